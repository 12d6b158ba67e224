// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "draw/content.h"

/* Words that are read or written by one job: at least a row. */
#define JOB_WORDS 65536u

/* Bits of a word of depth that are its depth. */
#define DEPTH_MASK 0xffffffu

static uint32_t target_align(int pixels)
{
	return ((uint32_t)pixels + ACCEL_TARGET_ALIGN - 1) / ACCEL_TARGET_ALIGN *
	       ACCEL_TARGET_ALIGN;
}

int accel_target_new(struct accel_device *device, int width, int height, struct accel_target **out)
{
	struct accel_target *target;
	uint64_t size;
	int err;

	if (width < 1 || width > ACCEL_TARGET_SIZE_MAX || height < 1 ||
	    height > ACCEL_TARGET_SIZE_MAX) {
		accel_device_message(device, "a target of %d x %d pixels: a side has 1 to %d",
				     width, height, ACCEL_TARGET_SIZE_MAX);
		return -EINVAL;
	}
	target = malloc(sizeof(*target));
	if (!target)
		return -ENOMEM;
	*target = (struct accel_target){
		.device = device,
		.width = width,
		.height = height,
		.pitch = target_align(width) * 4,
		.rows = target_align(height),
	};
	size = (uint64_t)target->pitch * target->rows;
	err = accel_buffer_new(device, size, &target->colour);
	if (err)
		goto err_free;
	err = accel_buffer_new(device, size, &target->depth);
	if (err)
		goto err_free_colour;
	err = accel_content_new(target, &target->content);
	if (err)
		goto err_free_depth;
	accel_device_ref(device);
	*out = target;
	return 0;

err_free_depth:
	accel_buffer_free(target->depth);
err_free_colour:
	accel_buffer_free(target->colour);
err_free:
	free(target);
	return err;
}

void accel_target_free(struct accel_target *target)
{
	if (!target)
		return;
	accel_content_unref(target->content);
	accel_buffer_free(target->depth);
	accel_buffer_free(target->colour);
	accel_device_unref(target->device);
	free(target);
}

static int target_check(const struct accel_target *target, enum accel_plane plane,
			const struct accel_rectangle *part, size_t pitch)
{
	if (plane != ACCEL_PLANE_COLOUR && plane != ACCEL_PLANE_DEPTH) {
		accel_device_message(target->device, "a target has no plane %u", plane);
		return -EINVAL;
	}
	if (part->x < 0 || part->x > target->width || part->y < 0 || part->y > target->height ||
	    part->width < 0 || part->width > target->width - part->x || part->height < 0 ||
	    part->height > target->height - part->y) {
		accel_device_message(target->device,
				     "%d x %d pixels at %d, %d of a target of "
				     "%d x %d",
				     part->width, part->height, part->x, part->y, target->width,
				     target->height);
		return -EINVAL;
	}
	if (pitch < (size_t)part->width * 4 || pitch % 4) {
		accel_device_message(target->device, "a pitch of %zu bytes for rows of %d pixels",
				     pitch, part->width);
		return -EINVAL;
	}
	return 0;
}

static struct accel_buffer *target_buffer(const struct accel_target *target, enum accel_plane plane)
{
	return plane == ACCEL_PLANE_COLOUR ? target->colour : target->depth;
}

/* Rows that are copied together, as many as one job does. */
struct copy {
	struct accel_buffer *buffer;
	uint64_t offset;        /* in it, of the first row */
	uint32_t pitch;         /* bytes from a row to the next */
	uint32_t width, height; /* of all rows, which have pixels */
	uint32_t step;          /* rows of a job */
	uint32_t *words;        /* of these */
};

/* -ENOMEM. */
static int target_copy_init(struct copy *copy, const struct accel_target *target,
			    enum accel_plane plane, const struct accel_rectangle *part)
{
	const uint32_t width = (uint32_t)part->width, height = (uint32_t)part->height;

	*copy = (struct copy){
		.buffer = target_buffer(target, plane),
		.offset = (uint64_t)part->y * target->pitch + (uint64_t)part->x * 4,
		.pitch = target->pitch,
		.width = width,
		.height = height,
		.step = JOB_WORDS / width < height ? JOB_WORDS / width : height,
	};
	copy->words = malloc((size_t)width * copy->step * sizeof(*copy->words));
	return copy->words ? 0 : -ENOMEM;
}

/* How many rows the job from row @y on has. */
static uint32_t target_copy_rows(const struct copy *copy, uint32_t y)
{
	return copy->height - y < copy->step ? copy->height - y : copy->step;
}

static int target_read_rows(struct copy *copy, uint8_t *pixels, size_t pitch)
{
	const size_t width = copy->width;
	int err = 0;

	for (uint32_t y = 0; y < copy->height && !err; y += copy->step) {
		const uint32_t rows = target_copy_rows(copy, y);

		err = accel_buffer_read_rows(copy->buffer, copy->offset + (uint64_t)y * copy->pitch,
					     copy->pitch, copy->width, rows, copy->words);
		for (uint32_t row = 0; row < rows && !err; row++)
			memcpy(pixels + (y + row) * pitch, copy->words + row * width, width * 4);
	}
	return err;
}

/* @mask: the bits of a pixel that it has. */
static int target_write_rows(struct copy *copy, const uint8_t *pixels, size_t pitch, uint32_t mask)
{
	const size_t width = copy->width;
	int err = 0;

	for (uint32_t y = 0; y < copy->height && !err; y += copy->step) {
		const uint32_t rows = target_copy_rows(copy, y);

		for (uint32_t row = 0; row < rows; row++)
			memcpy(copy->words + row * width, pixels + (y + row) * pitch, width * 4);
		for (size_t i = 0; i < rows * width; i++)
			copy->words[i] &= mask;
		err = accel_buffer_write_rows(copy->buffer,
					      copy->offset + (uint64_t)y * copy->pitch, copy->pitch,
					      copy->width, rows, copy->words);
	}
	return err;
}

int accel_target_read(struct accel_target *target, enum accel_plane plane,
		      const struct accel_rectangle *part, void *pixels, size_t pitch)
{
	const struct accel_rectangle all = { 0, 0, target->width, target->height };
	struct copy copy;
	int err;

	if (!part)
		part = &all;
	err = target_check(target, plane, part, pitch);
	if (err || !part->width || !part->height)
		return err;
	err = target_copy_init(&copy, target, plane, part);
	if (!err)
		err = target_read_rows(&copy, pixels, pitch);
	free(copy.words);
	return err;
}

int accel_target_write(struct accel_target *target, enum accel_plane plane,
		       const struct accel_rectangle *part, const void *pixels, size_t pitch)
{
	const struct accel_rectangle all = { 0, 0, target->width, target->height };
	struct copy copy;
	int err;

	if (!part)
		part = &all;
	err = target_check(target, plane, part, pitch);
	if (err || !part->width || !part->height)
		return err;
	err = target_copy_init(&copy, target, plane, part);
	if (!err)
		err = target_write_rows(&copy, pixels, pitch,
					plane == ACCEL_PLANE_DEPTH ? DEPTH_MASK : UINT32_MAX);
	free(copy.words);
	return err;
}
