/* SPDX-License-Identifier: MIT */
/* Points of triangles at the centres of pixels; a part of kernel_loops.h. */
#include <math.h>

#include "draw/kernel.h"
#include "draw/loop.h"

/* How much of a corner there is, on the screen: twice the area that the point and the others span. */
LOOP_INLINE float loop_weight(const struct accel_pixel_batch *batch, int i, int b, int c)
{
	const int32_t x = batch->pixel[0][i] * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF;
	const int32_t y = batch->pixel[1][i] * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF;
	double bx = batch->x[b][i] - x, by = batch->y[b][i] - y;
	double cx = batch->x[c][i] - x, cy = batch->y[c][i] - y;

	return fabsf((float)(bx * cy - cx * by));
}

LOOP_INLINE float loop_blend(const float part[3], float a, float b, float c)
{
	float sum = 0;

	sum += part[0] * a;
	sum += part[1] * b;
	sum += part[2] * c;
	return sum;
}

static void loop_pixel(struct accel_pixel_batch *batch, int count)
{
	for (int i = 0; i < count; i++) {
		float weight[3] = { loop_weight(batch, i, 1, 2) / batch->w[0][i],
				    loop_weight(batch, i, 2, 0) / batch->w[1][i],
				    loop_weight(batch, i, 0, 1) / batch->w[2][i] };
		float sum = weight[0] + weight[1] + weight[2];
		const float part[3] = { weight[0] / sum, weight[1] / sum, weight[2] / sum };

		batch->light.length[i] = loop_blend(part, batch->length[0][i], batch->length[1][i],
						    batch->length[2][i]);
#pragma GCC unroll 4
		for (int j = 0; j < 3; j++) {
			batch->light.eye[j][i] = loop_blend(part, batch->eye[0][j][i],
							    batch->eye[1][j][i],
							    batch->eye[2][j][i]);
			batch->light.normal[j][i] = loop_blend(part, batch->normal[0][j][i],
							       batch->normal[1][j][i],
							       batch->normal[2][j][i]);
		}
#pragma GCC unroll 4
		for (int j = 0; j < 4; j++)
			batch->light.paint[j][i] = loop_blend(part, batch->paint[0][j][i],
							      batch->paint[1][j][i],
							      batch->paint[2][j][i]);
	}
}
