// SPDX-License-Identifier: MIT
#include "usb_plain.h"

#include <libusb.h>

#include "gloss_regs.h"
#include "vm_test.h"

enum {
	INTERFACE = 1,
	TRANSFERS = 4,
	TRANSFER_BYTES = 64 << 10,
	TIMEOUT_MS = 20000,
};

struct usb_plain {
	libusb_context *context;
	libusb_device_handle *handle;
	struct libusb_transfer *transfer[TRANSFERS];
	uint8_t data[TRANSFERS][TRANSFER_BYTES];
	size_t left; /* bytes that no transfer has been submitted for */
	int in_flight;
};

static void must(const char *what, int result)
{
	if (result < 0)
		vm_fail("%s: %s", what, libusb_error_name(result));
}

/* ---- finding ---- */

static int has_serial(libusb_device *device, const char *serial, libusb_device_handle **handle)
{
	struct libusb_device_descriptor descriptor;
	char text[128] = "";

	if (libusb_get_device_descriptor(device, &descriptor) ||
	    descriptor.idVendor != GLOSS_USB_VENDOR || descriptor.idProduct != GLOSS_USB_PRODUCT ||
	    libusb_open(device, handle))
		return 0;
	libusb_get_string_descriptor_ascii(*handle, descriptor.iSerialNumber, (unsigned char *)text,
					   sizeof(text));
	if (!strcmp(text, serial))
		return 1;
	libusb_close(*handle);
	return 0;
}

static void find(struct usb_plain *plain, const char *board)
{
	const char *serial = strchr(board, '/');
	libusb_device **list;
	ssize_t count, i;

	count = libusb_get_device_list(plain->context, &list);
	must("libusb_get_device_list", (int)count);
	for (i = 0; i < count; i++)
		if (serial && has_serial(list[i], serial + 1, &plain->handle))
			break;
	libusb_free_device_list(list, 1);
	if (i == count)
		vm_fail("%s is not there", board);
}

struct usb_plain *usb_plain_open(const char *board)
{
	struct usb_plain *plain = calloc(1, sizeof(*plain));

	if (!plain)
		vm_fail("out of memory");
	must("libusb_init", libusb_init(&plain->context));
	find(plain, board);
	must("libusb_claim_interface", libusb_claim_interface(plain->handle, INTERFACE));
	for (int n = 0; n < TRANSFERS; n++) {
		plain->transfer[n] = libusb_alloc_transfer(0);
		if (!plain->transfer[n])
			vm_fail("out of memory");
	}
	return plain;
}

void usb_plain_close(struct usb_plain *plain)
{
	for (int n = 0; n < TRANSFERS; n++)
		libusb_free_transfer(plain->transfer[n]);
	libusb_release_interface(plain->handle, INTERFACE);
	libusb_close(plain->handle);
	libusb_exit(plain->context);
	free(plain);
}

/* ---- moving ---- */

static void submit(struct usb_plain *plain, struct libusb_transfer *transfer)
{
	if (!plain->left)
		return;
	transfer->length = plain->left < TRANSFER_BYTES ? (int)plain->left : TRANSFER_BYTES;
	plain->left -= (size_t)transfer->length;
	plain->in_flight++;
	must("libusb_submit_transfer", libusb_submit_transfer(transfer));
}

static void LIBUSB_CALL ended(struct libusb_transfer *transfer)
{
	struct usb_plain *plain = transfer->user_data;

	plain->in_flight--;
	if (transfer->status != LIBUSB_TRANSFER_COMPLETED ||
	    transfer->actual_length != transfer->length)
		vm_fail("endpoint %#x: status %d, %d of %d bytes", transfer->endpoint,
			transfer->status, transfer->actual_length, transfer->length);
	submit(plain, transfer);
}

static double now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double usb_plain_move(struct usb_plain *plain, uint8_t endpoint, size_t bytes)
{
	double start = now();

	plain->left = bytes;
	for (int n = 0; n < TRANSFERS; n++) {
		libusb_fill_bulk_transfer(plain->transfer[n], plain->handle, endpoint,
					  plain->data[n], TRANSFER_BYTES, ended, plain, TIMEOUT_MS);
		submit(plain, plain->transfer[n]);
	}
	while (plain->in_flight)
		must("libusb_handle_events", libusb_handle_events(plain->context));
	return now() - start;
}
