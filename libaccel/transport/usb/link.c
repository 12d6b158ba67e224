// SPDX-License-Identifier: MIT
/* Jobs of a link, and its thread. */
#include <errno.h>
#include <stdlib.h>
#include <time.h>

#include "gloss_regs.h"
#include "transport/thread.h"
#include "transport/usb/link_priv.h"

#define NS_PER_MS 1000000

/* With as much in memory to be sent, a further job waits: more would not be sent any sooner. */
#define QUEUED_MAX (4u << 20)

/* A board that has failed so often, and done no job meanwhile, is of no use. */
#define FAILURES_MAX 16

#define MEMORY_PAUSE_MS 250

/* When the thread has seen no job for a while, it looks no more, but is called. */
#define SLEEP_MS 60000

/* ---- jobs ---- */

struct accel_usb_job *accel_usb_job_new(struct accel_usb_link *link, size_t words)
{
	struct accel_usb_job *job = malloc(sizeof(*job));

	if (!job)
		return NULL;
	*job = (struct accel_usb_job){ .message = accel_usb_pool_get(&link->pool, words) };
	if (!job->message) {
		free(job);
		return NULL;
	}
	job->bytes = words * sizeof(uint32_t);
	return job;
}

void accel_usb_job_free(struct accel_usb_link *link, struct accel_usb_job *job)
{
	accel_usb_pool_put(&link->pool, job->message);
	free(job);
}

/* The functions from here on are called with the lock held. */
/* Jobs end nearly in their order, so it is among the first. */
static void link_remove(struct accel_usb_link *link, const struct accel_usb_job *job)
{
	struct accel_usb_job **at = &link->first;

	while (*at != job)
		at = &(*at)->next;
	*at = job->next;
	if (!job->next)
		link->last = at;
}

static void job_end(struct accel_usb_link *link, struct accel_usb_job *job, int error)
{
	link_remove(link, job);
	job->ended = true;
	job->error = error;
	link->running--;
	if (!error && !job->must)
		link->failures = 0;
	if (job->forgotten) {
		accel_job_table_take(&link->jobs, &job->entry);
		accel_usb_job_free(link, job);
	} else {
		pthread_cond_broadcast(&link->ended);
	}
}

void accel_usb_link_job_moved(struct accel_usb_link *link, struct accel_usb_job *job)
{
	if (job->sent == job->bytes) {
		accel_usb_pool_put(&link->pool, job->message);
		job->message = NULL;
		if (job->answered)
			job_end(link, job, 0);
	}
	if (link->waiting && link->queued < QUEUED_MAX)
		pthread_cond_broadcast(&link->room);
}

/* Nothing of them is in flight any more. */
static void link_lose(struct accel_usb_link *link, int error)
{
	while (link->first)
		job_end(link, link->first, error);
	link->sending = link->answering = NULL;
	link->queued = 0;
	link->losses++;
	pthread_cond_broadcast(&link->room);
}

/* After a sync: what was before it is lost, and jobs are sent again. With the lock held. */
static void link_begin(struct accel_usb_link *link)
{
	link_lose(link, link->broken_by);
	if (link->state == USB_LINK_STARTING)
		link->state = USB_LINK_READY;
}

/* ---- the thread ---- */

/* With the lock held. It may be where it waits for events, or about to. */
static void link_wake(struct accel_usb_link *link)
{
	link->asleep = false;
	libusb_interrupt_event_handler(link->node->context);
}

void accel_usb_link_break(struct accel_usb_link *link, int err)
{
	if (link->state < USB_LINK_BROKEN) {
		link->state = USB_LINK_BROKEN;
		link->broken_by = err;
	}
	if (err == -ENODEV)
		link->state = USB_LINK_GONE;
	if (link->asleep)
		link_wake(link);
}

/* With the lock held, which it gives up meanwhile. The board is well, and will be tried again. */
static void link_wait_for_memory(struct accel_usb_link *link)
{
	const struct timespec pause = { 0, MEMORY_PAUSE_MS * NS_PER_MS };

	link_lose(link, -ENOMEM);
	pthread_mutex_unlock(&link->lock);
	nanosleep(&pause, NULL);
	pthread_mutex_lock(&link->lock);
}

