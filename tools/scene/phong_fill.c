// SPDX-License-Identifier: MIT
/* Triangles to lit pixels. */
#include <math.h>
#include <string.h>

#include "scene/phong_priv.h"

#define SNAP 16 /* steps a pixel */
/* Keeps products of two coordinates in 64 bits. */
#define WINDOW_MAX (1 << 24)

/* A triangle whose vertices run clockwise on screen. */
struct triangle {
	const struct phong_vertex *vertex[3];
	float inverse_area;
	int side;   /* 0 front, 1 back: of base, lamps and alpha */
	float flip; /* factor of the normal */
};

/* A point of the surface. */
struct phong_point {
	float eye[3], normal[3], paint[3];
};

/* An edge function, positive to the right of the edge. */
struct edge {
	int64_t value, dx, dy; /* at a pixel centre, less @bias; from pixel to pixel */
	int64_t bias;          /* 1 if pixels on it are outside: not a top or left edge */
};

static float dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The C library's fminf and fmaxf are calls, for the sake of NaN. */
static float clamp(float value, float low, float high)
{
	return value < low ? low : value > high ? high : value;
}

static void normalise(float v[3])
{
	float length = sqrtf(dot(v, v));
	float scale = length > 0 ? 1 / length : 0;

	for (int i = 0; i < 3; i++)
		v[i] *= scale;
}

static void product(float out[3], const float a[4], const float b[4])
{
	for (int i = 0; i < 3; i++)
		out[i] = a[i] * b[i];
}

static const float white[4] = { 1, 1, 1, 1 };

static struct phong_lamp prepare_lamp(const struct scene *scene, const struct accel_light *light)
{
	bool painted = phong_painted(scene);
	struct phong_lamp lamp = {
		.positional = light->position[3] != 0,
		.spot = light->spot_cutoff > 0 && light->spot_cutoff <= 90,
		.spot_exponent = light->spot_exponent,
		.spot_cosine = cosf(light->spot_cutoff * (3.14159265358979f / 180)),
	};

	for (int i = 0; i < 3; i++) {
		lamp.position[i] = light->position[i];
		if (lamp.positional)
			lamp.position[i] /= light->position[3];
		lamp.spot_direction[i] = light->spot_direction[i];
		lamp.attenuation[i] = light->attenuation[i];
	}
	if (lamp.attenuation[0] == 0 && lamp.attenuation[1] == 0 && lamp.attenuation[2] == 0)
		lamp.attenuation[0] = 1;
	if (!lamp.positional)
		normalise(lamp.position);
	memcpy(lamp.half, lamp.position, sizeof(lamp.half));
	lamp.half[2] += 1;
	normalise(lamp.half);
	normalise(lamp.spot_direction);
	for (int side = 0; side < 2; side++) {
		const struct accel_material *material = &scene->material[side];

		product(lamp.ambient[side], light->ambient, painted ? white : material->ambient);
		product(lamp.diffuse[side], light->diffuse, painted ? white : material->diffuse);
		product(lamp.specular[side], light->specular, material->specular);
	}
	return lamp;
}

void phong_fill_init(struct phong_fill *fill, const struct scene *scene, struct phong_frame *frame)
{
	fill->scene = scene;
	fill->frame = frame;
	fill->lamps = 0;
	for (int i = 0; i < ACCEL_LIGHTS; i++)
		if (scene->light[i].enabled)
			fill->lamp[fill->lamps++] = prepare_lamp(scene, &scene->light[i]);
	for (int side = 0; side < 2; side++) {
		const struct accel_material *material = &scene->material[side];
		float alpha = phong_painted(scene) ? 1 : clamp(material->diffuse[3], 0, 1);

		product(fill->base[side], scene->ambient,
			phong_painted(scene) ? white : material->ambient);
		memcpy(fill->emission[side], material->emission, sizeof(fill->emission[side]));
		fill->alpha[side] = (uint32_t)(alpha * 255 + 0.5f) << 24;
	}
}

/* Turns @to into the unit vector from @eye to the lamp; returns how much of its light arrives. */
static float reach(const struct phong_lamp *lamp, const float eye[3], float to[3])
{
	float distance, cosine, factor;

	if (!lamp->positional) {
		memcpy(to, lamp->position, sizeof(lamp->position));
		return 1;
	}
	for (int i = 0; i < 3; i++)
		to[i] = lamp->position[i] - eye[i];
	distance = sqrtf(dot(to, to));
	normalise(to);
	factor = 1 / (lamp->attenuation[0] +
		      distance * (lamp->attenuation[1] + distance * lamp->attenuation[2]));
	if (lamp->spot) {
		cosine = -dot(to, lamp->spot_direction);
		factor = cosine < lamp->spot_cosine ? 0 :
						      factor * powf(cosine, lamp->spot_exponent);
	}
	return factor;
}

