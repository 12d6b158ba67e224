/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_ERROR_H
#define GLOSS_ERROR_H

#include <GL/gl.h>

struct gloss_context;

/* Keeps @error for glGetError, unless an earlier one has not been asked for. */
void gloss_error(struct gloss_context *context, GLenum error);
/* The same of what a function of libaccel returned, if that is an error. */
void gloss_error_accel(struct gloss_context *context, int err);

/* GLOSS_DEBUG=perf: says once that @what is drawn without. */
enum gloss_missing {
	GLOSS_MISSING_TEXTURE,
	GLOSS_MISSING_BLEND,
	GLOSS_MISSING_ALPHA_TEST,
	GLOSS_MISSING_STENCIL,
	GLOSS_MISSING_FOG,
	GLOSS_MISSING_LOGIC_OP,
	GLOSS_MISSING_POLYGON_STIPPLE,
	GLOSS_MISSING_COLOUR_SUM,
	GLOSS_MISSING_SEPARATE_SPECULAR,
	GLOSS_MISSING_SMOOTH_POINT,
	GLOSS_MISSING_SMOOTH_LINE,
	GLOSS_MISSING_SMOOTH_POLYGON,
	GLOSS_MISSING_FRONT,
	GLOSS_MISSING_DRAW,
	GLOSS_MISSING_COUNT
};
void gloss_missing(struct gloss_context *context, enum gloss_missing what);
/* The same of all that the state asks for. */
void gloss_missing_tell(struct gloss_context *context);

#endif
