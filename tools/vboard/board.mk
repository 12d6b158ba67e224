# SPDX-License-Identifier: MIT
# The C model of the port, and the board that is made of it and the core's model.

BOARD_MODEL_OBJECTS := $(addprefix $(BUILD)/tools/vboard/,port_dma.o port_pci.o board_model.o)

$(BOARD_MODEL_OBJECTS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver $(CFLAGS) -MMD -MP -c $< -o $@

-include $(BOARD_MODEL_OBJECTS:.o=.d)

