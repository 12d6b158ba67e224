/* SPDX-License-Identifier: MIT */
/* Contexts, the devices that each sees, and who wants to know when one leaves. */
#include "fake_usb_priv.h"

#define HOTPLUGS 4

struct hotplug {
	struct libusb_context *context; /* NULL: free */
	int events;
	libusb_hotplug_callback_fn callback;
	void *data;
};

static struct libusb_context contexts[FAKE_CONTEXTS];
static struct libusb_device devices[FAKE_DEVICES];
static struct hotplug hotplugs[HOTPLUGS];

/* ---- contexts ---- */

struct libusb_context *fake_context_check(struct libusb_context *context, const char *function)
{
	if (!context)
		fake_violation("%s: the default context is other people's", function);
	if (!context->used)
		fake_violation("%s: the context is gone", function);
	return context;
}

int libusb_init(libusb_context **out)
{
	struct libusb_context *context = contexts;
	int err;

	fake_lock();
	err = fake_call(__func__);
	while (!err && context < contexts + FAKE_CONTEXTS && context->used)
		context++;
	if (context == contexts + FAKE_CONTEXTS)
		fake_violation("%s: too many contexts", __func__);
	if (!err) {
		*context = (struct libusb_context){ .used = true };
		*out = context;
		fake_usb.contexts++;
	}
	fake_unlock();
	return err;
}

void libusb_exit(libusb_context *context)
{
	fake_lock();
	fake_context_check(context, __func__);
	if (context->handled)
		fake_violation("%s: somebody handles events", __func__);
	for (struct libusb_device *device = devices; device < devices + FAKE_DEVICES; device++)
		if (device->references && device->context == context)
			fake_violation("%s: a device is still there", __func__);
	for (struct hotplug *hotplug = hotplugs; hotplug < hotplugs + HOTPLUGS; hotplug++)
		if (hotplug->context == context) {
			hotplug->context = NULL;
			fake_usb.hotplug_callbacks--;
		}
	context->used = false;
	fake_usb.contexts--;
	fake_unlock();
}

int libusb_set_option(libusb_context *context, enum libusb_option option, ...)
{
	int err;

	(void)option;
	fake_lock();
	err = fake_call(__func__);
	if (context)
		fake_context_check(context, __func__);
	fake_unlock();
	return err;
}

int libusb_has_capability(uint32_t capability)
{
	return capability == LIBUSB_CAP_HAS_CAPABILITY || capability == LIBUSB_CAP_HAS_HOTPLUG ||
	       capability == LIBUSB_CAP_SUPPORTS_DETACH_KERNEL_DRIVER;
}

const struct libusb_version *libusb_get_version(void)
{
	static const struct libusb_version version = { 1, 0, 26, 11724, "", "fake" };

	return &version;
}

/* ---- devices ---- */

struct libusb_device *fake_device_check(struct libusb_device *device, const char *function)
{
	if (device < devices || device >= devices + FAKE_DEVICES || !device->references)
		fake_violation("%s: the device is gone", function);
	return device;
}

bool fake_device_alive(const struct libusb_device *device)
{
	const struct fake_bridge *bridge = &fake.bridge[device->board];

	return bridge->present && bridge->plug == device->plug && !device->context->dead;
}

/* The device on the bus for @context, with a reference more. */
static struct libusb_device *device_get(struct libusb_context *context, unsigned int board)
{
	struct libusb_device *unused = NULL;

	for (struct libusb_device *device = devices; device < devices + FAKE_DEVICES; device++) {
		if (!device->references) {
			unused = unused ? unused : device;
		} else if (device->context == context && device->board == board &&
			   fake_device_alive(device)) {
			device->references++;
			return device;
		}
	}
	if (!unused)
		fake_violation("too many devices");
	*unused = (struct libusb_device){
		.references = 1, .context = context, .board = board, .plug = fake.bridge[board].plug
	};
	fake_usb.devices++;
	return unused;
}

void fake_device_put(struct libusb_device *device)
{
	if (!--device->references)
		fake_usb.devices--;
}

/* A test that set a board present has plugged it in. */
static void devices_scan(void)
{
	for (unsigned int n = 0; n < FAKE_USB_BOARDS; n++) {
		struct fake_bridge *bridge = &fake.bridge[n];

		if (fake_usb.board[n].present && !bridge->present)
			fake_bridge_plug(bridge, false);
		else if (!fake_usb.board[n].present && bridge->present)
			fake_bridge_unplug(bridge);
	}
}

/* A list with the NULL at its end. */
struct list {
	bool used;
	libusb_device *device[FAKE_USB_BOARDS + 1];
};

static struct list lists[FAKE_CONTEXTS];

static ssize_t list_fill(struct libusb_context *context, libusb_device **device)
{
	ssize_t count = 0;

	devices_scan();
	for (unsigned int n = 0; n < FAKE_USB_BOARDS && !context->dead; n++)
		if (fake.bridge[n].present)
			device[count++] = device_get(context, n);
	device[count] = NULL;
	return count;
}

