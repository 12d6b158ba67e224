// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "gloss_regs.h"
#include "usb_node.h"

#define INTERFACE 0
#define REQUEST_MS 1000
#define SERIAL_BYTES 128		/* a string of a descriptor has at most 126 characters */
#define ANOTHER_BOARD 1			/* beside libusb's errors, which are negative */

/* ---- names ---- */

struct usb_where {
	uint16_t vendor, product;
	const char *serial;		/* NULL: any */
};

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
static const char *where_ids(const char *text, struct usb_where *where)
{
	if (!*text || *text == '/')
		return text;
	text = where_number(text, &where->vendor);
	return text && *text == ':' ? where_number(text + 1, &where->product) : NULL;
}

static int where_parse(const char *text, struct usb_where *where,
		       struct accel_transport_error *error)
{
	*where = (struct usb_where){ GLOSS_USB_VENDOR, GLOSS_USB_PRODUCT, NULL };
	text = where_ids(text, where);
	if (text && !*text)
		return 0;
	if (text && text[0] == '/' && text[1]) {
		where->serial = text + 1;
		return 0;
	}
	accel_transport_say(error, "name a board as in usb:%04x:%04x/SERIAL, usb:/SERIAL or usb:",
			    GLOSS_USB_VENDOR, GLOSS_USB_PRODUCT);
	return -EINVAL;
}

const char *accel_usb_node_serial(const struct accel_usb_node *node)
{
	const char *slash = strchr(node->name, '/');

	return slash ? slash + 1 : "";
}

/* ---- errors ---- */

static int node_error(int err)
{
	switch (err) {
	case LIBUSB_ERROR_NO_MEM:
		return -ENOMEM;
	case LIBUSB_ERROR_ACCESS:
		return -EACCES;
	case LIBUSB_ERROR_BUSY:
		return -EBUSY;
	default:
		return -ENODEV;
	}
}

static int node_refuse(libusb_device *device, const char *name, int err,
		       struct accel_transport_error *error)
{
	switch (err) {
	case LIBUSB_ERROR_ACCESS:
		accel_transport_say(error, "not permitted: /dev/bus/usb/%03u/%03u; install "
				    "60-gloss.rules, as make install does, and plug the board in "
				    "again", libusb_get_bus_number(device),
				    libusb_get_device_address(device));
		break;
	case LIBUSB_ERROR_BUSY:
		accel_transport_say(error, "%s is in use by another program", name);
		break;
	default:
		accel_transport_say(error, "%s: %s", name, libusb_strerror(err));
		break;
	}
	return node_error(err);
}

static int node_refuse_all(const struct usb_where *where, struct accel_transport_error *error)
{
	if (where->serial)
		accel_transport_say(error, "there is no board usb:%04x:%04x/%s; gloss-info --list "
				    "shows those that are there", where->vendor, where->product,
				    where->serial);
	else
		accel_transport_say(error, "no Gloss board %04x:%04x on USB; lsusb shows what is "
				    "plugged in", where->vendor, where->product);
	return -ENODEV;
}

/* ---- what is on the bus ---- */

static bool endpoint_is(const struct libusb_interface_descriptor *interface, unsigned int address,
			enum libusb_endpoint_transfer_type type)
{
	int i;

