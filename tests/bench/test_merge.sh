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

# blames NAME MESSAGE EXPECTED: it fails, and what is right is written all the same
blames() {
	if run || ! grep -qF "$2" "$out/said" ||
		[ "$(tr -d ' \n' <"$out/bench.json")" != "$3" ]; then
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
sed -i '$a| `pnr.mhz` | x |' "$out/figures.md"
echo '{"synth.luts": 7}' >"$out/synth.json"
takes "figures without those of placing" '{"a.speed":1.5,"a.words":28,"synth.luts":7}'
grep -q "make pnr.*pnr.mhz" "$out/said" || fail "says that placing is missing"

begin
sed -i '$a| `pnr.mhz` | x |' "$out/figures.md"
echo '{"pnr.mhz": 99.5}' >"$out/pnr.json"
takes "figures with those of placing" '{"a.speed":1.5,"a.words":28,"pnr.mhz":99.5}'

begin
rm "$out/bench/a.txt"
mkdir "$out/vm"
echo '{ "a.speed": 1.5, "a.words": 28 }' >"$out/vm/a.json"
takes "figures of the virtual machine" '{"a.speed":1.5,"a.words":28}'

begin
echo 'a.speed -  # needs what is not here' >"$out/bench/a.txt"
echo 'a.words 28' >>"$out/bench/a.txt"
takes "a figure that can not be measured here" '{"a.words":28}'
grep -q "can not be measured here.*a.speed" "$out/said" || fail "says what can not be measured"

both='{"a.speed":1.5,"a.words":28}' speed='{"a.speed":1.5}' words='{"a.words":28}'

begin
mkdir "$out/vm"
echo '{ "a.words": 28 }' >"$out/vm/a.json"
blames "a name in a file and an object" "twice: $out/vm/a.json: a.words" "$speed"

begin
echo 'a.words 28' >"$out/bench/b.txt"
blames "a name in two files" "twice: $out/bench/b.txt: a.words" "$speed"

begin
echo 'a.words 28' >>"$out/bench/a.txt"
blames "a name twice in a file" "twice: $out/bench/a.txt: a.words" "$speed"

begin
echo 'a.words 28' >>"$out/bench/a.txt"
echo 'a.words 28' >>"$out/bench/a.txt"
blames "a name three times" "twice: $out/bench/a.txt: a.words" "$speed"

begin
echo '{"synth.luts": 7, "synth.luts": 7}' >"$out/synth.json"
blames "a name twice in an object" "twice: $out/synth.json: synth.luts" "$both"

for value in many nan inf; do
	begin
	printf 'a.speed %s\na.words 28\n' $value >"$out/bench/a.txt"
	blames "the value $value" "not a number: $out/bench/a.txt: a.speed" "$words"
done

for value in '"7"' true null NaN '{}'; do
	begin
	echo "{\"synth.luts\": $value}" >"$out/synth.json"
	blames "the value $value of an object" "not a number: $out/synth.json: synth.luts" "$both"
done

for text in '[7]' '{"synth.luts"'; do
	begin
	echo "$text" >"$out/synth.json"
	blames "the file $text" "$out/synth.json" "$both"
done

begin
echo 'a.speed is 7' >"$out/bench/b.txt"
blames "a line of three words" "not 'name value': $out/bench/b.txt" "$both"

begin
echo 'a.other 7' >"$out/bench/b.txt"
blames "a name that the docs do not explain" "not explained in $out/figures.md: a.other" \
	'{"a.other":7,"a.speed":1.5,"a.words":28}'

begin
echo 'a.speed 1.5' >"$out/bench/a.txt"
blames "a figure that is missing" "no benchmark printed it: a.words" "$speed"

exit $failed
