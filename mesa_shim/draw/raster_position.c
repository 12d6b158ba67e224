// SPDX-License-Identifier: MIT
/* The raster position, which has a vertex's colour. */
#include <math.h>
#include <string.h>

#include "draw/batch.h"
#include "draw/emit.h"
#include "state/command.h"

static void raster_take_current(struct gloss_context *context)
{
	const struct gloss_current *current = &context->attributes.current;
	struct gloss_raster_position *raster = &context->attributes.raster;

	for (int i = 0; i < 4; i++) {
		raster->colour[i] = fminf(fmaxf(current->vertex.colour[i], 0), 1);
		raster->secondary[i] = fminf(fmaxf(current->secondary[i], 0), 1);
	}
	memcpy(raster->texcoord, current->texcoord, sizeof(raster->texcoord));
	raster->index = current->index;
	raster->valid = GL_TRUE;
}

static bool raster_is_clipped(const struct gloss_context *context, const GLfloat eye[4],
			      const GLfloat clip[4])
{
	const struct gloss_transform *transform = &context->attributes.transform;

	for (int i = 0; i < 3; i++)
		if (!(fabsf(clip[i]) <= clip[3]))
			return true;
	for (int i = 0; i < GLOSS_CLIP_PLANES; i++) {
		const GLfloat *plane = transform->plane[i];

		if (transform->clip[i] &&
		    plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2] + plane[3] * eye[3] <
			    0)
			return true;
	}
	return !(clip[3] > 0);
}

static void raster_take_lit(void *data, enum accel_captured what,
			    const struct accel_captured_vertex *vertex, uint32_t vertices)
{
	(void)what;
	(void)vertices;
	memcpy(data, vertex->colour, sizeof(vertex->colour));
}

/* The colour of a point that is lit there. */
static void raster_light(struct gloss_context *context, const GLfloat object[4])
{
	const struct gloss_vertex *current = &context->attributes.current.vertex;
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 1,
							.position = { .data = object,
								      .components = 4 },
							.normal = { .data = current->normal },
							.colour = { .data = current->colour,
								    .components = 4 });
	const struct accel_primitive point = { ACCEL_TOPOLOGY_POINTS, 0, 1 };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &point, .primitives = 1);

	gloss_batch_draw(context);
	gloss_emit_capture(context, &arrays, &elements, raster_take_lit,
			   context->attributes.raster.colour);
}

/* A valid position is a hit of selection. */
static void raster_select(struct gloss_context *context)
{
	if (context->render_mode == GL_SELECT)
		gloss_select_hit(context, context->attributes.raster.position[2]);
}

GLOSS_LISTED4(RasterPos4f, GLfloat, x, GLfloat, y, GLfloat, z, GLfloat, w)
{
	struct gloss_raster_position *raster = &context->attributes.raster;
	const struct gloss_viewport *viewport = &context->attributes.viewport;
	const GLfloat object[4] = { x, y, z, w };
	const GLfloat near = viewport->range[0], far = viewport->range[1];
	GLfloat eye[4], clip[4];

	gloss_matrix_apply(gloss_matrix_modelview(context), object, eye);
	gloss_matrix_apply(gloss_matrix_projection(context), eye, clip);
	raster_take_current(context);
	raster->valid = !raster_is_clipped(context, eye, clip);
	if (!raster->valid)
		return;
	for (int i = 0; i < 2; i++)
		raster->position[i] = (GLfloat)viewport->box[i] +
				      (clip[i] / clip[3] + 1) * (GLfloat)viewport->box[2 + i] / 2;
	raster->position[2] = near + (clip[2] / clip[3] + 1) * (far - near) / 2;
	raster->position[3] = clip[3];
	raster->distance = sqrtf(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]);
	if (context->attributes.lighting.enabled)
		raster_light(context, object);
	raster_select(context);
}

GLOSS_LISTED3(WindowPos3f, GLfloat, x, GLfloat, y, GLfloat, z)
{
	struct gloss_raster_position *raster = &context->attributes.raster;
	const GLfloat *range = context->attributes.viewport.range;

	raster_take_current(context);
	raster->position[0] = x;
	raster->position[1] = y;
	raster->position[2] = range[0] + fminf(fmaxf(z, 0), 1) * (range[1] - range[0]);
	raster->position[3] = 1;
	raster->distance = 0;
	raster_select(context);
}
