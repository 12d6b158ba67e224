// SPDX-License-Identifier: MIT
/*
 * Lines as parallelograms, as wide as they are along the axis that they are less along (OpenGL 1.5,
 * section 3.4). So a line is on as many pixels of each column, or row. Of its ends the first is its
 * own and the last is not, so that where segments meet no pixel is missing or drawn twice.
 */
#include <math.h>
#include <stdlib.h>

#include "draw/group.h"

/* Pixels of a longer part of a line would not fit a record's edges, with the width beside it. */
#define PART_HEIGHT (ACCEL_EDGE_HEIGHT_MAX >> ACCEL_SNAP_BITS >> 1)

/* The least that vertices are apart. */
#define SNAP (1 << (ACCEL_WINDOW_BITS - ACCEL_SNAP_BITS))

/* Rounded, so that of a stipple's bits, which begin whole pixels from a vertex, each begins there. */
static int32_t lines_between(int32_t a, int32_t b, double t)
{
	return a + (int32_t)floor((b - a) * t + 0.5);
}

/* The place that is @t of the way on the screen, which in space is another part of it. */
static void lines_cut(const struct accel_vertex *a, const struct accel_vertex *b, double t,
		      struct accel_vertex *vertex)
{
	const double of_a = (1 - t) / (double)a->w, of_b = t / (double)b->w;
	const float part = (float)(of_b / (of_a + of_b));

	*vertex = *a;
	vertex->x = lines_between(a->x, b->x, t);
	vertex->y = lines_between(a->y, b->y, t);
	vertex->w = (float)(1 / (of_a + of_b));
	vertex->z = a->z + t * (b->z - a->z);
	for (int i = 0; i < 4; i++)
		vertex->sample.colour[i] = a->sample.colour[i] +
					   part * (b->sample.colour[i] - a->sample.colour[i]);
}

static int lines_fill(struct accel_lines *lines, const struct accel_vertex *a,
		      const struct accel_vertex *b, const struct accel_vertex *flat)
{
	const bool steep = abs(b->y - a->y) > abs(b->x - a->x);
	const int32_t x = steep ? lines->half : 0, y = steep ? 0 : lines->half;
	/* The first end is the line's and the last is not, whichever way it goes. */
	const int32_t shift = (steep ? b->y < a->y : b->x < a->x) ? SNAP : 0;
	struct accel_vertex corner[4] = { *a, *b, *b, *a }, middle;
	int err;

	if (abs(b->y - a->y) > PART_HEIGHT * ACCEL_WINDOW_ONE) {
		lines_cut(a, b, 0.5, &middle);
		err = lines_fill(lines, a, &middle, flat);
		return err ? err : lines_fill(lines, &middle, b, flat);
	}
	for (int i = 0; i < 4; i++) {
		corner[i].x += (i < 2 ? -x : x) + (steep ? 0 : shift);
		corner[i].y += (i < 2 ? -y : y) + (steep ? shift : 0);
	}
	return accel_strokes_fill(lines->pass, &lines->strokes, corner, 4, flat);
}

/* Pixels along the axis that it is more along. */
static double lines_length(const struct accel_vertex *a, const struct accel_vertex *b)
{
	return (double)number_max(abs(b->x - a->x), abs(b->y - a->y)) / ACCEL_WINDOW_ONE;
}

/* The bit of the stipple that is at a distance, and where the next begins. */
static bool lines_stippled(const struct accel_line_style *style, double distance, double *next)
{
	const int repeat = style->repeat;
	const double bit = (double)(int64_t)(distance / repeat);

	*next = (bit + 1) * repeat;
	return style->stipple >> (int64_t)bit % 16 & 1;
}

static int lines_stipple(struct accel_lines *lines, const struct accel_vertex *a,
			 const struct accel_vertex *b, const struct accel_vertex *flat)
{
	const struct accel_line_style *style = &lines->pass->state->line;
	const double length = lines_length(a, b), begin = lines->distance, end = begin + length;
	struct accel_vertex from, to;
	int err = 0;

	while (lines->distance < end && !err) {
		double at = lines->distance, next;
		bool drawn = lines_stippled(style, at, &next);

		next = next < end ? next : end;
		if (drawn) {
			lines_cut(a, b, (at - begin) / length, &from);
			lines_cut(a, b, (next - begin) / length, &to);
			err = lines_fill(lines, &from, &to, flat);
		}
		lines->distance = next;
	}
	return err;
}

void accel_lines_begin(struct accel_lines *lines, struct accel_pass *pass)
{
	lines->pass = pass;
	lines->half = number_max(1, (int)(pass->state->line.width + 0.5f)) * ACCEL_WINDOW_HALF;
	lines->distance = 0;
	lines->strokes.seen.count = 0;
}

