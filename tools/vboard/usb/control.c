// SPDX-License-Identifier: MIT
/* The control endpoint: the requests that every device has, and registers. */
#include <linux/usb/ch9.h>
#include <string.h>

#include "vboard/usb/vboard.h"

#define REGISTER_BYTES 4

/* ---- endpoints ---- */

/* Whether it is halted; NULL: there is no such endpoint. */
static bool *control_halted(struct vboard_usb *usb, uint16_t endpoint)
{
	switch (endpoint) {
	case VBOARD_USB_PLAIN_SINK:
		return &usb->sink_halted;
	case VBOARD_USB_PLAIN_SOURCE:
		return &usb->source_halted;
	case GLOSS_USB_ENDPOINT_EVENT:
		return &usb->event_halted;
	default:
		return endpoint > UINT8_MAX ?
			       NULL :
			       vboard_usb_bridge_halted(&usb->bridge, (uint8_t)endpoint);
	}
}

static void control_clear_halts(struct vboard_usb *usb, uint8_t interface)
{
	struct vboard_usb_endpoint endpoints[VBOARD_USB_ENDPOINTS];

	vboard_usb_endpoints(endpoints, usb->super);
	for (int i = 0; i < VBOARD_USB_ENDPOINTS; i++)
		if (endpoints[i].interface == interface)
			*control_halted(usb, endpoints[i].address) = false;
}

bool vboard_usb_configure(struct vboard_usb *usb, uint8_t configuration)
{
	uint8_t i;

	if (configuration > 1)
		return false;
	for (i = 0; i < VBOARD_USB_INTERFACES; i++)
		control_clear_halts(usb, i);
	usb->configuration = configuration;
	return true;
}

bool vboard_usb_set_interface(struct vboard_usb *usb, uint8_t interface, uint8_t setting)
{
	if (interface >= VBOARD_USB_INTERFACES || setting)
		return false;
	control_clear_halts(usb, interface);
	return true;
}

/* ---- requests; each returns the length of the answer, or -1 ---- */

/* SET_FEATURE and CLEAR_FEATURE of an endpoint. */
static int control_halt(struct vboard_usb *usb, const struct usb_redir_control_packet_header *head)
{
	bool *halted = control_halted(usb, head->index);

	if (!halted || head->value != USB_ENDPOINT_HALT)
		return -1;
	*halted = head->request == USB_REQ_SET_FEATURE;
	return 0;
}

static int control_status(struct vboard_usb *usb,
			  const struct usb_redir_control_packet_header *head, uint8_t *answer)
{
	const bool *halted;

	memset(answer, 0, 2);
	switch (head->requesttype & USB_RECIP_MASK) {
	case USB_RECIP_DEVICE:
		answer[0] = 1 << USB_DEVICE_SELF_POWERED;
		return 2;
	case USB_RECIP_INTERFACE:
		return head->index < VBOARD_USB_INTERFACES ? 2 : -1;
	default:
		halted = control_halted(usb, head->index);
		if (!halted && head->index & ~USB_DIR_IN)
			return -1;
		answer[0] = halted && *halted;
		return 2;
	}
}

static int control_standard(struct vboard_usb *usb,
			    const struct usb_redir_control_packet_header *head, uint8_t *answer)
{
	bool endpoint = (head->requesttype & USB_RECIP_MASK) == USB_RECIP_ENDPOINT;

	switch (head->request) {
	case USB_REQ_GET_STATUS:
		return control_status(usb, head, answer);
	case USB_REQ_GET_DESCRIPTOR:
		return vboard_usb_descriptor(answer, head->value, usb->super, usb->serial);
	case USB_REQ_GET_CONFIGURATION:
		answer[0] = usb->configuration;
		return 1;
	case USB_REQ_CLEAR_FEATURE:
	case USB_REQ_SET_FEATURE:
		/* Those of the device and of interfaces are about saving power. */
		return endpoint ? control_halt(usb, head) : 0;
	case USB_REQ_SET_SEL:
	case USB_REQ_SET_ISOCH_DELAY:
		return usb->super ? 0 : -1;
	default:
		return -1;
	}
}

static uint32_t control_read(struct vboard_usb *usb, uint16_t offset, bool faults)
{
	return faults ? vboard_usb_faults_window_read(&usb->faults, offset) :
			vboard_usb_bridge_read(&usb->bridge, offset);
}

static void control_write(struct vboard_usb *usb, uint16_t offset, uint32_t value, bool faults)
{
	if (faults)
		vboard_usb_faults_window_write(&usb->faults, offset, value);
	else
		vboard_usb_bridge_write(&usb->bridge, offset, value);
}

static int control_register(struct vboard_usb *usb,
			    const struct usb_redir_control_packet_header *head, const uint8_t *data,
			    uint8_t *answer)
{
	bool in = head->requesttype & USB_DIR_IN;
	uint32_t value;

	if (head->index >= VBOARD_USB_INTERFACES || head->length != REGISTER_BYTES ||
	    head->value % REGISTER_BYTES ||
	    head->request != (in ? GLOSS_USB_READ_REGISTER : GLOSS_USB_WRITE_REGISTER))
		return -1;
	usb->requests++;
	if (!head->index && vboard_usb_faults_refuse(&usb->faults))
		return -1;
	if (in) {
		value = control_read(usb, head->value, head->index);
		memcpy(answer, &value, sizeof(value));
		return REGISTER_BYTES;
	}
	memcpy(&value, data, sizeof(value));
	control_write(usb, head->value, value, head->index);
	return 0;
}

int vboard_usb_control(struct vboard_usb *usb, const struct usb_redir_control_packet_header *head,
		       const uint8_t *data, uint8_t *answer)
{
	switch (head->requesttype & ~USB_DIR_IN) {
	case USB_TYPE_VENDOR | USB_RECIP_INTERFACE:
		return control_register(usb, head, data, answer);
	case USB_TYPE_STANDARD | USB_RECIP_DEVICE:
	case USB_TYPE_STANDARD | USB_RECIP_INTERFACE:
	case USB_TYPE_STANDARD | USB_RECIP_ENDPOINT:
		return control_standard(usb, head, answer);
	default:
		return -1;
	}
}
