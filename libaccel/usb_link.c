// SPDX-License-Identifier: MIT
/* Jobs of a link, and its thread. */
#include <errno.h>
#include <stdlib.h>
#include <time.h>

#include "gloss_regs.h"
#include "thread.h"
#include "usb_link_priv.h"

#define MS_PER_S 1000
#define NS_PER_MS 1000000

/* With as much in memory to be sent, a further job waits: more would not be sent any sooner. */
#define QUEUED_MAX (4u << 20)

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
static void job_end(struct accel_usb_link *link, struct accel_usb_job *job, int error)
{
	job->ended = true;
	job->error = error;
	link->running--;
	pthread_cond_broadcast(&link->ended);
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
		pthread_cond_signal(&link->room);
}

/* Nothing of them is in flight any more. */
static void link_lose(struct accel_usb_link *link, int error)
{
	struct accel_usb_job *job;

	for (job = link->first; job; job = job->next)
		if (!job->ended)
			job_end(link, job, error);
	link->sending = link->answering = NULL;
	link->queued = 0;
	link->losses++;
	pthread_cond_broadcast(&link->room);
}

/* After a sync: what was before it is lost, and jobs are sent again. With the lock held. */
static void link_begin(struct accel_usb_link *link)
{
	link_lose(link, -EIO);
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
	if (err == -ENODEV)
		link->state = USB_LINK_GONE;
	else if (link->state < USB_LINK_BROKEN)
		link->state = USB_LINK_BROKEN;
	if (link->asleep)
		link_wake(link);
}

/*
 * With the lock held, which it gives up meanwhile. What has become of the jobs is only known when
 * the board works again, or is gone: that a cable is unplugged can look like any error at first.
 */
static void link_recover(struct accel_usb_link *link)
{
	int err;

	pthread_mutex_unlock(&link->lock);
	accel_usb_link_drain(link);
	err = accel_usb_link_sync(link);
	pthread_mutex_lock(&link->lock);
	if (err)
		link->state = USB_LINK_GONE;
	else
		link_begin(link);
}

/* Likewise. */
static void link_handle(struct accel_usb_link *link)
{
	int ms = accel_usb_link_watch(link);

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
	pthread_cond_init(&link->room, NULL);
	accel_thread_condition_init(&link->ended);
	accel_usb_pool_init(&link->pool);
}

static void link_destroy(struct accel_usb_link *link)
{
	accel_usb_transfers_fini(link);
	accel_usb_pool_fini(&link->pool);
	pthread_cond_destroy(&link->ended);
	pthread_cond_destroy(&link->room);
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

/* ---- submitting ---- */

uint64_t accel_usb_link_losses(struct accel_usb_link *link)
{
	uint64_t losses;

	pthread_mutex_lock(&link->lock);
	losses = link->losses;
	pthread_mutex_unlock(&link->lock);
	return losses;
}

/* With the lock held, which it gives up while it waits. */
static void link_wait_for_room(struct accel_usb_link *link)
{
	link->waiting = true;
	while (link->state != USB_LINK_GONE && link->queued >= QUEUED_MAX)
		pthread_cond_wait(&link->room, &link->lock);
	link->waiting = false;
}

/* With the lock held. */
static void link_append(struct accel_usb_link *link, struct accel_usb_job *job)
{
	job->sequence = ++link->sequence;
	job->answer.sequence = job->message->word[GLOSS_USB_JOB_SEQUENCE_WORD] =
		(uint32_t)job->sequence;
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
	link_wait_for_room(link);
	if (link->state == USB_LINK_GONE)
		err = -ENODEV;
	else if (link->losses != losses)
		err = -EAGAIN;
	if (!err) {
		link_append(link, job);
		*sequence = job->sequence;
	}
	pthread_mutex_unlock(&link->lock);
	return err;
}

/* ---- waiting ---- */

int64_t accel_usb_link_now_ms(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * (int64_t)MS_PER_S + now.tv_nsec / NS_PER_MS;
}

/* The link to the job, or NULL. With the lock held. */
static struct accel_usb_job **link_find(struct accel_usb_link *link, uint64_t sequence)
{
	struct accel_usb_job **at;

	for (at = &link->first; *at; at = &(*at)->next)
		if ((*at)->sequence == sequence)
			return at;
	return NULL;
}

/* Takes an ended job off the list. With the lock held. */
static struct accel_usb_job *link_take(struct accel_usb_link *link, uint64_t sequence)
{
	struct accel_usb_job **at = link_find(link, sequence);
	struct accel_usb_job *job = *at;

	*at = job->next;
	if (!job->next)
		link->last = at;
	return job;
}

int accel_usb_link_wait(struct accel_usb_link *link, uint64_t sequence, int64_t timeout_ns,
			struct gloss_status *status)
{
	struct accel_usb_job **at, *job = NULL;
	int err;

	pthread_mutex_lock(&link->lock);
	at = link_find(link, sequence);
	err = at ? accel_thread_wait(&link->ended, &link->lock, &(*at)->ended, timeout_ns) :
		   -EINVAL;
	if (!err)
		job = link_take(link, sequence);
	pthread_mutex_unlock(&link->lock);
	if (!job)
		return err;
	*status = (struct gloss_status){ .cause = GLOSS_FAULT_NONE };
	err = job->error;
	if (!err)
		*status = job->answer.status;
	accel_usb_job_free(link, job);
	return err;
}
