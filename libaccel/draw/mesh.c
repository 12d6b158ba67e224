// SPDX-License-Identifier: MIT
/* A mesh's triangles, one after the other: their vertices, whether they are seen, which side. */
#include <errno.h>
#include <math.h>
#include <string.h>

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

/* Vertices from @first on, transformed. -EINVAL: *@bad of them is not finite. */
static int mesh_transform_batch(const struct accel_pass *pass, uint32_t first, int count,
				struct accel_vertex_batch *batch, int *bad)
{
	bool normal = pass->lit && pass->normal.data;
	bool colour = (!pass->lit || pass->painted) && pass->colour.data;

	accel_fetch_batch(&pass->position, first, count, 3, batch->position);
	if (normal)
		accel_fetch_batch(&pass->normal, first, count, 3, batch->across);
	if (colour)
		accel_fetch_batch(&pass->colour, first, count, 4, batch->paint);
	for (int i = 0; i < 4 && !colour; i++)
		for (int j = 0; j < count; j++)
			batch->paint[i][j] = 1;
	accel_kernel()->transform(&pass->transform, batch, count, normal);
	for (*bad = 0; *bad < count; ++*bad)
		if (!batch->finite[*bad])
			return -EINVAL;
	return 0;
}

int accel_mesh_transform(struct accel_pass *pass)
{
	struct accel_vertex_batch batch = { 0 };
	const uint32_t vertices = pass->mesh->vertices;
	int count, bad, err;

	for (uint32_t first = 0; first < vertices; first += (uint32_t)count) {
		count = vertices - first < ACCEL_BATCH ? (int)(vertices - first) : ACCEL_BATCH;
		err = mesh_transform_batch(pass, first, count, &batch, &bad);
		if (err) {
			accel_device_message(pass->device, "vertex %u of the mesh is not finite",
					     first + (uint32_t)bad);
			return err;
		}
		for (int i = 0; i < count; i++) {
			struct accel_vertex *vertex = &pass->vertex[first + (uint32_t)i];

			accel_geometry_vertex_of(&batch, i, vertex);
			/* Without lighting it is all there is to see. */
			vertex->sample = (struct accel_sample){ 0 };
			memcpy(vertex->sample.colour, vertex->paint, sizeof(vertex->paint));
			pass->screen[first + (uint32_t)i] = (struct accel_screen){
				vertex->x, vertex->y, vertex->outside
			};
		}
	}
	return 0;
}

/* The direction in which the front of a triangle looks, by its vertices in eye space. */
static void mesh_face_normal(const float a[3], const float b[3], const float c[3], float out[3])
{
	double n[3], length;

	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		n[i] = ((double)b[j] - (double)a[j]) * ((double)c[k] - (double)a[k]) -
		       ((double)b[k] - (double)a[k]) * ((double)c[j] - (double)a[j]);
	}
	length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
	for (int i = 0; i < 3; i++)
		out[i] = length > 0 ? (float)(n[i] / length) : 0;
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

