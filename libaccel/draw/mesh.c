// SPDX-License-Identifier: MIT
/* A mesh's triangles, one after the other: their vertices, whether they are seen, which side. */
#include <string.h>

#include "draw/group.h"
#include "draw/kernel.h"

/* Vertices of the arrays, where they are not those of the pass; what is none has any number. */
static const uint32_t *mesh_gather(const struct accel_pass *pass, const uint32_t *index, int count,
				   uint32_t gathered[ACCEL_BATCH])
{
	if (!pass->gather && !pass->base)
		return index;
	for (int i = 0; i < count; i++) {
		gathered[i] = pass->gather ? pass->gather[index[i]] : pass->base + index[i];
		gathered[i] = gathered[i] < pass->arrays->vertices ? gathered[i] : pass->base;
	}
	return gathered;
}

void accel_mesh_fetch(const struct accel_pass *pass, const uint32_t *index, int count,
		      struct accel_vertex_batch *batch)
{
	bool normal = pass->lit && pass->normal.data;
	bool colour = (!pass->lit || pass->painted) && pass->colour.data;
	uint32_t gathered[ACCEL_BATCH];

	index = mesh_gather(pass, index, count, gathered);
	accel_fetch_batch(&pass->position, index, count, 4, batch->position);
	if (normal)
		accel_fetch_batch(&pass->normal, index, count, 3, batch->across);
	if (colour)
		accel_fetch_batch(&pass->colour, index, count, 4, batch->paint);
	for (int i = 0; i < 4 && !colour; i++)
		for (int j = 0; j < count; j++)
			batch->paint[i][j] = 1;
	accel_kernel()->transform(&pass->transform, batch, count, normal);
}

/*
 * Keeps what culling needs of vertices from @first on; returns how many there are up to one that is
 * an error.
 */
static int mesh_keep(const struct accel_pass *pass, uint32_t first, int count,
		     const struct accel_vertex_batch *batch)
{
	const uint32_t vertices = pass->arrays->vertices;

	for (int i = 0; i < count; i++) {
		const uint32_t number = first + (uint32_t)i;
		bool good = batch->finite[i] && (!pass->gather || pass->gather[number] < vertices);

		if (!good && pass->strict)
			return i;
		pass->screen[number] = (struct accel_screen){ { batch->x[i], batch->y[i] },
							      good ? batch->outside[i] :
								     ACCEL_OUTSIDE_INFINITE };
	}
	return count;
}

uint32_t accel_mesh_transform(const struct accel_pass *pass, uint32_t first, uint32_t end)
{
	struct accel_vertex_batch batch;
	uint32_t index[ACCEL_BATCH];

	while (first < end) {
		int count = end - first < ACCEL_BATCH ? (int)(end - first) : ACCEL_BATCH, good;

		for (int i = 0; i < count; i++)
			index[i] = first + (uint32_t)i;
		accel_mesh_fetch(pass, index, count, &batch);
		good = mesh_keep(pass, first, count, &batch);
		first += (uint32_t)good;
		if (good < count)
			break;
	}
	return first;
}

/* The side that is seen; -1: neither, or it is culled. */
static int mesh_visible_side(const struct accel_pass *pass, int64_t area)
{
	const struct accel_state *state = pass->state;
	/* Counter-clockwise in NDC is front, and on the screen y points down. */
	bool back = (area > 0) != (state->clockwise != state->bottom);

	if (area == 0 || accel_pass_culls(pass, back))
		return -1;
	return back && accel_pass_sides(pass);
}

/* Nothing else of it is looked at then. */
static void mesh_see_none(struct accel_seen *seen)
{
	seen->count = 0;
}

void accel_mesh_see(struct accel_seen *seen, const struct accel_point *const point[3],
		    const uint32_t vertex[3], uint32_t flat, int side)
{
	const int i = seen->count++;

	for (int j = 0; j < 3; j++) {
		seen->batch.x[j][i] = point[j]->x;
		seen->batch.y[j][i] = point[j]->y;
		seen->vertex[i][j] = vertex[j];
	}
	seen->flat[i] = flat;
	seen->side[i] = side;
}

int accel_mesh_put(struct accel_pass *pass, struct accel_seen *seen, bool of_group)
{
	const struct accel_bounds *visible = &pass->transform.window.visible;
	const int count = seen->count;
	int put = 0;

	accel_kernel()->setup(&seen->batch, count, visible);
	for (int i = 0; i < count; i++) {
		struct accel_face *face = accel_group_face(pass->group);

		if (!accel_setup_draws(&seen->batch, i, visible, &face->setup)) {
			pass->group->faces--;
			continue;
		}
		memcpy(face->vertex, seen->vertex[i], sizeof(face->vertex));
		face->flat = seen->flat[i];
		face->side = seen->side[i];
		face->clipped = of_group;
		put++;
	}
	seen->count = 0;
	return put;
}

