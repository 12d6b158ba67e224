// SPDX-License-Identifier: MIT
/* Transfers of a link: out of the jobs' messages, and in to the parser. */
#include <errno.h>
#include <stdlib.h>
#include <time.h>

#include "usb_link_priv.h"

#define PAUSE_NS 1000000

/* ---- submitting ---- */

/* With the lock held. False: it did not go, and the link is broken. */
static bool transfer_submit(struct usb_transfer *transfer)
{
	struct accel_usb_link *link = transfer->link;
	int err = libusb_submit_transfer(transfer->transfer);

	if (err) {
		accel_usb_link_break(link, err == LIBUSB_ERROR_NO_DEVICE ? -ENODEV : -EIO);
		return false;
	}
	transfer->in_flight = true;
	link->in_flight++;
	return true;
}

static struct usb_transfer *out_unused(struct accel_usb_link *link)
{
	unsigned int i;

	for (i = 0; i < USB_OUT_TRANSFERS; i++)
		if (!link->out[i].in_flight)
			return &link->out[i];
	return NULL;
}

static bool out_submit(struct usb_transfer *out, struct accel_usb_job *job, void *bytes,
		       size_t count)
{
	out->job = job;
	out->transfer->buffer = bytes;
	out->transfer->length = (int)count;
	return transfer_submit(out);
}

void accel_usb_transfers_send(struct accel_usb_link *link)
{
	struct usb_transfer *out;

	while (link->state == USB_LINK_READY && link->sending && (out = out_unused(link))) {
		struct accel_usb_job *job = link->sending;
		size_t count = job->bytes - job->started;

		if (count > USB_TRANSFER_BYTES)
			count = USB_TRANSFER_BYTES;
		if (!out_submit(out, job, (uint8_t *)job->message->word + job->started, count))
			return;
		job->started += count;
		if (job->started == job->bytes)
			link->sending = job->next;
	}
}

void accel_usb_transfers_start(struct accel_usb_link *link, uint32_t nonce)
{
	const struct gloss_usb_sync sync = {
		.mark = GLOSS_USB_SYNC_MAGIC,
		.nonce = nonce,
		.nonce_complement = ~nonce,
		.mark_complement = ~GLOSS_USB_SYNC_MAGIC,
	};
	unsigned int i;

	accel_usb_parser_start(&link->parser, nonce);
	gloss_usb_sync_pack(link->sync_words, &sync);
	link->in_next = 0;
	link->synchronised = link->hint = false;
	for (i = 0; i < USB_IN_TRANSFERS; i++) {
		link->in[i].ended = false;
		if (!transfer_submit(&link->in[i]))
			return;
	}
	if (transfer_submit(&link->event))
		out_submit(&link->out[0], NULL, link->sync_words, sizeof(link->sync_words));
}

/* ---- what has ended ---- */

/* With the lock held. True: it is to be looked at. */
static bool transfer_end(struct usb_transfer *transfer, bool *halted)
{
	struct accel_usb_link *link = transfer->link;

	transfer->in_flight = false;
	link->in_flight--;
	switch (transfer->transfer->status) {
	case LIBUSB_TRANSFER_COMPLETED:
		return link->state < USB_LINK_BROKEN;
	case LIBUSB_TRANSFER_NO_DEVICE:
		accel_usb_link_break(link, -ENODEV);
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
	if (!transfer_end(out, &link->halted_out) || transfer->actual_length != transfer->length) {
		accel_usb_link_break(link, -EIO);
	} else if (out->job) {
		link->moves++;
		link->queued -= (size_t)transfer->length;
		out->job->sent += (size_t)transfer->length;
		accel_usb_link_job_moved(link, out->job);
		accel_usb_transfers_send(link);
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
		accel_usb_link_job_moved(link, job);
		return true;
	default:
		break;
	}
	accel_usb_link_break(link, -EIO);
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

		if (!in_message(link, accel_usb_parser_take(&link->parser,
							    job ? &job->answer : NULL, &words,
							    &count)))
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
	in->ended = transfer_end(in, &link->halted_in);
	if (!in->ended)
		accel_usb_link_break(link, -EIO);
	for (in = &link->in[link->in_next]; in->ended && link->state < USB_LINK_BROKEN;
	     in = &link->in[link->in_next]) {
		in->ended = false;
		link->in_next = (link->in_next + 1) % USB_IN_TRANSFERS;
		if (in_take(link, in->transfer))
			transfer_submit(in);
	}
	pthread_mutex_unlock(&link->lock);
}

/* Events are hints. If one can not be had, the link does without until it starts again. */
static void event_ended(struct libusb_transfer *transfer)
{
	struct usb_transfer *event = transfer->user_data;
	struct accel_usb_link *link = event->link;
	struct gloss_usb_event what;

	pthread_mutex_lock(&link->lock);
	if (transfer_end(event, &link->halted_event)) {
		gloss_usb_event_unpack(link->event_words, &what);
		if (transfer->actual_length == sizeof(link->event_words) &&
		    what.mark == GLOSS_USB_EVENT_MAGIC && what.lost)
			link->hint = true;
		transfer_submit(event);
	}
	pthread_mutex_unlock(&link->lock);
}

/* ---- all of them ---- */

void accel_usb_transfers_cancel(struct accel_usb_link *link)
{
	unsigned int i;

	for (i = 0; i < USB_OUT_TRANSFERS; i++)
		if (link->out[i].in_flight)
			libusb_cancel_transfer(link->out[i].transfer);
	for (i = 0; i < USB_IN_TRANSFERS; i++)
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
	libusb_fill_bulk_transfer(transfer->transfer, link->node->handle, endpoint, NULL, 0, ended,
				  transfer, 0);
	return true;
}

static bool transfers_init_all(struct accel_usb_link *link)
{
	unsigned int i;

	for (i = 0; i < USB_OUT_TRANSFERS; i++)
		if (!transfer_init(&link->out[i], link, GLOSS_USB_ENDPOINT_OUT, out_ended))
			return false;
	for (i = 0; i < USB_IN_TRANSFERS; i++) {
		struct usb_transfer *in = &link->in[i];

		if (!transfer_init(in, link, GLOSS_USB_ENDPOINT_IN, in_ended))
			return false;
		in->transfer->buffer = (unsigned char *)link->in_words + i * USB_TRANSFER_BYTES;
		in->transfer->length = USB_TRANSFER_BYTES;
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
	unsigned int i;

	for (i = 0; i < USB_OUT_TRANSFERS; i++)
		libusb_free_transfer(link->out[i].transfer);
	for (i = 0; i < USB_IN_TRANSFERS; i++)
		libusb_free_transfer(link->in[i].transfer);
	libusb_free_transfer(link->event.transfer);
	free(link->in_words);
}
