/* SPDX-License-Identifier: MIT */
/* Colours and normals given as integers: OpenGL 1.5, table 2.9. */
#ifndef GLOSS_CONVERT_H
#define GLOSS_CONVERT_H

#include <GL/gl.h>

static inline GLfloat gloss_from_ub(GLubyte c)
{
	return (GLfloat)c / 255.0f;
}

static inline GLfloat gloss_from_b(GLbyte c)
{
	return (2.0f * (GLfloat)c + 1.0f) / 255.0f;
}

static inline GLfloat gloss_from_us(GLushort c)
{
	return (GLfloat)c / 65535.0f;
}

static inline GLfloat gloss_from_s(GLshort c)
{
	return (2.0f * (GLfloat)c + 1.0f) / 65535.0f;
}

static inline GLfloat gloss_from_ui(GLuint c)
{
	return (GLfloat)(c / 4294967295.0);
}

static inline GLfloat gloss_from_i(GLint c)
{
	return (GLfloat)((2.0 * c + 1.0) / 4294967295.0);
}

#endif
