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
	echo "$prefix/include/gloss/accel_draw.h"
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
	$cc -std=c11 $cflags examples/highlight.c $libs -o "$work/highlight"
	cat >"$work/cxx.cpp" <<-'end'
		#include <accel.h>
		int main()
		{
			accel_light lamp = ACCEL_LIGHT();
			accel_state *state;

			lamp.enabled = true;
			int err = accel_state_new(&state) || accel_state_set_light(state, 0, &lamp);
			accel_state_free(state);
			return err;
		}
	end
	for header in accel.h accel_draw.h gloss_packets.h; do
		echo "#include <$header>" | $cc -std=c11 $cflags -fsyntax-only -x c -
	done
	for std in c++11 c++20; do
		$cxx -std=$std $cflags "$work/cxx.cpp" $libs -o "$work/cxx-$std"
	done
}
export LD_LIBRARY_PATH="$destdir$libdir"
readelf -d "$work/shared" | grep -q 'NEEDED.*\[libaccel.so.0\]'
if readelf -d "$work/static" | grep NEEDED | grep -q -e libaccel -e stdc++; then
	echo "the static program needs a library that it should have in itself"
	exit 1
fi

"$work/cxx-c++11"
"$work/cxx-c++20"
"$work/shared" >"$work/shared.ppm"
"$work/static" >"$work/static.ppm"
cmp "$work/shared.ppm" "$work/static.ppm"
[ "$(head -c 15 "$work/shared.ppm")" = "P6 256 256 255" ]
[ "$(wc -c <"$work/shared.ppm")" -eq $((15 + 256 * 256 * 3)) ]
# Triangles of half the picture's area: more than a third of the bytes are not black.
"$work/highlight" >"$work/highlight.ppm"
for picture in shared highlight; do
	[ "$(tail -c +16 "$work/$picture.ppm" | tr -d '\0' | wc -c)" -gt 65536 ]
done

case " $cores " in
*" t64-k8 "*)
	GLOSS_SIM_PATH="$destdir$libdir/gloss" "$work/shared" sim: >"$work/sim.ppm"
	cmp "$work/shared.ppm" "$work/sim.ppm"
	;;
esac
