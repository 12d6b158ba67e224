// SPDX-License-Identifier: MIT
#include "usb_cable.h"

#include <libusb.h>

#include "gloss_regs.h"
#include "vboard/usb/faults.h"
#include "vm_test.h"

enum {
	INTERFACE = 1,
	STEP_MS = 10,
};

struct usb_cable {
	libusb_context *context;
	libusb_device_handle *handle;
};

static bool has_serial(libusb_device *device, const char *serial, libusb_device_handle **handle)
{
	struct libusb_device_descriptor descriptor;
	char text[128] = "";

	if (libusb_get_device_descriptor(device, &descriptor) ||
	    descriptor.idVendor != GLOSS_USB_VENDOR || descriptor.idProduct != GLOSS_USB_PRODUCT ||
	    libusb_open(device, handle))
		return false;
	libusb_get_string_descriptor_ascii(*handle, descriptor.iSerialNumber, (unsigned char *)text,
					   sizeof(text));
	if (!strcmp(text, serial))
		return true;
	libusb_close(*handle);
	return false;
}

/* In a context of its own: without udev one does not learn of boards that come later. */
static bool find(struct usb_cable *cable, const char *serial)
{
	libusb_device **list;
	ssize_t count, i;
	int err = libusb_init(&cable->context);

	if (err)
		vm_fail("libusb_init: %s", libusb_error_name(err));
	count = libusb_get_device_list(cable->context, &list);
	for (i = 0; i < count; i++)
		if (has_serial(list[i], serial, &cable->handle))
			break;
	if (count >= 0)
		libusb_free_device_list(list, 1);
	if (count >= 0 && i < count)
		return true;
	libusb_exit(cable->context);
	return false;
}

struct usb_cable *usb_cable_open(const char *board)
{
	struct usb_cable *cable = calloc(1, sizeof(*cable));
	const char *serial = strchr(board, '/');
	int left = vm_patience_ms();

	if (!cable || !serial)
		vm_fail("%s: no serial number, or no memory", board);
	while (!find(cable, serial + 1)) {
		left -= STEP_MS;
		if (left < 0)
			vm_fail("%s is not there", board);
		usleep(STEP_MS * 1000);
	}
	return cable;
}

void usb_cable_close(struct usb_cable *cable)
{
	libusb_close(cable->handle);
	libusb_exit(cable->context);
	free(cable);
}

/* False: it is not there; the stack says so in several ways while it finds that out. */
static bool request(struct usb_cable *cable, uint8_t type, uint8_t number, uint32_t offset,
		    uint32_t *value)
{
	int got = libusb_control_transfer(cable->handle, type, number, (uint16_t)offset, INTERFACE,
					  (unsigned char *)value, sizeof(*value),
					  (unsigned int)vm_patience_ms());

	if (got == LIBUSB_ERROR_NO_DEVICE || got == LIBUSB_ERROR_IO)
		return false;
	if (got != sizeof(*value))
		vm_fail("fault window, offset %#x: %s", offset, libusb_error_name(got));
	return true;
}

bool usb_cable_arm(struct usb_cable *cable, uint32_t offset, uint32_t value)
{
	return request(cable, 0x41, GLOSS_USB_WRITE_REGISTER, offset, &value);
}

bool usb_cable_read(struct usb_cable *cable, uint32_t offset, uint32_t *value)
{
	return request(cable, 0xc1, GLOSS_USB_READ_REGISTER, offset, value);
}

bool usb_cable_disarm(struct usb_cable *cable)
{
	bool there = true;

	for (uint32_t at = VBOARD_USB_FAULT_UNPLUG; at <= VBOARD_USB_FAULT_REFUSE_CONTROL; at += 4)
		there = there && usb_cable_arm(cable, at, 0);
	return there;
}