/* The signed area of a polygon on screen. */
static int64_t mesh_polygon_area(const struct accel_corner *polygon, int corners)
{
	int64_t area = 0;

	for (int i = 1; i + 1 < corners; i++)
		area += accel_surface_area(&polygon[0].vertex, &polygon[i].vertex,
					   &polygon[i + 1].vertex);
	return area;
}

/* Its parts count as the one triangle that they are. */
static void mesh_put_fan(struct accel_pass *pass, struct accel_corner *polygon, int corners,
			 struct accel_vertex *flat, int64_t area, int side)
{
	int apex = accel_clip_apex(polygon, corners);
	uint32_t number[ACCEL_POLYGON_MAX], of_flat;
	struct accel_seen fan;

	mesh_see_none(&fan);
	for (int i = 0; i < corners; i++) {
		accel_shading_vertex(pass, &polygon[i].vertex, side);
		number[i] = accel_group_vertex(pass->group, side);
		pass->group->vertex[number[i]] = polygon[i].vertex;
	}
	accel_shading_vertex(pass, flat, side);
	of_flat = accel_group_vertex(pass->group, side);
	pass->group->vertex[of_flat] = *flat;
	for (int i = 1; i + 1 < corners; i++) {
		const int at[3] = { apex, (apex + i) % corners, (apex + i + 1) % corners };
		const uint32_t vertex[3] = { number[at[0]], number[at[1]], number[at[2]] };
		struct accel_point point[3];
		int64_t part;

		for (int j = 0; j < 3; j++)
			point[j] = (struct accel_point){ polygon[at[j]].vertex.x,
							 polygon[at[j]].vertex.y };
		part = accel_setup_area(&point[0], &point[1], &point[2]);
		if (part && (part > 0) == (area > 0))
			accel_mesh_see(&fan,
				       (const struct accel_point *[3]){ &point[0], &point[1],
									&point[2] },
				       vertex, of_flat, side);
	}
	if (accel_mesh_put(pass, &fan, true))
		pass->stats->clipped++;
	else
		pass->stats->culled++;
}

void accel_mesh_corner(const struct accel_pass *pass, uint32_t index, struct accel_corner *corner)
{
	uint32_t gathered[ACCEL_BATCH];
	float position[4], edge[4];

	index = *mesh_gather(pass, &index, 1, gathered);
	accel_fetch_element(&pass->position, index, position);
	accel_clip_corner(&pass->transform, position, corner);
	corner->boundary = true;
	if (!pass->edge.data)
		return;
	accel_fetch_element(&pass->edge, index, edge);
	corner->boundary = edge[0] != 0;
}

int accel_mesh_clip(const struct accel_pass *pass, const struct accel_vertex vertex[3],
		    const uint32_t index[3], uint32_t planes,
		    struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	struct accel_corner spare[ACCEL_POLYGON_MAX];
	const struct accel_clipped clipped = { polygon, spare, ACCEL_POLYGON_MAX };

	for (int i = 0; i < 3; i++) {
		accel_mesh_corner(pass, index[i], &polygon[i]);
		polygon[i].vertex = vertex[i];
		polygon[i].vertex.sampled = 0;
	}
	return accel_clip_polygon(&pass->transform.window, planes, &clipped, 3);
}

/* The same, with the light at the triangle's own vertices to interpolate between. */
static void mesh_clip_lit(const struct accel_pass *pass, struct accel_vertex vertex[3],
			  const uint32_t index[3], uint32_t planes, int side,
			  struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	int corners;

	for (int i = 0; i < 3; i++)
		accel_shading_vertex(pass, &vertex[i], side);
	corners = accel_mesh_clip(pass, vertex, index, planes, polygon);
	for (int i = 0; i < corners; i++)
		polygon[i].vertex.sampled = 1u + (unsigned int)side;
}

/* The vertices of a triangle, complete but for their light. */
static void mesh_vertices(const struct accel_pass *pass, const uint32_t index[3],
			  struct accel_vertex vertex[3])
{
	struct accel_vertex *const corner[3] = { &vertex[0], &vertex[1], &vertex[2] };
	struct accel_vertex_batch batch;

	accel_mesh_fetch(pass, index, 3, &batch);
	for (int i = 0; i < 3; i++)
		accel_geometry_vertex_of(&batch, i, &vertex[i]);
	if (!accel_pass_shares(pass))
		accel_face_flatten(corner, pass->state->clockwise);
}

