# SPDX-License-Identifier: MIT
# "usb:" on a libusb of our own, with boards on the C model: see tests/usb/fake_usb.h.
##@ RTL against the model

# A test that links FAKE_USB_OBJS, and wraps these names, leaves the real libusb out.
FAKE_USB_OBJS := $(addprefix $(BUILD)/tests/usb/, fake_usb.o fake_usb_bridge.o fake_usb_channel.o \
	fake_usb_clock.o fake_usb_descriptor.o fake_usb_device.o fake_usb_handle.o \
	fake_usb_idle.o fake_usb_sync.o \
	fake_usb_transfer.o) $(BOARD_USB_MODEL_OBJECTS)
FAKE_USB_WRAPPED := clock_gettime pthread_cond_timedwait pthread_cond_clockwait nanosleep usleep

FLAGS_tests/usb := $(USB_CFLAGS)

# Without libusb's header there is nothing to test.
ifneq ($(USB_LIBS),)
# Faults of a cable, a few on the Verilated board.
USB_FAULTS_RTL ?= 25
USB_FAULTS_BOARD := $(BUILD)/sim/accel-usb-t64-k8.so
.PHONY: usb-faults-rtl
usb-faults-rtl: $(BUILD)/tests/usb/test_usb_faults $(USB_FAULTS_BOARD) ## faults of a USB cable, on the RTL
	$(Q)$< -n $(USB_FAULTS_RTL) -b $(USB_FAULTS_BOARD)

CHECKS += usb-faults-rtl
endif
