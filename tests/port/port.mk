# SPDX-License-Identifier: MIT
# Hosts for boards and an engine for ports, as the tests need them; and boards against each other.
##@ RTL against the model

PORT_HOST_OBJ := $(BUILD)/tests/port/port_host.o
USB_HOST_OBJ := $(BUILD)/tests/port/usb_host.o
PORT_TEST_OBJS := $(PORT_HOST_OBJ) $(USB_HOST_OBJ) $(BUILD)/tests/port/fake_engine.o

# The boards of the models against Verilated ones: of PCI one of each width of the port. A round has
# three batches of up to four jobs.
PORT_ROUNDS ?= 250
PORT_TEST_BOARDS := $(addprefix $(BUILD)/sim/accel-board-,t32-k1.so t64-k2.so t64-k8.so)
USB_ROUNDS ?= 130
USB_TEST_BOARDS := $(addprefix $(BUILD)/sim/accel-usb-,t32-k1.so t64-k2.so)

BOARD_TESTS := $(addprefix $(BUILD)/tests/port/,test_boards test_usb_boards)

$(BOARD_TESTS): private LIBS := -ldl
$(BOARD_TESTS): $(BUILD)/tests/port/pair.o $(PORT_HOST_OBJ) $(STREAM_RANDOM_OBJS) $(MODEL_OBJS)
$(BUILD)/tests/port/test_boards: $(BUILD)/tests/port/pci_jobs.o $(BOARD_MODEL_OBJECTS)
$(BUILD)/tests/port/test_usb_boards: $(BUILD)/tests/port/usb_jobs.o $(USB_HOST_OBJ) \
	$(BOARD_USB_MODEL_OBJECTS)

.PHONY: check-port check-port-pci check-port-usb
check-port: check-port-pci check-port-usb ## the ports: models against RTL

check-port-pci: $(BUILD)/tests/port/test_boards $(PORT_TEST_BOARDS)
	$(Q)for board in $(PORT_TEST_BOARDS); do $< -n $(PORT_ROUNDS) $$board || exit 1; done

check-port-usb: $(BUILD)/tests/port/test_usb_boards $(USB_TEST_BOARDS)
	$(Q)for board in $(USB_TEST_BOARDS); do $< -n $(USB_ROUNDS) $$board || exit 1; done

CHECKS += check-port
