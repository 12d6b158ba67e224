#!/bin/sh
# SPDX-License-Identifier: MIT
# What `make install-lib` put into DESTDIR is all there, and enough to compile the README's
# program, in C and C++, shared and static, and to run it on model and simulator:
# test_install.sh DESTDIR PREFIX LIBDIR CORES
set -eu
destdir=$(cd "$1" && pwd) prefix=$2 libdir=$3 cores=$4
work=$destdir.work
cc=${CC:-cc} cxx=${CXX:-c++}
rm -rf "$work"
mkdir -p "$work"

{
	echo "$prefix/include/gloss/accel.h"
	echo "$prefix/include/gloss/gloss_packets.h"
	for file in libaccel.a libaccel.so libaccel.so.0 pkgconfig/libaccel.pc; do
		echo "$libdir/$file"
	done
	for core in $cores; do
		echo "$libdir/gloss/accel-sim-$core.so"
	done
} | sort >"$work/expected"
(cd "$destdir" && find . ! -type d) | sed 's/^\.//' | sort >"$work/installed"
diff -u "$work/expected" "$work/installed"

export PKG_CONFIG_PATH="$destdir$libdir/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$destdir"
cflags="-Wall -Wextra -Wpedantic -Werror $(pkg-config --cflags libaccel)"
libs=$(pkg-config --libs libaccel)
static=$(pkg-config --static --libs libaccel | sed 's/-laccel\b/-l:libaccel.a/')

# shellcheck disable=SC2086 # lists of flags
{
	$cc -std=c11 $cflags examples/triangle.c $libs -o "$work/shared"
	$cc -std=c11 $cflags examples/triangle.c $static -o "$work/static"
	printf '#include <accel.h>\nint main() { accel_device_free(nullptr); }\n' >"$work/cxx.cpp"
	$cxx -std=c++17 $cflags "$work/cxx.cpp" $libs -o "$work/cxx"
}
export LD_LIBRARY_PATH="$destdir$libdir"
readelf -d "$work/shared" | grep -q 'NEEDED.*\[libaccel.so.0\]'
if readelf -d "$work/static" | grep NEEDED | grep -q -e libaccel -e stdc++; then
	echo "the static program needs a library that it should have in itself"
	exit 1
fi

"$work/cxx"
"$work/shared" >"$work/shared.ppm"
"$work/static" >"$work/static.ppm"
cmp "$work/shared.ppm" "$work/static.ppm"
[ "$(head -c 15 "$work/shared.ppm")" = "P6 256 256 255" ]
[ "$(wc -c <"$work/shared.ppm")" -eq $((15 + 256 * 256 * 3)) ]
# A triangle of half the picture's area: more than a third of the bytes are not black.
[ "$(tail -c +16 "$work/shared.ppm" | tr -d '\0' | wc -c)" -gt 65536 ]

case " $cores " in
*" t64-k8 "*)
	GLOSS_SIM_PATH="$destdir$libdir/gloss" "$work/shared" sim: >"$work/sim.ppm"
	cmp "$work/shared.ppm" "$work/sim.ppm"
	;;
esac
