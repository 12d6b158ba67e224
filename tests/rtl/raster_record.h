/* SPDX-License-Identifier: MIT */
/* Random TRIANGLE packets for the benches of raster: real triangles, and any values at all. */
#ifndef TESTS_RASTER_RECORD_H
#define TESTS_RASTER_RECORD_H

#include <algorithm>
#include <vector>

#include "tb.h"

extern "C" {
#include "model/model.h"
}

/* 1/16 pixel */
struct Point {
	int x, y;
};

inline int floor_div(int64_t n, int64_t d)
{
	return (int)(n / d - (n % d < 0));
}

/* The first row whose centre is not above @y. */
inline int first_row(int y)
{
	return floor_div(y - 8 + 15, 16);
}

/* An edge of a real triangle from @top down to @bottom, as it is at @row; see group edges_wide. */
inline model_edge edge_between(Point top, Point bottom, int row)
{
	int64_t dx = bottom.x - top.x, dy = bottom.y - top.y;
	model_edge edge = {};

	if (dy <= 0)
		return edge;
	int64_t place = (top.x - 8) * dy + dx * (16 * row + 8 - top.y) + 16 * dy - 1;

	edge.x = floor_div(place, 16 * dy);
	edge.r = (uint32_t)((place - edge.x * 16 * dy) / 16);
	edge.step = floor_div(dx, dy);
	edge.m = (uint32_t)(dx - edge.step * dy);
	edge.dy = (uint32_t)dy;
	return edge;
}

/* Edges and rows of the triangle @p inside a tile's rows; false if it has none there. */
inline bool triangle_between(Point p[3], int tile_size, model_triangle &t)
{
	std::sort(p, p + 3, [](const Point &a, const Point &b) { return a.y < b.y; });
	int top = std::max(first_row(p[0].y), 0);
	int end = std::min(first_row(p[2].y), tile_size);
	int middle = first_row(p[1].y);

	if (top >= end)
		return false;

	int64_t turn = (int64_t)(p[1].x - p[0].x) * (p[2].y - p[0].y) -
		       (int64_t)(p[2].x - p[0].x) * (p[1].y - p[0].y);
	bool bend_right = turn > 0; /* the middle vertex is right of the long edge */
	bool below = middle <= top; /* the tile begins below the middle vertex */
	model_edge whole = edge_between(p[0], p[2], top);
	model_edge bent = below ? edge_between(p[1], p[2], top) : edge_between(p[0], p[1], top);

	t.left = bend_right ? whole : bent;
	t.right = bend_right ? bent : whole;
	t.middle = edge_between(p[1], p[2], middle);
	t.first_row = top;
	t.last_row = end - 1 - top;
	t.switch_row = below || middle >= end ? 0 : middle - top;
	t.side = bend_right;
	return true;
}

/* Any edge values at all: registers wrap. */
inline model_edge edge_any(Random &random)
{
	model_edge edge;

	edge.x = random.chance(50) ? random.between(-80, 80) : random.between(-4096, 4095);
	edge.step = random.chance(50) ? random.between(-3, 3) : random.between(-4096, 4095);
	edge.r = random.bits() & 0xffff;
	edge.m = random.bits() & 0xffff;
	edge.dy = random.bits() & (random.chance(50) ? 0xffff : 0xff);
	return edge;
}

inline void triangle_any(Random &random, int tile_size, model_triangle &t)
{
	t.left = edge_any(random);
	t.right = edge_any(random);
	t.middle = edge_any(random);
	t.first_row = random.below(tile_size);
	t.last_row = random.below(tile_size - t.first_row);
	t.switch_row = random.below(64);
	t.side = random.below(2);
}

/* A real triangle of a random size, in and around the tile. */
inline bool triangle_real(Random &random, int tile_size, model_triangle &t)
{
	static const int sizes[] = { 1, 4, 10, 32, 63, 200, 1000 };
	int size = 16 * sizes[random.below(7)];
	int x = random.between(-size, 16 * tile_size), y = random.between(-size, 16 * tile_size);
	Point p[3];

	for (Point &point : p)
		point = { x + random.between(0, size), y + random.between(0, size) };
	return triangle_between(p, tile_size, t);
}

/* Does the triangle fit the compact form? */
inline bool triangle_fits(const model_triangle &t)
{
	for (const model_edge *e : { &t.left, &t.right, &t.middle }) {
		if (e->x < -128 || e->x > 127 || e->step < -128 || e->step > 127)
			return false;
		if (e->r > 1023 || e->m > 1023 || e->dy > 1023)
			return false;
	}
	return true;
}

template <typename Group> void edges_set(Group &g, const model_triangle &t)
{
	g = {};
	g.left_x = t.left.x, g.left_step = t.left.step;
	g.left_r = t.left.r, g.left_m = t.left.m, g.left_dy = t.left.dy;
	g.right_x = t.right.x, g.right_step = t.right.step;
	g.right_r = t.right.r, g.right_m = t.right.m, g.right_dy = t.right.dy;
	g.middle_x = t.middle.x, g.middle_step = t.middle.step;
	g.middle_r = t.middle.r, g.middle_m = t.middle.m, g.middle_dy = t.middle.dy;
	g.first_row = t.first_row, g.last_row = t.last_row;
	g.switch_row = t.switch_row, g.side = t.side;
}

