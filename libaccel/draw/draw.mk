# SPDX-License-Identifier: MIT
# From meshes to command streams. In the order a triangle passes through them.

DRAW_SOURCES := $(addprefix libaccel/draw/, draw.c clear.c arrays.c primitives.c slices.c mesh.c strokes.c points.c lines.c polygons.c capture.c offset.c group.c face.c geometry.c fetch.c clip.c \
	lighting.c patch.c shading.c spot.c interpolate.c split.c few.c leaf.c surface.c setup.c small.c record.c \
	record_small.c bin.c fill.c content.c frame.c kernel.c kernel_baseline.c kernel_avx2.c kernel_avx512.c)

# Loops that become vector code. Neither option changes a value: errno is not asked for, nor are traps.
KERNEL_CFLAGS := -O3 -fno-math-errno -fno-trapping-math
FLAGS_libaccel/draw/kernel_baseline.c := $(KERNEL_CFLAGS)
FLAGS_libaccel/draw/kernel_avx2.c := $(KERNEL_CFLAGS)
FLAGS_libaccel/draw/kernel_avx512.c := $(KERNEL_CFLAGS)
ifneq ($(filter x86_64%,$(shell $(CC) -dumpmachine)),)
FLAGS_libaccel/draw/kernel_avx2.c += -mavx2
FLAGS_libaccel/draw/kernel_avx512.c += -mavx512f -mavx512bw -mavx512dq -mavx512vl \
	-mprefer-vector-width=512
endif
