/* SPDX-License-Identifier: MIT */
/* A USB board at its cable: what the files of vboard-usb share. */
#ifndef VBOARD_VBOARD_USB_H
#define VBOARD_VBOARD_USB_H

#include <usbredirparser.h>

#include "vboard/loop.h"
#include "vboard/usb/bridge.h"
#include "vboard/usb/descriptors.h"
#include "vboard/usb/faults.h"

#define VBOARD_USB_READ_BYTES 4096u

struct vboard_usb {
	const char *name; /* for messages */
	const char *serial;
	bool super; /* speed, or high */
	struct vboard_loop loop;

	struct vboard_usb_faults faults;
	struct vboard_usb_bridge bridge;
	bool sink_halted, source_halted, event_halted;
	uint8_t configuration;

	/* The cable. */
	struct usbredirparser *parser;
	bool plugged;
	bool leaving;                   /* pulled, and the host does not know it yet */
	uint64_t replug;                /* when it is plugged in again; UINT64_MAX: never */
	bool listening;                 /* the host takes events */
	struct vboard_usb_queue source; /* transfers of the plain source */
	int end;                        /* what serve() is to return, if not 1 */

	/* What was received and not parsed yet, and how much may be received now. */
	uint8_t read[VBOARD_USB_READ_BYTES];
	uint32_t read_at, read_count, read_budget;

	uint64_t requests;            /* of registers */
	uint64_t out_bytes, in_bytes; /* of the port */
	uint64_t events;
};

/* ---- control.c: the control endpoint ---- */

/*
 * Does what a request asks; @data is what it brought, @answer has room for
 * VBOARD_USB_DESCRIPTOR_MAX bytes. The length of the answer; -1: the request is stalled.
 */
int vboard_usb_control(struct vboard_usb *usb, const struct usb_redir_control_packet_header *head,
		       const uint8_t *data, uint8_t *answer);

/* SET_CONFIGURATION; false: there is no such configuration. */
bool vboard_usb_configure(struct vboard_usb *usb, uint8_t configuration);
/* SET_INTERFACE; false: there is no such setting. */
bool vboard_usb_set_interface(struct vboard_usb *usb, uint8_t interface, uint8_t setting);

/* ---- transfers.c: the endpoints ---- */

void vboard_usb_take_transfers(struct usbredirparser *parser);
/* The bridge's ->ended, whose user is the vboard_usb. */
void vboard_usb_ended(void *user, const struct vboard_usb_transfer *transfer,
		      enum vboard_usb_status status, void *data, uint32_t bytes);
/* Ends the first transfer of the plain source; false: there is none. */
bool vboard_usb_pour(struct vboard_usb *usb);
/* Sends the events there are, if the host takes them. */
void vboard_usb_tell_events(struct vboard_usb *usb);

/* ---- refuse.c: what such a device does not have ---- */

void vboard_usb_refuse_others(struct usbredirparser *parser);

/* ---- door.c: the cable ---- */

/* Does so much wait for the host to read it that nothing more is to be done for it? */
bool vboard_door_usb_full(const struct vboard_usb *usb);
void vboard_door_usb_unplug(struct vboard_usb *usb);

/*
 * Plugs it in, once the host is there: ->name, ->serial, ->super, ->loop.socket, ->faults and
 * ->bridge, as far as its ops and its board, are set. False: out of memory.
 */
bool vboard_door_usb_init(struct vboard_usb *usb);
void vboard_door_usb_fini(struct vboard_usb *usb);

/* Its side of the loop, whose data is the vboard_usb. */
extern const struct vboard_loop_ops vboard_door_usb_loop;

#endif
