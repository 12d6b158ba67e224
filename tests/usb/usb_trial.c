/* SPDX-License-Identifier: MIT */
#include "usb_trial.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stream_random.h"

#define ITEMS 4
#define SIDE_MAX 160 /* pixels */
#define TRIANGLES 5
#define READ_WORDS 4096u /* of each slot */
#define DAMAGED_EVERY 4
#define COPY_BLOCK (GLOSS_LENGTH_MAX - 2) /* words of a packet */
#define COPY_BLOCKS 100

/* What a device did for a job of the generator. */
struct job_side {
	struct accel_buffer *buffer[GLOSS_SLOTS];
	struct accel_stream *stream;
	struct accel_fence *fence[2]; /* of the job, and of reading back */
	struct accel_fence_status status;
	uint32_t *response, *content;
	int result[2];
};

struct picture_side {
	struct accel_target *target;
	struct accel_fence *fence;
	uint32_t *pixel;
	int result;
};

/* Words that go there and come back, block by block, so that both ways are busy at once. */
struct copy {
	struct accel_buffer *buffer;
	struct accel_stream *stream;
	struct accel_fence *fence;
	uint32_t *sent, *back;
	uint32_t blocks;
	int result;
};

enum item_kind { ITEM_JOB, ITEM_PICTURE, ITEM_COPY };

struct item {
	enum item_kind kind;
	uint64_t seed;
	uint32_t content_words;
	struct stream_random random;
	int width, height;
	struct job_side job[2]; /* of the board, of the model */
	struct picture_side drawn[2];
	struct copy copy;
};

static const char *context = "";

void usb_trial_context(const char *text)
{
	context = text;
}

void usb_trial_fail(const char *format, ...)
{
	va_list arguments;

	va_start(arguments, format);
	fprintf(stderr, "%s: ", context);
	vfprintf(stderr, format, arguments);
	fprintf(stderr, "\n");
	va_end(arguments);
	exit(1);
}

struct accel_device *usb_trial_model(unsigned int tile_size)
{
	struct accel_device *device;
	char name[64];

	snprintf(name, sizeof(name), "model:memory=8388608,tile=%u", tile_size);
	if (accel_device_new(name, NULL, NULL, &device))
		usb_trial_fail("%s does not open", name);
	return device;
}

static uint64_t next(uint64_t *seed)
{
	uint64_t z = *seed += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return z ^ z >> 31;
}

static uint32_t below(uint64_t *seed, uint32_t limit)
{
	return (uint32_t)(next(seed) % limit);
}

static void *memory(size_t count, size_t size)
{
	void *block = calloc(count, size);

	if (!block)
		usb_trial_fail("out of memory");
	return block;
}

/* ---- a job: what it answers, and the beginning of each slot ---- */

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

static int job_submit(const struct item *item, struct job_side *side, struct accel_device *device)
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
static int job_finish(struct job_side *side)
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

static void job_prepare(struct item *item, unsigned int tile_size)
{
	const struct accel_job *job = &item->random.job;

	stream_random_valid(&item->random, item->seed, (int)tile_size);
	if (item->seed % DAMAGED_EVERY == 0)
		stream_random_damage(&item->random);
	item->content_words = 0;
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++)
		item->content_words += slot_read_words(&job->slot[n]);
	for (int n = 0; n < 2; n++) {
		item->job[n].response = memory((size_t)job->response_words + 1, 4);
		item->job[n].content = memory(item->content_words, 4);
	}
}

static void compare_words(const struct item *item, const char *what, const uint32_t *board,
			  const uint32_t *model, size_t count)
{
	for (size_t n = 0; n < count; n++)
		if (board[n] != model[n])
			usb_trial_fail("seed %#llx: word %zu of %s: board %08x, model %08x",
				       (unsigned long long)item->seed, n, what, board[n], model[n]);
}

/* What ended well is right, if what was before it did, too. */
static void job_compare(const struct item *item)
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
	compare_words(item, "the answer", board->response, model->response, ought->response_words);
	if (board->fence[1] && !board->result[1])
		compare_words(item, "all slots", board->content, model->content,
			      item->content_words);
}

/* ---- a picture ---- */

static int picture_mesh(const struct item *item, struct accel_draw *draw,
			struct accel_target *target, struct accel_state *state)
{
	static const struct accel_clear black = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR |
								    ACCEL_CLEAR_DEPTH,
							    .depth = 1);
	float position[3 * TRIANGLES][3], colour[3 * TRIANGLES][4];
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3 * TRIANGLES,
						  .position = { .data = position },
						  .colour = { .data = colour });
	uint64_t seed = item->seed;
	int err;

	for (int n = 0; n < 3 * TRIANGLES; n++) {
		for (int i = 0; i < 3; i++)
			position[n][i] = (float)below(&seed, 2001) / 1000 - 1;
		for (int i = 0; i < 4; i++)
			colour[n][i] = (float)below(&seed, 256) / 255;
	}
	err = accel_draw_begin(draw, target, &black);
	return err ? err : accel_draw_mesh(draw, state, &mesh);
}

static int picture_submit(const struct item *item, struct picture_side *side,
			  struct accel_device *device)
{
	struct accel_state *state;
	struct accel_draw *draw = NULL;
	int err = accel_state_new(&state);

	if (err)
		return err;
	err = accel_target_new(device, item->width, item->height, &side->target);
	if (!err)
		err = accel_draw_new(device, &draw);
	if (!err)
		err = picture_mesh(item, draw, side->target, state);
	if (!err)
		err = accel_draw_submit(draw, &side->fence);
	accel_draw_free(draw);
	accel_state_free(state);
	return err;
}

