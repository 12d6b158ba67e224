// SPDX-License-Identifier: MIT
#include "vboard/usb/bridge.h"

#include <stdlib.h>
#include <string.h>

/* ---- transfers ---- */

void vboard_usb_bridge_init(struct vboard_usb_bridge *bridge)
{
	vboard_usb_queue_init(&bridge->out);
	vboard_usb_queue_init(&bridge->in);
}

static void bridge_forget(struct vboard_usb_queue *queue)
{
	while (queue->first)
		vboard_usb_queue_remove(queue, queue->first);
}

void vboard_usb_bridge_fini(struct vboard_usb_bridge *bridge)
{
	vboard_usb_bridge_drop(bridge);
	free(bridge->word);
}

static struct vboard_usb_queue *bridge_queue(struct vboard_usb_bridge *bridge, uint8_t endpoint)
{
	return endpoint == GLOSS_USB_ENDPOINT_IN ? &bridge->in : &bridge->out;
}

bool vboard_usb_bridge_submit(struct vboard_usb_bridge *bridge, uint64_t id, uint8_t endpoint,
			      uint32_t *data, uint32_t bytes)
{
	const struct vboard_usb_transfer transfer = {
		.id = id,
		.endpoint = endpoint,
		.data = data,
		.bytes = bytes,
	};

	return bytes <= VBOARD_USB_TRANSFER_MAX &&
	       vboard_usb_queue_add(bridge_queue(bridge, endpoint), &transfer);
}

static void bridge_end(struct vboard_usb_bridge *bridge, struct vboard_usb_transfer *transfer,
		       enum vboard_usb_status status, void *data, uint32_t bytes)
{
	bridge->ended(bridge->user, transfer, status, data, bytes);
	vboard_usb_queue_remove(bridge_queue(bridge, transfer->endpoint), transfer);
}

void vboard_usb_bridge_cancel(struct vboard_usb_bridge *bridge, uint64_t id)
{
	struct vboard_usb_transfer *transfer = vboard_usb_queue_find(&bridge->out, id);

	if (!transfer)
		transfer = vboard_usb_queue_find(&bridge->in, id);
	if (transfer)
		bridge_end(bridge, transfer, VBOARD_USB_CANCELLED, NULL, 0);
}

bool *vboard_usb_bridge_halted(struct vboard_usb_bridge *bridge, uint8_t endpoint)
{
	switch (endpoint) {
	case GLOSS_USB_ENDPOINT_OUT:
		return &bridge->out_halted;
	case GLOSS_USB_ENDPOINT_IN:
		return &bridge->in_halted;
	default:
		return NULL;
	}
}

void vboard_usb_bridge_drop(struct vboard_usb_bridge *bridge)
{
	bridge_forget(&bridge->out);
	bridge_forget(&bridge->in);
	bridge->out_halted = false;
	bridge->in_halted = false;
	bridge->count = 0;
	bridge->held = false;
	bridge->burst_ended = false;
}

/* ---- OUT ---- */

/* The fault of a transfer that begins. */
static void bridge_begin(struct vboard_usb_bridge *bridge, struct vboard_usb_transfer *transfer)
{
	enum vboard_usb_fault fault = vboard_usb_faults_out(bridge->faults);

	transfer->begun = true;
	if (fault == VBOARD_USB_STALL)
		bridge->out_halted = true;
	if (fault == VBOARD_USB_LOSE)
		transfer->taken = transfer->bytes / 4;
}

/* Bytes at the end that fill no word are dropped. */
static bool bridge_out(struct vboard_usb_bridge *bridge)
{
	struct vboard_usb_transfer *transfer = bridge->out.first;
	uint32_t words, taken = 0;

	if (!transfer)
		return false;
	if (!transfer->begun && !bridge->out_halted)
		bridge_begin(bridge, transfer);
	if (bridge->out_halted) {
		bridge_end(bridge, transfer, VBOARD_USB_STALLED, NULL, 0);
		return true;
	}
	words = transfer->bytes / 4;
	if (transfer->taken < words)
		taken = bridge->ops->out(bridge->board, transfer->data + transfer->taken,
					 words - transfer->taken);
	transfer->taken += taken;
	if (transfer->taken < words)
		return taken;
	bridge_end(bridge, transfer, VBOARD_USB_DONE, NULL, transfer->bytes);
	return true;
}

/* ---- IN ---- */

