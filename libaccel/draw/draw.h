/* SPDX-License-Identifier: MIT */
/* A draw, for the files that have its calls. */
#ifndef ACCEL_DRAW_DRAW_H
#define ACCEL_DRAW_DRAW_H

#include "draw/slices.h"

/* What the transform and the light of a draw's pass are of: stamps of a state, and the rest. */
struct accel_derived {
	uint64_t geometry, light; /* 0: they are of nothing */
	int width, height;
	bool painted;
};

struct accel_draw {
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_bin bin;
	struct accel_target target;    /* of this frame, a reference to each of its parts */
	bool has_target;               /* a frame was begun */
	struct accel_draw_stats stats; /* of this frame, or the one before */
	struct accel_capture capture;
	struct accel_pass pass; /* of this call; its transform and light are kept for the next */
	struct accel_derived derived;
	struct accel_slices slices; /* of a mesh; memory and threads are kept from mesh to mesh */
};

/* ---- draw.c ---- */

/* -EINVAL, and a message that says what is missing before @what. */
int accel_draw_check_begun(const struct accel_draw *draw, const char *what);
/* Forgets the frame, and what was counted. */
void accel_draw_lose(struct accel_draw *draw);

/* ---- clear.c ---- */

/* A clear as tiles have it; without a bit in its mask if @given is NULL. */
int accel_draw_clear_take(struct accel_draw *draw, const struct accel_clear *given,
			  struct accel_tile_clear *clear);
/* Clears the whole target. After an error the frame is lost. */
int accel_draw_clear_all(struct accel_draw *draw, const struct accel_tile_clear *clear);

#endif
