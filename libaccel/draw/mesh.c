// SPDX-License-Identifier: MIT
/* A mesh's triangles, one after the other: their vertices, whether they are seen, which side. */
#include <errno.h>
#include <string.h>

#include "draw/group.h"
#include "draw/kernel.h"

static int mesh_check(struct accel_device *device, const struct accel_mesh *mesh)
{
	if (mesh->topology < ACCEL_TOPOLOGY_TRIANGLES ||
	    mesh->topology > ACCEL_TOPOLOGY_TRIANGLE_FAN) {
		accel_device_message(device,
				     "a mesh of topology %u: so far triangles, their strips "
				     "and fans are drawn, %u to %u",
				     mesh->topology, ACCEL_TOPOLOGY_TRIANGLES,
				     ACCEL_TOPOLOGY_TRIANGLE_FAN);
		return -EINVAL;
	}
	if (!mesh->position.data || mesh->reserved) {
		accel_device_message(device, mesh->reserved ?
						     "a mesh whose reserved member is set" :
						     "a mesh without positions");
		return -EINVAL;
	}
	for (uint32_t i = 0; mesh->index && i < mesh->indices; i++) {
		if (mesh->index[i] < mesh->vertices)
			continue;
		accel_device_message(device, "index %u is of vertex %u, and the mesh has %u", i,
				     mesh->index[i], mesh->vertices);
		return -EINVAL;
	}
	return 0;
}

int accel_mesh_begin(struct accel_pass *pass)
{
	const struct accel_mesh *mesh = pass->mesh;
	int err = mesh_check(pass->device, mesh);

	if (!err)
		err = accel_fetch_init(&pass->position, pass->device, ACCEL_ATTRIBUTE_POSITION,
				       &mesh->position);
	if (!err)
		err = accel_fetch_init(&pass->normal, pass->device, ACCEL_ATTRIBUTE_NORMAL,
				       &mesh->normal);
	if (!err)
		err = accel_fetch_init(&pass->colour, pass->device, ACCEL_ATTRIBUTE_COLOUR,
				       &mesh->colour);
	return err;
}

void accel_mesh_fetch(const struct accel_pass *pass, const uint32_t *index, int count,
		      struct accel_vertex_batch *batch)
{
	bool normal = pass->lit && pass->normal.data;
	bool colour = (!pass->lit || pass->painted) && pass->colour.data;

	accel_fetch_batch(&pass->position, index, count, 3, batch->position);
	if (normal)
		accel_fetch_batch(&pass->normal, index, count, 3, batch->across);
	if (colour)
		accel_fetch_batch(&pass->colour, index, count, 4, batch->paint);
	for (int i = 0; i < 4 && !colour; i++)
		for (int j = 0; j < count; j++)
			batch->paint[i][j] = 1;
	accel_kernel()->transform(&pass->transform, batch, count, normal);
}

