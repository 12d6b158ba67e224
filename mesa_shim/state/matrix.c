// SPDX-License-Identifier: MIT
#include "state/matrix.h"

#include <math.h>
#include <string.h>

#include "state/command.h"

static const struct gloss_matrix identity = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };

/* A stack as the commands see it. */
struct matrix_stack {
	struct gloss_matrix *matrix;
	GLint *top, depth;
	unsigned int dirty;
};

void gloss_matrices_init(struct gloss_matrices *matrices)
{
	memset(matrices, 0, sizeof(*matrices));
	matrices->modelview[0] = matrices->projection[0] = identity;
	for (int i = 0; i < GLOSS_UNITS; i++)
		matrices->texture[i][0] = identity;
}

const struct gloss_matrix *gloss_matrix_modelview(const struct gloss_context *context)
{
	return &context->matrices.modelview[context->matrices.modelview_top];
}

const struct gloss_matrix *gloss_matrix_projection(const struct gloss_context *context)
{
	return &context->matrices.projection[context->matrices.projection_top];
}

void gloss_matrix_multiply(struct gloss_matrix *out, const struct gloss_matrix *a,
			   const struct gloss_matrix *b)
{
	struct gloss_matrix product;

	for (int column = 0; column < 4; column++)
		gloss_matrix_apply(a, &b->m[4 * column], &product.m[4 * column]);
	*out = product;
}

void gloss_matrix_apply(const struct gloss_matrix *matrix, const GLfloat v[4], GLfloat out[4])
{
	const GLfloat *m = matrix->m;
	GLfloat x = v[0], y = v[1], z = v[2], w = v[3];

	for (int row = 0; row < 4; row++)
		out[row] = m[row] * x + m[row + 4] * y + m[row + 8] * z + m[row + 12] * w;
}

/* The 2x2 minors of rows or columns @i and @j of four numbers each. */
static double matrix_minor(const double *a, const double *b, int i, int j)
{
	return a[i] * b[j] - a[j] * b[i];
}

/* Cramer's rule on x M = row: the determinant of M with row i replaced by @row, over M's. */
static double matrix_determinant(double row[4][4])
{
	const double *a = row[0], *b = row[1], *c = row[2], *d = row[3];

	return matrix_minor(a, b, 0, 1) * matrix_minor(c, d, 2, 3) -
	       matrix_minor(a, b, 0, 2) * matrix_minor(c, d, 1, 3) +
	       matrix_minor(a, b, 0, 3) * matrix_minor(c, d, 1, 2) +
	       matrix_minor(a, b, 1, 2) * matrix_minor(c, d, 0, 3) -
	       matrix_minor(a, b, 1, 3) * matrix_minor(c, d, 0, 2) +
	       matrix_minor(a, b, 2, 3) * matrix_minor(c, d, 0, 1);
}

void gloss_matrix_apply_inverse(const struct gloss_matrix *matrix, const GLfloat row[4],
				GLfloat out[4])
{
	double rows[4][4], replaced[4][4], determinant;

	for (int i = 0; i < 16; i++)
		rows[i % 4][i / 4] = (double)matrix->m[i];
	determinant = matrix_determinant(rows);
	for (int i = 0; i < 4; i++) {
		memcpy(replaced, rows, sizeof(rows));
		for (int j = 0; j < 4; j++)
			replaced[i][j] = (double)row[j];
		out[i] = determinant == 0 ? 0 :
					    (GLfloat)(matrix_determinant(replaced) / determinant);
	}
}

static struct matrix_stack matrix_stack(struct gloss_context *context)
{
	struct gloss_matrices *matrices = &context->matrices;
	GLint unit = context->attributes.texturing.active;

