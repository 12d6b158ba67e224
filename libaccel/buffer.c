// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"

#define BUFFER_SIZE_MAX (1ull << 31)

/* Words that one packet carries, and that one job does, which bounds what waits in memory. */
#define WRITE_WORDS (GLOSS_LENGTH_MAX - 2)
#define WRITE_JOB_WORDS (64 * WRITE_WORDS)
/* READ_MEMORY counts its words in 16 bits. */
#define ROW_WORDS_MAX 65535u

int accel_buffer_new(struct accel_device *device, uint64_t size, struct accel_buffer **out)
{
	struct accel_buffer *buffer;
	int err, held;

	if (!size || size > BUFFER_SIZE_MAX || size % 4) {
		accel_device_message(device, "a buffer can not have %llu bytes",
				     (unsigned long long)size);
		return -EINVAL;
	}
	buffer = malloc(sizeof(*buffer));
	if (!buffer)
		return -ENOMEM;
	*buffer = (struct accel_buffer){ .size = size, .references = 1 };
	err = accel_device_enter(device, &held);
	if (err)
		goto err_free;
	err = device->ops->memory_new(device->state, size, &buffer->object);
	accel_device_leave(device, held);
	if (err)
		goto err_message;
	buffer->device = accel_device_ref(device);
	*out = buffer;
	return 0;

err_message:
	accel_device_message(device, "no board memory for a buffer of %llu bytes: %s",
			     (unsigned long long)size,
			     err == -ENOMEM ? "there is not as much left" :
					      accel_device_why(device, err));
err_free:
	free(buffer);
	return err;
}

struct accel_buffer *accel_buffer_ref(struct accel_buffer *buffer)
{
	atomic_fetch_add(&buffer->references, 1);
	return buffer;
}

void accel_buffer_unref(struct accel_buffer *buffer)
{
	struct accel_device *device = buffer->device;

	if (atomic_fetch_sub(&buffer->references, 1) != 1)
		return;
	accel_device_free_buffer(device, buffer);
	accel_device_unref(device);
}

void accel_buffer_busy(struct accel_buffer *buffer, uint64_t sequence)
{
	uint64_t before = atomic_load(&buffer->busy);

	while (before < sequence && !atomic_compare_exchange_weak(&buffer->busy, &before, sequence))
		;
}

void accel_buffer_free(struct accel_buffer *buffer)
{
	if (buffer)
		accel_buffer_unref(buffer);
}

/* ---- copies ---- */

static int buffer_check(const struct accel_buffer *buffer, uint64_t offset, uint64_t size)
{
	if (offset % 4 == 0 && size % 4 == 0 && offset <= buffer->size &&
	    size <= buffer->size - offset)
		return 0;
	accel_device_message(buffer->device, "%llu bytes at %llu of a buffer of %llu",
			     (unsigned long long)size, (unsigned long long)offset,
			     (unsigned long long)buffer->size);
	return -EINVAL;
}

static int buffer_emit_write(struct accel_stream *stream, uint32_t slot, uint32_t offset,
			     const void *data, uint32_t count)
{
	const struct gloss_write_memory packet = { .slot = slot, .offset = offset };
	uint32_t words[1 + GLOSS_LENGTH_MAX];

	gloss_write_memory_pack(words, &packet, 2 + count);
	memcpy(words + 3, data, (size_t)count * 4);
	return accel_stream_emit(stream, words, 3 + count);
}

static int buffer_emit_writes(struct accel_stream *stream, struct accel_buffer *buffer,
			      uint32_t offset, const uint8_t *data, uint32_t count)
{
	int slot = accel_stream_slot(stream, buffer, ACCEL_SLOT_WRITE);
	int err = slot < 0 ? slot : 0;

	while (!err && count) {
		uint32_t now = count < WRITE_WORDS ? count : WRITE_WORDS;

		err = buffer_emit_write(stream, (uint32_t)slot, offset, data, now);
		offset += now * 4;
		data += (size_t)now * 4;
		count -= now;
	}
	return err;
}

