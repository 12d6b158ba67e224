#!/bin/sh
# SPDX-License-Identifier: MIT
# Programs find both USB boards, and draw on each what they draw on model:.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
	failures=$((failures + 1))
	echo "FAILED: $*"
	sed 's/^/    /' "$work/out" "$work/err"
}

# run PROGRAM ARGUMENT...: exits with 0 and complains of nothing.
run() {
	program=$1
	shift
	"$GLOSS_BUILD/$program" "$@" >"$work/out" 2>"$work/err"
	status=$?
	[ "$status" -eq 0 ] || fail "$program $*: exit $status"
	[ ! -s "$work/err" ] || fail "$program $*: complains"
}

# has PATTERN: a line of what was printed.
has() {
	grep -qx -- "$1" "$work/out" || fail "no line '$1'"
}

# draws_on DEVICE
draws_on() {
	run gloss-view --device "$1" --size 100x70 --out "$work/board.png" --stats sphere:2
	has 'device  *Gloss USB board .*'
	cmp -s "$work/board.png" "$work/model.png" || fail "$1: gloss-view draws something else"
	run tests/vm/triangle "$1"
	cmp -s "$work/out" "$work/model.ppm" || fail "$1: triangle draws something else"
}

run gloss-view --device model: --size 100x70 --out "$work/model.png" sphere:2
run tests/vm/triangle model:
cp "$work/out" "$work/model.ppm"

run gloss-info --list
for board in "$GLOSS_USB_RTL" "$GLOSS_USB_MODEL" "drm:$GLOSS_NODE_RTL" "drm:$GLOSS_NODE_MODEL"; do
	has "$board  *..*"
done
run gloss-info --list --json
has " {\"device\": \"$GLOSS_USB_RTL\", \"description\": \".*\"},*"

for board in "$GLOSS_USB_RTL" "$GLOSS_USB_MODEL"; do
	run gloss-info --device "$board"
	has "device  *Gloss USB board ${board##*/}, .*"
	has 'tiles  *64x64 pixels'
	has 'lanes  *[1248] pixels a clock'
	has 'memory  *[1-9][0-9]* MiB'
	draws_on "$board"
done
draws_on usb:

echo "$failures failures"
[ "$failures" -eq 0 ]
