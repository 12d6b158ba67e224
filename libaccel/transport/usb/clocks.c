// SPDX-License-Identifier: MIT
/* The board's clock and stall counters, summed over resets and wraps. */
#include <errno.h>

#include "gloss_regs.h"
#include "transport/usb/link_priv.h"

#define ATTEMPTS 4

/* The halves belong together when the upper one is the same before and after the lower one. */
static int clocks_read_clocks(struct accel_usb_node *node, uint64_t *clocks)
{
	uint32_t low = 0, high = 0, again = 0;
	int err;

	err = accel_usb_node_read(node, GLOSS_REG_CLOCKS_HIGH, &again);
	for (int attempt = 0; attempt < ATTEMPTS && !err; attempt++) {
		high = again;
		err = accel_usb_node_read(node, GLOSS_REG_CLOCKS_LOW, &low);
		if (!err)
			err = accel_usb_node_read(node, GLOSS_REG_CLOCKS_HIGH, &again);
		if (!err && again == high) {
			*clocks = (uint64_t)high << 32 | low;
			return 0;
		}
	}
	return err ? err : -EIO;
}

static int clocks_read_stalls(struct accel_usb_node *node, uint32_t stall[5])
{
	static const uint16_t offset[] = {
		GLOSS_REG_STALL_STREAM, GLOSS_REG_STALL_RASTER,   GLOSS_REG_STALL_TILE,
		GLOSS_REG_STALL_MEMORY, GLOSS_REG_STALL_RESPONSE,
	};
	int err = 0;

	for (int i = 0; i < 5 && !err; i++)
		err = accel_usb_node_read(node, offset[i], &stall[i]);
	return err;
}

static void clocks_add(uint64_t *sum, uint64_t *last, uint32_t now)
{
	*sum += (uint32_t)(now - (uint32_t)*last);
	*last = now;
}

/* With clocks.lock. An error leaves all as it was. */
static int clocks_update_locked(struct accel_usb_link *link)
{
	struct accel_device_clocks *sum = &link->clocks.sum, *last = &link->clocks.last;
	uint32_t stall[5];
	uint64_t clocks;
	int err;

	err = clocks_read_clocks(link->node, &clocks);
	if (!err)
		err = clocks_read_stalls(link->node, stall);
	if (err)
		return err;
	sum->clocks += clocks - last->clocks;
	last->clocks = clocks;
	clocks_add(&sum->stall_stream, &last->stall_stream, stall[0]);
	clocks_add(&sum->stall_raster, &last->stall_raster, stall[1]);
	clocks_add(&sum->stall_tile, &last->stall_tile, stall[2]);
	clocks_add(&sum->stall_memory, &last->stall_memory, stall[3]);
	clocks_add(&sum->stall_response, &last->stall_response, stall[4]);
	return 0;
}

void accel_usb_clocks_keep(struct accel_usb_link *link)
{
	if (!link->boot)
		return;
	pthread_mutex_lock(&link->clocks.lock);
	clocks_update_locked(link);
	pthread_mutex_unlock(&link->clocks.lock);
}

void accel_usb_clocks_restart(struct accel_usb_link *link)
{
	pthread_mutex_lock(&link->clocks.lock);
	link->clocks.last = (struct accel_device_clocks){ 0 };
	pthread_mutex_unlock(&link->clocks.lock);
}

/* A board that has done jobs in no time has no clock. */
static int clocks_check(struct accel_usb_link *link)
{
	uint32_t jobs = 0;
	int err = 0;

	if (!link->clocks.sum.clocks)
		err = accel_usb_node_read(link->node, GLOSS_REG_JOBS, &jobs);
	return !err && jobs ? -ENOTSUP : err;
}

int accel_usb_clocks_read(struct accel_usb_link *link, struct accel_device_clocks *clocks)
{
	int err;

	if (accel_usb_link_is_gone(link))
		return -ENODEV;
	pthread_mutex_lock(&link->clocks.lock);
	err = clocks_update_locked(link);
	if (!err)
		err = clocks_check(link);
	*clocks = link->clocks.sum;
	pthread_mutex_unlock(&link->clocks.lock);
	return err;
}
