// SPDX-License-Identifier: MIT
/* Points as squares of whole pixels (OpenGL 1.5, section 3.3). */
#include <math.h>

#include "draw/group.h"

/* As wide as its distance from the eye makes it, in whole pixels. */
static int points_width(const struct accel_pass *pass, const struct accel_vertex *vertex)
{
	const struct accel_point_style *style = &pass->state->point;
	const float distance = sqrtf(number_dot(vertex->eye, vertex->eye));
	const float *factor = style->attenuation;
	float by = factor[0] + distance * (factor[1] + distance * factor[2]), width = style->width;

	if (factor[1] != 0 || factor[2] != 0 || factor[0] != 1)
		width = by > 0 ? width / sqrtf(by) : style->most;
	width = width > style->least ? width : style->least;
	width = width < style->most ? width : style->most;
	return number_max(1, (int)(width + 0.5f));
}

/* The first of @width pixels around a coordinate; between two pixels it is in the one that is greater. */
static int32_t points_first(int32_t at, int width)
{
	const int32_t low = width % 2 ? at : at + ACCEL_WINDOW_HALF;

	return (low >> ACCEL_WINDOW_BITS) - width / 2;
}

int accel_points_put(struct accel_pass *pass, struct accel_strokes *strokes,
		     const struct accel_vertex *vertex)
{
	const int width = points_width(pass, vertex), size = width * ACCEL_WINDOW_ONE;
	const int32_t x = points_first(vertex->x, width) * ACCEL_WINDOW_ONE;
	/* To the greater y as it is in NDC, which goes up unless the target's is turned. */
	const int32_t up = pass->state->bottom ? 0 : 1;
	const int32_t y = points_first(vertex->y - up, width) * ACCEL_WINDOW_ONE;
	struct accel_vertex corner[4] = { *vertex, *vertex, *vertex, *vertex };

	for (int i = 0; i < 4; i++) {
		corner[i].x = x + (i == 1 || i == 2 ? size : 0);
		corner[i].y = y + (i >= 2 ? size : 0);
	}
	if (width > 1)
		return accel_strokes_fill(pass, strokes, corner, 4, vertex);
	/* Of a triangle around the one centre there is one record. */
	corner[2].x = x + ACCEL_WINDOW_HALF;
	return accel_strokes_fill(pass, strokes, corner, 3, vertex);
}

static void points_capture(const struct accel_pass *pass, uint32_t index,
			   const struct accel_vertex *vertex)
{
	struct accel_captured_vertex captured;
	struct accel_corner corner;

	accel_mesh_corner(pass, index, &corner);
	corner.vertex = *vertex;
	accel_capture(pass, ACCEL_CAPTURED_POINT, &corner, 1, vertex, &captured);
}

static int points_flush(struct accel_pass *pass, struct accel_strokes *strokes)
{
	int err = 0;

	accel_strokes_light(pass, strokes);
	for (int i = 0; i < strokes->count && !err; i++)
		if (pass->capture.call)
			points_capture(pass, strokes->index[i], &strokes->vertex[i]);
		else
			err = accel_points_put(pass, strokes, &strokes->vertex[i]);
	strokes->count = 0;
	return err;
}

int accel_points_draw(struct accel_pass *pass)
{
	struct accel_walk walk = { .pass = pass, .primitive = pass->elements->primitive };
	struct accel_strokes strokes;
	int err = 0;

	strokes.count = strokes.seen.count = 0;
	for (uint32_t n = 0; n < pass->elements->primitives && !err; n++, walk.primitive++) {
		const uint32_t count = accel_primitives_elements(pass, walk.primitive);

		for (uint32_t i = 0; i < count && !err; i++) {
			uint32_t *vertex = &strokes.index[strokes.count];

			/* A point is there with all of its pixels if its middle is in view. */
			if (!accel_primitives_vertex(&walk, i, vertex) ||
			    pass->screen[*vertex].outside)
				continue;
			if (++strokes.count == ACCEL_BATCH)
				err = points_flush(pass, &strokes);
		}
		walk.before += count;
	}
	if (!err)
		err = points_flush(pass, &strokes);
	if (!err)
		err = accel_strokes_flush(pass, &strokes);
	return err ? err : accel_face_draw_all(pass);
}
