// SPDX-License-Identifier: MIT
/*
 * Colours and depth to fixed point. They are rounded once a triangle, at a pixel in its middle;
 * record.c moves them from there in integers, so no picture depends on where tiles begin.
 *
 * The second-order surface is SH-QSURF (Romaniuk 2009, ch. 3) through the colours of the vertices
 * and edge midpoints, in the coordinates u, v of the triangle (0,0) (1,0) (0,1).
 */
#include <math.h>
#include <string.h>

#include "draw/kernel.h"

#define CHANNELS 4
/*
 * Steps a pixel, of depth and of a channel, and a pixel squared. What is steeper is a sliver that
 * covers next to nothing; up to here 64 bits hold the values of a surface all over its target.
 */
#define DEPTH_SLOPE_MAX 0x1p36
#define SLOPE_MAX 0x1p26
#define CURVATURE_MAX 0x1p16

int64_t accel_surface_area(const struct accel_vertex *a, const struct accel_vertex *b,
			   const struct accel_vertex *c)
{
	return (int64_t)(b->x - a->x) * (c->y - a->y) - (int64_t)(c->x - a->x) * (b->y - a->y);
}

static int32_t surface_middle_of(int32_t a, int32_t b, int32_t c)
{
	int32_t low = number_min(a, b), high = number_max(a, b);

	low = number_min(low, c);
	high = number_max(high, c);
	return (low + high) >> (ACCEL_WINDOW_BITS + 1);
}

void accel_surface_basis(struct accel_basis *basis, const struct accel_vertex *const vertex[3])
{
	const struct accel_vertex *a = vertex[0], *b = vertex[1], *c = vertex[2];
	double one = ACCEL_WINDOW_ONE, half = one / 2;
	double inverse = 1 / (double)accel_surface_area(a, b, c);
	double x, y;

	basis->x = surface_middle_of(a->x, b->x, c->x);
	basis->y = surface_middle_of(a->y, b->y, c->y);
	/* From vertex a to the pixel's centre. */
	x = basis->x * one + half - a->x;
	y = basis->y * one + half - a->y;
	basis->u = (x * (c->y - a->y) - y * (c->x - a->x)) * inverse;
	basis->v = (y * (b->x - a->x) - x * (b->y - a->y)) * inverse;
	basis->ux = (c->y - a->y) * one * inverse;
	basis->uy = (a->x - c->x) * one * inverse;
	basis->vx = (a->y - b->y) * one * inverse;
	basis->vy = (b->x - a->x) * one * inverse;
}