static bool bridge_grow(struct vboard_usb_bridge *bridge, uint32_t words)
{
	uint32_t *word;

	if (words <= bridge->room)
		return true;
	word = realloc(bridge->word, 4 * (size_t)words);
	if (!word)
		return false;
	bridge->word = word;
	bridge->room = words;
	return true;
}

/* Takes words of the board until there are @wanted, its burst ends or it has no more. */
static bool bridge_take(struct vboard_usb_bridge *bridge, uint32_t wanted)
{
	uint32_t *word, count, may;
	bool moved = false;

	if (!bridge_grow(bridge, wanted))
		return false;
	while (bridge->count < wanted && !bridge->burst_ended &&
	       !vboard_usb_faults_hold(bridge->faults)) {
		word = bridge->word + bridge->count;
		count = bridge->ops->in(bridge->board, word, wanted - bridge->count,
					&bridge->burst_ended);
		if (!count)
			break;
		moved = true;
		may = vboard_usb_faults_words(bridge->faults, word, count);
		bridge->held = may < count;
		bridge->may = bridge->count + may;
		bridge->count += count;
	}
	return moved;
}

/*
 * Sends the first @words of those there are. Without a packet that is not full the host does not
 * see the end of the burst behind them, so then an empty one is still to come.
 */
static void bridge_send(struct vboard_usb_bridge *bridge, struct vboard_usb_transfer *transfer,
			uint32_t words)
{
	bool full = words && 4 * words == transfer->bytes &&
		    transfer->bytes % bridge->packet_bytes == 0;

	bridge_end(bridge, transfer, VBOARD_USB_DONE, bridge->word, 4 * words);
	if (words == bridge->count && !full)
		bridge->burst_ended = false;
	bridge->count -= words;
	bridge->may -= words;
	if (bridge->count)
		memmove(bridge->word, bridge->word + words, 4 * (size_t)bridge->count);
}

/* Ends a transfer for which there are @words. */
static void bridge_give(struct vboard_usb_bridge *bridge, struct vboard_usb_transfer *transfer,
			uint32_t words)
{
	switch (vboard_usb_faults_in(bridge->faults, words)) {
	case VBOARD_USB_STALL:
		bridge->in_halted = true;
		bridge_end(bridge, transfer, VBOARD_USB_STALLED, NULL, 0);
		break;
	case VBOARD_USB_EMPTY:
		bridge_end(bridge, transfer, VBOARD_USB_DONE, NULL, 0);
		break;
	case VBOARD_USB_SHORT:
		bridge_send(bridge, transfer, words / 2);
		break;
	default:
		bridge_send(bridge, transfer, words);
		break;
	}
}

/* A transfer ends as soon as it is full or has all up to the end of a burst. */
static bool bridge_in(struct vboard_usb_bridge *bridge)
{
	struct vboard_usb_transfer *transfer = bridge->in.first;
	uint32_t wanted, words;
	bool moved;

	if (!transfer)
		return false;
	if (bridge->in_halted) {
		bridge_end(bridge, transfer, VBOARD_USB_STALLED, NULL, 0);
		return true;
	}
	wanted = transfer->bytes / 4;
	moved = bridge_take(bridge, wanted);
	if (bridge->held && !vboard_usb_faults_hold(bridge->faults))
		bridge->held = false;
	if (!bridge->held)
		bridge->may = bridge->count;
	words = bridge->may < wanted ? bridge->may : wanted;
	if (words < wanted && !(bridge->burst_ended && words == bridge->count))
		return moved;
	bridge_give(bridge, transfer, words);
	return true;
}

bool vboard_usb_bridge_work(struct vboard_usb_bridge *bridge)
{
	bool moved = bridge_out(bridge);

	moved |= bridge->ops->work(bridge->board);
	moved |= bridge_in(bridge);
	return moved;
}

/* ---- registers ---- */

uint32_t vboard_usb_bridge_read(struct vboard_usb_bridge *bridge, uint32_t offset)
{
	return bridge->ops->read(bridge->board, offset);
}

void vboard_usb_bridge_write(struct vboard_usb_bridge *bridge, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL && (value & GLOSS_REG_CONTROL_RESET)) {
		vboard_usb_faults_reset(bridge->faults);
		if (bridge->held) {
			bridge->count = bridge->may;
			bridge->burst_ended = false;
			bridge->held = false;
		}
	}
	bridge->ops->write(bridge->board, offset, value);
}
