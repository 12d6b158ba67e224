/* SPDX-License-Identifier: MIT */
/*
 * The cable and the bridge behind it: transfers to packets, packets to the words of the port,
 * requests to its registers. A round moves some of what could move, as chance has it.
 */
#include <string.h>

#include "fake_usb_priv.h"

static unsigned int number(const struct fake_bridge *bridge)
{
	return (unsigned int)(bridge - fake.bridge);
}

static void bridge_empty(struct fake_bridge *bridge)
{
	bridge->out_count = bridge->packet_count = 0;
	bridge->empty_follows = false;
}

/* ---- faults ---- */

bool fake_bridge_fault(struct fake_bridge *bridge, enum fake_usb_fault fault)
{
	if (!bridge->at[fault] || --bridge->at[fault])
		return false;
	fake_usb.fired++;
	/* Of these nobody has to find out by waiting. */
	if (fault != FAKE_USB_SHORT_IN && fault != FAKE_USB_EMPTY_IN)
		fake.hurry = true;
	return true;
}

/* A packet of any kind is about to move; false: not any more. */
static bool bridge_packet(struct fake_bridge *bridge)
{
	if (fake_bridge_fault(bridge, FAKE_USB_GLITCH)) {
		bridge->ops->reset(bridge->board);
		if (fake_below(2))
			bridge_empty(bridge);
	}
	if (fake_bridge_fault(bridge, FAKE_USB_KILL)) {
		fake_device_kill();
		return false;
	}
	if (fake_bridge_fault(bridge, FAKE_USB_UNPLUG)) {
		fake_bridge_unplug(bridge);
		if (bridge->value[FAKE_USB_UNPLUG])
			fake_bridge_plug(bridge, bridge->value[FAKE_USB_UNPLUG] > 1);
		return false;
	}
	return true;
}

/* ---- plugging ---- */

static void bridge_make_board(struct fake_bridge *bridge)
{
	const struct gloss_usb_board_ops *ops = fake_usb.board[number(bridge)].ops;

	if (bridge->ops == ops)
		return;
	fake_bridge_stop(bridge);
	bridge->ops = ops;
	bridge->board = ops->create(fake_usb_memory(number(bridge)), FAKE_USB_BOARD_BYTES);
	if (!bridge->board)
		fake_violation("no memory for a board");
	bridge_empty(bridge);
}

void fake_bridge_start(struct fake_bridge *bridge, unsigned int n)
{
	memset(bridge, 0, sizeof(*bridge));
	bridge->plug = n;
	for (int queue = 0; queue < FAKE_QUEUES; queue++)
		fake_list_init(&bridge->queue[queue]);
}

void fake_bridge_stop(struct fake_bridge *bridge)
{
	if (bridge->ops)
		bridge->ops->destroy(bridge->board);
	bridge->ops = NULL;
}

void fake_bridge_unplug(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer;

	fake_usb.board[number(bridge)].present = false;
	if (!bridge->present)
		return;
	/* Before the kernel knows why, a transfer may just have failed. */
	for (int queue = 0; queue < FAKE_QUEUES; queue++) {
		transfer = bridge->queue[queue].first;
		if (transfer && !fake_below(4))
			fake_transfer_end(transfer, LIBUSB_TRANSFER_ERROR);
	}
	fake_transfer_end_all(bridge, NULL, LIBUSB_TRANSFER_NO_DEVICE);
	bridge->present = false;
}

void fake_bridge_plug(struct fake_bridge *bridge, bool power)
{
	fake_usb.board[number(bridge)].present = true;
	if (bridge->present)
		return;
	bridge_make_board(bridge);
	bridge->present = true;
	bridge->plug++;
	bridge->packet_bytes = fake_usb.board[number(bridge)].speed >= LIBUSB_SPEED_SUPER ? 1024 :
											    512;
	memset(bridge->halted, 0, sizeof(bridge->halted));
	if (power) {
		bridge->ops->reset(bridge->board);
		bridge_empty(bridge);
	}
}

