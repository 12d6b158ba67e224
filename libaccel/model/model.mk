# SPDX-License-Identifier: MIT
# The bit-exact model: MODEL_OBJS go into libaccel, the benches and the tests.

MODEL_SOURCES := $(addprefix libaccel/model/, \
	command.c command_check.c triangle.c raster.c shade.c fragment.c tile.c memory.c)
MODEL_OBJS := $(MODEL_SOURCES:%.c=$(BUILD)/%.o)

$(BUILD)/libaccel/model/%.o: libaccel/model/%.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -fPIC -MMD -MP -c $< -o $@

-include $(MODEL_OBJS:.o=.d)
