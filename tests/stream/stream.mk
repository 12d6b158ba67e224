# SPDX-License-Identifier: MIT
# Whole jobs, model against RTL, other ones each time. 200 groups are 2,000 valid and 400 damaged jobs for
# each core; before a change of the core lands, make stream STREAM_GROUPS=1000 or more.

STREAM_GROUPS ?= 200
STREAM_SOURCES := $(addprefix tests/stream/, \
	test_stream.c stream_random.c stream_random_triangle.c stream_random_damage.c) \
	tools/decode/decode.c tools/decode/print.c

$(BUILD)/tests/stream/test_stream: $(STREAM_SOURCES) tests/stream/stream_random.h tools/decode/decode.h \
		$(MODEL_OBJS)
	$(call quiet,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -Itools -Itests/stream $(STREAM_SOURCES) $(MODEL_OBJS) \
		-ldl -o $@

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

# A second generator, from the table of rtl/gloss.xml; and the same jobs to boards on USB.
# make check has what reaches every packet, opcode and reserved bit on a core, and some of it on a board.
GRAMMAR_JOBS  ?= 50000
GRAMMAR_SOURCES := $(addprefix tests/stream/, test_grammar.c grammar.c grammar_sense.c \
	grammar_damage.c grammar_coverage.c grammar_engine.c) tools/decode/decode.c tools/decode/print.c
GRAMMAR_OBJECTS := $(USB_HOST_OBJ) $(BOARD_USB_MODEL_OBJECTS) $(MODEL_OBJS)

$(BUILD)/tests/stream/test_grammar: $(GRAMMAR_SOURCES) $(wildcard tests/stream/grammar*.h) \
		tools/decode/decode.h tools/decode/table.h tools/decode/gloss_table.h $(GRAMMAR_OBJECTS)
	$(call quiet,CC,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -Idriver -Itools -Itests/stream -Itests/port \
		$(GRAMMAR_SOURCES) $(GRAMMAR_OBJECTS) -ldl -o $@

GRAMMAR_RUN = $< -o $(BUILD)/tests/stream/failed-$@.bin
check-grammar: $(BUILD)/tests/stream/test_grammar $(addprefix $(BUILD)/sim/,accel-sim-t32-k1.so accel-usb-t64-k2.so)
	$(Q)$(GRAMMAR_RUN) $(BUILD)/sim/accel-sim-t32-k1.so
	$(Q)$(GRAMMAR_RUN) -n 256 $(BUILD)/sim/accel-usb-t64-k2.so

# An eighth on each core, and on the USB boards that there are of it.
GRAMMAR_CORES := $(STREAM_FIRST) $(STREAM_SECOND)
GRAMMAR_BOARDS := t32-k1 t64-k2 t64-k8
$(GRAMMAR_CORES:%=grammar-%): grammar-%: $(BUILD)/tests/stream/test_grammar $(BUILD)/sim/accel-sim-%.so
	$(Q)$(GRAMMAR_RUN) -n $$(($(GRAMMAR_JOBS) / $(words $(GRAMMAR_CORES)))) $(filter %.so,$^)
$(GRAMMAR_BOARDS:%=grammar-%): grammar-%: $(BUILD)/sim/accel-usb-%.so

.PHONY: check-grammar stream-grammar $(GRAMMAR_CORES:%=grammar-%)
stream-grammar: $(GRAMMAR_CORES:%=grammar-%) ## 50,000 jobs of a second generator: model against RTL and USB boards

CHECKS += check-grammar
