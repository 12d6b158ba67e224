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
#include "scene/mesh_face.h"
#include "scene/mesh_place.h"

/* How many of a place's vertices a corner is compared with, so that a fan of a million ends. */
#define COMPARED 32
/* The same for triangles that share an edge, of which there should be two. */
#define SHARING 8

#define NONE UINT32_MAX

/* A corner at the place that is looked at, with the ends of its triangle's two edges there. */
struct corner {
	uint32_t triangle, which; /* corner 0, 1 or 2 of it */
	uint32_t group;           /* index of an earlier one of its group, or its own */
	uint32_t other[2];        /* the place at each edge's other end */
	uint32_t before[2];       /* an earlier corner with an edge to there, or NONE */
	struct face face;         /* its triangle's */
	float sum[3];             /* of a group's first: its normal, not of unit length */
	uint32_t vertex;          /* and the last that has it, or NONE */
};

struct build {
	const struct mesh *raw;
	enum mesh_normals normals;
	float (*given)[3]; /* normals of the file, if they are wanted; or NULL */
	float crease;      /* the cosine */
	struct places places;
	struct face *face;     /* of triangles; NULL if all normals are given */
	struct corner *corner; /* of the place, room for the most there are of one */
	/*
	 * Of each place, as seen from the one that is looked at: 1 + where in places.corner the
	 * last corner with an edge to there is. What an earlier place has left is lower than all
	 * that this one may have.
	 */
	uint32_t *last;
	struct mesh *mesh;
	uint32_t room; /* for vertices in mesh */
};

static float dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of unit length, or zero. */
static void unit(float out[3], const float v[3])
{
	double x = v[0], y = v[1], z = v[2], length = sqrt(x * x + y * y + z * z);

	for (int i = 0; i < 3; i++)
		out[i] = length > 0 && isfinite(length) ? (float)((double)v[i] / length) : 0;
}

/* The corner itself, or that which is @step further in its triangle. */
static uint32_t vertex_of(const struct build *build, const struct corner *corner, uint32_t step)
{
	uint32_t which = corner->which + step;

	return build->raw->triangle[corner->triangle][which < 3 ? which : which - 3];
}

/* What has no area has no normal, so it can not tell whether its edges are creases. */
static bool has_area(const float normal[3])
{
	return normal[0] || normal[1] || normal[2];
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
	a = group_of(build, a);
	b = group_of(build, b);
	build->corner[a > b ? a : b].group = a < b ? a : b;
}

/* Joins corner @i with earlier ones that have an edge to the same place, if it is no crease. */
static void join_over_edge(struct build *build, uint32_t i, int end)
{
	struct corner *corner = &build->corner[i];
	uint32_t other = corner->other[end], before = corner->before[end];

	for (int n = 0; n < SHARING && before != NONE; n++) {
		const struct corner *b = &build->corner[before];

		if (dot(corner->face.normal, b->face.normal) >= build->crease)
			join(build, i, before);
		before = b->before[b->other[0] != other];
	}
}

/* The places of a triangle with an area are three. */
static void find_edges(struct build *build, uint32_t begin, uint32_t i)
{
	struct corner *corner = &build->corner[i];

	for (int end = 0; end < 2; end++) {
		uint32_t other = build->places.place[vertex_of(build, corner, end + 1)];
		uint32_t *last = &build->last[other];

		corner->other[end] = other;
		corner->before[end] = *last > begin ? *last - begin - 1 : NONE;
		*last = begin + i + 1;
	}
}

static void make_groups(struct build *build, uint32_t begin, uint32_t corners)
{
	for (uint32_t i = 0; i < corners; i++) {
		struct corner *corner = &build->corner[i];

		corner->face = build->face[corner->triangle];
		corner->group = build->normals == MESH_NORMALS_SMOOTH ? 0 : i;
		corner->vertex = NONE;
		corner->before[0] = corner->before[1] = NONE;
		for (int axis = 0; axis < 3; axis++)
			corner->sum[axis] = 0;
		if (build->normals == MESH_NORMALS_CREASED && has_area(corner->face.normal))
			find_edges(build, begin, i);
	}
	for (uint32_t i = 0; i < corners; i++)
		for (int end = 0; end < 2; end++)
			join_over_edge(build, i, end);
}

static void sum_normals(struct build *build, uint32_t corners)
{
	for (uint32_t i = 0; i < corners; i++) {
		struct corner *corner = &build->corner[i];
		float *sum;

		/* Whose group it names has done the same before. */
		corner->group = build->corner[corner->group].group;
		sum = build->corner[corner->group].sum;
		for (int axis = 0; axis < 3; axis++)
			sum[axis] += corner->face.angle[corner->which] * corner->face.normal[axis];
	}
}

