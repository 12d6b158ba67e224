// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gloss_regs.h"
#include "transport/usb/node.h"

#define REQUEST_MS 1000

/* Beside libusb's errors, which are negative. */
#define ANOTHER_BOARD 1
#define KERNEL_DRIVER 2

/* ---- errors ---- */

int accel_usb_node_error(int err)
{
	if (err >= 0)
		return 0;
	return err == LIBUSB_ERROR_NO_DEVICE ? -ENODEV :
	       err == LIBUSB_ERROR_NO_MEM    ? -ENOMEM :
					       -EIO;
}

/* For a board that does not open. */
static int node_open_error(int err)
{
	switch (err) {
	case KERNEL_DRIVER:
		return -EBUSY;
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
	char path[USB_NAME_BYTES];

	switch (err) {
	case KERNEL_DRIVER:
		accel_usb_where_path(device, path);
		accel_transport_say(error,
				    "%s is held by a driver of the kernel; ls -l "
				    "/sys/bus/usb/devices/%s:*/driver shows which, and unbind in "
				    "there takes it away",
				    name, path);
		break;
	case LIBUSB_ERROR_ACCESS:
		accel_transport_say(error,
				    "not permitted: /dev/bus/usb/%03u/%03u; install "
				    "60-gloss.rules, as make install does, and plug the board in "
				    "again",
				    libusb_get_bus_number(device),
				    libusb_get_device_address(device));
		break;
	case LIBUSB_ERROR_BUSY:
		accel_transport_say(error, "%s is in use by another program", name);
		break;
	default:
		accel_transport_say(error, "%s: %s", name, libusb_strerror(err));
		break;
	}
	return node_open_error(err);
}

static int node_refuse_all(const struct accel_usb_where *where, struct accel_transport_error *error)
{
	if (where->path)
		accel_transport_say(error,
				    "there is no Gloss board at usb:%s; gloss-info --list "
				    "shows those that are there",
				    where->path);
	else if (where->serial)
		accel_transport_say(error,
				    "there is no board usb:%04x:%04x/%s; gloss-info --list "
				    "shows those that are there",
				    where->vendor, where->product, where->serial);
	else
		accel_transport_say(error,
				    "no Gloss board %04x:%04x on USB; lsusb shows what is "
				    "plugged in",
				    where->vendor, where->product);
	return -ENODEV;
}

/* ---- one board ---- */

/* Characters that a terminal does not print as such are replaced. */
static int node_read_serial(struct accel_usb_node *node,
			    const struct libusb_device_descriptor *descriptor)
{
	unsigned char *serial = (unsigned char *)node->serial;
	int length = 0;

	if (descriptor->iSerialNumber)
		length = libusb_get_string_descriptor_ascii(node->handle, descriptor->iSerialNumber,
							    serial, USB_SERIAL_BYTES - 1);
	for (int i = 0; i < length; i++)
		if (serial[i] < ' ' || serial[i] > '~')
			serial[i] = '?';
	serial[length > 0 ? length : 0] = '\0';
	return length < 0 ? length : 0;
}

/* The name that is known before the board is opened. */
static void node_set_name(struct accel_usb_node *node, libusb_device *device,
			  const struct accel_usb_where *where)
{
	struct libusb_device_descriptor descriptor = { .idVendor = where->vendor,
						       .idProduct = where->product };

	node->serial[0] = '\0';
	libusb_get_device_descriptor(device, &descriptor);
	if (where->path)
		snprintf(node->name, sizeof(node->name), "usb:%s", where->path);
	else
		accel_usb_where_name(&descriptor, "", node->name);
}

/* ANOTHER_BOARD: it is not the one that is meant. */
static int node_identify(struct accel_usb_node *node, const struct accel_usb_where *where)
{
	struct libusb_device_descriptor descriptor;
	int err = libusb_get_device_descriptor(libusb_get_device(node->handle), &descriptor);

	if (!err)
		err = node_read_serial(node, &descriptor);
	if (err)
		return where->serial ? err : 0;
	if (!where->path)
		accel_usb_where_name(&descriptor, node->serial, node->name);
	if (where->serial && strcmp(node->serial, where->serial) != 0)
		return ANOTHER_BOARD;
	return 0;
}

static int node_claim(libusb_device_handle *handle)
{
	int err = libusb_claim_interface(handle, USB_INTERFACE);

	if (err == LIBUSB_ERROR_BUSY && libusb_kernel_driver_active(handle, USB_INTERFACE) == 1)
		return KERNEL_DRIVER;
	return err;
}

/* As node_identify and node_claim. */
static int node_try(libusb_device *device, const struct accel_usb_where *where,
		    struct accel_usb_node *node)
{
	int err;

	node_set_name(node, device, where);
	err = libusb_open(device, &node->handle);
	if (err)
		return err;
	err = node_identify(node, where);
	if (!err)
		err = node_claim(node->handle);
	if (err)
		libusb_close(node->handle);
	return err;
}

/* ---- all of them ---- */

/* Of several boards the first that opens; if none does, the first says why. */
static int node_open_any(libusb_device *const *list, const struct accel_usb_where *where,
			 struct accel_usb_node *node, struct accel_transport_error *error)
{
	libusb_device *device;
	unsigned int last = 0;
	int err, first = 0;

	while ((device = accel_usb_where_next(list, where, last))) {
		err = node_try(device, where, node);
		if (!err)
			return 0;
		if (err != ANOTHER_BOARD && !first)
			first = node_refuse(device, node->name, err, error);
		last = accel_usb_where_place(device);
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

static int node_find(const struct accel_usb_where *where, struct accel_usb_node *node,
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
	struct accel_usb_where where;
	int err;

	node->stuck = false;
	err = accel_usb_where_parse(text, &where, error);
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
	libusb_release_interface(node->handle, USB_INTERFACE);
	libusb_close(node->handle);
	libusb_exit(node->context);
}

/* libusb does not know that the claim of a handle is lost, so another handle tries. */
int accel_usb_node_claim_again(struct accel_usb_node *node)
{
	libusb_device_handle *handle;
	int err = libusb_open(libusb_get_device(node->handle), &handle);

	if (err)
		return err == LIBUSB_ERROR_NO_DEVICE ? -ENODEV : 0;
	if (libusb_claim_interface(handle, USB_INTERFACE)) {
		libusb_close(handle);
		return 0;
	}
	libusb_close(node->handle);
	node->handle = handle;
	return 0;
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

/* A board that was found. */
struct listed {
	struct accel_usb_node node; /* of which only the name is of use */
	char path[USB_NAME_BYTES];
	struct accel_transport_error line;
};

/* Whether another program has it is not asked: that would be to take it. */
static void listed_fill(struct listed *board, libusb_device *device,
			const struct accel_usb_where *where)
{
	int err;

	accel_usb_where_path(device, board->path);
	node_set_name(&board->node, device, where);
	err = libusb_open(device, &board->node.handle);
	if (err) {
		node_refuse(device, board->node.name, err, &board->line);
		return;
	}
	node_identify(&board->node, where);
	libusb_close(board->node.handle);
	accel_transport_say(&board->line,
			    "Gloss USB board /dev/bus/usb/%03u/%03u, port %s, "
			    "%s speed",
			    libusb_get_bus_number(device), libusb_get_device_address(device),
			    *board->path ? board->path : "unknown", device_speed(device));
}

/* Of several with the same name each is called by its place. */
static bool listed_is_unique(const struct listed *board, const struct listed *boards, size_t count)
{
	for (size_t i = 0; i < count; i++)
		if (&boards[i] != board && !strcmp(boards[i].node.name, board->node.name))
			return false;
	return true;
}

static void list_tell(const struct listed *boards, size_t count, accel_device_list_fn found,
		      void *data)
{
	char name[USB_NAME_BYTES + sizeof("usb:")];

	for (size_t i = 0; i < count; i++) {
		const struct listed *board = &boards[i];

		if (listed_is_unique(board, boards, count) || !*board->path)
			snprintf(name, sizeof(name), "%s", board->node.name);
		else
			snprintf(name, sizeof(name), "usb:%s", board->path);
		found(data, name, board->line.text);
	}
}

static int list_all(libusb_device *const *list, size_t count, accel_device_list_fn found,
		    void *data)
{
	const struct accel_usb_where where = { GLOSS_USB_VENDOR, GLOSS_USB_PRODUCT, NULL, NULL };
	struct listed *boards = calloc(count + 1, sizeof(*boards));
	libusb_device *device;
	unsigned int last = 0;
	size_t boards_found = 0;

	if (!boards)
		return -ENOMEM;
	while (boards_found < count && (device = accel_usb_where_next(list, &where, last))) {
		listed_fill(&boards[boards_found++], device, &where);
		last = accel_usb_where_place(device);
	}
	list_tell(boards, boards_found, found, data);
	free(boards);
	return 0;
}

int accel_usb_node_list(accel_device_list_fn found, void *data)
{
	struct accel_transport_error error = { "" };
	libusb_context *context;
	libusb_device **list;
	ssize_t count;
	int err;

	err = node_context(&context, &error);
	if (err)
		return err == -ENOMEM ? err : 0;
	count = libusb_get_device_list(context, &list);
	if (count >= 0) {
		err = list_all(list, (size_t)count, found, data);
		libusb_free_device_list(list, 1);
	} else if (count == LIBUSB_ERROR_NO_MEM) {
		err = -ENOMEM;
	}
	libusb_exit(context);
	return err;
}

/* ---- registers ---- */

static int node_request(struct accel_usb_node *node, uint8_t direction, uint8_t request,
			uint16_t offset, uint32_t *value)
{
	const uint8_t type = direction | LIBUSB_REQUEST_TYPE_VENDOR | LIBUSB_RECIPIENT_INTERFACE;
	int length;

	length = libusb_control_transfer(node->handle, type, request, offset, USB_INTERFACE,
					 (unsigned char *)value, sizeof(*value), REQUEST_MS);
	if (length == sizeof(*value))
		return 0;
	return length < 0 ? accel_usb_node_error(length) : -EIO;
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
