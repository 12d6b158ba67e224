/* SPDX-License-Identifier: MIT */
/* What is sent of triangles of one or two pixels; a part of kernel_loops.h. Why is in few.c. */
#include "draw/kernel.h"
#include "draw/loop.h"

/* As a pixel has it. */
LOOP_INLINE uint32_t loop_few_level(float colour)
{
	return (uint32_t)(int32_t)(loop_choose(colour < 1, colour, 1) * 255 + 0.5f);
}

/* s10.22 of a difference of steps; to be taken as the integers of a record are. */
LOOP_INLINE int32_t loop_few_fixed(float steps)
{
	float scaled = steps * (1 << GLOSS_COLOUR_FRACTION);
	float away = loop_choose(scaled < 0, -0.5f, 0.5f);

	return (int32_t)(scaled + away);
}

/* From the first pixel's colour to the last's; flat: 0. */
LOOP_INLINE void loop_few_linear(const struct accel_few_batch *few, int i, int channel, bool flat,
				 struct accel_surface_batch *out)
{
	const float x = (float)few->x[i], y = (float)few->y[i];
	float a = few->colour[0][channel][i], b = few->colour[1][channel][i], step;

	a = loop_choose(a < 1, a, 1);
	b = loop_choose(b < 1, b, 1);
	step = loop_choose(flat, 0, 255 * (b - a) / (x * x + y * y));
	out->i[i] = loop_few_fixed(loop_choose(flat, 0, 255 * a + 0.5f));
	out->dx[i] = loop_few_fixed(step * x);
	out->dy[i] = loop_few_fixed(step * y);
	out->dxx[i] = out->dxy[i] = out->dyy[i] = 0;
}

static void loop_few(const struct accel_few_batch *few, struct accel_fit_batch *batch, int first,
		     int end)
{
	for (int i = first; i < end; i++) {
		uint32_t other = 0;

#pragma GCC unroll 4
		for (int j = 0; j < 4; j++) {
			batch->level[j][i] = loop_few_level(few->colour[0][j][i]);
			other |= batch->level[j][i] ^ loop_few_level(few->colour[1][j][i]);
		}
		batch->even[i] = batch->level[3][i] == loop_few_level(few->colour[1][3][i]);
		batch->form[i] = GLOSS_SHADING_LINEAR & loop_mask(other != 0);
	}
	for (int channel = 0; channel < 4; channel++)
		for (int i = first; i < end; i++)
			loop_few_linear(few, i, channel, batch->form[i] == GLOSS_SHADING_FLAT,
					&batch->surface[channel]);
}
