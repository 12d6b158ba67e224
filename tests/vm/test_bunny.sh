#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the bunny through the driver, on the Verilated core and on the C model behind the port: the
# pictures are those of model:, byte for byte.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bunny=${MODELS:-/usr/share/glmark2/models}/bunny.obj
[ -r "$bunny" ] || {
	echo "skip: no $bunny (package glmark2-data)"
	exit 77
}

draw() {
	"$GLOSS_BUILD/gloss-view" --device "$2" --stats --out "$work/$1.png" "$bunny"
}

same() {
	cmp "$work/$1.png" "$work/model.png" || {
		echo "the bunny on board $1 is not the one on the model"
		exit 1
	}
}

draw model model:
draw port "drm:$GLOSS_NODE_MODEL"
same port
draw rtl "drm:$GLOSS_NODE_RTL"
same rtl