/* ---- endpoint 0 ---- */

static uint32_t get_word(const uint8_t *byte)
{
	return byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 | (uint32_t)byte[3] << 24;
}

static void put_word(uint8_t *byte, uint32_t word)
{
	for (int n = 0; n < 4; n++)
		byte[n] = (uint8_t)(word >> 8 * n);
}

static void register_write(struct fake_bridge *bridge, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL && value & GLOSS_REG_CONTROL_RESET) {
		bridge->hang_in = bridge->hang_out = false;
		fake.hurry = false;
		fake_usb.resets++;
		if (fake_bridge_fault(bridge, FAKE_USB_RESET_LASTS))
			bridge->resets_last = bridge->value[FAKE_USB_RESET_LASTS];
	}
	bridge->ops->write(bridge->board, offset, value);
}

static uint32_t register_read(struct fake_bridge *bridge, uint32_t offset)
{
	uint32_t value = bridge->ops->read(bridge->board, offset);

	if (offset == GLOSS_REG_CONTROL && bridge->resets_last) {
		bridge->resets_last--;
		fake.hurry = true;
		value |= GLOSS_REG_CONTROL_RESET;
	}
	return value;
}

static enum libusb_transfer_status control_run(struct fake_bridge *bridge,
					       struct libusb_transfer *public)
{
	uint8_t *setup = public->buffer, *data = setup + LIBUSB_CONTROL_SETUP_SIZE;
	uint32_t offset = setup[2] | (uint32_t)setup[3] << 8;
	uint32_t interface = setup[4] | (uint32_t)setup[5] << 8;
	uint32_t length = setup[6] | (uint32_t)setup[7] << 8;

	if (interface || offset % 4 || length < 4)
		return LIBUSB_TRANSFER_STALL;
	if (setup[0] == 0xc1 && setup[1] == GLOSS_USB_READ_REGISTER)
		put_word(data, register_read(bridge, offset));
	else if (setup[0] == 0x41 && setup[1] == GLOSS_USB_WRITE_REGISTER && length == 4)
		register_write(bridge, offset, get_word(data));
	else
		return LIBUSB_TRANSFER_STALL;
	public->actual_length = 4;
	return LIBUSB_TRANSFER_COMPLETED;
}

/* Whether this request is one of those that are refused, or not answered. */
static bool control_fault(struct fake_bridge *bridge, enum fake_usb_fault fault, uint32_t *left)
{
	if (fake_bridge_fault(bridge, fault))
		*left = bridge->value[fault] + 1;
	if (!*left)
		return false;
	--*left;
	fake.hurry = true;
	return true;
}

int fake_bridge_request(struct fake_bridge *bridge)
{
	if (!bridge_packet(bridge))
		return LIBUSB_ERROR_NO_DEVICE;
	if (control_fault(bridge, FAKE_USB_HANG_CONTROL, &bridge->silences))
		return LIBUSB_ERROR_TIMEOUT;
	return control_fault(bridge, FAKE_USB_REFUSE_CONTROL, &bridge->refusals) ?
	       LIBUSB_ERROR_PIPE : 0;
}

static bool control_pump(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer = bridge->queue[FAKE_CONTROL].first;

	if (!transfer || transfer->lost)
		return false;
	if (!bridge_packet(bridge))
		return true;
	/* One that is not answered holds up those behind it. */
	if (control_fault(bridge, FAKE_USB_HANG_CONTROL, &bridge->silences))
		transfer->lost = true;
	else if (control_fault(bridge, FAKE_USB_REFUSE_CONTROL, &bridge->refusals))
		fake_transfer_end(transfer, LIBUSB_TRANSFER_STALL);
	else
		fake_transfer_end(transfer, control_run(bridge, &transfer->public));
	return true;
}

/* ---- OUT ---- */

