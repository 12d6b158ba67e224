#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the bunny on each board given: the pictures are those of model:, byte for byte.
# vm_bunny.sh DEVICE...
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bunny=${MODELS:-/usr/share/glmark2/models}/bunny.obj
[ -r "$bunny" ] || {
	echo "skip: no $bunny (package glmark2-data)"
	exit 77
}

draw() {
	"$GLOSS_BUILD/gloss-view" --device "$1" --stats --out "$2" "$bunny"
}

draw model: "$work/model.png"
for device; do
	draw "$device" "$work/board.png"
	cmp "$work/board.png" "$work/model.png" || {
		echo "the bunny on $device is not the one on the model"
		exit 1
	}
done
