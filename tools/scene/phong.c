// SPDX-License-Identifier: MIT
/* Vertices to triangles inside the near and far plane; phong_fill.c draws those. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/matrix.h"
#include "scene/phong_priv.h"

int phong_frame_new(const struct scene *scene, bool light, struct phong_frame *frame)
{
	size_t pixels = (size_t)scene->width * scene->height;

	frame->width = scene->width;
	frame->height = scene->height;
	frame->pixel = malloc(pixels * sizeof(*frame->pixel));
	frame->depth = malloc(pixels * sizeof(*frame->depth));
	frame->light = light ? malloc(pixels * sizeof(*frame->light)) : NULL;
	if (frame->pixel && frame->depth && (frame->light || !light))
		return 0;
	phong_frame_free(frame);
	return -ENOMEM;
}

void phong_frame_free(struct phong_frame *frame)
{
	free(frame->pixel);
	free(frame->depth);
	free(frame->light);
	memset(frame, 0, sizeof(*frame));
}

static float clamp(float value)
{
	return value < 0 ? 0 : value > 1 ? 1 : value;
}

static uint32_t pack(const float rgba[4])
{
	uint32_t word = 0;

	for (int i = 0; i < 4; i++)
		word |= (uint32_t)(clamp(rgba[i]) * 255 + 0.5f) << 8 * i;
	return word;
}

static void clear(struct phong_frame *frame, const float background[4])
{
	size_t pixels = (size_t)frame->width * frame->height;
	uint32_t word = pack(background);

	for (size_t i = 0; i < pixels; i++) {
		frame->pixel[i] = word;
		frame->depth[i] = 1;
	}
	for (size_t i = 0; frame->light && i < pixels; i++)
		memcpy(frame->light[i], background, sizeof(frame->light[i]));
}

/* Model to clip space, column by column. */
static void clip_matrix(double m[16], const struct scene *scene)
{
	for (int column = 0; column < 4; column++) {
		for (int row = 0; row < 4; row++) {
			double sum = 0;

			for (int i = 0; i < 4; i++)
				sum += (double)scene->projection[4 * i + row] *
				       (double)scene->modelview[4 * column + i];
			m[4 * column + row] = sum;
		}
	}
}

