// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "draw/content.h"

/* Words that are read by one job: at least a row. */
#define READ_WORDS 65536u

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

/* Reads rows that have pixels, as many at a time as one job does. */
static int target_read_part(struct accel_target *target, struct accel_buffer *buffer,
			    const struct accel_rectangle *part, uint8_t *pixels, size_t pitch)
{
	uint32_t width = (uint32_t)part->width, height = (uint32_t)part->height;
	uint32_t step = READ_WORDS / width < height ? READ_WORDS / width : height;
	uint64_t offset = (uint64_t)part->y * target->pitch + (uint64_t)part->x * 4;
	uint32_t *words;
	int err = 0;

	words = malloc((size_t)width * step * sizeof(*words));
	if (!words)
		return -ENOMEM;
	for (uint32_t y = 0; y < height && !err; y += step) {
		uint32_t rows = height - y < step ? height - y : step;

		err = accel_buffer_read_rows(buffer, offset + (uint64_t)y * target->pitch,
					     target->pitch, width, rows, words);
		for (uint32_t row = 0; row < rows && !err; row++)
			memcpy(pixels + (y + row) * pitch, words + (size_t)row * width,
			       (size_t)width * 4);
	}
	free(words);
	return err;
}

int accel_target_read(struct accel_target *target, enum accel_plane plane,
		      const struct accel_rectangle *part, void *pixels, size_t pitch)
{
	const struct accel_rectangle all = { 0, 0, target->width, target->height };
	int err;

	if (!part)
		part = &all;
	err = target_check(target, plane, part, pitch);
	if (err || !part->width || !part->height)
		return err;
	return target_read_part(target,
				plane == ACCEL_PLANE_COLOUR ? target->colour : target->depth, part,
				pixels, pitch);
}
