/* SPDX-License-Identifier: MIT */
/* Scenes that the library draws on the model and the oracle works out, and how far they differ. */
#ifndef SCENE_H
#define SCENE_H

#include "accel_test.h"
#include "oracle.h"

#define SCENE_SIDE 96
#define SCENE_PIXELS (SCENE_SIDE * SCENE_SIDE)
#define SCENE_VERTICES 16

/* What a program says: whole floats, so that both sides have the same numbers. */
struct scene {
	struct oracle_state gl;
	enum oracle_topology topology;
	struct oracle_vertex vertex[SCENE_VERTICES];
	int vertices;
};

/* What the library made of it: rows from the bottom, as the oracle's. */
struct drawing {
	uint32_t colour[SCENE_PIXELS], depth[SCENE_PIXELS];
};

struct board {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct accel_state *state;
};

/*
 * How far a drawing is off. Colours are of 255. Depths are steps of 2^24 - 1 beyond what the library
 * may be off: 3, and as much as the depth changes along 1/64 pixel, for records of small triangles
 * have its slopes in 15 bits.
 */
struct difference {
	int covered;          /* pixels that either draws */
	int coverage;         /* of them those that the other does not */
	int compared;         /* well inside of a polygon: colours are compared there */
	double colour, depth; /* most of any channel */
	int x, y;             /* where the colour is farthest off, from the bottom */
	double mean;          /* of all channels compared */
};

/* A board for all tests of a program, and its end. */
int scene_setup(void **state);
int scene_teardown(void **state);

/* The states of a new context, without depth test but with depths written from 0.125 to 0.875. */
void scene_init(struct scene *scene, enum oracle_topology topology);
/* Appends a vertex, whose normal is z and whose colour is white. */
struct oracle_vertex *scene_vertex(struct scene *scene, double x, double y, double z);

void scene_draw(struct board *board, const struct scene *scene, enum accel_shading shading,
		struct drawing *drawing);
/* Into a picture that lasts until the next call. */
const struct oracle_picture *scene_work_out(const struct scene *scene);
/* Colours are compared where the centre of a pixel is @inside pixels from all edges. */
struct difference scene_compare(const struct drawing *drawing, const struct oracle_picture *picture,
				double inside);

/* Draws with Gouraud shading and fails unless coverage is exact, depths are as near as
 * scene_compare says and colours of all pixels within @steps of 255; at least @least pixels have to be compared. */
void scene_assert(struct board *board, const struct scene *scene, double steps, int least);

#endif
