// SPDX-License-Identifier: MIT
/* A link's sense of time: whether the board is at work, or has stopped for ever. */
#include <errno.h>

#include "gloss_regs.h"
#include "transport/thread.h"
#include "transport/usb/link_priv.h"

/* A board in which nothing has moved at this many looks, this far apart, has stopped. Looks are
 * counted, not time, because a machine that was stopped meanwhile has not looked. */
#define LOOKS 8
#define LOOK_MS 250
#define LOOKS_IDLE 4
#define CLOCKS_MS 5000
#define MORE_MS 1000

/* Words that PROGRESS has yet to count at most. */
static uint64_t watch_words(const struct accel_usb_link *link)
{
	const struct accel_usb_job *job;
	uint64_t words = 0;

	for (job = link->first; job; job = job->next)
		words += (uint64_t)job->answer.stream_words + job->answer.response_words;
	return words;
}

/* Whether PROGRESS has moved as that of a board at work does. */
static bool watch_progress(struct accel_usb_link *link, uint32_t progress)
{
	struct usb_watch *watch = &link->watch;
	uint32_t moved = progress - watch->progress;
	bool known = watch->known;

	watch->known = true;
	watch->progress = progress;
	if (!known || !moved || moved > watch_words(link) - watch->spent)
		return false;
	watch->spent += moved;
	return true;
}

/* Gives the lock up while the board is asked. */
static bool watch_ask_locked(struct accel_usb_link *link)
{
	uint64_t moves = link->moves;
	uint32_t progress;
	int err;

	pthread_mutex_unlock(&link->lock);
	err = accel_usb_node_read(link->node, GLOSS_REG_PROGRESS, &progress);
	pthread_mutex_lock(&link->lock);
	if (err == -ENODEV)
		accel_usb_link_break_locked(link, err);
	return link->moves != moves || (!err && watch_progress(link, progress));
}

/* Gives the lock up meanwhile. An event says that the channel is lost: the board knows. */
static void watch_hint_locked(struct accel_usb_link *link)
{
	uint32_t status;
	int err;

	link->hint = false;
	pthread_mutex_unlock(&link->lock);
	err = accel_usb_node_read(link->node, GLOSS_REG_STATUS, &status);
	pthread_mutex_lock(&link->lock);
	if (err != -ENOMEM && (err || status & GLOSS_REG_STATUS_LOST))
		accel_usb_link_break_locked(link, err ? err : -EIO);
}

static void watch_look_locked(struct accel_usb_link *link)
{
	struct usb_watch *watch = &link->watch;

	if (link->running && watch_ask_locked(link))
		watch->still = 0;
	else
		watch->still++;
	if (link->running && watch->still >= LOOKS)
		accel_usb_link_break_locked(link, link->starved ? -ENOMEM : -EIO);
}

/* Gives the lock up while it reads. Counters of 32 bits wrap while there is always a job. */
static void watch_clocks_locked(struct accel_usb_link *link, int64_t now)
{
	if (!link->running || now < link->clocks.next_ms)
		return;
	link->clocks.next_ms = now + CLOCKS_MS;
	pthread_mutex_unlock(&link->lock);
	accel_usb_clocks_keep(link);
	pthread_mutex_lock(&link->lock);
}

int accel_usb_watch_locked(struct accel_usb_link *link)
{
	struct usb_watch *watch = &link->watch;
	int64_t now = accel_thread_now_ms();

	if (link->hint)
		watch_hint_locked(link);
	watch_clocks_locked(link, now);
	if (now >= link->more_ms) {
		accel_usb_transfers_more_locked(link);
		link->more_ms = now + MORE_MS;
	}
	if (watch->moves != link->moves)
		*watch = (struct usb_watch){ .moves = link->moves, .next_ms = now + LOOK_MS };
	if (now >= watch->next_ms) {
		watch_look_locked(link);
		watch->next_ms = accel_thread_now_ms() + LOOK_MS;
	}
	return link->running || watch->still < LOOKS_IDLE ? LOOK_MS : 0;
}