	for (i = 0; i < interface->bNumEndpoints; i++)
		if (interface->endpoint[i].bEndpointAddress == address)
			return (interface->endpoint[i].bmAttributes &
				LIBUSB_TRANSFER_TYPE_MASK) == (int)type;
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
static bool device_is_ours(libusb_device *device, const struct usb_where *where)
{
	struct libusb_device_descriptor descriptor;
	struct libusb_config_descriptor *config;
	bool ours;

	if (libusb_get_device_descriptor(device, &descriptor) ||
	    descriptor.idVendor != where->vendor || descriptor.idProduct != where->product ||
	    libusb_get_active_config_descriptor(device, &config))
		return false;
	ours = config->bNumInterfaces > INTERFACE &&
	       config->interface[INTERFACE].num_altsetting > 0 &&
	       interface_is_ours(&config->interface[INTERFACE].altsetting[0]);
	libusb_free_config_descriptor(config);
	return ours;
}

/* By bus and address, as lsusb has them. */
static unsigned int device_place(libusb_device *device)
{
	return libusb_get_bus_number(device) << 8 | libusb_get_device_address(device);
}

/* The board that comes next after place @last; NULL: there is none. */
static libusb_device *device_next(libusb_device *const *list, const struct usb_where *where,
				  unsigned int last)
{
	libusb_device *next = NULL;

	for (; *list; list++)
		if (device_place(*list) > last &&
		    (!next || device_place(*list) < device_place(next)) &&
		    device_is_ours(*list, where))
			next = *list;
	return next;
}

/* ---- one board ---- */

/* Characters that a terminal does not print as such are replaced. */
static int node_read_serial(libusb_device_handle *handle, char *serial)
{
	struct libusb_device_descriptor descriptor;
	int i, length = 0;

	if (libusb_get_device_descriptor(libusb_get_device(handle), &descriptor) ||
	    !descriptor.iSerialNumber)
		length = 0;
	else
		length = libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber,
							    (unsigned char *)serial,
							    SERIAL_BYTES - 1);
	for (i = 0; i < length; i++)
		if (serial[i] < ' ' || serial[i] > '~')
			serial[i] = '?';
	serial[length > 0 ? length : 0] = '\0';
	return length < 0 ? length : 0;
}

static void node_set_name(struct accel_usb_node *node, const struct usb_where *where,
			  const char *serial)
{
	snprintf(node->name, sizeof(node->name), "usb:%04x:%04x%s%s", where->vendor,
		 where->product, *serial ? "/" : "", serial);
}

/* ANOTHER_BOARD: it is not the one that is meant. */
static int node_identify(struct accel_usb_node *node, const struct usb_where *where)
{
	char serial[SERIAL_BYTES];
	int err = node_read_serial(node->handle, serial);

	if (err && where->serial)
		return err;
	node_set_name(node, where, serial);
	if (where->serial && strcmp(serial, where->serial) != 0)
		return ANOTHER_BOARD;
	return 0;
}

/* As node_identify. */
static int node_try(libusb_device *device, const struct usb_where *where,
		    struct accel_usb_node *node)
{
	int err;

	node_set_name(node, where, "");
	err = libusb_open(device, &node->handle);
	if (err)
		return err;
	err = node_identify(node, where);
	if (!err)
		err = libusb_claim_interface(node->handle, INTERFACE);
	if (err)
		libusb_close(node->handle);
	return err;
}

/* ---- all of them ---- */

/* Of several boards the first that opens; if none does, the first says why. */
static int node_open_any(libusb_device *const *list, const struct usb_where *where,
			 struct accel_usb_node *node, struct accel_transport_error *error)
{
	libusb_device *device;
	unsigned int last = 0;
	int err, first = 0;

	while ((device = device_next(list, where, last))) {
		err = node_try(device, where, node);
		if (!err)
			return 0;
		if (err != ANOTHER_BOARD && !first)
			first = node_refuse(device, node->name, err, error);
		last = device_place(device);
	}
	return first ? first : node_refuse_all(where, error);
}

static int node_context(libusb_context **context, struct accel_transport_error *error)
{
	int err = libusb_init(context);

	if (!err)
		return 0;
	accel_transport_say(error, "USB can not be used here: %s", libusb_strerror(err));
	return err == LIBUSB_ERROR_NO_MEM ? -ENOMEM : -ENODEV;
}

static int node_find(const struct usb_where *where, struct accel_usb_node *node,
		     struct accel_transport_error *error)
{
	libusb_device **list;
	ssize_t count;
	int err;

