# SPDX-License-Identifier: MIT
# OpenGL's state: what the commands keep, and how it is asked for.

SHIM_SOURCES += $(addprefix mesa_shim/state/, context.c command.c error.c missing.c table.c attributes.c enable.c get.c \
	push.c client.c matrix.c transform.c light.c material.c raster.c fragment.c fog.c hint.c pixel_store.c \
	string.c)
