/* SPDX-License-Identifier: MIT */
/* What the tests of drawing share: triangles by their corners, and which pixels records draw. */
#ifndef DRAW_TEST_H
#define DRAW_TEST_H

#include "accel_test.h"
#include "draw/bin.h"
#include "model/model.h"

/* A vertex at (x, y) in 1/16 pixel. */
static inline struct accel_vertex vertex_at(int x, int y)
{
	const int one = ACCEL_WINDOW_ONE >> ACCEL_SNAP_BITS;

	return (struct accel_vertex){
		.x = x * one,
		.y = y * one,
		.w = 1,
		.length = 1,
		.paint = { 1, 1, 1, 1 },
	};
}

static inline float test_unit(uint64_t *seed)
{
	return (float)(test_random(seed) >> 40) * 0x1p-24f;
}

/* From @low to @high - 1. */
static inline int test_between(uint64_t *seed, int low, int high)
{
	return low + (int)test_below(seed, (uint32_t)(high - low));
}

/* Is the pixel inside by its edge functions: left and top edges are, others are not. */
static inline bool edge_functions_inside(const struct accel_vertex *const vertex[3], int x, int y)
{
	bool turned = accel_surface_area(vertex[0], vertex[1], vertex[2]) < 0;
	int64_t px = (int64_t)x * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF;
	int64_t py = (int64_t)y * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF;

	for (int i = 0; i < 3; i++) {
		const struct accel_vertex *a = vertex[turned ? (i + 1) % 3 : i];
		const struct accel_vertex *b = vertex[turned ? i : (i + 1) % 3];
		int64_t dx = b->x - a->x, dy = b->y - a->y;
		int64_t side = dx * (py - a->y) - dy * (px - a->x);

		if (side < 0 || (side == 0 && !(dy < 0 || (dy == 0 && dx > 0))))
			return false;
	}
	return true;
}

/* A flat triangle that is ready for the bin; false: it crosses no row. */
static inline bool triangle_ready(struct accel_triangle *triangle, struct accel_depth_plane *plane,
				  const struct accel_vertex *const vertex[3])
{
	static const float white[4] = { 1, 1, 1, 1 };
	const double depth[3] = { vertex[0]->z, vertex[1]->z, vertex[2]->z };
	struct accel_basis basis;

	memset(triangle, 0, sizeof(*triangle));
	if (!accel_setup_init(&triangle->setup, vertex))
		return false;
	accel_surface_basis(&basis, vertex);
	accel_surface_plane(plane, &basis, depth, triangle->setup.narrow);
	triangle->plane = plane;
	accel_surface_flat(triangle, white);
	return true;
}

/* Called for each triangle's packet of a bin. */
typedef void (*record_fn)(void *data, const uint32_t *packet, int tile_x, int tile_y,
			  int tile_size);

static inline uint32_t packet_words(uint32_t header)
{
	assert_true(gloss_opcode_known(gloss_header_opcode(header)));
	assert_true(gloss_header_valid(header));
	return 1 + gloss_header_length(header);
}

/* A triangle's packet of either kind. */
static inline void record_unpack(const uint32_t *packet, int tile_size,
				 struct model_triangle *triangle)
{
	if (gloss_header_opcode(packet[0]) == GLOSS_OP_TRIANGLE_SMALL)
		model_triangle_small_unpack(packet, triangle);
	else
		model_triangle_unpack(packet, tile_size, triangle);
}

static inline void records_of_words(const uint32_t *words, uint32_t count, record_fn call,
				    void *data, int x, int y, int tile_size)
{
	while (count) {
		uint32_t length = packet_words(words[0]);
		struct gloss_triangle_small header_small;
		struct gloss_triangle header;

		assert_true(length <= count);
		if (gloss_header_opcode(words[0]) == GLOSS_OP_TRIANGLE) {
			gloss_triangle_unpack(words, &header);
			assert_int_equal(length, 1 + gloss_triangle_length(&header));
			if (header.geometry == GLOSS_GEOMETRY_WIDE)
				assert_int_equal(gloss_edges_wide_invalid(words + 1), -1);
			if (header.geometry == GLOSS_GEOMETRY_COMPACT)
				assert_int_equal(gloss_edges_compact_invalid(words + 1), -1);
			call(data, words, x, y, tile_size);
		} else if (gloss_header_opcode(words[0]) == GLOSS_OP_TRIANGLE_SMALL) {
			gloss_triangle_small_unpack(words, &header_small);
			assert_int_equal(length, 1 + gloss_triangle_small_length(&header_small));
			call(data, words, x, y, tile_size);
		}
		words += length;
		count -= length;
	}
}

static inline void records_of_bin(const struct accel_bin *bin, record_fn call, void *data)
{
	for (int i = 0; i < bin->columns * bin->rows; i++) {
		const struct accel_tile *tile = &bin->tile[i];
		uint32_t *words = malloc(tile->words * sizeof(*words) + 1), count = 0;

		assert_non_null(words);
		for (const struct accel_chunk *c = tile->chunk; c; c = c->next) {
			memcpy(words + count, c->words, c->used * sizeof(*words));
			count += c->used;
		}
		assert_int_equal(count, tile->words);
		records_of_words(words, count, call, data, i % bin->columns * bin->tile_size,
				 i / bin->columns * bin->tile_size, bin->tile_size);
		free(words);
	}
}

/* How often each pixel is drawn; a record that draws nothing is counted too. */
struct coverage {
	int pitch, rows;
	uint8_t *count;
	long drawn;
	int empty;
};

static inline void coverage_record(void *data, const uint32_t *packet, int tile_x, int tile_y,
				   int tile_size)
{
	const struct model_scissor scissor = { 0, 0, tile_size, tile_size };
	struct coverage *coverage = data;
	struct model_triangle triangle;
	struct model_walk walk;
	struct model_span span;
	bool empty = true;

	record_unpack(packet, tile_size, &triangle);
	assert_true(triangle.first_row + triangle.last_row < tile_size);
	model_raster_begin(&walk, &triangle);
	while (model_raster_next(&walk, &scissor, &span)) {
		empty = false;
		for (int x = span.x0; x < span.x1; x++)
			coverage->count[(tile_y + span.y) * coverage->pitch + tile_x + x]++;
		coverage->drawn += span.x1 - span.x0;
	}
	coverage->empty += empty;
}

/* What records draw, the last of them on top. */
struct picture {
	int pitch;
	uint32_t *colour, *depth;
};

static inline void picture_record(void *data, const uint32_t *packet, int tile_x, int tile_y,
				  int tile_size)
{
	const struct model_scissor scissor = { 0, 0, tile_size, tile_size };
	uint32_t colour[MODEL_TILE_MAX], depth[MODEL_TILE_MAX];
	const struct picture *picture = data;
	struct model_triangle triangle;
	struct model_walk walk;
	struct model_span span;

	record_unpack(packet, tile_size, &triangle);
	model_raster_begin(&walk, &triangle);
	while (model_raster_next(&walk, &scissor, &span)) {
		int at = (tile_y + span.y) * picture->pitch + tile_x + span.x0;

		model_shade_span(&triangle, model_raster_anchor(&triangle, tile_size), &span,
				 colour, depth);
		for (int i = 0; i < span.x1 - span.x0; i++) {
			picture->colour[at + i] = colour[i];
			picture->depth[at + i] = depth[i];
		}
	}
}

#endif
