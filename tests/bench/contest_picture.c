// SPDX-License-Identifier: MIT
/* Whether the ways of a contest draw the same. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contest.h"
#include "scene/quality.h"

/*
 * The pixels at a contour show the surface in front or the one behind, as vertices are snapped:
 * those whose depths differ by more than SURFACE are counted for themselves, and may be STRAY of
 * the others.
 */
#define SURFACE (1.0f / 500)
#define STRAY 0.01

/* What pictures of one scene are compared with. */
struct references {
	struct phong_frame phong, gouraud;
};

static int new_references(const struct scene *scene, struct references *references)
{
	int ret = phong_frame_new(scene, true, &references->phong);

	if (ret)
		return ret;
	ret = phong_frame_new(scene, true, &references->gouraud);
	if (ret)
		phong_frame_free(&references->phong);
	return ret;
}

static void free_references(struct references *references)
{
	phong_frame_free(&references->phong);
	phong_frame_free(&references->gouraud);
}

/* Per-pixel Phong's coverage with the painter's colours. */
static void take_colours(struct references *references, const struct painter *painter)
{
	struct phong_frame *frame = &references->gouraud;

	memcpy(frame->depth, references->phong.depth, painter->pixels * sizeof(*frame->depth));
	for (size_t i = 0; i < painter->pixels; i++)
		for (int channel = 0; channel < 3; channel++)
			frame->light[i][channel] = (float)(painter->colour[i] >> 8 * channel &
							   0xff) /
						   255;
}

/* Takes what shows another surface for what is not covered. */
static void mark_strays(struct painter *painter, const struct phong_frame *frame)
{
	for (size_t i = 0; i < painter->pixels; i++)
		if (fabsf((float)painter->depth[i] / 0xffffff - frame->depth[i]) > SURFACE)
			painter->depth[i] = 0xffffff;
}

static int add_picture(struct contest *contest, enum contest_way way, const struct scene *scene,
		       struct references *references, struct quality *quality)
{
	const struct phong_frame *frame = contest->painter[way].way->as_gouraud ?
						  &references->gouraud :
						  &references->phong;
	struct painter *painter = &contest->painter[way];
	int ret = painter_picture(painter, scene);

	if (ret)
		return ret;
	if (way == CONTEST_GOURAUD)
		take_colours(references, painter);
	mark_strays(painter, frame);
	quality_add(quality, frame, painter->colour, painter->depth);
	return 0;
}

static int add_scene(struct contest *contest, const struct scene *scene,
		     struct references *references, struct quality quality[CONTEST_WAYS])
{
	int ret = phong_draw(scene, &references->phong);

	for (enum contest_way way = 0; way < CONTEST_WAYS && !ret; way++)
		if (contest_has(contest, way))
			ret = add_picture(contest, way, scene, references, &quality[way]);
	return ret;
}

static int judge(const struct way *way, const struct quality *quality, const char *name)
{
	double nmse = quality_nmse(quality);
	double stray = (double)quality->stray / (double)quality->pixels;

	printf("# %s: %s: NMSE against %s %.1e, at most %.1e; %.2f %% show another surface\n", name,
	       way->name, way->as_gouraud ? "gouraud" : "per-pixel Phong", nmse, way->nmse,
	       100 * stray);
	fflush(stdout);
	if (quality->pixels && nmse <= way->nmse && stray <= STRAY)
		return 0;
	fprintf(stderr, "%s: %s: not the picture that it should be, NMSE %.1e, %.2f %% stray\n",
		name, way->name, nmse, 100 * stray);
	return -EIO;
}

int contest_compare(struct contest *contest, const struct scene *scenes, int count,
		    const char *name)
{
	struct quality quality[CONTEST_WAYS] = { 0 };
	struct references references;
	int ret = new_references(scenes, &references), failed = 0;

	if (!ret) {
		for (int i = 0; i < count && !ret; i++)
			ret = add_scene(contest, &scenes[i], &references, quality);
		free_references(&references);
	}
	if (ret)
		fprintf(stderr, "%s: can not compare pictures: %s\n", name, strerror(-ret));
	for (enum contest_way way = 0; way < CONTEST_WAYS && !ret; way++)
		if (contest_has(contest, way) &&
		    judge(contest->painter[way].way, &quality[way], name))
			failed = -EIO;
	return ret ? ret : failed;
}
