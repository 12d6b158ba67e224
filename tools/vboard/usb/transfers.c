// SPDX-License-Identifier: MIT
/* Transfers of a USB board's endpoints, as they come in usbredir's packets. */
#include <errno.h>

#include "vboard/usb/vboard.h"

#define EVENT_BYTES (4 * GLOSS_USB_EVENT_WORDS)

/* ---- the control endpoint ---- */

static void usb_control(void *data, uint64_t id, struct usb_redir_control_packet_header *head,
			uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;
	uint8_t answer[VBOARD_USB_DESCRIPTOR_MAX];
	bool in = head->endpoint & 0x80;
	int length = -1;

	(void)count; /* is what the head says */
	if (usb->plugged && in == !!(head->requesttype & 0x80))
		length = vboard_usb_control(usb, head, bytes, answer);
	usbredirparser_free_packet_data(usb->parser, bytes);
	if (!usb->plugged)
		return;
	head->status = length < 0 ? usb_redir_stall : usb_redir_success;
	if (in && length < head->length)
		head->length = (uint16_t)(length < 0 ? 0 : length);
	if (!in && length < 0)
		head->length = 0;
	usbredirparser_send_control_packet(usb->parser, id, head, in ? answer : NULL,
					   in ? head->length : 0);
}

static void usb_tell_configuration(struct vboard_usb *usb, uint64_t id, bool done)
{
	struct usb_redir_configuration_status_header status = {
		.status = done ? usb_redir_success : usb_redir_stall,
		.configuration = usb->configuration,
	};

	if (usb->plugged)
		usbredirparser_send_configuration_status(usb->parser, id, &status);
}

static void usb_set_configuration(void *data, uint64_t id,
				  struct usb_redir_set_configuration_header *set)
{
	struct vboard_usb *usb = data;

	usb_tell_configuration(usb, id, vboard_usb_configure(usb, set->configuration));
}

static void usb_get_configuration(void *data, uint64_t id)
{
	usb_tell_configuration(data, id, true);
}

static void usb_tell_setting(struct vboard_usb *usb, uint64_t id, uint8_t interface, bool done)
{
	struct usb_redir_alt_setting_status_header status = {
		.status = done ? usb_redir_success : usb_redir_stall,
		.interface = interface,
	};

	if (usb->plugged)
		usbredirparser_send_alt_setting_status(usb->parser, id, &status);
}

static void usb_set_setting(void *data, uint64_t id, struct usb_redir_set_alt_setting_header *set)
{
	struct vboard_usb *usb = data;

	usb_tell_setting(usb, id, set->interface,
			 vboard_usb_set_interface(usb, set->interface, set->alt));
}

static void usb_get_setting(void *data, uint64_t id, struct usb_redir_get_alt_setting_header *get)
{
	usb_tell_setting(data, id, get->interface, get->interface < VBOARD_USB_INTERFACES);
}

/* ---- bulk endpoints ---- */

static void usb_answer_bulk(struct vboard_usb *usb, uint64_t id, uint8_t endpoint, uint8_t status,
			    uint8_t *bytes, uint32_t count)
{
	struct usb_redir_bulk_packet_header head = {
		.endpoint = endpoint,
		.status = status,
		.length = (uint16_t)count,
		.length_high = (uint16_t)(count >> 16),
	};
	bool in = endpoint & 0x80;

	usbredirparser_send_bulk_packet(usb->parser, id, &head, in ? bytes : NULL,
					in ? (int)count : 0);
}

void vboard_usb_ended(void *user, const struct vboard_usb_transfer *transfer,
		      enum vboard_usb_status status, void *data, uint32_t bytes)
{
	static const uint8_t says[] = {
		[VBOARD_USB_DONE] = usb_redir_success,
		[VBOARD_USB_STALLED] = usb_redir_stall,
		[VBOARD_USB_CANCELLED] = usb_redir_cancelled,
	};
	struct vboard_usb *usb = user;

	if (transfer->endpoint & 0x80)
		usb->in_bytes += bytes;
	else
		usb->out_bytes += bytes;
	usb_answer_bulk(usb, transfer->id, transfer->endpoint, says[status], data, bytes);
}

/* A transfer of the port. False: there is no room for it. */
static bool usb_port(struct vboard_usb *usb, uint64_t id, uint8_t endpoint, uint8_t *bytes,
		     uint32_t count)
{
	if (vboard_usb_faults_exit(&usb->faults))
		usb->end = -ECANCELED;
	if (vboard_usb_faults_unplug(&usb->faults)) {
		usbredirparser_free_packet_data(usb->parser, bytes);
		vboard_door_usb_unplug(usb);
		return true;
	}
	/* malloc() made the bytes, so they are aligned. */
	return vboard_usb_bridge_submit(&usb->bridge, id, endpoint, (void *)bytes, count);
}

static bool usb_sink(struct vboard_usb *usb, uint64_t id, uint8_t *bytes, uint32_t count)
{
	usbredirparser_free_packet_data(usb->parser, bytes);
	usb_answer_bulk(usb, id, VBOARD_USB_PLAIN_SINK,
			usb->sink_halted ? usb_redir_stall : usb_redir_success, NULL, count);
	return true;
}

