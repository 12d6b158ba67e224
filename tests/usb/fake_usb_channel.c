/* SPDX-License-Identifier: MIT */
/* Bulk and interrupt endpoints: transfers to packets, packets to the words of the port. */
#include <string.h>

#include "fake_usb_priv.h"

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
	if (!fake_bridge_packet(bridge))
		return true;
	for (int n = 0; n + 4 <= bytes && !transfer->lost; n += 4)
		out_word(bridge, fake_get_word(public->buffer + public->actual_length + n));
	public->actual_length += bytes;
	if (public->actual_length == public->length)
		fake_transfer_end(transfer, LIBUSB_TRANSFER_COMPLETED);
	return true;
}

bool fake_out_pump(struct fake_bridge *bridge)
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
bool fake_out_offer(struct fake_bridge *bridge)
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
		word = fake_random();
	}
	fake_put_word(packet->byte + packet->bytes, word);
	packet->bytes += 4;
	fake_usb.in_words++;
}

/* From the port to the packet that is being filled; chance ends some before they are full. */
bool fake_in_take(struct fake_bridge *bridge)
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
	if (fake_bridge_packet(bridge) && bridge->packet_count && packet_take(bridge, &packet))
		in_deliver(bridge, transfer, &packet);
	return true;
}

bool fake_in_pump(struct fake_bridge *bridge)
{
	bool moved = false;

	for (uint32_t left = 1 + fake_below(8); left && in_packet(bridge); left--)
		moved = true;
	return moved;
}

/* ---- events ---- */

bool fake_event_pump(struct fake_bridge *bridge)
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
	if (!fake_bridge_packet(bridge))
		return true;
	for (int n = 0; n < GLOSS_USB_EVENT_WORDS; n++)
		fake_put_word(packet.byte + 4 * n, words[n]);
	in_deliver(bridge, transfer, &packet);
	if (transfer->state == FAKE_QUEUED)
		fake_transfer_end(transfer, LIBUSB_TRANSFER_COMPLETED);
	return true;
}
