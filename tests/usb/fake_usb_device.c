/* SPDX-License-Identifier: MIT */
/* Contexts, devices, descriptors and handles. */
#include <string.h>

#include "fake_usb_priv.h"

#define CONFIGURATIONS 8
#define HOTPLUGS 4

/* What is behind one pointer of libusb_get_active_config_descriptor. */
struct configuration {
	bool used;
	struct libusb_config_descriptor config;
	struct libusb_interface interface[FAKE_INTERFACES];
	struct libusb_interface_descriptor setting[FAKE_INTERFACES];
	struct libusb_endpoint_descriptor endpoint[FAKE_USB_ENDPOINTS];
};

struct hotplug {
	struct libusb_context *context;		/* NULL: free */
	int events;
	libusb_hotplug_callback_fn callback;
	void *data;
};

static struct libusb_context contexts[FAKE_CONTEXTS];
static struct libusb_device devices[FAKE_DEVICES];
static struct libusb_device_handle handles[FAKE_HANDLES];
static struct configuration configurations[CONFIGURATIONS];
static struct hotplug hotplugs[HOTPLUGS];

static void lock(void)
{
	pthread_mutex_lock(&fake.lock);
}

static void unlock(void)
{
	pthread_mutex_unlock(&fake.lock);
}

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

	lock();
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
	unlock();
	return err;
}

void libusb_exit(libusb_context *context)
{
	lock();
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
	unlock();
}

int libusb_set_option(libusb_context *context, enum libusb_option option, ...)
{
	int err;

	(void)option;
	lock();
	err = fake_call(__func__);
	if (context)
		fake_context_check(context, __func__);
	unlock();
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

static struct libusb_device *device_check(struct libusb_device *device, const char *function)
{
	if (device < devices || device >= devices + FAKE_DEVICES || !device->references)
		fake_violation("%s: the device is gone", function);
	return device;
}

static bool device_alive(const struct libusb_device *device)
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
			   device_alive(device)) {
			device->references++;
			return device;
		}
	}
	if (!unused)
		fake_violation("too many devices");
	*unused = (struct libusb_device){ .references = 1, .context = context, .board = board,
					  .plug = fake.bridge[board].plug };
	fake_usb.devices++;
	return unused;
}

static void device_put(struct libusb_device *device)
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

ssize_t libusb_get_device_list(libusb_context *context, libusb_device ***out)
{
	static libusb_device *list[FAKE_CONTEXTS][FAKE_USB_BOARDS + 1];
	unsigned int slot = 0;
	ssize_t count = 0;

	lock();
	fake_context_check(context, __func__);
	count = fake_call(__func__);
	if (!count) {
		devices_scan();
		while (slot < FAKE_CONTEXTS && list[slot][FAKE_USB_BOARDS])
			slot++;
		if (slot == FAKE_CONTEXTS)
			fake_violation("%s: too many lists", __func__);
		for (unsigned int n = 0; n < FAKE_USB_BOARDS && !context->dead; n++)
			if (fake.bridge[n].present)
				list[slot][count++] = device_get(context, n);
		list[slot][count] = NULL;
		/* Its last entry is there for this, never an entry of a board. */
		list[slot][FAKE_USB_BOARDS] = (void *)list;
		*out = list[slot];
		fake_usb.lists++;
	}
	unlock();
	return count;
}

void libusb_free_device_list(libusb_device **list, int unref_devices)
{
	if (!list)
		return;
	lock();
	if (!list[FAKE_USB_BOARDS])
		fake_violation("%s: no such list", __func__);
	for (unsigned int n = 0; n < FAKE_USB_BOARDS && list[n] && unref_devices; n++)
		device_put(device_check(list[n], __func__));
	list[FAKE_USB_BOARDS] = NULL;
	fake_usb.lists--;
	unlock();
}

libusb_device *libusb_ref_device(libusb_device *device)
{
	lock();
	device_check(device, __func__)->references++;
	unlock();
	return device;
}

void libusb_unref_device(libusb_device *device)
{
	if (!device)
		return;
	lock();
	device_put(device_check(device, __func__));
	unlock();
}

static const struct fake_usb_board *device_board(const struct libusb_device *device)
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
	return device_board(device)->speed;
}

int libusb_get_max_packet_size(libusb_device *device, unsigned char endpoint)
{
	const struct fake_usb_board *board = device_board(device);

	for (unsigned int n = 0; n < board->endpoints; n++)
		if (board->endpoint[n].address == endpoint)
			return board->endpoint[n].packet_bytes;
	return LIBUSB_ERROR_NOT_FOUND;
}

/* ---- descriptors ---- */

/* Texts have the numbers 1 to 3; 0: there is none. */
static const char *board_text(const struct fake_usb_board *board, unsigned int index)
{
	const char *const text[] = { NULL, board->manufacturer_text, board->product_text,
				     board->serial };

	return index < 4 ? text[index] : NULL;
}

