// SPDX-License-Identifier: MIT
/*
 * Polygons one by one: those whose side is drawn as lines or points, and all that are captured. Each
 * is lit and clipped as a whole. Its outlines are the edges that have an edge flag, and those that
 * clipping made. What is filled goes the way of all triangles, in turn with these.
 */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "draw/geometry_window.h"
#include "draw/group.h"

struct polygons {
	struct accel_pass *pass;
	struct accel_walk walk;
	struct accel_lines lines;
	/* Triangles of the pass: up to this polygon; and those before it that are to be filled. */
	uint64_t triangle, fill_first, fill_end;
	/* This polygon. */
	int corners;
	uint32_t planes; /* that cut it */
	bool located;    /* corners have their place in clip space */
	bool flagged;    /* its edges have flags */
	uint32_t *index; /* of the pass */
	struct accel_corner *corner, *spare;
	struct accel_captured_vertex *captured;
	int room; /* of each of the four */
	struct accel_vertex provoking;
};

/* -ENOMEM. */
static int polygons_reserve(struct polygons *polygons, uint32_t corners)
{
	const size_t room = (size_t)corners + ACCEL_CLIP_CORNERS;

	if (room <= (size_t)polygons->room)
		return 0;
	if (room > INT_MAX / sizeof(*polygons->corner))
		return -ENOMEM;
	free(polygons->index);
	free(polygons->corner);
	free(polygons->spare);
	free(polygons->captured);
	polygons->index = malloc(room * sizeof(*polygons->index));
	polygons->corner = malloc(room * sizeof(*polygons->corner));
	polygons->spare = malloc(room * sizeof(*polygons->spare));
	polygons->captured = malloc(room * sizeof(*polygons->captured));
	polygons->room = (int)room;
	return polygons->index && polygons->corner && polygons->spare && polygons->captured ?
		       0 :
		       -ENOMEM;
}

/* The vertices of polygon @number; false: it can not be drawn, or is out of view. */
static bool polygons_take(struct polygons *polygons, uint32_t number)
{
	const enum accel_topology topology = polygons->walk.primitive->topology;
	uint32_t any = 0, all = UINT32_MAX;

	for (int i = 0; i < polygons->corners; i++) {
		const uint32_t element = accel_primitives_corner(topology, number, (uint32_t)i);
		uint32_t *vertex = &polygons->index[i];

		if (!accel_primitives_vertex(&polygons->walk, element, vertex))
			return false;
		any |= polygons->pass->screen[*vertex].outside;
		all &= polygons->pass->screen[*vertex].outside;
	}
	polygons->planes = any & ACCEL_OUTSIDE_CLIP;
	polygons->flagged = accel_primitives_has_edges(topology);
	polygons->located = false;
	return !all;
}

static void polygons_locate(struct polygons *polygons)
{
	for (int i = 0; i < polygons->corners; i++)
		accel_mesh_corner(polygons->pass, polygons->index[i], &polygons->corner[i]);
	polygons->located = true;
}

/* ---- sides ---- */

/* Twice the area in the window, and something of its sign for what reaches behind the eye; NDC. */
static double polygons_area(const struct polygons *polygons)
{
	const struct accel_screen *screen = polygons->pass->screen;
	const bool up = !polygons->pass->state->bottom;
	double area = 0;

	for (int i = 1; i + 1 < polygons->corners; i++) {
		const struct accel_corner *a = &polygons->corner[0], *b = &polygons->corner[i];
		const double *p = a->clip, *q = b->clip, *r = (b + 1)->clip;
		const uint32_t *index = &polygons->index[i];

		if (polygons->planes)
			area += p[3] * (q[0] * r[1] - q[1] * r[0]) +
				q[3] * (r[0] * p[1] - r[1] * p[0]) +
				r[3] * (p[0] * q[1] - p[1] * q[0]);
		else
			area += (up ? -1.0 : 1.0) *
				(double)accel_setup_area(&screen[polygons->index[0]].at,
							 &screen[index[0]].at,
							 &screen[index[1]].at);
	}
	return area;
}

/* Without an area it is no front. */
static bool polygons_is_back(const struct polygons *polygons)
{
	const double area = polygons_area(polygons);

	return !(polygons->pass->state->clockwise ? area < 0 : area > 0);
}

/* ---- light and clipping ---- */

static void polygons_flatten(const struct polygons *polygons)
{
	struct accel_corner *corner = polygons->corner;
	struct accel_vertex *const first[3] = { &corner[0].vertex, &corner[1].vertex,
						&corner[2].vertex };

	accel_face_flatten(first, polygons->pass->state->clockwise);
	for (int i = 3; i < polygons->corners; i++)
		memcpy(corner[i].vertex.normal, corner[0].vertex.normal,
		       sizeof(corner[0].vertex.normal));
}

