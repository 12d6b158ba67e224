# SPDX-License-Identifier: MIT
# The virtual boards: what stands in for a PCI board and for a USB board in a virtual machine.

VBOARD_SERVE_OBJECTS := $(addprefix $(BUILD)/tools/vboard/, load.o loop.o options.o serve.o)
VBOARD_OBJECTS := $(VBOARD_SERVE_OBJECTS) $(addprefix $(BUILD)/tools/vboard/pci/, config.o door.o \
	faults.o memory.o message.o options.o qtest.o)
VBOARD_USB_OBJECTS := $(VBOARD_SERVE_OBJECTS) $(addprefix $(BUILD)/tools/vboard/usb/, door.o \
	options.o bridge.o control.o descriptors.o faults.o queue.o refuse.o transfers.o)
VBOARD_MAIN := $(BUILD)/tools/vboard/pci/main.o
VBOARD_USB_MAIN := $(BUILD)/tools/vboard/usb/main.o
VBOARD_USB_LIBS := -lusbredirparser

# Without usbredir's parser there are no USB boards to test with, and everything else.
VBOARD_PROGRAMS := vboard-pci
ifeq ($(shell pkg-config --exists libusbredirparser-0.5 2>/dev/null && echo yes),yes)
VBOARD_PROGRAMS += vboard-usb
endif

include tools/vboard/board/board.mk

FLAGS_tools/vboard := -Idriver -pthread
FLAGS_tools/vboard/options.c := -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'
$(BUILD)/tools/vboard/options.o: VERSION

$(BUILD)/vboard-pci: private LIBS := $(ACCEL_LIBS)
$(BUILD)/vboard-pci: $(VBOARD_MAIN) $(VBOARD_OBJECTS) $(BOARD_MODEL_OBJECTS) $(BUILD)/libaccel/parts.a
	$(link)

$(BUILD)/vboard-usb: private LIBS := $(VBOARD_USB_LIBS) $(ACCEL_LIBS)
$(BUILD)/vboard-usb: $(VBOARD_USB_MAIN) $(VBOARD_USB_OBJECTS) $(BOARD_USB_MODEL_OBJECTS) \
		$(BUILD)/libaccel/parts.a
	$(link)

VBOARD_PLUGINS = $(BOARD_RTL_PLUGIN) $(USB_RTL_PLUGIN)

.PHONY: install-vboard
install-vboard: $(VBOARD_PROGRAMS:%=$(BUILD)/%) $(VBOARD_PLUGINS)
	$(call quiet,INSTALL,$(VBOARD_PROGRAMS))
	$(Q)for program in $(VBOARD_PROGRAMS); do \
		install -D -m 755 $(BUILD)/$$program $(DESTDIR)$(PREFIX)/bin/$$program && \
		install -D -m 644 tools/vboard/$${program#vboard-}/$$program.1 \
			$(DESTDIR)$(PREFIX)/share/man/man1/$$program.1 || exit 1; \
	done
	$(Q)install -D -m 755 -t $(DESTDIR)$(LIBDIR)/gloss $(VBOARD_PLUGINS)

INSTALLS += install-vboard

ALL += $(VBOARD_PROGRAMS:%=$(BUILD)/%)