/* One job; @count at most WRITE_JOB_WORDS. */
static int buffer_write_job(struct accel_stream *stream, struct accel_buffer *buffer,
			    uint32_t offset, const uint8_t *data, uint32_t count)
{
	int err = buffer_emit_writes(stream, buffer, offset, data, count);

	return err ? err : accel_stream_finish(stream, NULL, 0);
}

int accel_buffer_write(struct accel_buffer *buffer, uint64_t offset, const void *data,
		       uint64_t size)
{
	struct accel_stream *stream;
	const uint8_t *from = data;
	int err;

	err = buffer_check(buffer, offset, size);
	if (err)
		return err;
	err = accel_stream_new_copy(buffer->device, &stream);
	if (err)
		return err;
	while (!err && size) {
		uint64_t words = size / 4;
		uint32_t now = words < WRITE_JOB_WORDS ? (uint32_t)words : WRITE_JOB_WORDS;

		err = buffer_write_job(stream, buffer, (uint32_t)offset, from, now);
		from += (size_t)now * 4;
		offset += (uint64_t)now * 4;
		size -= (uint64_t)now * 4;
	}
	accel_stream_free(stream);
	return err;
}

int accel_buffer_write_rows(struct accel_buffer *buffer, uint64_t offset, uint32_t pitch,
			    uint32_t count, uint32_t rows, const uint32_t *words)
{
	struct accel_stream *stream;
	int err;

	err = accel_stream_new_copy(buffer->device, &stream);
	if (err)
		return err;
	for (uint32_t row = 0; row < rows && !err; row++)
		err = buffer_emit_writes(stream, buffer, (uint32_t)offset + row * pitch,
					 (const uint8_t *)(words + (size_t)row * count), count);
	if (!err)
		err = accel_stream_finish(stream, NULL, 0);
	accel_stream_free(stream);
	return err;
}

static int buffer_emit_reads(struct accel_stream *stream, struct accel_buffer *buffer,
			     uint64_t offset, uint32_t pitch, uint32_t count, uint32_t rows)
{
	struct gloss_read_memory packet = { .count = count, .offset = (uint32_t)offset };
	uint32_t words[1 + GLOSS_READ_MEMORY_WORDS];
	int slot = accel_stream_slot(stream, buffer, ACCEL_SLOT_READ);
	int err = slot < 0 ? slot : 0;

	packet.slot = (uint32_t)slot;
	while (!err && rows--) {
		gloss_read_memory_pack(words, &packet);
		err = accel_stream_emit(stream, words, 1 + GLOSS_READ_MEMORY_WORDS);
		packet.offset += pitch;
	}
	return err;
}

int accel_buffer_read_rows(struct accel_buffer *buffer, uint64_t offset, uint32_t pitch,
			   uint32_t count, uint32_t rows, uint32_t *words)
{
	struct accel_stream *stream;
	int err;

	err = accel_stream_new_copy(buffer->device, &stream);
	if (err)
		return err;
	err = buffer_emit_reads(stream, buffer, offset, pitch, count, rows);
	if (!err)
		err = accel_stream_finish(stream, words, count * rows);
	accel_stream_free(stream);
	return err;
}

int accel_buffer_read(struct accel_buffer *buffer, uint64_t offset, void *data, uint64_t size)
{
	uint8_t *to = data;
	uint32_t *words;
	int err;

	err = buffer_check(buffer, offset, size);
	if (err || !size)
		return err;
	words = malloc(ROW_WORDS_MAX * sizeof(*words));
	if (!words)
		return -ENOMEM;
	while (!err && size) {
		uint32_t now = size / 4 < ROW_WORDS_MAX ? (uint32_t)(size / 4) : ROW_WORDS_MAX;

		err = accel_buffer_read_rows(buffer, offset, 0, now, 1, words);
		if (!err)
			memcpy(to, words, (size_t)now * 4);
		to += (size_t)now * 4;
		offset += (uint64_t)now * 4;
		size -= (uint64_t)now * 4;
	}
	free(words);
	return err;
}
