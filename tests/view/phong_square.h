/* SPDX-License-Identifier: MIT */
/* A square that fills a picture, as the reference draws it. */
#ifndef TESTS_VIEW_PHONG_SQUARE_H
#define TESTS_VIEW_PHONG_SQUARE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/matrix.h"
#include "scene/mesh.h"
#include "scene/phong.h"

#define SIZE 64

static inline void assert_close(double a, double b, double tolerance)
{
	if (fabs(a - b) > tolerance)
		fail_msg("%g is not %g", a, b);
}

/* A square of side 2 in the plane z = 0, in two triangles, with one normal. */
static const float square[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
static const uint32_t square_index[6] = { 0, 1, 2, 0, 2, 3 };

struct fixture {
	struct scene scene;
	struct phong_frame frame;
	float normal[4][3];
};

/* The square fills the picture, without perspective. */
static inline int setup(void **state)
{
	struct fixture *f = calloc(1, sizeof(*f));

	scene_init(&f->scene, SIZE, SIZE);
	for (int i = 0; i < 4; i++)
		f->normal[i][2] = 1;
	f->scene.mesh = (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						      .vertices = 4, .position = { .data = square },
						      .normal = { .data = f->normal }, .indices = 6,
						      .index = square_index);
	f->scene.local_viewer = false;
	*state = f;
	return phong_frame_new(&f->scene, true, &f->frame);
}

static inline int teardown(void **state)
{
	struct fixture *f = *state;

	phong_frame_free(&f->frame);
	free(f);
	return 0;
}

static inline const float *light_at(const struct fixture *f, int x, int y)
{
	return f->frame.light[y * SIZE + x];
}

static inline unsigned int covered(const struct phong_frame *frame)
{
	unsigned int pixels = 0;

	for (size_t i = 0; i < (size_t)frame->width * frame->height; i++)
		pixels += phong_covered(frame, i);
	return pixels;
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
