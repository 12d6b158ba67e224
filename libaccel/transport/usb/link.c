// SPDX-License-Identifier: MIT
/* A link's thread and its life; submitting jobs, and waiting for them. */
#include <errno.h>
#include <stdlib.h>
#include <time.h>

#include "gloss_regs.h"
#include "transport/thread.h"
#include "transport/usb/link_priv.h"

#define NS_PER_MS 1000000
#define MEMORY_PAUSE_MS 250

/* A thread that has seen no job for a while sleeps until a job wakes it, at most for this long. */
#define SLEEP_MS 60000

/* ---- the thread ---- */

/* Gives the lock up meanwhile. The board is well, and will be tried again. */
static void link_wait_for_memory_locked(struct accel_usb_link *link)
{
	const struct timespec pause = { 0, MEMORY_PAUSE_MS * NS_PER_MS };

	accel_usb_link_lose_locked(link, -ENOMEM);
	pthread_mutex_unlock(&link->lock);
	nanosleep(&pause, NULL);
	pthread_mutex_lock(&link->lock);
}

/*
 * Gives the lock up meanwhile. What has become of the jobs is only known when
 * the board works again, or is gone: that a cable is unplugged can look like any error at first.
 */
static void link_recover_locked(struct accel_usb_link *link)
{
	int err;

	if (link->broken_by == -ENOMEM)
		accel_usb_transfers_less_locked(link);
	else
		accel_usb_transfers_most_locked(link);
	pthread_mutex_unlock(&link->lock);
	err = accel_usb_sync_drain(link) ? accel_usb_sync(link) : -ENODEV;
	pthread_mutex_lock(&link->lock);
	if (err == -ENOMEM)
		link_wait_for_memory_locked(link);
	else if (err || ++link->failures >= USB_FAILURES_MAX)
		link->state = USB_LINK_GONE;
	else
		accel_usb_link_begin_locked(link);
}

/* Gives the lock up while events come. */
static void link_handle_locked(struct accel_usb_link *link)
{
	int ms;

	accel_usb_transfers_send_locked(link);
	ms = accel_usb_watch_locked(link);
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
			link_recover_locked(link);
		else
			link_handle_locked(link);
	}
	link->state = USB_LINK_GONE;
	pthread_mutex_unlock(&link->lock);
	accel_usb_sync_drain(link);
	pthread_mutex_lock(&link->lock);
	accel_usb_link_lose_locked(link, -ENODEV);
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
	accel_pool_init(&link->pool, &accel_usb_buffer_kind, NULL);
}

/* But for one whose transfers are in flight for ever. */
static void link_destroy(struct accel_usb_link *link)
{
	if (link->node->stuck)
		return;
	accel_usb_transfers_fini(link);
	accel_job_table_fini(&link->jobs, NULL);
	accel_pool_fini(&link->pool);
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
	accel_usb_transfers_most_locked(link);
	link_init_locks(link);
	err = accel_usb_transfers_init(link);
	if (!err)
		err = accel_usb_sync(link);
	if (err)
		goto err_destroy;
	accel_usb_link_begin_locked(link);
	err = accel_thread_new(&link->thread, link_thread, link);
	if (err)
		goto err_drain;
	*out = link;
	return 0;

err_drain:
	pthread_mutex_lock(&link->lock);
	link->state = USB_LINK_GONE;
	pthread_mutex_unlock(&link->lock);
	accel_usb_sync_drain(link);
err_destroy:
	link_destroy(link);
	return err;
}

void accel_usb_link_free(struct accel_usb_link *link)
{
	pthread_mutex_lock(&link->lock);
	link->stop = true;
	accel_usb_link_wake_locked(link);
	pthread_mutex_unlock(&link->lock);
	pthread_join(link->thread, NULL);
	link_destroy(link);
}

/* ---- submitting ---- */

void accel_usb_link_wait_for_room(struct accel_usb_link *link)
{
	pthread_mutex_lock(&link->lock);
	link->waiting++;
	while (link->state != USB_LINK_GONE && link->queued >= USB_QUEUED_MAX)
		pthread_cond_wait(&link->room, &link->lock);
	link->waiting--;
	pthread_mutex_unlock(&link->lock);
}

static void link_append_locked(struct accel_usb_link *link, struct accel_usb_job *job)
{
	accel_job_table_put(&link->jobs, &job->entry, ++link->sequence);
	job->answer.sequence = job->message->word[GLOSS_USB_JOB_SEQUENCE_WORD] = (uint32_t)link
											 ->sequence;
	*link->last = job;
	link->last = &job->next;
	if (!link->sending)
		link->sending = job;
	if (!link->answering)
		link->answering = job;
	link->queued += job->bytes;
	link->running++;
	link->moves++;
	accel_usb_transfers_send_locked(link);
	if (link->asleep)
		accel_usb_link_wake_locked(link);
}

int accel_usb_link_submit(struct accel_usb_link *link, struct accel_usb_job *job, uint64_t losses,
			  uint64_t *sequence)
{
	int err = 0;

	pthread_mutex_lock(&link->lock);
	if (link->state == USB_LINK_GONE)
		err = -ENODEV;
	else if (link->losses != losses)
		err = -EAGAIN;
	if (!err) {
		link_append_locked(link, job);
		*sequence = link->sequence;
	}
	pthread_mutex_unlock(&link->lock);
	return err;
}

/* ---- waiting ---- */

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
	struct accel_job_entry *entry;
	int err;

	pthread_mutex_lock(&link->lock);
	err = accel_job_table_wait(&link->jobs, sequence, &link->ended, &link->lock, timeout_ns,
				   &entry);
	pthread_mutex_unlock(&link->lock);
	return err ? err : job_result(link, (struct accel_usb_job *)entry, status);
}

void accel_usb_link_forget(struct accel_usb_link *link, uint64_t sequence)
{
	struct accel_usb_job *job;

	pthread_mutex_lock(&link->lock);
	job = (struct accel_usb_job *)accel_job_table_find(&link->jobs, sequence);
	if (job->entry.ended) {
		accel_job_table_take(&link->jobs, &job->entry);
		accel_usb_job_free(link, job);
	} else {
		job->forgotten = true;
	}
	pthread_mutex_unlock(&link->lock);
}
