// SPDX-License-Identifier: MIT
#include <string.h>

#include "state/attributes.h"

#define WHITE 1, 1, 1, 1
#define BLACK 0, 0, 0, 1

static void attributes_init_lighting(struct gloss_lighting *lighting)
{
	static const struct gloss_light light = {
		.ambient = { BLACK },
		.diffuse = { BLACK },
		.specular = { BLACK },
		.position = { 0, 0, 1, 0 },
		.direction = { 0, 0, -1 },
		.cutoff = 180,
		.attenuation = { 1, 0, 0 },
	};
	static const GLfloat white[4] = { WHITE };
	static const struct gloss_material material = {
		.ambient = { 0.2f, 0.2f, 0.2f, 1 },
		.diffuse = { 0.8f, 0.8f, 0.8f, 1 },
		.specular = { BLACK },
		.emission = { BLACK },
		.indexes = { 0, 1, 1 },
	};

	*lighting = (struct gloss_lighting){
		.shade_model = GL_SMOOTH,
		.colour_control = GL_SINGLE_COLOR,
		.track_face = GL_FRONT_AND_BACK,
		.track_mode = GL_AMBIENT_AND_DIFFUSE,
		.ambient = { 0.2f, 0.2f, 0.2f, 1 },
		.material = { material, material },
	};
	for (int i = 0; i < GLOSS_LIGHTS; i++)
		lighting->light[i] = light;
	memcpy(lighting->light[0].diffuse, white, sizeof(white));
	memcpy(lighting->light[0].specular, white, sizeof(white));
}

static void attributes_init_current(struct gloss_attributes *attributes)
{
	attributes->current = (struct gloss_current){
		.vertex = { .position = { BLACK },
			    .colour = { WHITE },
			    .normal = { 0, 0, 1 },
			    .edge = 1 },
		.secondary = { BLACK },
		.index = 1,
	};
	attributes->raster = (struct gloss_raster_position){
		.position = { BLACK },
		.colour = { WHITE },
		.secondary = { BLACK },
		.index = 1,
		.valid = GL_TRUE,
	};
	for (int i = 0; i < GLOSS_UNITS; i++)
		attributes->current.texcoord[i][3] = attributes->raster.texcoord[i][3] = 1;
}

static void attributes_init_fragments(struct gloss_attributes *attributes)
{
	attributes->depth = (struct gloss_depth){ .func = GL_LESS, .clear = 1, .mask = GL_TRUE };
	attributes->stencil = (struct gloss_stencil){
		.func = GL_ALWAYS,
		.fail = GL_KEEP,
		.depth_fail = GL_KEEP,
		.pass = GL_KEEP,
		.mask = 0xff,
		.write_mask = 0xff,
	};
	attributes->colour_buffer = (struct gloss_colour_buffer){
		.alpha_func = GL_ALWAYS,
		.logic_op = GL_COPY,
		.draw_buffer = GL_BACK,
		.source = GL_ONE,
		.target = GL_ZERO,
		.source_alpha = GL_ONE,
		.target_alpha = GL_ZERO,
		.equation = GL_FUNC_ADD,
		.equation_alpha = GL_FUNC_ADD,
		.index_mask = -1,
		.mask = { GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE },
		.dither = GL_TRUE,
	};
	attributes->fog = (struct gloss_fog){
		.mode = GL_EXP,
		.source = GL_FRAGMENT_DEPTH,
		.density = 1,
		.end = 1,
	};
	attributes->multisample = (struct gloss_multisample){ .coverage = 1, .enabled = GL_TRUE };
}

static void attributes_init_unit(struct gloss_unit *unit)
{
	unit->environment = (struct gloss_environment){
		.mode = GL_MODULATE,
		.combine = { GL_MODULATE, GL_MODULATE },
		.source = { { GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT },
			    { GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT } },
		.operand = { { GL_SRC_COLOR, GL_SRC_COLOR, GL_SRC_ALPHA },
			     { GL_SRC_ALPHA, GL_SRC_ALPHA, GL_SRC_ALPHA } },
		.scale = { 1, 1 },
	};
	for (int i = 0; i < 4; i++)
		unit->texgen[i].mode = GL_EYE_LINEAR;
	/* S and T have planes, R and Q none. */
	unit->texgen[0].object[0] = unit->texgen[0].eye[0] = 1;
	unit->texgen[1].object[1] = unit->texgen[1].eye[1] = 1;
}

void gloss_attributes_init(struct gloss_attributes *attributes)
{
	*attributes = (struct gloss_attributes){
		.point = { .size = 1, .most = 64, .fade = 1, .attenuation = { 1, 0, 0 } },
		.line = { .width = 1, .pattern = 0xffff, .repeat = 1 },
		.polygon = { .cull_face = GL_BACK,
			     .front_face = GL_CCW,
			     .mode = { GL_FILL, GL_FILL } },
		.transfer = { .zoom = { 1, 1 },
			      .scale = { WHITE },
			      .depth_scale = 1,
			      .read_buffer = GL_BACK },
		.viewport = { .range = { 0, 1 } },
		.transform = { .matrix_mode = GL_MODELVIEW },
		.evaluating = { .segments1 = 1,
				.segments2 = { 1, 1 },
				.grid1 = { 0, 1 },
				.grid2 = { 0, 1, 0, 1 } },
		.hints = { GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE,
			   GL_DONT_CARE, GL_DONT_CARE },
	};
	memset(attributes->polygon_stipple, 0xff, sizeof(attributes->polygon_stipple));
	attributes_init_current(attributes);
	attributes_init_lighting(&attributes->lighting);
	attributes_init_fragments(attributes);
	for (int i = 0; i < GLOSS_UNITS; i++)
		attributes_init_unit(&attributes->texturing.unit[i]);
}
