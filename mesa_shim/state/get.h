/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_GET_H
#define GLOSS_GET_H

#include "state/table.h"

#define GLOSS_VALUES 16

/* What glGet answers, before it is converted: doubles hold every integer and float exactly. */
struct gloss_values {
	enum gloss_kind kind;
	unsigned int count; /* 0: there is nothing of this name */
	double value[GLOSS_VALUES];
};

struct gloss_context;

/* Without a test for glBegin, and without an error. */
void gloss_get(struct gloss_context *context, GLenum name, struct gloss_values *values);
/* OpenGL's conversion to integers: section 6.1.2. */
GLint gloss_get_integer(enum gloss_kind kind, double value);
void gloss_get_row(struct gloss_context *context, const struct gloss_row *row,
		   struct gloss_values *values);

#endif