/* ---- vertices ---- */

static int grow(struct build *build)
{
	uint32_t twice = build->room < UINT32_MAX / 2 ? build->room * 2 : UINT32_MAX;
	uint32_t room = build->room ? twice : build->raw->vertices;
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
	if (build->given)
		unit(normal, build->given[vertex]);
	else
		normal[0] = normal[1] = normal[2] = 0;
}

static void made_normal(struct build *build, const struct corner *corner, const float sum[3],
			float normal[3])
{
	if (build->normals == MESH_NORMALS_FACETS)
		memcpy(normal, corner->face.normal, sizeof(float[3]));
	else
		unit(normal, sum);
	/* Where there is nothing but degenerate triangles, or opposite ones, any will do. */
	if (!has_area(normal))
		normal[2] = 1;
}

static bool wants_normals(const struct build *build, uint32_t corners)
{
	for (uint32_t i = 0; i < corners && build->face; i++) {
		float normal[3];

		given_normal(build, vertex_of(build, &build->corner[i], 0), normal);
		if (!has_area(normal))
			return true;
	}
	return false;
}

/* The vertex of corner @i of the place whose vertices begin at @first. */
static int add_corner(struct build *build, uint32_t i, uint32_t first, uint32_t *number)
{
	const struct corner *corner = &build->corner[i];
	uint32_t vertex = vertex_of(build, corner, 0);
	struct corner *group;
	float normal[3];
	int ret;

	given_normal(build, vertex, normal);
	if (has_area(normal))
		return add_vertex(build, vertex, normal, first, number);
	group = &build->corner[corner->group];
	/* What add_vertex would find. */
	if (group->vertex != NONE && !build->raw->colour && build->normals != MESH_NORMALS_FACETS &&
	    build->mesh->vertices - group->vertex <= COMPARED) {
		*number = group->vertex;
		return 0;
	}
	made_normal(build, corner, group->sum, normal);
	ret = add_vertex(build, vertex, normal, first, number);
	group->vertex = *number;
	return ret;
}

static int build_place(struct build *build, uint32_t place)
{
	uint32_t begin = build->places.first[place];
	uint32_t corners = build->places.first[place + 1] - begin;
	uint32_t first = build->mesh->vertices;
	int ret = 0;

	for (uint32_t i = 0; i < corners; i++) {
		build->corner[i].triangle = build->places.corner[begin + i] / 3;
		build->corner[i].which = build->places.corner[begin + i] % 3;
	}
	if (wants_normals(build, corners)) {
		make_groups(build, begin, corners);
		sum_normals(build, corners);
	}
	for (uint32_t i = 0; i < corners && !ret; i++) {
		const struct corner *corner = &build->corner[i];

		ret = add_corner(build, i, first,
				 &build->mesh->triangle[corner->triangle][corner->which]);
	}
	return ret;
}

static bool all_given(const struct build *build)
{
	for (uint32_t i = 0; i < build->raw->vertices; i++) {
		float normal[3];

		given_normal(build, i, normal);
		if (!has_area(normal))
			return false;
	}
	return true;
}

static int begin_faces(struct build *build)
{
	build->face = malloc(build->raw->triangles * sizeof(*build->face));
	build->last = calloc(build->raw->vertices, sizeof(*build->last));
	if (!build->face || !build->last)
		return -ENOMEM;
	faces_make(build->raw, build->face);
	return 0;
}

static int start(struct build *build)
{
	const struct mesh *raw = build->raw;
	int ret = places_new(raw, &build->places);

	if (ret)
		return ret;
	build->corner = calloc(build->places.most, sizeof(*build->corner));
	build->mesh->triangles = raw->triangles;
	build->mesh->triangle = malloc(raw->triangles * sizeof(*build->mesh->triangle));
	if (!build->corner || !build->mesh->triangle)
		return -ENOMEM;
	return all_given(build) ? 0 : begin_faces(build);
}

int mesh_build(const struct mesh *raw, enum mesh_normals normals, float crease, struct mesh *mesh)
{
	struct build build = {
		.raw = raw,
		.normals = normals,
		.given = normals == MESH_NORMALS_CREASED ? raw->normal : NULL,
		.crease = cosf(crease * (3.14159265f / 180)),
		.mesh = mesh,
	};
	int ret;

	memset(mesh, 0, sizeof(*mesh));
	ret = start(&build);
	for (uint32_t i = 0; i < raw->vertices && !ret; i++)
		ret = build_place(&build, i);
	places_free(&build.places);
	free(build.face);
	free(build.corner);
	free(build.last);
	if (ret)
		mesh_free(mesh);
	return ret;
}
