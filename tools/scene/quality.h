/* SPDX-License-Identifier: MIT */
/* How far a picture is from the per-pixel reference. */
#ifndef TOOLS_QUALITY_H
#define TOOLS_QUALITY_H

#include "scene/phong.h"

/* Sums, so that pictures can be taken together. */
struct quality {
	double error, reference; /* sums of squares over covered pixels, all channels */
	double worst;            /* greatest difference of a channel, in steps of 8 bits */
	int worst_x, worst_y;
	uint64_t pixels; /* covered by both */
	uint64_t stray;  /* covered by one of them */
};

/*
 * Adds a picture of the size of @frame, which must have light. @colour and @depth are as
 * accel_target_read gives them, without gaps between rows.
 */
void quality_add(struct quality *quality, const struct phong_frame *frame, const uint32_t *colour,
		 const uint32_t *depth);

/* The normalised mean square error: error over reference; 0 for no pixels. */
double quality_nmse(const struct quality *quality);

#endif