static void polygons_light(struct polygons *polygons, bool back)
{
	const struct accel_pass *pass = polygons->pass;
	const int side = back && accel_pass_sides(pass);
	struct accel_vertex *vertex[ACCEL_BATCH];
	struct accel_vertex_batch batch;

	for (int i = 0; i < polygons->corners; i += ACCEL_BATCH) {
		const int count = number_min(polygons->corners - i, ACCEL_BATCH);

		accel_mesh_fetch(pass, &polygons->index[i], count, &batch);
		for (int j = 0; j < count; j++)
			accel_geometry_vertex_of(&batch, j, &polygons->corner[i + j].vertex);
	}
	if (!accel_pass_shares(pass))
		polygons_flatten(polygons);
	for (int i = 0; i < polygons->corners; i += ACCEL_BATCH) {
		const int count = number_min(polygons->corners - i, ACCEL_BATCH);

		for (int j = 0; j < count; j++)
			vertex[j] = &polygons->corner[i + j].vertex;
		accel_shading_vertices(pass, vertex, count, side);
	}
}

static void polygons_clip(struct polygons *polygons)
{
	const struct accel_clipped clipped = { polygons->corner, polygons->spare, polygons->room };
	const enum accel_topology topology = polygons->walk.primitive->topology;

	polygons->provoking = polygons->corner[accel_primitives_provoking(topology)].vertex;
	for (int i = 0; i < polygons->corners && !polygons->flagged; i++)
		polygons->corner[i].boundary = true;
	if (polygons->planes)
		polygons->corners = accel_clip_polygon(&polygons->pass->transform.window,
						       polygons->planes, &clipped,
						       polygons->corners);
}

/* Of its triangles, which are of one plane, the largest says most exactly how steep that is. */
static void polygons_offset(struct polygons *polygons, enum accel_polygon_mode mode)
{
	const struct accel_state *state = polygons->pass->state;
	struct accel_corner *corner = polygons->corner;
	double offset;
	int largest = 1;
	int64_t most = -1;

	if (!(state->offset_modes >> mode & 1))
		return;
	for (int i = 1; i + 1 < polygons->corners; i++) {
		const int64_t area = accel_surface_area(&corner[0].vertex, &corner[i].vertex,
							&corner[i + 1].vertex);

		if (llabs(area) <= most)
			continue;
		most = llabs(area);
		largest = i;
	}
	offset = accel_offset(state, (const struct accel_vertex *[3]){
					     &corner[0].vertex, &corner[largest].vertex,
					     &corner[largest + 1].vertex });
	for (int i = 0; i < polygons->corners; i++)
		corner[i].vertex.z += offset;
}

/* ---- what is drawn ---- */

static int polygons_line(struct polygons *polygons, const struct accel_corner *a,
			 const struct accel_corner *b)
{
	const struct accel_corner ends[2] = { *a, *b };

	if (!polygons->pass->capture.call)
		return accel_lines_put(&polygons->lines, &a->vertex, &b->vertex,
				       &polygons->provoking);
	accel_lines_capture(&polygons->lines, ends, &polygons->provoking);
	return 0;
}

static int polygons_point(struct polygons *polygons, const struct accel_corner *corner)
{
	const uint32_t beside = ACCEL_OUTSIDE_LEFT | ACCEL_OUTSIDE_RIGHT | ACCEL_OUTSIDE_TOP |
				ACCEL_OUTSIDE_BOTTOM;
	struct accel_pass *pass = polygons->pass;
	struct accel_vertex vertex = corner->vertex;

	if (geometry_outside(&pass->transform.window, corner->clip) & beside)
		return 0;
	if (pass->capture.call) {
		accel_capture(pass, ACCEL_CAPTURED_POINT, corner, 1, &polygons->provoking,
			      polygons->captured);
		return 0;
	}
	if (pass->state->shading == ACCEL_SHADING_FLAT)
		memcpy(vertex.sample.colour, polygons->provoking.sample.colour,
		       sizeof(vertex.sample.colour));
	return accel_points_put(pass, &polygons->lines.strokes, &vertex);
}

