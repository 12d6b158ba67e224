// SPDX-License-Identifier: MIT
/*
 * Triangles of one or two pixels. No surface through their vertices and edges is as good as the
 * light at the pixels themselves, and none costs less: no edge has to be lit for them, none is
 * split, and what is sent is flat, or linear from the one pixel to the other.
 */
#include <string.h>

#include "draw/group.h"
#include "draw/kernel.h"

#define CHANNELS 4

void accel_few_find(struct accel_few *few, const struct accel_pass *pass,
		    const struct accel_setup *setup)
{
	few->count = 0;
	if (!pass->lit || pass->state->shading != ACCEL_SHADING_ADAPTIVE ||
	    setup->end - setup->first > ACCEL_LOOP_ROWS || setup->pixels > ACCEL_FEW)
		return;
	for (int y = setup->first; y < setup->end; y++) {
		const struct accel_row *row = &setup->row[y - setup->first];

		for (int x = row->left; x < row->right; x++)
			few->pixel[few->count++] = (struct accel_pixel){ x, y };
	}
}

/* Points that are lit together. */
struct points {
	int count;
	float *colour[ACCEL_BATCH]; /* where their light goes */
	struct accel_pixel_batch batch;
};

static void few_flush(const struct accel_pass *pass, struct points *points, int side)
{
	const struct accel_light_batch *light = &points->batch.light;

	accel_kernel()->pixel(&points->batch, points->count);
	accel_kernel()->light(&pass->lighting, side, &points->batch.light, points->count);
	for (int i = 0; i < points->count; i++)
		for (int j = 0; j < CHANNELS; j++)
			points->colour[i][j] = light->colour[j][i];
	points->count = 0;
}

static void few_put_corner(struct accel_pixel_batch *batch, int i, int corner,
			   const struct accel_vertex *vertex)
{
	batch->x[corner][i] = vertex->x;
	batch->y[corner][i] = vertex->y;
	batch->w[corner][i] = vertex->w;
	batch->length[corner][i] = vertex->length;
	for (int j = 0; j < 3; j++) {
		batch->eye[corner][j][i] = vertex->eye[j];
		batch->normal[corner][j][i] = vertex->normal[j];
	}
	for (int j = 0; j < 4; j++)
		batch->paint[corner][j][i] = vertex->paint[j];
}

static void few_put(struct points *points, const struct accel_patch *patch,
		    const struct accel_pixel *pixel, float *colour)
{
	const int i = points->count++;

	points->batch.pixel[0][i] = pixel->x;
	points->batch.pixel[1][i] = pixel->y;
	for (int j = 0; j < 3; j++)
		few_put_corner(&points->batch, i, j, patch->vertex[j]);
	points->colour[i] = colour;
}

static void few_light_side(const struct accel_pass *pass, const struct accel_patch *patch,
			   struct accel_few *const *few, int count, int side)
{
	struct points points;

	points.count = 0;
	for (int i = 0; i < count; i++) {
		for (int j = 0; j < few[i]->count && patch[i].side == side; j++) {
			few_put(&points, &patch[i], &few[i]->pixel[j], few[i]->colour[j]);
			if (points.count == ACCEL_BATCH)
				few_flush(pass, &points, side);
		}
	}
	few_flush(pass, &points, side);
}

void accel_few_light(const struct accel_pass *pass, const struct accel_patch *patch,
		     struct accel_few *const *few, int count)
{
	for (int side = 0; side <= accel_pass_sides(pass); side++)
		few_light_side(pass, patch, few, count, side);
}

/* s10.22 of a difference of steps; to be taken as the integers of a record are. */
static uint32_t few_fixed(float steps)
{
	float scaled = steps * (1 << GLOSS_COLOUR_FRACTION);

	return (uint32_t)(int32_t)(scaled < 0 ? scaled - 0.5f : scaled + 0.5f);
}

/* Of 0 to 255, as a pixel has it. */
static int few_level(float colour)
{
	return (int)((colour < 1 ? colour : 1) * 255 + 0.5f);
}

static bool few_same(const struct accel_few *few, int channel)
{
	return few_level(few->colour[0][channel]) ==
	       few_level(few->colour[few->count - 1][channel]);
}

/* From the first pixel's colour to the last's. */
static void few_linear(struct accel_triangle *triangle, const struct accel_few *few, int channel)
{
	const struct accel_pixel *a = &few->pixel[0], *b = &few->pixel[few->count - 1];
	const float *from = few->colour[0], *to = few->colour[few->count - 1];
	int x = b->x - a->x, y = b->y - a->y;
	float begin = from[channel] < 1 ? from[channel] : 1;
	float end = to[channel] < 1 ? to[channel] : 1;
	float step = 255 * (end - begin) / (float)(x * x + y * y);

	triangle->channel[channel] = (struct accel_surface){
		.i = few_fixed(255 * begin + 0.5f),
		.dx = few_fixed(step * (float)x),
		.dy = few_fixed(step * (float)y),
	};
}

void accel_few_surface(struct accel_triangle *triangle, const struct accel_few *few)
{
	triangle->x = few->pixel[0].x;
	triangle->y = few->pixel[0].y;
	accel_surface_flat(triangle, few->colour[0]);
	if (few_same(few, 0) && few_same(few, 1) && few_same(few, 2) && few_same(few, 3))
		return;
	triangle->shading = GLOSS_SHADING_LINEAR;
	triangle->alpha_linear = !few_same(few, 3);
	for (int i = 0; i < CHANNELS; i++)
		few_linear(triangle, few, i);
}
