#!/bin/sh
# SPDX-License-Identifier: MIT
# What tests/bench/merge takes and what it refuses: test_merge.sh OUT
set -u
merge=$(dirname "$0")/merge
out=$1
failed=0

# A build folder that is right, to be spoilt by each case.
begin() {
	rm -rf "$out"
	mkdir -p "$out/bench"
	# shellcheck disable=SC2016 # the docs have backquotes
	printf '| name | what |\n|---|---|\n| `a.speed` | x |\n| `a.words` | x |\n| `synth.luts` | x |\n' \
		>"$out/figures.md"
	printf '# a remark\na.speed 1.50   # at least 1\n\na.words 28\n' >"$out/bench/a.txt"
}

fail() {
	echo "test_merge: $1" >&2
	cat "$out/said" >&2
	failed=1
}

run() {
	"$merge" "$out" "$out/figures.md" >"$out/said" 2>&1
}

# takes NAME EXPECTED
takes() {
	if ! run || [ "$(tr -d ' \n' <"$out/bench.json")" != "$2" ]; then
		fail "$1"
	fi
}

# refuses NAME MESSAGE: and writes nothing
refuses() {
	if run || [ -e "$out/bench.json" ] || ! grep -qF "$2" "$out/said"; then
		fail "$1"
	fi
}

begin
takes "figures without those of synthesis" '{"a.speed":1.5,"a.words":28}'
grep -q "make synth.*synth.luts" "$out/said" || fail "says that synthesis is missing"

begin
echo '{"synth.luts": 7}' >"$out/synth.json"
takes "figures with those of synthesis" '{"a.speed":1.5,"a.words":28,"synth.luts":7}'

begin
rm "$out/bench/a.txt"
mkdir "$out/vm"
echo '{ "a.speed": 1.5, "a.words": 28 }' >"$out/vm/a.json"
takes "figures of the virtual machine" '{"a.speed":1.5,"a.words":28}'

begin
mkdir "$out/vm"
echo '{ "a.words": 28 }' >"$out/vm/a.json"
refuses "a name in a file and an object" "twice: $out/vm/a.json: a.words"

begin
echo 'a.words 28' >"$out/bench/b.txt"
refuses "a name in two files" "twice: $out/bench/b.txt: a.words"

begin
echo 'a.words 28' >>"$out/bench/a.txt"
refuses "a name twice in a file" "twice: $out/bench/a.txt: a.words"

begin
echo '{"synth.luts": 7, "synth.luts": 7}' >"$out/synth.json"
refuses "a name twice in an object" "twice: $out/synth.json: synth.luts"

for value in many nan inf; do
	begin
	echo "a.speed $value" >"$out/bench/a.txt"
	refuses "the value $value" "not a number: $out/bench/a.txt: a.speed"
done

for value in '"7"' true null NaN '{}'; do
	begin
	echo "{\"synth.luts\": $value}" >"$out/synth.json"
	refuses "the value $value of an object" "not a number: $out/synth.json: synth.luts"
done

for text in '[7]' '{"synth.luts"'; do
	begin
	echo "$text" >"$out/synth.json"
	refuses "the file $text" "$out/synth.json"
done

begin
echo 'a.speed is 7' >"$out/bench/b.txt"
refuses "a line of three words" "not 'name value': $out/bench/b.txt"

begin
echo 'a.other 7' >"$out/bench/b.txt"
refuses "a name that the docs do not explain" "not explained in $out/figures.md: a.other"

begin
echo 'a.speed 1.5' >"$out/bench/a.txt"
refuses "a figure that is missing" "no benchmark printed it: a.words"

exit $failed
