// SPDX-License-Identifier: MIT
#include "draw/emit.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "draw/read.h"
#include "state/command.h"
#include "window/surface.h"

/* The top row of a box. OpenGL counts rows from the bottom, a target from the top. */
static int emit_top(const struct gloss_context *context, const GLint box[4])
{
	const int64_t top = (int64_t)context->height - box[1] - box[3];

	if (top < INT_MIN)
		return INT_MIN;
	return top > INT_MAX ? INT_MAX : (int)top;
}

static void emit_viewport(struct gloss_context *context, struct accel_state *state)
{
	const GLint *box = context->attributes.viewport.box;
	const GLint *cut = context->attributes.scissor.box;

	accel_state_set_viewport(state, box[0], emit_top(context, box), box[2], box[3]);
	accel_state_set_depth_range(state, context->attributes.viewport.range[0],
				    context->attributes.viewport.range[1]);
	if (context->attributes.scissor.test)
		accel_state_set_scissor(state, cut[0], emit_top(context, cut), cut[2], cut[3]);
	else
		accel_state_set_scissor(state, 0, 0, -1, -1);
}

static void emit_clip_planes(const struct gloss_transform *transform, struct accel_state *state)
{
	for (int i = 0; i < GLOSS_CLIP_PLANES; i++)
		accel_state_set_clip_plane(state, i,
					   transform->clip[i] ? transform->plane[i] : NULL);
}

/* The attenuations of OpenGL may all be 0, which is infinitely bright and 1 to libaccel. */
static void emit_light(struct accel_state *state, int index, const struct gloss_light *from)
{
	struct accel_light light = ACCEL_LIGHT(.enabled = from->enabled,
					       .spot_exponent = from->exponent,
					       .spot_cutoff = from->cutoff);

	memcpy(light.position, from->position, sizeof(light.position));
	memcpy(light.ambient, from->ambient, sizeof(light.ambient));
	memcpy(light.diffuse, from->diffuse, sizeof(light.diffuse));
	memcpy(light.specular, from->specular, sizeof(light.specular));
	memcpy(light.attenuation, from->attenuation, sizeof(light.attenuation));
	memcpy(light.spot_direction, from->direction, sizeof(light.spot_direction));
	accel_state_set_light(state, index, &light);
}

static struct accel_material emit_material(const struct gloss_material *from)
{
	struct accel_material material = ACCEL_MATERIAL(.shininess = from->shininess);

	memcpy(material.emission, from->emission, sizeof(material.emission));
	memcpy(material.ambient, from->ambient, sizeof(material.ambient));
	memcpy(material.diffuse, from->diffuse, sizeof(material.diffuse));
	memcpy(material.specular, from->specular, sizeof(material.specular));
	return material;
}

/* What of the material of one side follows the colour. */
static enum accel_tracks emit_tracks(const struct gloss_lighting *lighting, GLenum side)
{
	if (!lighting->track ||
	    (lighting->track_face != side && lighting->track_face != GL_FRONT_AND_BACK))
		return ACCEL_TRACKS_NONE;
	switch (lighting->track_mode) {
	case GL_EMISSION:
		return ACCEL_TRACKS_EMISSION;
	case GL_AMBIENT:
		return ACCEL_TRACKS_AMBIENT;
	case GL_DIFFUSE:
		return ACCEL_TRACKS_DIFFUSE;
	case GL_SPECULAR:
		return ACCEL_TRACKS_SPECULAR;
	default:
		return ACCEL_TRACKS_AMBIENT_DIFFUSE;
	}
}

static void emit_normals(const struct gloss_transform *transform, struct accel_state *state)
{
	if (transform->normalize)
		accel_state_set_normals(state, ACCEL_NORMALS_UNIT);
	else if (transform->rescale)
		accel_state_set_normals(state, ACCEL_NORMALS_RESCALE);
	else
		accel_state_set_normals(state, ACCEL_NORMALS_AS_GIVEN);
}

