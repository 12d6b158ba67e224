// SPDX-License-Identifier: MIT
/*
 * Coefficients of small triangles, rounded to what TRIANGLE_SMALL holds: once a triangle, at its own
 * anchor, so that no picture depends on where tiles begin. What a tile that cuts the triangle asks
 * for is moved from there, and sent small or large as it fits; the bits are the same. small_loop.h does
 * it, and packs the record that is sent where the triangle is in one tile.
 *
 * Differences are rounded from the highest order on, each to where it holds in the triangle's
 * middle with those above it as they have become. So an error counts from the middle, although the
 * anchor may be seven pixels from the triangle.
 */
#include "draw/kernel.h"
#include "draw/small.h"

#define CHANNELS 3

/* The box of more rows than accel_setup has it of. */
static void small_box_row(struct accel_small *small, const struct accel_row *row, int y)
{
	if (row->left >= row->right)
		return;
	if (small->x0 >= small->x1) {
		small->x0 = row->left;
		small->x1 = row->right;
		small->y0 = y;
		small->anchor_x = row->left;
	}
	small->x0 = number_min(small->x0, row->left);
	small->x1 = number_max(small->x1, row->right);
	small->y1 = y + 1;
}

static void small_box(struct accel_small *small, const struct accel_setup *setup)
{
	struct accel_row room[ACCEL_SMALL_SIZE];
	const struct accel_row *row = accel_setup_rows(setup, setup->first, setup->end, room);

	for (int y = setup->first; y < setup->end; y++)
		small_box_row(small, &row[y - setup->first], y);
}

void accel_small_init(struct accel_small *small, const struct accel_setup *setup)
{
	const int rows = setup->end - setup->first;

	*small = (struct accel_small){ .fits = false };
	if (rows > ACCEL_SMALL_SIZE)
		return;
	if (rows > ACCEL_LOOP_ROWS)
		small_box(small, setup);
	else
		*small = (struct accel_small){
			.x0 = setup->box.x0,
			.y0 = setup->box.y0,
			.x1 = setup->box.x1,
			.y1 = setup->box.y1,
			.anchor_x = setup->start,
		};
	small->anchor_x &= ~((int)GLOSS_ANCHOR_ALIGN - 1);
	small->fits = small->x0 < small->x1 && small->x1 - small->x0 <= ACCEL_SMALL_SIZE;
}

static int64_t small_round_depth(int64_t value, unsigned int shift)
{
	return (value + (INT64_C(1) << (shift - 1))) & -(INT64_C(1) << shift);
}

static bool small_depth_fits(int64_t value, unsigned int shift)
{
	int64_t limit = INT64_C(1) << (SMALL_DEPTH_BITS - 1);

	return value >> shift >= -limit && value >> shift < limit;
}

void accel_small_plane(struct accel_depth_plane *plane)
{
	for (unsigned int scale = 0; scale < SMALL_SCALES; scale++) {
		unsigned int shift = small_depth_shift(scale);
		int64_t dx = small_round_depth(plane->dx, shift);
		int64_t dy = small_round_depth(plane->dy, shift);

		if (!small_depth_fits(dx, shift) || !small_depth_fits(dy, shift))
			continue;
		plane->z = small_round_depth(plane->z, GLOSS_SMALL_DEPTH_SHIFT);
		plane->dx = dx;
		plane->dy = dy;
		return;
	}
}

/* A plane in short units; false: it has bits that these have not. */
static bool small_take_plane(struct accel_leaf_batch *batch, int i,
			     const struct accel_depth_plane *plane)
{
	const int64_t rest = (1 << GLOSS_SMALL_DEPTH_SHIFT) - 1;
	int64_t dx = plane->dx >> GLOSS_SMALL_DEPTH_SHIFT,
		dy = plane->dy >> GLOSS_SMALL_DEPTH_SHIFT;

	batch->depth_x[i] = plane->x;
	batch->depth_y[i] = plane->y;
	batch->depth_z[i] = (int32_t)(plane->z >> GLOSS_SMALL_DEPTH_SHIFT);
	batch->depth_dx[i] = (int32_t)dx;
	batch->depth_dy[i] = (int32_t)dy;
	return dx == (int32_t)dx && dy == (int32_t)dy &&
	       !((plane->z | plane->dx | plane->dy) & rest);
}

/* first is above last. */
#define ROW_WITHOUT_PIXEL 1

