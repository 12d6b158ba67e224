// SPDX-License-Identifier: MIT
#include "window/surface.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "accel.h"
#include "window/device.h"
#include "window/x11.h"

struct gloss_surface {
	atomic_uint references;
	const struct gloss_config *config;
	struct gloss_x11 *x11; /* NULL: a pbuffer */
	int width, height;
	struct accel_target *target; /* of that size; NULL: not yet */
	bool measured;               /* the window's size is known to be current */
	bool fresh, touched;
	int interval;
	int64_t shown; /* when the last picture was due, nanoseconds */
};

#define SECOND INT64_C(1000000000)
#define REFRESH (SECOND / 60)

static int surface_side(int side)
{
	return side < ACCEL_TARGET_SIZE_MAX ? side : ACCEL_TARGET_SIZE_MAX;
}

/* Takes over the size of the window; a target of another size is of no more use. */
static bool surface_measure(struct gloss_surface *surface)
{
	int width, height;

	if (!surface->x11 || surface->measured)
		return true;
	if (gloss_x11_size(surface->x11, &width, &height))
		return false;
	surface->measured = true;
	width = surface_side(width);
	height = surface_side(height);
	if (width == surface->width && height == surface->height)
		return true;
	accel_target_free(surface->target);
	surface->target = NULL;
	surface->width = width;
	surface->height = height;
	return true;
}

static int surface_first_interval(void)
{
	const char *mode = getenv("vblank_mode");

	return mode && !strcmp(mode, "0") ? 0 : 1;
}

struct gloss_surface *gloss_surface_new(const struct gloss_config *config, struct gloss_x11 *x11,
					int width, int height)
{
	struct gloss_surface *surface = calloc(1, sizeof(*surface));

	if (!surface)
		return NULL;
	surface->references = 1;
	surface->config = config;
	surface->width = surface_side(width);
	surface->height = surface_side(height);
	surface->x11 = x11;
	surface->interval = surface_first_interval();
	surface_measure(surface);
	return surface;
}

struct gloss_surface *gloss_surface_ref(struct gloss_surface *surface)
{
	if (surface)
		surface->references++;
	return surface;
}

void gloss_surface_unref(struct gloss_surface *surface)
{
	if (!surface || --surface->references)
		return;
	gloss_x11_close(surface->x11);
	accel_target_free(surface->target);
	free(surface);
}

struct accel_target *gloss_surface_target(struct gloss_surface *surface)
{
	struct accel_device *device;

	if (!surface_measure(surface))
		return NULL;
	if (surface->target)
		return surface->target;
	device = gloss_device();
	if (!device || accel_target_new(device, surface->width, surface->height, &surface->target))
		surface->target = NULL;
	surface->fresh = surface->target;
	return surface->target;
}

bool gloss_surface_fresh(struct gloss_surface *surface)
{
	bool fresh = surface->fresh;

	surface->fresh = false;
	return fresh;
}

int gloss_surface_width(const struct gloss_surface *surface)
{
	return surface->width;
}

int gloss_surface_height(const struct gloss_surface *surface)
{
	return surface->height;
}

const struct gloss_config *gloss_surface_config(const struct gloss_surface *surface)
{
	return surface->config;
}

void gloss_surface_touched(struct gloss_surface *surface)
{
	surface->touched = true;
}

void gloss_surface_flushed(struct gloss_surface *surface)
{
	if (surface->touched && !surface->config->double_buffered)
		gloss_surface_present(surface);
}

int gloss_surface_present(struct gloss_surface *surface)
{
	int err = 0;

	surface->touched = false;
	if (surface->x11 && surface->target)
		err = gloss_x11_put(surface->x11, surface->target, surface->width, surface->height);
	surface->measured = false;
	return err;
}

int gloss_surface_copy(struct gloss_surface *surface, struct gloss_x11 *x11)
{
	if (!surface->target)
		return 0;
	return gloss_x11_put(x11, surface->target, surface->width, surface->height);
}

void gloss_surface_set_interval(struct gloss_surface *surface, int interval)
{
	surface->interval = interval < GLOSS_INTERVAL_MAX ? interval : GLOSS_INTERVAL_MAX;
}

int gloss_surface_interval(const struct gloss_surface *surface)
{
	return surface->interval;
}

void gloss_surface_pace(struct gloss_surface *surface)
{
	struct timespec time;
	int64_t now, due;

	if (!surface->x11 || !surface->interval)
		return;
	clock_gettime(CLOCK_MONOTONIC, &time);
	now = time.tv_sec * SECOND + time.tv_nsec;
	due = surface->shown + surface->interval * REFRESH;
	if (due > now) {
		time.tv_sec = (time_t)(due / SECOND);
		time.tv_nsec = (long)(due % SECOND);
		while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, NULL) == EINTR)
			;
	}
	surface->shown = due > now ? due : now;
}

void gloss_surface_leave(struct gloss_surface *surface)
{
	gloss_x11_close(surface->x11);
	surface->x11 = NULL;
}

bool gloss_surface_alive(struct gloss_surface *surface)
{
	int width, height;

	return !surface->x11 || !gloss_x11_size(surface->x11, &width, &height);
}
