// SPDX-License-Identifier: MIT
/* Transfers of a link: out of the jobs' messages, and in to the parser. */
#include <errno.h>
#include <stdlib.h>
#include <time.h>

#include "transport/usb/link_priv.h"

#define PAUSE_NS 1000000

/* ---- submitting ---- */

/* -ENOMEM: there is none at the moment; else the link is broken by an error. */
static int transfer_submit_locked(struct usb_transfer *transfer)
{
	struct accel_usb_link *link = transfer->link;
	int err;

	transfer->transfer->dev_handle = link->node->handle;
	err = accel_usb_node_error(libusb_submit_transfer(transfer->transfer));
	if (err && err != -ENOMEM)
		accel_usb_link_break_locked(link, err);
	if (err)
		return err;
	transfer->in_flight = true;
	link->in_flight++;
	link->starved = false;
	return 0;
}

/* False: it is as short as it may be. */
static bool bytes_halve(unsigned int *bytes, unsigned int min)
{
	if (*bytes <= min)
		return false;
	*bytes /= 2;
	return true;
}

static int in_submit(struct accel_usb_link *link, struct usb_transfer *in)
{
	int err;

	in->transfer->length = (int)link->in_bytes;
	err = transfer_submit_locked(in);
	if (err)
		return err;
	in->queued = true;
	in->ended = in->gives_way = false;
	in->next = NULL;
	link->in_queued++;
	*link->in_last = in;
	link->in_last = &in->next;
	return 0;
}

static int in_submit_all(struct accel_usb_link *link)
{
	int err = 0;

	for (unsigned int i = 0; i < USB_IN_TRANSFERS && link->in_queued < link->in_count && !err;
	     i++)
		if (!link->in[i].queued)
			err = in_submit(link, &link->in[i]);
	return err;
}

/* As many as there is memory for; -ENOMEM: not even one. */
static int in_submit_some(struct accel_usb_link *link)
{
	int err;

	do {
		err = in_submit_all(link);
	} while (err == -ENOMEM && bytes_halve(&link->in_bytes, USB_IN_BYTES_MIN));
	if (err != -ENOMEM || link->in_first)
		return err == -ENOMEM ? 0 : err;
	link->starved = true;
	return err;
}

void accel_usb_transfers_most_locked(struct accel_usb_link *link)
{
	link->in_count = USB_IN_TRANSFERS;
	link->in_bytes = link->out_bytes = USB_TRANSFER_BYTES;
}

bool accel_usb_transfers_less_locked(struct accel_usb_link *link)
{
	return bytes_halve(&link->in_bytes, USB_IN_BYTES_MIN) || bytes_halve(&link->in_count, 1);
}

static void double_up_to(unsigned int *count, unsigned int max)
{
	*count = *count > max / 2 ? max : 2 * *count;
}

void accel_usb_transfers_more_locked(struct accel_usb_link *link)
{
	double_up_to(&link->in_count, USB_IN_TRANSFERS);
	double_up_to(&link->in_bytes, USB_TRANSFER_BYTES);
	double_up_to(&link->out_bytes, USB_TRANSFER_BYTES);
}

/*
 * When there is no memory to send, because what waits to be read into has it all, the last of that
 * is given back. False: there is nothing to be given.
 */
static bool in_give_way(struct accel_usb_link *link)
{
	struct usb_transfer *in, *last = NULL;

	for (in = link->in_first; in; in = in->next) {
		if (in->ended)
			continue;
		if (in->gives_way)
			return true;
		last = in;
	}
	if (!last ||
	    (!bytes_halve(&link->in_count, 1) && !bytes_halve(&link->in_bytes, USB_IN_BYTES_MIN)))
		return false;
	last->gives_way = true;
	libusb_cancel_transfer(last->transfer);
	return true;
}

static struct usb_transfer *out_unused(struct accel_usb_link *link)
{
	for (unsigned int i = 0; i < USB_OUT_TRANSFERS; i++)
		if (!link->out[i].in_flight)
			return &link->out[i];
	return NULL;
}

static int out_submit(struct usb_transfer *out, struct accel_usb_job *job, void *bytes,
		      size_t count)
{
	out->job = job;
	out->transfer->buffer = bytes;
	out->transfer->length = (int)count;
	return transfer_submit_locked(out);
}

/* What comes next of @job. */
static int out_submit_job(struct accel_usb_link *link, struct usb_transfer *out,
			  struct accel_usb_job *job)
{
	uint8_t *bytes = (uint8_t *)job->message->word + job->started;
	size_t count;
	int err;

	do {
		count = job->bytes - job->started;
		if (count > link->out_bytes)
			count = link->out_bytes;
		err = out_submit(out, job, bytes, count);
	} while (err == -ENOMEM && bytes_halve(&link->out_bytes, USB_OUT_BYTES_MIN));
	if (err)
		return err;
	job->started += count;
	if (job->started == job->bytes)
		link->sending = job->next;
	return 0;
}