static void mesh_put_clipped(struct accel_pass *pass, const uint32_t index[3], uint32_t planes)
{
	struct accel_corner polygon[ACCEL_POLYGON_MAX];
	struct accel_vertex vertex[3], flat;
	int64_t area;
	int corners, side;

	mesh_vertices(pass, index, vertex);
	flat = vertex[2];
	corners = accel_mesh_clip(pass, vertex, index, planes, polygon);
	area = mesh_polygon_area(polygon, corners);
	side = mesh_visible_side(pass, area);
	if (side < 0) {
		pass->stats->culled++;
		return;
	}
	if (pass->lit && pass->interpolated)
		mesh_clip_lit(pass, vertex, index, planes, side, polygon);
	mesh_put_fan(pass, polygon, corners, &flat, area, side);
}

/* Draws what is in the group if it has no room for more. */
static int mesh_flush(struct accel_pass *pass, struct accel_seen *seen)
{
	const int count = seen->count;

	pass->stats->culled += (uint64_t)(count - accel_mesh_put(pass, seen, false));
	return accel_group_full(pass->group) ? accel_face_draw_all(pass) : 0;
}

/* The last of @index is the vertex that gives a flat triangle its colour. */
static int mesh_put_triangle(struct accel_pass *pass, const uint32_t index[3],
			     struct accel_seen *seen)
{
	const struct accel_screen *const screen = pass->screen;
	const struct accel_screen *a = &screen[index[0]], *b = &screen[index[1]];
	const struct accel_screen *c = &screen[index[2]];
	const uint32_t planes = (a->outside | b->outside | c->outside) & ACCEL_OUTSIDE_CLIP;
	int side = -1, err;

	if (!(a->outside & b->outside & c->outside)) {
		if (planes) {
			err = mesh_flush(pass, seen);
			if (!err)
				mesh_put_clipped(pass, index, planes);
			return err;
		}
		side = mesh_visible_side(pass, accel_setup_area(&a->at, &b->at, &c->at));
	}
	if (side < 0) {
		pass->stats->culled++;
		return 0;
	}
	accel_mesh_see(seen, (const struct accel_point *[3]){ &a->at, &b->at, &c->at }, index,
		       index[2], side);
	return seen->count == ACCEL_BATCH ? mesh_flush(pass, seen) : 0;
}

/*
 * Takes triangles of a list of indices, at most @most, while there is room, up to one that needs
 * more than to be seen or culled. Returns how many.
 */
static uint32_t mesh_see_listed(const struct accel_pass *pass, struct accel_walk *walk,
				uint64_t most, struct accel_seen *seen)
{
	const uint32_t odd = ACCEL_OUTSIDE_CLIP | ACCEL_OUTSIDE_INFINITE;
	const uint32_t vertices = pass->arrays->vertices, base = pass->base;
	const int before = seen->count;
	uint32_t taken, index[3];

	if (!walk->number)
		return 0;
	if (most > walk->triangles - walk->triangle)
		most = walk->triangles - walk->triangle;
	for (taken = 0; taken < most && seen->count < ACCEL_BATCH; taken++) {
		const struct accel_screen *a, *b, *c;
		int side;

		memcpy(index, walk->number + taken * sizeof(index), sizeof(index));
		if (index[0] >= vertices || index[1] >= vertices || index[2] >= vertices)
			break;
		for (int i = 0; i < 3; i++)
			index[i] -= base;
		a = &pass->screen[index[0]];
		b = &pass->screen[index[1]];
		c = &pass->screen[index[2]];
		if ((a->outside | b->outside | c->outside) & odd)
			break;
		if (a->outside & b->outside & c->outside)
			continue;
		side = mesh_visible_side(pass, accel_setup_area(&a->at, &b->at, &c->at));
		if (side >= 0)
			accel_mesh_see(seen,
				       (const struct accel_point *[3]){ &a->at, &b->at, &c->at },
				       index, index[2], side);
	}
	walk->number += taken * sizeof(index);
	walk->triangle += taken;
	pass->stats->triangles_in += taken;
	pass->stats->culled += taken - (uint32_t)(seen->count - before);
	return taken;
}

static int mesh_put_next(struct accel_pass *pass, struct accel_walk *walk, struct accel_seen *seen)
{
	uint32_t index[3];

	pass->stats->triangles_in++;
	if (accel_primitives_next(walk, index))
		return mesh_put_triangle(pass, index, seen);
	pass->stats->culled++;
	return 0;
}

int accel_mesh_draw(struct accel_pass *pass, uint64_t first, uint64_t end)
{
	struct accel_seen seen; /* large: what is not counted is not set */
	struct accel_walk walk;
	uint64_t i = first;
	int err = 0;

	mesh_see_none(&seen);
	if (first < end)
		accel_primitives_begin(&walk, pass, first);
	while (i < end && !err) {
		i += mesh_see_listed(pass, &walk, end - i, &seen);
		if (seen.count == ACCEL_BATCH) {
			err = mesh_flush(pass, &seen);
		} else if (i < end) {
			err = mesh_put_next(pass, &walk, &seen);
			i++;
		}
	}
	if (!err)
		err = mesh_flush(pass, &seen);
	return err ? err : accel_face_draw_all(pass);
}
