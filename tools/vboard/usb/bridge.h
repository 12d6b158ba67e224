/* SPDX-License-Identifier: MIT */
/*
 * The bridge of a USB board: bulk transfers of the host on one side, the words of the board's two
 * channels on the other. It holds transfers until they end, in the order in which they came.
 *
 * An IN transfer ends when it is full, or where the board ends a burst: then the last packet is a
 * short one, or an empty one if nothing is left over. Words that no transfer has taken wait.
 */
#ifndef VBOARD_USB_BRIDGE_H
#define VBOARD_USB_BRIDGE_H

#include "vboard/board/usb.h"
#include "vboard/usb/faults.h"

#define VBOARD_USB_TRANSFER_MAX (16u << 20) /* bytes */
#define VBOARD_USB_TRANSFERS 1024u          /* that wait, of an endpoint */
#define VBOARD_USB_WAITING_MAX (64u << 20)  /* bytes that wait to go OUT */

struct vboard_usb_transfer {
	struct vboard_usb_transfer *next;
	uint64_t id; /* the host's */
	uint8_t endpoint;
	uint32_t bytes; /* there are of OUT, or is room for of IN */
	uint32_t *data; /* of OUT, malloc'ed; NULL of IN */
	bool begun;     /* of OUT */
	uint32_t taken; /* words of OUT that the board has */
};

struct vboard_usb_queue {
	struct vboard_usb_transfer *first, **end;
	uint32_t count;
	uint32_t out_bytes; /* of all transfers' data */
};

enum vboard_usb_status { VBOARD_USB_DONE, VBOARD_USB_STALLED, VBOARD_USB_CANCELLED };

struct vboard_usb_bridge {
	const struct gloss_usb_board_ops *ops;
	struct gloss_usb_board *board;
	struct vboard_usb_faults *faults;
	uint32_t packet_bytes;
	/* A transfer has ended; @data is what an IN transfer got. */
	void (*ended)(void *user, const struct vboard_usb_transfer *transfer,
		      enum vboard_usb_status status, void *data, uint32_t bytes);
	void *user;

	struct vboard_usb_queue out, in;
	bool out_halted, in_halted;

	/* Words of IN on their way to the host. */
	uint32_t *word;
	uint32_t room, count;
	uint32_t may; /* how many of them may leave while the faults hold the rest */
	bool held;
	bool burst_ended; /* behind the last of them */
};

/* ->ops, ->board, ->faults, ->packet_bytes, ->ended and ->user are set, the rest is 0. */
void vboard_usb_bridge_init(struct vboard_usb_bridge *bridge);
void vboard_usb_bridge_fini(struct vboard_usb_bridge *bridge);

/*
 * A transfer of an endpoint of the port: @data, malloc'ed and the bridge's from now, if it is
 * OUT. False: it is too long, or too many wait: it was not taken, nor was @data.
 */
bool vboard_usb_bridge_submit(struct vboard_usb_bridge *bridge, uint64_t id, uint8_t endpoint,
			      uint32_t *data, uint32_t bytes);
/* Ends it as cancelled, if it is here. */
void vboard_usb_bridge_cancel(struct vboard_usb_bridge *bridge, uint64_t id);

/* A step of all that can move. False: nothing does, until a transfer or register access, or due. */
bool vboard_usb_bridge_work(struct vboard_usb_bridge *bridge);

/* Registers of the board. */
uint32_t vboard_usb_bridge_read(struct vboard_usb_bridge *bridge, uint32_t offset);
void vboard_usb_bridge_write(struct vboard_usb_bridge *bridge, uint32_t offset, uint32_t value);

/* Whether it is halted; NULL: no bulk endpoint of the port. */
bool *vboard_usb_bridge_halted(struct vboard_usb_bridge *bridge, uint8_t endpoint);

/* The cable is pulled, or the host begins anew: transfers are forgotten, and words of IN. */
void vboard_usb_bridge_drop(struct vboard_usb_bridge *bridge);

/* Queues; first is NULL if one is empty. */
void vboard_usb_queue_init(struct vboard_usb_queue *queue);
/* False: out of memory, or too many. */
bool vboard_usb_queue_add(struct vboard_usb_queue *queue,
			  const struct vboard_usb_transfer *transfer);
/* NULL: it is not there. A host may well give an id twice: this is the first one. */
struct vboard_usb_transfer *vboard_usb_queue_find(struct vboard_usb_queue *queue, uint64_t id);
/* It is in the queue; frees it, and its data. */
void vboard_usb_queue_remove(struct vboard_usb_queue *queue, struct vboard_usb_transfer *transfer);

#endif
