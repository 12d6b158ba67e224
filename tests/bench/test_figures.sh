#!/bin/sh
# SPDX-License-Identifier: MIT
# How figures get into the documents, and into the drawing of them: test_figures.sh OUT
set -u
here=$(dirname "$0")
out=$1
failed=0

fail() {
	echo "test_figures: $1" >&2
	failed=1
}

rm -rf "$out"
mkdir -p "$out"
cat >"$out/figures.md" <<'END'
# Figures
<!-- bench -->
```
a.count                              11
frame.vs_cphong.bunny                0.5
gone.count                           3
kept.speed                           2.5
```
<!-- end -->
| name | what | aim |
|---|---|---|
| `a.count` | x | |
| `a.mtri_s` | x | |
| `frame.vs_cphong.bunny` | x | at least 1 |
| `kept.speed` | x | 2 |
| `new.speed` | x | not asserted |
END
echo '{"a.count": 12, "a.mtri_s": 7, "new.speed": 0.123456, "frame.vs_cphong.bunny": 0.75}' >"$out/bench.json"

# What was not measured stays, what is not explained goes, times are left out.
"$here/figures" "$out/bench.json" "$out/figures.md" || fail 'figures fails'
# shellcheck disable=SC2016 # of Markdown
sed -n '/^```/,/^```/p' "$out/figures.md" | grep -v '^```' | tr -s ' ' >"$out/block"
cat >"$out/wanted" <<'END'
a.count 12
frame.vs_cphong.bunny 0.75
kept.speed 2.5
new.speed 0.1235
END
cmp "$out/block" "$out/wanted" || fail 'another block than it should be'
head -n 1 "$out/figures.md" | grep -qx '# Figures' || fail 'the text before is lost'
tail -n 1 "$out/figures.md" | grep -q 'new.speed' || fail 'the text after is lost'

"$here/plot" "$out/figures.md" "$out/speed.svg" || fail 'plot fails'
grep -q '>0.75<' "$out/speed.svg" || fail 'the drawing has no figure'
grep -q 'stroke="#b3261e"' "$out/speed.svg" || fail 'the drawing has no aim'
"$here/plot" --check "$out/figures.md" "$out/speed.svg" || fail 'a drawing is not what was drawn'
sed -i 's/0.75/0.8/' "$out/figures.md"
"$here/plot" --check "$out/figures.md" "$out/speed.svg" 2>"$out/said" && fail 'an old drawing passes'
grep -q "make plot" "$out/said" || fail 'does not say what to do'
exit $failed