int accel_lines_put(struct accel_lines *lines, const struct accel_vertex *a,
		    const struct accel_vertex *b, const struct accel_vertex *flat)
{
	if (lines->pass->state->line.repeat)
		return lines_stipple(lines, a, b, flat);
	return lines_fill(lines, a, b, flat);
}

void accel_lines_capture(struct accel_lines *lines, const struct accel_corner corner[2],
			 const struct accel_vertex *flat)
{
	struct accel_captured_vertex captured[2];

	accel_capture(lines->pass,
		      lines->distance > 0 ? ACCEL_CAPTURED_LINE : ACCEL_CAPTURED_LINE_FIRST, corner,
		      2, flat, captured);
	lines->distance = 1;
}

static int lines_draw_one(struct accel_lines *lines, const uint32_t index[2],
			  const struct accel_vertex vertex[2])
{
	const struct accel_pass *pass = lines->pass;
	const uint32_t outside[2] = { vertex[0].outside, vertex[1].outside };
	const uint32_t planes = (outside[0] | outside[1]) & ACCEL_OUTSIDE_CLIP;
	const struct accel_vertex *a = &vertex[0], *b = &vertex[1];
	struct accel_corner polygon[ACCEL_POLYGON_MAX];

	if (outside[0] & outside[1])
		return 0;
	if (planes || pass->capture.call) {
		/* As a triangle of no width, whose first edge it is. */
		const struct accel_vertex three[3] = { *a, *b, *b };
		const uint32_t of[3] = { index[0], index[1], index[1] };

		if (!accel_mesh_clip(pass, three, of, planes, polygon))
			return 0;
		a = &polygon[0].vertex;
		b = &polygon[1].vertex;
	}
	if (pass->capture.call) {
		accel_lines_capture(lines, polygon, &vertex[1]);
		return 0;
	}
	return accel_lines_put(lines, a, b, &vertex[1]);
}

/* Segments from one element to the next, or of pairs; those that can be drawn. */
static int lines_run(struct accel_lines *lines, const struct accel_walk *walk,
		     const uint32_t *element, int elements, bool pairs)
{
	struct accel_strokes *strokes = &lines->strokes;
	bool good[ACCEL_BATCH] = { false };
	int err = 0;

	for (int i = 0; i < elements; i++) {
		good[i] = accel_primitives_vertex(walk, element[i], &strokes->index[i]);
		/* There is a vertex 0, which is fetched in its place. */
		if (!good[i])
			strokes->index[i] = 0;
	}
	strokes->count = elements;
	accel_strokes_light(lines->pass, strokes);
	for (int i = 0; i + 1 < elements && !err; i += pairs ? 2 : 1) {
		if (pairs)
			lines->distance = 0;
		if (good[i] && good[i + 1])
			err = lines_draw_one(lines, &strokes->index[i], &strokes->vertex[i]);
	}
	return err;
}

static int lines_primitive(struct accel_lines *lines, const struct accel_walk *walk, uint32_t count)
{
	const enum accel_topology topology = walk->primitive->topology;
	const bool pairs = topology == ACCEL_TOPOLOGY_LINES;
	uint32_t element[ACCEL_BATCH], first = 0;
	int err = 0;

	lines->distance = 0;
	while (first + 1 < count && !err) {
		const uint32_t some = count - first < ACCEL_BATCH ? count - first : ACCEL_BATCH;

		for (uint32_t i = 0; i < some; i++)
			element[i] = first + i;
		err = lines_run(lines, walk, element, (int)some, pairs);
		/* The last of a strip is the first of what follows. */
		first += pairs || some < ACCEL_BATCH ? some : some - 1;
	}
	element[0] = count - 1;
	element[1] = 0;
	if (topology == ACCEL_TOPOLOGY_LINE_LOOP && count > 1 && !err)
		err = lines_run(lines, walk, element, 2, false);
	return err;
}

int accel_lines_draw(struct accel_pass *pass)
{
	struct accel_walk walk = { .pass = pass, .primitive = pass->elements->primitive };
	struct accel_lines lines;
	int err = 0;

	accel_lines_begin(&lines, pass);
	for (uint32_t n = 0; n < pass->elements->primitives && !err; n++, walk.primitive++) {
		const uint32_t count = accel_primitives_elements(pass, walk.primitive);

		err = lines_primitive(&lines, &walk, count);
		walk.before += count;
	}
	if (!err)
		err = accel_strokes_flush(pass, &lines.strokes);
	return err ? err : accel_face_draw_all(pass);
}
