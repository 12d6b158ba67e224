// SPDX-License-Identifier: MIT
#include <stdlib.h>

#include "vboard/usb/bridge.h"

void vboard_usb_queue_init(struct vboard_usb_queue *queue)
{
	*queue = (struct vboard_usb_queue){ .end = &queue->first };
}

bool vboard_usb_queue_add(struct vboard_usb_queue *queue,
			  const struct vboard_usb_transfer *transfer)
{
	uint32_t out_bytes = transfer->data ? transfer->bytes : 0;
	struct vboard_usb_transfer *copy;

	if (queue->count == VBOARD_USB_TRANSFERS ||
	    out_bytes > VBOARD_USB_WAITING_MAX - queue->out_bytes)
		return false;
	copy = malloc(sizeof(*copy));
	if (!copy)
		return false;
	*copy = *transfer;
	copy->next = NULL;
	*queue->end = copy;
	queue->end = &copy->next;
	queue->count++;
	queue->out_bytes += out_bytes;
	return true;
}

struct vboard_usb_transfer *vboard_usb_queue_find(struct vboard_usb_queue *queue, uint64_t id)
{
	struct vboard_usb_transfer *transfer = queue->first;

	while (transfer && transfer->id != id)
		transfer = transfer->next;
	return transfer;
}

void vboard_usb_queue_remove(struct vboard_usb_queue *queue, struct vboard_usb_transfer *transfer)
{
	struct vboard_usb_transfer **link = &queue->first;

	while (*link != transfer)
		link = &(*link)->next;
	*link = transfer->next;
	if (!transfer->next)
		queue->end = link;
	queue->count--;
	queue->out_bytes -= transfer->data ? transfer->bytes : 0;
	free(transfer->data);
	free(transfer);
}
