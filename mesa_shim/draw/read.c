// SPDX-License-Identifier: MIT
#include "draw/read.h"

#include <stdlib.h>
#include <string.h>

#include "state/command.h"
#include "window/surface.h"

void gloss_read_forget(struct gloss_context *context)
{
	context->cache.plane[ACCEL_PLANE_COLOUR].valid = false;
	context->cache.plane[ACCEL_PLANE_DEPTH].valid = false;
}

void gloss_read_free(struct gloss_context *context)
{
	free(context->cache.plane[ACCEL_PLANE_COLOUR].pixel);
	free(context->cache.plane[ACCEL_PLANE_DEPTH].pixel);
}

static bool read_reserve(struct gloss_read_plane *plane, size_t size)
{
	uint32_t *pixel;

	if (size <= plane->room)
		return true;
	pixel = realloc(plane->pixel, size);
	if (!pixel)
		return false;
	plane->pixel = pixel;
	plane->room = size;
	return true;
}

const uint32_t *gloss_read_plane(struct gloss_context *context, enum accel_plane which)
{
	struct gloss_read_cache *cache = &context->cache;
	struct gloss_read_plane *plane = &cache->plane[which];
	struct accel_target *target;
	size_t pitch;

	if (!context->read_surface)
		return NULL;
	if (plane->valid)
		return plane->pixel;
	gloss_context_flush(context);
	target = gloss_surface_target(context->read_surface);
	cache->width = gloss_surface_width(context->read_surface);
	cache->height = gloss_surface_height(context->read_surface);
	pitch = (size_t)cache->width * sizeof(*plane->pixel);
	if (!target || !read_reserve(plane, pitch * (size_t)cache->height)) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return NULL;
	}
	plane->valid = !accel_target_read(target, which, NULL, plane->pixel, pitch);
	return plane->valid ? plane->pixel : NULL;
}

static void read_unpack(const struct gloss_context *context, enum accel_plane plane, uint32_t word,
			float rgba[4])
{
	if (plane == ACCEL_PLANE_DEPTH) {
		rgba[0] = (float)((double)(word & 0xffffff) / 0xffffff);
		return;
	}
	for (int i = 0; i < 4; i++)
		rgba[i] = (float)((const uint8_t *)&word)[i] / 255;
	if (!context->visual.alpha)
		rgba[3] = 1;
}

void gloss_read_row(struct gloss_context *context, enum accel_plane plane, int64_t x, int64_t y,
		    int count, float (*row)[4])
{
	const uint32_t *from = gloss_read_plane(context, plane);
	const struct gloss_read_cache *cache = &context->cache;
	const int64_t line = cache->height - 1 - y;

	memset(row, 0, (size_t)count * sizeof(*row));
	if (!from || line < 0 || line >= cache->height)
		return;
	for (int i = 0; i < count; i++)
		if (x + i >= 0 && x + i < cache->width)
			read_unpack(context, plane, from[line * cache->width + x + i], row[i]);
}