/* As pixels_small and row words have it. */
static uint32_t small_row(const struct accel_row *row, int x)
{
	return row->left < row->right ? (uint32_t)((row->right - 1 - x) * 16 + row->left - x) :
					ROW_WITHOUT_PIXEL;
}

void accel_small_put(struct accel_leaf_batch *batch, int i, const struct accel_small *small,
		     const struct accel_setup *setup, const struct accel_depth_plane *plane)
{
	struct accel_row room[ACCEL_SMALL_SIZE];
	const struct accel_row *row;

	batch->x0[i] = batch->y0[i] = batch->x1[i] = batch->y1[i] = batch->anchor_x[i] = 0;
	batch->head[i] = 0;
	batch->fits[i] = small->fits && small_take_plane(batch, i, plane) ? ~0u : 0;
	if (!batch->fits[i])
		return;
	batch->x0[i] = small->x0;
	batch->y0[i] = small->y0;
	batch->x1[i] = small->x1;
	batch->y1[i] = small->y1;
	batch->anchor_x[i] = small->anchor_x;
	row = accel_setup_rows(setup, setup->first, setup->end, room) + small->y0 - setup->first;
	batch->head[i] = small_row(&row[0], small->x0) << 16;
	if (small->y1 - small->y0 > 1)
		batch->head[i] |= small_row(&row[1], small->x0) << 24;
}

uint32_t accel_small_words(const struct accel_leaf_batch *batch, int i,
			   const struct accel_setup *setup, uint32_t words[ACCEL_RECORD_WORDS])
{
	const int rows = batch->y1[i] - batch->y0[i], head = GLOSS_SMALL_HEAD_ROWS;
	uint32_t count = batch->words[i];
	struct accel_row room[ACCEL_SMALL_SIZE];
	const struct accel_row *row;

	for (uint32_t j = 0; j < ACCEL_SMALL_WORDS; j++)
		words[j] = batch->word[j][i];
	if (rows <= head)
		return count;
	row = accel_setup_rows(setup, setup->first, setup->end, room) + batch->y0[i] - setup->first;
	for (int j = 0; j < rows - head; j++) {
		const unsigned int place = (unsigned int)j % GLOSS_SMALL_WORD_ROWS;
		uint32_t *word = &words[count + (unsigned int)j / GLOSS_SMALL_WORD_ROWS];

		*word = (place ? *word : 0) | small_row(&row[head + j], batch->x0[i]) << 8 * place;
	}
	return count + ((uint32_t)(rows - head) + 3) / GLOSS_SMALL_WORD_ROWS;
}

void accel_small_surface(struct accel_leaf_batch *batch, int i,
			 const struct accel_triangle *triangle)
{
	struct accel_fit_batch *fit = &batch->fit;

	fit->at_x[i] = triangle->x;
	fit->at_y[i] = triangle->y;
	fit->form[i] = triangle->shading;
	for (int j = 0; j < CHANNELS; j++) {
		const struct accel_surface *surface = &triangle->channel[j];

		fit->surface[j].i[i] = (int32_t)surface->i;
		fit->surface[j].dx[i] = (int32_t)surface->dx;
		fit->surface[j].dy[i] = (int32_t)surface->dy;
		fit->surface[j].dxx[i] = (int32_t)surface->dxx;
		fit->surface[j].dxy[i] = (int32_t)surface->dxy;
		fit->surface[j].dyy[i] = (int32_t)surface->dyy;
	}
	for (int j = 0; j < 4; j++)
		fit->level[j][i] = triangle->constant[j];
	if (triangle->alpha_linear)
		batch->fits[i] = 0;
}

void accel_small_take(const struct accel_leaf_batch *batch, int i, struct accel_triangle *triangle)
{
	triangle->small.fits = batch->fits[i];
	if (!batch->fits[i])
		return;
	triangle->small.depth_scale = batch->depth_scale[i];
	if (triangle->shading == GLOSS_SHADING_FLAT)
		return;
	triangle->x = batch->anchor_x[i];
	triangle->y = batch->y0[i];
	for (int j = 0; j < CHANNELS; j++) {
		const struct accel_surface_batch *from = &batch->fit.surface[j];

		triangle->channel[j] = (struct accel_surface){
			(uint32_t)from->i[i],   (uint32_t)from->dx[i],  (uint32_t)from->dy[i],
			(uint32_t)from->dxx[i], (uint32_t)from->dxy[i], (uint32_t)from->dyy[i],
		};
	}
}
