// SPDX-License-Identifier: MIT
/* One TRIANGLE_SMALL packet, if a triangle's numbers at the tile's anchor are such as it has. */
#include "draw/triangle.h"
#include "draw/small.h"

#define CHANNELS 3

/* first is above last. */
#define ROW_WITHOUT_PIXEL 1

/* The rows of a place, as in the packet. */
struct rows {
	int x, count;
	uint8_t row[GLOSS_SMALL_HEAD_ROWS + 4 * GLOSS_SMALL_WORD_ROWS];
};

static int rows_left(const struct accel_place *place, int i)
{
	return number_max(place->row[i].left - place->x, 0);
}

static int rows_right(const struct accel_place *place, int i)
{
	return number_min(place->row[i].right - place->x, place->tile_size);
}

static void rows_init(struct rows *rows, const struct accel_place *place)
{
	*rows = (struct rows){ .x = place->tile_size, .count = place->end - place->first };
	for (int i = 0; i < rows->count; i++)
		if (rows_left(place, i) < rows_right(place, i))
			rows->x = number_min(rows_left(place, i), rows->x);
	for (int i = 0; i < rows->count; i++) {
		int first = rows_left(place, i) - rows->x;
		int last = rows_right(place, i) - 1 - rows->x;

		rows->row[i] = (uint8_t)(first > last ? ROW_WITHOUT_PIXEL : last * 16 + first);
	}
}

static enum gloss_row_words rows_words(const struct rows *rows)
{
	int rest = rows->count - (int)GLOSS_SMALL_HEAD_ROWS;

	if (rest <= 0)
		return GLOSS_ROW_WORDS_NONE;
	return (enum gloss_row_words)((unsigned int)(rest + 3) / GLOSS_SMALL_WORD_ROWS);
}

static uint32_t rows_pack(uint32_t *words, const struct rows *rows)
{
	uint32_t count = rows_words(rows);

	for (uint32_t i = 0; i < count; i++) {
		const uint8_t *row = &rows->row[GLOSS_SMALL_HEAD_ROWS + i * GLOSS_SMALL_WORD_ROWS];

		words[i] = (uint32_t)row[0] | (uint32_t)row[1] << 8 | (uint32_t)row[2] << 16 |
			   (uint32_t)row[3] << 24;
	}
	return count;
}

static void pack_pixels(uint32_t *words, const struct accel_place *place, const struct rows *rows)
{
	gloss_pixels_small_pack(words, &(struct gloss_pixels_small){
					       .x = (uint32_t)rows->x,
					       .first_row = (uint32_t)(place->first - place->y),
					       .last_row = (uint32_t)rows->count - 1,
					       .first_0 = rows->row[0] & 15u,
					       .last_0 = rows->row[0] >> 4,
					       .first_1 = rows->row[1] & 15u,
					       .last_1 = rows->row[1] >> 4,
				       });
}

static void pack_depth(uint32_t *words, const struct accel_triangle *triangle, int x, int y)
{
	const struct accel_depth_plane *plane = triangle->plane;
	int64_t z = plane->z + (x - plane->x) * plane->dx + (y - plane->y) * plane->dy;
	unsigned int shift = small_depth_shift(triangle->small.depth_scale);

	gloss_depth_small_pack(words, &(struct gloss_depth_small){
					      .z = (int32_t)(z >> GLOSS_SMALL_DEPTH_SHIFT),
					      .dx = (int32_t)(plane->dx >> shift),
					      .dy = (int32_t)(plane->dy >> shift),
					      .scale = triangle->small.depth_scale,
				      });
}

/*
 * The scale at which numbers fit in @bits, the scales @step apart from @unit on. @together are the
 * numbers' magnitudes, @bits_set their bits, each or-ed. false: they do not fit, or not exactly.
 */
static bool find_scale(uint32_t together, uint32_t bits_set, unsigned int unit, unsigned int step,
		       unsigned int bits, uint32_t *scale)
{
	unsigned int shift = unit;

	for (*scale = 0; *scale < SMALL_SCALES && together >> (shift + bits - 1); ++*scale)
		shift += step;
	return *scale < SMALL_SCALES && !(bits_set & ((1u << shift) - 1));
}

/* A value that was moved by second differences may have bits below those of a value, too. */
static bool find_slope_scale(const struct accel_surface surface[CHANNELS], uint32_t *scale)
{
	uint32_t together = 0, bits_set = 0, value = 0;

	for (int i = 0; i < CHANNELS; i++) {
		together |= small_magnitude(surface[i].dx) | small_magnitude(surface[i].dy);
		bits_set |= surface[i].dx | surface[i].dy;
		value |= surface[i].i;
	}
	return !(value & ((1u << GLOSS_SMALL_SLOPE_SHIFT) - 1)) &&
	       find_scale(together, bits_set, GLOSS_SMALL_SLOPE_SHIFT,
			  GLOSS_SMALL_SLOPE_SCALE_SHIFT, SMALL_SLOPE_BITS, scale);
}