/*
 * With the lock held, which it gives up meanwhile. What has become of the jobs is only known when
 * the board works again, or is gone: that a cable is unplugged can look like any error at first.
 */
static void link_recover(struct accel_usb_link *link)
{
	int err;

	if (link->broken_by == -ENOMEM)
		accel_usb_transfers_less(link);
	else
		accel_usb_transfers_most(link);
	pthread_mutex_unlock(&link->lock);
	err = accel_usb_link_drain(link) ? accel_usb_link_sync(link) : -ENODEV;
	pthread_mutex_lock(&link->lock);
	if (err == -ENOMEM)
		link_wait_for_memory(link);
	else if (err || ++link->failures >= FAILURES_MAX)
		link->state = USB_LINK_GONE;
	else
		link_begin(link);
}

/* Likewise. */
static void link_handle(struct accel_usb_link *link)
{
	int ms;

	accel_usb_transfers_send(link);
	ms = accel_usb_link_watch(link);
	if (link->state != USB_LINK_READY)
		return;
	link->asleep = !ms;
	pthread_mutex_unlock(&link->lock);
	accel_usb_transfers_handle(link, ms ? ms : SLEEP_MS);
	pthread_mutex_lock(&link->lock);
	link->asleep = false;
}

static void *link_thread(void *argument)
{
	struct accel_usb_link *link = argument;

	pthread_mutex_lock(&link->lock);
	while (!link->stop && link->state != USB_LINK_GONE) {
		if (link->state == USB_LINK_BROKEN)
			link_recover(link);
		else
			link_handle(link);
	}
	link->state = USB_LINK_GONE;
	pthread_mutex_unlock(&link->lock);
	accel_usb_link_drain(link);
	pthread_mutex_lock(&link->lock);
	link_lose(link, -ENODEV);
	pthread_mutex_unlock(&link->lock);
	return NULL;
}

/* ---- life ---- */

static void link_init_locks(struct accel_usb_link *link)
{
	pthread_mutex_init(&link->lock, NULL);
	pthread_mutex_init(&link->clocks.lock, NULL);
	pthread_cond_init(&link->room, NULL);
	accel_thread_condition_init(&link->ended);
	accel_usb_pool_init(&link->pool);
}

/* But for one whose transfers are in flight for ever. */
static void link_destroy(struct accel_usb_link *link)
{
	if (link->node->stuck)
		return;
	accel_usb_transfers_fini(link);
	accel_job_table_fini(&link->jobs, NULL);
	accel_usb_pool_fini(&link->pool);
	pthread_cond_destroy(&link->ended);
	pthread_cond_destroy(&link->room);
	pthread_mutex_destroy(&link->clocks.lock);
	pthread_mutex_destroy(&link->lock);
	free(link);
}

int accel_usb_link_new(struct accel_usb_node *node, struct accel_usb_link **out)
{
	struct accel_usb_link *link = calloc(1, sizeof(*link));
	int err;

	if (!link)
		return -ENOMEM;
	link->node = node;
	link->last = &link->first;
	accel_job_table_init(&link->jobs);
	accel_usb_transfers_most(link);
	link_init_locks(link);
	err = accel_usb_transfers_init(link);
	if (!err)
		err = accel_usb_link_sync(link);
	if (err)
		goto err_destroy;
	link_begin(link);
	err = accel_thread_new(&link->thread, link_thread, link);
	if (err)
		goto err_drain;
	*out = link;
	return 0;

err_drain:
	pthread_mutex_lock(&link->lock);
	link->state = USB_LINK_GONE;
	pthread_mutex_unlock(&link->lock);
	accel_usb_link_drain(link);
err_destroy:
	link_destroy(link);
	return err;
}

void accel_usb_link_free(struct accel_usb_link *link)
{
	pthread_mutex_lock(&link->lock);
	link->stop = true;
	link_wake(link);
	pthread_mutex_unlock(&link->lock);
	pthread_join(link->thread, NULL);
	link_destroy(link);
}

bool accel_usb_link_is_gone(struct accel_usb_link *link)
{
	bool gone;

	pthread_mutex_lock(&link->lock);
	gone = link->state == USB_LINK_GONE;
	pthread_mutex_unlock(&link->lock);
	return gone;
}

