# SPDX-License-Identifier: MIT
# From the calls of a program to draws of libaccel.

SHIM_SOURCES += mesa_shim/api/attributes.c $(addprefix mesa_shim/draw/, vertices.c batch.c immediate.c list.c \
	list_names.c names.c shared.c clear.c read.c read_pixels.c \
	pixel_format.c raster_position.c bitmap.c buffer.c array.c \
	array_draw.c emit.c render_mode.c select.c feedback.c \
	evaluator.c evaluate.c query.c)
