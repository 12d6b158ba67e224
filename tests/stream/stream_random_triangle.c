// SPDX-License-Identifier: MIT
/*
 * Random TRIANGLE packets: set up from real corners, or with any bits in every
 * field that takes them.
 */
#include <stdlib.h>

#include "stream_random.h"

#define below stream_random_below
#define between stream_random_between
#define chance stream_random_chance

/* In 1/16 pixel, from the tile's corner. */
struct point {
	int32_t x, y;
};

/* Divides rounding down. */
static int64_t floor_div(int64_t a, int64_t b)
{
	return a / b - (a % b < 0);
}

/* First row or column whose centre is not before @place. */
static int32_t first_centre(int32_t place)
{
	return (int32_t)floor_div(place + 7, 16);
}

struct line {
	int32_t x, step;
	uint32_t r, m, dy;
};

/*
 * The edge from @a down to @b at @row. x is the ceiling of a division by 16*dy;
 * steps are multiples of 16 of its units, so that r can be kept in units of 16.
 */
static struct line line_at(struct point a, struct point b, int32_t row)
{
	int64_t dx = b.x - a.x, dy = b.y - a.y, all = 16 * dy;
	int64_t n = (a.x - 8) * dy + (16 * row + 8 - a.y) * dx + all - 1;
	int64_t x = floor_div(n, all), step = floor_div(dx, dy);

	return (struct line){ .x = (int32_t)x,
			      .step = (int32_t)step,
			      .r = (uint32_t)((n - x * all) / 16),
			      .m = (uint32_t)(dx - step * dy),
			      .dy = (uint32_t)dy };
}

static void set_left(struct gloss_edges_wide *e, struct line line)
{
	e->left_x = line.x;
	e->left_step = line.step;
	e->left_r = line.r;
	e->left_m = line.m;
	e->left_dy = line.dy;
}

static void set_right(struct gloss_edges_wide *e, struct line line)
{
	e->right_x = line.x;
	e->right_step = line.step;
	e->right_r = line.r;
	e->right_m = line.m;
	e->right_dy = line.dy;
}

static void set_middle(struct gloss_edges_wide *e, struct line line)
{
	e->middle_x = line.x;
	e->middle_step = line.step;
	e->middle_r = line.r;
	e->middle_m = line.m;
	e->middle_dy = line.dy;
}

static void sort(struct point p[3])
{
	static const int order[3] = { 0, 1, 0 };
	struct point swap;

	for (int n = 0; n < 3; n++) {
		int k = order[n];

		if (p[k].y <= p[k + 1].y)
			continue;
		swap = p[k];
		p[k] = p[k + 1];
		p[k + 1] = swap;
	}
}

/* False: no row of the tile has the triangle on its centre line. */
static bool set_up(struct gloss_edges_wide *e, struct point p[3], int tile_size)
{
	int32_t first, last, middle;
	bool middle_left;
	struct line whole, upper = { 0 }, lower = { 0 };

	sort(p);
	first = first_centre(p[0].y);
	middle = first_centre(p[1].y);
	last = first_centre(p[2].y) - 1;
	first = first < 0 ? 0 : first;
	last = last > tile_size - 1 ? tile_size - 1 : last;
	if (first > last)
		return false;
	whole = line_at(p[0], p[2], first);
	if (middle > first)
		upper = line_at(p[0], p[1], first);
	if (middle <= last)
		lower = line_at(p[1], p[2], middle > first ? middle : first);
	middle_left = (int64_t)(p[1].x - p[0].x) * (p[2].y - p[0].y) <
		      (int64_t)(p[2].x - p[0].x) * (p[1].y - p[0].y);
	set_left(e, !middle_left ? whole : middle > first ? upper : lower);
	set_right(e, middle_left ? whole : middle > first ? upper : lower);
	set_middle(e, lower);
	e->first_row = (uint32_t)first;
	e->last_row = (uint32_t)(last - first);
	e->switch_row = middle > first && middle <= last ? (uint32_t)(middle - first) : 0;
	e->side = !middle_left;
	return true;
}

