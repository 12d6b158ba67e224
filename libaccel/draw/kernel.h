/* SPDX-License-Identifier: MIT */
/*
 * The loops that work on ACCEL_BATCH vertices, points or edges at a time, each number in an array
 * of its own so that they become vector code. They are compiled once for every set of instructions
 * (kernel_*.c, all from the *_loop.h) and give the same bits in each: every operation rounds by
 * itself and in the order in which it is written, none is fused, none approximate.
 */
#ifndef ACCEL_DRAW_KERNEL_H
#define ACCEL_DRAW_KERNEL_H

#include "draw/triangle.h"

/* Enough that a call costs nothing, and what it works on fits into a first-level cache. */
#define ACCEL_BATCH 128

/* ---- fetch.c ---- */

/* As accel_fetch_element, @components of @count elements, each component in an array. */
void accel_fetch_batch(const struct accel_fetch *fetch, const uint32_t *number, int count,
		       int components, float (*out)[ACCEL_BATCH]);

/* ---- geometry_loop.h ---- */

struct accel_vertex_batch {
	/* Of the arrays; across: normals. */
	float position[4][ACCEL_BATCH], across[3][ACCEL_BATCH], paint[4][ACCEL_BATCH];
	/* The rest is as in accel_vertex. What has ACCEL_OUTSIDE_CLIP bits has any x, y, w, z. */
	double z[ACCEL_BATCH];
	int32_t x[ACCEL_BATCH], y[ACCEL_BATCH];
	float w[ACCEL_BATCH], eye[3][ACCEL_BATCH], normal[3][ACCEL_BATCH], length[ACCEL_BATCH];
	uint32_t outside[ACCEL_BATCH];
	uint32_t finite[ACCEL_BATCH]; /* 0: something is too large for a float, or no number */
};

/* ---- lighting_loop.h ---- */

struct accel_light_batch {
	/* Of points, as in accel_vertex. */
	float eye[3][ACCEL_BATCH], normal[3][ACCEL_BATCH], length[ACCEL_BATCH];
	float paint[4][ACCEL_BATCH];
	/* Their light, as in accel_sample. */
	float colour[4][ACCEL_BATCH], shine[ACCEL_BATCH], near[ACCEL_BATCH], near_lamp[ACCEL_BATCH];
	uint32_t facing[ACCEL_BATCH], in_cone[ACCEL_BATCH];
	/* Of the loops: directions, what the length makes of a highlight, paint as it is taken. */
	float unit[3][ACCEL_BATCH], viewer[3][ACCEL_BATCH], gloss[ACCEL_BATCH];
	float ambient[3][ACCEL_BATCH], diffuse[3][ACCEL_BATCH], specular[3][ACCEL_BATCH];
};

/* ---- edge_loop.h ---- */

struct accel_edge_batch {
	/* Of both ends, as in accel_vertex and its sample; lights: those of facing and in_cone. */
	int32_t x[2][ACCEL_BATCH], y[2][ACCEL_BATCH];
	float w[2][ACCEL_BATCH], eye[2][3][ACCEL_BATCH], normal[2][3][ACCEL_BATCH];
	float colour[2][3][ACCEL_BATCH], shine[2][ACCEL_BATCH];
	float near[2][ACCEL_BATCH], near_lamp[2][ACCEL_BATCH];
	uint32_t lights[2][ACCEL_BATCH];
	/* What they tell. */
	float spread[ACCEL_BATCH]; /* angle of the normals and of what moves, squared */
	float lamp[ACCEL_BATCH];   /* angle at which a lamp sees the edge, squared */
	float length[ACCEL_BATCH]; /* on the screen, squared, pixels */
	float most_shine[ACCEL_BATCH];
	float bend[ACCEL_BATCH];    /* bound of the middle's distance from the straight line */
	uint32_t even[ACCEL_BATCH]; /* have both ends the same lights? */
};

/* ---- pixel_loop.h ---- */

