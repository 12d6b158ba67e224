// SPDX-License-Identifier: MIT
/* The device and what is drawn on it. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/device.h"
#include "view/view.h"

/* Light from everywhere on what has colours; materials have a reflectance of their own for it. */
#define PAINTED_AMBIENT 0.2f

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
	struct mesh_options reading = view->options->reading;
	char message[MESH_MESSAGE];
	struct waiting waiting;
	int ret;

	reading.waiting = waiting_show;
	reading.data = &waiting;
	waiting_begin(&waiting, name);
	ret = mesh_load(name, &reading, &view->mesh, message);
	waiting_end(&waiting);
	if (ret) {
		fprintf(stderr, "gloss-view: %s\n", message);
		return VIEW_FAILED;
	}
	mesh_bounds(&view->mesh, view->centre, &view->radius);
	/* Its inverse scales the mesh, and must be a number too. */
	if (!isfinite(view->radius) || view->radius < 1e-30f) {
		view_error("mesh has no size", name,
			   "give one whose points are apart, and less than 1e38");
		return VIEW_FAILED;
	}
	if (!mesh_has_area(&view->mesh)) {
		view_error("nothing of the mesh is visible", name,
			   "all its triangles are points or lines, give one with faces");
		return VIEW_FAILED;
	}
	mesh_rescale(&view->mesh, view->centre, &view->radius);
	return VIEW_OK;
}

void view_set_sides(struct view *view, bool two_sided)
{
	view->scene.two_sided = two_sided;
	view->scene.cull = two_sided ? ACCEL_CULL_NONE : ACCEL_CULL_BACK;
}

static void open_scene(struct view *view)
{
	const struct view_options *options = view->options;
	struct scene *scene = &view->scene;

	scene_init(scene, options->width, options->height);
	scene->mesh = mesh_lend(&view->mesh);
	view_set_sides(view, options->two_sided);
	scene->material[0] = scene->material[1] = options->material;
	scene->painted = view->mesh.colour && !options->recoloured;
	/* Colours are what the light that comes from everywhere is reflected by, too. */
	for (int i = 0; i < 3 && scene->painted; i++)
		scene->ambient[i] = PAINTED_AMBIENT;
	memcpy(scene->background, options->background, sizeof(scene->background));
	view_camera_frame(view);
	view_camera_set(view, 0);
}

static int at_most(int size)
{
	return size < ACCEL_TARGET_SIZE_MAX ? size : ACCEL_TARGET_SIZE_MAX;
}

static bool in_parts(const struct view_options *options)
{
	return options->width > ACCEL_TARGET_SIZE_MAX || options->height > ACCEL_TARGET_SIZE_MAX;
}

/* Memory for what is read back. */
static int open_pictures(struct view *view)
{
	const struct view_options *options = view->options;
	size_t pixels = (size_t)options->width * options->height;
	bool depth = options->stats || options->compare || (options->out && !options->turntable);

	if (in_parts(options) &&
	    picture_new(at_most(options->width), at_most(options->height), &view->part))
		return failed("out of memory", "picture", -ENOMEM);
	if (depth)
		view->depth = malloc(pixels * sizeof(*view->depth));
	return depth && !view->depth ? failed("out of memory", "picture", -ENOMEM) : VIEW_OK;
}

static int open_target(struct view *view)
{
	const struct view_options *options = view->options;
	int ret = accel_target_new(view->device, at_most(options->width), at_most(options->height),
				   &view->target);

	return ret ? failed("no memory for the picture on device", options->device, ret) : VIEW_OK;
}

static int open_device(struct view *view)
{
	const char *name = view->options->device;
	int ret;

	if (device_open("gloss-view", name, &view->device))
		return VIEW_FAILED;
	if (open_target(view) != VIEW_OK)
		return VIEW_FAILED;
	ret = accel_draw_new(view->device, &view->draw);
	return ret ? failed("can not draw on device", name, ret) : VIEW_OK;
}

static void close_pictures(struct view *view)
{
	picture_free(&view->part);
	free(view->depth);
	view->depth = NULL;
}

