// SPDX-License-Identifier: MIT
/* Points (3.3) and lines (3.4), neither of them smooth. */
#include "oracle.h"

#include <math.h>
#include <stddef.h>

/* Of what is rounded: what is nearer to half way, or to a whole number, may go to either side. */
#define UNSURE 0.002
/* A line's middle may lie so much to the side, in slopes: its ends are moved by that to exclude one. */
#define ASIDE (1.0 / ORACLE_ROUND + 1e-9)
/* Pixels: pieces of a stippled line have rounded ends, and so their sides are a little aside. */
#define PIECES 0.01
/* Shorter lines, in pixels, have ends too near to compare their colours. */
#define SHORT 4.0

static int whole_width(double width, bool *doubt)
{
	*doubt |= fabs(width - floor(width) - 0.5) < UNSURE;
	return (int)fmax(1, floor(width + 0.5));
}

/* Equation 3.1, with 2.13's derived size. */
static double point_size(const struct oracle_state *state, const struct oracle_corner *corner)
{
	const double *eye = corner->eye, *k = state->point_attenuation;
	double d = sqrt(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]);
	double size = state->point_size * sqrt(1 / (k[0] + k[1] * d + k[2] * d * d));

	return fmin(fmax(size, state->point_least), state->point_most);
}

/* The first of @width pixels around what is in sixteenths of one. */
static int first_pixel(double at, int width)
{
	at /= ORACLE_ROUND;
	return (int)(width % 2 ? floor(at) : floor(at + 0.5)) - width / 2;
}

static struct oracle_pixel *pixel_at(struct oracle_picture *picture, int x, int y)
{
	bool inside = x >= 0 && y >= 0 && x < picture->width && y < picture->height;

	return inside ? &picture->pixel[y * picture->width + x] : NULL;
}

void oracle_point(const struct oracle_state *state, const struct oracle_corner *corner,
		  struct oracle_picture *picture)
{
	struct oracle_place place;
	int width, x, y;

	if (!oracle_in_view(state, corner, &picture->doubtful))
		return;
	place = oracle_place(state, corner->clip, &picture->doubtful);
	width = whole_width(point_size(state, corner), &picture->doubtful);
	x = first_pixel(place.x, width);
	y = first_pixel(place.y, width);
	for (int i = 0; i < width * width; i++) {
		struct oracle_pixel *pixel = pixel_at(picture, x + i % width, y + i / width);

		if (!pixel)
			continue;
		*pixel = (struct oracle_pixel){ .drawn = true,
						.depth = place.z,
						.inside = INFINITY };
		for (int j = 0; j < 4; j++)
			pixel->colour[j] = corner->colour[ORACLE_FRONT][0][j];
	}
}

/* A line in the window. @along is the axis that it is more along, @aside the other. */
struct line {
	const struct oracle_corner *corner;
	struct oracle_place place[2];
	double along[2], aside[2]; /* of the ends, sixteenths */
	double length;             /* along the axis, sixteenths */
	bool steep;
};

/* Colour and depth @t of the way (equations 3.3 and 3.4). */
static void line_value(const struct line *line, double t, double value[5])
{
	const double a = (1 - t) / line->place[0].w, b = t / line->place[1].w;

	for (int i = 0; i < 4; i++)
		value[i] = (a * line->corner[0].colour[ORACLE_FRONT][0][i] +
			    b * line->corner[1].colour[ORACLE_FRONT][0][i]) /
			   (a + b);
	value[4] = (1 - t) * line->place[0].z + t * line->place[1].z;
}

/*
 * The fragment @t of the way along the axis. The specification takes the nearest point of the line to the
 * centre, which is as much as half a pixel off; either is good, and so are ends moved as ASIDE says.
 */
static void line_paint(const struct line *line, double t, double off, struct oracle_pixel *pixel)
{
	const double slope = (line->aside[1] - line->aside[0]) / line->length;
	const double moved = fabs(off * slope) / (1 + slope * slope) + 1;
	double value[5], beside[5];

	line_value(line, t, value);
	*pixel = (struct oracle_pixel){
		.drawn = true,
		.depth = value[4],
		.slope = ORACLE_ROUND * fabs(line->place[1].z - line->place[0].z) / line->length,
		.inside = line->length < SHORT * ORACLE_ROUND ? 0 : INFINITY,
	};
	for (int i = 0; i < 4; i++)
		pixel->colour[i] = value[i];
	for (int i = 0; i < 2; i++) {
		line_value(line, t + (i ? moved : -moved) / line->length, beside);
		for (int j = 0; j < 5; j++)
			pixel->slack[j] = fmax(pixel->slack[j], fabs(beside[j] - value[j]));
	}
}

/* The fragments beside each other at one place along the axis (3.4.2). */
static void line_column(const struct line *line, int column, int width, double unsure,
			struct oracle_picture *picture)
{
	const double centre = (column + 0.5) * ORACLE_ROUND;
	const double t = fabs(centre - line->along[0]) / line->length;
	const double slope = (line->aside[1] - line->aside[0]) / line->length;
	const double middle = line->aside[0] + t * (line->aside[1] - line->aside[0]);
	const double low = middle / ORACLE_ROUND - (width - 1) / 2.0;
	const bool either = fabs(low - floor(low + 0.5)) < fabs(slope) * ASIDE + unsure;

	for (int i = either ? -1 : 0; i < width + either; i++) {
		int row = (int)floor(low) + i;
		struct oracle_pixel *pixel = line->steep ? pixel_at(picture, row, column) :
							   pixel_at(picture, column, row);

		if (!pixel)
			continue;
		line_paint(line, t, (row + 0.5) * ORACLE_ROUND - middle, pixel);
		pixel->either = either;
	}
}

/* Columns whose centres are from the first end on to before the last one; returns how many. */
static int line_columns(const struct line *line, int *first, int *step)
{
	const double a = line->along[0] / ORACLE_ROUND, b = line->along[1] / ORACLE_ROUND;
	int end;

	if (a < b) {
		*first = (int)ceil(a - 0.5);
		end = (int)ceil(b - 0.5);
		*step = 1;
		return end - *first;
	}
	*first = (int)floor(a - 0.5);
	end = (int)floor(b - 0.5);
	*step = -1;
	return *first - end;
}

void oracle_line(const struct oracle_state *state, const struct oracle_corner ends[2],
		 int *stippled, struct oracle_picture *picture)
{
	const int width = whole_width(state->line_width, &picture->doubtful);
	struct oracle_corner corner[2] = { ends[0], ends[1] };
	struct line line = { .corner = corner };
	int first, step, count;

	if (!oracle_clip_line(state, corner))
		return;
	for (int i = 0; i < 2; i++)
		line.place[i] = oracle_place(state, corner[i].clip, &picture->doubtful);
	line.steep = fabs(line.place[1].y - line.place[0].y) >
		     fabs(line.place[1].x - line.place[0].x);
	for (int i = 0; i < 2; i++) {
		line.along[i] = line.steep ? line.place[i].y : line.place[i].x;
		line.aside[i] = line.steep ? line.place[i].x : line.place[i].y;
	}
	line.length = fabs(line.along[1] - line.along[0]);
	count = line_columns(&line, &first, &step);
	for (int i = 0; i < count; i++, ++*stippled)
		if (!state->stipple_repeat ||
		    state->stipple >> (*stippled / state->stipple_repeat) % 16 & 1)
			line_column(&line, first + i * step, width,
				    state->stipple_repeat ? PIECES : 1e-6, picture);
}
