# SPDX-License-Identifier: MIT
# Whole jobs, model against RTL. 1000 groups are 10,000 valid and 2,000 damaged jobs.

STREAM_GROUPS ?= 1000
STREAM_SOURCES := $(addprefix tests/stream/, \
	test_stream.c stream_random.c stream_random_triangle.c stream_random_damage.c) \
	tools/decode.c tools/decode_print.c

$(BUILD)/tests/stream/test_stream: $(STREAM_SOURCES) tests/stream/stream_random.h tools/decode.h \
		$(MODEL_OBJS)
	$(call quiet,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -Itools -Itests/stream $(STREAM_SOURCES) $(MODEL_OBJS) \
		-ldl -o $@

# Two targets of about the same time, for two processors.
STREAM_FIRST := t64-k1 t64-k4 t64-k8
STREAM_SECOND := t64-k2 t32-k1 t32-k2 t32-k4 t32-k8

define stream_run
stream-$(1): $(BUILD)/tests/stream/test_stream $(2:%=$(BUILD)/sim/accel-sim-%.so)
	$(Q)for core in $(2); do \
		$$< -n $(STREAM_GROUPS) -o $(BUILD)/tests/stream/failed-$$$$core.bin \
			$(BUILD)/sim/accel-sim-$$$$core.so || exit 1; \
	done
endef
$(eval $(call stream_run,first,$(STREAM_FIRST)))
$(eval $(call stream_run,second,$(STREAM_SECOND)))

.PHONY: stream stream-first stream-second
stream: stream-first stream-second ## random jobs, valid and damaged: model against RTL, byte for byte

CHECKS += stream-first stream-second
