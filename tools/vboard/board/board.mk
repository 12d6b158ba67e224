# SPDX-License-Identifier: MIT
# The C models of the ports, and the boards that are made of them and the core's model.

BOARD_BASE_OBJECTS := $(addprefix $(BUILD)/tools/vboard/,port/base.o board/engine.o)
BOARD_MODEL_OBJECTS := $(BOARD_BASE_OBJECTS) \
	$(addprefix $(BUILD)/tools/vboard/,port/dma.o port/pci.o board/pci_model.o)
BOARD_USB_MODEL_OBJECTS := $(BOARD_BASE_OBJECTS) \
	$(addprefix $(BUILD)/tools/vboard/,port/usb.o board/usb_model.o)
