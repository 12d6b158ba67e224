// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"

#define STREAM_ROOM_FIRST 1024u

struct accel_stream {
	struct accel_device *device;
	uint32_t *words;
	size_t count, room;
	struct accel_buffer *buffer[GLOSS_SLOTS];	/* a reference each */
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

void accel_stream_free(struct accel_stream *stream)
{
	if (!stream)
		return;
	accel_stream_reset(stream);
	accel_device_unref(stream->device);
	free(stream->words);
	free(stream);
}

void accel_stream_reset(struct accel_stream *stream)
{
	stream->count = 0;
	while (stream->slots)
		accel_buffer_unref(stream->buffer[--stream->slots]);
}

/* Room for @count words in all; it doubles, so that a word costs the same in the end. */
static int stream_reserve(struct accel_stream *stream, size_t count)
{
	size_t room = stream->room ? stream->room : STREAM_ROOM_FIRST;
	uint32_t *words;

	if (count <= stream->room)
		return 0;
	while (room < count)
		room *= 2;
	words = realloc(stream->words, room * sizeof(*words));
	if (!words)
		return -ENOMEM;
	stream->words = words;
	stream->room = room;
	return 0;
}

int accel_stream_emit(struct accel_stream *stream, const uint32_t *words, size_t count)
{
	int err;

	if (!count)
		return 0;
	if (count > ACCEL_STREAM_WORDS_MAX - stream->count) {
		accel_device_message(stream->device, "a stream of more than %u words",
				     ACCEL_STREAM_WORDS_MAX);
		return -E2BIG;
	}
	err = stream_reserve(stream, stream->count + count);
	if (err)
		return err;
	memcpy(stream->words + stream->count, words, count * sizeof(*words));
	stream->count += count;
	return 0;
}

static unsigned int stream_find(const struct accel_stream *stream,
				const struct accel_buffer *buffer)
{
	unsigned int slot = 0;

	while (slot < stream->slots && stream->buffer[slot] != buffer)
		slot++;
	return slot;
}

int accel_stream_slot(struct accel_stream *stream, struct accel_buffer *buffer,
		      unsigned int rights)
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

static int stream_start(const struct accel_stream *stream, uint32_t *response,
			uint32_t response_words, uint64_t *sequence)
{
	struct accel_transport_slot slot[GLOSS_SLOTS];
	const struct accel_transport_job job = {
		.stream = stream->words,
		.stream_words = (uint32_t)stream->count,
		.response = response,
		.response_words = response_words,
		.slot = slot,
		.slots = stream->slots,
	};
	struct accel_device *device = stream->device;
	unsigned int i;
	int err;

	for (i = 0; i < stream->slots; i++)
		slot[i] = (struct accel_transport_slot){
			.object = stream->buffer[i]->object,
			.rights = (enum gloss_rights)stream->rights[i],
		};
	pthread_mutex_lock(&device->lock);
	err = device->ops->submit(device->state, &job, sequence);
	pthread_mutex_unlock(&device->lock);
	return err;
}

int accel_stream_submit(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
			struct accel_fence **out)
{
	struct accel_fence *fence;
	uint64_t sequence;
	int err;

	if (response_words && !response) {
		accel_device_message(stream->device, "no buffer for %u response words",
				     response_words);
		return -EINVAL;
	}
	fence = accel_fence_new(stream->device);
	if (!fence)
		return -ENOMEM;
	err = stream_start(stream, response, response_words, &sequence);
	if (err) {
		accel_device_message(stream->device, "a job was not taken: %s", strerror(-err));
		accel_fence_free(fence);
		return err;
	}
	accel_fence_begin(fence, sequence, stream->buffer, stream->slots);
	stream->slots = 0;
	stream->count = 0;
	if (out) {
		*out = fence;
		return 0;
	}
	err = accel_fence_wait(fence, -1, NULL);
	accel_fence_free(fence);
	return err;
}
