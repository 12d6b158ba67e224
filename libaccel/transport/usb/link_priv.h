/* SPDX-License-Identifier: MIT */
/* What the files of a link on USB know of each other. */
#ifndef ACCEL_USB_LINK_PRIV_H
#define ACCEL_USB_LINK_PRIV_H

#include "transport/usb/link.h"

/* In flight at once. OUT has no memory of its own, so it may be deeper, for small jobs. Transfers
 * are long, for each has its price. */
#define USB_OUT_TRANSFERS 8
#define USB_IN_TRANSFERS 4
#define USB_TRANSFER_BYTES (256u << 10)
/* When the kernel has no memory for such long ones, they are halved down to these. */
#define USB_OUT_BYTES_MIN (4u << 10)
#define USB_IN_BYTES_MIN (16u << 10)

/* With as much in memory to be sent, a further job waits: more would not be sent any sooner. */
#define USB_QUEUED_MAX (4u << 20)

/* A board that has failed so often, and done no job meanwhile, is of no use. */
#define USB_FAILURES_MAX 16

enum usb_link_state {
	USB_LINK_STARTING, /* the sync is on its way */
	USB_LINK_READY,
	USB_LINK_BROKEN, /* all that is in flight is to be ended */
	USB_LINK_GONE
};

struct usb_transfer {
	struct accel_usb_link *link;
	struct libusb_transfer *transfer;
	struct accel_usb_job *job; /* of OUT, NULL: the sync */
	bool in_flight;
	/* Of IN: */
	bool queued;               /* submitted, and its words not taken yet */
	bool ended;                /* and its turn has not come */
	bool gives_way;            /* it is cancelled, what it has is right */
	struct usb_transfer *next; /* submitted after it */
};

/* How long nothing has moved. */
struct usb_watch {
	int64_t next_ms;    /* when to look */
	unsigned int still; /* how often there was nothing to be seen */
	uint64_t moves;     /* of the link, at the last look */
	bool known;         /* PROGRESS was read since then */
	uint32_t progress;
	uint64_t spent; /* by how much it has moved since then */
};

/* What the board's counters have summed up to, though they begin again with each reset. */
struct usb_clocks {
	pthread_mutex_t lock; /* and of the node's handle, for who is not the thread */
	struct accel_device_clocks sum, last; /* last: as read, since the reset */
	int64_t next_ms;                      /* when they are to be read, before one wraps */
};

struct accel_usb_link {
	struct accel_usb_node *node;
	pthread_t thread;
	pthread_mutex_t lock; /* protects what follows */
	pthread_cond_t ended; /* a job has */
	pthread_cond_t room;  /* less is queued */
	bool stop;
	bool asleep; /* the thread may be, for long */
	enum usb_link_state state;
	int broken_by;  /* what jobs are told when it is broken */
	bool powerless; /* gone, because the board had lost its power */

	struct usb_transfer out[USB_OUT_TRANSFERS], in[USB_IN_TRANSFERS], event;
	unsigned int in_flight;
	struct usb_transfer *in_first, **in_last; /* in the order of their words */
	unsigned int in_queued;                   /* in there */
	unsigned int in_count;                    /* as many are to be */
	unsigned int in_bytes, out_bytes;         /* of one, at most */
	bool starved;                             /* no memory for a transfer that is needed */
	int64_t more_ms;                          /* when to try with more */
	uint32_t *in_words;                       /* the buffers of IN */
	uint32_t event_words[GLOSS_USB_EVENT_WORDS];
	uint32_t sync_words[GLOSS_USB_SYNC_WORDS];
	struct accel_pool pool; /* of struct accel_usb_buffer; has its own lock */
	bool halted_out, halted_in, halted_event;
	bool hint; /* the board says that it is lost */
	bool synchronised;
	struct accel_usb_parser parser;

	uint32_t boot; /* what the board's BOOT has to be; 0 at first */
	struct usb_watch watch;
	struct usb_clocks clocks; /* has its own lock */
	uint64_t sequence;        /* of the last job */
	uint64_t losses;
	unsigned int failures;               /* since a job of the program's was done */
	uint64_t moves;                      /* changes with each job and transfer that is of use */
	size_t queued;                       /* bytes that are not sent */
	unsigned int waiting;                /* threads, for less to be queued */
	unsigned int running;                /* jobs that have not ended */
	struct accel_job_table jobs;         /* until they were waited for */
	struct accel_usb_job *first, **last; /* that have not ended, in order */
	struct accel_usb_job *sending;       /* the first not started as a whole */
	struct accel_usb_job *answering;     /* the first not answered */
};

/*
 * Files from below to above; each calls those above it in this list. A function whose name ends in
 * _locked is called with link->lock held; where it gives that up meanwhile, it says so.
 */

/* link_state.c */
extern const struct accel_pool_kind accel_usb_buffer_kind;
/* The link has failed, as the jobs are to be told (-EIO, -ENOMEM), or is gone (-ENODEV). */
void accel_usb_link_break_locked(struct accel_usb_link *link, int err);
/* The thread may be where it waits for events, or about to. */
void accel_usb_link_wake_locked(struct accel_usb_link *link);
/* All of the job was sent, or answered. */
void accel_usb_link_job_moved_locked(struct accel_usb_link *link, struct accel_usb_job *job);
/* All jobs end with @error. Nothing of them is in flight any more. */
void accel_usb_link_lose_locked(struct accel_usb_link *link, int error);
/* After a sync: what was before it is lost, and jobs are sent again. */
void accel_usb_link_begin_locked(struct accel_usb_link *link);

/* transfer.c */
/* -ENOMEM: and some are there. */
int accel_usb_transfers_init(struct accel_usb_link *link);
void accel_usb_transfers_fini(struct accel_usb_link *link);
/* Begins to read, and sends a sync with @nonce. The link is starting. -ENOMEM: the kernel has none
 * for that. */
int accel_usb_transfers_start_locked(struct accel_usb_link *link, uint32_t nonce);
/* As many and as long ones as there may be are to be started next time, or about half of what was
 * started last; false: that was the least. */
void accel_usb_transfers_most_locked(struct accel_usb_link *link);
bool accel_usb_transfers_less_locked(struct accel_usb_link *link);
/* Twice as much may be in flight, if there is memory for that again. */
void accel_usb_transfers_more_locked(struct accel_usb_link *link);
/* Sends what can be sent of the jobs, and reads again where there was no memory for it. */
void accel_usb_transfers_send_locked(struct accel_usb_link *link);
void accel_usb_transfers_cancel_locked(struct accel_usb_link *link);
/* Without the lock: lets callbacks come, at most for a time. */
void accel_usb_transfers_handle(struct accel_usb_link *link, int ms);

/* clocks.c, in the thread, without the lock */
/* Adds what was counted since the last time, if the board says. */
void accel_usb_clocks_keep(struct accel_usb_link *link);
/* They begin again. */
void accel_usb_clocks_restart(struct accel_usb_link *link);

/* watch.c */
/* Breaks a link that stands still; milliseconds until it is to be called again, 0: when there is a
 * job. It gives the lock up while it asks the board. */
int accel_usb_watch_locked(struct accel_usb_link *link);

/* sync.c, without the lock */
/* Ends what is in flight. False: that can not be done, so what it uses must stay for ever. */
bool accel_usb_sync_drain(struct accel_usb_link *link);
/* Resets the board and finds the beginning of IN; the link is starting still. -EIO, -ENODEV,
 * -ENOMEM. */
int accel_usb_sync(struct accel_usb_link *link);

#endif
