// SPDX-License-Identifier: MIT
/* The forms a TRIANGLE is sent in, to the one the stages take. */
#include <string.h>

#include "model.h"

/* Wide and compact edges differ in the places of the fields, not in their names. */
#define EDGES_SET(triangle, edges)                                                                 \
	do {                                                                                       \
		(triangle)->left = (struct model_edge){ (edges)->left_x, (edges)->left_step,       \
							(edges)->left_r, (edges)->left_m,          \
							(edges)->left_dy };                        \
		(triangle)->right = (struct model_edge){ (edges)->right_x, (edges)->right_step,    \
							 (edges)->right_r, (edges)->right_m,       \
							 (edges)->right_dy };                      \
		(triangle)->middle = (struct model_edge){ (edges)->middle_x, (edges)->middle_step, \
							  (edges)->middle_r, (edges)->middle_m,    \
							  (edges)->middle_dy };                    \
		(triangle)->first_row = (int)(edges)->first_row;                                   \
		(triangle)->last_row = (int)(edges)->last_row;                                     \
		(triangle)->switch_row = (int)(edges)->switch_row;                                 \
		(triangle)->side = (int)(edges)->side;                                             \
	} while (0)

static const uint32_t *unpack_edges(const uint32_t *words, enum gloss_geometry geometry,
				    int tile_size, struct model_triangle *triangle)
{
	struct gloss_edges_wide wide;
	struct gloss_edges_compact compact;

	switch (geometry) {
	case GLOSS_GEOMETRY_WIDE:
		gloss_edges_wide_unpack(words, &wide);
		EDGES_SET(triangle, &wide);
		return words + GLOSS_EDGES_WIDE_WORDS;
	case GLOSS_GEOMETRY_COMPACT:
		gloss_edges_compact_unpack(words, &compact);
		EDGES_SET(triangle, &compact);
		return words + GLOSS_EDGES_COMPACT_WORDS;
	default:
		/* Covering: upright edges at the tile's borders. */
		triangle->left = (struct model_edge){ .x = 0, .dy = 1 };
		triangle->right = (struct model_edge){ .x = tile_size, .dy = 1 };
		triangle->middle = triangle->left;
		triangle->first_row = 0;
		triangle->last_row = tile_size - 1;
		triangle->switch_row = 0;
		triangle->side = 0;
		return words;
	}
}

static uint64_t depth_compact(int32_t value)
{
	return (uint64_t)(int64_t)value << GLOSS_DEPTH_COMPACT_SHIFT;
}

static const uint32_t *unpack_depth(const uint32_t *words, enum gloss_geometry geometry,
				    struct model_plane *plane)
{
	struct gloss_depth_wide wide;
	struct gloss_depth_compact compact;

	if (geometry == GLOSS_GEOMETRY_COMPACT) {
		gloss_depth_compact_unpack(words, &compact);
		plane->z = depth_compact(compact.z);
		plane->dx = depth_compact(compact.dx);
		plane->dy = depth_compact(compact.dy);
		return words + GLOSS_DEPTH_COMPACT_WORDS;
	}
	gloss_depth_wide_unpack(words, &wide);
	plane->z = (uint64_t)wide.z_high << 32 | wide.z;
	plane->dx = (uint64_t)wide.dx_high << 32 | wide.dx;
	plane->dy = (uint64_t)wide.dy_high << 32 | wide.dy;
	return words + GLOSS_DEPTH_WIDE_WORDS;
}

/* A constant is a surface without slopes: 255 << 22 fits. */
static struct model_surface constant(uint32_t value)
{
	return (struct model_surface){ .i = value << GLOSS_COLOUR_FRACTION };
}

static const uint32_t *unpack_plane(const uint32_t *words, struct model_surface *surface)
{
	*surface = (struct model_surface){ .i = words[0], .dx = words[1], .dy = words[2] };
	return words + GLOSS_ALPHA_LINEAR_WORDS;
}

/* The order of the words is that of the struct, channel after channel. */
static const uint32_t *unpack_surface(const uint32_t *words, struct model_surface *surface)
{
	*surface = (struct model_surface){ words[0], words[1], words[2],
					   words[3], words[4], words[5] };
	return words + GLOSS_COLOUR_SECOND_ORDER_WORDS / 3;
}

static void unpack_colour(const uint32_t *words, enum gloss_shading shading,
			  struct model_triangle *triangle)
{
	struct gloss_colour_flat flat;

	switch (shading) {
	case GLOSS_SHADING_SECOND_ORDER:
		words = unpack_surface(words, &triangle->red);
		words = unpack_surface(words, &triangle->green);
		unpack_surface(words, &triangle->blue);
		return;
	case GLOSS_SHADING_LINEAR:
		words = unpack_plane(words, &triangle->red);
		words = unpack_plane(words, &triangle->green);
		unpack_plane(words, &triangle->blue);
		return;
	default:
		gloss_colour_flat_unpack(words, &flat);
		triangle->red = constant(flat.red);
		triangle->green = constant(flat.green);
		triangle->blue = constant(flat.blue);
	}
}

void model_triangle_unpack(const uint32_t *packet, int tile_size, struct model_triangle *triangle)
{
	struct gloss_triangle header;
	const uint32_t *words = packet + 1;

	gloss_triangle_unpack(packet, &header);
	triangle->listed = false;
	words = unpack_edges(words, header.geometry, tile_size, triangle);
	words = unpack_depth(words, header.geometry, &triangle->depth);
	if (header.alpha_linear)
		words = unpack_plane(words, &triangle->alpha);
	else
		triangle->alpha = constant(header.alpha);
	unpack_colour(words, header.shading, triangle);
}