static void add_lamp(const struct phong_fill *fill, const struct phong_lamp *lamp, int side,
		     const struct phong_point *point, const float viewer[3], float light[3])
{
	const float *eye = point->eye, *normal = point->normal, *paint = point->paint;
	float to[3], half[3], cosine, highlight;
	bool same_half = !lamp->positional && !fill->scene->local_viewer;
	float factor = reach(lamp, eye, to);

	if (factor == 0)
		return;
	for (int i = 0; i < 3; i++)
		light[i] += factor * lamp->ambient[side][i] * paint[i];
	cosine = dot(normal, to);
	if (cosine <= 0)
		return;
	for (int i = 0; i < 3; i++)
		half[i] = to[i] + viewer[i];
	if (!same_half)
		normalise(half);
	highlight = dot(normal, same_half ? lamp->half : half);
	highlight = factor *
		    powf(highlight > 0 ? highlight : 0, fill->scene->material[side].shininess);
	cosine *= factor;
	for (int i = 0; i < 3; i++)
		light[i] += cosine * lamp->diffuse[side][i] * paint[i] +
			    highlight * lamp->specular[side][i];
}

static void shade(const struct phong_fill *fill, int side, struct phong_point *point,
		  float light[3])
{
	float viewer[3] = { 0, 0, 1 };

	normalise(point->normal);
	if (fill->scene->local_viewer) {
		for (int i = 0; i < 3; i++)
			viewer[i] = -point->eye[i];
		normalise(viewer);
	}
	for (int i = 0; i < 3; i++)
		light[i] = fill->base[side][i] * point->paint[i] + fill->emission[side][i];
	for (int i = 0; i < fill->lamps; i++)
		add_lamp(fill, &fill->lamp[i], side, point, viewer, light);
}

static uint32_t pack(const float light[3], uint32_t alpha)
{
	uint32_t word = alpha;

	for (int i = 0; i < 3; i++)
		word |= (uint32_t)(clamp(light[i], 0, 1) * 255 + 0.5f) << 8 * i;
	return word;
}

/* Lights a pixel that passed the depth test; b1, b2: its weights of vertex 1 and 2 on screen. */
static void draw_pixel(const struct phong_fill *fill, const struct triangle *t, float b1, float b2,
		       size_t pixel)
{
	const struct phong_vertex *v0 = t->vertex[0], *v1 = t->vertex[1], *v2 = t->vertex[2];
	float w1 = b1 * v1->inverse_w, w2 = b2 * v2->inverse_w;
	float w = 1 / ((1 - b1 - b2) * v0->inverse_w + w1 + w2);
	bool painted = phong_painted(fill->scene);
	struct phong_point point;
	float light[3];

	w1 *= w;
	w2 *= w;
	for (int i = 0; i < 3; i++) {
		point.eye[i] = v0->eye[i] + w1 * (v1->eye[i] - v0->eye[i]) +
			       w2 * (v2->eye[i] - v0->eye[i]);
		point.normal[i] = t->flip * (v0->normal[i] + w1 * (v1->normal[i] - v0->normal[i]) +
					     w2 * (v2->normal[i] - v0->normal[i]));
		point.paint[i] = !painted ? 1 :
					    v0->paint[i] + w1 * (v1->paint[i] - v0->paint[i]) +
						    w2 * (v2->paint[i] - v0->paint[i]);
	}
	shade(fill, t->side, &point, light);
	fill->frame->pixel[pixel] = pack(light, fill->alpha[t->side]);
	if (fill->frame->light)
		memcpy(fill->frame->light[pixel], light, sizeof(light));
}

/* The edge from @a to @b at pixel (@x, @y). */
static struct edge edge_init(const struct phong_vertex *a, const struct phong_vertex *b, int x,
			     int y)
{
	struct edge edge = { .dx = (a->y - b->y) * SNAP, .dy = (b->x - a->x) * SNAP };
	bool top_left = b->y < a->y || (b->y == a->y && b->x > a->x);

	edge.bias = !top_left;
	edge.value = (b->x - a->x) * (y * SNAP + SNAP / 2 - a->y) -
		     (b->y - a->y) * (x * SNAP + SNAP / 2 - a->x) - edge.bias;
	return edge;
}