static void emit_lighting(struct gloss_context *context, struct accel_state *state)
{
	const struct gloss_lighting *lighting = &context->attributes.lighting;
	struct accel_material front = emit_material(&lighting->material[0]);
	struct accel_material back = emit_material(&lighting->material[1]);

	accel_state_set_lighting(state, lighting->enabled);
	accel_state_set_two_sided(state, lighting->two_side);
	accel_state_set_local_viewer(state, lighting->local_viewer);
	accel_state_set_ambient(state, lighting->ambient);
	accel_state_set_colour_material(state, emit_tracks(lighting, GL_FRONT),
					emit_tracks(lighting, GL_BACK));
	emit_normals(&context->attributes.transform, state);
	accel_state_set_material(state, &front, &back);
	for (int i = 0; i < GLOSS_LIGHTS; i++)
		emit_light(state, i, &lighting->light[i]);
}

static void emit_line_and_point(const struct gloss_context *context, struct accel_state *state)
{
	const struct gloss_line *line = &context->attributes.line;
	const struct gloss_point *point = &context->attributes.point;
	const struct accel_line_style line_style = ACCEL_LINE_STYLE(
			.width = line->width, .stipple = (uint16_t)line->pattern,
			.repeat = line->stipple ? (uint16_t)line->repeat : 0);
	const struct accel_point_style point_style = ACCEL_POINT_STYLE(
			.width = point->size, .least = point->least, .most = point->most,
			.attenuation = { point->attenuation[0], point->attenuation[1],
					 point->attenuation[2] });

	accel_state_set_line_style(state, &line_style);
	accel_state_set_point_style(state, &point_style);
}

static enum accel_polygon_mode emit_polygon_mode(GLenum mode)
{
	if (mode == GL_POINT)
		return ACCEL_POLYGON_POINTS;
	return mode == GL_LINE ? ACCEL_POLYGON_LINES : ACCEL_POLYGON_FILL;
}

static void emit_polygons(const struct gloss_polygon *polygon, struct accel_state *state)
{
	const unsigned int modes = (unsigned int)polygon->offset_fill << ACCEL_POLYGON_FILL |
				   (unsigned int)polygon->offset_line << ACCEL_POLYGON_LINES |
				   (unsigned int)polygon->offset_point << ACCEL_POLYGON_POINTS;

	accel_state_set_polygon_mode(state, emit_polygon_mode(polygon->mode[0]),
				     emit_polygon_mode(polygon->mode[1]));
	/* Depths of vertices that are floats differ by two steps near the eye, if they differ. */
	accel_state_set_polygon_offset(state, polygon->factor, 2 * polygon->units, modes);
}

bool gloss_emit_has_outlines(const struct gloss_context *context)
{
	const GLenum *mode = context->attributes.polygon.mode;

	return mode[0] != GL_FILL || mode[1] != GL_FILL;
}

static void emit_raster(struct gloss_context *context, struct accel_state *state)
{
	const struct gloss_polygon *polygon = &context->attributes.polygon;
	bool back = polygon->cull_face == GL_BACK;

	emit_line_and_point(context, state);
	emit_polygons(polygon, state);
	accel_state_set_front_face(state, polygon->front_face == GL_CW);
	if (!polygon->cull)
		accel_state_set_cull(state, ACCEL_CULL_NONE);
	else if (polygon->cull_face == GL_FRONT_AND_BACK)
		accel_state_set_cull(state, ACCEL_CULL_BOTH);
	else
		accel_state_set_cull(state, back ? ACCEL_CULL_BACK : ACCEL_CULL_FRONT);
	accel_state_set_shading(state, context->attributes.lighting.shade_model == GL_FLAT ?
					       ACCEL_SHADING_FLAT :
					       context->shading);
}

static void emit_colour_mask(const struct gloss_context *context, struct accel_state *state,
			     bool drawn)
{
	const GLboolean *mask = context->attributes.colour_buffer.mask;

	drawn = drawn && context->attributes.colour_buffer.draw_buffer != GL_NONE;
	/* A window without alpha has alpha 1, as it was cleared to. */
	accel_state_set_colour_mask(state, drawn && mask[0], drawn && mask[1], drawn && mask[2],
				    drawn && mask[3] && context->visual.alpha);
}

