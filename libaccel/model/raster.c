// SPDX-License-Identifier: MIT
/*
 * Edges to spans. An edge is stepped in remainder form: x is the exact ceiling
 * of the edge's place in a row, r what the division left over, so there is
 * nothing to round.
 *
 * The registers are the core's. x and step have 13 bits: x + step + carry keeps
 * the low 13, and columns compare as signed 13-bit numbers. r, m and dy have 16
 * bits: r + m loses its carry, and the sum that is left is compared with dy and
 * reduced by it, unsigned. Any values are therefore legal; only those a division
 * can give mean anything.
 *
 * A small triangle has no edges: its rows are listed.
 */
#include "lanes.h"

MODEL_INLINE int32_t sign13(uint32_t x)
{
	return (int32_t)(x << 19) >> 19;
}

MODEL_INLINE void edge_step(struct model_edge *edge)
{
	uint32_t r = (edge->r + edge->m) & 0xffff;
	uint32_t carry = r >= edge->dy;

	edge->r = carry ? r - edge->dy : r;
	edge->x = sign13((uint32_t)edge->x + (uint32_t)edge->step + carry);
}

/* A row that is listed; without a pixel x1 is not above x0. */
MODEL_INLINE void row_listed(const struct model_triangle *triangle, int row, int32_t *x0,
			     int32_t *x1)
{
	*x0 = triangle->x + (triangle->row[row] & 15);
	*x1 = triangle->x + (triangle->row[row] >> 4) + 1;
}

/* From the row before to walk->row. */
MODEL_INLINE void walk_step(struct model_walk *walk)
{
	const struct model_triangle *triangle = walk->triangle;

	edge_step(&walk->left);
	edge_step(&walk->right);
	if (walk->row != triangle->switch_row)
		return;
	if (triangle->side)
		walk->right = triangle->middle;
	else
		walk->left = triangle->middle;
}

MODEL_INLINE bool walk_next(struct model_walk *walk, const struct model_scissor *scissor,
			    struct model_span *span)
{
	while (walk->row <= walk->triangle->last_row) {
		if (walk->triangle->listed)
			row_listed(walk->triangle, walk->row, &walk->left.x, &walk->right.x);
		else if (walk->row)
			walk_step(walk);
		span->y = walk->triangle->first_row + walk->row++;
		span->x0 = walk->left.x > scissor->x0 ? walk->left.x : scissor->x0;
		span->x1 = walk->right.x < scissor->x1 ? walk->right.x : scissor->x1;
		if (span->x0 < span->x1 && span->y >= scissor->y0 && span->y < scissor->y1)
			return true;
	}
	return false;
}

void model_raster_begin(struct model_walk *walk, const struct model_triangle *triangle)
{
	walk->triangle = triangle;
	walk->left = triangle->left;
	walk->right = triangle->right;
	walk->row = 0;
}

bool model_raster_next(struct model_walk *walk, const struct model_scissor *scissor,
		       struct model_span *span)
{
	return walk_next(walk, scissor, span);
}

/* What the rows come to together, apart from the walk: rows side by side. */
MODEL_INLINE void sum_up(struct model_spans *spans, int rows)
{
	int lanes = model_lanes(rows), longest = 0, blocks = 0, pixels = 0;

	for (int n = rows; n < rows + MODEL_LANES; n++)
		spans->y[n] = spans->x0[n] = spans->count[n] = 0;
	for (int n = 0; n < lanes; n++) {
		longest = spans->count[n] > longest ? spans->count[n] : longest;
		blocks += model_lanes(spans->count[n]) / MODEL_LANES;
		pixels += spans->count[n];
	}
	spans->rows = rows;
	spans->longest = longest;
	spans->blocks = blocks;
	spans->pixels = pixels;
}

MODEL_CLONES
void model_raster_spans(const struct model_triangle *triangle, const struct model_scissor *scissor,
			struct model_spans *spans)
{
	const struct model_scissor clip = *scissor;
	struct model_walk walk;
	struct model_span span;
	int rows = 0;

	model_raster_begin(&walk, triangle);
	for (; walk_next(&walk, &clip, &span); rows++) {
		spans->y[rows] = span.y;
		spans->x0[rows] = span.x0;
		spans->count[rows] = span.x1 - span.x0;
	}
	sum_up(spans, rows);
}

int model_raster_anchor(const struct model_triangle *triangle, int tile_size)
{
	int x = triangle->left.x;

	if (x < 0)
		x = 0;
	if (x > tile_size - 1)
		x = tile_size - 1;
	return x & ~((int)GLOSS_ANCHOR_ALIGN - 1);
}
