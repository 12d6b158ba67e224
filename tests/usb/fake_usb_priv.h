/* SPDX-License-Identifier: MIT */
/*
 * What the files of fake_usb.h share: the bus in fake_usb.c, time in fake_usb_clock.c, who
 * sleeps meanwhile in fake_usb_idle.c; devices
 * in fake_usb_device.c, fake_usb_descriptor.c and, opened, fake_usb_handle.c; transfers and events
 * in fake_usb_transfer.c, calls made of these in fake_usb_sync.c; the cable in fake_usb_bridge.c,
 * and words on it in fake_usb_channel.c.
 */
#ifndef FAKE_USB_PRIV_H
#define FAKE_USB_PRIV_H

#include <pthread.h>

#include "fake_usb.h"

#define FAKE_CONTEXTS 8
#define FAKE_DEVICES 64
#define FAKE_HANDLES 16
#define FAKE_TRANSFERS 512
#define FAKE_INTERFACES 2
#define FAKE_PACKET_MAX 1024u
#define FAKE_PACKETS 4u      /* a power of 2; most that the bridge holds of IN */
#define FAKE_OUT_WORDS 1024u /* most that it holds of OUT */

enum fake_queue { FAKE_CONTROL, FAKE_OUT, FAKE_IN, FAKE_EVENT, FAKE_QUEUES };

struct libusb_context {
	bool used, dead; /* dead: its host was killed */
	bool handled;    /* somebody handles its events */
	pthread_t handler;
	bool interrupted;
};

struct libusb_device {
	unsigned int references; /* 0: not there */
	struct libusb_context *context;
	unsigned int board, plug; /* the plug-th time that it is on the bus */
	bool announced;           /* a hotplug callback has seen it */
};

struct libusb_device_handle {
	bool used;
	struct libusb_device *device;
	bool claimed[FAKE_INTERFACES]; /* as libusb knows */
	bool lost[FAKE_INTERFACES];    /* but the kernel does not */
};

enum fake_transfer_state {
	FAKE_FREE,
	FAKE_IDLE,   /* the caller's */
	FAKE_QUEUED, /* the bus's, bytes may move */
	FAKE_ENDED,  /* the bus's, until its callback is called */
};

struct fake_transfer {
	struct fake_transfer *next; /* in its queue, or of those ended */
	enum fake_transfer_state state;
	enum fake_queue queue;
	struct libusb_device_handle *handle; /* while not idle */
	bool cancelled;
	bool lost;        /* OUT: its words go nowhere */
	int64_t deadline; /* of its time-out; INT64_MAX: none */
	int64_t due;      /* when it is known that it has ended */
	struct libusb_transfer public;
};

struct fake_list {
	struct fake_transfer *first, **last;
};

/* A packet on its way in. */
struct fake_packet {
	uint32_t bytes;
	bool whole; /* nothing is put to it any more */
	uint8_t byte[FAKE_PACKET_MAX];
};

struct fake_bridge {
	const struct gloss_usb_board_ops *ops; /* those that made board */
	struct gloss_usb_board *board;
	unsigned int plug;
	bool present;
	unsigned int packet_bytes; /* most of a bulk packet */
	struct fake_list queue[FAKE_QUEUES];
	bool halted[FAKE_QUEUES];

	uint32_t out[FAKE_OUT_WORDS], out_first, out_count;
	struct fake_packet packet[FAKE_PACKETS];
	unsigned int packet_first, packet_count;
	bool empty_follows; /* a burst ended with a packet that was full */

	/* Faults: what is armed, and what has come. */
	uint64_t at[FAKE_USB_FAULTS];
	uint32_t value[FAKE_USB_FAULTS];
	uint32_t garbage_in, garbage_out, refusals, silences, resets_last, empties;
	bool hang_in, hang_out, garbage_event;
};

struct fake_state {
	/* Who has the ticket may touch everything here and in fake_usb; mutex is for the tickets. */
	pthread_mutex_t mutex;
	unsigned int ticket, next_ticket;
	pthread_cond_t turn, changed;
	uint64_t seed;
	struct fake_bridge bridge[FAKE_USB_BOARDS];
	struct fake_list ended;
	size_t bytes_in_flight, memory_limit;
	bool held;

	const char *fail_function; /* the fail_at-th call of it, 0: none */
	unsigned int fail_at;
	bool fail_always;
	int fail_error;
};

extern struct fake_state fake;

