// SPDX-License-Identifier: MIT
/*
 * Normals, and vertices that are joined exactly. A place is a point in space, known by the number
 * of the first vertex there; a corner is that of a triangle, number 3 * triangle + 0, 1 or 2.
 *
 * Around a place the corners of neighbouring triangles belong together unless the edge between
 * them is a crease. Those that belong together have one normal: the sum of their triangles'
 * normals, each weighted with the angle it has there, so that it does not matter how a face is
 * cut into triangles.
 */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"
#include "scene/mesh_place.h"

/* How many of a place's vertices a corner is compared with, so that a fan of a million ends. */
#define COMPARED 32
/* The same for triangles that share an edge, of which there should be two. */
#define SHARING 8

/* A corner at the place that is looked at. */
struct corner {
	uint32_t number;
	uint32_t group;			/* index of another of its group, or its own */
	float sum[3];			/* of a group's first: its normal, not of unit length */
};

/* One end of an edge: the place at the other end, and the index of the corner. */
struct end {
	uint32_t place, corner;
};

struct build {
	const struct mesh *raw;
	enum mesh_normals normals;
	float crease;			/* the cosine */
	struct places places;
	float (*face)[3];		/* of triangles; zero without area */
	struct corner *corner;		/* of the place, room for the most there are of one */
	struct end *end;		/* twice as many */
	struct mesh *mesh;
	uint32_t room;			/* for vertices in mesh */
};

static float dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(double out[3], const float a[3], const float b[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = (double)a[i] - (double)b[i];
}

/* Of unit length, or zero. */
static void unit(float out[3], const double v[3])
{
	double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

	for (int i = 0; i < 3; i++)
		out[i] = length > 0 && isfinite(length) ? (float)(v[i] / length) : 0;
}

static void face_normal(const struct mesh *raw, uint32_t triangle, float normal[3])
{
	const uint32_t *index = raw->triangle[triangle];
	double u[3], v[3], n[3];

	subtract(u, raw->position[index[1]], raw->position[index[0]]);
	subtract(v, raw->position[index[2]], raw->position[index[0]]);
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		n[i] = u[j] * v[k] - u[k] * v[j];
	}
	unit(normal, n);
}

static uint32_t vertex_of(const struct build *build, uint32_t corner, uint32_t step)
{
	return build->raw->triangle[corner / 3][(corner % 3 + step) % 3];
}

/* The angle of a corner. */
static float angle(const struct build *build, uint32_t corner)
{
	float (*p)[3] = build->raw->position;
	const float *at = p[vertex_of(build, corner, 0)];
	double u[3], v[3], cross[3], cosine = 0;

	subtract(u, p[vertex_of(build, corner, 1)], at);
	subtract(v, p[vertex_of(build, corner, 2)], at);
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		cross[i] = u[j] * v[k] - u[k] * v[j];
		cosine += u[i] * v[i];
	}
	return (float)atan2(sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]),
			    cosine);
}

/* ---- what belongs together ---- */

static uint32_t group_of(struct build *build, uint32_t corner)
{
	struct corner *c = build->corner;

	while (c[corner].group != corner) {
		c[corner].group = c[c[corner].group].group;
		corner = c[corner].group;
	}
	return corner;
}

static void join(struct build *build, uint32_t a, uint32_t b)
{
	build->corner[group_of(build, a)].group = group_of(build, b);
}

static int compare_ends(const void *a, const void *b)
{
	const struct end *p = a, *q = b;

	return p->place < q->place ? -1 : p->place > q->place;
}

static const float *face_of(const struct build *build, uint32_t corner)
{
	return build->face[build->corner[corner].number / 3];
}

/* Most places have a dozen ends, for which the C library's sort is slow. */
static void sort_ends(struct end *end, uint32_t ends)
{
	if (ends > 64) {
		qsort(end, ends, sizeof(*end), compare_ends);
		return;
	}
	for (uint32_t i = 1; i < ends; i++) {
		struct end moved = end[i];
		uint32_t j = i;

		for (; j && end[j - 1].place > moved.place; j--)
			end[j] = end[j - 1];
		end[j] = moved;
	}
}

