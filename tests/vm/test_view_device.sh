#!/bin/sh
# SPDX-License-Identifier: MIT
# What gloss-view says of boards that are there, missing or not permitted, to an ordinary user in and
# out of the nodes' group.
set -u
work=$(mktemp -d)
rtl=$GLOSS_NODE_RTL model=$GLOSS_NODE_MODEL
mode=$(stat -c %a "$rtl") group=$(stat -c %G "$rtl")
[ "$group" != UNKNOWN ] || group=$(stat -c %g "$rtl")
trap 'rm -rf "$work"; chmod "$mode" "$rtl" "$model"' EXIT
chmod 755 "$work"
failures=0

fail() {
	failures=$((failures + 1))
	echo "FAILED: $*"
	sed 's/^/    /' "$work/out" "$work/err"
}

# view GROUP DEVICE: as user 1000, in GROUP besides its own.
view() {
	setpriv --reuid 1000 --regid 1000 --groups "$1" "$GLOSS_BUILD/gloss-view" \
		--device "$2" --size 64x64 --stats sphere:1 >"$work/out" 2>"$work/err"
	status=$?
}

# draws_on NODE GROUP DEVICE
draws_on() {
	view "$2" "$3"
	[ "$status" -eq 0 ] || fail "$3: exit $status"
	grep -q "^device  *Gloss PCI board $1, 64-pixel tiles, [1248] lanes$" "$work/out" ||
		fail "$3 is not drawn on $1"
	[ ! -s "$work/err" ] || fail "$3: complains"
}

# refused GROUP DEVICE REASON: one line, exit 1.
refused() {
	view "$1" "$2"
	[ "$status" -eq 1 ] || fail "$2: exit $status, not 1"
	[ "$(wc -l <"$work/err")" -eq 1 ] || fail "$2: not one line"
	grep -qxF "gloss-view: can not open device: ${2%:}: $3" "$work/err" || fail "$2: not '$3'"
	[ ! -s "$work/out" ] || fail "$2: prints"
}

members=$(stat -c %g "$rtl")
draws_on "$rtl" "$members" drm:
draws_on "$rtl" "$members" auto
draws_on "$rtl" "$members" "drm:$rtl"
draws_on "$model" "$members" "drm:$model"

refused "$members" drm:/dev/dri/renderD200 "there is no /dev/dri/renderD200; ls /dev/dri shows the nodes, \
sudo modprobe gloss loads the module"
refused "$members" drm:/dev/null '/dev/null is no DRM node'

advice="add yourself with sudo usermod -aG $group \$USER and log in again"
refused 1000 "drm:$rtl" "not permitted: $rtl is for group $group; $advice"
refused 1000 drm: "not permitted: $rtl is for group $group; $advice"

chmod 600 "$rtl"
refused "$members" "drm:$rtl" "not permitted: $rtl is of group $group and mode 0600; \
group render and mode 0660 are usual"
draws_on "$model" "$members" drm:
chmod 600 "$model"
view "$members" auto
grep -q '^device  *Gloss USB board' "$work/out" || fail 'auto without a PCI board is not one on USB'
view 1000 auto
grep -q '^device  *C model' "$work/out" || fail 'auto without a board that may be used is not the model'

echo "$failures failures"
[ "$failures" -eq 0 ]
