// SPDX-License-Identifier: MIT
#include <math.h>

#include "scene/quality.h"

#define DEPTH_CLEAR 0xffffffu

static void add_pixel(struct quality *quality, const float light[3], uint32_t colour, int x, int y)
{
	for (int channel = 0; channel < 3; channel++) {
		double wanted = fmin(fmax(light[channel], 0), 1);
		double drawn = (colour >> 8 * channel & 0xff) / 255.0;
		double difference = fabs(drawn - wanted);

		quality->error += difference * difference;
		quality->reference += wanted * wanted;
		if (difference * 255 > quality->worst) {
			quality->worst = difference * 255;
			quality->worst_x = x;
			quality->worst_y = y;
		}
	}
}

void quality_add(struct quality *quality, const struct phong_frame *frame, const uint32_t *colour,
		 const uint32_t *depth)
{
	size_t i = 0;

	for (int y = 0; y < frame->height; y++) {
		for (int x = 0; x < frame->width; x++, i++) {
			bool drawn = (depth[i] & DEPTH_CLEAR) != DEPTH_CLEAR;

			if (drawn && phong_covered(frame, i)) {
				add_pixel(quality, frame->light[i], colour[i], x, y);
				quality->pixels++;
			} else if (drawn || phong_covered(frame, i)) {
				quality->stray++;
			}
		}
	}
}

double quality_nmse(const struct quality *quality)
{
	return quality->reference > 0 ? quality->error / quality->reference : 0;
}
