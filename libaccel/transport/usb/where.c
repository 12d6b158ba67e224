// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "gloss_regs.h"
#include "transport/usb/where.h"

#define PORTS_MAX 7 /* hubs behind one another, as USB allows */

/* ---- what a person writes ---- */

/* One to four hexadecimal digits; returns what follows, NULL without. */
static const char *where_number(const char *text, uint16_t *number)
{
	static const char digits[] = "0123456789abcdef0123456789ABCDEF";
	const char *start = text, *digit;

	*number = 0;
	while (*text && (digit = strchr(digits, *text)) && text - start < 4) {
		*number = (uint16_t)(*number << 4 | ((digit - digits) & 15));
		text++;
	}
	return text == start ? NULL : text;
}

/* NULL: there is something else. */
static const char *where_ids(const char *text, struct accel_usb_where *where)
{
	if (!*text || *text == '/')
		return text;
	text = where_number(text, &where->vendor);
	return text && *text == ':' ? where_number(text + 1, &where->product) : NULL;
}

/* Numbers, a dash after the first and dots between the others. */
static bool where_is_path(const char *text)
{
	static const char digits[] = "0123456789";
	size_t length = strspn(text, digits);

	if (!length || text[length] != '-')
		return false;
	do {
		text += length + 1;
		length = strspn(text, digits);
	} while (length && text[length] == '.');
	return length && !text[length];
}

int accel_usb_where_parse(const char *text, struct accel_usb_where *where,
			  struct accel_transport_error *error)
{
	*where = (struct accel_usb_where){ GLOSS_USB_VENDOR, GLOSS_USB_PRODUCT, NULL, NULL };
	if (where_is_path(text)) {
		where->path = text;
		return 0;
	}
	text = where_ids(text, where);
	if (text && !*text)
		return 0;
	if (text && text[0] == '/' && text[1]) {
		where->serial = text + 1;
		return 0;
	}
	accel_transport_say(error,
			    "name a board as in usb:%04x:%04x/SERIAL, usb:/SERIAL, usb:1-2 "
			    "(its bus and port) or usb:",
			    GLOSS_USB_VENDOR, GLOSS_USB_PRODUCT);
	return -EINVAL;
}

/* ---- what a board is called ---- */

void accel_usb_where_path(libusb_device *device, char path[USB_NAME_BYTES])
{
	uint8_t port[PORTS_MAX];
	int ports = libusb_get_port_numbers(device, port, PORTS_MAX);
	size_t length = 0;

	path[0] = '\0';
	for (int i = 0; i < ports; i++) {
		if (!i)
			length = (size_t)snprintf(path, USB_NAME_BYTES, "%u-%u",
						  libusb_get_bus_number(device), port[i]);
		else
			length += (size_t)snprintf(path + length, USB_NAME_BYTES - length, ".%u",
						   port[i]);
	}
}

void accel_usb_where_name(const struct libusb_device_descriptor *descriptor, const char *serial,
			  char name[USB_NAME_BYTES])
{
	snprintf(name, USB_NAME_BYTES, "usb:%04x:%04x%s%s", descriptor->idVendor,
		 descriptor->idProduct, *serial ? "/" : "", serial);
}

/* ---- what is on the bus ---- */

/* Whether a device of these ids at that place can be meant. */
static bool where_fits(const struct accel_usb_where *where, libusb_device *device,
		       const struct libusb_device_descriptor *descriptor)
{
	char path[USB_NAME_BYTES];

	if (!where->path)
		return descriptor->idVendor == where->vendor &&
		       descriptor->idProduct == where->product;
	accel_usb_where_path(device, path);
	return !strcmp(path, where->path);
}

static bool endpoint_is(const struct libusb_interface_descriptor *interface, unsigned int address,
			enum libusb_endpoint_transfer_type type)
{
	for (int i = 0; i < interface->bNumEndpoints; i++)
		if (interface->endpoint[i].bEndpointAddress == address)
			return (interface->endpoint[i].bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) ==
			       (int)type;
	return false;
}

static bool interface_is_ours(const struct libusb_interface_descriptor *interface)
{
	return interface->bInterfaceClass == LIBUSB_CLASS_VENDOR_SPEC &&
	       interface->bInterfaceSubClass == GLOSS_USB_SUBCLASS &&
	       interface->bInterfaceProtocol == GLOSS_USB_PROTOCOL &&
	       endpoint_is(interface, GLOSS_USB_ENDPOINT_OUT, LIBUSB_ENDPOINT_TRANSFER_TYPE_BULK) &&
	       endpoint_is(interface, GLOSS_USB_ENDPOINT_IN, LIBUSB_ENDPOINT_TRANSFER_TYPE_BULK) &&
	       endpoint_is(interface, GLOSS_USB_ENDPOINT_EVENT,
			   LIBUSB_ENDPOINT_TRANSFER_TYPE_INTERRUPT);
}

/* Asks descriptors alone, which the kernel has: a device is not opened to look at it. */
static bool device_is_ours(libusb_device *device, const struct accel_usb_where *where)
{
	struct libusb_device_descriptor descriptor;
	struct libusb_config_descriptor *config;
	bool ours;

	if (libusb_get_device_descriptor(device, &descriptor) ||
	    !where_fits(where, device, &descriptor) ||
	    libusb_get_active_config_descriptor(device, &config))
		return false;
	ours = config->bNumInterfaces > USB_INTERFACE &&
	       config->interface[USB_INTERFACE].num_altsetting > 0 &&
	       interface_is_ours(&config->interface[USB_INTERFACE].altsetting[0]);
	libusb_free_config_descriptor(config);
	return ours;
}

unsigned int accel_usb_where_place(libusb_device *device)
{
	return libusb_get_bus_number(device) << 8 | libusb_get_device_address(device);
}

libusb_device *accel_usb_where_next(libusb_device *const *list, const struct accel_usb_where *where,
				    unsigned int last)
{
	libusb_device *next = NULL;

	for (; *list; list++)
		if (accel_usb_where_place(*list) > last &&
		    (!next || accel_usb_where_place(*list) < accel_usb_where_place(next)) &&
		    device_is_ours(*list, where))
			next = *list;
	return next;
}
