# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# For scripts that draw with programs of OpenGL. In the environment are a DISPLAY; VENDOR, the folder of the
# OpenGL vendor library; and TOOLS, that of gl_shot and still_clock.so.
# shellcheck disable=SC2034 # used by those scripts
gloss="env LD_LIBRARY_PATH=$VENDOR __GLX_VENDOR_LIBRARY_NAME=gloss
	__EGL_VENDOR_LIBRARY_FILENAMES=$VENDOR/90_gloss.json GLOSS_DEVICE=model: GLOSS_CONFIG=/dev/null vblank_mode=0"
mesa='env __GLX_VENDOR_LIBRARY_NAME=mesa LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=0'
softpipe="$mesa GALLIUM_DRIVER=softpipe"
llvmpipe="$mesa GALLIUM_DRIVER=llvmpipe"

# need PACKAGES PROGRAM...: skips without one of the programs.
need() {
	packages=$1
	shift
	for program; do
		command -v "$program" >/dev/null || {
			echo "skip: no $program; install $packages (make deps)"
			exit 0
		}
	done
}

# need_renderer NAME COMMAND...: skips if glxinfo, run by that, has another renderer.
need_renderer() {
	renderer=$1
	shift
	"$@" glxinfo 2>/dev/null | grep -q "renderer string: $renderer" || {
		echo "skip: no $renderer; install libgl1-mesa-dri (make deps)"
		exit 0
	}
}

# draw WIDTH HEIGHT PICTURE COMMAND...: what a program has in the corner of the screen, when it stands still.
draw() {
	width=$1 height=$2 picture=$3
	shift 3
	"$@" >"$picture.log" 2>&1 &
	program=$!
	"$TOOLS/gl_shot" "$width" "$height" "$picture"
	kill $program
	wait $program 2>/dev/null || true
	"$TOOLS/gl_shot" --black "$width" "$height"
}