static uint8_t board_text_index(const struct fake_usb_board *board, uint8_t index)
{
	return board_text(board, index) ? index : 0;
}

int libusb_get_device_descriptor(libusb_device *device, struct libusb_device_descriptor *out)
{
	const struct fake_usb_board *board;
	int err;

	lock();
	board = device_board(device_check(device, __func__));
	err = fake_call(__func__);
	if (!err)
		*out = (struct libusb_device_descriptor){
			.bLength = LIBUSB_DT_DEVICE_SIZE,
			.bDescriptorType = LIBUSB_DT_DEVICE,
			.bcdUSB = board->speed >= LIBUSB_SPEED_SUPER ? 0x0300 : 0x0200,
			.bMaxPacketSize0 = board->speed >= LIBUSB_SPEED_SUPER ? 9 : 64,
			.idVendor = board->vendor,
			.idProduct = board->product,
			.bcdDevice = 0x0100,
			.iManufacturer = board_text_index(board, 1),
			.iProduct = board_text_index(board, 2),
			.iSerialNumber = board_text_index(board, 3),
			.bNumConfigurations = 1,
		};
	unlock();
	return err;
}

static void configuration_fill(struct configuration *c, const struct fake_usb_board *board)
{
	unsigned int interfaces = board->interfaces < FAKE_INTERFACES ? board->interfaces :
									FAKE_INTERFACES;

	*c = (struct configuration){ .used = true };
	c->config = (struct libusb_config_descriptor){
		.bLength = LIBUSB_DT_CONFIG_SIZE,
		.bDescriptorType = LIBUSB_DT_CONFIG,
		.bNumInterfaces = (uint8_t)interfaces,
		.bConfigurationValue = 1,
		.interface = c->interface,
	};
	for (unsigned int n = 0; n < board->endpoints; n++)
		c->endpoint[n] = (struct libusb_endpoint_descriptor){
			.bLength = LIBUSB_DT_ENDPOINT_SIZE,
			.bDescriptorType = LIBUSB_DT_ENDPOINT,
			.bEndpointAddress = board->endpoint[n].address,
			.bmAttributes = board->endpoint[n].attributes,
			.wMaxPacketSize = board->endpoint[n].packet_bytes,
		};
	for (unsigned int n = 0; n < interfaces; n++) {
		c->setting[n] = (struct libusb_interface_descriptor){
			.bLength = LIBUSB_DT_INTERFACE_SIZE,
			.bDescriptorType = LIBUSB_DT_INTERFACE,
			.bInterfaceNumber = (uint8_t)n,
			.bNumEndpoints = n ? 0 : board->endpoints,
			.bInterfaceClass = board->interface_class,
			.bInterfaceSubClass = (uint8_t)(board->interface_subclass - n),
			.bInterfaceProtocol = board->interface_protocol,
			.endpoint = n || !board->endpoints ? NULL : c->endpoint,
		};
		c->interface[n] = (struct libusb_interface){ &c->setting[n], 1 };
	}
}

int libusb_get_active_config_descriptor(libusb_device *device,
					struct libusb_config_descriptor **out)
{
	struct configuration *c = configurations;
	int err;

	lock();
	device_check(device, __func__);
	err = fake_call(__func__);
	while (!err && c < configurations + CONFIGURATIONS && c->used)
		c++;
	if (c == configurations + CONFIGURATIONS)
		fake_violation("%s: too many", __func__);
	if (!err) {
		configuration_fill(c, device_board(device));
		*out = &c->config;
		fake_usb.configurations++;
	}
	unlock();
	return err;
}

int libusb_get_config_descriptor(libusb_device *device, uint8_t index,
				 struct libusb_config_descriptor **out)
{
	return index ? LIBUSB_ERROR_NOT_FOUND : libusb_get_active_config_descriptor(device, out);
}

void libusb_free_config_descriptor(struct libusb_config_descriptor *config)
{
	if (!config)
		return;
	lock();
	for (struct configuration *c = configurations; c < configurations + CONFIGURATIONS; c++) {
		if (&c->config != config)
			continue;
		if (!c->used)
			fake_violation("%s: it is gone", __func__);
		memset(c, 0x5a, sizeof(*c));
		c->used = false;
		fake_usb.configurations--;
	}
	unlock();
}

/* ---- handles ---- */

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
	return !handle->dead && device_alive(handle->device);
}

int libusb_open(libusb_device *device, libusb_device_handle **out)
{
	struct libusb_device_handle *handle = handles;
	int err;

	lock();
	device_check(device, __func__);
	err = fake_call(__func__);
	if (!err && !device_alive(device))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err)
		err = device_board(device)->open_error;
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
	unlock();
	return err;
}