static void emit_depth(const struct gloss_context *context, struct accel_state *state)
{
	const struct gloss_depth *depth = &context->attributes.depth;

	if (depth->test && context->visual.depth)
		accel_state_set_depth(state, (enum accel_compare)(depth->func - GL_NEVER),
				      depth->mask);
	else
		accel_state_set_depth(state, ACCEL_COMPARE_ALWAYS, false);
}

static void emit_state(struct gloss_context *context)
{
	struct accel_state *state = context->state;
	unsigned int dirty = context->dirty;

	if (dirty & GLOSS_DIRTY_MODELVIEW)
		accel_state_set_modelview(state, gloss_matrix_modelview(context)->m);
	if (dirty & GLOSS_DIRTY_PROJECTION)
		accel_state_set_projection(state, gloss_matrix_projection(context)->m);
	if (dirty & GLOSS_DIRTY_VIEWPORT) {
		emit_viewport(context, state);
		emit_clip_planes(&context->attributes.transform, state);
	}
	if (dirty & GLOSS_DIRTY_LIGHTING)
		emit_lighting(context, state);
	if (dirty & GLOSS_DIRTY_RASTER)
		emit_raster(context, state);
	if (dirty & GLOSS_DIRTY_FRAGMENT) {
		emit_colour_mask(context, state, true);
		emit_depth(context, state);
	}
	if (context->tell)
		gloss_missing_tell(context);
	context->dirty = 0;
}

/* A new target has the initial depth of programs that never clear it. */
static int emit_begin_target(struct gloss_context *context)
{
	const struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH,
						     .rgba = { 0, 0, 0,
							       context->visual.alpha ? 0 : 1 },
						     .depth = 1);
	bool fresh = gloss_surface_fresh(context->draw_surface);

	return accel_draw_begin(context->draw, context->target, fresh ? &clear : NULL);
}

bool gloss_emit_begin(struct gloss_context *context)
{
	int err, height;

	if (context->target)
		return true;
	if (!context->draw_surface)
		return false;
	context->target = gloss_surface_target(context->draw_surface);
	if (!context->target)
		return false;
	height = gloss_surface_height(context->draw_surface);
	if (height != context->height)
		context->dirty |= GLOSS_DIRTY_VIEWPORT;
	context->height = height;
	context->width = gloss_surface_width(context->draw_surface);
	err = emit_begin_target(context);
	gloss_error_accel(context, err);
	if (err)
		context->target = NULL;
	return !err;
}

void gloss_emit_touch(struct gloss_context *context)
{
	gloss_read_forget(context);
	gloss_surface_touched(context->draw_surface);
}

/* What became of a call that draws; after -ENOMEM there is no frame any more. */
static void emit_result(struct gloss_context *context, int err)
{
	gloss_error_accel(context, err);
	if (err == -ENOMEM)
		context->target = NULL;
	else if (err)
		gloss_missing(context, GLOSS_MISSING_DRAW);
}

void gloss_emit_capture(struct gloss_context *context, const struct accel_arrays *arrays,
			const struct accel_elements *elements, accel_capture_fn call, void *data)
{
	if (!gloss_emit_begin(context))
		return;
	if (context->dirty)
		emit_state(context);
	accel_draw_capture(context->draw, call, data);
	emit_result(context, accel_draw_arrays(context->draw, context->state, arrays, elements));
	if (context->target)
		accel_draw_capture(context->draw, NULL, NULL);
}

void gloss_emit_draw(struct gloss_context *context, const struct accel_arrays *arrays,
		     const struct accel_elements *elements)
{
	if (context->render_mode != GL_RENDER) {
		gloss_emit_capture(context, arrays, elements, gloss_render_mode_capture, context);
		return;
	}
	if (!gloss_emit_begin(context))
		return;
	if (context->dirty)
		emit_state(context);
	gloss_emit_touch(context);
	emit_result(context, accel_draw_arrays(context->draw, context->state, arrays, elements));
}