static bool find_bend_scale(const struct accel_surface *s, uint32_t *scale)
{
	return find_scale(small_magnitude(s->dxx) | small_magnitude(s->dxy) |
				  small_magnitude(s->dyy),
			  s->dxx | s->dxy | s->dyy, GLOSS_SMALL_BEND_SHIFT,
			  GLOSS_SMALL_BEND_SCALE_SHIFT, SMALL_BEND_BITS, scale);
}

static int32_t shifted(uint32_t value, unsigned int shift)
{
	return (int32_t)value >> shift;
}

static uint32_t fraction(uint32_t value)
{
	return value >> GLOSS_SMALL_SLOPE_SHIFT & 0xff;
}

static void pack_linear(uint32_t *words, const struct accel_surface surface[CHANNELS],
			uint32_t scale)
{
	unsigned int shift = small_slope_shift(scale);
	const struct accel_surface *red = &surface[0], *green = &surface[1], *blue = &surface[2];

	gloss_colour_linear_small_pack(words,
				       &(struct gloss_colour_linear_small){
					       .red = shifted(red->i, GLOSS_COLOUR_FRACTION),
					       .green = shifted(green->i, GLOSS_COLOUR_FRACTION),
					       .blue = shifted(blue->i, GLOSS_COLOUR_FRACTION),
					       .slope_scale = scale,
					       .red_fraction = fraction(red->i),
					       .red_dx = shifted(red->dx, shift),
					       .red_dy = shifted(red->dy, shift),
					       .green_fraction = fraction(green->i),
					       .green_dx = shifted(green->dx, shift),
					       .green_dy = shifted(green->dy, shift),
					       .blue_fraction = fraction(blue->i),
					       .blue_dx = shifted(blue->dx, shift),
					       .blue_dy = shifted(blue->dy, shift),
				       });
}

/* The word of a channel: dxx, dxy, dyy and their scale are in the same bits of each. */
static bool pack_bends(uint32_t *words, const struct accel_surface *s)
{
	const uint32_t mask = (1u << SMALL_BEND_BITS) - 1;
	unsigned int shift;
	uint32_t scale;

	if (!find_bend_scale(s, &scale))
		return false;
	shift = small_bend_shift(scale);
	*words = (s->dxx >> shift & mask) | (s->dxy >> shift & mask) << SMALL_BEND_BITS |
		 (s->dyy >> shift & mask) << 2 * SMALL_BEND_BITS | scale << 3 * SMALL_BEND_BITS;
	return true;
}

/* Words of the colour; 0: it does not fit. */
static uint32_t pack_colour(uint32_t *words, const struct accel_triangle *triangle, int x, int y)
{
	uint32_t u = (uint32_t)(x - triangle->x), v = (uint32_t)(y - triangle->y), scale;
	struct accel_surface surface[CHANNELS];

	if (triangle->shading == GLOSS_SHADING_FLAT)
		return accel_record_flat(words, triangle->constant);
	for (int i = 0; i < CHANNELS; i++)
		accel_record_surface_at(&triangle->channel[i], u, v, &surface[i]);
	if (!find_slope_scale(surface, &scale))
		return 0;
	pack_linear(words, surface, scale);
	if (triangle->shading == GLOSS_SHADING_LINEAR)
		return GLOSS_COLOUR_LINEAR_SMALL_WORDS;
	words += GLOSS_COLOUR_LINEAR_SMALL_WORDS;
	for (int i = 0; i < CHANNELS; i++)
		if (!pack_bends(&words[i], &surface[i]))
			return 0;
	return GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS;
}

uint32_t accel_record_small(uint32_t words[ACCEL_RECORD_WORDS],
			    const struct accel_triangle *triangle, const struct accel_place *place)
{
	int x = accel_record_anchor_x(place);
	uint32_t count = 1 + GLOSS_PIXELS_SMALL_WORDS + GLOSS_DEPTH_SMALL_WORDS, colour;
	struct rows rows;

	colour = pack_colour(words + count, triangle, x, place->first);
	if (!colour)
		return 0;
	rows_init(&rows, place);
	gloss_triangle_small_pack(words, &(struct gloss_triangle_small){
						 .shading = triangle->shading,
						 .row_words = rows_words(&rows),
						 .alpha = triangle->constant[3],
					 });
	pack_pixels(words + 1, place, &rows);
	pack_depth(words + 1 + GLOSS_PIXELS_SMALL_WORDS, triangle, x, place->first);
	count += colour;
	return count + rows_pack(words + count, &rows);
}