/* Draws the pixels of one row; the edges stand at its first pixel, x0. */
static void draw_row(const struct phong_fill *fill, const struct triangle *t,
		     const struct edge edge[3], int x0, int x1, int y)
{
	int64_t e0 = edge[0].value, e1 = edge[1].value, e2 = edge[2].value;
	float z0 = t->vertex[0]->z, dz1 = t->vertex[1]->z - z0, dz2 = t->vertex[2]->z - z0;
	size_t pixel = (size_t)y * fill->frame->width + x0;

	for (int x = x0; x <= x1; x++, pixel++) {
		if ((e0 | e1 | e2) >= 0) {
			/* Edge 1 runs from vertex 1 to 2, opposite to vertex 0. */
			float b1 = (float)(e2 + edge[2].bias) * t->inverse_area;
			float b2 = (float)(e0 + edge[0].bias) * t->inverse_area;
			float z = z0 + b1 * dz1 + b2 * dz2;

			if (z < fill->frame->depth[pixel]) {
				fill->frame->depth[pixel] = z;
				draw_pixel(fill, t, b1, b2, pixel);
			}
		}
		e0 += edge[0].dx;
		e1 += edge[1].dx;
		e2 += edge[2].dx;
	}
}

/* First and last pixel whose centre is between the least and greatest of three coordinates. */
static void extent(int64_t a, int64_t b, int64_t c, int size, int *first, int *last)
{
	int64_t low = a < b ? a : b, high = a < b ? b : a;

	low = c < low ? c : low;
	high = c > high ? c : high;
	low = (low + SNAP / 2 - 1) >> 4;
	high = (high - SNAP / 2) >> 4;
	*first = low < 0 ? 0 : low > size ? size : (int)low;
	*last = high < -1 ? -1 : high >= size ? size - 1 : (int)high;
}

static void draw_rows(const struct phong_fill *fill, const struct triangle *t)
{
	const struct phong_vertex *const *v = t->vertex;
	struct edge edge[3];
	int x0, x1, y0, y1;

	extent(v[0]->x, v[1]->x, v[2]->x, fill->frame->width, &x0, &x1);
	extent(v[0]->y, v[1]->y, v[2]->y, fill->frame->height, &y0, &y1);
	for (int i = 0; i < 3; i++)
		edge[i] = edge_init(v[i], v[(i + 1) % 3], x0, y0);
	for (int y = y0; y <= y1; y++) {
		draw_row(fill, t, edge, x0, x1, y);
		for (int i = 0; i < 3; i++)
			edge[i].value += edge[i].dy;
	}
}

static int64_t snap(double pixel)
{
	pixel = pixel > -WINDOW_MAX ? pixel : -WINDOW_MAX;
	pixel = pixel < WINDOW_MAX ? pixel : WINDOW_MAX;
	return (int64_t)floor(pixel * SNAP + 0.5);
}

void phong_fill_project(const struct phong_frame *frame, struct phong_vertex *vertex)
{
	double half_width = frame->width / 2.0, half_height = frame->height / 2.0;
	double inverse = 1 / vertex->clip[3];

	vertex->x = snap(vertex->clip[0] * inverse * half_width + half_width);
	vertex->y = snap(vertex->clip[1] * inverse * -half_height + half_height);
	vertex->z = (float)(vertex->clip[2] * inverse * 0.5 + 0.5);
	vertex->inverse_w = (float)inverse;
}

void phong_fill_triangle(const struct phong_fill *fill, const struct phong_vertex *a,
			 const struct phong_vertex *b, const struct phong_vertex *c)
{
	struct triangle t = { .vertex = { a, b, c }, .flip = 1 };
	int64_t area = (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
	bool back = area > 0; /* counter-clockwise is front, and y points down here */

	if (area == 0 || fill->scene->cull == (back ? ACCEL_CULL_BACK : ACCEL_CULL_FRONT))
		return;
	if (!back) {
		t.vertex[1] = c;
		t.vertex[2] = b;
		area = -area;
	}
	if (back && fill->scene->two_sided) {
		t.side = 1;
		t.flip = -1;
	}
	t.inverse_area = 1 / (float)area;
	draw_rows(fill, &t);
}