int view_resize(struct view *view)
{
	int ret;

	view->scene.width = view->options->width;
	view->scene.height = view->options->height;
	close_pictures(view);
	accel_target_free(view->target);
	view->target = NULL;
	ret = open_pictures(view);
	if (ret == VIEW_OK)
		ret = open_target(view);
	if (ret == VIEW_OK)
		view_camera_frame(view);
	return ret;
}

int view_load(struct view *view, const struct view_options *options)
{
	int ret;

	memset(view, 0, sizeof(*view));
	view->options = options;
	ret = open_mesh(view);
	if (ret == VIEW_OK)
		open_scene(view);
	return ret;
}

int view_open(struct view *view, const struct view_options *options)
{
	int ret = view_load(view, options);

	if (ret == VIEW_OK)
		ret = open_pictures(view);
	if (ret == VIEW_OK)
		ret = open_device(view);
	return ret;
}

void view_close(struct view *view)
{
	accel_draw_free(view->draw);
	accel_target_free(view->target);
	accel_device_free(view->device);
	close_pictures(view);
	mesh_free(&view->mesh);
}

static uint64_t clocks(struct view *view)
{
	struct accel_device_clocks clocks;

	return accel_device_clocks(view->device, &clocks, sizeof(clocks)) ? 0 : clocks.clocks;
}

/* Copies the part of the target that is in the picture to its place. */
static void copy_part(const struct view *view, uint32_t *pixels)
{
	const struct scene *scene = &view->scene;
	const struct picture *part = &view->part;
	int width = scene->width - scene->left, height = scene->height - scene->top;

	width = width < part->width ? width : part->width;
	height = height < part->height ? height : part->height;
	for (int row = 0; row < height; row++)
		memcpy(pixels + (size_t)(scene->top + row) * scene->width + scene->left,
		       part->pixel + (size_t)row * part->width, width * sizeof(*pixels));
}

/* Reads colour or depth of the whole target. */
static int read_part(struct view *view, uint32_t *pixels, enum accel_plane plane)
{
	bool parts = view->part.pixel != NULL;
	uint32_t *to = parts ? view->part.pixel : pixels;
	int width = parts ? view->part.width : view->scene.width;
	int ret = accel_target_read(view->target, plane, NULL, to, width * sizeof(*to));

	if (!ret && parts)
		copy_part(view, pixels);
	return ret;
}

static void add_stats(struct accel_draw_stats *sum, const struct accel_draw_stats *part)
{
	sum->triangles_in += part->triangles_in;
	sum->culled += part->culled;
	sum->clipped += part->clipped;
	sum->flat += part->flat;
	sum->linear += part->linear;
	sum->second_order += part->second_order;
	sum->split += part->split;
	sum->records += part->records;
	sum->stream_words += part->stream_words;
	sum->tiles += part->tiles;
}

static int draw_part(struct view *view, enum accel_shading shading, struct picture *picture)
{
	struct accel_draw_stats stats;
	int ret;

	view->scene.keeps_depth = view->depth;
	ret = scene_draw(&view->scene, shading, view->draw, view->target, &stats);
	if (!ret)
		ret = read_part(view, picture->pixel, ACCEL_PLANE_COLOUR);
	if (!ret && view->depth)
		ret = read_part(view, view->depth, ACCEL_PLANE_DEPTH);
	if (!ret)
		add_stats(&view->stats, &stats);
	return ret;
}

static uint64_t count_visible(const struct view *view)
{
	size_t pixels = (size_t)view->scene.width * view->scene.height;
	uint64_t visible = 0;

	for (size_t i = 0; view->depth && i < pixels; i++)
		visible += (view->depth[i] & 0xffffff) != 0xffffff;
	return visible;
}

int view_draw(struct view *view, enum accel_shading shading, struct picture *picture)
{
	uint64_t before = clocks(view);
	struct scene *scene = &view->scene;
	int ret = 0;

	device_reason_forget();
	memset(&view->stats, 0, sizeof(view->stats));
	for (int y = 0; y < scene->height && !ret; y += ACCEL_TARGET_SIZE_MAX) {
		for (int x = 0; x < scene->width && !ret; x += ACCEL_TARGET_SIZE_MAX) {
			scene->left = x;
			scene->top = y;
			ret = draw_part(view, shading, picture);
		}
	}
	view->clocks = clocks(view) - before;
	view->visible = count_visible(view);
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