const char *accel_usb_link_why(struct accel_usb_link *link, int err)
{
	const char *why = "the board is unplugged, or does not answer";

	if (err == -ENOMEM)
		return USB_NO_MEMORY;
	if (err != -ENODEV)
		return NULL;
	pthread_mutex_lock(&link->lock);
	if (link->node->stuck)
		why = "transfers on USB do not end";
	else if (link->powerless)
		why = "the board has lost its power, and what its memory held; open it again";
	else if (link->failures >= FAILURES_MAX)
		why = "the board fails again and again";
	pthread_mutex_unlock(&link->lock);
	return why;
}

/* ---- submitting ---- */

uint64_t accel_usb_link_losses(struct accel_usb_link *link)
{
	uint64_t losses;

	pthread_mutex_lock(&link->lock);
	losses = link->losses;
	pthread_mutex_unlock(&link->lock);
	return losses;
}

void accel_usb_link_wait_for_room(struct accel_usb_link *link)
{
	pthread_mutex_lock(&link->lock);
	link->waiting++;
	while (link->state != USB_LINK_GONE && link->queued >= QUEUED_MAX)
		pthread_cond_wait(&link->room, &link->lock);
	link->waiting--;
	pthread_mutex_unlock(&link->lock);
}

/* With the lock held. */
static void link_append(struct accel_usb_link *link, struct accel_usb_job *job)
{
	accel_job_table_put(&link->jobs, &job->entry, ++link->sequence);
	job->answer.sequence = job->message->word[GLOSS_USB_JOB_SEQUENCE_WORD] =
		(uint32_t)link->sequence;
	*link->last = job;
	link->last = &job->next;
	if (!link->sending)
		link->sending = job;
	if (!link->answering)
		link->answering = job;
	link->queued += job->bytes;
	link->running++;
	link->moves++;
	accel_usb_transfers_send(link);
	if (link->asleep)
		link_wake(link);
}

int accel_usb_link_submit(struct accel_usb_link *link, struct accel_usb_job *job,
			  uint64_t losses, uint64_t *sequence)
{
	int err = 0;

	pthread_mutex_lock(&link->lock);
	if (link->state == USB_LINK_GONE)
		err = -ENODEV;
	else if (link->losses != losses)
		err = -EAGAIN;
	if (!err) {
		link_append(link, job);
		*sequence = link->sequence;
	}
	pthread_mutex_unlock(&link->lock);
	return err;
}

/* ---- waiting ---- */

int64_t accel_usb_link_now_ms(void)
{
	return accel_thread_now_ns() / NS_PER_MS;
}

/* The job's result, of which nothing is kept. */
static int job_result(struct accel_usb_link *link, struct accel_usb_job *job,
		      struct gloss_status *status)
{
	int err = job->error;

	*status = (struct gloss_status){ .cause = GLOSS_FAULT_NONE };
	if (!err)
		*status = job->answer.status;
	accel_usb_job_free(link, job);
	return err;
}

int accel_usb_link_wait(struct accel_usb_link *link, uint64_t sequence, int64_t timeout_ns,
			struct gloss_status *status)
{
	struct accel_usb_job *job;
	int err = -EINVAL;

	pthread_mutex_lock(&link->lock);
	job = (struct accel_usb_job *)accel_job_table_find(&link->jobs, sequence);
	if (job)
		err = accel_thread_wait(&link->ended, &link->lock, &job->ended, timeout_ns);
	if (!err)
		accel_job_table_take(&link->jobs, &job->entry);
	pthread_mutex_unlock(&link->lock);
	return err ? err : job_result(link, job, status);
}

void accel_usb_link_forget(struct accel_usb_link *link, uint64_t sequence)
{
	struct accel_usb_job *job;

	pthread_mutex_lock(&link->lock);
	job = (struct accel_usb_job *)accel_job_table_find(&link->jobs, sequence);
	if (job->ended) {
		accel_job_table_take(&link->jobs, &job->entry);
		accel_usb_job_free(link, job);
	} else {
		job->forgotten = true;
	}
	pthread_mutex_unlock(&link->lock);
}