/* Corners of a triangle of at most @size pixels that has to do with the tile. */
static void random_corners(struct stream_random *r, struct point p[3], int32_t size)
{
	int32_t x = between(r, -8 * size, 16 * r->tile_size - 8 * size);
	int32_t y = between(r, -8 * size, 16 * r->tile_size - 8 * size);

	for (int n = 0; n < 3; n++) {
		p[n].x = x + between(r, 0, 16 * size);
		p[n].y = y + between(r, 0, 16 * size);
		if (chance(r, 10))
			p[n].x &= ~15;
		if (chance(r, 10))
			p[n].y &= ~15;
	}
}

static void real_edges(struct stream_random *r, struct gloss_edges_wide *e)
{
	static const int32_t sizes[] = { 1, 2, 4, 8, 16, 32, 60, 63, 200, 1500 };
	struct point p[3];

	do
		random_corners(r, p, sizes[below(r, sizeof(sizes) / sizeof(*sizes))]);
	while (!set_up(e, p, r->tile_size));
}

static void random_rows(struct stream_random *r, struct gloss_edges_wide *e)
{
	e->first_row = below(r, (uint32_t)r->tile_size);
	e->last_row = below(r, (uint32_t)r->tile_size - e->first_row);
	e->switch_row = chance(r, 50) ? below(r, 64) : below(r, e->last_row + 1);
	e->side = below(r, 2);
}

/* Slow enough to stay in the tile for some rows, with any remainder, also one that wraps. */
static struct line wild_line(struct stream_random *r, int32_t x)
{
	struct line line;

	line.x = x;
	line.step = between(r, -3, 3);
	line.r = stream_random_word(r) & 0xffff;
	line.m = stream_random_word(r) & 0xffff;
	line.dy = chance(r, 20) ? below(r, 3) : stream_random_word(r) & 0xffff;
	if (!chance(r, 25))
		return line;
	line.x = between(r, -4096, 4095);
	line.step = chance(r, 50) ? between(r, -4096, 4095) : between(r, -64, 64);
	return line;
}

static void wild_edges(struct stream_random *r, struct gloss_edges_wide *e)
{
	random_rows(r, e);
	set_left(e, wild_line(r, between(r, -8, r->tile_size)));
	set_right(e, wild_line(r, between(r, 0, r->tile_size + 8)));
	set_middle(e, wild_line(r, between(r, -8, r->tile_size + 8)));
}

static bool line_narrow(int32_t x, int32_t step, uint32_t dy)
{
	return x >= -128 && x < 128 && step >= -128 && step < 128 && dy < 1024;
}

static bool edges_narrow(const struct gloss_edges_wide *e)
{
	return line_narrow(e->left_x, e->left_step, e->left_dy) &&
	       line_narrow(e->right_x, e->right_step, e->right_dy) &&
	       line_narrow(e->middle_x, e->middle_step, e->middle_dy);
}

/* r and m of a real edge are below dy; those of a wild one lose their high bits here. */
static struct gloss_edges_compact narrow(const struct gloss_edges_wide *e)
{
	return (struct gloss_edges_compact){
		.left_x = e->left_x,
		.left_step = e->left_step,
		.left_r = e->left_r,
		.left_m = e->left_m,
		.left_dy = e->left_dy,
		.right_x = e->right_x,
		.right_step = e->right_step,
		.right_r = e->right_r,
		.right_m = e->right_m,
		.right_dy = e->right_dy,
		.middle_x = e->middle_x,
		.middle_step = e->middle_step,
		.middle_r = e->middle_r,
		.middle_m = e->middle_m,
		.middle_dy = e->middle_dy,
		.first_row = e->first_row,
		.last_row = e->last_row,
		.switch_row = e->switch_row,
		.side = e->side,
	};
}

