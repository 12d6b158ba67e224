# SPDX-License-Identifier: MIT
# From meshes to command streams. In the order a triangle passes through them.

DRAW_SOURCES := $(addprefix libaccel/draw/, draw.c mesh.c geometry.c fetch.c clip.c lighting.c patch.c \
	shading.c interpolate.c split.c surface.c setup.c record.c bin.c content.c frame.c)
