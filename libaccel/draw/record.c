// SPDX-License-Identifier: MIT
/* One TRIANGLE packet: a triangle's edges and surfaces, as a tile has them. record_small.c has the
 * short form. */
#include "draw/triangle.h"

int accel_record_anchor_x(const struct accel_place *place)
{
	int x = place->covering ? 0 : place->row->left - place->x;

	x = number_clamp(x, 0, place->tile_size - 1);
	return place->x + (x & ~((int)GLOSS_ANCHOR_ALIGN - 1));
}

static void record_edges_wide(struct gloss_edges_wide *edges, const struct accel_setup *setup,
			      const struct accel_place *place)
{
	const struct accel_line *left = accel_setup_line(setup, place->first, false);
	const struct accel_line *right = accel_setup_line(setup, place->first, true);
	uint32_t left_r, right_r;

	accel_setup_at(left, place->first, &left_r);
	accel_setup_at(right, place->first, &right_r);
	*edges = (struct gloss_edges_wide){
		.left_x = place->row->left - place->x,
		.left_step = left->step,
		.left_r = left_r,
		.left_m = left->m,
		.left_dy = (uint32_t)left->dy,
		.first_row = (uint32_t)(place->first - place->y),
		.last_row = (uint32_t)(place->end - place->first - 1),
		.right_x = place->row->right - place->x,
		.right_step = right->step,
		.right_r = right_r,
		.right_m = right->m,
		.right_dy = (uint32_t)right->dy,
	};
	if (setup->turn <= place->first || setup->turn >= place->end)
		return;
	edges->switch_row = (uint32_t)(setup->turn - place->first);
	edges->side = setup->right_turns;
	edges->middle_x = accel_setup_at(&setup->middle, setup->turn, &edges->middle_r) - place->x;
	edges->middle_step = setup->middle.step;
	edges->middle_m = setup->middle.m;
	edges->middle_dy = (uint32_t)setup->middle.dy;
}

static uint32_t record_pack_edges_wide(uint32_t *words, const struct accel_setup *setup,
				       const struct accel_place *place)
{
	struct gloss_edges_wide edges;

	record_edges_wide(&edges, setup, place);
	gloss_edges_wide_pack(words, &edges);
	return GLOSS_EDGES_WIDE_WORDS;
}

static uint32_t record_pack_edges_compact(uint32_t *words, const struct accel_setup *setup,
					  const struct accel_place *place)
{
	struct gloss_edges_wide wide;

	record_edges_wide(&wide, setup, place);
	gloss_edges_compact_pack(words, &(struct gloss_edges_compact){
						.left_r = wide.left_r,
						.left_m = wide.left_m,
						.left_dy = wide.left_dy,
						.left_x = wide.left_x,
						.left_step = wide.left_step,
						.first_row = wide.first_row,
						.last_row = wide.last_row,
						.right_r = wide.right_r,
						.right_m = wide.right_m,
						.right_dy = wide.right_dy,
						.right_x = wide.right_x,
						.right_step = wide.right_step,
						.switch_row = wide.switch_row,
						.side = wide.side,
						.middle_r = wide.middle_r,
						.middle_m = wide.middle_m,
						.middle_dy = wide.middle_dy,
						.middle_x = wide.middle_x,
						.middle_step = wide.middle_step,
					});
	return GLOSS_EDGES_COMPACT_WORDS;
}

static uint32_t record_high_byte(int64_t value)
{
	return (uint32_t)((uint64_t)value >> 32) & 0xff;
}

static uint32_t record_pack_depth_wide(uint32_t *words, int64_t z, int64_t dx, int64_t dy)
{
	gloss_depth_wide_pack(words, &(struct gloss_depth_wide){
					     .z = (uint32_t)z,
					     .dx = (uint32_t)dx,
					     .dy = (uint32_t)dy,
					     .z_high = record_high_byte(z),
					     .dx_high = record_high_byte(dx),
					     .dy_high = record_high_byte(dy),
				     });
	return GLOSS_DEPTH_WIDE_WORDS;
}

static uint32_t record_pack_depth_compact(uint32_t *words, int64_t z, int64_t dx, int64_t dy)
{
	gloss_depth_compact_pack(words, &(struct gloss_depth_compact){
						.z = (int32_t)(z >> GLOSS_DEPTH_COMPACT_SHIFT),
						.dx = (int32_t)(dx >> GLOSS_DEPTH_COMPACT_SHIFT),
						.dy = (int32_t)(dy >> GLOSS_DEPTH_COMPACT_SHIFT),
					});
	return GLOSS_DEPTH_COMPACT_WORDS;
}

