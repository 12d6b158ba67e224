// SPDX-License-Identifier: MIT
/* Painters of this project: the library on a board, and per-pixel Phong in plain C. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "painter.h"
#include "scene/phong.h"

struct library {
	const struct way *way;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	size_t pitch;
};

static void *open_library(const struct way *way, const struct scene *scene,
			  char message[PAINTER_MESSAGE])
{
	struct library *library = calloc(1, sizeof(*library));

	if (library && !accel_device_new(way->device, NULL, NULL, &library->device) &&
	    !accel_target_new(library->device, scene->width, scene->height, &library->target) &&
	    !accel_draw_new(library->device, &library->draw)) {
		library->way = way;
		library->pitch = scene->width * sizeof(uint32_t);
		return library;
	}
	snprintf(message, PAINTER_MESSAGE, "can not draw on %s", way->device);
	free(library);
	return NULL;
}

static int draw_library(void *painter, const struct scene *scene)
{
	struct library *library = painter;

	return scene_draw(scene, library->way->shading, library->draw, library->target, NULL);
}

static int read_library(void *painter, uint32_t *colour, uint32_t *depth)
{
	struct library *library = painter;
	int ret;

	ret = accel_target_read(library->target, ACCEL_PLANE_COLOUR, NULL, colour, library->pitch);
	return ret ? ret :
		     accel_target_read(library->target, ACCEL_PLANE_DEPTH, NULL, depth,
				       library->pitch);
}

const struct painter_ops painter_library = { open_library, draw_library, read_library };

static void *open_phong(const struct way *way, const struct scene *scene,
			char message[PAINTER_MESSAGE])
{
	struct phong_frame *frame = calloc(1, sizeof(*frame));

	if (frame && !phong_frame_new(scene, false, frame))
		return frame;
	snprintf(message, PAINTER_MESSAGE, "out of memory for %s", way->name);
	free(frame);
	return NULL;
}

static int draw_phong(void *painter, const struct scene *scene)
{
	return phong_draw(scene, painter);
}

static int read_phong(void *painter, uint32_t *colour, uint32_t *depth)
{
	const struct phong_frame *frame = painter;
	size_t pixels = (size_t)frame->width * frame->height;

	memcpy(colour, frame->pixel, pixels * sizeof(*colour));
	for (size_t i = 0; i < pixels; i++)
		depth[i] = (uint32_t)(frame->depth[i] * 0xffffff);
	return 0;
}

const struct painter_ops painter_phong = { open_phong, draw_phong, read_phong };
