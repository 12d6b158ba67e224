/* SPDX-License-Identifier: MIT */
/* Open devices, their interfaces and what is done to them at once. */
#include <string.h>

#include "fake_usb_priv.h"

static struct libusb_device_handle handles[FAKE_HANDLES];

void fake_handle_check(const struct libusb_device_handle *handle, const char *function)
{
	if (handle < handles || handle >= handles + FAKE_HANDLES || !handle->used)
		fake_violation("%s: the handle is closed", function);
}

struct fake_bridge *fake_handle_bridge(const struct libusb_device_handle *handle)
{
	return &fake.bridge[handle->device->board];
}

bool fake_handle_alive(const struct libusb_device_handle *handle)
{
	return fake_device_alive(handle->device);
}

int libusb_open(libusb_device *device, libusb_device_handle **out)
{
	struct libusb_device_handle *handle = handles;
	int err;

	fake_lock();
	fake_device_check(device, __func__);
	err = fake_call(__func__);
	if (!err && !fake_device_alive(device))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err)
		err = fake_device_board(device)->open_error;
	while (!err && handle < handles + FAKE_HANDLES && handle->used)
		handle++;
	if (handle == handles + FAKE_HANDLES)
		fake_violation("%s: too many handles", __func__);
	if (!err) {
		*handle = (struct libusb_device_handle){ .used = true, .device = device };
		device->references++;
		fake_usb.handles++;
		*out = handle;
	}
	fake_unlock();
	return err;
}

/* A handle of @board that has claimed @interface. */
static bool interface_taken(unsigned int board, int interface)
{
	if (interface == 0 &&
	    (fake_usb.board[board].foreign || fake_usb.board[board].kernel_driver))
		return true;
	for (struct libusb_device_handle *h = handles; h < handles + FAKE_HANDLES; h++)
		if (h->used && h->claimed[interface] && !h->lost[interface] &&
		    h->device->board == board && fake_handle_alive(h))
			return true;
	return false;
}

static void handle_release(struct libusb_device_handle *handle, int interface)
{
	for (struct fake_list *list = fake_handle_bridge(handle)->queue + FAKE_OUT;
	     list < fake_handle_bridge(handle)->queue + FAKE_QUEUES; list++)
		for (struct fake_transfer *t = list->first; t; t = t->next)
			if (t->handle == handle)
				fake_violation("an interface goes with transfers in flight");
	for (struct fake_transfer *t = fake.ended.first; t; t = t->next)
		if (t->handle == handle && t->queue != FAKE_CONTROL)
			fake_violation("an interface goes before a transfer's callback");
	if (handle->claimed[interface]) {
		handle->claimed[interface] = handle->lost[interface] = false;
		fake_usb.claims--;
	}
}

void fake_handle_use(struct libusb_device_handle *handle, unsigned int interface,
		     const char *function)
{
	if (!handle->claimed[interface])
		fake_violation("%s: interface %u is not claimed", function, interface);
	if (!handle->lost[interface] || interface_taken(handle->device->board, (int)interface))
		return;
	handle->lost[interface] = false;
	fake_usb.implicit_claims++;
}

void fake_handle_lose_claims(unsigned int board)
{
	for (struct libusb_device_handle *h = handles; h < handles + FAKE_HANDLES; h++)
		for (int n = 0; n < FAKE_INTERFACES; n++)
			if (h->used && h->device->board == board && h->claimed[n])
				h->lost[n] = true;
}

int libusb_kernel_driver_active(libusb_device_handle *handle, int interface)
{
	int err;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err)
		err = interface == 0 && fake_device_board(handle->device)->kernel_driver;
	fake_unlock();
	return err;
}

void libusb_close(libusb_device_handle *handle)
{
	if (!handle)
		return;
	fake_lock();
	fake_handle_check(handle, __func__);
	for (int n = 0; n < FAKE_INTERFACES; n++)
		handle_release(handle, n);
	fake_device_put(handle->device);
	handle->used = false;
	fake_usb.handles--;
	fake_unlock();
}

libusb_device *libusb_get_device(libusb_device_handle *handle)
{
	fake_handle_check(handle, __func__);
	return handle->device;
}

int libusb_claim_interface(libusb_device_handle *handle, int interface)
{
	int err;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err && (interface < 0 || interface >= FAKE_INTERFACES ||
		     interface >= fake_device_board(handle->device)->interfaces))
		err = LIBUSB_ERROR_NOT_FOUND;
	if (!err && !handle->claimed[interface]) {
		if (interface_taken(handle->device->board, interface)) {
			err = LIBUSB_ERROR_BUSY;
		} else {
			handle->claimed[interface] = true;
			fake_usb.claims++;
		}
	}
	fake_unlock();
	return err;
}

int libusb_release_interface(libusb_device_handle *handle, int interface)
{
	int err;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && (interface < 0 || interface >= FAKE_INTERFACES || !handle->claimed[interface]))
		err = LIBUSB_ERROR_NOT_FOUND;
	if (!err)
		handle_release(handle, interface);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	fake_unlock();
	return err;
}

int libusb_get_configuration(libusb_device_handle *handle, int *configuration)
{
	int err;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	*configuration = 1;
	fake_unlock();
	return err;
}

int libusb_set_auto_detach_kernel_driver(libusb_device_handle *handle, int enable)
{
	int err;

	(void)enable;
	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	fake_unlock();
	return err;
}

int libusb_clear_halt(libusb_device_handle *handle, unsigned char endpoint)
{
	struct fake_bridge *bridge;
	int err;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	bridge = fake_handle_bridge(handle);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err)
		fake_handle_use(handle, 0, __func__);
	if (!err)
		err = fake_bridge_request(bridge);
	if (!err)
		bridge->halted[endpoint == GLOSS_USB_ENDPOINT_OUT ? FAKE_OUT :
			       endpoint == GLOSS_USB_ENDPOINT_IN  ? FAKE_IN :
								    FAKE_EVENT] = false;
	pthread_cond_broadcast(&fake.changed);
	fake_unlock();
	return err;
}

int libusb_reset_device(libusb_device_handle *handle)
{
	static const enum libusb_transfer_status status[] = {
		LIBUSB_TRANSFER_ERROR,
		LIBUSB_TRANSFER_CANCELLED,
		LIBUSB_TRANSFER_NO_DEVICE,
	};
	struct fake_bridge *bridge;
	int err;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	bridge = fake_handle_bridge(handle);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err) {
		fake_transfer_end_all(bridge, handle, status[fake_below(3)]);
		memset(bridge->halted, 0, sizeof(bridge->halted));
	}
	fake_unlock();
	return err;
}
