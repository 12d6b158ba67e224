/* SPDX-License-Identifier: MIT */
/* What a device says of itself before anybody speaks to its interfaces. */
#include <string.h>

#include "fake_usb_priv.h"

#define CONFIGURATIONS 8

/* What is behind one pointer of libusb_get_active_config_descriptor. */
struct configuration {
	bool used;
	struct libusb_config_descriptor config;
	struct libusb_interface interface[FAKE_INTERFACES];
	struct libusb_interface_descriptor setting[FAKE_INTERFACES];
	struct libusb_endpoint_descriptor endpoint[FAKE_USB_ENDPOINTS];
};

static struct configuration configurations[CONFIGURATIONS];

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

	fake_lock();
	board = fake_device_board(fake_device_check(device, __func__));
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
	fake_unlock();
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

	fake_lock();
	fake_device_check(device, __func__);
	err = fake_call(__func__);
	while (!err && c < configurations + CONFIGURATIONS && c->used)
		c++;
	if (c == configurations + CONFIGURATIONS)
		fake_violation("%s: too many", __func__);
	if (!err) {
		configuration_fill(c, fake_device_board(device));
		*out = &c->config;
		fake_usb.configurations++;
	}
	fake_unlock();
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
	fake_lock();
	for (struct configuration *c = configurations; c < configurations + CONFIGURATIONS; c++) {
		if (&c->config != config)
			continue;
		if (!c->used)
			fake_violation("%s: it is gone", __func__);
		memset(c, 0x5a, sizeof(*c));
		c->used = false;
		fake_usb.configurations--;
	}
	fake_unlock();
}

int libusb_get_string_descriptor_ascii(libusb_device_handle *handle, uint8_t index,
				       unsigned char *data, int length)
{
	const char *text;
	int err, count = 0;

	fake_lock();
	fake_handle_check(handle, __func__);
	err = fake_call(__func__);
	if (!err && !fake_handle_alive(handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	text = board_text(fake_device_board(handle->device), index);
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
	fake_unlock();
	return err ? err : count;
}
