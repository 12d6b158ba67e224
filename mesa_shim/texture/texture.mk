# SPDX-License-Identifier: MIT
# Textures: images kept as they were given, and all that says how they are sampled.

SHIM_SOURCES += $(addprefix mesa_shim/texture/, texture.c format.c image.c tex_call.c tex_image.c tex_sub_image.c compressed.c \
	get_image.c parameter.c environment.c texgen.c)
