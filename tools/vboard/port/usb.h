/* SPDX-License-Identifier: MIT */
/*
 * The C model of the USB port: channels, messages and events as rtl/gloss.xml has them
 * under bus usb. It has words of a job only as long as they wait for their turn.
 */
#ifndef VBOARD_PORT_USB_H
#define VBOARD_PORT_USB_H

#include "vboard/port/base.h"

#define PORT_USB_FIFO_WORDS 8192u /* a power of 2 */
#define PORT_USB_EVENTS 4u

/* What the port does with the next word of OUT. */
enum port_usb_state {
	PORT_USB_UNSYNCHRONISED,
	PORT_USB_READY, /* a job begins with it */
	PORT_USB_HEAD,  /* it is of the job's head or slots */
	PORT_USB_RUNNING,
	PORT_USB_CHECKING, /* it is the job's checksum */
	PORT_USB_ENDING,   /* not looked at: the job's completion is to be sent */
	PORT_USB_LOST,
};

struct port_usb_fifo {
	uint32_t first, count;
	uint32_t word[PORT_USB_FIFO_WORDS];
};

struct port_usb {
	struct port_base base; /* STATUS is made when it is read */
	enum port_usb_state state;
	struct port_usb_fifo out, in;
	bool burst_end[PORT_USB_FIFO_WORDS]; /* of in's words: the last of a burst */

	/* The last words of OUT, a usb_sync perhaps; or a job's, its slots behind its head. */
	uint32_t head[GLOSS_USB_JOB_WORDS + GLOSS_SLOTS * GLOSS_SLOT_ENTRY_WORDS];
	uint32_t head_count;

	/* The job under way. */
	uint32_t stream_left;                /* words that are not yet in the window */
	bool refused;                        /* by the engine: its words are dropped */
	uint32_t answer_first, answer_count; /* words in base.answer that are in no chunk */
	uint32_t chunk[GLOSS_USB_RESPONSE_WORDS + GLOSS_USB_CHUNK_WORDS];
	uint32_t chunk_count;               /* words behind its header */
	uint32_t out_checksum, in_checksum; /* of what has passed of the job, of its answer */

	uint32_t event[PORT_USB_EVENTS][GLOSS_USB_EVENT_WORDS];
	uint32_t events;
};

/* Power on: fills all of @port. */
void port_usb_init(struct port_usb *port, const struct port_engine *engine,
		   const struct port_build *build);

/* As those of struct gloss_usb_board_ops: port_usb_reset is power on, too. */
uint32_t port_usb_read(const struct port_usb *port, uint32_t offset);
void port_usb_write(struct port_usb *port, uint32_t offset, uint32_t value);
uint32_t port_usb_out(struct port_usb *port, const uint32_t *words, uint32_t count);
uint32_t port_usb_in(struct port_usb *port, uint32_t *words, uint32_t room, bool *flush);
bool port_usb_event(struct port_usb *port, uint32_t words[GLOSS_USB_EVENT_WORDS]);
bool port_usb_work(struct port_usb *port);
void port_usb_reset(struct port_usb *port);

#endif
