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

void accel_few_put(const struct accel_few *few, int i, struct accel_few_batch *batch,
		   struct accel_fit_batch *fit)
{
	const struct accel_pixel *first = &few->pixel[0], *last = &few->pixel[few->count - 1];

	fit->at_x[i] = first->x;
	fit->at_y[i] = first->y;
	batch->x[i] = last->x - first->x;
	batch->y[i] = last->y - first->y;
	for (int j = 0; j < CHANNELS; j++) {
		batch->colour[0][j][i] = few->colour[0][j];
		batch->colour[1][j][i] = few->colour[few->count - 1][j];
	}
}
