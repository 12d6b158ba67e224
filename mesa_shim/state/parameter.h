/* SPDX-License-Identifier: MIT */
/* What commands of one parameter by name take: up to four floats, or integers for them. */
#ifndef GLOSS_PARAMETER_H
#define GLOSS_PARAMETER_H

#include <string.h>

#include "api/convert.h"
#include "state/command.h"

static inline struct gloss_vector gloss_parameter_floats(const GLfloat *params, unsigned int count)
{
	struct gloss_vector vector = { { 0 } };

	memcpy(vector.v, params, count * sizeof(*params));
	return vector;
}

/* @unit: the whole range stands for -1 to 1, as of colours. */
static inline struct gloss_vector gloss_parameter_integers(const GLint *params, unsigned int count,
							   bool unit)
{
	struct gloss_vector vector = { { 0 } };

	for (unsigned int i = 0; i < count; i++)
		vector.v[i] = unit ? gloss_from_i(params[i]) : (GLfloat)params[i];
	return vector;
}

/* The enum that a number stands for; ~0: none. */
static inline GLenum gloss_parameter_enum(GLfloat value)
{
	return value >= 0 && value < 65536 ? (GLenum)value : ~0u;
}

#endif
