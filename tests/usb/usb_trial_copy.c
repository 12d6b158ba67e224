/* SPDX-License-Identifier: MIT */
/* Words that are copied to the board and back. */
#include "usb_trial_priv.h"

#define COPY_BLOCK (GLOSS_LENGTH_MAX - 2) /* words of a packet */
#define COPY_BLOCKS 100

static int copy_emit(struct copy *copy)
{
	uint32_t words[1 + GLOSS_LENGTH_MAX], count = 0;
	int err = 0;

	for (uint32_t block = 0; block < copy->blocks && !err; block++) {
		const uint32_t offset = 4 * COPY_BLOCK * block;
		const struct gloss_write_memory write = { .slot = 0, .offset = offset };
		const struct gloss_read_memory read = { .slot = 0,
							.offset = offset,
							.count = COPY_BLOCK };

		gloss_write_memory_pack(words, &write, 2 + COPY_BLOCK);
		memcpy(words + 3, copy->sent + COPY_BLOCK * block, 4 * COPY_BLOCK);
		err = accel_stream_emit(copy->stream, words, 3 + COPY_BLOCK);
		gloss_read_memory_pack(words, &read);
		if (!err)
			err = accel_stream_emit(copy->stream, words, 1 + GLOSS_READ_MEMORY_WORDS);
		count += COPY_BLOCK;
	}
	return err ? err : accel_stream_submit(copy->stream, copy->back, count, &copy->fence);
}

int trial_copy_submit(struct copy *copy, struct accel_device *device)
{
	int err = accel_buffer_new(device, 4ull * COPY_BLOCK * copy->blocks, &copy->buffer);

	if (!err)
		err = accel_stream_new(device, &copy->stream);
	if (!err)
		err = accel_stream_slot(copy->stream, copy->buffer,
					ACCEL_SLOT_READ | ACCEL_SLOT_WRITE);
	return err < 0 ? err : copy_emit(copy);
}

int trial_copy_finish(struct copy *copy)
{
	bool submitted = copy->fence;

	copy->result = submitted ? accel_fence_wait(copy->fence, -1, NULL, 0) : -ENODEV;
	accel_fence_free(copy->fence);
	accel_stream_free(copy->stream);
	accel_buffer_free(copy->buffer);
	return submitted ? copy->result : 0;
}

void trial_copy_prepare(struct item *item)
{
	struct copy *copy = &item->copy;
	uint64_t seed = item->seed;

	copy->blocks = 1 + test_below(&seed, 1 + test_below(&seed, COPY_BLOCKS));
	copy->sent = trial_memory(COPY_BLOCK * copy->blocks, 4);
	copy->back = trial_memory(COPY_BLOCK * copy->blocks, 4);
	for (uint32_t n = 0; n < COPY_BLOCK * copy->blocks; n++)
		copy->sent[n] = (uint32_t)test_random(&seed);
}

void trial_copy_compare(const struct item *item)
{
	if (!item->copy.result)
		trial_compare_words(item, "a copy", item->copy.back, item->copy.sent,
				    COPY_BLOCK * item->copy.blocks);
}