static bool out_in_flight(const struct accel_usb_link *link)
{
	for (unsigned int i = 0; i < USB_OUT_TRANSFERS; i++)
		if (link->out[i].in_flight)
			return true;
	return false;
}

/* What there is no memory for is sent when a transfer has ended, or the thread looks again. */
void accel_usb_transfers_send_locked(struct accel_usb_link *link)
{
	struct usb_transfer *out;
	int err;

	if (link->state != USB_LINK_READY)
		return;
	err = in_submit_some(link);
	while (!err && link->sending && (out = out_unused(link)))
		err = out_submit_job(link, out, link->sending);
	if (err == -ENOMEM && !out_in_flight(link) && !in_give_way(link))
		link->starved = true;
}

int accel_usb_transfers_start_locked(struct accel_usb_link *link, uint32_t nonce)
{
	const struct gloss_usb_sync sync = {
		.mark = GLOSS_USB_SYNC_MAGIC,
		.nonce = nonce,
		.nonce_complement = ~nonce,
		.mark_complement = ~GLOSS_USB_SYNC_MAGIC,
	};
	int err;

	accel_usb_message_start(&link->parser, nonce);
	gloss_usb_sync_pack(link->sync_words, &sync);
	link->in_first = NULL;
	link->in_last = &link->in_first;
	link->in_queued = 0;
	link->synchronised = link->hint = false;
	for (unsigned int i = 0; i < USB_IN_TRANSFERS; i++)
		link->in[i].queued = false;
	err = in_submit_all(link);
	if (err)
		return err;
	err = transfer_submit_locked(&link->event);
	if (err && err != -ENOMEM)
		return err;
	return out_submit(&link->out[0], NULL, link->sync_words, sizeof(link->sync_words));
}

/* ---- what has ended ---- */

/* True: it is to be looked at. */
static bool transfer_end_locked(struct usb_transfer *transfer, bool *halted)
{
	struct accel_usb_link *link = transfer->link;

	transfer->in_flight = false;
	link->in_flight--;
	switch (transfer->transfer->status) {
	case LIBUSB_TRANSFER_COMPLETED:
		return link->state < USB_LINK_BROKEN;
	case LIBUSB_TRANSFER_NO_DEVICE:
		accel_usb_link_break_locked(link, -ENODEV);
		return false;
	case LIBUSB_TRANSFER_STALL:
		*halted = true;
		break;
	default:
		break;
	}
	return false;
}

static void out_ended(struct libusb_transfer *transfer)
{
	struct usb_transfer *out = transfer->user_data;
	struct accel_usb_link *link = out->link;

	pthread_mutex_lock(&link->lock);
	if (!transfer_end_locked(out, &link->halted_out) ||
	    transfer->actual_length != transfer->length) {
		accel_usb_link_break_locked(link, -EIO);
	} else if (out->job) {
		link->moves++;
		link->queued -= (size_t)transfer->length;
		out->job->sent += (size_t)transfer->length;
		accel_usb_link_job_moved_locked(link, out->job);
		accel_usb_transfers_send_locked(link);
	}
	pthread_mutex_unlock(&link->lock);
}

/* False: the link is broken. */
static bool in_message(struct accel_usb_link *link, enum accel_usb_message message)
{
	struct accel_usb_job *job = link->answering;

	switch (message) {
	case ACCEL_USB_SYNC:
		link->synchronised = true;
		return true;
	case ACCEL_USB_MORE:
		return true;
	case ACCEL_USB_COMPLETION:
		if (job->started < job->bytes || (job->must && job->answer.status.cause))
			break;
		job->answered = true;
		link->answering = job->next;
		accel_usb_link_job_moved_locked(link, job);
		return true;
	default:
		break;
	}
	accel_usb_link_break_locked(link, -EIO);
	return false;
}

/* The words of one transfer. */
static bool in_take(struct accel_usb_link *link, const struct libusb_transfer *transfer)
{
	const uint32_t *words = (const void *)transfer->buffer;
	size_t count = (size_t)transfer->actual_length / sizeof(*words);

	if ((size_t)transfer->actual_length % sizeof(*words))
		return in_message(link, ACCEL_USB_GARBLED);
	if (count)
		link->moves++;
	while (count) {
		struct accel_usb_job *job = link->state == USB_LINK_READY ? link->answering : NULL;

		if (!in_message(link,
				accel_usb_message_take(&link->parser, job ? &job->answer : NULL,
						       &words, &count)))
			return false;
	}
	return true;
}

