/* SPDX-License-Identifier: MIT */
/* Matrices and their stacks. */
#ifndef GLOSS_MATRIX_H
#define GLOSS_MATRIX_H

#include "state/attributes.h"

#define GLOSS_MODELVIEW_DEPTH 32
#define GLOSS_PROJECTION_DEPTH 4
#define GLOSS_TEXTURE_DEPTH 4

struct gloss_matrix {
	GLfloat m[16]; /* column by column */
};

struct gloss_matrices {
	struct gloss_matrix modelview[GLOSS_MODELVIEW_DEPTH];
	struct gloss_matrix projection[GLOSS_PROJECTION_DEPTH];
	struct gloss_matrix texture[GLOSS_UNITS][GLOSS_TEXTURE_DEPTH];
	GLint modelview_top, projection_top, texture_top[GLOSS_UNITS]; /* indices */
};

struct gloss_context;

void gloss_matrices_init(struct gloss_matrices *matrices);
const struct gloss_matrix *gloss_matrix_modelview(const struct gloss_context *context);
const struct gloss_matrix *gloss_matrix_projection(const struct gloss_context *context);
void gloss_matrix_multiply(struct gloss_matrix *out, const struct gloss_matrix *a,
			   const struct gloss_matrix *b);
/* A column; @out may be @v. */
void gloss_matrix_apply(const struct gloss_matrix *matrix, const GLfloat v[4], GLfloat out[4]);
/* A row times the inverse, as planes are taken to eye space. A matrix without an inverse gives 0. */
void gloss_matrix_apply_inverse(const struct gloss_matrix *matrix, const GLfloat row[4],
				GLfloat out[4]);

#endif
