// SPDX-License-Identifier: MIT
#include "draw/read.h"

#include <stdlib.h>

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