/* Before its first byte. True: it has ended. */
static bool out_begin(struct fake_bridge *bridge, struct fake_transfer *transfer)
{
	if (fake_bridge_fault(bridge, FAKE_USB_STALL_OUT))
		bridge->halted[FAKE_OUT] = true;
	if (bridge->halted[FAKE_OUT])
		fake_transfer_end(transfer, LIBUSB_TRANSFER_STALL);
	else if (fake_bridge_fault(bridge, FAKE_USB_ERROR_OUT))
		fake_transfer_end(transfer, LIBUSB_TRANSFER_ERROR);
	else
		transfer->lost = fake_bridge_fault(bridge, FAKE_USB_LOSE_OUT);
	return transfer->state != FAKE_QUEUED;
}

static void out_word(struct fake_bridge *bridge, uint32_t word)
{
	if (fake_bridge_fault(bridge, FAKE_USB_GARBAGE_OUT))
		bridge->garbage_out = bridge->value[FAKE_USB_GARBAGE_OUT] + 1;
	if (bridge->garbage_out) {
		bridge->garbage_out--;
		fake.hurry = true;
		word = fake_random();
	}
	bridge->out[(bridge->out_first + bridge->out_count++) % FAKE_OUT_WORDS] = word;
	fake_usb.out_words++;
}

/* A packet of @transfer, if there is room for it. */
static bool out_packet(struct fake_bridge *bridge, struct fake_transfer *transfer)
{
	struct libusb_transfer *public = &transfer->public;
	int bytes = public->length - public->actual_length;

	if (bytes > (int)bridge->packet_bytes)
		bytes = (int)bridge->packet_bytes;
	if (FAKE_OUT_WORDS - bridge->out_count < (uint32_t)bytes / 4)
		return false;
	if (!public->actual_length && out_begin(bridge, transfer))
		return true;
	if (!bridge_packet(bridge))
		return true;
	for (int n = 0; n + 4 <= bytes && !transfer->lost; n += 4)
		out_word(bridge, get_word(public->buffer + public->actual_length + n));
	public->actual_length += bytes;
	if (public->actual_length == public->length)
		fake_transfer_end(transfer, LIBUSB_TRANSFER_COMPLETED);
	return true;
}

static bool out_pump(struct fake_bridge *bridge)
{
	bool moved = false;

	for (uint32_t left = 1 + fake_below(8); left && bridge->queue[FAKE_OUT].first; left--) {
		if (!out_packet(bridge, bridge->queue[FAKE_OUT].first))
			break;
		moved = true;
	}
	return moved;
}

/* From the bridge to the port. */
static bool out_offer(struct fake_bridge *bridge)
{
	uint32_t count = FAKE_OUT_WORDS - bridge->out_first, taken;

	if (bridge->out_count && fake_bridge_fault(bridge, FAKE_USB_HANG_OUT))
		bridge->hang_out = true;
	if (bridge->hang_out || !bridge->out_count)
		return false;
	count = count < bridge->out_count ? count : bridge->out_count;
	taken = bridge->ops->out(bridge->board, bridge->out + bridge->out_first,
				 1 + fake_below(count));
	bridge->out_first = (bridge->out_first + taken) % FAKE_OUT_WORDS;
	bridge->out_count -= taken;
	return taken;
}

/* ---- IN ---- */

static struct fake_packet *packet_last(struct fake_bridge *bridge)
{
	return &bridge->packet[(bridge->packet_first + bridge->packet_count - 1) % FAKE_PACKETS];
}

/* An empty one at the end, to be filled; NULL: there is no room. */
static struct fake_packet *packet_new(struct fake_bridge *bridge)
{
	struct fake_packet *packet;

	if (bridge->packet_count == FAKE_PACKETS)
		return NULL;
	bridge->packet_count++;
	packet = packet_last(bridge);
	packet->bytes = 0;
	packet->whole = false;
	return packet;
}

static void in_word(struct fake_bridge *bridge, struct fake_packet *packet, uint32_t word)
{
	if (fake_bridge_fault(bridge, FAKE_USB_GARBAGE_IN))
		bridge->garbage_in = bridge->value[FAKE_USB_GARBAGE_IN] + 1;
	if (bridge->garbage_in) {
		bridge->garbage_in--;
		fake.hurry = true;
		word = fake_random();
	}
	put_word(packet->byte + packet->bytes, word);
	packet->bytes += 4;
	fake_usb.in_words++;
}

