// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"
#include "dump.h"
#include "transport/thread.h"

#define STREAM_ROOM_FIRST 1024u
#define PARTS_ROOM_FIRST 64u
#define NOWHERE ((size_t)-1)

struct accel_stream {
	struct accel_device *device;
	bool is_copy;    /* of the library's own: not dumped */
	uint32_t *words; /* its own */
	size_t count, room;
	/* What it consists of if some words are lent; with NULL the next of its own. */
	struct accel_transport_part *part;
	size_t parts, parts_room;
	size_t in_parts;                          /* of its own words */
	size_t lent;                              /* words */
	struct accel_buffer *buffer[GLOSS_SLOTS]; /* a reference each */
	unsigned int rights[GLOSS_SLOTS];
	unsigned int slots;
};

int accel_stream_new(struct accel_device *device, struct accel_stream **out)
{
	struct accel_stream *stream = calloc(1, sizeof(*stream));

	if (!stream)
		return -ENOMEM;
	stream->device = accel_device_ref(device);
	*out = stream;
	return 0;
}

int accel_stream_new_copy(struct accel_device *device, struct accel_stream **out)
{
	int err = accel_stream_new(device, out);

	if (!err)
		(*out)->is_copy = true;
	return err;
}

struct accel_device *accel_stream_device(const struct accel_stream *stream)
{
	return stream->device;
}

void accel_stream_free(struct accel_stream *stream)
{
	if (!stream)
		return;
	accel_stream_reset(stream);
	accel_device_unref(stream->device);
	free(stream->part);
	free(stream->words);
	free(stream);
}

/* Of words, and of slots whose buffers somebody else has now. */
static void stream_empty(struct accel_stream *stream)
{
	stream->count = stream->parts = stream->in_parts = stream->lent = 0;
	stream->slots = 0;
}

void accel_stream_reset(struct accel_stream *stream)
{
	while (stream->slots)
		accel_buffer_unref(stream->buffer[--stream->slots]);
	stream_empty(stream);
}

/* The place of @words in those of the stream; NOWHERE: they are not among them. */
static size_t stream_place(const struct accel_stream *stream, const uint32_t *words)
{
	uintptr_t from = (uintptr_t)stream->words, at = (uintptr_t)words;

	if (!from || at < from || at >= from + stream->count * sizeof(*words))
		return NOWHERE;
	return (at - from) / sizeof(*words);
}

/*
 * @array with room for @count elements of @size bytes, instead of *@room: @first to begin with, and
 * twice as many each time, so that an element costs the same in the end. NULL: out of memory, and
 * nothing has changed.
 */
static void *stream_grow(void *array, size_t size, size_t *room, size_t first, size_t count)
{
	size_t larger = *room ? *room : first;
	void *grown;

	while (larger < count)
		larger *= 2;
	grown = realloc(array, larger * size);
	if (grown)
		*room = larger;
	return grown;
}

/* Room for @count words in all. */
static int stream_reserve(struct accel_stream *stream, size_t count)
{
	uint32_t *words;

	if (count <= stream->room)
		return 0;
	words = stream_grow(stream->words, sizeof(*words), &stream->room, STREAM_ROOM_FIRST, count);
	if (!words)
		return -ENOMEM;
	stream->words = words;
	return 0;
}

static int stream_check(const struct accel_stream *stream, size_t count)
{
	if (count <= ACCEL_STREAM_WORDS_MAX - stream->count - stream->lent)
		return 0;
	accel_device_message(stream->device, "a stream of more than %u words",
			     ACCEL_STREAM_WORDS_MAX);
	return -E2BIG;
}

int accel_stream_emit(struct accel_stream *stream, const uint32_t *words, size_t count)
{
	size_t place = stream_place(stream, words);
	int err;

	if (!count)
		return 0;
	err = stream_check(stream, count);
	if (!err)
		err = stream_reserve(stream, stream->count + count);
	if (err)
		return err;
	if (place != NOWHERE)
		words = stream->words + place;
	memcpy(stream->words + stream->count, words, count * sizeof(*words));
	stream->count += count;
	return 0;
}

/* Room for @count parts in all. */
static int stream_reserve_parts(struct accel_stream *stream, size_t count)
{
	struct accel_transport_part *part;

	if (count <= stream->parts_room)
		return 0;
	part = stream_grow(stream->part, sizeof(*part), &stream->parts_room, PARTS_ROOM_FIRST,
			   count);
	if (!part)
		return -ENOMEM;
	stream->part = part;
	return 0;
}

/* Those of its own words that are in no part are one, and the last. There is room. */
static void stream_part_own(struct accel_stream *stream)
{
	if (stream->count == stream->in_parts)
		return;
	stream->part[stream->parts++] = (struct accel_transport_part){
		.count = stream->count - stream->in_parts,
	};
	stream->in_parts = stream->count;
}

int accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count)
{
	int err;

	if (!count)
		return 0;
	err = stream_check(stream, count);
	/* With its own words before and after them. */
	if (!err)
		err = stream_reserve_parts(stream, stream->parts + 3);
	if (err)
		return err;
	stream_part_own(stream);
	stream->part[stream->parts++] = (struct accel_transport_part){ words, count };
	stream->lent += count;
	return 0;
}