/* Joins the corners whose edges lead to the same place, if that edge is no crease. */
static void join_over_edges(struct build *build, uint32_t ends)
{
	struct end *end = build->end;

	sort_ends(end, ends);
	for (uint32_t i = 1; i < ends; i++) {
		uint32_t least = i > SHARING ? i - SHARING : 0;

		for (uint32_t j = i; j > least && end[j - 1].place == end[i].place; j--)
			if (dot(face_of(build, end[i].corner), face_of(build, end[j - 1].corner)) >=
			    build->crease)
				join(build, end[i].corner, end[j - 1].corner);
	}
}

/* What has no area has no normal, so it can not tell whether its edges are creases. */
static bool has_area(const float normal[3])
{
	return normal[0] || normal[1] || normal[2];
}

static void make_groups(struct build *build, uint32_t corners)
{
	uint32_t ends = 0;

	for (uint32_t i = 0; i < corners; i++) {
		struct corner *corner = &build->corner[i];

		corner->group = build->normals == MESH_NORMALS_SMOOTH ? 0 : i;
		for (int axis = 0; axis < 3; axis++)
			corner->sum[axis] = 0;
		if (!has_area(face_of(build, i)))
			continue;
		for (uint32_t step = 1; step < 3; step++) {
			build->end[ends].place =
				build->places.place[vertex_of(build, corner->number, step)];
			build->end[ends++].corner = i;
		}
	}
	if (build->normals == MESH_NORMALS_CREASED)
		join_over_edges(build, ends);
}

static void sum_normals(struct build *build, uint32_t corners)
{
	for (uint32_t i = 0; i < corners; i++) {
		float *sum = build->corner[group_of(build, i)].sum;
		float weight = angle(build, build->corner[i].number);

		for (int axis = 0; axis < 3; axis++)
			sum[axis] += weight * face_of(build, i)[axis];
	}
}

/* ---- vertices ---- */

static int grow(struct build *build)
{
	uint32_t room = build->room < UINT32_MAX / 2 ? build->room * 2 + 64 : UINT32_MAX;
	struct mesh *mesh = build->mesh, larger = *mesh;

	/* Each is the mesh's as soon as it is there, so that nothing is lost or freed twice. */
	larger.position = reallocarray(mesh->position, room, sizeof(*mesh->position));
	if (!larger.position)
		return -ENOMEM;
	mesh->position = larger.position;
	larger.normal = reallocarray(mesh->normal, room, sizeof(*mesh->normal));
	if (!larger.normal)
		return -ENOMEM;
	mesh->normal = larger.normal;
	if (build->raw->colour) {
		larger.colour = reallocarray(mesh->colour, room, sizeof(*mesh->colour));
		if (!larger.colour)
			return -ENOMEM;
		mesh->colour = larger.colour;
	}
	build->room = room;
	return 0;
}

static bool equal(const float *a, const float *b, int count)
{
	for (int i = 0; i < count; i++)
		if (a[i] != b[i])
			return false;
	return true;
}

/* The number of a vertex like @raw with @normal among the last ones of its place, or a new one. */
static int add_vertex(struct build *build, uint32_t raw, const float normal[3], uint32_t first,
		      uint32_t *number)
{
	const float *colour = build->raw->colour ? build->raw->colour[raw] : NULL;
	struct mesh *mesh = build->mesh;

	for (uint32_t i = mesh->vertices; i > first && mesh->vertices - i < COMPARED; i--) {
		if (!equal(mesh->normal[i - 1], normal, 3) ||
		    (colour && !equal(mesh->colour[i - 1], colour, 4)))
			continue;
		*number = i - 1;
		return 0;
	}
	if (mesh->vertices == build->room && grow(build))
		return -ENOMEM;
	*number = mesh->vertices++;
	memcpy(mesh->position[*number], build->raw->position[raw], sizeof(*mesh->position));
	memcpy(mesh->normal[*number], normal, sizeof(*mesh->normal));
	if (colour)
		memcpy(mesh->colour[*number], colour, sizeof(*mesh->colour));
	return 0;
}

