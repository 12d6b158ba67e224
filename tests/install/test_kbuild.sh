#!/bin/sh
# SPDX-License-Identifier: MIT
# The kernel's own build, given the top folder, makes gloss.ko, in a copy: test_kbuild.sh OUT KDIR
set -eu
out=$1
kdir=$2

rm -rf "$out"
mkdir -p "$out"
out=$(cd "$out" && pwd)
cp -r Kbuild driver "$out"
env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL make -C "$kdir" M="$out" \
	CONFIG_DEBUG_INFO_BTF_MODULES= modules >"$out/log" 2>&1 || {
	cat "$out/log" >&2
	exit 1
}
[ -e "$out/driver/gloss.ko" ] || {
	echo "test_kbuild: make -C $kdir M=... made no driver/gloss.ko" >&2
	exit 1
}
echo "gloss.ko from the top folder: built"
