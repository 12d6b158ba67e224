#!/bin/sh
# SPDX-License-Identifier: MIT
# What `make install-shim` put into DESTDIR is what libglvnd finds, and uninstall-shim takes it away:
# test_install_shim.sh DESTDIR LIBDIR DATADIR MAKE, with a DISPLAY.
set -eu
destdir=$1 libdir=$2 datadir=$3 make=$4
work=$destdir.work
rm -rf "$work"
mkdir -p "$work"

for program in glxinfo eglinfo; do
	command -v $program >/dev/null || {
		echo "skip: no $program; install mesa-utils (make deps)"
		exit 0
	}
done

printf '%s\n' "$datadir/90_gloss.json" "$libdir/libEGL_gloss.so.0" "$libdir/libGLX_gloss.so.0" | sort >"$work/expected"
(cd "$destdir" && find . ! -type d) | sed 's/^\.//' | sort >"$work/installed"
diff -u "$work/expected" "$work/installed"

export GLOSS_DEVICE=model: GLOSS_CONFIG=/dev/null
LD_LIBRARY_PATH=$destdir$libdir __GLX_VENDOR_LIBRARY_NAME=gloss glxinfo >"$work/glxinfo"
grep -q 'OpenGL vendor string: Gloss' "$work/glxinfo"

# EGL needs no library path, as the vendor's file has it; here DESTDIR comes before it.
sed "s|\"$libdir/|\"$destdir$libdir/|" "$destdir$datadir/90_gloss.json" >"$work/90_gloss.json"
__EGL_VENDOR_LIBRARY_DIRS=$work eglinfo >"$work/eglinfo"
grep -q 'EGL vendor string: Gloss' "$work/eglinfo"

$make -s uninstall-shim DESTDIR="$destdir"
left=$(find "$destdir" ! -type d)
[ -z "$left" ] || {
	echo "left by uninstall-shim: $left" >&2
	exit 1
}
