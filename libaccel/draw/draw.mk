# SPDX-License-Identifier: MIT
# From meshes to command streams. In the order a triangle passes through them.

DRAW_SOURCES := $(addprefix libaccel/draw/, draw.c mesh.c geometry.c clip.c lighting.c shading.c \
	interpolate.c split.c surface.c setup.c record.c bin.c frame.c)

DRAW_UNIT_TESTS := test_setup test_setup_surface test_geometry test_lighting test_shading \
	test_bin test_draw test_draw_colour test_draw_parts test_draw_split test_draw_clip \
	test_draw_spot test_draw_perspective test_draw_reports test_draw_out_of_memory
UNIT_TESTS += $(DRAW_UNIT_TESTS)

$(call unit,test_draw_out_of_memory): UNIT_LDFLAGS := -Wl,--wrap=malloc \
	-Wl,--wrap=calloc -Wl,--wrap=realloc -Wl,--wrap=free
$(call unit,test_draw): $(DECODE_OBJECTS)
$(call unit,test_draw): ACCEL_CFLAGS += -Itools
$(call unit,test_draw): UNIT_LDFLAGS := $(DECODE_OBJECTS) -Wl,--wrap=accel_stream_submit