/* Rounds to @bits fraction bits. */
static int64_t surface_fixed(double value, unsigned int bits)
{
	double scaled = value * (double)(1u << bits);

	return (int64_t)(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

/* s10.22; the core drops the high bits too. */
static uint32_t surface_fixed_colour(double value)
{
	return (uint32_t)surface_fixed(value, GLOSS_COLOUR_FRACTION);
}

void accel_surface_plane(struct accel_depth_plane *plane, const struct accel_basis *basis,
			 const double depth[3], bool narrow)
{
	double z = depth[0] * ACCEL_DEPTH_MAX, du = depth[1] * ACCEL_DEPTH_MAX - z;
	double dv = depth[2] * ACCEL_DEPTH_MAX - z;
	double dx = du * basis->ux + dv * basis->vx, dy = du * basis->uy + dv * basis->vy;
	unsigned int bits = GLOSS_DEPTH_FRACTION, shift = 0;

	plane->x = basis->x;
	plane->y = basis->y;
	if (fabs(dx) < DEPTH_SLOPE_MAX && fabs(dy) < DEPTH_SLOPE_MAX) {
		z += du * basis->u + dv * basis->v;
	} else {
		z += (du + dv) / 3;
		dx = dy = 0;
	}
	z += 0.5;
	plane->narrow = narrow &&
			fabs(z) + ACCEL_NARROW_REACH * (fabs(dx) + fabs(dy)) < ACCEL_NARROW_DEPTH;
	if (plane->narrow)
		shift = GLOSS_DEPTH_COMPACT_SHIFT;
	plane->z = surface_fixed(z, bits - shift) * (1 << shift);
	plane->dx = surface_fixed(dx, bits - shift) * (1 << shift);
	plane->dy = surface_fixed(dy, bits - shift) * (1 << shift);
}

void accel_surface_plane_of(struct accel_depth_plane *plane, const struct accel_fit_batch *batch,
			    int i)
{
	const int32_t one = 1 << GLOSS_DEPTH_COMPACT_SHIFT;

	*plane = (struct accel_depth_plane){
		.x = batch->at_x[i],
		.y = batch->at_y[i],
		.z = (int64_t)batch->depth[0][i] * one,
		.dx = (int64_t)batch->depth[1][i] * one,
		.dy = (int64_t)batch->depth[2][i] * one,
		.narrow = true,
	};
}

/* i = i0 + d u + e v + a u^2 + b v^2 + c u v */
struct polynomial {
	double i, d, e, a, b, c;
};

static struct polynomial surface_linear(double i1, double i2, double i3)
{
	return (struct polynomial){ .i = i1, .d = i2 - i1, .e = i3 - i1 };
}

static struct polynomial surface_second_order(double i1, double i2, double i3, double i12,
					      double i23, double i31)
{
	double a = 2 * (i1 + i2 - 2 * i12), b = 2 * (i1 + i3 - 2 * i31);

	return (struct polynomial){
		.i = i1,
		.d = i2 - i1 - a,
		.e = i3 - i1 - b,
		.a = a,
		.b = b,
		.c = 4 * (i1 + i23 - i12 - i31),
	};
}

/* Forward differences at the basis's pixel; false: too large to be of use. */
static bool surface_fit(struct accel_surface *surface, const struct accel_basis *f,
			const struct polynomial *p)
{
	double du = p->d + 2 * p->a * f->u + p->c * f->v;
	double dv = p->e + 2 * p->b * f->v + p->c * f->u;
	double xx = 2 * (p->a * f->ux * f->ux + p->b * f->vx * f->vx + p->c * f->ux * f->vx);
	double yy = 2 * (p->a * f->uy * f->uy + p->b * f->vy * f->vy + p->c * f->uy * f->vy);
	double xy = 2 * (p->a * f->ux * f->uy + p->b * f->vx * f->vy) +
		    p->c * (f->ux * f->vy + f->uy * f->vx);
	double dx = du * f->ux + dv * f->vx + xx / 2, dy = du * f->uy + dv * f->vy + yy / 2;

	if (!(fabs(dx) < SLOPE_MAX && fabs(dy) < SLOPE_MAX && fabs(xx) < CURVATURE_MAX &&
	      fabs(yy) < CURVATURE_MAX && fabs(xy) < CURVATURE_MAX))
		return false;
	surface->i = surface_fixed_colour(p->i + f->u * (p->d + p->a * f->u + p->c * f->v) +
					  f->v * (p->e + p->b * f->v) + 0.5);
	surface->dx = surface_fixed_colour(dx);
	surface->dy = surface_fixed_colour(dy);
	surface->dxx = surface_fixed_colour(xx);
	surface->dxy = surface_fixed_colour(xy);
	surface->dyy = surface_fixed_colour(yy);
	return true;
}

static float surface_clamp_unit(float value)
{
	return value < 0 ? 0 : value > 1 ? 1 : value;
}

static uint8_t surface_constant(float value)
{
	return (uint8_t)(surface_clamp_unit(value) * 255 + 0.5f);
}

void accel_surface_flat(struct accel_triangle *triangle, const float colour[4])
{
	triangle->shading = GLOSS_SHADING_FLAT;
	triangle->alpha_linear = false;
	/* Loops over batches read them whatever the shading is. */
	memset(triangle->channel, 0, sizeof(triangle->channel));
	for (int i = 0; i < CHANNELS; i++)
		triangle->constant[i] = surface_constant(colour[i]);
}

/* A plane for each of the channels from @first to before @end. */
static bool surface_fit_linear(struct accel_triangle *triangle, const struct accel_basis *basis,
			       int first, int end, const float *const colour[3])
{
	bool fits = true;

	for (int i = first; i < end; i++) {
		const struct polynomial p = surface_linear(255 * (double)colour[0][i],
							   255 * (double)colour[1][i],
							   255 * (double)colour[2][i]);

		fits &= surface_fit(&triangle->channel[i], basis, &p);
	}
	return fits;
}

static void surface_fit_alpha(struct accel_triangle *triangle, const struct accel_basis *basis,
			      const float *const colour[3])
{
	float a = colour[0][3], b = colour[1][3], c = colour[2][3];

	triangle->constant[3] = surface_constant((a + b + c) / 3);
	triangle->alpha_linear = (a != b || a != c) &&
				 surface_fit_linear(triangle, basis, 3, CHANNELS, colour);
}

static void surface_triangle_linear(struct accel_triangle *triangle,
				    const struct accel_basis *basis, const float *const colour[3])
{
	float mean[CHANNELS];

	triangle->shading = GLOSS_SHADING_LINEAR;
	if (!surface_fit_linear(triangle, basis, 0, 3, colour)) {
		for (int i = 0; i < CHANNELS; i++)
			mean[i] = (colour[0][i] + colour[1][i] + colour[2][i]) / 3;
		accel_surface_flat(triangle, mean);
	}
	surface_fit_alpha(triangle, basis, colour);
}

void accel_surface_gouraud(struct accel_triangle *triangle, const struct accel_basis *basis,
			   const struct accel_vertex *const vertex[3])
{
	float colour[3][CHANNELS];
	bool equal = true;

	triangle->x = basis->x;
	triangle->y = basis->y;
	for (int i = 0; i < CHANNELS; i++) {
		for (int j = 0; j < 3; j++)
			colour[j][i] = surface_clamp_unit(vertex[j]->sample.colour[i]);
		equal &= colour[0][i] == colour[1][i] && colour[0][i] == colour[2][i];
	}
	if (equal)
		accel_surface_flat(triangle, colour[0]);
	else
		surface_triangle_linear(triangle, basis,
					(const float *const[3]){ colour[0], colour[1], colour[2] });
}

/*
 * The least and greatest of a channel's control points, which bound the surface; clamped, as the
 * core clamps it.
 */
static void surface_bounds(const struct accel_patch *patch, int channel, float *low, float *high)
{
	*low = 1;
	*high = 0;
	for (int i = 0; i < 3; i++) {
		float a = patch->vertex[i]->sample.colour[channel];
		float b = patch->vertex[(i + 1) % 3]->sample.colour[channel];
		float end = surface_clamp_unit(a);
		float control = surface_clamp_unit(2 * patch->edge[i]->colour[channel] -
						   (a + b) / 2);

		*low = end < *low ? end : *low;
		*high = number_larger(end, *high);
		*low = control < *low ? control : *low;
		*high = number_larger(control, *high);
	}
}

/* If no channel varies by a step, @colour is the middle of what it has. */
static bool surface_is_flat(const struct accel_patch *patch, float colour[3])
{
	for (int i = 0; i < 3; i++) {
		float low, high;

		surface_bounds(patch, i, &low, &high);
		if (high - low >= 1 / 255.0f)
			return false;
		colour[i] = (low + high) / 2;
	}
	return true;
}

static bool surface_fit_second_order(struct accel_triangle *triangle,
				     const struct accel_basis *basis,
				     const struct accel_patch *patch)
{
	for (int i = 0; i < 3; i++) {
		const struct polynomial p = surface_second_order(
			255 * (double)patch->vertex[0]->sample.colour[i],
			255 * (double)patch->vertex[1]->sample.colour[i],
			255 * (double)patch->vertex[2]->sample.colour[i],
			255 * (double)patch->edge[0]->colour[i],
			255 * (double)patch->edge[1]->colour[i],
			255 * (double)patch->edge[2]->colour[i]);

		if (!surface_fit(&triangle->channel[i], basis, &p))
			return false;
	}
	triangle->shading = GLOSS_SHADING_SECOND_ORDER;
	return true;
}

void accel_surface_patch(struct accel_triangle *triangle, const struct accel_basis *basis,
			 const struct accel_patch *patch)
{
	const float *const colour[3] = {
		patch->vertex[0]->sample.colour,
		patch->vertex[1]->sample.colour,
		patch->vertex[2]->sample.colour,
	};
	bool curved = accel_patch_curved(patch);
	float flat[CHANNELS] = { 0 };

	triangle->x = basis->x;
	triangle->y = basis->y;
	if (surface_is_flat(patch, flat))
		accel_surface_flat(triangle, flat);
	else if (!curved || !surface_fit_second_order(triangle, basis, patch))
		surface_triangle_linear(triangle, basis, colour);
	surface_fit_alpha(triangle, basis, colour);
}

void accel_surface_basis_of(const struct accel_fit_batch *batch, int i, struct accel_basis *basis)
{
	*basis = (struct accel_basis){
		.x = batch->at_x[i],
		.y = batch->at_y[i],
		.u = batch->u[i],
		.v = batch->v[i],
		.ux = batch->ux[i],
		.uy = batch->uy[i],
		.vx = batch->vx[i],
		.vy = batch->vy[i],
	};
}

static void surface_take(const struct accel_surface_batch *batch, int i,
			 struct accel_surface *surface)
{
	*surface = (struct accel_surface){
		.i = (uint32_t)batch->i[i],
		.dx = (uint32_t)batch->dx[i],
		.dy = (uint32_t)batch->dy[i],
		.dxx = (uint32_t)batch->dxx[i],
		.dxy = (uint32_t)batch->dxy[i],
		.dyy = (uint32_t)batch->dyy[i],
	};
}

void accel_surface_fitted(struct accel_triangle *triangle, const struct accel_fit_batch *batch,
			  int i, const struct accel_patch *patch)
{
	const float flat[CHANNELS] = { batch->flat_colour[0][i], batch->flat_colour[1][i],
				       batch->flat_colour[2][i] };
	const float *const colour[3] = {
		patch->vertex[0]->sample.colour,
		patch->vertex[1]->sample.colour,
		patch->vertex[2]->sample.colour,
	};
	struct accel_basis basis;

	accel_surface_basis_of(batch, i, &basis);
	if (!batch->flat[i] && !batch->fits[i]) {
		accel_surface_patch(triangle, &basis, patch);
		return;
	}
	triangle->x = basis.x;
	triangle->y = basis.y;
	triangle->shading = batch->curved[i] ? GLOSS_SHADING_SECOND_ORDER : GLOSS_SHADING_LINEAR;
	for (int j = 0; j < 3; j++)
		surface_take(&batch->surface[j], i, &triangle->channel[j]);
	if (batch->flat[i])
		accel_surface_flat(triangle, flat);
	surface_fit_alpha(triangle, &basis, colour);
}

void accel_surface_few(struct accel_triangle *triangle, const struct accel_fit_batch *batch, int i)
{
	triangle->x = batch->at_x[i];
	triangle->y = batch->at_y[i];
	triangle->shading = (enum gloss_shading)batch->form[i];
	triangle->alpha_linear = !batch->even[i];
	for (int j = 0; j < CHANNELS; j++) {
		surface_take(&batch->surface[j], i, &triangle->channel[j]);
		triangle->constant[j] = (uint8_t)batch->level[j][i];
	}
}