ssize_t libusb_get_device_list(libusb_context *context, libusb_device ***out)
{
	struct list *list = lists;
	ssize_t count;

	fake_lock();
	fake_context_check(context, __func__);
	count = fake_call(__func__);
	while (list < lists + FAKE_CONTEXTS && list->used)
		list++;
	if (list == lists + FAKE_CONTEXTS)
		fake_violation("%s: too many lists", __func__);
	if (!count) {
		list->used = true;
		count = list_fill(context, list->device);
		*out = list->device;
		fake_usb.lists++;
	}
	fake_unlock();
	return count;
}

void libusb_free_device_list(libusb_device **device, int unref_devices)
{
	struct list *list = lists;

	if (!device)
		return;
	fake_lock();
	while (list < lists + FAKE_CONTEXTS && (list->device != device || !list->used))
		list++;
	if (list == lists + FAKE_CONTEXTS)
		fake_violation("%s: no such list", __func__);
	for (; *device && unref_devices; device++)
		fake_device_put(fake_device_check(*device, __func__));
	list->used = false;
	fake_usb.lists--;
	fake_unlock();
}

libusb_device *libusb_ref_device(libusb_device *device)
{
	fake_lock();
	fake_device_check(device, __func__)->references++;
	fake_unlock();
	return device;
}

void libusb_unref_device(libusb_device *device)
{
	if (!device)
		return;
	fake_lock();
	fake_device_put(fake_device_check(device, __func__));
	fake_unlock();
}

const struct fake_usb_board *fake_device_board(const struct libusb_device *device)
{
	return &fake_usb.board[device->board];
}

uint8_t libusb_get_bus_number(libusb_device *device)
{
	(void)device;
	return 1;
}

uint8_t libusb_get_device_address(libusb_device *device)
{
	return (uint8_t)(2 + device->board + 8 * device->plug % 120);
}

uint8_t libusb_get_port_number(libusb_device *device)
{
	return (uint8_t)(1 + device->board);
}

int libusb_get_port_numbers(libusb_device *device, uint8_t *numbers, int length)
{
	if (length < 1)
		return LIBUSB_ERROR_OVERFLOW;
	numbers[0] = libusb_get_port_number(device);
	return 1;
}

int libusb_get_device_speed(libusb_device *device)
{
	return fake_device_board(device)->speed;
}

int libusb_get_max_packet_size(libusb_device *device, unsigned char endpoint)
{
	const struct fake_usb_board *board = fake_device_board(device);

	for (unsigned int n = 0; n < board->endpoints; n++)
		if (board->endpoint[n].address == endpoint)
			return board->endpoint[n].packet_bytes;
	return LIBUSB_ERROR_NOT_FOUND;
}

void fake_device_kill(void)
{
	for (struct libusb_context *c = contexts; c < contexts + FAKE_CONTEXTS; c++)
		c->dead = c->used;
	for (unsigned int n = 0; n < FAKE_USB_BOARDS; n++)
		fake_transfer_end_all(&fake.bridge[n], NULL, LIBUSB_TRANSFER_NO_DEVICE);
}

/* ---- hotplug ---- */

static void hotplug_call(const struct hotplug *hotplug, struct libusb_device *device,
			 libusb_hotplug_event event)
{
	struct hotplug called = *hotplug;

	if (!(called.events & event))
		return;
	device->references++;
	fake_unlock();
	called.callback(called.context, device, event, called.data);
	fake_lock();
	fake_device_put(device);
}

bool fake_device_announce(struct libusb_context *context)
{
	bool any = false;

	for (struct libusb_device *d = devices; d < devices + FAKE_DEVICES; d++) {
		if (!d->references || d->context != context || d->announced || fake_device_alive(d))
			continue;
		d->announced = true;
		for (struct hotplug *h = hotplugs; h < hotplugs + HOTPLUGS; h++) {
			if (h->context != context)
				continue;
			any = true;
			hotplug_call(h, d, LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT);
		}
	}
	return any;
}

int libusb_hotplug_register_callback(libusb_context *context, int events, int flags, int vendor,
				     int product, int class, libusb_hotplug_callback_fn callback,
				     void *data, libusb_hotplug_callback_handle *out)
{
	int n = 0, err;

	(void)vendor;
	(void)product;
	(void)class;
	fake_lock();
	fake_context_check(context, __func__);
	err = fake_call(__func__);
	if (flags & LIBUSB_HOTPLUG_ENUMERATE)
		fake_violation("%s: this bus does not enumerate", __func__);
	while (!err && n < HOTPLUGS && hotplugs[n].context)
		n++;
	if (n == HOTPLUGS)
		fake_violation("%s: too many", __func__);
	if (!err) {
		hotplugs[n] = (struct hotplug){ context, events, callback, data };
		fake_usb.hotplug_callbacks++;
		if (out)
			*out = n + 1;
	}
	fake_unlock();
	return err;
}

void libusb_hotplug_deregister_callback(libusb_context *context,
					libusb_hotplug_callback_handle handle)
{
	fake_lock();
	fake_context_check(context, __func__);
	if (handle > 0 && handle <= HOTPLUGS && hotplugs[handle - 1].context == context) {
		hotplugs[handle - 1].context = NULL;
		fake_usb.hotplug_callbacks--;
	}
	fake_unlock();
}
