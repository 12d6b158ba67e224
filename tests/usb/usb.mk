# SPDX-License-Identifier: MIT
# "usb:" on a libusb of our own, with boards on the C model: see tests/usb/fake_usb.h.

# A test that links FAKE_USB_OBJS and FAKE_USB_LDFLAGS leaves the real libusb out.
FAKE_USB_SOURCES := $(addprefix tests/usb/, fake_usb.c fake_usb_bridge.c fake_usb_channel.c \
	fake_usb_clock.c fake_usb_descriptor.c fake_usb_device.c fake_usb_handle.c fake_usb_sync.c \
	fake_usb_transfer.c)
FAKE_USB_OBJS := $(FAKE_USB_SOURCES:%.c=$(BUILD)/%.o) $(BOARD_USB_MODEL_OBJECTS)
FAKE_USB_CFLAGS := $(USB_CFLAGS) -Itools -Itests/usb -Itests/unit -Itests/stream
FAKE_USB_LDFLAGS := $(addprefix -Wl$(comma)--wrap=, clock_gettime pthread_cond_timedwait \
	pthread_cond_clockwait nanosleep usleep)

$(FAKE_USB_SOURCES:%.c=$(BUILD)/%.o): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(FAKE_USB_CFLAGS) $(CFLAGS) -pthread -MMD -MP -MF $@.d -c $< -o $@

USB_TRIAL_OBJ := $(BUILD)/tests/usb/usb_trial.o
$(USB_TRIAL_OBJ): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(FAKE_USB_CFLAGS) $(CFLAGS) -pthread -MMD -MP -MF $@.d -c $< -o $@

# Without libusb's header there is nothing to test.
ifneq ($(USB_LIBS),)
# Tests in tests/usb; those in tests/unit that want the fake are in USB_UNIT_TESTS.
USB_TESTS := test_fake_usb test_usb_errors test_usb_faults

$(call unit,test_usb_faults): $(USB_TRIAL_OBJ)
$(call unit,$(USB_TESTS) $(USB_UNIT_TESTS)): $(BUILD)/%: %.c $(FAKE_USB_OBJS) $(STREAM_RANDOM_OBJS) \
		$(BUILD)/libaccel/parts.a
	$(call quiet,CC,$(filter %.c,$^))
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(FAKE_USB_CFLAGS) $(CFLAGS) -pthread -MMD -MP -MF $@.d \
		$(filter %.c %.o,$^) $(filter %.a,$^) $(FAKE_USB_LDFLAGS) $(UNIT_LDFLAGS) -lcmocka \
		$(filter-out $(USB_LIBS),$(ACCEL_LIBS)) -o $@

# They run under ASan and UBSan, TSan and valgrind, too: the last two are slow and have a sample. Other
# points each time; USB_FAULTS=1000 make run-test_usb_faults for more.
run-test_usb_faults: export USB_FAULTS ?= 250
USB_FAULTS_SAMPLE ?= 40
USB_VALGRIND_TESTS := test_fake_usb test_usb_faults
ACCEL_UNIT_TESTS += $(USB_TESTS)
UNIT_TESTS += $(USB_TESTS)
VALGRIND_TESTS += $(USB_VALGRIND_TESTS)
unit-thread unit-valgrind: export USB_FAULTS ?= $(USB_FAULTS_SAMPLE)
unit-valgrind: $(call unit,$(USB_VALGRIND_TESTS))

# And a few on the Verilated board.
USB_FAULTS_RTL ?= 25
USB_FAULTS_BOARD := $(BUILD)/sim/accel-usb-t64-k8.so
.PHONY: usb-faults-rtl
usb-faults-rtl: $(call unit,test_usb_faults) $(USB_FAULTS_BOARD) ## faults of a USB cable, on the RTL
	$(Q)$< -n $(USB_FAULTS_RTL) -b $(USB_FAULTS_BOARD)

CHECKS += usb-faults-rtl

include tests/fuzz/fuzz_usb.mk
endif

-include $(FAKE_USB_OBJS:.o=.o.d) $(USB_TRIAL_OBJ).d