/* While its own words do not move. NULL: it is not in parts. */
static const struct accel_transport_part *stream_parts(struct accel_stream *stream)
{
	const uint32_t *own = stream->words;

	if (!stream->lent)
		return NULL;
	stream_part_own(stream);
	for (size_t i = 0; i < stream->parts; i++)
		if (!stream->part[i].words) {
			stream->part[i].words = own;
			own += stream->part[i].count;
		}
	return stream->part;
}

/* When they may move again. */
static void stream_forget_places(struct accel_stream *stream)
{
	for (size_t i = 0; i < stream->parts; i++)
		if (stream_place(stream, stream->part[i].words) != NOWHERE)
			stream->part[i].words = NULL;
}

static unsigned int stream_find(const struct accel_stream *stream,
				const struct accel_buffer *buffer)
{
	unsigned int slot = 0;

	while (slot < stream->slots && stream->buffer[slot] != buffer)
		slot++;
	return slot;
}

int accel_stream_slot(struct accel_stream *stream, struct accel_buffer *buffer, unsigned int rights)
{
	unsigned int slot = stream_find(stream, buffer);

	if (buffer->device != stream->device || !rights ||
	    rights & ~(ACCEL_SLOT_READ | ACCEL_SLOT_WRITE)) {
		accel_device_message(stream->device, "a slot for %s",
				     buffer->device != stream->device ?
					     "the buffer of another device" :
					     "no rights that there are");
		return -EINVAL;
	}
	if (slot == GLOSS_SLOTS) {
		accel_device_message(stream->device, "a stream that names more than %u buffers",
				     GLOSS_SLOTS);
		return -ENOSPC;
	}
	if (slot == stream->slots) {
		stream->buffer[slot] = accel_buffer_ref(buffer);
		stream->rights[slot] = 0;
		stream->slots++;
	}
	stream->rights[slot] |= rights;
	return (int)slot;
}

const uint32_t *accel_stream_words(const struct accel_stream *stream, size_t *count)
{
	*count = stream->count;
	return stream->words;
}

/* What a job may write is no longer what it was. */
static void stream_count_writes(const struct accel_stream *stream)
{
	for (unsigned int i = 0; i < stream->slots; i++)
		if (stream->rights[i] & ACCEL_SLOT_WRITE)
			atomic_fetch_add(&stream->buffer[i]->written, 1);
}

static int stream_start(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
			uint64_t *sequence)
{
	struct accel_transport_slot slot[GLOSS_SLOTS];
	const struct accel_transport_job job = {
		.stream = stream->lent ? NULL : stream->words,
		.part = stream_parts(stream),
		.stream_words = (uint32_t)(stream->count + stream->lent),
		.response = response,
		.response_words = response_words,
		.slot = slot,
		.slots = stream->slots,
	};
	struct accel_device *device = stream->device;
	int err, held;

	for (unsigned int i = 0; i < stream->slots; i++)
		slot[i] = (struct accel_transport_slot){
			.object = stream->buffer[i]->object,
			.rights = (enum gloss_rights)stream->rights[i],
		};
	if (!stream->is_copy)
		accel_dump_job(device, &job, stream->buffer);
	err = accel_device_enter(device, &held);
	if (err)
		return err;
	err = device->ops->submit(device->state, &job, sequence);
	accel_device_leave(device, held);
	return err;
}

/* Without the device's lock, for others may have it meanwhile. */
static void stream_wait_for_room(const struct accel_stream *stream)
{
	const struct accel_device *device = stream->device;
	int held;

	if (!device->ops->wait_for_room || accel_device_is_inherited(device))
		return;
	held = accel_thread_hold_cancel();
	device->ops->wait_for_room(device->state);
	accel_thread_allow_cancel(held);
}

int accel_stream_send(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
		      struct accel_fence *fence)
{
	uint64_t sequence;
	int err;

	if (response_words && !response) {
		accel_device_message(stream->device, "no buffer for %u response words",
				     response_words);
		return -EINVAL;
	}
	err = accel_fence_reserve(fence);
	if (err)
		return err;
	stream_wait_for_room(stream);
	err = stream_start(stream, response, response_words, &sequence);
	if (err) {
		stream_forget_places(stream);
		accel_device_message(stream->device, "a job was not taken: %s",
				     accel_device_why(stream->device, err));
		return err;
	}
	stream_count_writes(stream);
	accel_fence_add(fence, sequence, stream->buffer, stream->slots);
	stream_empty(stream);
	return 0;
}

/* *@fence is that of the job. */
static int stream_send_alone(struct accel_stream *stream, uint32_t *response,
			     uint32_t response_words, struct accel_fence **fence)
{
	int err;

	*fence = accel_fence_new(stream->device);
	if (!*fence)
		return -ENOMEM;
	err = accel_stream_send(stream, response, response_words, *fence);
	if (err)
		accel_fence_free(*fence);
	return err;
}

int accel_stream_submit(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
			struct accel_fence **out)
{
	struct accel_fence *fence;
	int err;

	if (response_words && !out) {
		accel_device_message(stream->device,
				     "a response that nobody waits for: give "
				     "accel_stream_submit a fence, or call accel_stream_finish");
		return -EINVAL;
	}
	err = stream_send_alone(stream, response, response_words, &fence);
	if (!err)
		accel_fence_give(fence, out);
	return err;
}

int accel_stream_finish(struct accel_stream *stream, uint32_t *response, uint32_t response_words)
{
	struct accel_fence *fence;
	int err = stream_send_alone(stream, response, response_words, &fence);

	return err ? err : accel_fence_finish(fence);
}
