// SPDX-License-Identifier: MIT
/* Places between the vertices of a triangle: the middles of its edges, and its own. */

#include "draw/triangle.h"

/* How far from @a and from @b, in space, the point is that is halfway on the screen. */
static void patch_halfway(const struct accel_vertex *a, const struct accel_vertex *b, float *of_a,
			  float *of_b)
{
	double sum = 1 / ((double)a->w + (double)b->w);

	*of_a = (float)((double)b->w * sum);
	*of_b = (float)((double)a->w * sum);
}

void accel_patch_middle(const struct accel_vertex *a, const struct accel_vertex *b,
			struct accel_vertex *middle)
{
	float s, t;

	patch_halfway(a, b, &s, &t);
	middle->x = (a->x + b->x) / 2;
	middle->y = (a->y + b->y) / 2;
	middle->w = s * a->w + t * b->w;
	middle->z = (a->z + b->z) / 2;
	middle->outside = 0;
	middle->level = (a->level > b->level ? a->level : b->level) + 1;
	middle->sampled = 0;
	middle->sample = (struct accel_sample){ 0 };
	middle->length = s * a->length + t * b->length;
	for (int i = 0; i < 3; i++) {
		middle->eye[i] = s * a->eye[i] + t * b->eye[i];
		middle->normal[i] = s * a->normal[i] + t * b->normal[i];
	}
	for (int i = 0; i < 4; i++) {
		middle->sample.colour[i] = s * a->sample.colour[i] + t * b->sample.colour[i];
		middle->paint[i] = s * a->paint[i] + t * b->paint[i];
	}
}

bool accel_patch_divisible(const struct accel_vertex *a, const struct accel_vertex *b)
{
	return a->level < ACCEL_SPLIT_LEVELS && b->level < ACCEL_SPLIT_LEVELS;
}

bool accel_patch_curved(const struct accel_patch *patch)
{
	return patch->edge[0]->curved || patch->edge[1]->curved || patch->edge[2]->curved;
}

/* The point that has so much of each corner in space, in proportion. */
static void patch_blend(const struct accel_vertex *const corner[3], const float weight[3],
			struct accel_vertex *vertex)
{
	const float sum = weight[0] + weight[1] + weight[2];

	*vertex = (struct accel_vertex){ .w = 1 };
	for (int i = 0; i < 3; i++) {
		float part = weight[i] / sum;

		vertex->length += part * corner[i]->length;
		for (int j = 0; j < 3; j++) {
			vertex->eye[j] += part * corner[i]->eye[j];
			vertex->normal[j] += part * corner[i]->normal[j];
		}
		for (int j = 0; j < 4; j++) {
			vertex->sample.colour[j] += part * corner[i]->sample.colour[j];
			vertex->paint[j] += part * corner[i]->paint[j];
		}
	}
}

void accel_patch_centre(const struct accel_patch *patch, struct accel_vertex *vertex)
{
	float weight[3];

	for (int i = 0; i < 3; i++)
		weight[i] = 1 / patch->vertex[i]->w;
	patch_blend(patch->vertex, weight, vertex);
}

void accel_patch_surface_centre(const struct accel_patch *patch, float colour[3])
{
	for (int i = 0; i < 3; i++)
		colour[i] = (4 * (patch->edge[0]->colour[i] + patch->edge[1]->colour[i] +
				  patch->edge[2]->colour[i]) -
			     (patch->vertex[0]->sample.colour[i] +
			      patch->vertex[1]->sample.colour[i] +
			      patch->vertex[2]->sample.colour[i])) /
			    9;
}
