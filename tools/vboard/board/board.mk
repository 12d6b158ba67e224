# SPDX-License-Identifier: MIT
# The C models of the ports, the boards that are made of them and the core's model, and their tests.

BOARD_BASE_OBJECTS := $(addprefix $(BUILD)/tools/vboard/,port/base.o board/engine.o)
BOARD_MODEL_OBJECTS := $(BOARD_BASE_OBJECTS) \
	$(addprefix $(BUILD)/tools/vboard/,port/dma.o port/pci.o board/pci_model.o)
BOARD_USB_MODEL_OBJECTS := $(BOARD_BASE_OBJECTS) \
	$(addprefix $(BUILD)/tools/vboard/,port/usb.o board/usb_model.o)
BOARD_OBJECTS := $(sort $(BOARD_MODEL_OBJECTS) $(BOARD_USB_MODEL_OBJECTS))

$(BOARD_OBJECTS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools $(CFLAGS) -MMD -MP -c $< -o $@

-include $(BOARD_OBJECTS:.o=.d)

# Hosts for boards and an engine for ports, as the tests need them.
PORT_HOST_OBJ := $(BUILD)/tests/port/port_host.o
USB_HOST_OBJ := $(BUILD)/tests/port/usb_host.o
FAKE_ENGINE_OBJ := $(BUILD)/tests/port/fake_engine.o
PAIR_OBJ := $(BUILD)/tests/port/pair.o
PORT_TEST_OBJS := $(PORT_HOST_OBJ) $(USB_HOST_OBJ) $(FAKE_ENGINE_OBJ)
$(PAIR_OBJ) $(PORT_TEST_OBJS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools -Itests/stream $(CFLAGS) -MMD -MP \
		-c $< -o $@

-include $(PAIR_OBJ:.o=.d) $(PORT_TEST_OBJS:.o=.d)

BOARD_UNIT_TESTS := test_port_pci test_port_usb test_port_usb_reset test_board_model \
	test_board_usb_model

$(call unit,$(BOARD_UNIT_TESTS)): $(BUILD)/%: %.c \
		$(PORT_TEST_OBJS) $(BOARD_OBJECTS) $(STREAM_RANDOM_OBJS) $(MODEL_OBJS)
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools -Itests/unit -Itests/port -Itests/stream $(CFLAGS) \
		-MMD -MP -MF $@.d $(filter-out %.h,$^) -lcmocka -o $@

UNIT_TESTS += $(BOARD_UNIT_TESTS)
SANITIZED_TESTS += $(BOARD_UNIT_TESTS)

# The boards of the models against Verilated ones: of PCI one of each width of the port. A round has
# three batches of up to four jobs.
PORT_ROUNDS ?= 250
PORT_TEST_BOARDS := $(addprefix $(BUILD)/sim/accel-board-,t32-k1.so t64-k2.so t64-k8.so)
USB_ROUNDS ?= 130
USB_TEST_BOARDS := $(addprefix $(BUILD)/sim/accel-usb-,t32-k1.so t64-k2.so)

$(BUILD)/tests/port/test_boards: $(PORT_HOST_OBJ) $(BOARD_MODEL_OBJECTS)
$(BUILD)/tests/port/test_usb_boards: $(PORT_HOST_OBJ) $(USB_HOST_OBJ) $(BOARD_USB_MODEL_OBJECTS)

BOARD_TESTS := $(addprefix $(BUILD)/tests/port/,test_boards test_usb_boards)

$(BOARD_TESTS): $(BUILD)/%: %.c $(PAIR_OBJ) $(STREAM_RANDOM_OBJS) $(MODEL_OBJS)
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools -Itests/stream $(CFLAGS) -MMD -MP \
		-MF $@.d $(filter-out %.h,$^) -ldl -o $@

-include $(BOARD_TESTS:=.d)

.PHONY: check-port check-port-pci check-port-usb
check-port: check-port-pci check-port-usb ## the ports: models against RTL

check-port-pci: $(BUILD)/tests/port/test_boards $(PORT_TEST_BOARDS)
	$(Q)for board in $(PORT_TEST_BOARDS); do $< -n $(PORT_ROUNDS) $$board || exit 1; done

check-port-usb: $(BUILD)/tests/port/test_usb_boards $(USB_TEST_BOARDS)
	$(Q)for board in $(USB_TEST_BOARDS); do $< -n $(USB_ROUNDS) $$board || exit 1; done

CHECKS += check-port
