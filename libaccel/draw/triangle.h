/* SPDX-License-Identifier: MIT */
/* A triangle that is not split any more: its surfaces in fixed point, and the packets it becomes. */
#ifndef ACCEL_DRAW_TRIANGLE_H
#define ACCEL_DRAW_TRIANGLE_H

#include "draw/draw_priv.h"

/* ---- surface.c ---- */

/* As in the packet: value, first and second differences, s10.22. */
struct accel_surface {
	uint32_t i, dx, dy, dxx, dxy, dyy;
};

/* What a narrow plane reaches, in depth steps, anywhere a tile may ask for it: s26. */
#define ACCEL_NARROW_DEPTH 0x1p25
#define ACCEL_NARROW_REACH 128

/* s28.12 at pixel (x, y) of the target. */
struct accel_depth_plane {
	int x, y;
	int64_t z, dx, dy;
	bool narrow; /* rounded to, and fits, depth_compact */
};

/* The place of the unit triangle (0,0) (1,0) (0,1) on screen: u and v at the anchor, and slopes. */
struct accel_basis {
	int x, y; /* the anchor's pixel */
	double u, v, ux, uy, vx, vy;
};

/* What TRIANGLE_SMALL has of a triangle. */
struct accel_small {
	bool fits; /* its coefficients are rounded for it, until then: it is small enough */
	int x0, y0, x1, y1;   /* its pixels; x1 and y1 are outside */
	int anchor_x;         /* with y0: where it is rounded */
	uint32_t depth_scale; /* of its plane */
};

struct accel_triangle {
	struct accel_setup setup;
	struct accel_small small;
	const struct accel_depth_plane *plane;
	int x, y; /* pixel the surfaces hold at */
	enum gloss_shading shading;
	bool alpha_linear;
	struct accel_surface channel[4];
	uint8_t constant[4]; /* instead of surfaces */
};

/* Twice the signed area of a triangle on screen, positive if it runs clockwise (y down). */
int64_t accel_surface_area(const struct accel_vertex *a, const struct accel_vertex *b,
			   const struct accel_vertex *c);
void accel_surface_basis(struct accel_basis *basis, const struct accel_vertex *const vertex[3]);
/* @depth: of the vertices. @narrow: the triangle is, so that the plane may be rounded to
 * depth_compact. */
void accel_surface_plane(struct accel_depth_plane *plane, const struct accel_basis *basis,
			 const double depth[3], bool narrow);
/* The same, and accel_small_plane, of triangle @i in a batch (kernel.h) whose plane is narrow. */
void accel_surface_plane_of(struct accel_depth_plane *plane, const struct accel_fit_batch *batch,
			    int i);
/* accel_surface_basis of it. */
void accel_surface_basis_of(const struct accel_fit_batch *batch, int i, struct accel_basis *basis);
/* As accel_surface_patch, of patch @i in a batch that has been fitted. */
void accel_surface_fitted(struct accel_triangle *triangle, const struct accel_fit_batch *batch,
			  int i, const struct accel_patch *patch);
/* The surfaces of triangle @i, which has few pixels. */
void accel_surface_few(struct accel_triangle *triangle, const struct accel_fit_batch *batch, int i);
/* Surfaces through the patch's samples: flat, linear or second order, as it needs. */
void accel_surface_patch(struct accel_triangle *triangle, const struct accel_basis *basis,
			 const struct accel_patch *patch);
/* A linear surface through the vertices' colours clamped to 0..1; flat if they are equal. */
void accel_surface_gouraud(struct accel_triangle *triangle, const struct accel_basis *basis,
			   const struct accel_vertex *const vertex[3]);
void accel_surface_flat(struct accel_triangle *triangle, const float colour[4]);

#define ACCEL_RECORD_WORDS 40

/* ---- small.c ---- */

/* Pixels a side of the largest triangle that is small. */
#define ACCEL_SMALL_SIZE 16

void accel_small_init(struct accel_small *small, const struct accel_setup *setup);
/* Rounds the plane of a triangle that is small enough, for it and for all parts of it. */
void accel_small_plane(struct accel_depth_plane *plane);
/*
 * Triangle @i of a batch (kernel.h) that is to be rounded, but for its surfaces. These are in the
 * batch, if it was fitted, or come from a triangle.
 */
void accel_small_put(struct accel_leaf_batch *batch, int i, const struct accel_small *small,
		     const struct accel_setup *setup, const struct accel_depth_plane *plane);
void accel_small_surface(struct accel_leaf_batch *batch, int i,
			 const struct accel_triangle *triangle);
/*
 * Then, its rounded surfaces, if it is small enough and no colour changes by more than a quarter of
 * a level; else clears small.fits and changes nothing.
 */
void accel_small_take(const struct accel_leaf_batch *batch, int i, struct accel_triangle *triangle);
/* Its record where it is in one tile; returns the words. */
uint32_t accel_small_words(const struct accel_leaf_batch *batch, int i,
			   const struct accel_setup *setup, uint32_t words[ACCEL_RECORD_WORDS]);

/* ---- record.c ---- */

/* Where a record goes, in pixels of the target. */
struct accel_place {
	int x, y, tile_size; /* the tile */
	int first, end;      /* rows to draw */
	bool covering;
	const struct accel_row *row; /* of row @first */
};

/* The column, of the target, at which a record's coefficients hold. */
int accel_record_anchor_x(const struct accel_place *place);
/* A surface moved by (u, v); the core's arithmetic wraps, and so does this. */
void accel_record_surface_at(const struct accel_surface *surface, uint32_t u, uint32_t v,
			     struct accel_surface *moved);
/* Packs colour_flat; returns its words. */
uint32_t accel_record_flat(uint32_t *words, const uint8_t constant[4]);
/* Packs the triangle's record for a tile; returns its words. */
uint32_t accel_record_pack(uint32_t words[ACCEL_RECORD_WORDS],
			   const struct accel_triangle *triangle, const struct accel_place *place);
/* A record that fills a tile with a colour (as a colour surface's word) and a depth. */
uint32_t accel_record_fill(uint32_t words[ACCEL_RECORD_WORDS], uint32_t colour, uint32_t depth);

/* ---- record_small.c ---- */

/* Packs a triangle whose small.fits; 0: at this place it does not. */
uint32_t accel_record_small(uint32_t words[ACCEL_RECORD_WORDS],
			    const struct accel_triangle *triangle, const struct accel_place *place);

#endif
