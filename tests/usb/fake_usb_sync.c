/* SPDX-License-Identifier: MIT */
/*
 * Synchronous calls, which are a transfer and events handled until it has ended: so they may
 * call any callback, and wait for whoever handles events. And what errors are called.
 */
#include <string.h>

#include "fake_usb_priv.h"

static void completed_set(struct libusb_transfer *public)
{
	__atomic_store_n((int *)public->user_data, 1, __ATOMIC_RELEASE);
}

/* The answer that libusb gives for a transfer's end. */
static int status_error(enum libusb_transfer_status status)
{
	static const int error[] = {
		[LIBUSB_TRANSFER_COMPLETED] = 0,
		[LIBUSB_TRANSFER_ERROR] = LIBUSB_ERROR_IO,
		[LIBUSB_TRANSFER_TIMED_OUT] = LIBUSB_ERROR_TIMEOUT,
		[LIBUSB_TRANSFER_CANCELLED] = LIBUSB_ERROR_IO,
		[LIBUSB_TRANSFER_STALL] = LIBUSB_ERROR_PIPE,
		[LIBUSB_TRANSFER_NO_DEVICE] = LIBUSB_ERROR_NO_DEVICE,
		[LIBUSB_TRANSFER_OVERFLOW] = LIBUSB_ERROR_OVERFLOW,
	};

	return error[status];
}

/* With the lock held. */
static int run(struct libusb_transfer *public, const char *function)
{
	struct libusb_context *context = public->dev_handle->device->context;
	int completed = 0, err;

	if (context->handled && pthread_equal(context->handler, pthread_self()))
		return LIBUSB_ERROR_BUSY;
	public->callback = completed_set;
	/* cppcheck-suppress autoVariables; it is not looked at once this has returned */
	public->user_data = &completed;
	err = fake_transfer_submit(public, function);
	while (!err && !__atomic_load_n(&completed, __ATOMIC_ACQUIRE))
		err = fake_events(context, 60000000000ll, &completed);
	return err ? err : status_error(public->status);
}

int libusb_control_transfer(libusb_device_handle *handle, uint8_t type, uint8_t request,
			    uint16_t value, uint16_t index, unsigned char *data, uint16_t length,
			    unsigned int timeout)
{
	uint8_t buffer[LIBUSB_CONTROL_SETUP_SIZE + 256];
	struct libusb_transfer *public;
	int err, count = 0;

	if (length > sizeof(buffer) - LIBUSB_CONTROL_SETUP_SIZE)
		return LIBUSB_ERROR_INVALID_PARAM;
	libusb_fill_control_setup(buffer, type, request, value, index, length);
	if (!(type & LIBUSB_ENDPOINT_IN) && length)
		memcpy(buffer + LIBUSB_CONTROL_SETUP_SIZE, data, length);
	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err) {
		public = fake_transfer_new();
		libusb_fill_control_transfer(public, handle, buffer, NULL, NULL, timeout);
		err = run(public, __func__);
		count = public->actual_length;
		fake_transfer_delete(public);
	}
	fake_unlock();
	if (!err && (type & LIBUSB_ENDPOINT_IN) && count)
		memcpy(data, buffer + LIBUSB_CONTROL_SETUP_SIZE, (size_t)count);
	return err ? err : count;
}

static int bulk(libusb_device_handle *handle, unsigned char endpoint, unsigned char *data,
		int length, int *actual, unsigned int timeout, uint8_t type, const char *function)
{
	struct libusb_transfer *public;
	int err;

	fake_lock();
	fake_handle_check(handle, function);
	err = fake_call(function);
	if (!err) {
		public = fake_transfer_new();
		libusb_fill_bulk_transfer(public, handle, endpoint, data, length, NULL, NULL,
					  timeout);
		public->type = type;
		err = run(public, function);
		if (actual)
			*actual = public->actual_length;
		fake_transfer_delete(public);
	}
	fake_unlock();
	return err;
}

int libusb_bulk_transfer(libusb_device_handle *handle, unsigned char endpoint, unsigned char *data,
			 int length, int *actual, unsigned int timeout)
{
	return bulk(handle, endpoint, data, length, actual, timeout, LIBUSB_TRANSFER_TYPE_BULK,
		    __func__);
}

int libusb_interrupt_transfer(libusb_device_handle *handle, unsigned char endpoint,
			      unsigned char *data, int length, int *actual, unsigned int timeout)
{
	return bulk(handle, endpoint, data, length, actual, timeout, LIBUSB_TRANSFER_TYPE_INTERRUPT,
		    __func__);
}

/* ---- names ---- */

struct error_text {
	int error;
	const char *name, *text;
};

/* clang-format off */
#define ERROR(name, text) { LIBUSB_##name, "LIBUSB_" #name, text }
/* clang-format on */

static const struct error_text *error_find(int error)
{
	static const struct error_text texts[] = {
		ERROR(SUCCESS, "Success"),
		ERROR(ERROR_IO, "Input/Output Error"),
		ERROR(ERROR_INVALID_PARAM, "Invalid parameter"),
		ERROR(ERROR_ACCESS, "Access denied (insufficient permissions)"),
		ERROR(ERROR_NO_DEVICE, "No such device (it may have been disconnected)"),
		ERROR(ERROR_NOT_FOUND, "Entity not found"),
		ERROR(ERROR_BUSY, "Resource busy"),
		ERROR(ERROR_TIMEOUT, "Operation timed out"),
		ERROR(ERROR_OVERFLOW, "Overflow"),
		ERROR(ERROR_PIPE, "Pipe error"),
		ERROR(ERROR_INTERRUPTED, "System call interrupted (perhaps due to signal)"),
		ERROR(ERROR_NO_MEM, "Insufficient memory"),
		ERROR(ERROR_NOT_SUPPORTED,
		      "Operation not supported or unimplemented on this platform"),
	};
	static const struct error_text other = ERROR(ERROR_OTHER, "Other error");
#undef ERROR

	for (size_t n = 0; n < sizeof(texts) / sizeof(texts[0]); n++)
		if (texts[n].error == error)
			return &texts[n];
	return &other;
}

const char *libusb_error_name(int error)
{
	return error_find(error)->name;
}

const char *libusb_strerror(int error)
{
	return error_find(error)->text;
}
