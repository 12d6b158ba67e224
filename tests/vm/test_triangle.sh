#!/bin/sh
# SPDX-License-Identifier: MIT
# The first program of README.md finds the board by itself, and draws on it what it draws on model:.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$GLOSS_BUILD/tests/vm/triangle" >"$work/auto.ppm"
"$GLOSS_BUILD/tests/vm/triangle" model: >"$work/model.ppm"
cmp "$work/auto.ppm" "$work/model.ppm"
[ "$(wc -c <"$work/auto.ppm")" -eq $((15 + 256 * 256 * 3)) ]