/* A handle of @board that has claimed @interface. */
static bool interface_taken(unsigned int board, int interface)
{
	if (interface == 0 && fake_usb.board[board].foreign)
		return true;
	for (struct libusb_device_handle *h = handles; h < handles + FAKE_HANDLES; h++)
		if (h->used && h->claimed[interface] && h->device->board == board &&
		    fake_handle_alive(h))
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
		handle->claimed[interface] = false;
		fake_usb.claims--;
	}
}

void libusb_close(libusb_device_handle *handle)
{
	if (!handle)
		return;
	lock();
	fake_handle_check(handle, __func__);
	for (int n = 0; n < FAKE_INTERFACES; n++)
		handle_release(handle, n);
	device_put(handle->device);
	handle->used = false;
	fake_usb.handles--;
	unlock();
}

libusb_device *libusb_get_device(libusb_device_handle *handle)
{
	fake_handle_check(handle, __func__);
	return handle->device;
}

int libusb_claim_interface(libusb_device_handle *handle, int interface)
{
	int err;

	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err && (interface < 0 || interface >= FAKE_INTERFACES ||
		     interface >= device_board(handle->device)->interfaces))
		err = LIBUSB_ERROR_NOT_FOUND;
	if (!err && !handle->claimed[interface]) {
		if (interface_taken(handle->device->board, interface)) {
			err = LIBUSB_ERROR_BUSY;
		} else {
			handle->claimed[interface] = true;
			fake_usb.claims++;
		}
	}
	unlock();
	return err;
}

int libusb_release_interface(libusb_device_handle *handle, int interface)
{
	int err;

	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && (interface < 0 || interface >= FAKE_INTERFACES || !handle->claimed[interface]))
		err = LIBUSB_ERROR_NOT_FOUND;
	if (!err)
		handle_release(handle, interface);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	unlock();
	return err;
}

int libusb_get_configuration(libusb_device_handle *handle, int *configuration)
{
	int err;

	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	*configuration = 1;
	unlock();
	return err;
}

int libusb_set_auto_detach_kernel_driver(libusb_device_handle *handle, int enable)
{
	int err;

	(void)enable;
	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	unlock();
	return err;
}

int libusb_clear_halt(libusb_device_handle *handle, unsigned char endpoint)
{
	struct fake_bridge *bridge;
	int err;

	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	bridge = fake_handle_bridge(handle);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err && !handle->claimed[0])
		fake_violation("%s: interface 0 is not claimed", __func__);
	if (!err)
		err = fake_bridge_request(bridge);
	if (!err)
		bridge->halted[endpoint == GLOSS_USB_ENDPOINT_OUT ? FAKE_OUT :
			       endpoint == GLOSS_USB_ENDPOINT_IN ? FAKE_IN : FAKE_EVENT] = false;
	pthread_cond_broadcast(&fake.changed);
	unlock();
	return err;
}

int libusb_reset_device(libusb_device_handle *handle)
{
	static const enum libusb_transfer_status status[] = {
		LIBUSB_TRANSFER_ERROR, LIBUSB_TRANSFER_CANCELLED, LIBUSB_TRANSFER_NO_DEVICE,
	};
	struct fake_bridge *bridge;
	int err;

	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	bridge = fake_handle_bridge(handle);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	if (!err) {
		fake_transfer_end_all(bridge, handle, status[fake_below(3)]);
		memset(bridge->halted, 0, sizeof(bridge->halted));
	}
	unlock();
	return err;
}

int libusb_get_string_descriptor_ascii(libusb_device_handle *handle, uint8_t index,
				       unsigned char *data, int length)
{
	const char *text;
	int err, count = 0;

	lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	text = board_text(device_board(handle->device), index);
	if (!err && !index)
		err = LIBUSB_ERROR_INVALID_PARAM;
	if (!err)
		err = text ? fake_bridge_request(fake_handle_bridge(handle)) : LIBUSB_ERROR_PIPE;
	while (!err && text[count] && count < length - 1) {
		data[count] = (unsigned char)text[count] < 128 ? (unsigned char)text[count] : '?';
		count++;
	}
	if (!err)
		data[count] = 0;
	unlock();
	return err ? err : count;
}

void fake_device_kill(void)
{
	for (struct libusb_device_handle *h = handles; h < handles + FAKE_HANDLES; h++)
		h->dead = h->used;
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
	unlock();
	called.callback(called.context, device, event, called.data);
	lock();
	device_put(device);
}

bool fake_device_announce(struct libusb_context *context)
{
	bool any = false;

	for (struct libusb_device *d = devices; d < devices + FAKE_DEVICES; d++) {
		if (!d->references || d->context != context || d->announced || device_alive(d))
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
	lock();
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
	unlock();
	return err;
}

void libusb_hotplug_deregister_callback(libusb_context *context,
					libusb_hotplug_callback_handle handle)
{
	lock();
	fake_context_check(context, __func__);
	if (handle > 0 && handle <= HOTPLUGS && hotplugs[handle - 1].context == context) {
		hotplugs[handle - 1].context = NULL;
		fake_usb.hotplug_callbacks--;
	}
	unlock();
}
