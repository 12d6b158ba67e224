#!/bin/sh
# SPDX-License-Identifier: MIT
# The first program in README.md is examples/triangle.c but for its licence line: test_readme.sh OUT
set -eu
mkdir -p "$1"
# shellcheck disable=SC2016 # backquotes of Markdown
sed -n '/^## A first program/,/^## What/p' README.md | sed -n '/^```c$/,/^```$/p' |
	sed '1d;$d' >"$1/readme.c"
sed 1d examples/triangle.c >"$1/example.c"
diff -u --label examples/triangle.c "$1/example.c" --label README.md "$1/readme.c"