/* Writes the edges of a triangle and returns the form that has become. */
static enum gloss_geometry random_edges(struct stream_random *r, uint32_t *words, uint32_t *count)
{
	struct gloss_edges_compact compact;
	struct gloss_edges_wide wide;
	bool wild = chance(r, 20);

	*count = 0;
	if (chance(r, 8))
		return GLOSS_GEOMETRY_COVERING;
	if (wild)
		wild_edges(r, &wide);
	else
		real_edges(r, &wide);
	if (chance(r, 75) && (wild || edges_narrow(&wide))) {
		compact = narrow(&wide);
		gloss_edges_compact_pack(words, &compact);
		*count = GLOSS_EDGES_COMPACT_WORDS;
		return GLOSS_GEOMETRY_COMPACT;
	}
	gloss_edges_wide_pack(words, &wide);
	*count = GLOSS_EDGES_WIDE_WORDS;
	return GLOSS_GEOMETRY_WIDE;
}

/* A number of up to 64 bits of random size and sign, so that small ones are as likely as large. */
static uint64_t spread(struct stream_random *r, int bits)
{
	uint64_t value = stream_random_word(r);

	value = value << 32 | stream_random_word(r);
	value >>= 64 - between(r, 1, bits);
	return chance(r, 50) ? value : 0 - value;
}

static void random_depth(struct stream_random *r, enum gloss_geometry geometry)
{
	int bits = geometry == GLOSS_GEOMETRY_COMPACT ? 32 : 40;
	int whole = geometry == GLOSS_GEOMETRY_COMPACT ? 6 : 12;
	uint64_t z, dx, dy;

	if (chance(r, 15)) {
		z = spread(r, bits);
		dx = spread(r, bits);
		dy = spread(r, bits);
	} else {
		z = (uint64_t)below(r, 1 << 24) << whole;
		dx = spread(r, 18 + whole);
		dy = spread(r, 18 + whole);
	}
	stream_random_emit(r, (uint32_t)z);
	stream_random_emit(r, (uint32_t)dx);
	stream_random_emit(r, (uint32_t)dy);
	if (geometry != GLOSS_GEOMETRY_COMPACT)
		stream_random_emit(r, (z >> 32 & 0xff) | (dx >> 32 & 0xff) << 8 |
					      (dy >> 32 & 0xff) << 16);
}

/* Value, two first differences, and three second ones if @words says so. */
static void random_surface(struct stream_random *r, int words)
{
	bool wild = chance(r, 15);

	stream_random_emit(r,
			   wild ? stream_random_word(r) : below(r, 256u << GLOSS_COLOUR_FRACTION));
	for (int n = 1; n < words; n++)
		stream_random_emit(r, (uint32_t)spread(r, wild ? 32 : n < 3 ? 25 : 19));
}

static void random_colour(struct stream_random *r, enum gloss_shading shading)
{
	if (shading == GLOSS_SHADING_FLAT) {
		stream_random_emit(r, below(r, 1 << 24));
		return;
	}
	for (int channel = 0; channel < 3; channel++)
		random_surface(r, shading == GLOSS_SHADING_LINEAR ? 3 : 6);
}

void stream_random_triangle(struct stream_random *r)
{
	uint32_t edges[GLOSS_EDGES_WIDE_WORDS], count, header;
	struct gloss_triangle p;

	p.geometry = random_edges(r, edges, &count);
	p.shading = (enum gloss_shading)below(r, 3);
	p.alpha_linear = chance(r, 30);
	p.alpha = below(r, 256);
	gloss_triangle_pack(&header, &p);
	stream_random_emit(r, header);
	for (uint32_t n = 0; n < count; n++)
		stream_random_emit(r, edges[n]);
	random_depth(r, p.geometry);
	if (p.alpha_linear)
		random_surface(r, GLOSS_ALPHA_LINEAR_WORDS);
	random_colour(r, p.shading);
}
