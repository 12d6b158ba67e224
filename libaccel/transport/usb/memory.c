// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "transport/usb/job_message.h"
#include "transport/usb/memory.h"
#include "transport/usb/zero.h"

/* A range of board memory; the library knows it by its base. */
struct usb_object {
	struct usb_object *next;
	uint64_t base;
	uint32_t size;  /* that a job can reach */
	uint32_t tiles; /* that it has, to be cleared */
	bool cleared;
	uint64_t clearing; /* the job that does it, 0: none */
};

void accel_usb_memory_init(struct accel_usb_memory *memory, struct accel_usb_link *link,
			   const struct accel_transport_info *info)
{
	*memory = (struct accel_usb_memory){ .link = link, .tile_size = info->tile_size };
	accel_range_init(&memory->ranges, info->memory_size);
}

/* The pointer to it, or to where the list ends. */
static struct usb_object **memory_find(struct accel_usb_memory *memory, uint64_t base)
{
	struct usb_object **link = &memory->objects;

	while (*link && (*link)->base != base)
		link = &(*link)->next;
	return link;
}

int accel_usb_memory_new(struct accel_usb_memory *memory, uint64_t size, uint64_t *object)
{
	uint64_t tile_bytes = accel_usb_zero_tile_bytes(memory->tile_size);
	uint64_t tiles = (size + tile_bytes - 1) / tile_bytes;
	struct usb_object *new;
	int err;

	if (accel_usb_link_is_gone(memory->link))
		return -ENODEV;
	new = malloc(sizeof(*new));
	if (!new)
		return -ENOMEM;
	err = accel_range_new(&memory->ranges, tiles * tile_bytes, object);
	if (err) {
		free(new);
		return err;
	}
	*new = (struct usb_object){
		.next = memory->objects,
		.base = *object,
		.size = (uint32_t)size,
		.tiles = (uint32_t)tiles,
	};
	memory->objects = new;
	return 0;
}

/*
 * The range may be used again at once, though it is still being cleared: what clears it for its
 * next owner, and that one's jobs, come after that.
 */
void accel_usb_memory_free(struct accel_usb_memory *memory, uint64_t base)
{
	struct usb_object **link = memory_find(memory, base), *object = *link;

	if (object->clearing)
		accel_usb_link_forget(memory->link, object->clearing);
	*link = object->next;
	free(object);
	accel_range_free(&memory->ranges, base);
}

/* A slot without rights is an empty one; to a stream it is the same. */
int accel_usb_memory_slots(struct accel_usb_memory *memory, const struct accel_transport_job *from,
			   uint32_t *words)
{
	for (uint32_t i = 0; i < from->slots; i++) {
		struct gloss_slot_entry slot = { .base = 0 };

		if (from->slot[i].rights) {
			const struct usb_object *object = *memory_find(memory,
								       from->slot[i].object);

			if (!object)
				return -EINVAL;
			slot = (struct gloss_slot_entry){
				.base = (uint32_t)object->base,
				.size = object->size,
				.rights = from->slot[i].rights,
			};
		}
		gloss_slot_entry_pack(words + i * GLOSS_SLOT_ENTRY_WORDS, &slot);
	}
	return 0;
}

/* Queues the job that makes the object zero. */
static int memory_clear_queue(struct accel_usb_memory *memory, struct usb_object *object,
			      uint64_t losses)
{
	uint32_t tile_size = memory->tile_size, *words;
	const struct gloss_slot_entry slot = {
		.base = (uint32_t)object->base,
		.size = object->tiles * accel_usb_zero_tile_bytes(tile_size),
		.rights = GLOSS_RIGHTS_WRITE,
	};
	const struct accel_transport_job from = {
		.stream_words = accel_usb_zero_words(object->tiles),
		.slots = 1,
	};
	struct accel_usb_job *job = accel_usb_job_message_begin(memory->link, &from, &words);
	int err;

	if (!job)
		return -ENOMEM;
	job->must = true;
	gloss_slot_entry_pack(words, &slot);
	accel_usb_zero_pack(words + GLOSS_SLOT_ENTRY_WORDS, tile_size, object->tiles);
	accel_usb_job_message_finish(job);
	err = accel_usb_link_submit(memory->link, job, losses, &object->clearing);
	if (err)
		accel_usb_job_free(memory->link, job);
	return err;
}

/* As accel_usb_memory_clear, for one object. */
static int memory_clear(struct accel_usb_memory *memory, struct usb_object *object, uint64_t losses)
{
	struct gloss_status status;
	int err;

	if (object->cleared)
		return 0;
	if (object->clearing) {
		err = accel_usb_link_wait(memory->link, object->clearing, 0, &status);
		if (err == -ETIMEDOUT)
			return 0;
		object->clearing = 0;
		object->cleared = !err;
		if (!err)
			return 0;
	}
	return memory_clear_queue(memory, object, losses);
}

int accel_usb_memory_clear(struct accel_usb_memory *memory, const struct accel_transport_job *from,
			   uint64_t losses)
{
	int err = 0;

	for (uint32_t i = 0; i < from->slots && !err; i++) {
		struct usb_object *object;

		if (!from->slot[i].rights)
			continue;
		object = *memory_find(memory, from->slot[i].object);
		err = object ? memory_clear(memory, object, losses) : -EINVAL;
	}
	return err;
}
