// SPDX-License-Identifier: MIT
/*
 * "usb:": a board on a cable, through libusb. The library has it for itself, hands out its memory
 * (memory.h) and clears that with jobs of its own; link.h has the jobs.
 */
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gloss_regs.h"
#include "transport/usb/job_message.h"
#include "transport/usb/memory.h"
#include "transport/usb/node.h"

#define MEMORY_PAGES_MAX (1u << 20)
#define ATTEMPTS 3 /* to submit a job */

struct transport_usb {
	struct accel_usb_node node;
	struct accel_usb_link *link;
	struct accel_transport_info info;
	struct accel_usb_memory memory;
};

/* ---- opening ---- */

static bool usb_info_fits(const struct accel_transport_info *info, uint32_t pages)
{
	return (info->tile_size == 32 || info->tile_size == 64) && pages &&
	       pages <= MEMORY_PAGES_MAX && info->pixels_per_clock && info->pixels_per_clock <= 8 &&
	       !(info->pixels_per_clock & (info->pixels_per_clock - 1));
}

/* With its serial number, if there is room for it. */
static void usb_name(struct accel_transport_info *info, const char *serial)
{
	const int room = sizeof(info->name);

	if (snprintf(info->name, room, "Gloss USB board%s%s, %u-pixel tiles, %u lanes",
		     *serial ? " " : "", serial, info->tile_size, info->pixels_per_clock) >= room)
		snprintf(info->name, room, "Gloss USB board, %u-pixel tiles, %u lanes",
			 info->tile_size, info->pixels_per_clock);
}

static int usb_read_registers(struct accel_usb_node *node, uint32_t *value)
{
	static const uint16_t offset[] = {
		GLOSS_REG_IDENTITY,
		GLOSS_REG_VERSION,
		GLOSS_REG_CAPABILITIES,
		GLOSS_REG_MEMORY_PAGES,
	};
	int err = 0;

	for (size_t i = 0; i < sizeof(offset) / sizeof(offset[0]) && !err; i++)
		err = accel_usb_node_read(node, offset[i], &value[i]);
	return err;
}

static int usb_identify(struct transport_usb *transport, struct accel_transport_error *error)
{
	struct accel_transport_info *info = &transport->info;
	const char *name = transport->node.name;
	uint32_t value[4];
	int err = usb_read_registers(&transport->node, value);

	if (err) {
		accel_transport_say(error,
				    err == -ENOMEM ? "%s: " USB_NO_MEMORY : "%s does not answer",
				    name);
		return err == -ENOMEM ? err : -ENODEV;
	}
	*info = (struct accel_transport_info){
		.version = value[1],
		.tile_size = value[2] & GLOSS_REG_CAPABILITIES_TILE_SIZE,
		.pixels_per_clock = (value[2] & GLOSS_REG_CAPABILITIES_PIXELS_PER_CLOCK) >> 8,
		.memory_size = (uint64_t)value[3] * GLOSS_PAGE_BYTES,
	};
	if (value[0] != GLOSS_IDENTITY)
		accel_transport_say(error, "%s is no Gloss board: its IDENTITY is 0x%08x", name,
				    value[0]);
	else if (info->version != GLOSS_VERSION)
		accel_transport_say(error, "%s speaks version %u of the stream, not %u", name,
				    info->version, GLOSS_VERSION);
	else if (!usb_info_fits(info, value[3]))
		accel_transport_say(error,
				    "%s is no Gloss board that there is: %u-pixel tiles, "
				    "%u lanes, %u pages",
				    name, info->tile_size, info->pixels_per_clock, value[3]);
	else
		return 0;
	return -ENODEV;
}

static int usb_start(struct transport_usb *transport, struct accel_transport_error *error)
{
	int err = accel_usb_link_new(&transport->node, &transport->link);

	if (!err)
		return 0;
	if (err == -ENOMEM)
		accel_transport_say(error, "%s: there is no memory; or " USB_NO_MEMORY,
				    transport->node.name);
	else
		accel_transport_say(error, "%s %s", transport->node.name,
				    err == -ENODEV ? "is gone" :
						     "does not answer as a Gloss board does");
	return err == -ENOMEM ? err : -ENODEV;
}

