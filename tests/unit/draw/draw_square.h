/* SPDX-License-Identifier: MIT */
/*
 * A square over the whole view, its positions NDC, which a test draws on the model with whatever it
 * changes of mesh and state. Every stream that is sent, of frames and of transfers, is one that
 * gloss-decode reads: link with --wrap=accel_engine_submit.
 */
#ifndef DRAW_SQUARE_H
#define DRAW_SQUARE_H

#include "draw_fixture.h"

#define SIDE 96
#define WHITE 0xffffffffu
#define RED 0xff0000ffu
#define GREEN 0xff00ff00u

/* What was read back. */
extern uint32_t pixels[SIDE * SIDE], others[SIDE * SIDE];

extern const float black[4];
extern const float square[4][3];

/* A frame of @pixels is begun; fixture_free ends it. */
int square_setup(void **state);

#define square_test(name) cmocka_unit_test_setup_teardown(name, square_setup, fixture_free)

/* Two triangles, counter-clockwise. */
struct accel_mesh square_mesh(void);
int mesh_draw(struct fixture *f, const struct accel_mesh *mesh);
/* Clears, draws and reads the colours. */
void picture(struct fixture *f, const struct accel_mesh *mesh, uint32_t *colour);
/* All of pixels. */
void assert_all(uint32_t wanted);
struct accel_draw_stats stats_of(const struct fixture *f);

#endif
