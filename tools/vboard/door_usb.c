// SPDX-License-Identifier: MIT
/* A USB board's end of its cable: the usbredir protocol, in which QEMU's usb-redir is the guest. */
#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>

#include "vboard_usb.h"

/* Bytes that are received before the board works again. */
#define SERVE_BYTES (4u << 20)
/* Of answers that wait for the host to read: then nothing more is asked or done. */
#define BACKLOG_BYTES (1u << 20)
/* Working without a look at the socket. */
#define WORK_NS 200000
#define EVENT_BYTES (4 * GLOSS_USB_EVENT_WORDS)

/* What QEMU calls an endpoint in its tables. */
#define TABLE_INDEX(endpoint) (((endpoint) & 0x80) >> 3 | ((endpoint) & 0x0f))

/* ---- bytes ---- */

static void door_log(void *data, int level, const char *message)
{
	const struct vboard_usb *usb = data;

	if (level <= usbredirparser_error)
		fprintf(stderr, "vboard-usb: %s: %s\n", usb->name, message);
}

/* What is there of @count bytes; 0: nothing now. -1: the host is gone, or as ->end says. */
static int door_receive(struct vboard_usb *usb, uint8_t *bytes, uint32_t count)
{
	ssize_t got = recv(usb->loop.socket, bytes, count, MSG_DONTWAIT);

	if (got > 0)
		return (int)got;
	if (got < 0 && (errno == EAGAIN || errno == EINTR))
		return 0;
	usb->end = !got || errno == ECONNRESET ? 0 : -errno;
	return -1;
}

/* Little is read with more behind it, much where it is to be. */
static int door_read(void *data, uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;
	uint32_t wanted = (uint32_t)count;
	int got;

	if (!usb->read_count) {
		if (!usb->read_budget)
			return 0;
		got = wanted >= VBOARD_USB_READ_BYTES ?
		      door_receive(usb, bytes, wanted) :
		      door_receive(usb, usb->read, VBOARD_USB_READ_BYTES);
		if (got <= 0)
			return got;
		usb->read_budget -= (uint32_t)got < usb->read_budget ? (uint32_t)got : usb->read_budget;
		if (wanted >= VBOARD_USB_READ_BYTES)
			return got;
		usb->read_at = 0;
		usb->read_count = (uint32_t)got;
	}
	if (wanted > usb->read_count)
		wanted = usb->read_count;
	memcpy(bytes, usb->read + usb->read_at, wanted);
	usb->read_at += wanted;
	usb->read_count -= wanted;
	return (int)wanted;
}

static int door_write(void *data, uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;
	ssize_t sent = send(usb->loop.socket, bytes, (size_t)count, MSG_DONTWAIT | MSG_NOSIGNAL);

	if (sent >= 0)
		return (int)sent;
	if (errno == EAGAIN || errno == EINTR)
		return 0;
	usb->end = errno == EPIPE || errno == ECONNRESET ? 0 : -errno;
	return -1;
}

static bool door_full(const struct vboard_usb *usb)
{
	return usbredirparser_get_bufferered_output_size(usb->parser) > BACKLOG_BYTES;
}

/* ---- the plug ---- */

static void door_tell_endpoints(struct vboard_usb *usb)
{
	struct vboard_usb_endpoint list[VBOARD_USB_ENDPOINTS];
	struct usb_redir_ep_info_header info = { 0 };
	uint16_t control = usb->super ? 512 : 64;
	int i;

	for (i = 0; i < 32; i++)
		info.type[i] = usb_redir_type_invalid;
	info.type[TABLE_INDEX(0x00)] = usb_redir_type_control;
	info.type[TABLE_INDEX(0x80)] = usb_redir_type_control;
	info.max_packet_size[TABLE_INDEX(0x00)] = control;
	info.max_packet_size[TABLE_INDEX(0x80)] = control;
	vboard_usb_endpoints(list, usb->super);
	for (i = 0; i < VBOARD_USB_ENDPOINTS; i++) {
		int at = TABLE_INDEX(list[i].address);

		info.type[at] = list[i].interrupt ? usb_redir_type_interrupt : usb_redir_type_bulk;
		info.interval[at] = list[i].interval;
		info.interface[at] = list[i].interface;
		info.max_packet_size[at] = list[i].packet_bytes;
	}
	usbredirparser_send_ep_info(usb->parser, &info);
}

