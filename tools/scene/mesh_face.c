// SPDX-License-Identifier: MIT
/*
 * Triangles are taken in blocks, each of their numbers in an array of its own, so that the
 * compiler makes vectors of them.
 */
#include <float.h>
#include <math.h>

#include "scene/mesh_face.h"

#define BLOCK 32
/* Relative error of quick_angle; it is below 8e-11. */
#define QUICK_ERROR 1e-10

struct block {
	double position[3][3][BLOCK]; /* of corner, axis */
	double cross[3][BLOCK];
	double sine[BLOCK], cosine[BLOCK]; /* of an angle, times the lengths of its sides */
	float low[BLOCK], high[BLOCK];     /* the angle is between them */
};

static void gather(const struct mesh *mesh, uint32_t first, uint32_t count, struct block *block)
{
	for (uint32_t i = 0; i < count; i++)
		for (int corner = 0; corner < 3; corner++) {
			const float *at = mesh->position[mesh->triangle[first + i][corner]];

			for (int axis = 0; axis < 3; axis++)
				block->position[corner][axis][i] = at[axis];
		}
}

/* Sets cross, sine and cosine. */
static void look_at_corner(struct block *block, int corner)
{
	double(*at)[BLOCK] = block->position[corner];
	double(*p)[BLOCK] = block->position[(corner + 1) % 3];
	double(*q)[BLOCK] = block->position[(corner + 2) % 3];

	for (int i = 0; i < BLOCK; i++) {
		double u[3], v[3], n[3];

		for (int j = 0; j < 3; j++) {
			u[j] = p[j][i] - at[j][i];
			v[j] = q[j][i] - at[j][i];
		}
		n[0] = u[1] * v[2] - u[2] * v[1];
		n[1] = u[2] * v[0] - u[0] * v[2];
		n[2] = u[0] * v[1] - u[1] * v[0];
		for (int j = 0; j < 3; j++)
			block->cross[j][i] = n[j];
		block->sine[i] = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
		block->cosine[i] = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
	}
}

/* arctan x / x, 0 <= x <= 1, of x^2: minimax, by mpmath's chebyfit. */
static double arc(double square)
{
	static const double term[] = {
		-0x1.5bcf6e5741041p-11, 0x1.3625e8d6eefb9p-8,  -0x1.0354cc23b8650p-6,
		0x1.151ab904c9279p-5,   -0x1.ba035c4e8d652p-5, 0x1.2811fdeff7003p-4,
		-0x1.6f95036b2d2f5p-4,  0x1.c6533dfc9a77bp-4,  -0x1.2488519fa5a60p-3,
		0x1.999914dc909cfp-3,   -0x1.555553f671b9ap-2, 0x1.ffffffff64898p-1,
	};
	double sum = term[0];

	for (unsigned int i = 1; i < sizeof(term) / sizeof(*term); i++)
		sum = sum * square + term[i];
	return sum;
}

/* atan2(sine, cosine), @sine not negative; not a number if both are 0. */
static double quick_angle(double sine, double cosine)
{
	double side = fabs(cosine);
	double x = (sine < side ? sine : side) / (sine < side ? side : sine);
	double least = x * arc(x * x), rest = M_PI_2 - least;
	double acute = sine < side ? least : rest, obtuse = M_PI - acute;

	return cosine < 0 ? obtuse : acute;
}

static void bound_angles(struct block *block)
{
	for (int i = 0; i < BLOCK; i++) {
		double angle = quick_angle(block->sine[i], block->cosine[i]);

		block->low[i] = (float)(angle * (1 - QUICK_ERROR));
		block->high[i] = (float)(angle * (1 + QUICK_ERROR));
	}
}

/* The angle is what atan2 gives as a float, which is asked where the quick one leaves two. */
static float angle_of(const struct block *block, uint32_t i)
{
	if (block->low[i] == block->high[i])
		return block->low[i];
	return (float)atan2(block->sine[i], block->cosine[i]);
}

static void set_normals(const struct block *block, uint32_t count, struct face *face)
{
	for (uint32_t i = 0; i < count; i++) {
		double length = block->sine[i];

		bool area = length > 0 && length <= DBL_MAX;

		for (int axis = 0; axis < 3; axis++)
			face[i].normal[axis] = area ? (float)(block->cross[axis][i] / length) : 0;
	}
}

void faces_make(const struct mesh *mesh, struct face *face)
{
	struct block block = { 0 };

	for (uint32_t first = 0; first < mesh->triangles; first += BLOCK) {
		uint32_t left = mesh->triangles - first, count = left < BLOCK ? left : BLOCK;

		gather(mesh, first, count, &block);
		for (int corner = 0; corner < 3; corner++) {
			look_at_corner(&block, corner);
			if (!corner)
				set_normals(&block, count, face + first);
			bound_angles(&block);
			for (uint32_t i = 0; i < count; i++)
				face[first + i].angle[corner] = angle_of(&block, i);
		}
	}
}
