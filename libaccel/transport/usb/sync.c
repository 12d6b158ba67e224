// SPDX-License-Identifier: MIT
/* How a link starts, and starts anew. */
#include <errno.h>
#include <sys/random.h>
#include <time.h>

#include "gloss_regs.h"
#include "transport/thread.h"
#include "transport/usb/link_priv.h"

#define ATTEMPTS 3
#define RESET_MS 2000
#define ECHO_MS 2000
#define HANDLE_MS 100

/* Every transfer that is cancelled ends soon, if anybody tells: somebody may have closed the file
 * descriptors of libusb, as daemons do of all that they inherit. */
#define DRAIN_MS 10000

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
bool accel_usb_sync_drain(struct accel_usb_link *link)
{
	int64_t deadline = accel_thread_now_ms() + DRAIN_MS;
	bool drained;

	pthread_mutex_lock(&link->lock);
	while (link->in_flight && !link->node->stuck && accel_thread_now_ms() < deadline) {
		accel_usb_transfers_cancel_locked(link);
		pthread_mutex_unlock(&link->lock);
		accel_usb_transfers_handle(link, HANDLE_MS);
		pthread_mutex_lock(&link->lock);
	}
	drained = !link->in_flight;
	if (!drained)
		link->node->stuck = true;
	pthread_mutex_unlock(&link->lock);
	return drained;
}

static int sync_clear_halt(struct accel_usb_link *link, bool *halted, unsigned char endpoint)
{
	int err = *halted ? libusb_clear_halt(link->node->handle, endpoint) : 0;

	if (!err)
		*halted = false;
	return accel_usb_node_error(err);
}

static int sync_clear_halts(struct accel_usb_link *link)
{
	int err = sync_clear_halt(link, &link->halted_out, GLOSS_USB_ENDPOINT_OUT);

	if (!err)
		err = sync_clear_halt(link, &link->halted_in, GLOSS_USB_ENDPOINT_IN);
	if (!err)
		err = sync_clear_halt(link, &link->halted_event, GLOSS_USB_ENDPOINT_EVENT);
	return err;
}

/*
 * Somebody else may have reset the bus, and with that taken the interface from this program. The
 * handle's users among other threads keep away meanwhile.
 */
static int sync_claim(struct accel_usb_link *link)
{
	int err;

	if (!link->boot)
		return 0;
	pthread_mutex_lock(&link->clocks.lock);
	err = accel_usb_node_claim_again(link->node);
	pthread_mutex_unlock(&link->clocks.lock);
	return err;
}

/* The board forgets what it was doing. */
static int sync_reset(struct accel_usb_link *link)
{
	int64_t deadline = accel_thread_now_ms() + RESET_MS;
	uint32_t control = 0;
	int err;

	accel_usb_clocks_keep(link);
	err = accel_usb_node_write(link->node, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	while (!err) {
		err = accel_usb_node_read(link->node, GLOSS_REG_CONTROL, &control);
		if (err || !(control & GLOSS_REG_CONTROL_RESET))
			break;
		if (accel_thread_now_ms() >= deadline)
			return -EIO;
		sync_pause(1);
	}
	if (!err)
		accel_usb_clocks_restart(link);
	return err;
}

/* Not 0. */
static int sync_random(uint32_t *number)
{
	do {
		if (getrandom(number, sizeof(*number), 0) != sizeof(*number))
			return -EIO;
	} while (!*number);
	return 0;
}

/* Only at the first start: the board keeps it, as long as it has power. */
static int sync_set_boot(struct accel_usb_link *link)
{
	uint32_t boot = 0;
	int err;

	if (link->boot)
		return 0;
	err = sync_random(&boot);
	if (!err)
		err = accel_usb_node_write(link->node, GLOSS_REG_BOOT, boot);
	if (!err)
		link->boot = boot;
	return err;
}

/* Gives the lock up while it waits. */
static void sync_wait_locked(struct accel_usb_link *link)
{
	int64_t deadline = accel_thread_now_ms() + ECHO_MS;

	while (link->state == USB_LINK_STARTING && !link->synchronised && !link->stop &&
	       accel_thread_now_ms() < deadline) {
		pthread_mutex_unlock(&link->lock);
		accel_usb_transfers_handle(link, HANDLE_MS);
		pthread_mutex_lock(&link->lock);
	}
}

/* Gives the lock up while it waits. */
static int sync_echo_locked(struct accel_usb_link *link, uint32_t nonce)
{
	int err = 0;

	if (link->state != USB_LINK_GONE) {
		link->state = USB_LINK_STARTING;
		err = accel_usb_transfers_start_locked(link, nonce);
	}
	if (!err)
		sync_wait_locked(link);
	if (!err && link->state == USB_LINK_STARTING && link->synchronised)
		return 0;
	accel_usb_link_break_locked(link, err ? err : -EIO);
	if (link->state == USB_LINK_GONE)
		return -ENODEV;
	return err == -ENOMEM ? err : -EIO;
}

/* Sends the sync, and waits for it to come back. */
static int sync_echo(struct accel_usb_link *link, uint32_t nonce)
{
	int err;

	pthread_mutex_lock(&link->lock);
	err = sync_echo_locked(link, nonce);
	pthread_mutex_unlock(&link->lock);
	if (err && !accel_usb_sync_drain(link))
		err = -ENODEV;
	return err;
}

static int sync_read_boot(struct accel_usb_link *link)
{
	uint32_t boot;
	int err = accel_usb_node_read(link->node, GLOSS_REG_BOOT, &boot);

	if (err || boot == link->boot)
		return err;
	pthread_mutex_lock(&link->lock);
	link->powerless = true;
	pthread_mutex_unlock(&link->lock);
	return -ENODEV;
}

/*
 * Whether it is still the board that was opened, with what its memory held. One that has lost its
 * power behind a bridge that has not looks the same but for this. When it loses that after the
 * sync, it is unsynchronised, and so is looked at again.
 */
static int sync_check_boot(struct accel_usb_link *link)
{
	int err = sync_read_boot(link);

	if (!err)
		return 0;
	pthread_mutex_lock(&link->lock);
	accel_usb_link_break_locked(link, err);
	pthread_mutex_unlock(&link->lock);
	return accel_usb_sync_drain(link) ? err : -ENODEV;
}

static int sync_once(struct accel_usb_link *link)
{
	uint32_t nonce = 0;
	int err;

	err = sync_claim(link);
	if (!err)
		err = sync_clear_halts(link);
	if (!err)
		err = sync_reset(link);
	if (!err)
		err = sync_set_boot(link);
	if (!err)
		err = sync_random(&nonce);
	if (!err)
		err = accel_usb_node_write(link->node, GLOSS_REG_NONCE, nonce);
	if (!err)
		err = sync_echo(link, nonce);
	return err ? err : sync_check_boot(link);
}

static int sync_attempts(struct accel_usb_link *link)
{
	int err = -EIO;

	for (int attempt = 0; attempt < ATTEMPTS && err == -EIO; attempt++) {
		if (attempt)
			sync_pause(PAUSE_MS << 2 * attempt);
		err = sync_once(link);
	}
	return err;
}

static bool sync_less(struct accel_usb_link *link)
{
	bool less;

	pthread_mutex_lock(&link->lock);
	less = accel_usb_transfers_less_locked(link);
	pthread_mutex_unlock(&link->lock);
	return less;
}

int accel_usb_sync(struct accel_usb_link *link)
{
	int err;

	do {
		err = sync_attempts(link);
	} while (err == -ENOMEM && sync_less(link));
	return err;
}