static int mesh_cull(struct accel_pass *pass)
{
	pass->stats->culled++;
	return 0;
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

static int mesh_draw_fan(struct accel_pass *pass, struct accel_corner *polygon, int corners,
			 struct accel_vertex *flat, int64_t area, int side)
{
	int apex = accel_clip_apex(polygon, corners), err = 0;
	uint64_t culled = pass->stats->culled, parts = 0;

	for (int i = 1; i + 1 < corners && !err; i++) {
		struct accel_vertex *const fan[3] = {
			&polygon[apex].vertex,
			&polygon[(apex + i) % corners].vertex,
			&polygon[(apex + i + 1) % corners].vertex,
		};
		int64_t part = accel_surface_area(fan[0], fan[1], fan[2]);

		if (!part || (part > 0) != (area > 0))
			continue;
		parts++;
		err = accel_split_draw(pass, fan, NULL, flat, side);
	}
	/* They count as the one triangle that they are. */
	if (pass->stats->culled - culled == parts) {
		pass->stats->culled = culled + 1;
	} else {
		pass->stats->culled = culled;
		pass->stats->clipped++;
	}
	return err;
}

static int mesh_clip(const struct accel_pass *pass, struct accel_vertex *const vertex[3],
		     const uint32_t index[3], uint32_t planes,
		     struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	for (int i = 0; i < 3; i++) {
		float position[4];

		accel_fetch_element(&pass->position, index[i], position);
		accel_clip_corner(&pass->transform, position, &polygon[i]);
		polygon[i].vertex = *vertex[i];
		polygon[i].vertex.sampled = 0;
	}
	return accel_clip_polygon(&pass->transform.window, planes, polygon);
}

/* The same, with the light at the triangle's own vertices to interpolate between. */
static void mesh_clip_lit(const struct accel_pass *pass, struct accel_vertex *const vertex[3],
			  const uint32_t index[3], uint32_t planes, int side,
			  struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	int corners;

	for (int i = 0; i < 3; i++)
		accel_shading_vertex(pass, vertex[i], side);
	corners = mesh_clip(pass, vertex, index, planes, polygon);
	for (int i = 0; i < corners; i++)
		polygon[i].vertex.sampled = 1u + (unsigned int)side;
}

static int mesh_draw_clipped(struct accel_pass *pass, struct accel_vertex *const vertex[3],
			     const uint32_t index[3], uint32_t planes)
{
	struct accel_corner polygon[ACCEL_POLYGON_MAX];
	struct accel_vertex flat = *vertex[2];
	int64_t area;
	int corners, side;

	flat.sampled = 0;
	corners = mesh_clip(pass, vertex, index, planes, polygon);
	area = mesh_polygon_area(polygon, corners);
	side = mesh_visible_side(pass->state, area);
	if (side < 0)
		return mesh_cull(pass);
	if (pass->lit && pass->interpolated)
		mesh_clip_lit(pass, vertex, index, planes, side, polygon);
	return mesh_draw_fan(pass, polygon, corners, &flat, area, side);
}

/* Copies of a triangle's vertices that have its own normal. */
static void mesh_flatten(struct accel_vertex *vertex[3], struct accel_vertex own[3])
{
	for (int i = 0; i < 3; i++) {
		own[i] = *vertex[i];
		vertex[i] = &own[i];
	}
	mesh_face_normal(own[0].eye, own[1].eye, own[2].eye, own[0].normal);
	memcpy(own[1].normal, own[0].normal, sizeof(own[0].normal));
	memcpy(own[2].normal, own[0].normal, sizeof(own[0].normal));
}

/* What of a triangle is seen: the side, -1 if nothing; *@planes are those that cut it. */
static int mesh_seen(const struct accel_pass *pass, const uint32_t index[3], uint32_t *planes)
{
	const struct accel_screen a = pass->screen[index[0]], b = pass->screen[index[1]];
	const struct accel_screen c = pass->screen[index[2]];

	if (a.outside & b.outside & c.outside)
		return -1;
	*planes = (a.outside | b.outside | c.outside) & ACCEL_OUTSIDE_CLIP;
	if (*planes)
		return 0;
	return mesh_visible_side(pass->state, (int64_t)(b.x - a.x) * (c.y - a.y) -
						      (int64_t)(c.x - a.x) * (b.y - a.y));
}

/* The last of @index is the vertex that gives a flat triangle its colour. */
static int mesh_draw_triangle(struct accel_pass *pass, const uint32_t index[3])
{
	bool shared = !pass->lit || pass->normal.data;
	struct accel_vertex *vertex[3], own[3];
	uint32_t planes;
	int side = mesh_seen(pass, index, &planes);

	pass->stats->triangles_in++;
	if (side < 0)
		return mesh_cull(pass);
	for (int i = 0; i < 3; i++)
		vertex[i] = &pass->vertex[index[i]];
	if (!shared)
		mesh_flatten(vertex, own);
	if (planes)
		return mesh_draw_clipped(pass, vertex, index, planes);
	return accel_split_draw(pass, vertex, shared ? index : NULL, vertex[2], side);
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

int accel_mesh_draw(struct accel_pass *pass)
{
	const struct accel_mesh *mesh = pass->mesh;
	uint32_t elements = mesh->index ? mesh->indices : mesh->vertices;
	uint32_t step = mesh->topology == ACCEL_TOPOLOGY_TRIANGLES ? 3 : 1;
	uint32_t index[3];
	int err = 0;

	for (uint32_t i = 0; elements - i >= 3 && !err; i += step) {
		mesh_triangle_index(mesh, i, index);
		err = mesh_draw_triangle(pass, index);
	}
	return err;
}