static int polygons_draw_outlines(struct polygons *polygons, enum accel_polygon_mode mode)
{
	int err = 0;

	polygons->lines.distance = 0;
	for (int i = 0; i < polygons->corners && !err; i++) {
		const struct accel_corner *corner = &polygons->corner[i];
		const struct accel_corner *next = &polygons->corner[(i + 1) % polygons->corners];

		if (!corner->boundary)
			continue;
		if (mode == ACCEL_POLYGON_LINES)
			err = polygons_line(polygons, corner, next);
		else
			err = polygons_point(polygons, corner);
	}
	return err;
}

/* Draws what is left of outlines, so that something else can follow. */
static int polygons_flush(struct polygons *polygons)
{
	int err = accel_strokes_flush(polygons->pass, &polygons->lines.strokes);

	return err ? err : accel_face_draw_all(polygons->pass);
}

/* Fills those polygons that are to be, before others are drawn. */
static int polygons_fill(struct polygons *polygons)
{
	const uint64_t first = polygons->fill_first, end = polygons->fill_end;
	struct accel_pass pass = *polygons->pass;
	int err;

	if (first == end)
		return 0;
	polygons->fill_first = polygons->fill_end;
	err = polygons_flush(polygons);
	accel_pass_shade(&pass, pass.filled);
	return err ? err : accel_mesh_draw(&pass, first, end);
}

/* The triangles of this polygon join those that are filled. */
static int polygons_join(struct polygons *polygons)
{
	const uint64_t end = polygons->triangle + (uint64_t)polygons->corners - 2;
	int err = 0;

	if (polygons->fill_end != polygons->triangle)
		err = polygons_fill(polygons);
	if (polygons->fill_first == polygons->fill_end)
		polygons->fill_first = polygons->triangle;
	polygons->fill_end = end;
	return err;
}

static int polygons_draw_side(struct polygons *polygons, bool back)
{
	const struct accel_pass *pass = polygons->pass;
	const enum accel_polygon_mode mode = pass->state->polygon_mode[back];
	int err;

	if (mode == ACCEL_POLYGON_FILL && !pass->capture.call)
		return polygons_join(polygons);
	err = polygons_fill(polygons);
	if (err)
		return err;
	if (!polygons->located)
		polygons_locate(polygons);
	polygons_light(polygons, back);
	polygons_clip(polygons);
	if (!polygons->corners)
		return 0;
	if (mode != ACCEL_POLYGON_FILL) {
		polygons_offset(polygons, mode);
		return polygons_draw_outlines(polygons, mode);
	}
	accel_capture(pass, ACCEL_CAPTURED_POLYGON, polygons->corner, (uint32_t)polygons->corners,
		      &polygons->provoking, polygons->captured);
	return 0;
}

static int polygons_draw_one(struct polygons *polygons, uint32_t number)
{
	bool back;

	if (!polygons_take(polygons, number))
		return 0;
	if (polygons->planes)
		polygons_locate(polygons);
	back = polygons_is_back(polygons);
	if (accel_pass_culls(polygons->pass, back))
		return 0;
	return polygons_draw_side(polygons, back);
}

static int polygons_primitive(struct polygons *polygons)
{
	const struct accel_pass *pass = polygons->pass;
	uint32_t corners, count;
	int err;

	count = accel_primitives_polygons(pass, polygons->walk.primitive, &corners);
	err = count ? polygons_reserve(polygons, corners) : 0;
	for (uint32_t i = 0; i < count && !err; i++) {
		polygons->corners = (int)corners;
		err = polygons_draw_one(polygons, i);
		polygons->triangle += corners - 2;
	}
	return err;
}

/* All but the strokes, of which there are none yet, and the polygon. */
static void polygons_begin(struct polygons *polygons, struct accel_pass *pass)
{
	polygons->pass = pass;
	polygons->walk = (struct accel_walk){ .pass = pass,
					      .primitive = pass->elements->primitive };
	accel_lines_begin(&polygons->lines, pass);
	polygons->triangle = polygons->fill_first = polygons->fill_end = 0;
	polygons->index = NULL;
	polygons->corner = polygons->spare = NULL;
	polygons->captured = NULL;
	polygons->room = 0;
}

int accel_polygons_draw(struct accel_pass *pass)
{
	struct polygons polygons;
	struct accel_walk *walk = &polygons.walk;
	int err = 0;

	polygons_begin(&polygons, pass);
	for (uint32_t n = 0; n < pass->elements->primitives && !err; n++, walk->primitive++) {
		err = polygons_primitive(&polygons);
		walk->before += accel_primitives_elements(pass, walk->primitive);
	}
	if (!err)
		err = polygons_fill(&polygons);
	if (!err)
		err = polygons_flush(&polygons);
	free(polygons.index);
	free(polygons.corner);
	free(polygons.spare);
	free(polygons.captured);
	return err;
}
