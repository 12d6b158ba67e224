// SPDX-License-Identifier: MIT
/* What state a link is in, and what becomes of its jobs by that. */
#include <errno.h>
#include <stdlib.h>

#include "transport/usb/link_priv.h"

/* ---- jobs ---- */

static int buffer_create(void *data, uint64_t size, struct accel_pool_buffer **out)
{
	(void)data;
	if (size > SIZE_MAX - sizeof(struct accel_usb_buffer))
		return -ENOMEM;
	*out = malloc(sizeof(struct accel_usb_buffer) + size);
	return *out ? 0 : -ENOMEM;
}

static void buffer_destroy(void *data, struct accel_pool_buffer *buffer)
{
	(void)data;
	free(buffer);
}

const struct accel_pool_kind accel_usb_buffer_kind = {
	.unused_bytes = 32u << 20,
	.unused_buffers = 64,
	.create = buffer_create,
	.destroy = buffer_destroy,
};

struct accel_usb_job *accel_usb_job_new(struct accel_usb_link *link, size_t words)
{
	struct accel_usb_job *job = malloc(sizeof(*job));
	const size_t bytes = words * sizeof(uint32_t);
	struct accel_pool_buffer *buffer;

	if (!job)
		return NULL;
	if (words > SIZE_MAX / sizeof(uint32_t) || accel_pool_get(&link->pool, bytes, &buffer)) {
		free(job);
		return NULL;
	}
	*job = (struct accel_usb_job){
		.message = (struct accel_usb_buffer *)buffer,
		.bytes = bytes,
	};
	return job;
}

static void job_put_message(struct accel_usb_link *link, struct accel_usb_job *job)
{
	if (job->message)
		accel_pool_put(&link->pool, &job->message->pooled);
	job->message = NULL;
}

void accel_usb_job_free(struct accel_usb_link *link, struct accel_usb_job *job)
{
	job_put_message(link, job);
	free(job);
}

/* Jobs end nearly in their order, so it is among the first. */
static void link_remove_locked(struct accel_usb_link *link, const struct accel_usb_job *job)
{
	struct accel_usb_job **at = &link->first;

	while (*at != job)
		at = &(*at)->next;
	*at = job->next;
	if (!job->next)
		link->last = at;
}

static void job_end_locked(struct accel_usb_link *link, struct accel_usb_job *job, int error)
{
	link_remove_locked(link, job);
	job->entry.ended = true;
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

void accel_usb_link_job_moved_locked(struct accel_usb_link *link, struct accel_usb_job *job)
{
	if (job->sent == job->bytes) {
		job_put_message(link, job);
		if (job->answered)
			job_end_locked(link, job, 0);
	}
	if (link->waiting && link->queued < USB_QUEUED_MAX)
		pthread_cond_broadcast(&link->room);
}

void accel_usb_link_lose_locked(struct accel_usb_link *link, int error)
{
	while (link->first)
		job_end_locked(link, link->first, error);
	link->sending = link->answering = NULL;
	link->queued = 0;
	link->losses++;
	pthread_cond_broadcast(&link->room);
}

void accel_usb_link_begin_locked(struct accel_usb_link *link)
{
	accel_usb_link_lose_locked(link, link->broken_by);
	if (link->state == USB_LINK_STARTING)
		link->state = USB_LINK_READY;
}

/* ---- the state ---- */

void accel_usb_link_wake_locked(struct accel_usb_link *link)
{
	link->asleep = false;
	libusb_interrupt_event_handler(link->node->context);
}

void accel_usb_link_break_locked(struct accel_usb_link *link, int err)
{
	if (link->state < USB_LINK_BROKEN) {
		link->state = USB_LINK_BROKEN;
		link->broken_by = err;
	}
	if (err == -ENODEV)
		link->state = USB_LINK_GONE;
	if (link->asleep)
		accel_usb_link_wake_locked(link);
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
	else if (link->failures >= USB_FAILURES_MAX)
		why = "the board fails again and again";
	pthread_mutex_unlock(&link->lock);
	return why;
}

uint64_t accel_usb_link_losses(struct accel_usb_link *link)
{
	uint64_t losses;

	pthread_mutex_lock(&link->lock);
	losses = link->losses;
	pthread_mutex_unlock(&link->lock);
	return losses;
}
