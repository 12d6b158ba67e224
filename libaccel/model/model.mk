# SPDX-License-Identifier: MIT
# The bit-exact model: MODEL_OBJS go into libaccel, the benches and the tests.

MODEL_SOURCES := $(addprefix libaccel/model/, command.c command_check.c triangle.c draw.c \
	raster.c shade.c fragment.c tile.c memory.c)
MODEL_OBJS := $(MODEL_SOURCES:%.c=$(BUILD)/%.o)

$(BUILD)/libaccel/model/%.o: libaccel/model/%.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -fPIC -MMD -MP -c $< -o $@

# Random jobs, for whoever compares engines.
STREAM_RANDOM_SOURCES := $(addprefix tests/stream/, stream_random.c stream_random_triangle.c \
	stream_random_damage.c)
STREAM_RANDOM_OBJS := $(STREAM_RANDOM_SOURCES:%.c=$(BUILD)/%.o)

$(STREAM_RANDOM_OBJS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -MMD -MP -c $< -o $@

-include $(MODEL_OBJS:.o=.d) $(STREAM_RANDOM_OBJS:.o=.d)

MODEL_TESTS := $(addprefix test_model_, command draw fault memory random raster triangle)
MODEL_TEST_SOURCES := tests/unit/model/reference.c

$(call unit,$(MODEL_TESTS)): $(BUILD)/%: %.c $(MODEL_TEST_SOURCES) \
		$(STREAM_RANDOM_OBJS) $(MODEL_OBJS)
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itests/unit -Itests/stream $(CFLAGS) -MMD -MP -MF $@.d $< \
		$(MODEL_TEST_SOURCES) $(STREAM_RANDOM_OBJS) $(MODEL_OBJS) -lcmocka -o $@

UNIT_TESTS += $(MODEL_TESTS)

include tests/fuzz/fuzz.mk
