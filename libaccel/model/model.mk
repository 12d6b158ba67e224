# SPDX-License-Identifier: MIT
# The bit-exact model: MODEL_OBJS go into libaccel, the benches and the tests.

MODEL_SOURCES := $(addprefix libaccel/model/, command.c command_check.c parallel.c triangle.c \
	triangle_small.c draw.c draw_small.c raster.c shade.c fragment.c tile.c memory.c)
MODEL_OBJS := $(MODEL_SOURCES:%.c=$(BUILD)/%.o)