static void door_plug(struct vboard_usb *usb)
{
	struct usb_redir_interface_info_header interfaces = {
		.interface_count = VBOARD_USB_INTERFACES,
		.interface = { 0, 1 },
		.interface_class = { 0xff, 0xff },
		.interface_subclass = { GLOSS_USB_SUBCLASS, VBOARD_USB_PLAIN_SUBCLASS },
		.interface_protocol = { GLOSS_USB_PROTOCOL, GLOSS_USB_PROTOCOL },
	};
	struct usb_redir_device_connect_header device = {
		.speed = usb->super ? usb_redir_speed_super : usb_redir_speed_high,
		.vendor_id = GLOSS_USB_VENDOR,
		.product_id = GLOSS_USB_PRODUCT,
		.device_version_bcd = VBOARD_USB_DEVICE_VERSION,
	};

	usb->plugged = true;
	usb->replug = UINT64_MAX;
	usbredirparser_send_interface_info(usb->parser, &interfaces);
	door_tell_endpoints(usb);
	usbredirparser_send_device_connect(usb->parser, &device);
}

/* What the host had begun is over. The board, which has its own power, does not notice. */
static void door_forget(struct vboard_usb *usb)
{
	vboard_usb_bridge_drop(&usb->bridge);
	while (usb->source.first)
		vboard_usb_queue_remove(&usb->source, usb->source.first);
	usb->listening = false;
	vboard_usb_configure(usb, 0);
}

static void door_unplug(struct vboard_usb *usb)
{
	uint32_t ms = usb->faults.armed.replug;

	usb->faults.armed.unplug = 0;
	if (!usb->plugged)
		return;
	usb->plugged = false;
	usb->leaving = true;
	usb->replug = ms ? vboard_now() + 1000000ull * ms : UINT64_MAX;
	door_forget(usb);
	usbredirparser_send_device_disconnect(usb->parser);
}

static void door_hello(void *data, struct usb_redir_hello_header *hello)
{
	struct vboard_usb *usb = data;

	(void)hello;
	door_plug(usb);
}

/* From here on the host does not mean the device that was pulled. */
static void door_disconnected(void *data)
{
	struct vboard_usb *usb = data;

	usb->leaving = false;
}

static void door_reset(void *data)
{
	struct vboard_usb *usb = data;

	if (usb->plugged)
		door_forget(usb);
}

/* ---- the control endpoint ---- */

