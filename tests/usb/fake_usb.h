/* SPDX-License-Identifier: MIT */
/*
 * A libusb-1.0 in this process, and boards on its bus: linked in place of the real one. What
 * libusb promises, and no more, holds here: callbacks come only while somebody handles events,
 * from whichever thread does, also from one in a synchronous call; a cancelled transfer may
 * have moved bytes, or end as if it had not been cancelled; IN ends with a short packet.
 *
 * The bridge turns transfers into the words of a struct gloss_usb_board_ops. How it cuts them
 * into packets, how much it holds, and how far each side gets before the other moves follows
 * from the seed. The board works while somebody handles events.
 *
 * A call that the real library forbids, or that loses something, is said on stderr and ends
 * the process: a transfer submitted twice or freed in flight, an interface not claimed, an
 * object used after its end or left behind. It allocates nothing after the start.
 *
 * Link $(FAKE_USB_OBJS) with $(FAKE_USB_LDFLAGS), which give the library the clock below.
 */
#ifndef FAKE_USB_H
#define FAKE_USB_H

#include <stdbool.h>
#include <stdint.h>
#include <libusb.h>

#include "vboard/board/usb.h"

#define FAKE_USB_BOARDS 3
#define FAKE_USB_ENDPOINTS 8
#define FAKE_USB_BOARD_BYTES (4u << 20)

/* A board; the bus has it while @present. Set it up while no host looks. */
struct fake_usb_board {
	const struct gloss_usb_board_ops *ops; /* used when it is first plugged in */
	bool present;
	bool foreign;       /* another program has claimed interface 0 */
	bool kernel_driver; /* a driver of the kernel has it */
	int open_error;     /* of libusb_open; 0: it opens */
	enum libusb_speed speed;
	uint16_t vendor, product;
	const char *manufacturer_text, *product_text, *serial; /* NULL: it has none */

	/* Its configuration; endpoints are those of interface 0. */
	uint8_t interfaces, interface_class, interface_subclass, interface_protocol;
	uint8_t endpoints;
	struct {
		uint8_t address, attributes;
		uint16_t packet_bytes;
	} endpoint[FAKE_USB_ENDPOINTS];
};

/* What can happen on the cable of a board. The @at-th is counted from arming, from 1. */
enum fake_usb_fault {
	FAKE_USB_NO_FAULT,
	FAKE_USB_UNPLUG,    /* at the at-th packet of any endpoint, control too; @value
					 * 1: and plugged in at once, 2: with power lost */
	FAKE_USB_KILL,      /* so, but for the host: its board stays as it is */
	FAKE_USB_GLITCH,    /* so, but the board is in its power-on state again, and
					 * its memory as it comes */
	FAKE_USB_BUS_RESET, /* so, but another program resets the device: what is in
					 * flight ends, and the claim is lost, which only the
					 * kernel knows */
	FAKE_USB_STALL_OUT, /* the at-th transfer; the endpoint is halted */
	FAKE_USB_STALL_IN,
	FAKE_USB_STALL_EVENT,
	FAKE_USB_ERROR_OUT, /* the at-th transfer ends with LIBUSB_TRANSFER_ERROR */
	FAKE_USB_ERROR_IN,
	FAKE_USB_OVERFLOW_IN,
	FAKE_USB_LOSE_OUT, /* the at-th transfer is taken and its words dropped */
	FAKE_USB_LOSE_IN,  /* the at-th packet */
	FAKE_USB_REPEAT_IN,
	FAKE_USB_SHORT_IN,   /* the at-th packet comes in two halves */
	FAKE_USB_EMPTY_IN,   /* empty packets, @value of them, before the at-th */
	FAKE_USB_ODD_IN,     /* the at-th packet's last word lacks 1 to 3 bytes */
	FAKE_USB_GARBAGE_IN, /* the at-th word and the @value after it */
	FAKE_USB_GARBAGE_OUT,
	FAKE_USB_GARBAGE_EVENT,  /* an event that the board did not send, now */
	FAKE_USB_HANG_IN,        /* from the at-th word on, until CONTROL.reset */
	FAKE_USB_HANG_OUT,       /* no word is taken any more, likewise */
	FAKE_USB_REFUSE_CONTROL, /* the at-th request and the @value after it are stalled */
	FAKE_USB_HANG_CONTROL,   /* those are not answered */
	FAKE_USB_RESET_LASTS,    /* CONTROL.reset reads 1 @value times, until when it
					 * has not been done, and writes are lost */
	FAKE_USB_DELAY,          /* each end comes @value us later, from now on */
	FAKE_USB_FAULTS
};

