// SPDX-License-Identifier: MIT
/* How a link starts, and starts anew. */
#include <errno.h>
#include <sys/random.h>
#include <time.h>

#include "gloss_regs.h"
#include "usb_link_priv.h"

#define ATTEMPTS 3
#define RESET_MS 2000
#define ECHO_MS 2000
#define HANDLE_MS 100

/* A board that has just been unplugged is soon known to be; one that has a fault may get over
 * it. */
#define PAUSE_MS 20
#define NS_PER_MS 1000000

static void sync_pause(int ms)
{
	const struct timespec time = { 0, ms * NS_PER_MS };

	nanosleep(&time, NULL);
}

/* Cancelling is repeated: a call that fails must not make this wait for ever. */
void accel_usb_link_drain(struct accel_usb_link *link)
{
	pthread_mutex_lock(&link->lock);
	while (link->in_flight) {
		accel_usb_transfers_cancel(link);
		pthread_mutex_unlock(&link->lock);
		accel_usb_transfers_handle(link, HANDLE_MS);
		pthread_mutex_lock(&link->lock);
	}
	pthread_mutex_unlock(&link->lock);
}

static int sync_clear_halt(struct accel_usb_link *link, bool *halted, unsigned char endpoint)
{
	int err = *halted ? libusb_clear_halt(link->node->handle, endpoint) : 0;

	if (!err)
		*halted = false;
	return err == LIBUSB_ERROR_NO_DEVICE ? -ENODEV : err ? -EIO : 0;
}

/* The board forgets what it was doing. */
static int sync_reset(struct accel_usb_link *link)
{
	int64_t deadline = accel_usb_link_now_ms() + RESET_MS;
	uint32_t control = 0;
	int err;

	err = accel_usb_node_write(link->node, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	while (!err) {
		err = accel_usb_node_read(link->node, GLOSS_REG_CONTROL, &control);
		if (err || !(control & GLOSS_REG_CONTROL_RESET))
			break;
		if (accel_usb_link_now_ms() >= deadline)
			return -EIO;
		sync_pause(1);
	}
	return err;
}

static int sync_nonce(uint32_t *nonce)
{
	do {
		if (getrandom(nonce, sizeof(*nonce), 0) != sizeof(*nonce))
			return -EIO;
	} while (!*nonce);
	return 0;
}

/* With the lock held, which it gives up while it waits. */
static void sync_wait(struct accel_usb_link *link)
{
	int64_t deadline = accel_usb_link_now_ms() + ECHO_MS;

	while (link->state == USB_LINK_STARTING && !link->synchronised && !link->stop &&
	       accel_usb_link_now_ms() < deadline) {
		pthread_mutex_unlock(&link->lock);
		accel_usb_transfers_handle(link, HANDLE_MS);
		pthread_mutex_lock(&link->lock);
	}
}

/* Sends the sync, and waits for it to come back. */
static int sync_echo(struct accel_usb_link *link, uint32_t nonce)
{
	int err = 0;

	pthread_mutex_lock(&link->lock);
	if (link->state != USB_LINK_GONE) {
		link->state = USB_LINK_STARTING;
		accel_usb_transfers_start(link, nonce);
	}
	sync_wait(link);
	if (link->state != USB_LINK_STARTING || !link->synchronised) {
		accel_usb_link_break(link, -EIO);
		err = link->state == USB_LINK_GONE ? -ENODEV : -EIO;
	}
	pthread_mutex_unlock(&link->lock);
	if (err)
		accel_usb_link_drain(link);
	return err;
}

static int sync_once(struct accel_usb_link *link)
{
	uint32_t nonce = 0;
	int err;

	err = sync_clear_halt(link, &link->halted_out, GLOSS_USB_ENDPOINT_OUT);
	if (!err)
		err = sync_clear_halt(link, &link->halted_in, GLOSS_USB_ENDPOINT_IN);
	if (!err)
		err = sync_clear_halt(link, &link->halted_event, GLOSS_USB_ENDPOINT_EVENT);
	if (!err)
		err = sync_reset(link);
	if (!err)
		err = sync_nonce(&nonce);
	if (!err)
		err = accel_usb_node_write(link->node, GLOSS_REG_NONCE, nonce);
	return err ? err : sync_echo(link, nonce);
}

int accel_usb_link_sync(struct accel_usb_link *link)
{
	int attempt, err = -EIO;

	for (attempt = 0; attempt < ATTEMPTS && err == -EIO; attempt++) {
		if (attempt)
			sync_pause(PAUSE_MS << 2 * attempt);
		err = sync_once(link);
	}
	return err;
}