struct accel_pixel_batch {
	int32_t pixel[2][ACCEL_BATCH]; /* x, y; the triangle has not more than a few rows */
	/* Of its corners, as in accel_vertex. */
	int32_t x[3][ACCEL_BATCH], y[3][ACCEL_BATCH];
	float w[3][ACCEL_BATCH], eye[3][3][ACCEL_BATCH], normal[3][3][ACCEL_BATCH];
	float length[3][ACCEL_BATCH], paint[3][4][ACCEL_BATCH];
	struct accel_light_batch light; /* of the point, that is ready to be lit */
};

/* ---- setup_loop.h ---- */

/* As struct accel_line, and struct accel_row. */
struct accel_line_batch {
	int32_t row[ACCEL_BATCH], x[ACCEL_BATCH];
	uint32_t r[ACCEL_BATCH];
	int32_t dx[ACCEL_BATCH], dy[ACCEL_BATCH], step[ACCEL_BATCH];
	uint32_t m[ACCEL_BATCH];
};

struct accel_row_batch {
	int32_t left[ACCEL_BATCH], right[ACCEL_BATCH];
};

struct accel_setup_batch {
	int32_t x[3][ACCEL_BATCH], y[3][ACCEL_BATCH]; /* of triangles that have an area */
	/* The rest is as in accel_setup. */
	int32_t first[ACCEL_BATCH], turn[ACCEL_BATCH], end[ACCEL_BATCH];
	uint32_t right_turns[ACCEL_BATCH], narrow[ACCEL_BATCH];
	uint32_t covers[ACCEL_BATCH]; /* is a pixel of the first rows visible? */
	/* Of these rows: as in accel_setup. */
	int32_t x0[ACCEL_BATCH], y0[ACCEL_BATCH], x1[ACCEL_BATCH], y1[ACCEL_BATCH];
	int32_t start[ACCEL_BATCH], pixels[ACCEL_BATCH];
	struct accel_line_batch left, right, middle;
	struct accel_row_batch row[ACCEL_LOOP_ROWS];
	int32_t at[2][ACCEL_BATCH], at_r[2][ACCEL_BATCH]; /* of the loops */
};

/* ---- fit_loop.h ---- */

/* As struct accel_surface. */
struct accel_surface_batch {
	int32_t i[ACCEL_BATCH], dx[ACCEL_BATCH], dy[ACCEL_BATCH];
	int32_t dxx[ACCEL_BATCH], dxy[ACCEL_BATCH], dyy[ACCEL_BATCH];
};

struct accel_fit_batch {
	int32_t x[3][ACCEL_BATCH], y[3][ACCEL_BATCH]; /* of triangles that have an area */
	float colour[6][3][ACCEL_BATCH];              /* of vertices, and of the edges after them */
	float alpha[3][ACCEL_BATCH];                  /* of vertices */
	uint32_t curved[ACCEL_BATCH];                 /* is the surface of second order? 0 or 1 */
	double z[3][ACCEL_BATCH];                     /* of vertices */
	uint32_t small[ACCEL_BATCH];   /* is the plane to be rounded for a small record? 0 or 1 */
	uint32_t narrow[ACCEL_BATCH];  /* may it be? 0 or 1; in the end: it is, and is here: */
	int32_t depth[3][ACCEL_BATCH]; /* z, dx, dy in units of GLOSS_DEPTH_COMPACT_SHIFT */
	/* As accel_basis; at_x, at_y are its x and y. */
	int32_t at_x[ACCEL_BATCH], at_y[ACCEL_BATCH];
	double u[ACCEL_BATCH], v[ACCEL_BATCH], ux[ACCEL_BATCH], uy[ACCEL_BATCH];
	double vx[ACCEL_BATCH], vy[ACCEL_BATCH];
	uint32_t flat[ACCEL_BATCH]; /* does it not vary by a step? */
	float flat_colour[3][ACCEL_BATCH];
	uint32_t fits[ACCEL_BATCH];            /* are all numbers of its surfaces small enough? */
	struct accel_surface_batch surface[4]; /* the last is alpha's, and of few_loop.h only */
	uint32_t form[ACCEL_BATCH];            /* enum gloss_shading */
	uint32_t level[4][ACCEL_BATCH]; /* of a flat triangle, and of an alpha that is even */
	uint32_t even[ACCEL_BATCH];     /* have all vertices, or pixels, the same alpha? */
};

