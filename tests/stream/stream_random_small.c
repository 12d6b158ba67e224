// SPDX-License-Identifier: MIT
/* Random TRIANGLE_SMALL packets: rows that narrow and lean as a triangle's do, or any rows at all. */
#include "stream_random.h"

#define below stream_random_below
#define between stream_random_between
#define chance stream_random_chance

#define ROWS_MAX 16

static int32_t clamp(int32_t value)
{
	return value < 0 ? 0 : value > 15 ? 15 : value;
}

static void real_rows(struct stream_random *r, uint8_t row[ROWS_MAX + 2])
{
	int32_t left = between(r, 0, 15), right = between(r, left, 15);
	int32_t left_step = between(r, -2, 2), right_step = between(r, -2, 2);

	for (int n = 0; n < ROWS_MAX; n++) {
		row[n] = (uint8_t)(clamp(right) << 4 | clamp(left));
		left += left_step;
		right += right_step;
	}
}

static void random_rows(struct stream_random *r, uint8_t row[ROWS_MAX + 2])
{
	if (!chance(r, 25)) {
		real_rows(r, row);
		return;
	}
	for (int n = 0; n < ROWS_MAX; n++)
		row[n] = (uint8_t)stream_random_word(r);
}

static void random_pixels(struct stream_random *r, uint32_t rows, const uint8_t *row)
{
	uint32_t x = below(r, chance(r, 20) ? 64 : (uint32_t)r->tile_size);
	uint32_t first_row = below(r, (uint32_t)r->tile_size - rows + 1);
	uint32_t word;

	gloss_pixels_small_pack(&word, &(struct gloss_pixels_small){
					       .x = x,
					       .first_row = first_row,
					       .last_row = rows - 1,
					       .first_0 = row[0] & 15u,
					       .last_0 = row[0] >> 4,
					       .first_1 = row[1] & 15u,
					       .last_1 = row[1] >> 4,
				       });
	stream_random_emit(r, word);
}

/* A number of up to @bits bits of random size and sign. */
static int32_t spread(struct stream_random *r, int bits)
{
	int32_t value = (int32_t)(stream_random_word(r) >> 1);

	value >>= between(r, 32 - bits, 31);
	return chance(r, 50) ? value : -value;
}

static void random_depth(struct stream_random *r)
{
	uint32_t words[GLOSS_DEPTH_SMALL_WORDS];
	struct gloss_depth_small depth;

	depth.z = chance(r, 15) ? (int32_t)stream_random_word(r) : (int32_t)below(r, 1 << 28);
	depth.dx = spread(r, 15);
	depth.dy = spread(r, 15);
	depth.scale = below(r, chance(r, 70) ? 2 : 4);
	gloss_depth_small_pack(words, &depth);
	stream_random_emit(r, words[0]);
	stream_random_emit(r, words[1]);
}

static uint32_t random_slopes(struct stream_random *r)
{
	uint32_t dx = (uint32_t)spread(r, 12) & 0xfff, dy = (uint32_t)spread(r, 12) & 0xfff;

	return dx << 8 | dy << 20 | below(r, 256);
}

static uint32_t random_bends(struct stream_random *r)
{
	uint32_t dxx = (uint32_t)spread(r, 10) & 0x3ff, dxy = (uint32_t)spread(r, 10) & 0x3ff;
	uint32_t dyy = (uint32_t)spread(r, 10) & 0x3ff;

	return dxx | dxy << 10 | dyy << 20 | below(r, 4) << 30;
}

/* Whole parts of the values, and the scale of the differences. */
static uint32_t random_values(struct stream_random *r)
{
	uint32_t red = below(r, 256), green = below(r, 256), blue = below(r, 256);

	return red | green << 10 | blue << 20 | below(r, 3) << 30;
}

static void random_colour(struct stream_random *r, enum gloss_shading shading)
{
	bool wild = chance(r, 15);

	if (shading == GLOSS_SHADING_FLAT) {
		stream_random_emit(r, below(r, 1 << 24));
		return;
	}
	stream_random_emit(r, wild ? stream_random_word(r) : random_values(r));
	for (int channel = 0; channel < 3; channel++)
		stream_random_emit(r, random_slopes(r));
	for (int channel = 0; channel < 3 && shading == GLOSS_SHADING_SECOND_ORDER; channel++)
		stream_random_emit(r, random_bends(r));
}

void stream_random_small(struct stream_random *r)
{
	uint32_t rows = (uint32_t)between(r, 1, chance(r, 60) ? 4 : ROWS_MAX), header;
	uint32_t sent = GLOSS_SMALL_HEAD_ROWS;
	struct gloss_triangle_small p;
	uint8_t row[ROWS_MAX + 2] = { 0 };

	p.shading = (enum gloss_shading)below(r, 3);
	p.row_words = (enum gloss_row_words)((rows + 1) / GLOSS_SMALL_WORD_ROWS);
	if (p.row_words < GLOSS_ROW_WORDS_FOUR && chance(r, 5))
		p.row_words++;
	p.alpha = below(r, 256);
	gloss_triangle_small_pack(&header, &p);
	stream_random_emit(r, header);
	random_rows(r, row);
	random_pixels(r, rows, row);
	random_depth(r);
	random_colour(r, p.shading);
	for (uint32_t n = 0; n < p.row_words; n++, sent += GLOSS_SMALL_WORD_ROWS)
		stream_random_emit(r, (uint32_t)row[sent] | (uint32_t)row[sent + 1] << 8 |
					      (uint32_t)row[sent + 2] << 16 |
					      (uint32_t)row[sent + 3] << 24);
}