/* Words are taken in the order in which they were asked for. */
static void in_ended(struct libusb_transfer *transfer)
{
	struct usb_transfer *in = transfer->user_data;
	struct accel_usb_link *link = in->link;

	pthread_mutex_lock(&link->lock);
	if (in->gives_way && transfer->status == LIBUSB_TRANSFER_CANCELLED)
		transfer->status = LIBUSB_TRANSFER_COMPLETED;
	in->ended = transfer_end_locked(in, &link->halted_in);
	if (!in->ended)
		accel_usb_link_break_locked(link, -EIO);
	while (link->state < USB_LINK_BROKEN && link->in_first && link->in_first->ended) {
		in = link->in_first;
		link->in_first = in->next;
		if (!link->in_first)
			link->in_last = &link->in_first;
		in->queued = false;
		link->in_queued--;
		if (in_take(link, in->transfer))
			in_submit_some(link);
	}
	accel_usb_transfers_send_locked(link);
	pthread_mutex_unlock(&link->lock);
}

/* Events are hints. If one can not be had, the link does without until it starts again. */
static void event_ended(struct libusb_transfer *transfer)
{
	struct usb_transfer *event = transfer->user_data;
	struct accel_usb_link *link = event->link;
	struct gloss_usb_event what;

	pthread_mutex_lock(&link->lock);
	if (transfer_end_locked(event, &link->halted_event)) {
		gloss_usb_event_unpack(link->event_words, &what);
		if (transfer->actual_length == sizeof(link->event_words) &&
		    what.mark == GLOSS_USB_EVENT_MAGIC && what.lost)
			link->hint = true;
		transfer_submit_locked(event);
	}
	pthread_mutex_unlock(&link->lock);
}

/* ---- all of them ---- */

void accel_usb_transfers_cancel_locked(struct accel_usb_link *link)
{
	for (unsigned int i = 0; i < USB_OUT_TRANSFERS; i++)
		if (link->out[i].in_flight)
			libusb_cancel_transfer(link->out[i].transfer);
	for (unsigned int i = 0; i < USB_IN_TRANSFERS; i++)
		if (link->in[i].in_flight)
			libusb_cancel_transfer(link->in[i].transfer);
	if (link->event.in_flight)
		libusb_cancel_transfer(link->event.transfer);
}

void accel_usb_transfers_handle(struct accel_usb_link *link, int ms)
{
	const struct timespec pause = { 0, PAUSE_NS };
	struct timeval time = { ms / 1000, ms % 1000 * 1000 };

	if (libusb_handle_events_timeout(link->node->context, &time))
		nanosleep(&pause, NULL);
}

/* libusb has no time-outs here: the link judges by what moves. */
static bool transfer_init(struct usb_transfer *transfer, struct accel_usb_link *link,
			  unsigned char endpoint, libusb_transfer_cb_fn ended)
{
	transfer->link = link;
	transfer->transfer = libusb_alloc_transfer(0);
	if (!transfer->transfer)
		return false;
	libusb_fill_bulk_transfer(transfer->transfer, NULL, endpoint, NULL, 0, ended, transfer, 0);
	return true;
}

static bool transfers_init_all(struct accel_usb_link *link)
{
	for (unsigned int i = 0; i < USB_OUT_TRANSFERS; i++)
		if (!transfer_init(&link->out[i], link, GLOSS_USB_ENDPOINT_OUT, out_ended))
			return false;
	for (unsigned int i = 0; i < USB_IN_TRANSFERS; i++) {
		struct usb_transfer *in = &link->in[i];

		if (!transfer_init(in, link, GLOSS_USB_ENDPOINT_IN, in_ended))
			return false;
		in->transfer->buffer = (unsigned char *)link->in_words + i * USB_TRANSFER_BYTES;
	}
	if (!transfer_init(&link->event, link, GLOSS_USB_ENDPOINT_EVENT, event_ended))
		return false;
	link->event.transfer->type = LIBUSB_TRANSFER_TYPE_INTERRUPT;
	link->event.transfer->buffer = (unsigned char *)link->event_words;
	link->event.transfer->length = sizeof(link->event_words);
	return true;
}

int accel_usb_transfers_init(struct accel_usb_link *link)
{
	link->in_words = malloc((size_t)USB_IN_TRANSFERS * USB_TRANSFER_BYTES);
	return link->in_words && transfers_init_all(link) ? 0 : -ENOMEM;
}

void accel_usb_transfers_fini(struct accel_usb_link *link)
{
	for (unsigned int i = 0; i < USB_OUT_TRANSFERS; i++)
		libusb_free_transfer(link->out[i].transfer);
	for (unsigned int i = 0; i < USB_IN_TRANSFERS; i++)
		libusb_free_transfer(link->in[i].transfer);
	libusb_free_transfer(link->event.transfer);
	free(link->in_words);
}