	switch (context->attributes.transform.matrix_mode) {
	case GL_PROJECTION:
		return (struct matrix_stack){ matrices->projection, &matrices->projection_top,
					      GLOSS_PROJECTION_DEPTH, GLOSS_DIRTY_PROJECTION };
	case GL_TEXTURE:
		return (struct matrix_stack){ matrices->texture[unit], &matrices->texture_top[unit],
					      GLOSS_TEXTURE_DEPTH, 0 };
	default:
		return (struct matrix_stack){ matrices->modelview, &matrices->modelview_top,
					      GLOSS_MODELVIEW_DEPTH, GLOSS_DIRTY_MODELVIEW };
	}
}

/* The matrix that the commands change, which is about to be changed. */
static struct gloss_matrix *matrix_change(struct gloss_context *context)
{
	const struct matrix_stack stack = matrix_stack(context);

	if (stack.dirty)
		gloss_change(context, stack.dirty);
	return stack.matrix + *stack.top;
}

GLOSS_LISTED1(MatrixMode, GLenum, mode)
{
	if (mode == GL_MODELVIEW || mode == GL_PROJECTION || mode == GL_TEXTURE)
		context->attributes.transform.matrix_mode = mode;
	else
		gloss_error(context, GL_INVALID_ENUM);
}

GLOSS_LISTED0(LoadIdentity)
{
	*matrix_change(context) = identity;
}

GLOSS_LISTED1(LoadMatrix, struct gloss_matrix, matrix)
{
	*matrix_change(context) = matrix;
}

GLOSS_LISTED1(MultMatrix, struct gloss_matrix, matrix)
{
	struct gloss_matrix *top = matrix_change(context);

	gloss_matrix_multiply(top, top, &matrix);
}

GLOSS_LISTED0(PushMatrix)
{
	struct matrix_stack stack = matrix_stack(context);

	if (*stack.top + 1 == stack.depth) {
		gloss_error(context, GL_STACK_OVERFLOW);
		return;
	}
	stack.matrix[*stack.top + 1] = stack.matrix[*stack.top];
	++*stack.top;
}

GLOSS_LISTED0(PopMatrix)
{
	struct matrix_stack stack = matrix_stack(context);

	if (!*stack.top) {
		gloss_error(context, GL_STACK_UNDERFLOW);
		return;
	}
	gloss_change(context, stack.dirty);
	--*stack.top;
}

/* Frustum and Ortho have errors of their own, which come when they are executed. */
GLOSS_LISTED6(Frustum, GLdouble, l, GLdouble, r, GLdouble, b, GLdouble, t, GLdouble, n, GLdouble, f)
{
	struct gloss_matrix frustum = { { 0 } }, *top;

	if (n <= 0 || f <= 0 || n == f || l == r || b == t) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	frustum.m[0] = (GLfloat)(2 * n / (r - l));
	frustum.m[5] = (GLfloat)(2 * n / (t - b));
	frustum.m[8] = (GLfloat)((r + l) / (r - l));
	frustum.m[9] = (GLfloat)((t + b) / (t - b));
	frustum.m[10] = (GLfloat)(-(f + n) / (f - n));
	frustum.m[11] = -1;
	frustum.m[14] = (GLfloat)(-2 * f * n / (f - n));
	top = matrix_change(context);
	gloss_matrix_multiply(top, top, &frustum);
}

GLOSS_LISTED6(Ortho, GLdouble, l, GLdouble, r, GLdouble, b, GLdouble, t, GLdouble, n, GLdouble, f)
{
	struct gloss_matrix ortho = identity, *top;

	if (n == f || l == r || b == t) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	ortho.m[0] = (GLfloat)(2 / (r - l));
	ortho.m[5] = (GLfloat)(2 / (t - b));
	ortho.m[10] = (GLfloat)(-2 / (f - n));
	ortho.m[12] = (GLfloat)(-(r + l) / (r - l));
	ortho.m[13] = (GLfloat)(-(t + b) / (t - b));
	ortho.m[14] = (GLfloat)(-(f + n) / (f - n));
	top = matrix_change(context);
	gloss_matrix_multiply(top, top, &ortho);
}