/* The link is gone, or there was none. What is in flight for ever keeps what it may still use. */
static void usb_free(struct transport_usb *transport)
{
	if (transport->node.stuck)
		return;
	accel_usb_node_close(&transport->node);
	accel_range_fini(&transport->memory.ranges);
	free(transport);
}

static int transport_usb_open(const char *where, void **state, struct accel_transport_error *error)
{
	struct transport_usb *transport = calloc(1, sizeof(*transport));
	int err;

	if (!transport)
		return -ENOMEM;
	err = accel_usb_node_open(where, &transport->node, error);
	if (err) {
		free(transport);
		return err;
	}
	err = usb_identify(transport, error);
	if (!err)
		err = usb_start(transport, error);
	if (err) {
		usb_free(transport);
		return err;
	}
	usb_name(&transport->info, transport->node.serial);
	accel_usb_memory_init(&transport->memory, transport->link, &transport->info);
	*state = transport;
	return 0;
}

static void transport_usb_close(void *state)
{
	struct transport_usb *transport = state;

	accel_usb_link_free(transport->link);
	usb_free(transport);
}

static void transport_usb_info(void *state, struct accel_transport_info *info)
{
	const struct transport_usb *transport = state;

	*info = transport->info;
}

static int transport_usb_memory_new(void *state, uint64_t size, uint64_t *object)
{
	struct transport_usb *transport = state;

	return accel_usb_memory_new(&transport->memory, size, object);
}

static void transport_usb_memory_free(void *state, uint64_t base)
{
	struct transport_usb *transport = state;

	accel_usb_memory_free(&transport->memory, base);
}

/* ---- jobs ---- */

/* A board that fails again and again between a clearing job and the job fails this one, too. */
static int usb_job_submit(struct transport_usb *transport, struct accel_usb_job *job,
			  const struct accel_transport_job *from, uint64_t *sequence)
{
	int err = -EAGAIN;

	for (int attempt = 0; attempt < ATTEMPTS && err == -EAGAIN; attempt++) {
		uint64_t losses = accel_usb_link_losses(transport->link);

		err = accel_usb_memory_clear(&transport->memory, from, losses);
		if (!err)
			err = accel_usb_link_submit(transport->link, job, losses, sequence);
	}
	return err == -EAGAIN ? -EIO : err;
}

static int transport_usb_submit(void *state, const struct accel_transport_job *from,
				uint64_t *sequence)
{
	struct transport_usb *transport = state;
	struct accel_usb_job *job;
	uint32_t *words;
	int err;

	if (from->slots > GLOSS_SLOTS)
		return -EINVAL;
	job = accel_usb_job_message_begin(transport->link, from, &words);
	if (!job)
		return -ENOMEM;
	err = accel_usb_memory_slots(&transport->memory, from, words);
	accel_transport_copy(from, words + (size_t)from->slots * GLOSS_SLOT_ENTRY_WORDS);
	accel_usb_job_message_finish(job);
	if (!err)
		err = usb_job_submit(transport, job, from, sequence);
	if (err)
		accel_usb_job_free(transport->link, job);
	return err;
}

static void transport_usb_wait_for_room(void *state)
{
	struct transport_usb *transport = state;

	accel_usb_link_wait_for_room(transport->link);
}

static int transport_usb_wait(void *state, uint64_t sequence, int64_t timeout_ns,
			      struct gloss_status *status)
{
	struct transport_usb *transport = state;

	return accel_usb_link_wait(transport->link, sequence, timeout_ns, status);
}

static int transport_usb_clocks(void *state, struct accel_device_clocks *clocks)
{
	struct transport_usb *transport = state;

	return accel_usb_clocks_read(transport->link, clocks);
}

static const char *transport_usb_why(void *state, int err)
{
	struct transport_usb *transport = state;

	return accel_usb_link_why(transport->link, err);
}

const struct accel_transport_ops accel_transport_usb = {
	.scheme = "usb",
	.open = transport_usb_open,
	.list = accel_usb_node_list,
	.close = transport_usb_close,
	.info = transport_usb_info,
	.memory_new = transport_usb_memory_new,
	.memory_free = transport_usb_memory_free,
	.wait_for_room = transport_usb_wait_for_room,
	.submit = transport_usb_submit,
	.wait = transport_usb_wait,
	.clocks = transport_usb_clocks,
	.why = transport_usb_why,
};