static void transform_normal(float out[3], const float m[9], const float normal[3])
{
	float length;

	for (int row = 0; row < 3; row++)
		out[row] = m[row] * normal[0] + m[3 + row] * normal[1] + m[6 + row] * normal[2];
	length = sqrtf(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
	for (int i = 0; i < 3 && length > 0; i++)
		out[i] /= length;
}

/* Distance from the near (0) or far (1) plane, positive inside. */
static double inside(const struct phong_vertex *v, int plane)
{
	return plane ? v->clip[3] - v->clip[2] : v->clip[3] + v->clip[2];
}

static bool between_planes(const struct phong_vertex *v)
{
	return inside(v, 0) >= 0 && inside(v, 1) >= 0;
}

static struct phong_vertex *transform(const struct scene *scene, const struct phong_frame *frame)
{
	const struct accel_mesh *mesh = &scene->mesh;
	const float(*position)[3] = mesh->position.data, (*normal)[3] = mesh->normal.data;
	const float(*colour)[4] = mesh->colour.data;
	struct phong_vertex *vertex = calloc(mesh->vertices, sizeof(*vertex));
	float normal_matrix[9];
	double m[16];

	if (!vertex)
		return NULL;
	matrix_normal(normal_matrix, scene->modelview);
	clip_matrix(m, scene);
	for (uint32_t i = 0; i < mesh->vertices; i++) {
		const float *p = position[i];
		struct phong_vertex *v = &vertex[i];
		float eye[4];

		matrix_transform(eye, scene->modelview, p);
		memcpy(v->eye, eye, sizeof(v->eye));
		for (int row = 0; row < 4; row++)
			v->clip[row] = m[row] * (double)p[0] + m[4 + row] * (double)p[1] +
				       m[8 + row] * (double)p[2] + m[12 + row];
		for (int j = 0; j < 3 && phong_painted(scene); j++)
			v->paint[j] = clamp(colour[i][j]);
		if (normal)
			transform_normal(v->normal, normal_matrix, normal[i]);
		if (between_planes(v))
			phong_fill_project(frame, v);
	}
	return vertex;
}

static struct phong_vertex between(const struct phong_vertex *a, const struct phong_vertex *b,
				   double t)
{
	struct phong_vertex v = { 0 };

	for (int i = 0; i < 3; i++) {
		v.eye[i] = a->eye[i] + (float)t * (b->eye[i] - a->eye[i]);
		v.normal[i] = a->normal[i] + (float)t * (b->normal[i] - a->normal[i]);
		v.paint[i] = a->paint[i] + (float)t * (b->paint[i] - a->paint[i]);
	}
	for (int i = 0; i < 4; i++)
		v.clip[i] = a->clip[i] + t * (b->clip[i] - a->clip[i]);
	return v;
}

/* Sutherland and Hodgman: keeps the part of the polygon that is inside one plane. */
static int clip(const struct phong_vertex *in, int count, int plane, struct phong_vertex *out)
{
	int kept = 0;

	for (int i = 0; i < count; i++) {
		const struct phong_vertex *a = &in[i], *b = &in[(i + 1) % count];
		double da = inside(a, plane), db = inside(b, plane);

		if (da >= 0)
			out[kept++] = *a;
		if ((da >= 0) != (db >= 0))
			out[kept++] = between(a, b, da / (da - db));
	}
	return kept;
}

static void face_normal(float n[3], const float a[3], const float b[3], const float c[3])
{
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		n[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
	}
}

static void draw_clipped(const struct phong_fill *fill, const struct phong_vertex vertex[3])
{
	struct phong_vertex polygon[5], near[4];
	int count;

	count = clip(vertex, 3, 0, near);
	count = clip(near, count, 1, polygon);
	for (int i = 0; i < count; i++)
		phong_fill_project(fill->frame, &polygon[i]);
	for (int i = 2; i < count; i++)
		phong_fill_triangle(fill, &polygon[0], &polygon[i - 1], &polygon[i]);
}

static void draw_triangle(const struct phong_fill *fill, const struct phong_vertex *a,
			  const struct phong_vertex *b, const struct phong_vertex *c)
{
	bool whole = between_planes(a) && between_planes(b) && between_planes(c);
	struct phong_vertex copy[3];

	if (whole && fill->scene->mesh.normal.data) {
		phong_fill_triangle(fill, a, b, c);
		return;
	}
	copy[0] = *a;
	copy[1] = *b;
	copy[2] = *c;
	for (int i = 0; i < 3 && !fill->scene->mesh.normal.data; i++)
		face_normal(copy[i].normal, a->eye, b->eye, c->eye);
	draw_clipped(fill, copy);
}

/* The mesh's element number @i as a vertex; NULL if it has none of that index. */
static const struct phong_vertex *element(const struct accel_mesh *mesh,
					  const struct phong_vertex *vertex, uint32_t i)
{
	uint32_t index = mesh->index ? mesh->index[i] : i;

	return index < mesh->vertices ? &vertex[index] : NULL;
}

static int draw_mesh(const struct phong_fill *fill, const struct phong_vertex *vertex)
{
	const struct accel_mesh *mesh = &fill->scene->mesh;
	uint32_t elements = mesh->index ? mesh->indices : mesh->vertices;
	uint32_t step = mesh->topology == ACCEL_TOPOLOGY_TRIANGLES ? 3 : 1;

	for (uint32_t i = 0; i + 2 < elements; i += step) {
		uint32_t first = mesh->topology == ACCEL_TOPOLOGY_TRIANGLE_FAN ? 0 : i;
		const struct phong_vertex *a = element(mesh, vertex, first);
		const struct phong_vertex *b = element(mesh, vertex, i + 1);
		const struct phong_vertex *c = element(mesh, vertex, i + 2);

		if (!a || !b || !c)
			return -EINVAL;
		/* Every second triangle of a strip turns the other way. */
		if (mesh->topology == ACCEL_TOPOLOGY_TRIANGLE_STRIP && i % 2)
			draw_triangle(fill, b, a, c);
		else
			draw_triangle(fill, a, b, c);
	}
	return 0;
}

int phong_draw(const struct scene *scene, struct phong_frame *frame)
{
	struct phong_vertex *vertex;
	struct phong_fill fill;
	int ret;

	clear(frame, scene->background);
	vertex = transform(scene, frame);
	if (!vertex)
		return -ENOMEM;
	phong_fill_init(&fill, scene, frame);
	ret = draw_mesh(&fill, vertex);
	free(vertex);
	return ret;
}