/* The scissor and the masks for what no vertices draw. */
static void emit_plain_state(struct gloss_context *context, bool tested, bool colour, bool depth)
{
	emit_viewport(context, context->plain);
	emit_colour_mask(context, context->plain, colour);
	if (tested)
		emit_depth(context, context->plain);
	else
		accel_state_set_depth(context->plain, ACCEL_COMPARE_ALWAYS, depth);
}

#define EMIT_FILLS 256u

static int32_t emit_pixel(float at)
{
	const float most = ACCEL_TARGET_SIZE_MAX;

	return (int32_t)ceilf(fminf(fmaxf(at, -most), 2 * most) - 0.5f);
}

/* The pixels whose centres are in @box. */
static struct accel_rectangle emit_pixels(const struct gloss_context *context, const float box[4])
{
	const int32_t x = emit_pixel(box[0]), y = emit_pixel(box[1]);
	const int32_t width = emit_pixel(box[2]) - x, height = emit_pixel(box[3]) - y;

	return (struct accel_rectangle){ x, context->height - y - height, width, height };
}

static void emit_fills(struct gloss_context *context, const float (*box)[4], uint32_t count,
		       float z, const float rgba[4])
{
	struct accel_fill fill[EMIT_FILLS];

	for (uint32_t i = 0; i < count; i++) {
		fill[i].pixels = emit_pixels(context, box[i]);
		memcpy(fill[i].rgba, rgba, sizeof(fill[i].rgba));
		fill[i].depth = fminf(fmaxf(z, 0), 1);
	}
	emit_result(context, accel_draw_rectangles(context->draw, context->plain, fill, count));
}

void gloss_emit_rectangles(struct gloss_context *context, const float (*box)[4], uint32_t count,
			   float z, const float rgba[4], bool tested, bool colour, bool depth)
{
	if (context->render_mode != GL_RENDER || !gloss_emit_begin(context))
		return;
	gloss_emit_touch(context);
	emit_plain_state(context, tested, colour, depth);
	for (uint32_t i = 0; i < count && context->target; i += EMIT_FILLS)
		emit_fills(context, box + i, count - i < EMIT_FILLS ? count - i : EMIT_FILLS, z,
			   rgba);
}

void gloss_emit_clear(struct gloss_context *context, const struct accel_clear *given)
{
	const GLboolean *mask = context->attributes.colour_buffer.mask;
	const bool alpha = context->visual.alpha;
	struct accel_clear clear = *given;

	if (context->render_mode != GL_RENDER || !gloss_emit_begin(context))
		return;
	gloss_emit_touch(context);
	emit_plain_state(context, false, true, false);
	/* The alpha of a window without is 1 wherever all else is written. */
	accel_state_set_colour_mask(context->plain, mask[0], mask[1], mask[2],
				    alpha ? mask[3] : mask[0] && mask[1] && mask[2]);
	clear.rgba[3] = alpha ? clear.rgba[3] : 1;
	emit_result(context, accel_draw_clear_masked(context->draw, context->plain, &clear));
}

bool gloss_emit_is_plain(const struct gloss_context *context)
{
	const struct gloss_attributes *attributes = &context->attributes;
	const GLboolean *mask = attributes->colour_buffer.mask;

	return !(attributes->depth.test && context->visual.depth) &&
	       attributes->colour_buffer.draw_buffer != GL_NONE && mask[0] && mask[1] && mask[2] &&
	       (mask[3] || !context->visual.alpha);
}

void gloss_emit_write(struct gloss_context *context, enum accel_plane plane,
		      const struct accel_rectangle *part, const uint32_t *pixels)
{
	struct accel_target *target;

	/* A frame that was begun clears what is new. */
	if (context->render_mode != GL_RENDER || !gloss_emit_begin(context))
		return;
	target = context->target;
	gloss_context_flush(context);
	gloss_error_accel(context, accel_target_write(target, plane, part, pixels,
						      (size_t)part->width * sizeof(*pixels)));
	gloss_emit_touch(context);
}