	count = libusb_get_device_list(node->context, &list);
	if (count < 0) {
		accel_transport_say(error, "USB can not be looked at: %s",
				    libusb_strerror((int)count));
		return count == LIBUSB_ERROR_NO_MEM ? -ENOMEM : -ENODEV;
	}
	err = node_open_any(list, where, node, error);
	libusb_free_device_list(list, 1);
	return err;
}

int accel_usb_node_open(const char *text, struct accel_usb_node *node,
			struct accel_transport_error *error)
{
	struct usb_where where;
	int err;

	err = where_parse(text, &where, error);
	if (err)
		return err;
	err = node_context(&node->context, error);
	if (err)
		return err;
	err = node_find(&where, node, error);
	if (err)
		libusb_exit(node->context);
	return err;
}

void accel_usb_node_close(struct accel_usb_node *node)
{
	libusb_release_interface(node->handle, INTERFACE);
	libusb_close(node->handle);
	libusb_exit(node->context);
}

/* ---- listing ---- */

static const char *device_speed(libusb_device *device)
{
	switch (libusb_get_device_speed(device)) {
	case LIBUSB_SPEED_FULL:
		return "full";
	case LIBUSB_SPEED_HIGH:
		return "high";
	case LIBUSB_SPEED_SUPER:
	case LIBUSB_SPEED_SUPER_PLUS:
		return "super";
	default:
		return "unknown";
	}
}

/* Whether another program has it is not asked: that would be to take it. */
static void node_list_one(libusb_device *device, const struct usb_where *where,
			  accel_device_list_fn found, void *data)
{
	struct accel_transport_error error = { "" };
	struct accel_usb_node node = { .context = NULL };
	int err;

	node_set_name(&node, where, "");
	err = libusb_open(device, &node.handle);
	if (!err) {
		node_identify(&node, where);
		libusb_close(node.handle);
		accel_transport_say(&error, "Gloss USB board /dev/bus/usb/%03u/%03u, %s speed",
				    libusb_get_bus_number(device),
				    libusb_get_device_address(device), device_speed(device));
	} else {
		node_refuse(device, node.name, err, &error);
	}
	found(data, node.name, error.text);
}

int accel_usb_node_list(accel_device_list_fn found, void *data)
{
	const struct usb_where where = { GLOSS_USB_VENDOR, GLOSS_USB_PRODUCT, NULL };
	struct accel_transport_error error = { "" };
	libusb_device **list, *device;
	libusb_context *context;
	unsigned int last = 0;
	ssize_t count;
	int err;

	err = node_context(&context, &error);
	if (err)
		return err == -ENOMEM ? err : 0;
	count = libusb_get_device_list(context, &list);
	if (count >= 0) {
		while ((device = device_next(list, &where, last))) {
			node_list_one(device, &where, found, data);
			last = device_place(device);
		}
		libusb_free_device_list(list, 1);
	}
	libusb_exit(context);
	return count == LIBUSB_ERROR_NO_MEM ? -ENOMEM : 0;
}

/* ---- registers ---- */

static int node_request(struct accel_usb_node *node, uint8_t direction, uint8_t request,
			uint16_t offset, uint32_t *value)
{
	const uint8_t type = direction | LIBUSB_REQUEST_TYPE_VENDOR | LIBUSB_RECIPIENT_INTERFACE;
	int length;

	length = libusb_control_transfer(node->handle, type, request, offset, INTERFACE,
					 (unsigned char *)value, sizeof(*value), REQUEST_MS);
	if (length == sizeof(*value))
		return 0;
	return length == LIBUSB_ERROR_NO_DEVICE ? -ENODEV : -EIO;
}

int accel_usb_node_read(struct accel_usb_node *node, uint16_t offset, uint32_t *value)
{
	*value = 0;
	return node_request(node, LIBUSB_ENDPOINT_IN, GLOSS_USB_READ_REGISTER, offset, value);
}

int accel_usb_node_write(struct accel_usb_node *node, uint16_t offset, uint32_t value)
{
	return node_request(node, LIBUSB_ENDPOINT_OUT, GLOSS_USB_WRITE_REGISTER, offset, &value);
}