static int picture_finish(const struct item *item, struct picture_side *side)
{
	bool submitted = side->fence;

	side->result = -ENODEV;
	if (submitted) {
		side->result = accel_fence_wait(side->fence, -1, NULL, 0);
		if (!side->result)
			side->result = accel_target_read(side->target, ACCEL_PLANE_COLOUR, NULL,
							 side->pixel, (size_t)item->width * 4);
		accel_fence_free(side->fence);
	}
	accel_target_free(side->target);
	return submitted ? side->result : 0;
}

static void picture_prepare(struct item *item)
{
	uint64_t seed = item->seed;

	item->width = 1 + (int)below(&seed, SIDE_MAX);
	item->height = 1 + (int)below(&seed, SIDE_MAX);
	for (int n = 0; n < 2; n++)
		item->drawn[n].pixel = memory((size_t)item->width * (size_t)item->height, 4);
}

static void picture_compare(const struct item *item)
{
	if (!item->drawn[0].result)
		compare_words(item, "a picture", item->drawn[0].pixel, item->drawn[1].pixel,
			      (size_t)item->width * (size_t)item->height);
}

/* ---- a copy: what is right is known without the model ---- */

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

static int copy_submit(struct copy *copy, struct accel_device *device)
{
	int err = accel_buffer_new(device, 4ull * COPY_BLOCK * copy->blocks, &copy->buffer);

	if (!err)
		err = accel_stream_new(device, &copy->stream);
	if (!err)
		err = accel_stream_slot(copy->stream, copy->buffer,
					ACCEL_SLOT_READ | ACCEL_SLOT_WRITE);
	return err < 0 ? err : copy_emit(copy);
}

static int copy_finish(struct copy *copy)
{
	bool submitted = copy->fence;

	copy->result = submitted ? accel_fence_wait(copy->fence, -1, NULL, 0) : -ENODEV;
	accel_fence_free(copy->fence);
	accel_stream_free(copy->stream);
	accel_buffer_free(copy->buffer);
	return submitted ? copy->result : 0;
}

static void copy_prepare(struct item *item)
{
	struct copy *copy = &item->copy;
	uint64_t seed = item->seed;

	copy->blocks = 1 + below(&seed, 1 + below(&seed, COPY_BLOCKS));
	copy->sent = memory(COPY_BLOCK * copy->blocks, 4);
	copy->back = memory(COPY_BLOCK * copy->blocks, 4);
	for (uint32_t n = 0; n < COPY_BLOCK * copy->blocks; n++)
		copy->sent[n] = (uint32_t)next(&seed);
}

static void copy_compare(const struct item *item)
{
	if (!item->copy.result)
		compare_words(item, "a copy", item->copy.back, item->copy.sent,
			      COPY_BLOCK * item->copy.blocks);
}

/* ---- all of them ---- */

/* On the board (@side 0) or the model. */
static int item_submit(struct item *item, int side, struct accel_device *device)
{
	switch (item->kind) {
	case ITEM_JOB:
		return job_submit(item, &item->job[side], device);
	case ITEM_PICTURE:
		return picture_submit(item, &item->drawn[side], device);
	default:
		return side ? 0 : copy_submit(&item->copy, device);
	}
}

static int item_finish(struct item *item, int side)
{
	switch (item->kind) {
	case ITEM_JOB:
		return job_finish(&item->job[side]);
	case ITEM_PICTURE:
		return picture_finish(item, &item->drawn[side]);
	default:
		return side ? 0 : copy_finish(&item->copy);
	}
}

static void item_compare(const struct item *item)
{
	switch (item->kind) {
	case ITEM_JOB:
		job_compare(item);
		break;
	case ITEM_PICTURE:
		picture_compare(item);
		break;
	default:
		copy_compare(item);
	}
}

static void item_prepare(struct item *item, uint64_t *seed, unsigned int tile_size)
{
	static const enum item_kind kind[] = {
		ITEM_JOB, ITEM_JOB, ITEM_JOB, ITEM_JOB, ITEM_PICTURE, ITEM_PICTURE, ITEM_COPY,
	};

	*item = (struct item){ .seed = next(seed), .kind = kind[below(seed, 7)] };
	if (item->kind == ITEM_JOB)
		job_prepare(item, tile_size);
	else if (item->kind == ITEM_PICTURE)
		picture_prepare(item);
	else
		copy_prepare(item);
}

static void item_free(struct item *item)
{
	for (int n = 0; n < 2; n++) {
		free(item->job[n].response);
		free(item->job[n].content);
		free(item->drawn[n].pixel);
	}
	free(item->copy.sent);
	free(item->copy.back);
}

static int items_run(struct item *items, int count, int side, struct accel_device *device)
{
	int err = 0, last;

	for (int n = 0; n < count && !err; n++)
		err = item_submit(&items[n], side, device);
	for (int n = 0; n < count; n++) {
		last = item_finish(&items[n], side);
		if (!err)
			err = last;
	}
	return err;
}

static void check_error(int err)
{
	if (err && err != -EIO && err != -ENODEV && err != -ENOMEM)
		usb_trial_fail("the error %s is none that a board may have", strerror(-err));
}

int usb_trial_run(struct accel_device *device, struct accel_device *model, uint64_t seed)
{
	struct item *items = memory(ITEMS, sizeof(*items));
	int count = 1 + (int)below(&seed, ITEMS), err;
	struct accel_device_info info;

	accel_device_info(device, &info, sizeof(info));
	for (int n = 0; n < count; n++)
		item_prepare(&items[n], &seed, info.tile_size);
	err = items_run(items, count, 0, device);
	check_error(err);
	if (items_run(items, count, 1, model))
		usb_trial_fail("the model failed");
	for (int n = 0; n < count; n++)
		item_compare(&items[n]);
	for (int n = 0; n < count; n++)
		item_free(&items[n]);
	free(items);
	return err;
}
