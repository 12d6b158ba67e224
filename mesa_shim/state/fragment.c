// SPDX-License-Identifier: MIT
/* What happens to fragments: scissor, depth, masks, and the tests and blending that the core does
 * not do yet. Clear values too. */
#include <math.h>

#include "state/command.h"

static GLfloat fragment_clamp(GLfloat value)
{
	return fminf(fmaxf(value, 0), 1);
}

static bool fragment_is_compare(struct gloss_context *context, GLenum func)
{
	if (func >= GL_NEVER && func <= GL_ALWAYS)
		return true;
	gloss_error(context, GL_INVALID_ENUM);
	return false;
}

GLOSS_LISTED1(DepthFunc, GLenum, func)
{
	if (!fragment_is_compare(context, func))
		return;
	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &context->attributes.depth.func, &func,
		     sizeof(func));
}

GLOSS_LISTED1(DepthMask, GLboolean, flag)
{
	const GLboolean mask = flag != 0;

	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &context->attributes.depth.mask, &mask,
		     sizeof(mask));
}

GLOSS_LISTED1(ClearDepth, GLdouble, depth)
{
	context->attributes.depth.clear = fragment_clamp((GLfloat)depth);
}

GLOSS_LISTED4(ColorMask, GLboolean, r, GLboolean, g, GLboolean, b, GLboolean, a)
{
	const GLboolean mask[4] = { r != 0, g != 0, b != 0, a != 0 };

	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, context->attributes.colour_buffer.mask, mask,
		     sizeof(mask));
}

static void fragment_set_colour(GLfloat colour[4], GLfloat r, GLfloat g, GLfloat b, GLfloat a)
{
	colour[0] = fragment_clamp(r);
	colour[1] = fragment_clamp(g);
	colour[2] = fragment_clamp(b);
	colour[3] = fragment_clamp(a);
}

GLOSS_LISTED4(ClearColor, GLfloat, r, GLfloat, g, GLfloat, b, GLfloat, a)
{
	fragment_set_colour(context->attributes.colour_buffer.clear, r, g, b, a);
}

GLOSS_LISTED4(BlendColor, GLfloat, r, GLfloat, g, GLfloat, b, GLfloat, a)
{
	fragment_set_colour(context->attributes.colour_buffer.constant, r, g, b, a);
}

GLOSS_LISTED4(ClearAccum, GLfloat, r, GLfloat, g, GLfloat, b, GLfloat, a)
{
	GLfloat *clear = context->attributes.accum_clear;

	clear[0] = fminf(fmaxf(r, -1), 1);
	clear[1] = fminf(fmaxf(g, -1), 1);
	clear[2] = fminf(fmaxf(b, -1), 1);
	clear[3] = fminf(fmaxf(a, -1), 1);
}

/* No configuration has an accumulation buffer. */
GLOSS_LISTED2(Accum, GLenum, op, GLfloat, value)
{
	(void)value;
	gloss_error(context,
		    op >= GL_ACCUM && op <= GL_ADD ? GL_INVALID_OPERATION : GL_INVALID_ENUM);
}

GLOSS_LISTED1(ClearIndex, GLfloat, c)
{
	context->attributes.colour_buffer.clear_index = c;
}

GLOSS_LISTED1(IndexMask, GLuint, mask)
{
	context->attributes.colour_buffer.index_mask = (GLint)mask;
}

GLOSS_LISTED4(Scissor, GLint, x, GLint, y, GLsizei, width, GLsizei, height)
{
	const GLint box[4] = { x, y, width, height };

	if (width < 0 || height < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_VIEWPORT, context->attributes.scissor.box, box,
		     sizeof(box));
}

GLOSS_LISTED2(AlphaFunc, GLenum, func, GLclampf, reference)
{
	if (!fragment_is_compare(context, func))
		return;
	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	context->attributes.colour_buffer.alpha_func = func;
	context->attributes.colour_buffer.alpha_reference = fragment_clamp(reference);
}

