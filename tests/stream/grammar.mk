# SPDX-License-Identifier: MIT
# A second generator, from the table of rtl/gloss.xml; and the same jobs to boards on USB.
# make check has what reaches every packet, opcode and reserved bit on a core, and some of it on a board.
##@ RTL against the model
GRAMMAR_JOBS  ?= 50000
$(BUILD)/tests/stream/test_grammar: private LIBS := -ldl
$(BUILD)/tests/stream/test_grammar: $(addprefix $(BUILD)/tests/stream/, grammar.o grammar_sense.o \
	grammar_damage.o grammar_coverage.o grammar_engine.o) $(DECODE_OBJECTS) $(USB_HOST_OBJ) \
	$(BOARD_USB_MODEL_OBJECTS) $(MODEL_OBJS)

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
