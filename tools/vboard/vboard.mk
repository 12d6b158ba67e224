# SPDX-License-Identifier: MIT
# The virtual board: what stands in for a PCI board in a virtual machine.

VBOARD_OBJECTS := $(addprefix $(BUILD)/tools/vboard/, config.o door_pci.o faults.o load.o loop.o \
	memory.o message.o options.o qtest.o)
VBOARD_MAIN := $(BUILD)/tools/vboard/vboard-pci.o

# The model of the port and the board (BOARD_MODEL_OBJECTS), and the Verilated board.
include $(wildcard tools/vboard/board.mk)

$(VBOARD_OBJECTS) $(VBOARD_MAIN): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver $(CFLAGS) -pthread -MMD -MP -c $< -o $@

$(BUILD)/tools/vboard/options.o: ACCEL_CFLAGS += -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'
$(BUILD)/tools/vboard/load.o: $(BUILD)/libaccel/sim_dir
$(BUILD)/tools/vboard/load.o: ACCEL_CFLAGS += -DACCEL_SIM_DIR='"$(ACCEL_SIM_DIR)"'

$(BUILD)/vboard-pci: $(VBOARD_MAIN) $(VBOARD_OBJECTS) $(BOARD_MODEL_OBJECTS) \
		$(BUILD)/libaccel/parts.a
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(ACCEL_LIBS) -o $@

-include $(VBOARD_OBJECTS:.o=.d) $(VBOARD_MAIN:.o=.d)

LINT_C += -Idriver
ALL += $(BUILD)/vboard-pci