static bool fragment_is_factor(GLenum factor, bool source)
{
	switch (factor) {
	case GL_ZERO:
	case GL_ONE:
		return true;
	case GL_SRC_ALPHA_SATURATE:
		return source;
	default:
		return (factor >= GL_SRC_COLOR && factor <= GL_ONE_MINUS_DST_COLOR) ||
		       (factor >= GL_CONSTANT_COLOR && factor <= GL_ONE_MINUS_CONSTANT_ALPHA);
	}
}

GLOSS_LISTED4(BlendFuncSeparate, GLenum, source, GLenum, target, GLenum, source_alpha, GLenum,
	      target_alpha)
{
	struct gloss_colour_buffer *buffer = &context->attributes.colour_buffer;

	if (!fragment_is_factor(source, true) || !fragment_is_factor(target, false) ||
	    !fragment_is_factor(source_alpha, true) || !fragment_is_factor(target_alpha, false)) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &buffer->source, &source, sizeof(source));
	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &buffer->target, &target, sizeof(target));
	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &buffer->source_alpha, &source_alpha,
		     sizeof(source_alpha));
	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &buffer->target_alpha, &target_alpha,
		     sizeof(target_alpha));
}

void gl_BlendFunc(GLenum sfactor, GLenum dfactor)
{
	gl_BlendFuncSeparate(sfactor, dfactor, sfactor, dfactor);
}

static bool fragment_is_equation(GLenum mode)
{
	return mode == GL_FUNC_ADD || mode == GL_FUNC_SUBTRACT ||
	       mode == GL_FUNC_REVERSE_SUBTRACT || mode == GL_MIN || mode == GL_MAX;
}

GLOSS_LISTED2(BlendEquationSeparate, GLenum, colour, GLenum, alpha)
{
	if (!fragment_is_equation(colour) || !fragment_is_equation(alpha)) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	context->attributes.colour_buffer.equation = colour;
	context->attributes.colour_buffer.equation_alpha = alpha;
}

void gl_BlendEquation(GLenum mode)
{
	gl_BlendEquationSeparate(mode, mode);
}

GLOSS_LISTED1(LogicOp, GLenum, op)
{
	if (op < GL_CLEAR || op > GL_SET) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_FRAGMENT, &context->attributes.colour_buffer.logic_op,
		     &op, sizeof(op));
}

GLOSS_LISTED3(StencilFunc, GLenum, func, GLint, reference, GLuint, mask)
{
	if (!fragment_is_compare(context, func))
		return;
	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	context->attributes.stencil.func = func;
	context->attributes.stencil.reference = reference < 0   ? 0 :
						reference > 255 ? 255 :
								  reference;
	context->attributes.stencil.mask = (GLint)mask;
}

static bool fragment_is_stencil_op(GLenum op)
{
	return op == GL_ZERO || op == GL_INVERT || (op >= GL_KEEP && op <= GL_DECR) ||
	       op == GL_INCR_WRAP || op == GL_DECR_WRAP;
}

GLOSS_LISTED3(StencilOp, GLenum, fail, GLenum, depth_fail, GLenum, pass)
{
	if (!fragment_is_stencil_op(fail) || !fragment_is_stencil_op(depth_fail) ||
	    !fragment_is_stencil_op(pass)) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	context->attributes.stencil.fail = fail;
	context->attributes.stencil.depth_fail = depth_fail;
	context->attributes.stencil.pass = pass;
}

GLOSS_LISTED1(StencilMask, GLuint, mask)
{
	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	context->attributes.stencil.write_mask = (GLint)mask;
}

GLOSS_LISTED1(ClearStencil, GLint, s)
{
	context->attributes.stencil.clear = s;
}

GLOSS_LISTED2(SampleCoverage, GLclampf, value, GLboolean, invert)
{
	context->attributes.multisample.coverage = fragment_clamp(value);
	context->attributes.multisample.invert = invert != 0;
}