/* Keeps what culling needs of vertices from @first on; returns how many there are up to a bad one. */
static int mesh_keep(const struct accel_pass *pass, uint32_t first, int count,
		     const struct accel_vertex_batch *batch)
{
	for (int i = 0; i < count; i++) {
		if (!batch->finite[i])
			return i;
		pass->screen[first + (uint32_t)i] = (struct accel_screen){
			{ batch->x[i], batch->y[i] }, batch->outside[i]
		};
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
static int mesh_visible_side(const struct accel_state *state, int64_t area)
{
	/* Counter-clockwise on screen is front, and window y points down. */
	bool back = area > 0;

	if (area == 0 || state->cull == (back ? ACCEL_CULL_BACK : ACCEL_CULL_FRONT))
		return -1;
	return back && state->two_sided && state->lighting ? 1 : 0;
}

/* Puts a triangle into the group, unless it covers no pixel; then returns NULL. */
static struct accel_face *mesh_put(struct accel_pass *pass, const struct accel_point point[3],
				   int side)
{
	struct accel_face *face = accel_group_face(pass->group);

	if (accel_setup_points(&face->setup, point) &&
	    accel_setup_draws(&face->setup, &pass->transform.window.visible)) {
		face->side = side;
		return face;
	}
	pass->group->faces--;
	return NULL;
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

/* A triangle of the fan that is left of a clipped one; false: it covers no pixel. */
static bool mesh_put_corner(struct accel_pass *pass, const struct accel_vertex *const corner[3],
			    const uint32_t vertex[3], uint32_t flat, int side)
{
	struct accel_point point[3];
	struct accel_face *face;

	for (int i = 0; i < 3; i++)
		point[i] = (struct accel_point){ corner[i]->x, corner[i]->y };
	face = mesh_put(pass, point, side);
	if (!face)
		return false;
	memcpy(face->vertex, vertex, sizeof(face->vertex));
	face->flat = flat;
	face->clipped = true;
	return true;
}

/* Its parts count as the one triangle that they are. */
static void mesh_put_fan(struct accel_pass *pass, struct accel_corner *polygon, int corners,
			 struct accel_vertex *flat, int64_t area, int side)
{
	int apex = accel_clip_apex(polygon, corners);
	uint32_t number[ACCEL_POLYGON_MAX], of_flat;
	bool drawn = false;

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
		const struct accel_vertex *const fan[3] = { &polygon[at[0]].vertex,
							    &polygon[at[1]].vertex,
							    &polygon[at[2]].vertex };
		const uint32_t vertex[3] = { number[at[0]], number[at[1]], number[at[2]] };
		int64_t part = accel_surface_area(fan[0], fan[1], fan[2]);

		if (part && (part > 0) == (area > 0))
			drawn |= mesh_put_corner(pass, fan, vertex, of_flat, side);
	}
	if (drawn)
		pass->stats->clipped++;
	else
		pass->stats->culled++;
}

static int mesh_clip(const struct accel_pass *pass, const struct accel_vertex vertex[3],
		     const uint32_t index[3], uint32_t planes,
		     struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	for (int i = 0; i < 3; i++) {
		float position[4];

		accel_fetch_element(&pass->position, index[i], position);
		accel_clip_corner(&pass->transform, position, &polygon[i]);
		polygon[i].vertex = vertex[i];
		polygon[i].vertex.sampled = 0;
	}
	return accel_clip_polygon(&pass->transform.window, planes, polygon);
}

/* The same, with the light at the triangle's own vertices to interpolate between. */
static void mesh_clip_lit(const struct accel_pass *pass, struct accel_vertex vertex[3],
			  const uint32_t index[3], uint32_t planes, int side,
			  struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	int corners;

	for (int i = 0; i < 3; i++)
		accel_shading_vertex(pass, &vertex[i], side);
	corners = mesh_clip(pass, vertex, index, planes, polygon);
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
		accel_face_flatten(corner);
}

static void mesh_put_clipped(struct accel_pass *pass, const uint32_t index[3], uint32_t planes)
{
	struct accel_corner polygon[ACCEL_POLYGON_MAX];
	struct accel_vertex vertex[3], flat;
	int64_t area;
	int corners, side;

	mesh_vertices(pass, index, vertex);
	flat = vertex[2];
	corners = mesh_clip(pass, vertex, index, planes, polygon);
	area = mesh_polygon_area(polygon, corners);
	side = mesh_visible_side(pass->state, area);
	if (side < 0) {
		pass->stats->culled++;
		return;
	}
	if (pass->lit && pass->interpolated)
		mesh_clip_lit(pass, vertex, index, planes, side, polygon);
	mesh_put_fan(pass, polygon, corners, &flat, area, side);
}

/* The last of @index is the vertex that gives a flat triangle its colour. */
static void mesh_put_triangle(struct accel_pass *pass, const uint32_t index[3])
{
	const struct accel_screen *const screen = pass->screen;
	const struct accel_screen *a = &screen[index[0]], *b = &screen[index[1]];
	const struct accel_screen *c = &screen[index[2]];
	const uint32_t planes = (a->outside | b->outside | c->outside) & ACCEL_OUTSIDE_CLIP;
	struct accel_face *face = NULL;
	int side;

	pass->stats->triangles_in++;
	if (!(a->outside & b->outside & c->outside)) {
		if (planes) {
			mesh_put_clipped(pass, index, planes);
			return;
		}
		side = mesh_visible_side(pass->state, accel_setup_area(&a->at, &b->at, &c->at));
		if (side >= 0)
			face = mesh_put(pass, (const struct accel_point[3]){ a->at, b->at, c->at },
					side);
	}
	if (!face) {
		pass->stats->culled++;
		return;
	}
	memcpy(face->vertex, index, sizeof(face->vertex));
	face->clipped = false;
}

/* The vertices of the triangle that element @i of the mesh begins. */
static void mesh_triangle_index(const struct accel_mesh *mesh, uint32_t i, uint32_t index[3])
{
	uint32_t element[3] = { i, i + 1, i + 2 };

	if (mesh->topology == ACCEL_TOPOLOGY_TRIANGLE_FAN)
		element[0] = 0;
	/* Every second triangle of a strip turns the other way. */
	if (mesh->topology == ACCEL_TOPOLOGY_TRIANGLE_STRIP && i % 2) {
		element[0] = i + 1;
		element[1] = i;
	}
	for (int j = 0; j < 3; j++)
		index[j] = mesh->index ? mesh->index[element[j]] : element[j];
}

uint32_t accel_mesh_triangles(const struct accel_mesh *mesh)
{
	uint32_t elements = mesh->index ? mesh->indices : mesh->vertices;

	if (elements < 3)
		return 0;
	return mesh->topology == ACCEL_TOPOLOGY_TRIANGLES ? elements / 3 : elements - 2;
}

int accel_mesh_draw(struct accel_pass *pass, uint32_t first, uint32_t end)
{
	const uint32_t step = pass->mesh->topology == ACCEL_TOPOLOGY_TRIANGLES ? 3 : 1;
	uint32_t index[3];
	int err = 0;

	for (uint32_t i = first; i < end && !err; i++) {
		mesh_triangle_index(pass->mesh, i * step, index);
		mesh_put_triangle(pass, index);
		if (accel_group_full(pass->group))
			err = accel_face_draw_all(pass);
	}
	return err ? err : accel_face_draw_all(pass);
}
