// SPDX-License-Identifier: MIT
#include "draw/batch.h"

#include <string.h>

#include "draw/emit.h"
#include "state/command.h"

#define BATCH_KEPT 3

static void batch_send(struct gloss_context *context, const struct gloss_vertices *vertices)
{
	const struct gloss_vertex *vertex = vertices->vertex;
	struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = vertices->vertices,
						  .position = { .data = vertex->position,
								.stride = sizeof(*vertex),
								.components = 4 },
						  .colour = { .data = vertex->colour,
							      .stride = sizeof(*vertex),
							      .components = 4 });
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = vertices->primitive,
							      .primitives = vertices->primitives);

	if (context->attributes.lighting.enabled)
		arrays.normal = (struct accel_array){ .data = vertex->normal,
						      .stride = sizeof(*vertex) };
	if (gloss_emit_has_outlines(context))
		arrays.edge = (struct accel_array){ .data = &vertex->edge,
						    .stride = sizeof(*vertex) };
	gloss_emit_draw(context, &arrays, &elements);
}

void gloss_batch_draw(struct gloss_context *context)
{
	struct gloss_vertices *vertices = &context->immediate;

	if (vertices->failed)
		gloss_error(context, GL_OUT_OF_MEMORY);
	if (vertices->primitives)
		batch_send(context, vertices);
	gloss_vertices_clear(vertices);
}

/*
 * The vertices with which a primitive of @count goes on are put to @kept, and how many there are is
 * returned. @drawn is how many are drawn before: a strip of triangles goes on with an even one, so
 * that its faces stay turned.
 */
static uint32_t batch_keep(const struct accel_primitive *primitive, uint32_t count,
			   const struct gloss_vertex *vertex, struct gloss_vertex *kept,
			   uint32_t *drawn)
{
	uint32_t last = 0;

	*drawn = count;
	switch (primitive->topology) {
	case ACCEL_TOPOLOGY_LINES:
		last = count % 2;
		break;
	case ACCEL_TOPOLOGY_TRIANGLES:
		last = count % 3;
		break;
	case ACCEL_TOPOLOGY_QUADS:
		last = count % 4;
		break;
	case ACCEL_TOPOLOGY_LINE_STRIP:
		last = count < 1 ? count : 1;
		break;
	case ACCEL_TOPOLOGY_TRIANGLE_STRIP:
	case ACCEL_TOPOLOGY_QUAD_STRIP:
		last = count < 2 ? count : 2 + count % 2;
		*drawn = count - count % 2;
		break;
	case ACCEL_TOPOLOGY_TRIANGLE_FAN:
	case ACCEL_TOPOLOGY_POLYGON:
		if (count > 1) {
			kept[0] = vertex[0];
			kept[1] = vertex[count - 1];
			return 2;
		}
		last = count;
		break;
	default:
		break;
	}
	memcpy(kept, vertex + count - last, last * sizeof(*kept));
	return last;
}

void gloss_batch_break(struct gloss_context *context, unsigned int dirty)
{
	struct gloss_vertices *vertices = &context->immediate;
	struct gloss_vertex kept[BATCH_KEPT];
	struct accel_primitive open;
	uint32_t count, drawn;

	if (!vertices->inside) {
		gloss_change(context, dirty);
		return;
	}
	open = vertices->primitive[vertices->primitives - 1];
	if (open.topology == ACCEL_TOPOLOGY_LINE_LOOP) {
		context->dirty |= dirty;
		return;
	}
	count = batch_keep(&open, vertices->vertices - open.first, vertices->vertex + open.first,
			   kept, &drawn);
	vertices->vertices = open.first + drawn;
	gloss_vertices_end(vertices);
	gloss_change(context, dirty);
	gloss_vertices_begin(vertices, (GLenum)open.topology);
	/* The room of those that were drawn is there. */
	memcpy(vertices->vertex, kept, count * sizeof(*kept));
	vertices->vertices = count;
}