void gl_LoadMatrixf(const GLfloat *m)
{
	struct gloss_matrix matrix;

	memcpy(&matrix, m, sizeof(matrix));
	gl_LoadMatrix(matrix);
}

void gl_MultMatrixf(const GLfloat *m)
{
	struct gloss_matrix matrix;

	memcpy(&matrix, m, sizeof(matrix));
	gl_MultMatrix(matrix);
}

static struct gloss_matrix matrix_from_doubles(const GLdouble *m)
{
	struct gloss_matrix matrix;

	for (int i = 0; i < 16; i++)
		matrix.m[i] = (GLfloat)m[i];
	return matrix;
}

static struct gloss_matrix matrix_transpose(struct gloss_matrix matrix)
{
	struct gloss_matrix transposed;

	for (int i = 0; i < 16; i++)
		transposed.m[i] = matrix.m[i % 4 * 4 + i / 4];
	return transposed;
}

void gl_LoadMatrixd(const GLdouble *m)
{
	gl_LoadMatrix(matrix_from_doubles(m));
}

void gl_MultMatrixd(const GLdouble *m)
{
	gl_MultMatrix(matrix_from_doubles(m));
}

void gl_LoadTransposeMatrixf(const GLfloat *m)
{
	struct gloss_matrix matrix;

	memcpy(&matrix, m, sizeof(matrix));
	gl_LoadMatrix(matrix_transpose(matrix));
}

void gl_MultTransposeMatrixf(const GLfloat *m)
{
	struct gloss_matrix matrix;

	memcpy(&matrix, m, sizeof(matrix));
	gl_MultMatrix(matrix_transpose(matrix));
}

void gl_LoadTransposeMatrixd(const GLdouble *m)
{
	gl_LoadMatrix(matrix_transpose(matrix_from_doubles(m)));
}

void gl_MultTransposeMatrixd(const GLdouble *m)
{
	gl_MultMatrix(matrix_transpose(matrix_from_doubles(m)));
}

void gl_Translated(GLdouble x, GLdouble y, GLdouble z)
{
	struct gloss_matrix matrix = identity;

	matrix.m[12] = (GLfloat)x;
	matrix.m[13] = (GLfloat)y;
	matrix.m[14] = (GLfloat)z;
	gl_MultMatrix(matrix);
}

void gl_Translatef(GLfloat x, GLfloat y, GLfloat z)
{
	gl_Translated((double)x, (double)y, (double)z);
}

void gl_Scaled(GLdouble x, GLdouble y, GLdouble z)
{
	struct gloss_matrix matrix = identity;

	matrix.m[0] = (GLfloat)x;
	matrix.m[5] = (GLfloat)y;
	matrix.m[10] = (GLfloat)z;
	gl_MultMatrix(matrix);
}

void gl_Scalef(GLfloat x, GLfloat y, GLfloat z)
{
	gl_Scaled((double)x, (double)y, (double)z);
}

/* Around an axis of no length nothing turns. */
void gl_Rotated(GLdouble angle, GLdouble x, GLdouble y, GLdouble z)
{
	double length = sqrt(x * x + y * y + z * z), radians = angle * (M_PI / 180);
	double s = sin(radians), c = cos(radians);
	struct gloss_matrix matrix = identity;

	if (length > 0) {
		double a[3] = { x / length, y / length, z / length };

		for (int i = 0; i < 3; i++) {
			int j = (i + 1) % 3, k = (i + 2) % 3;

			matrix.m[5 * i] = (GLfloat)(a[i] * a[i] * (1 - c) + c);
			matrix.m[4 * i + j] = (GLfloat)(a[i] * a[j] * (1 - c) + a[k] * s);
			matrix.m[4 * i + k] = (GLfloat)(a[i] * a[k] * (1 - c) - a[j] * s);
		}
	}
	gl_MultMatrix(matrix);
}

void gl_Rotatef(GLfloat angle, GLfloat x, GLfloat y, GLfloat z)
{
	gl_Rotated((double)angle, (double)x, (double)y, (double)z);
}
