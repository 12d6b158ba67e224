#!/bin/sh
# SPDX-License-Identifier: MIT
# What tests/bench/run keeps when a benchmark fails: test_run.sh OUT
set -u
run=$(dirname "$0")/run
out=$1
failed=0

fail() {
	echo "test_run: $1" >&2
	cat "$out/said" >&2
	failed=1
}

# A make whose targets are benchmarks: "good", "late", which misses an aim, "dead", which ends by itself.
rm -rf "$out"
mkdir -p "$out/bench" "$out/vm"
cat >"$out/make" <<'END'
#!/bin/sh
for last; do :; done
case $last in
good) echo 'a.speed 1.5' >"$OUT/bench/good.txt" ;;
late)
	echo 'b.speed 0.5' >"$OUT/bench/late.txt"
	echo 'b.speed 0.5 # at least 1: MISSED'
	echo 'c.speed 0.5'
	echo 'make: *** [late] Error 1' >&2
	exit 1
	;;
dead)
	echo 'no board' >&2
	exit 2
	;;
esac
END
chmod +x "$out/make"
# shellcheck disable=SC2016 # the docs have backquotes
printf '| name | what |\n|---|---|\n| `a.speed` | x |\n| `b.speed` | x |\n' >"$out/figures.md"
export MAKE="$out/make" OUT="$out"

expect() {
	[ "$(tr -d ' \n' <"$out/bench.json")" = "$1" ] || fail "figures are not $1"
}

says() {
	grep -q "$1" "$out/said" || fail "does not say $1"
}

"$run" "$out" "$out/figures.md" good late >"$out/said" 2>&1 && fail 'passes in spite of a missed aim'
expect '{"a.speed":1.5,"b.speed":0.5}'
says 'FAILED: late: b.speed 0.5 # at least 1: MISSED'
says 'time taken: good [0-9]* s, late [0-9]* s$'

# The figures of the run before are not taken for those of this one.
echo '{"b.speed": 1}' >"$out/vm/late.json"
"$run" "$out" "$out/figures.md" dead good >"$out/said" 2>&1 && fail 'passes in spite of a dead part'
expect '{"a.speed":1.5}'
says 'FAILED: dead: no board'
says 'no benchmark printed it: b.speed'

cp "$out/figures.md" "$out/both.md"
grep -v b.speed "$out/both.md" >"$out/figures.md"
"$run" "$out" "$out/figures.md" good >"$out/said" 2>&1 || fail 'fails without a failure'
! grep -q FAILED "$out/said" || fail 'names a part that did not fail'
exit $failed