/* From the port to the packet that is being filled; chance ends some before they are full. */
static bool in_take(struct fake_bridge *bridge)
{
	struct fake_packet *packet = bridge->packet_count ? packet_last(bridge) : NULL;
	uint32_t words[FAKE_PACKET_MAX / 4], count;
	bool flush = false;

	if (!packet || packet->whole)
		packet = packet_new(bridge);
	if (!packet || bridge->hang_in)
		return false;
	if (bridge->empty_follows) {
		packet->whole = true;
		bridge->empty_follows = false;
		return true;
	}
	count = bridge->ops->in(bridge->board, words, (bridge->packet_bytes - packet->bytes) / 4,
				&flush);
	for (uint32_t n = 0; n < count; n++) {
		if (fake_bridge_fault(bridge, FAKE_USB_HANG_IN))
			bridge->hang_in = true;
		if (bridge->hang_in)
			return true;
		in_word(bridge, packet, words[n]);
	}
	packet->whole = flush || packet->bytes == bridge->packet_bytes ||
			(packet->bytes && !fake_below(64));
	bridge->empty_follows = flush && packet->bytes == bridge->packet_bytes;
	return count;
}

/* The first half of a packet, for the second stays where it is. */
static uint32_t packet_halve(struct fake_bridge *bridge, struct fake_packet *packet,
			     struct fake_packet *half)
{
	*half = *packet;
	half->bytes = packet->bytes / 8 * 4;
	packet->bytes -= half->bytes;
	memmove(packet->byte, packet->byte + half->bytes, packet->bytes);
	return half->bytes < bridge->packet_bytes;
}

/* Takes the next packet as it comes through the cable; false: there is none. */
static bool packet_take(struct fake_bridge *bridge, struct fake_packet *to)
{
	struct fake_packet *packet = &bridge->packet[bridge->packet_first];

	to->bytes = 0;
	if (fake_bridge_fault(bridge, FAKE_USB_EMPTY_IN))
		bridge->empties = bridge->value[FAKE_USB_EMPTY_IN];
	if (bridge->empties) {
		bridge->empties--;
		return true;
	}
	if (fake_bridge_fault(bridge, FAKE_USB_SHORT_IN))
		return packet_halve(bridge, packet, to);
	*to = *packet;
	if (to->bytes && fake_bridge_fault(bridge, FAKE_USB_ODD_IN))
		to->bytes -= 1 + fake_below(3);
	if (!fake_bridge_fault(bridge, FAKE_USB_REPEAT_IN)) {
		bridge->packet_first = (bridge->packet_first + 1) % FAKE_PACKETS;
		bridge->packet_count--;
	}
	return !fake_bridge_fault(bridge, FAKE_USB_LOSE_IN);
}

/* Before a transfer's first packet. True: it has ended. */
static bool in_begin(struct fake_bridge *bridge, struct fake_transfer *transfer)
{
	if (fake_bridge_fault(bridge, FAKE_USB_STALL_IN))
		bridge->halted[FAKE_IN] = true;
	if (bridge->halted[FAKE_IN])
		fake_transfer_end(transfer, LIBUSB_TRANSFER_STALL);
	else if (fake_bridge_fault(bridge, FAKE_USB_ERROR_IN))
		fake_transfer_end(transfer, LIBUSB_TRANSFER_ERROR);
	else if (fake_bridge_fault(bridge, FAKE_USB_OVERFLOW_IN))
		fake_transfer_end(transfer, LIBUSB_TRANSFER_OVERFLOW);
	return transfer->state != FAKE_QUEUED;
}