static uint32_t record_pack_depth(uint32_t *words, const struct accel_depth_plane *plane,
				  bool compact, int x, int y)
{
	int64_t z = plane->z + (x - plane->x) * plane->dx + (y - plane->y) * plane->dy;

	return compact ? record_pack_depth_compact(words, z, plane->dx, plane->dy) :
			 record_pack_depth_wide(words, z, plane->dx, plane->dy);
}

void accel_record_surface_at(const struct accel_surface *surface, uint32_t u, uint32_t v,
			     struct accel_surface *moved)
{
	/* Products of neighbours: u (u - 1) / 2 is whole before it wraps. */
	uint32_t uu = (uint32_t)((int64_t)(int32_t)u * ((int32_t)u - 1) / 2);
	uint32_t vv = (uint32_t)((int64_t)(int32_t)v * ((int32_t)v - 1) / 2);

	*moved = *surface;
	moved->i += u * surface->dx + v * surface->dy + uu * surface->dxx + vv * surface->dyy +
		    u * v * surface->dxy;
	moved->dx += u * surface->dxx + v * surface->dxy;
	moved->dy += v * surface->dyy + u * surface->dxy;
}

/* The words of a linear form are the first three of a second-order one. */
static uint32_t record_pack_surface(uint32_t *words, const struct accel_surface *surface,
				    uint32_t u, uint32_t v, bool linear)
{
	struct accel_surface moved;

	accel_record_surface_at(surface, u, v, &moved);
	words[0] = moved.i;
	words[1] = moved.dx;
	words[2] = moved.dy;
	if (linear)
		return 3;
	words[3] = moved.dxx;
	words[4] = moved.dxy;
	words[5] = moved.dyy;
	return 6;
}

uint32_t accel_record_flat(uint32_t *words, const uint8_t constant[4])
{
	gloss_colour_flat_pack(words, &(struct gloss_colour_flat){ constant[0], constant[1],
								   constant[2] });
	return GLOSS_COLOUR_FLAT_WORDS;
}

static uint32_t record_pack_colour(uint32_t *words, const struct accel_triangle *triangle, int x,
				   int y)
{
	uint32_t u = (uint32_t)(x - triangle->x), v = (uint32_t)(y - triangle->y), count = 0;
	bool flat = triangle->shading == GLOSS_SHADING_FLAT;
	bool linear = triangle->shading == GLOSS_SHADING_LINEAR;

	if (triangle->alpha_linear)
		count += record_pack_surface(words, &triangle->channel[3], u, v, true);
	for (int i = 0; i < 3 && !flat; i++)
		count += record_pack_surface(words + count, &triangle->channel[i], u, v, linear);
	return flat ? count + accel_record_flat(words + count, triangle->constant) : count;
}

static uint32_t record_pack_large(uint32_t *words, const struct accel_triangle *triangle,
				  const struct accel_place *place)
{
	bool compact = !place->covering && triangle->setup.narrow && triangle->plane->narrow;
	int x = accel_record_anchor_x(place);
	uint32_t count = 1;

	gloss_triangle_pack(words,
			    &(struct gloss_triangle){
				    .geometry = place->covering ? GLOSS_GEOMETRY_COVERING :
						compact         ? GLOSS_GEOMETRY_COMPACT :
								  GLOSS_GEOMETRY_WIDE,
				    .shading = triangle->shading,
				    .alpha_linear = triangle->alpha_linear,
				    .alpha = triangle->alpha_linear ? 0 : triangle->constant[3],
			    });
	if (compact)
		count += record_pack_edges_compact(words + count, &triangle->setup, place);
	else if (!place->covering)
		count += record_pack_edges_wide(words + count, &triangle->setup, place);
	count += record_pack_depth(words + count, triangle->plane, compact, x, place->first);
	return count + record_pack_colour(words + count, triangle, x, place->first);
}

uint32_t accel_record_pack(uint32_t words[ACCEL_RECORD_WORDS],
			   const struct accel_triangle *triangle, const struct accel_place *place)
{
	uint32_t count = 0;

	if (triangle->small.fits)
		count = accel_record_small(words, triangle, place);
	return count ? count : record_pack_large(words, triangle, place);
}

uint32_t accel_record_fill(uint32_t words[ACCEL_RECORD_WORDS], uint32_t colour, uint32_t depth)
{
	uint32_t count = 1;

	gloss_triangle_pack(words, &(struct gloss_triangle){
					   .geometry = GLOSS_GEOMETRY_COVERING,
					   .shading = GLOSS_SHADING_FLAT,
					   .alpha = colour >> 24,
				   });
	count += record_pack_depth_wide(words + count, (int64_t)depth << GLOSS_DEPTH_FRACTION, 0,
					0);
	gloss_colour_flat_pack(words + count, &(struct gloss_colour_flat){
						      .red = colour & 0xff,
						      .green = colour >> 8 & 0xff,
						      .blue = colour >> 16 & 0xff,
					      });
	return count + GLOSS_COLOUR_FLAT_WORDS;
}
