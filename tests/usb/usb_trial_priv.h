/* SPDX-License-Identifier: MIT */
/*
 * The items of a trial, as the files of usb_trial.h share them: jobs in usb_trial_job.c, pictures in
 * usb_trial_picture.c, copies in usb_trial_copy.c. Of each kind an item is prepared, is submitted
 * to the board and to the model and finished on both, which tells the first error, and is compared.
 */
#ifndef USB_TRIAL_PRIV_H
#define USB_TRIAL_PRIV_H

#include "accel_test.h"
#include "stream_random.h"
#include "usb_trial.h"

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

void trial_job_prepare(struct item *item, unsigned int tile_size);
int trial_job_submit(const struct item *item, struct job_side *side, struct accel_device *device);
int trial_job_finish(struct job_side *side);
void trial_job_compare(const struct item *item);

void trial_picture_prepare(struct item *item);
int trial_picture_submit(const struct item *item, struct picture_side *side,
			 struct accel_device *device);
int trial_picture_finish(const struct item *item, struct picture_side *side);
void trial_picture_compare(const struct item *item);

/* What is right is known without the model. */
void trial_copy_prepare(struct item *item);
int trial_copy_submit(struct copy *copy, struct accel_device *device);
int trial_copy_finish(struct copy *copy);
void trial_copy_compare(const struct item *item);

/* Cleared; out of memory ends the process, as does a word that differs. */
void *trial_memory(size_t count, size_t size);
void trial_compare_words(const struct item *item, const char *what, const uint32_t *board,
			 const uint32_t *model, size_t count);

#endif
