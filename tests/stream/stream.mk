# SPDX-License-Identifier: MIT
# Whole jobs, model against RTL, other ones each time. 200 groups are 2,000 valid and 400 damaged jobs for
# each core; before a change of the core lands, make stream STREAM_GROUPS=1000 or more.
##@ RTL against the model

STREAM_GROUPS ?= 200
# Random jobs, for whoever compares engines.
STREAM_RANDOM_OBJS := $(addprefix $(BUILD)/tests/stream/, stream_random.o stream_random_triangle.o \
	stream_random_small.o stream_random_damage.o)

$(BUILD)/tests/stream/test_stream: private LIBS := -ldl -pthread
$(BUILD)/tests/stream/test_stream: $(STREAM_RANDOM_OBJS) $(DECODE_OBJECTS) $(MODEL_OBJS) \
	$(addprefix $(BUILD)/libaccel/transport/, tile_threads.o thread.o)

# Two targets of about the same time, for two processors; one more, and shorter, for stream ports that
# are narrow and wide for their lanes.
STREAM_FIRST := t64-k1 t64-k4 t64-k8
STREAM_SECOND := t64-k2 t32-k1 t32-k2 t32-k4 t32-k8

STREAM_PORTS := t64-k8-s32 t32-k1-s128
STREAM_PORT_GROUPS ?= 100

define stream_run
stream-$(1): $(BUILD)/tests/stream/test_stream $(2:%=$(BUILD)/sim/accel-sim-%.so)
	$(Q)for core in $(2); do \
		$$< -n $(3) -o $(BUILD)/tests/stream/failed-$$$$core.bin \
			$(BUILD)/sim/accel-sim-$$$$core.so || exit 1; \
	done
endef
$(eval $(call stream_run,first,$(STREAM_FIRST),$$(STREAM_GROUPS)))
$(eval $(call stream_run,second,$(STREAM_SECOND),$$(STREAM_GROUPS)))
$(eval $(call stream_run,ports,$(STREAM_PORTS),$$(STREAM_PORT_GROUPS)))

.PHONY: stream stream-first stream-second stream-ports
stream: stream-first stream-second stream-ports ## random jobs, valid and damaged: model against RTL, byte for byte

CHECKS += stream-first stream-second stream-ports