static void in_deliver(struct fake_bridge *bridge, struct fake_transfer *transfer,
		       const struct fake_packet *packet)
{
	struct libusb_transfer *public = &transfer->public;
	uint32_t room = (uint32_t)(public->length - public->actual_length);
	uint32_t bytes = packet->bytes < room ? packet->bytes : room;

	if (bytes)
		memcpy(public->buffer + public->actual_length, packet->byte, bytes);
	public->actual_length += (int)bytes;
	if (packet->bytes > room)
		fake_transfer_end(transfer, LIBUSB_TRANSFER_OVERFLOW);
	else if (packet->bytes < bridge->packet_bytes || bytes == room)
		fake_transfer_end(transfer, LIBUSB_TRANSFER_COMPLETED);
}

static bool in_packet(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer = bridge->queue[FAKE_IN].first;
	struct fake_packet packet;

	if (!transfer)
		return false;
	if (bridge->halted[FAKE_IN]) {
		fake_transfer_end(transfer, LIBUSB_TRANSFER_STALL);
		return true;
	}
	if (!bridge->packet_count || !bridge->packet[bridge->packet_first].whole)
		return false;
	if (!transfer->public.actual_length && in_begin(bridge, transfer))
		return true;
	if (bridge_packet(bridge) && bridge->packet_count && packet_take(bridge, &packet))
		in_deliver(bridge, transfer, &packet);
	return true;
}

static bool in_pump(struct fake_bridge *bridge)
{
	bool moved = false;

	for (uint32_t left = 1 + fake_below(8); left && in_packet(bridge); left--)
		moved = true;
	return moved;
}

/* ---- events ---- */

static bool event_pump(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer = bridge->queue[FAKE_EVENT].first;
	struct fake_packet packet = { .bytes = 4 * GLOSS_USB_EVENT_WORDS };
	uint32_t words[GLOSS_USB_EVENT_WORDS] = { fake_random(), fake_random() };

	if (!transfer)
		return false;
	if (fake_bridge_fault(bridge, FAKE_USB_STALL_EVENT))
		bridge->halted[FAKE_EVENT] = true;
	if (bridge->halted[FAKE_EVENT]) {
		fake_transfer_end(transfer, LIBUSB_TRANSFER_STALL);
		return true;
	}
	if (!bridge->garbage_event && !bridge->ops->event(bridge->board, words))
		return false;
	bridge->garbage_event = false;
	if (!bridge_packet(bridge))
		return true;
	for (int n = 0; n < GLOSS_USB_EVENT_WORDS; n++)
		put_word(packet.byte + 4 * n, words[n]);
	in_deliver(bridge, transfer, &packet);
	if (transfer->state == FAKE_QUEUED)
		fake_transfer_end(transfer, LIBUSB_TRANSFER_COMPLETED);
	return true;
}

/* ---- everything ---- */

static bool cancel_pump(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer, *next;
	bool moved = false;

	for (int queue = 0; queue < FAKE_QUEUES; queue++)
		for (transfer = bridge->queue[queue].first; transfer; transfer = next) {
			next = transfer->next;
			if (!transfer->cancelled)
				continue;
			moved = true;
			if (fake_below(2))
				fake_transfer_end(transfer, LIBUSB_TRANSFER_CANCELLED);
		}
	return moved;
}

static bool bridge_pump(struct fake_bridge *bridge)
{
	static bool (*const step[])(struct fake_bridge *) = {
		cancel_pump, control_pump, out_pump, out_offer, in_take, in_pump, event_pump,
	};
	bool moved = false;

	for (size_t n = 0; n < sizeof(step) / sizeof(step[0]) && bridge->present; n++) {
		/* One that is left out might have moved something. */
		if (!fake_below(8))
			moved = true;
		else if (step[n](bridge))
			moved = true;
	}
	if (!fake.held && bridge->present && bridge->ops->work(bridge->board))
		moved = true;
	return moved;
}

bool fake_bridge_pump(void)
{
	bool moved = false;

	for (struct fake_bridge *b = fake.bridge; b < fake.bridge + FAKE_USB_BOARDS; b++)
		if (b->present && bridge_pump(b))
			moved = true;
	return moved;
}
