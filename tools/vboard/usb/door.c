// SPDX-License-Identifier: MIT
/* A USB board's end of its cable: the usbredir protocol, in which QEMU's usb-redir is the guest. */
#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>

#include "vboard/options.h"
#include "vboard/usb/vboard.h"

/* Bytes that are received before the board works again. */
#define SERVE_BYTES (4u << 20)
/* Of answers that wait for the host to read: then nothing more is asked or done. */
#define BACKLOG_BYTES (1u << 20)
/* Working without a look at the socket. */
#define WORK_NS 200000

/* Where an endpoint is in a table of them. */
static int door_table_index(int endpoint)
{
	return (endpoint & 0x80) >> 3 | (endpoint & 0x0f);
}

/* ---- bytes ---- */

static void door_log(void *data, int level, const char *message)
{
	const struct vboard_usb *usb = data;

	if (level <= usbredirparser_error)
		vboard_error(usb->name, message);
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
		usb->read_budget -= (uint32_t)got < usb->read_budget ? (uint32_t)got :
								       usb->read_budget;
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

bool vboard_door_usb_full(const struct vboard_usb *usb)
{
	return usbredirparser_get_bufferered_output_size(usb->parser) > BACKLOG_BYTES;
}

/* ---- the plug ---- */

static void door_tell_endpoints(struct vboard_usb *usb)
{
	struct vboard_usb_endpoint list[VBOARD_USB_ENDPOINTS];
	struct usb_redir_ep_info_header info = { 0 };
	uint16_t control = usb->super ? 512 : 64;

	for (int i = 0; i < 32; i++)
		info.type[i] = usb_redir_type_invalid;
	info.type[door_table_index(0x00)] = usb_redir_type_control;
	info.type[door_table_index(0x80)] = usb_redir_type_control;
	info.max_packet_size[door_table_index(0x00)] = control;
	info.max_packet_size[door_table_index(0x80)] = control;
	vboard_usb_endpoints(list, usb->super);
	for (int i = 0; i < VBOARD_USB_ENDPOINTS; i++) {
		int at = door_table_index(list[i].address);

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

void vboard_door_usb_unplug(struct vboard_usb *usb)
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

/* ---- the loop ---- */

static int door_serve(void *data)
{
	struct vboard_usb *usb = data;
	int ret;

	if (usbredirparser_do_write(usb->parser) < 0)
		return usb->end;
	if (vboard_door_usb_full(usb))
		return 1;
	usb->read_budget = SERVE_BYTES;
	ret = usbredirparser_do_read(usb->parser);
	if (ret == usbredirparser_read_parse_error)
		return -EPROTO;
	if (ret < 0 || usb->end < 0)
		return usb->end;
	if (usb->faults.armed.unplug == VBOARD_USB_FAULT_UNPLUG_NOW)
		vboard_door_usb_unplug(usb);
	return usbredirparser_do_write(usb->parser) < 0 ? usb->end : 1;
}

static bool door_step(struct vboard_usb *usb)
{
	bool moved = vboard_usb_bridge_work(&usb->bridge);

	moved |= vboard_usb_pour(usb);
	vboard_usb_tell_events(usb);
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
		moved = !vboard_door_usb_full(usb) && door_step(usb);
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
	short events = vboard_door_usb_full(usb) ? 0 : POLLIN;

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
	vboard_usb_take_transfers(parser);
	vboard_usb_refuse_others(parser);
}

bool vboard_door_usb_init(struct vboard_usb *usb)
{
	static const int can[] = {
		usb_redir_cap_connect_device_version,  usb_redir_cap_device_disconnect_ack,
		usb_redir_cap_ep_info_max_packet_size, usb_redir_cap_64bits_ids,
		usb_redir_cap_32bits_bulk_length,
	};
	uint32_t caps[USB_REDIR_CAPS_SIZE] = { 0 };

	usb->parser = usbredirparser_create();
	if (!usb->parser)
		return false;
	usb->parser->priv = usb;
	door_callbacks(usb->parser);
	usb->replug = UINT64_MAX;
	usb->end = 1;
	usb->bridge.faults = &usb->faults;
	usb->bridge.packet_bytes = usb->super ? 1024 : 512;
	usb->bridge.ended = vboard_usb_ended;
	usb->bridge.user = usb;
	vboard_usb_bridge_init(&usb->bridge);
	vboard_usb_queue_init(&usb->source);
	for (size_t i = 0; i < sizeof(can) / sizeof(can[0]); i++)
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