static void door_control(void *data, uint64_t id, struct usb_redir_control_packet_header *head,
			 uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;
	uint8_t answer[VBOARD_USB_DESCRIPTOR_MAX];
	bool in = head->endpoint & 0x80;
	int length = -1;

	(void)count;			/* is what the head says */
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

static void door_tell_configuration(struct vboard_usb *usb, uint64_t id, bool done)
{
	struct usb_redir_configuration_status_header status = {
		.status = done ? usb_redir_success : usb_redir_stall,
		.configuration = usb->configuration,
	};

	if (usb->plugged)
		usbredirparser_send_configuration_status(usb->parser, id, &status);
}

static void door_set_configuration(void *data, uint64_t id,
				   struct usb_redir_set_configuration_header *set)
{
	struct vboard_usb *usb = data;

	door_tell_configuration(usb, id, vboard_usb_configure(usb, set->configuration));
}

static void door_get_configuration(void *data, uint64_t id)
{
	door_tell_configuration(data, id, true);
}

static void door_tell_setting(struct vboard_usb *usb, uint64_t id, uint8_t interface, bool done)
{
	struct usb_redir_alt_setting_status_header status = {
		.status = done ? usb_redir_success : usb_redir_stall,
		.interface = interface,
	};

	if (usb->plugged)
		usbredirparser_send_alt_setting_status(usb->parser, id, &status);
}

static void door_set_setting(void *data, uint64_t id, struct usb_redir_set_alt_setting_header *set)
{
	struct vboard_usb *usb = data;

	door_tell_setting(usb, id, set->interface,
			  vboard_usb_set_interface(usb, set->interface, set->alt));
}

static void door_get_setting(void *data, uint64_t id, struct usb_redir_get_alt_setting_header *get)
{
	door_tell_setting(data, id, get->interface, get->interface < VBOARD_USB_INTERFACES);
}

/* ---- bulk endpoints ---- */

static void door_answer_bulk(struct vboard_usb *usb, uint64_t id, uint8_t endpoint, uint8_t status,
			     const void *bytes, uint32_t count)
{
	struct usb_redir_bulk_packet_header head = {
		.endpoint = endpoint,
		.status = status,
		.length = (uint16_t)count,
		.length_high = (uint16_t)(count >> 16),
	};
	bool in = endpoint & 0x80;

	/* The parser takes what it does not change without const. */
	usbredirparser_send_bulk_packet(usb->parser, id, &head, in ? (uint8_t *)(uintptr_t)bytes : NULL,
					in ? (int)count : 0);
}

static void door_ended(void *data, const struct vboard_usb_transfer *transfer,
		       enum vboard_usb_status status, const void *bytes, uint32_t count)
{
	static const uint8_t says[] = {
		[VBOARD_USB_DONE] = usb_redir_success,
		[VBOARD_USB_STALLED] = usb_redir_stall,
		[VBOARD_USB_CANCELLED] = usb_redir_cancelled,
	};
	struct vboard_usb *usb = data;

	if (transfer->endpoint & 0x80)
		usb->in_bytes += count;
	else
		usb->out_bytes += count;
	door_answer_bulk(usb, transfer->id, transfer->endpoint, says[status], bytes, count);
}

/* A transfer of the port. False: there is no room for it. */
static bool door_port(struct vboard_usb *usb, uint64_t id, uint8_t endpoint, uint8_t *bytes,
		      uint32_t count)
{
	unsigned int faults = vboard_usb_faults_transfer(&usb->faults, endpoint & 0x80);

	if (faults & VBOARD_USB_EXIT)
		usb->end = -ECANCELED;
	if (faults & VBOARD_USB_UNPLUG) {
		usbredirparser_free_packet_data(usb->parser, bytes);
		door_unplug(usb);
		return true;
	}
	/* malloc() made the bytes, so they are aligned. */
	return vboard_usb_bridge_submit(&usb->bridge, id, endpoint, faults,
					(uint32_t *)(void *)bytes, count);
}

static bool door_sink(struct vboard_usb *usb, uint64_t id, uint8_t *bytes, uint32_t count)
{
	usbredirparser_free_packet_data(usb->parser, bytes);
	door_answer_bulk(usb, id, VBOARD_USB_PLAIN_SINK,
			 usb->sink_halted ? usb_redir_stall : usb_redir_success, NULL, count);
	return true;
}

static bool door_source(struct vboard_usb *usb, uint64_t id, uint32_t count)
{
	const struct vboard_usb_transfer transfer = {
		.id = id,
		.endpoint = VBOARD_USB_PLAIN_SOURCE,
		.bytes = count,
	};

	return count <= VBOARD_USB_TRANSFER_MAX && vboard_usb_queue_add(&usb->source, &transfer);
}

static void door_bulk(void *data, uint64_t id, struct usb_redir_bulk_packet_header *head,
		      uint8_t *bytes, int length)
{
	struct vboard_usb *usb = data;
	uint32_t count = head->length | (uint32_t)head->length_high << 16;
	bool taken = false;

	(void)length;			/* is what the head says */
	if (!usb->plugged) {
		usbredirparser_free_packet_data(usb->parser, bytes);
		return;
	}
	if (head->endpoint == GLOSS_USB_ENDPOINT_OUT || head->endpoint == GLOSS_USB_ENDPOINT_IN)
		taken = door_port(usb, id, head->endpoint, bytes, count);
	else if (head->endpoint == VBOARD_USB_PLAIN_SINK)
		taken = door_sink(usb, id, bytes, count);
	else if (head->endpoint == VBOARD_USB_PLAIN_SOURCE)
		taken = door_source(usb, id, count);
	if (taken)
		return;
	usbredirparser_free_packet_data(usb->parser, bytes);
	door_answer_bulk(usb, id, head->endpoint, usb_redir_inval, NULL, 0);
}

static void door_cancel(void *data, uint64_t id)
{
	struct vboard_usb *usb = data;
	struct vboard_usb_transfer *transfer = vboard_usb_queue_find(&usb->source, id);

	vboard_usb_bridge_cancel(&usb->bridge, id);
	if (!transfer)
		return;
	door_answer_bulk(usb, id, transfer->endpoint, usb_redir_cancelled, NULL, 0);
	vboard_usb_queue_remove(&usb->source, transfer);
}

/* The next transfer of the source. */
static bool door_pour(struct vboard_usb *usb)
{
	static uint8_t zeros[VBOARD_USB_TRANSFER_MAX];	/* const would be in the program's file */
	const struct vboard_usb_transfer *transfer = usb->source.first;

	if (!transfer)
		return false;
	if (usb->source_halted)
		door_answer_bulk(usb, transfer->id, transfer->endpoint, usb_redir_stall, NULL, 0);
	else
		door_answer_bulk(usb, transfer->id, transfer->endpoint, usb_redir_success, zeros,
				 transfer->bytes);
	vboard_usb_queue_remove(&usb->source, usb->source.first);
	return true;
}

/* ---- the interrupt endpoint ---- */

/* Events stay in the board as long as the host does not take them. */
static void door_tell_events(struct vboard_usb *usb)
{
	struct usb_redir_interrupt_packet_header head = {
		.endpoint = GLOSS_USB_ENDPOINT_EVENT,
		.length = EVENT_BYTES,
	};
	uint32_t words[GLOSS_USB_EVENT_WORDS];

	while (usb->listening && !usb->event_halted && !door_full(usb) &&
	       usb->bridge.ops->event(usb->bridge.board, words)) {
		usbredirparser_send_interrupt_packet(usb->parser, usb->events++, &head,
						     (uint8_t *)words, EVENT_BYTES);
	}
}

static void door_tell_listening(struct vboard_usb *usb, uint64_t id, uint8_t endpoint, bool on)
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

static void door_listen(void *data, uint64_t id,
			struct usb_redir_start_interrupt_receiving_header *start)
{
	door_tell_listening(data, id, start->endpoint, true);
}

static void door_ignore(void *data, uint64_t id,
			struct usb_redir_stop_interrupt_receiving_header *stop)
{
	door_tell_listening(data, id, stop->endpoint, false);
}

/* ---- what this device does not have; the parser wants it all the same ---- */

static void door_tell_iso(struct vboard_usb *usb, uint64_t id, uint8_t endpoint)
{
	struct usb_redir_iso_stream_status_header status = {
		.status = usb_redir_inval,
		.endpoint = endpoint,
	};

	usbredirparser_send_iso_stream_status(usb->parser, id, &status);
}

static void door_start_iso(void *data, uint64_t id, struct usb_redir_start_iso_stream_header *start)
{
	door_tell_iso(data, id, start->endpoint);
}

static void door_stop_iso(void *data, uint64_t id, struct usb_redir_stop_iso_stream_header *stop)
{
	door_tell_iso(data, id, stop->endpoint);
}

static void door_tell_streams(struct vboard_usb *usb, uint64_t id, uint32_t endpoints)
{
	struct usb_redir_bulk_streams_status_header status = {
		.endpoints = endpoints,
		.status = usb_redir_inval,
	};

	usbredirparser_send_bulk_streams_status(usb->parser, id, &status);
}

static void door_alloc_streams(void *data, uint64_t id,
			       struct usb_redir_alloc_bulk_streams_header *alloc)
{
	door_tell_streams(data, id, alloc->endpoints);
}

static void door_free_streams(void *data, uint64_t id,
			      struct usb_redir_free_bulk_streams_header *streams)
{
	door_tell_streams(data, id, streams->endpoints);
}

static void door_iso(void *data, uint64_t id, struct usb_redir_iso_packet_header *head,
		     uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;

	(void)id, (void)head, (void)count;
	usbredirparser_free_packet_data(usb->parser, bytes);
}

static void door_interrupt(void *data, uint64_t id, struct usb_redir_interrupt_packet_header *head,
			   uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;

	(void)count;
	usbredirparser_free_packet_data(usb->parser, bytes);
	head->status = usb_redir_inval;
	head->length = 0;
	usbredirparser_send_interrupt_packet(usb->parser, id, head, NULL, 0);
}

/* ---- the loop ---- */

static int door_serve(void *data)
{
	struct vboard_usb *usb = data;
	int ret;

	if (usbredirparser_do_write(usb->parser) < 0)
		return usb->end;
	if (door_full(usb))
		return 1;
	usb->read_budget = SERVE_BYTES;
	ret = usbredirparser_do_read(usb->parser);
	if (ret == usbredirparser_read_parse_error)
		return -EPROTO;
	if (ret < 0 || usb->end < 0)
		return usb->end;
	if (usb->faults.armed.unplug == VBOARD_USB_FAULT_UNPLUG_NOW)
		door_unplug(usb);
	return usbredirparser_do_write(usb->parser) < 0 ? usb->end : 1;
}

static bool door_step(struct vboard_usb *usb)
{
	bool moved = vboard_usb_bridge_work(&usb->bridge);

	moved |= door_pour(usb);
	door_tell_events(usb);
	/* That the host is gone is seen when it is read from. */
	usbredirparser_do_write(usb->parser);
	return moved;
}

static bool door_work(void *data)
{
	struct vboard_usb *usb = data;
	uint64_t until = vboard_now() + WORK_NS;
	bool moved;

	if (!usb->plugged && !usb->leaving && vboard_now() >= usb->replug)
		door_plug(usb);
	do
		moved = !door_full(usb) && door_step(usb);
	while (moved && vboard_now() < until);
	return moved;
}

static uint64_t door_due(const void *data)
{
	const struct vboard_usb *usb = data;
	uint64_t due = vboard_usb_faults_due(&usb->faults);

	return !usb->plugged && !usb->leaving && usb->replug < due ? usb->replug : due;
}

static short door_events(const void *data)
{
	const struct vboard_usb *usb = data;
	short events = door_full(usb) ? 0 : POLLIN;

	return usbredirparser_has_data_to_write(usb->parser) ? events | POLLOUT : events;
}

const struct vboard_loop_ops vboard_door_usb_loop = {
	.serve = door_serve,
	.work = door_work,
	.due = door_due,
	.events = door_events,
};

/* ---- beginning and end ---- */

static void door_callbacks(struct usbredirparser *parser)
{
	parser->log_func = door_log;
	parser->read_func = door_read;
	parser->write_func = door_write;
	parser->hello_func = door_hello;
	parser->device_disconnect_ack_func = door_disconnected;
	parser->reset_func = door_reset;
	parser->set_configuration_func = door_set_configuration;
	parser->get_configuration_func = door_get_configuration;
	parser->set_alt_setting_func = door_set_setting;
	parser->get_alt_setting_func = door_get_setting;
	parser->start_interrupt_receiving_func = door_listen;
	parser->stop_interrupt_receiving_func = door_ignore;
	parser->cancel_data_packet_func = door_cancel;
	parser->control_packet_func = door_control;
	parser->bulk_packet_func = door_bulk;
	parser->iso_packet_func = door_iso;
	parser->interrupt_packet_func = door_interrupt;
	parser->start_iso_stream_func = door_start_iso;
	parser->stop_iso_stream_func = door_stop_iso;
	parser->alloc_bulk_streams_func = door_alloc_streams;
	parser->free_bulk_streams_func = door_free_streams;
}

bool vboard_door_usb_init(struct vboard_usb *usb)
{
	static const int can[] = {
		usb_redir_cap_connect_device_version,
		usb_redir_cap_device_disconnect_ack,
		usb_redir_cap_ep_info_max_packet_size,
		usb_redir_cap_64bits_ids,
		usb_redir_cap_32bits_bulk_length,
	};
	uint32_t caps[USB_REDIR_CAPS_SIZE] = { 0 };
	size_t i;

	usb->parser = usbredirparser_create();
	if (!usb->parser)
		return false;
	usb->parser->priv = usb;
	door_callbacks(usb->parser);
	usb->replug = UINT64_MAX;
	usb->end = 1;
	usb->bridge.faults = &usb->faults;
	usb->bridge.packet_bytes = usb->super ? 1024 : 512;
	usb->bridge.ended = door_ended;
	usb->bridge.user = usb;
	vboard_usb_bridge_init(&usb->bridge);
	vboard_usb_queue_init(&usb->source);
	for (i = 0; i < sizeof(can) / sizeof(can[0]); i++)
		usbredirparser_caps_set_cap(caps, can[i]);
	usbredirparser_init(usb->parser, "vboard-usb", caps, USB_REDIR_CAPS_SIZE,
			    usbredirparser_fl_usb_host);
	return true;
}

void vboard_door_usb_fini(struct vboard_usb *usb)
{
	door_forget(usb);
	vboard_usb_bridge_fini(&usb->bridge);
	usbredirparser_destroy(usb->parser);
}