/* The one the file gives; zero if it gives none or it is not wanted. */
static void given_normal(const struct build *build, uint32_t vertex, float normal[3])
{
	const float *given = build->raw->normal ? build->raw->normal[vertex] : NULL;

	if (given && build->normals == MESH_NORMALS_CREASED)
		unit(normal, (const double[3]){ given[0], given[1], given[2] });
	else
		normal[0] = normal[1] = normal[2] = 0;
}

static void made_normal(struct build *build, uint32_t corner, float normal[3])
{
	const float *sum = build->corner[group_of(build, corner)].sum;

	if (build->normals == MESH_NORMALS_FACETS)
		memcpy(normal, face_of(build, corner), sizeof(float[3]));
	else
		unit(normal, (const double[3]){ sum[0], sum[1], sum[2] });
	/* Where there is nothing but degenerate triangles, or opposite ones, any will do. */
	if (!has_area(normal))
		normal[2] = 1;
}

static bool wants_normals(const struct build *build, uint32_t corners)
{
	for (uint32_t i = 0; i < corners; i++) {
		float normal[3];

		given_normal(build, vertex_of(build, build->corner[i].number, 0), normal);
		if (!has_area(normal))
			return true;
	}
	return false;
}

static int build_place(struct build *build, uint32_t place)
{
	const uint32_t *list = build->places.corner + build->places.first[place];
	uint32_t corners = build->places.first[place + 1] - build->places.first[place];
	uint32_t first = build->mesh->vertices;
	int ret = 0;

	for (uint32_t i = 0; i < corners; i++)
		build->corner[i].number = list[i];
	if (wants_normals(build, corners)) {
		make_groups(build, corners);
		sum_normals(build, corners);
	}
	for (uint32_t i = 0; i < corners && !ret; i++) {
		uint32_t number = list[i], vertex = vertex_of(build, number, 0);
		float normal[3];

		given_normal(build, vertex, normal);
		if (!has_area(normal))
			made_normal(build, i, normal);
		ret = add_vertex(build, vertex, normal, first,
				 &build->mesh->triangle[number / 3][number % 3]);
	}
	return ret;
}

static int begin(struct build *build)
{
	const struct mesh *raw = build->raw;
	int ret = places_new(raw, &build->places);

	if (ret)
		return ret;
	build->face = calloc(raw->triangles, sizeof(*build->face));
	build->corner = calloc(build->places.most, sizeof(*build->corner));
	build->end = calloc(build->places.most, 2 * sizeof(*build->end));
	build->mesh->triangles = raw->triangles;
	build->mesh->triangle = calloc(raw->triangles, sizeof(*build->mesh->triangle));
	if (!build->face || !build->corner || !build->end || !build->mesh->triangle)
		return -ENOMEM;
	for (uint32_t i = 0; i < raw->triangles; i++)
		face_normal(raw, i, build->face[i]);
	return 0;
}

int mesh_build(const struct mesh *raw, enum mesh_normals normals, float crease, struct mesh *mesh)
{
	struct build build = {
		.raw = raw,
		.normals = normals,
		.crease = cosf(crease * (3.14159265f / 180)),
		.mesh = mesh,
	};
	int ret;

	memset(mesh, 0, sizeof(*mesh));
	ret = begin(&build);
	for (uint32_t i = 0; i < raw->vertices && !ret; i++)
		ret = build_place(&build, i);
	places_free(&build.places);
	free(build.face);
	free(build.corner);
	free(build.end);
	if (ret)
		mesh_free(mesh);
	return ret;
}