/* A packet and where its parts begin. */
struct Record {
	std::vector<uint32_t> header;
	/* edges, depth, alpha, colour; of a small one header to depth, colour, rows */
	std::vector<uint32_t> part[7];

	std::vector<uint32_t> packet() const
	{
		std::vector<uint32_t> words = header;

		for (const std::vector<uint32_t> &p : part)
			words.insert(words.end(), p.begin(), p.end());
		return words;
	}
};

/* Coefficients: any bits, or such that values are often in range. */
inline void surface_words(Random &random, std::vector<uint32_t> &words, unsigned int count)
{
	bool any = random.chance(30);

	for (unsigned int n = 0; n < count; n++) {
		int32_t bits = (int32_t)random.bits();

		words.push_back(any ? bits : bits >> random.between(0, 20));
	}
}

inline Record record_make(Random &random, const model_triangle &t, enum gloss_geometry geometry,
			  enum gloss_shading shading)
{
	static const unsigned int colour_words[] = { GLOSS_COLOUR_FLAT_WORDS,
						     GLOSS_COLOUR_LINEAR_WORDS,
						     GLOSS_COLOUR_SECOND_ORDER_WORDS };
	struct gloss_triangle header = {};
	Record record;

	header.geometry = geometry;
	header.shading = shading;
	header.alpha_linear = random.chance(30);
	header.alpha = header.alpha_linear ? 0 : random.below(256);
	record.header.resize(1);
	gloss_triangle_pack(record.header.data(), &header);

	if (geometry == GLOSS_GEOMETRY_WIDE) {
		struct gloss_edges_wide edges;

		edges_set(edges, t);
		record.part[0].resize(GLOSS_EDGES_WIDE_WORDS);
		gloss_edges_wide_pack(record.part[0].data(), &edges);
	} else if (geometry == GLOSS_GEOMETRY_COMPACT) {
		struct gloss_edges_compact edges;

		edges_set(edges, t);
		record.part[0].resize(GLOSS_EDGES_COMPACT_WORDS);
		gloss_edges_compact_pack(record.part[0].data(), &edges);
	}
	surface_words(random, record.part[1], geometry == GLOSS_GEOMETRY_COMPACT ? 3 : 4);
	if (header.alpha_linear)
		surface_words(random, record.part[2], GLOSS_ALPHA_LINEAR_WORDS);
	surface_words(random, record.part[3], colour_words[shading]);
	return record;
}

/* A row of a small record, mostly with pixels. */
inline uint32_t row_random(Random &random)
{
	uint32_t first = random.below(16), last = random.below(16);

	if (last < first && random.chance(80))
		std::swap(first, last);
	return last << 4 | first;
}

inline Record record_small_make(Random &random, uint32_t first_row, unsigned int rows,
				enum gloss_shading shading)
{
	static const unsigned int colour_words[] = { GLOSS_COLOUR_FLAT_WORDS,
						     GLOSS_COLOUR_LINEAR_SMALL_WORDS,
						     GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS };
	struct gloss_triangle_small header = { .shading = shading };
	struct gloss_pixels_small pixels = {};
	Record record;

	header.row_words = (enum gloss_row_words)((rows + 1) / 4);
	header.alpha = random.below(256);
	pixels.x = random.below(64);
	pixels.first_row = first_row, pixels.last_row = rows - 1;
	pixels.first_0 = random.below(16), pixels.last_0 = random.between(pixels.first_0, 15);
	pixels.first_1 = random.below(16), pixels.last_1 = random.below(16);
	record.part[4].resize(2);
	gloss_triangle_small_pack(&record.part[4][0], &header);
	gloss_pixels_small_pack(&record.part[4][1], &pixels);
	surface_words(random, record.part[4], GLOSS_DEPTH_SMALL_WORDS);
	surface_words(random, record.part[5], colour_words[shading]);
	for (uint32_t n = 0; n < header.row_words; n++)
		record.part[6].push_back(row_random(random) | row_random(random) << 8 |
					 row_random(random) << 16 | row_random(random) << 24);
	return record;
}

inline Record record_small_random(Random &random, int tile_size)
{
	unsigned int rows = random.between(1, random.chance(50) ? 3 : 16);

	return record_small_make(random, random.below(tile_size - rows + 1), rows,
				 (enum gloss_shading)random.below(3));
}

inline Record record_random(Random &random, int tile_size)
{
	if (random.chance(50))
		return record_small_random(random, tile_size);

	model_triangle t = {};
	enum gloss_geometry geometry = GLOSS_GEOMETRY_COVERING;

	if (random.chance(95)) {
		if (random.chance(20) || !triangle_real(random, tile_size, t))
			triangle_any(random, tile_size, t);
		geometry = triangle_fits(t) && random.chance(80) ? GLOSS_GEOMETRY_COMPACT :
								   GLOSS_GEOMETRY_WIDE;
	}
	return record_make(random, t, geometry, (enum gloss_shading)random.below(3));
}

#endif
