// SPDX-License-Identifier: MIT
/* The device and what is drawn on it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "device.h"
#include "gloss-view.h"

static int failed(const char *what, const char *where, int error)
{
	view_error(what, where, device_reason(error));
	return VIEW_FAILED;
}

const char *view_shading_name(enum accel_shading shading)
{
	static const char *const names[] = {
		[ACCEL_SHADING_GOURAUD] = "gouraud",
		[ACCEL_SHADING_ADAPTIVE] = "adaptive",
		[ACCEL_SHADING_QUADRATIC] = "quadratic",
		[ACCEL_SHADING_FLAT] = "flat",
	};

	return names[shading];
}

static int open_mesh(struct view *view)
{
	const char *name = view->options->mesh;
	char message[MESH_MESSAGE];

	if (mesh_load(name, &view->options->reading, &view->mesh, message)) {
		fprintf(stderr, "gloss-view: %s\n", message);
		return VIEW_FAILED;
	}
	mesh_bounds(&view->mesh, view->centre, &view->radius);
	/* Its inverse scales the mesh, and must be a number too. */
	if (isfinite(view->radius) && view->radius > 1e-30f) {
		mesh_rescale(&view->mesh, view->centre, &view->radius);
		return VIEW_OK;
	}
	view_error("mesh has no size", name, "give one whose points are apart, and less than 1e38");
	return VIEW_FAILED;
}

static void open_scene(struct view *view)
{
	const struct view_options *options = view->options;
	struct scene *scene = &view->scene;

	scene_init(scene, options->width, options->height);
	scene->mesh = mesh_lend(&view->mesh);
	scene->two_sided = options->two_sided;
	scene->cull = options->two_sided ? ACCEL_CULL_NONE : ACCEL_CULL_BACK;
	scene->material[0] = scene->material[1] = options->material;
	memcpy(scene->background, options->background, sizeof(scene->background));
	view_camera_set(view, 0);
}

static int open_device(struct view *view)
{
	const struct view_options *options = view->options;
	const char *name = options->device;
	int ret;

	if (device_open("gloss-view", name, &view->device))
		return VIEW_FAILED;
	ret = accel_target_new(view->device, options->width, options->height, &view->target);
	if (ret)
		return failed("no memory for the picture on device", name, ret);
	ret = accel_draw_new(view->device, &view->draw);
	return ret ? failed("can not draw on device", name, ret) : VIEW_OK;
}

int view_open(struct view *view, const struct view_options *options)
{
	int ret;

	memset(view, 0, sizeof(*view));
	view->options = options;
	ret = open_mesh(view);
	if (ret == VIEW_OK)
		ret = open_device(view);
	if (ret == VIEW_OK)
		open_scene(view);
	return ret;
}

void view_close(struct view *view)
{
	accel_draw_free(view->draw);
	accel_target_free(view->target);
	accel_device_free(view->device);
	mesh_free(&view->mesh);
}

static uint64_t clocks(struct view *view)
{
	struct accel_device_clocks clocks;

	return accel_device_clocks(view->device, &clocks) ? 0 : clocks.clocks;
}

int view_draw(struct view *view, enum accel_shading shading, struct picture *picture)
{
	uint64_t before = clocks(view);
	int ret;

	device_reason_forget();
	ret = scene_draw(&view->scene, shading, view->draw, view->target, &view->stats);
	view->clocks = clocks(view) - before;
	if (!ret)
		ret = accel_target_read_colour(view->target, picture->pixel,
					       picture->width * sizeof(*picture->pixel));
	return ret ? failed("drawing failed", view->options->device, ret) : VIEW_OK;
}

int view_write(const struct picture *picture, const char *path)
{
	int ret = picture_write(picture, path);

	if (!ret)
		return VIEW_OK;
	view_error("can not write", path, strerror(-ret));
	return VIEW_FAILED;
}