/* Fair. */
void fake_lock(void);
void fake_unlock(void);
/* Lets others have the lock, if there are any. */
void fake_give_way(void);
/* Without the lock, for changed, until @deadline or @due at most; see fake_clock_wait(). */
void fake_wait(int64_t deadline, int64_t due);
void fake_violation(const char *format, ...) __attribute__((format(printf, 1, 2), noreturn));
uint32_t fake_random(void);
uint32_t fake_below(uint32_t limit);
/* Counts a call of @function that can fail; 0, or the error that it is to answer. */
int fake_call(const char *function);

/* ---- time ---- */

void fake_clock_start(void);
void fake_clock_stop(void);
/*
 * Waits for @cond, until @deadline or @due (INT64_MAX: nothing is), whichever is first. Once all
 * sleep, time leaps to the first moment that anybody waits for; if the boards are held, for @due alone.
 */
void fake_clock_wait(pthread_cond_t *cond, pthread_mutex_t *mutex, int64_t deadline, int64_t due);
/* Time does not leap while the boards are held, but for who sleeps. */
void fake_clock_stand(bool value);
void fake_clock_leap(int64_t ns);
/* The bus has worked for a round. */
void fake_clock_round(void);

/* All threads but the caller and @clock. */
bool fake_all_others_sleep(long clock);

/* ---- devices; called with the lock held ---- */

struct libusb_device *fake_device_check(struct libusb_device *device, const char *function);
bool fake_device_alive(const struct libusb_device *device);
const struct fake_usb_board *fake_device_board(const struct libusb_device *device);
void fake_device_put(struct libusb_device *device);
struct fake_bridge *fake_handle_bridge(const struct libusb_device_handle *handle);
void fake_handle_check(const struct libusb_device_handle *handle, const char *function);
bool fake_handle_alive(const struct libusb_device_handle *handle);
/* The interface is used: a claim that was lost is made again, if nobody else has it now. */
void fake_handle_use(struct libusb_device_handle *handle, unsigned int interface,
		     const char *function);
/* All that are open on @board lose what they have claimed. */
void fake_handle_lose_claims(unsigned int board);
/* Ends everything of those hosts that are there now. */
void fake_device_kill(void);
/* Hotplug callbacks that are due in @context; gives up the lock for each. */
bool fake_device_announce(struct libusb_context *context);
struct libusb_context *fake_context_check(struct libusb_context *context, const char *function);

/* ---- transfers; called with the lock held ---- */

void fake_list_init(struct fake_list *list);
/* The transfer, which is in its queue, ends; its callback is due. */
void fake_transfer_end(struct fake_transfer *transfer, enum libusb_transfer_status status);
/* All of @handle (NULL: of all) on @bridge. */
void fake_transfer_end_all(struct fake_bridge *bridge, const struct libusb_device_handle *handle,
			   enum libusb_transfer_status status);
struct libusb_transfer *fake_transfer_new(void);
void fake_transfer_delete(struct libusb_transfer *public);
int fake_transfer_submit(struct libusb_transfer *public, const char *function);
/* Handles events once, or waits until *@completed. */
int fake_events(struct libusb_context *context, int64_t timeout_ns, int *completed);

/* ---- the cable; called with the lock held ---- */

void fake_bridge_start(struct fake_bridge *bridge, unsigned int number);
void fake_bridge_stop(struct fake_bridge *bridge);
/* Lets the boards and the transfers move; false: nothing does without the host, or time. */
bool fake_bridge_pump(void);
/* The at-th of @fault is now. */
bool fake_bridge_fault(struct fake_bridge *bridge, enum fake_usb_fault fault);
void fake_bridge_unplug(struct fake_bridge *bridge);
void fake_bridge_plug(struct fake_bridge *bridge, bool power);
/* A packet of any kind is about to move; false: not any more. */
bool fake_bridge_packet(struct fake_bridge *bridge);
uint32_t fake_get_word(const uint8_t *byte);
void fake_put_word(uint8_t *byte, uint32_t word);
/* A request that takes no transfer, as for a string: 0 or the error. */
int fake_bridge_request(struct fake_bridge *bridge);

/* A step each, of those that make up a round; false: nothing moved. */
bool fake_out_pump(struct fake_bridge *bridge);  /* transfers to the bridge */
bool fake_out_offer(struct fake_bridge *bridge); /* and to the port */
bool fake_in_take(struct fake_bridge *bridge);   /* from the port */
bool fake_in_pump(struct fake_bridge *bridge);   /* and to transfers */
bool fake_event_pump(struct fake_bridge *bridge);

#endif