/* Boards are the test's to set; counts are to be read, at any time. */
struct fake_usb {
	struct fake_usb_board board[FAKE_USB_BOARDS];

	unsigned int calls; /* that can fail */
	unsigned int submits, callbacks;
	unsigned int control_submits;     /* of these, for registers */
	unsigned int depth_out, depth_in; /* most transfers in flight at once */
	unsigned int resets;              /* CONTROL.reset written */
	unsigned int implicit_claims;     /* that the kernel made, with a warning in its log */
	unsigned int fired;               /* faults that have come, those of calls too */
	uint64_t out_words, in_words;

	/* That are there now. */
	unsigned int contexts, lists, devices, configurations, handles, claims, transfers,
		in_flight, hotplug_callbacks;
};

extern struct fake_usb fake_usb;

/* One board with the C model, 64-pixel tiles, high speed and serial "VIRTUAL0"; all as new. */
void fake_usb_start(uint64_t seed);
/* Every object of libusb must be gone. */
void fake_usb_stop(void);

/* Arms one fault of @board; there may be several. */
void fake_usb_arm(unsigned int board, enum fake_usb_fault fault, uint64_t at, uint32_t value);
/* None is armed any more, and what did not end by itself has ended. */
void fake_usb_disarm(void);
/* fired, while threads of the library may be at work. */
unsigned int fake_usb_fired(void);
const char *fake_usb_fault_name(enum fake_usb_fault fault);

/*
 * The @at-th call of @function from now on does nothing but answer @error, LIBUSB_ERROR_*;
 * @function NULL: of any that can fail. libusb_alloc_transfer and a list then give nothing.
 */
void fake_usb_fail(const char *function, unsigned int at, int error);

/* Each call of @function answers @error from now on, until that is disarmed. */
void fake_usb_fail_always(const char *function, int error);

/* The kernel has so many bytes for transfers in flight; 0: as many as there may be. */
void fake_usb_limit_memory(size_t bytes);
/* Submits but for registers, which are looked at as time passes. */
unsigned int fake_usb_bulk_submits(void);
/* Most IN transfers that were in flight at once since it was asked the last time. */
unsigned int fake_usb_take_depth_in(void);

/* The cable, at once. Board memory and the state of the port stay, or with @power do not. */
void fake_usb_unplug(unsigned int board);
void fake_usb_plug(unsigned int board, bool power);
/* The host dies: nothing of it reaches the board any more, and the board is free for another.
 * To what is left of the host in this process the board is unplugged. */
void fake_usb_kill(void);

/* The boards do not work until they are let go; transfers are taken as far as they have room. */
void fake_usb_hold(void);
void fake_usb_release(void);

/* The memory of a board, FAKE_USB_BOARD_BYTES; not while a host uses it. */
uint8_t *fake_usb_memory(unsigned int board);

/*
 * Time. It passes, slower than outside, and leaps to the next moment that anybody waits for as soon
 * as all threads of this process sleep: so time-outs take no time, and a busy machine makes no
 * difference. While the boards are held it leaps only for who sleeps here, by nanosleep, usleep or
 * fake_usb_rest(). The linker puts the first two, clock_gettime, pthread_cond_timedwait and
 * pthread_cond_clockwait here.
 */
void fake_usb_rest(unsigned int ms);
int64_t fake_usb_now_ns(void);
/* By how much it has leapt in all. */
int64_t fake_usb_leapt_ns(void);

#endif
