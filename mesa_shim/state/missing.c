// SPDX-License-Identifier: MIT
/* GLOSS_DEBUG=perf: what something is drawn without. */
#include <stddef.h>
#include <stdio.h>

#include "state/command.h"

void gloss_missing(struct gloss_context *context, enum gloss_missing what)
{
	static const char *const name[GLOSS_MISSING_COUNT] = {
		[GLOSS_MISSING_TEXTURE] = "textures",
		[GLOSS_MISSING_BLEND] = "blending",
		[GLOSS_MISSING_ALPHA_TEST] = "the alpha test",
		[GLOSS_MISSING_STENCIL] = "the stencil test",
		[GLOSS_MISSING_FOG] = "fog",
		[GLOSS_MISSING_LOGIC_OP] = "the logic operation",
		[GLOSS_MISSING_POLYGON_STIPPLE] = "polygon stipple",
		[GLOSS_MISSING_COLOUR_SUM] = "the secondary colour",
		[GLOSS_MISSING_SEPARATE_SPECULAR] = "separate specular light",
		[GLOSS_MISSING_SMOOTH_POINT] = "smooth points",
		[GLOSS_MISSING_SMOOTH_LINE] = "smooth lines",
		[GLOSS_MISSING_SMOOTH_POLYGON] = "smooth polygons",
		[GLOSS_MISSING_FRONT] = "a front buffer of its own",
		[GLOSS_MISSING_DRAW] = "primitives that libaccel refused",
	};

	if (!context->tell || context->told & 1u << what)
		return;
	context->told |= 1u << what;
	fprintf(stderr, "gloss: perf: drawn without %s\n", name[what]);
}

#define AT(member) offsetof(struct gloss_attributes, member)

/* Capabilities that nothing is drawn with. */
static const struct {
	size_t at;
	enum gloss_missing what;
} missing_capability[] = {
	{ AT(colour_buffer.blend), GLOSS_MISSING_BLEND },
	{ AT(colour_buffer.alpha_test), GLOSS_MISSING_ALPHA_TEST },
	{ AT(colour_buffer.logic), GLOSS_MISSING_LOGIC_OP },
	{ AT(stencil.test), GLOSS_MISSING_STENCIL },
	{ AT(fog.enabled), GLOSS_MISSING_FOG },
	{ AT(fog.sum), GLOSS_MISSING_COLOUR_SUM },
	{ AT(polygon.stipple), GLOSS_MISSING_POLYGON_STIPPLE },
	{ AT(polygon.smooth), GLOSS_MISSING_SMOOTH_POLYGON },
	{ AT(line.smooth), GLOSS_MISSING_SMOOTH_LINE },
	{ AT(point.smooth), GLOSS_MISSING_SMOOTH_POINT },
};

static bool missing_textures(const struct gloss_texturing *texturing)
{
	for (int i = 0; i < GLOSS_UNITS; i++)
		for (int j = 0; j < GLOSS_TEXTURE_KINDS; j++)
			if (texturing->unit[i].enabled[j])
				return true;
	return false;
}

/* Front and back of a surface are one target. */
static bool missing_front(const struct gloss_context *context)
{
	const GLenum buffer = context->attributes.colour_buffer.draw_buffer;

	return context->visual.double_buffered && buffer != GL_NONE && buffer != GL_BACK &&
	       buffer != GL_BACK_LEFT;
}

void gloss_missing_tell(struct gloss_context *context)
{
	const struct gloss_attributes *attributes = &context->attributes;
	const size_t count = sizeof(missing_capability) / sizeof(missing_capability[0]);

	for (size_t i = 0; i < count; i++)
		if (*((const GLboolean *)attributes + missing_capability[i].at))
			gloss_missing(context, missing_capability[i].what);
	if (missing_textures(&attributes->texturing))
		gloss_missing(context, GLOSS_MISSING_TEXTURE);
	if (attributes->lighting.enabled &&
	    attributes->lighting.colour_control == GL_SEPARATE_SPECULAR_COLOR)
		gloss_missing(context, GLOSS_MISSING_SEPARATE_SPECULAR);
	if (missing_front(context))
		gloss_missing(context, GLOSS_MISSING_FRONT);
}
