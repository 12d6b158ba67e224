// SPDX-License-Identifier: MIT
#include "vboard/usb/descriptors.h"

#include <linux/usb/ch9.h>
#include <string.h>

#include "gloss_regs.h"

enum { STRING_LANGUAGES, STRING_MANUFACTURER, STRING_PRODUCT, STRING_SERIAL };

#define LANGUAGE 0x0409 /* English, United States */
#define EVENT_BYTES (4 * GLOSS_USB_EVENT_WORDS)
#define EVENT_INTERVAL 4 /* a millisecond */
#define BURST_PACKETS 16
#define SUPER_CONTROL_LOG2 9 /* bytes of a packet */

#define LOW(value) ((uint8_t)(value))
#define HIGH(value) ((uint8_t)((value) >> 8))
#define WORD(value) LOW(value), HIGH(value)

void vboard_usb_endpoints(struct vboard_usb_endpoint endpoints[VBOARD_USB_ENDPOINTS], bool super)
{
	const uint16_t packet = super ? 1024 : 512;
	const struct vboard_usb_endpoint list[VBOARD_USB_ENDPOINTS] = {
		{ GLOSS_USB_ENDPOINT_OUT, 0, false, packet, 0 },
		{ GLOSS_USB_ENDPOINT_IN, 0, false, packet, 0 },
		{ GLOSS_USB_ENDPOINT_EVENT, 0, true, EVENT_BYTES, EVENT_INTERVAL },
		{ VBOARD_USB_PLAIN_SINK, 1, false, packet, 0 },
		{ VBOARD_USB_PLAIN_SOURCE, 1, false, packet, 0 },
	};

	memcpy(endpoints, list, sizeof(list));
}

/* Appends a descriptor, whose first byte is its length. */
static int append(uint8_t *bytes, int at, const uint8_t *descriptor)
{
	memcpy(bytes + at, descriptor, descriptor[0]);
	return at + descriptor[0];
}

static int describe_device(uint8_t *bytes, bool super)
{
	const uint8_t device[] = {
		USB_DT_DEVICE_SIZE,
		USB_DT_DEVICE,
		WORD(super ? 0x0300 : 0x0200),
		0,
		0,
		0, /* the interfaces have the classes */
		super ? SUPER_CONTROL_LOG2 : 64,
		WORD(GLOSS_USB_VENDOR),
		WORD(GLOSS_USB_PRODUCT),
		WORD(VBOARD_USB_DEVICE_VERSION),
		STRING_MANUFACTURER,
		STRING_PRODUCT,
		STRING_SERIAL,
		1,
	};

	return append(bytes, 0, device);
}

static int describe_endpoint(uint8_t *bytes, int at, const struct vboard_usb_endpoint *endpoint,
			     bool super)
{
	const uint8_t descriptor[] = {
		USB_DT_ENDPOINT_SIZE,
		USB_DT_ENDPOINT,
		endpoint->address,
		endpoint->interrupt ? USB_ENDPOINT_XFER_INT : USB_ENDPOINT_XFER_BULK,
		WORD(endpoint->packet_bytes),
		endpoint->interval,
	};
	const uint8_t companion[] = {
		USB_DT_SS_EP_COMP_SIZE,
		USB_DT_SS_ENDPOINT_COMP,
		endpoint->interrupt ? 0 : BURST_PACKETS - 1,
		0,
		WORD(endpoint->interrupt ? endpoint->packet_bytes : 0),
	};

	at = append(bytes, at, descriptor);
	return super ? append(bytes, at, companion) : at;
}

static int describe_interface(uint8_t *bytes, int at, uint8_t number, bool super)
{
	struct vboard_usb_endpoint endpoints[VBOARD_USB_ENDPOINTS];
	const uint8_t interface[] = {
		USB_DT_INTERFACE_SIZE,
		USB_DT_INTERFACE,
		number,
		0,
		number ? 2 : 3,
		USB_CLASS_VENDOR_SPEC,
		number ? VBOARD_USB_PLAIN_SUBCLASS : GLOSS_USB_SUBCLASS,
		GLOSS_USB_PROTOCOL,
		0,
	};

	vboard_usb_endpoints(endpoints, super);
	at = append(bytes, at, interface);
	for (int i = 0; i < VBOARD_USB_ENDPOINTS; i++)
		if (endpoints[i].interface == number)
			at = describe_endpoint(bytes, at, &endpoints[i], super);
	return at;
}

static int describe_configuration(uint8_t *bytes, bool super)
{
	const uint8_t configuration[] = {
		USB_DT_CONFIG_SIZE,
		USB_DT_CONFIG,
		0,
		0,
		VBOARD_USB_INTERFACES,
		1,
		0,
		USB_CONFIG_ATT_ONE | USB_CONFIG_ATT_SELFPOWER,
		0,
	};
	int at = append(bytes, 0, configuration);
	uint8_t i;

	for (i = 0; i < VBOARD_USB_INTERFACES; i++)
		at = describe_interface(bytes, at, i, super);
	bytes[2] = LOW(at);
	bytes[3] = HIGH(at);
	return at;
}

/* Of a board on USB 3: it also works at high speed, says the standard, and saves no power. */
static int describe_bos(uint8_t *bytes)
{
	const uint8_t bos[] = {
		USB_DT_BOS_SIZE,
		USB_DT_BOS,
		WORD(USB_DT_BOS_SIZE + USB_DT_USB_EXT_CAP_SIZE + USB_DT_USB_SS_CAP_SIZE),
		2,
	};
	const uint8_t extension[] = {
		USB_DT_USB_EXT_CAP_SIZE, USB_DT_DEVICE_CAPABILITY, USB_CAP_TYPE_EXT, 2, 0, 0, 0,
	};
	const uint8_t super[] = {
		USB_DT_USB_SS_CAP_SIZE,
		USB_DT_DEVICE_CAPABILITY,
		USB_SS_CAP_TYPE,
		0,
		WORD(USB_HIGH_SPEED_OPERATION | USB_5GBPS_OPERATION),
		2,
		10,
		WORD(0x7ff), /* us to leave U1 and U2 */
	};

	return append(bytes, append(bytes, append(bytes, 0, bos), extension), super);
}

static int describe_string(uint8_t *bytes, uint8_t index, const char *serial)
{
	const char *const strings[] = {
		[STRING_MANUFACTURER] = "Gloss",
		[STRING_PRODUCT] = "Gloss board",
		[STRING_SERIAL] = serial,
	};
	const uint8_t languages[] = { 4, USB_DT_STRING, WORD(LANGUAGE) };
	const char *text;
	int at = 2;

	if (index == STRING_LANGUAGES)
		return append(bytes, 0, languages);
	if (index > STRING_SERIAL)
		return -1;
	for (text = strings[index]; *text; text++) {
		bytes[at++] = (uint8_t)*text;
		bytes[at++] = 0;
	}
	bytes[0] = (uint8_t)at;
	bytes[1] = USB_DT_STRING;
	return at;
}

int vboard_usb_descriptor(uint8_t *bytes, uint16_t value, bool super, const char *serial)
{
	switch (value >> 8) {
	case USB_DT_DEVICE:
		return describe_device(bytes, super);
	case USB_DT_CONFIG:
		return value & 0xff ? -1 : describe_configuration(bytes, super);
	case USB_DT_STRING:
		return describe_string(bytes, (uint8_t)value, serial);
	case USB_DT_BOS:
		return super ? describe_bos(bytes) : -1;
	default:
		return -1;
	}
}