static bool usb_source(struct vboard_usb *usb, uint64_t id, uint32_t count)
{
	const struct vboard_usb_transfer transfer = {
		.id = id,
		.endpoint = VBOARD_USB_PLAIN_SOURCE,
		.bytes = count,
	};

	return count <= VBOARD_USB_TRANSFER_MAX && vboard_usb_queue_add(&usb->source, &transfer);
}

static void usb_bulk(void *data, uint64_t id, struct usb_redir_bulk_packet_header *head,
		     uint8_t *bytes, int length)
{
	struct vboard_usb *usb = data;
	uint32_t count = head->length | (uint32_t)head->length_high << 16;
	bool taken = false;

	(void)length; /* is what the head says */
	if (!usb->plugged) {
		usbredirparser_free_packet_data(usb->parser, bytes);
		return;
	}
	if (head->endpoint == GLOSS_USB_ENDPOINT_OUT || head->endpoint == GLOSS_USB_ENDPOINT_IN)
		taken = usb_port(usb, id, head->endpoint, bytes, count);
	else if (head->endpoint == VBOARD_USB_PLAIN_SINK)
		taken = usb_sink(usb, id, bytes, count);
	else if (head->endpoint == VBOARD_USB_PLAIN_SOURCE)
		taken = usb_source(usb, id, count);
	if (taken)
		return;
	usbredirparser_free_packet_data(usb->parser, bytes);
	usb_answer_bulk(usb, id, head->endpoint, usb_redir_inval, NULL, 0);
}

static void usb_cancel(void *data, uint64_t id)
{
	struct vboard_usb *usb = data;
	struct vboard_usb_transfer *transfer = vboard_usb_queue_find(&usb->source, id);

	vboard_usb_bridge_cancel(&usb->bridge, id);
	if (!transfer)
		return;
	usb_answer_bulk(usb, id, transfer->endpoint, usb_redir_cancelled, NULL, 0);
	vboard_usb_queue_remove(&usb->source, transfer);
}

bool vboard_usb_pour(struct vboard_usb *usb)
{
	static uint8_t zeros[VBOARD_USB_TRANSFER_MAX]; /* const would be in the program's file */
	const struct vboard_usb_transfer *transfer = usb->source.first;

	if (!transfer)
		return false;
	if (usb->source_halted)
		usb_answer_bulk(usb, transfer->id, transfer->endpoint, usb_redir_stall, NULL, 0);
	else
		usb_answer_bulk(usb, transfer->id, transfer->endpoint, usb_redir_success, zeros,
				transfer->bytes);
	vboard_usb_queue_remove(&usb->source, usb->source.first);
	return true;
}

/* ---- the interrupt endpoint ---- */

/* Events stay in the board as long as the host does not take them. */
void vboard_usb_tell_events(struct vboard_usb *usb)
{
	struct usb_redir_interrupt_packet_header head = {
		.endpoint = GLOSS_USB_ENDPOINT_EVENT,
		.length = EVENT_BYTES,
	};
	uint32_t words[GLOSS_USB_EVENT_WORDS];

	while (usb->listening && !usb->event_halted && !vboard_door_usb_full(usb) &&
	       usb->bridge.ops->event(usb->bridge.board, words)) {
		usbredirparser_send_interrupt_packet(usb->parser, usb->events++, &head,
						     (uint8_t *)words, EVENT_BYTES);
	}
}

static void usb_tell_listening(struct vboard_usb *usb, uint64_t id, uint8_t endpoint, bool on)
{
	struct usb_redir_interrupt_receiving_status_header status = {
		.status = usb_redir_success,
		.endpoint = endpoint,
	};

	if (!usb->plugged)
		return;
	if (endpoint == GLOSS_USB_ENDPOINT_EVENT)
		usb->listening = on && !usb->event_halted;
	if (on && !usb->listening)
		status.status = usb->event_halted ? usb_redir_stall : usb_redir_inval;
	usbredirparser_send_interrupt_receiving_status(usb->parser, id, &status);
}

static void usb_listen(void *data, uint64_t id,
		       struct usb_redir_start_interrupt_receiving_header *start)
{
	usb_tell_listening(data, id, start->endpoint, true);
}

static void usb_ignore(void *data, uint64_t id,
		       struct usb_redir_stop_interrupt_receiving_header *stop)
{
	usb_tell_listening(data, id, stop->endpoint, false);
}

void vboard_usb_take_transfers(struct usbredirparser *parser)
{
	parser->control_packet_func = usb_control;
	parser->set_configuration_func = usb_set_configuration;
	parser->get_configuration_func = usb_get_configuration;
	parser->set_alt_setting_func = usb_set_setting;
	parser->get_alt_setting_func = usb_get_setting;
	parser->bulk_packet_func = usb_bulk;
	parser->cancel_data_packet_func = usb_cancel;
	parser->start_interrupt_receiving_func = usb_listen;
	parser->stop_interrupt_receiving_func = usb_ignore;
}