/* ---- few_loop.h ---- */

/* As struct accel_few: the colours of the first pixel and of the last, and the way from it. */
struct accel_few_batch {
	float colour[2][4][ACCEL_BATCH];
	int32_t x[ACCEL_BATCH], y[ACCEL_BATCH];
};

/* ---- small_loop.h ---- */

/* Words of a small record before those of rows. */
#define ACCEL_SMALL_WORDS 11

struct accel_leaf_batch {
	/* Of it at_x, at_y, surface, form and level, in the end at the triangle's own anchor. */
	struct accel_fit_batch fit;
	/* ~0: the triangle is small enough; in the end: it is rounded, and packed. Else 0. */
	uint32_t fits[ACCEL_BATCH];
	/* As in accel_small, all 0 of a triangle that is not small. */
	int32_t x0[ACCEL_BATCH], y0[ACCEL_BATCH], x1[ACCEL_BATCH], y1[ACCEL_BATCH];
	int32_t anchor_x[ACCEL_BATCH];
	uint32_t head[ACCEL_BATCH]; /* rows in pixels_small */
	/* As in accel_depth_plane, but in units of GLOSS_SMALL_DEPTH_SHIFT. */
	int32_t depth_x[ACCEL_BATCH], depth_y[ACCEL_BATCH];
	int32_t depth_z[ACCEL_BATCH], depth_dx[ACCEL_BATCH], depth_dy[ACCEL_BATCH];
	uint32_t depth_scale[ACCEL_BATCH];
	/* The record, in the tile that its first pixel is in, and how many words; rows follow them. */
	uint32_t word[ACCEL_SMALL_WORDS][ACCEL_BATCH];
	uint32_t words[ACCEL_BATCH];
};

/* ---- the loops, as one set of instructions has them ---- */

struct accel_kernel {
	const char *name;
	bool (*runs)(void); /* has this processor the instructions? */
	/*
	 * The first @count vertices of @batch, and their paint may be limited. Without @normals,
	 * across and normal are left alone, and length is 1.
	 */
	void (*transform)(const struct accel_transform *transform, struct accel_vertex_batch *batch,
			  int count, bool normals);
	/* The light of @count points, and what one lamp alone adds to their colours. */
	void (*light)(const struct accel_lighting *lighting, int side,
		      struct accel_light_batch *batch, int count);
	void (*light_lamp)(const struct accel_lighting *lighting, const struct accel_lamp *lamp,
			   int side, struct accel_light_batch *batch, int count);
	/* What the ends of @count lit edges tell. */
	void (*edge)(const struct accel_lighting *lighting, int side,
		     struct accel_edge_batch *batch, int count);
	/* Places of @count pixels on their triangles, in the middle in space as on the screen. */
	void (*pixel)(struct accel_pixel_batch *batch, int count);
	/* The bases of @count triangles, and their depth planes; or their surfaces. */
	void (*plane)(struct accel_fit_batch *batch, int count);
	void (*fit)(struct accel_fit_batch *batch, int count);
	/* The same of triangles of few pixels, @first to @end - 1; at_x and at_y stay. */
	void (*few)(const struct accel_few_batch *few, struct accel_fit_batch *batch, int first,
		    int end);
	/* Rounds and packs those of @count triangles that are small; @tile_size is a power of two. */
	void (*small)(struct accel_leaf_batch *batch, int count, int tile_size);
	/* The edges of @count triangles, and up to ACCEL_LOOP_ROWS rows. */
	void (*setup)(struct accel_setup_batch *batch, int count,
		      const struct accel_bounds *visible);
};

/* From the plainest on; NULL ends them. */
extern const struct accel_kernel *const accel_kernels[];
extern const struct accel_kernel accel_kernel_baseline, accel_kernel_avx2, accel_kernel_avx512;

/* The last that runs here, or the one that tests set. Any thread may call it. */
const struct accel_kernel *accel_kernel(void);
/* For tests: NULL is the choice of the library again. */
void accel_kernel_set(const struct accel_kernel *kernel);

#endif
