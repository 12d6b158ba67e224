/* SPDX-License-Identifier: MIT */
/* Random jobs: what they answer, and the beginning of each slot. */
#include "usb_trial_priv.h"

#define READ_WORDS 4096u /* of each slot */
#define DAMAGED_EVERY 4

/* A slot of the library is not empty, has rights, and ends at a word. */
static uint32_t slot_words(const struct gloss_slot *slot)
{
	return slot->size < 4 ? 1 : slot->size / 4;
}

static uint32_t slot_read_words(const struct gloss_slot *slot)
{
	return slot_words(slot) < READ_WORDS ? slot_words(slot) : READ_WORDS;
}

static int job_slots(const struct item *item, struct job_side *side, unsigned int rights)
{
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++) {
		unsigned int own = item->random.job.slot[n].rights;
		int slot = accel_stream_slot(side->stream, side->buffer[n],
					     rights ? rights :
					     own    ? own :
						      ACCEL_SLOT_READ);

		if (slot < 0)
			return slot;
	}
	return 0;
}

static int job_read_back(const struct item *item, struct job_side *side)
{
	uint32_t words[1 + GLOSS_READ_MEMORY_WORDS];
	int err = job_slots(item, side, ACCEL_SLOT_READ);

	for (unsigned int n = 0; n < GLOSS_SLOTS && !err; n++) {
		const struct gloss_read_memory packet = {
			.slot = n,
			.count = slot_read_words(&item->random.job.slot[n]),
		};

		gloss_read_memory_pack(words, &packet);
		err = accel_stream_emit(side->stream, words, 1 + GLOSS_READ_MEMORY_WORDS);
	}
	if (err)
		return err;
	return accel_stream_submit(side->stream, side->content, item->content_words,
				   &side->fence[1]);
}

int trial_job_submit(const struct item *item, struct job_side *side, struct accel_device *device)
{
	const struct accel_job *job = &item->random.job;
	int err = accel_stream_new(device, &side->stream);

	for (unsigned int n = 0; n < GLOSS_SLOTS && !err; n++)
		err = accel_buffer_new(device, 4ull * slot_words(&job->slot[n]), &side->buffer[n]);
	if (!err)
		err = job_slots(item, side, 0);
	if (!err)
		err = accel_stream_emit(side->stream, job->stream, job->stream_words);
	if (!err)
		err = accel_stream_submit(side->stream, side->response, job->response_words,
					  &side->fence[0]);
	return err ? err : job_read_back(item, side);
}

/* The first error; -EIO with a fault is none. */
int trial_job_finish(struct job_side *side)
{
	int err = 0;

	for (int n = 0; n < 2 && side->fence[n]; n++) {
		struct accel_fence_status status = { 0 };

		side->result[n] = accel_fence_wait(side->fence[n], -1, &status, sizeof(status));
		if (side->result[n] == -EIO && status.fault)
			side->result[n] = 0;
		if (n == 0)
			side->status = status;
		if (!err)
			err = side->result[n];
		accel_fence_free(side->fence[n]);
	}
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++)
		accel_buffer_free(side->buffer[n]);
	accel_stream_free(side->stream);
	return err;
}

void trial_job_prepare(struct item *item, unsigned int tile_size)
{
	const struct accel_job *job = &item->random.job;

	stream_random_valid(&item->random, item->seed, (int)tile_size);
	if (item->seed % DAMAGED_EVERY == 0)
		stream_random_damage(&item->random);
	item->content_words = 0;
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++)
		item->content_words += slot_read_words(&job->slot[n]);
	for (int n = 0; n < 2; n++) {
		item->job[n].response = trial_memory((size_t)job->response_words + 1, 4);
		item->job[n].content = trial_memory(item->content_words, 4);
	}
}

/* What ended well is right, if what was before it did, too. */
void trial_job_compare(const struct item *item)
{
	const struct job_side *board = &item->job[0], *model = &item->job[1];
	const struct accel_fence_status *is = &board->status, *ought = &model->status;

	if (!board->fence[0] || board->result[0])
		return;
	if (is->fault != ought->fault || is->offset != ought->offset ||
	    is->response_words != ought->response_words)
		usb_trial_fail("seed %#llx: board fault %u at %u, %u answered; "
			       "model fault %u at %u, %u answered",
			       (unsigned long long)item->seed, is->fault, is->offset,
			       is->response_words, ought->fault, ought->offset,
			       ought->response_words);
	trial_compare_words(item, "the answer", board->response, model->response,
			    ought->response_words);
	if (board->fence[1] && !board->result[1])
		trial_compare_words(item, "all slots", board->content, model->content,
				    item->content_words);
}
