# SPDX-License-Identifier: MIT
# The virtual boards: what stands in for a PCI board and for a USB board in a virtual machine.

VBOARD_SERVE_OBJECTS := $(addprefix $(BUILD)/tools/vboard/, load.o loop.o options.o serve.o)
VBOARD_OBJECTS := $(VBOARD_SERVE_OBJECTS) $(addprefix $(BUILD)/tools/vboard/pci/, config.o door.o \
	faults.o memory.o message.o options.o qtest.o)
VBOARD_USB_OBJECTS := $(VBOARD_SERVE_OBJECTS) $(addprefix $(BUILD)/tools/vboard/usb/, door.o \
	options.o bridge.o control.o descriptors.o faults.o queue.o refuse.o transfers.o)
VBOARD_MAIN := $(BUILD)/tools/vboard/pci/main.o
VBOARD_USB_MAIN := $(BUILD)/tools/vboard/usb/main.o
VBOARD_ALL := $(sort $(VBOARD_OBJECTS) $(VBOARD_USB_OBJECTS) $(VBOARD_MAIN) $(VBOARD_USB_MAIN))
VBOARD_USB_LIBS := -lusbredirparser

# Without usbredir's parser there are no USB boards to test with, and everything else.
VBOARD_PROGRAMS := vboard-pci
ifeq ($(shell pkg-config --exists libusbredirparser-0.5 2>/dev/null && echo yes),yes)
VBOARD_PROGRAMS += vboard-usb
endif

# The model of the port and the board (BOARD_MODEL_OBJECTS), and the Verilated board.
include $(wildcard tools/vboard/board/board.mk)

$(VBOARD_ALL): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools $(CFLAGS) -pthread -MMD -MP -c $< -o $@

$(BUILD)/tools/vboard/options.o: ACCEL_CFLAGS += -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'
$(BUILD)/tools/vboard/load.o: $(BUILD)/libaccel/sim_dir
$(BUILD)/tools/vboard/load.o: ACCEL_CFLAGS += -DACCEL_SIM_DIR='"$(ACCEL_SIM_DIR)"'

$(BUILD)/vboard-pci: $(VBOARD_MAIN) $(VBOARD_OBJECTS) $(BOARD_MODEL_OBJECTS) \
		$(BUILD)/libaccel/parts.a
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(ACCEL_LIBS) -o $@

$(BUILD)/vboard-usb: $(VBOARD_USB_MAIN) $(VBOARD_USB_OBJECTS) $(BOARD_USB_MODEL_OBJECTS) \
		$(BUILD)/libaccel/parts.a
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(VBOARD_USB_LIBS) $(ACCEL_LIBS) -o $@

-include $(VBOARD_ALL:.o=.d)

# Unit tests, of its files and of a board in its slot.
VBOARD_TESTS := test_vboard_config test_vboard_memory test_vboard_message test_vboard_faults \
	test_vboard_door test_vboard_qtest

$(call unit,$(VBOARD_TESTS)): $(BUILD)/%: %.c $(VBOARD_OBJECTS) \
		$(BOARD_MODEL_OBJECTS) $(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools -Itests/unit $(CFLAGS) -pthread -MMD -MP -MF $@.d \
		$(filter-out %.h,$^) $(UNIT_LDFLAGS) -lcmocka $(ACCEL_LIBS) -o $@

VBOARD_USB_TESTS := test_vboard_usb test_vboard_usb_bridge

$(call unit,$(VBOARD_USB_TESTS)): $(BUILD)/%: %.c \
		$(VBOARD_USB_OBJECTS) $(BOARD_USB_MODEL_OBJECTS) $(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Idriver -Itools -Itests/unit $(CFLAGS) -pthread -MMD -MP -MF $@.d \
		$(filter-out %.h,$^) $(UNIT_LDFLAGS) -lcmocka $(VBOARD_USB_LIBS) $(ACCEL_LIBS) -o $@

# Tests of what is late have a clock of their own, and those of what is waited for wait for ever.
$(call unit,test_vboard_faults test_vboard_usb_bridge): UNIT_LDFLAGS := -Wl,--wrap=clock_gettime
$(call unit,test_vboard_door test_vboard_qtest): UNIT_LDFLAGS := -Wl,--wrap=pthread_cond_clockwait

UNIT_TESTS += $(VBOARD_TESTS) $(VBOARD_USB_TESTS)

.PHONY: vboard vboard-sanitize install-vboard
vboard: $(BUILD)/vboard-pci $(BUILD)/vboard-usb ## messages and exit codes of vboard-pci and vboard-usb
	$(Q)tests/vboard/run $^

vboard-sanitize: ## tests of the virtual board under ASan, UBSan and TSan
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan CFLAGS='$(SANITIZED_CFLAGS)' \
		$(VBOARD_TESTS:%=run-%) $(VBOARD_USB_TESTS:%=run-%)
	$(Q)+TSAN_OPTIONS=halt_on_error=1 $(SANITIZED_MAKE) BUILD=$(BUILD)/tsan \
		CFLAGS='-O1 -g -fsanitize=thread' run-test_vboard_door run-test_vboard_qtest \
		run-test_vboard_usb

CHECKS += vboard vboard-sanitize

VBOARD_PLUGINS = $(BOARD_RTL_PLUGIN) $(USB_RTL_PLUGIN)

install-vboard: $(VBOARD_PROGRAMS:%=$(BUILD)/%) $(VBOARD_PLUGINS)
	$(call quiet,INSTALL,$(VBOARD_PROGRAMS))
	$(Q)for program in $(VBOARD_PROGRAMS); do \
		install -D -m 755 $(BUILD)/$$program $(DESTDIR)$(PREFIX)/bin/$$program && \
		install -D -m 644 tools/vboard/$${program#vboard-}/$$program.1 \
			$(DESTDIR)$(PREFIX)/share/man/man1/$$program.1 || exit 1; \
	done
	$(Q)install -D -m 755 -t $(DESTDIR)$(LIBDIR)/gloss $(VBOARD_PLUGINS)

INSTALLS += install-vboard

LINT_C += -Idriver
ALL += $(VBOARD_PROGRAMS:%=$(BUILD)/%)
