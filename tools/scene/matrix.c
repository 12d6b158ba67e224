// SPDX-License-Identifier: MIT
#include <math.h>
#include <string.h>

#include "scene/matrix.h"

#define RADIANS(degrees) ((degrees) * (3.14159265358979f / 180))

void matrix_identity(float m[16])
{
	memset(m, 0, 16 * sizeof(*m));
	m[0] = m[5] = m[10] = m[15] = 1;
}

void matrix_multiply(float m[16], const float a[16], const float b[16])
{
	float product[16];

	for (int column = 0; column < 4; column++) {
		for (int row = 0; row < 4; row++) {
			float sum = 0;

			for (int i = 0; i < 4; i++)
				sum += a[i * 4 + row] * b[column * 4 + i];
			product[column * 4 + row] = sum;
		}
	}
	memcpy(m, product, sizeof(product));
}

void matrix_translate(float m[16], float x, float y, float z)
{
	float t[16];

	matrix_identity(t);
	t[12] = x;
	t[13] = y;
	t[14] = z;
	matrix_multiply(m, m, t);
}

void matrix_scale(float m[16], float factor)
{
	float s[16];

	matrix_identity(s);
	s[0] = s[5] = s[10] = factor;
	matrix_multiply(m, m, s);
}

/* Turns axis @a towards axis @b. */
static void rotate(float m[16], int a, int b, float degrees)
{
	float r[16];

	matrix_identity(r);
	r[a * 4 + a] = r[b * 4 + b] = cosf(RADIANS(degrees));
	r[a * 4 + b] = sinf(RADIANS(degrees));
	r[b * 4 + a] = -r[a * 4 + b];
	matrix_multiply(m, m, r);
}

void matrix_rotate_x(float m[16], float degrees)
{
	rotate(m, 1, 2, degrees);
}

void matrix_rotate_y(float m[16], float degrees)
{
	rotate(m, 2, 0, degrees);
}

void matrix_rotate_z(float m[16], float degrees)
{
	rotate(m, 0, 1, degrees);
}

void matrix_perspective(float m[16], float fov, float aspect, float near, float far)
{
	float f = 1 / tanf(RADIANS(fov) / 2);

	memset(m, 0, 16 * sizeof(*m));
	m[0] = f / aspect;
	m[5] = f;
	m[10] = (far + near) / (near - far);
	m[11] = -1;
	m[14] = 2 * far * near / (near - far);
}

void matrix_orthographic(float m[16], float half_height, float aspect, float near, float far)
{
	memset(m, 0, 16 * sizeof(*m));
	m[0] = 1 / (half_height * aspect);
	m[5] = 1 / half_height;
	m[10] = 2 / (near - far);
	m[14] = (far + near) / (near - far);
	m[15] = 1;
}

void matrix_normal(float n[9], const float m[16])
{
	float determinant;

	/* The cofactors are the transposed inverse but for the determinant. */
	for (int column = 0; column < 3; column++) {
		const float *p = m + (column + 1) % 3 * 4, *q = m + (column + 2) % 3 * 4;

		for (int row = 0; row < 3; row++) {
			int j = (row + 1) % 3, k = (row + 2) % 3;

			n[column * 3 + row] = p[j] * q[k] - p[k] * q[j];
		}
	}
	determinant = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
	for (int i = 0; i < 9; i++)
		n[i] = determinant != 0 ? n[i] / determinant : 0;
}

void matrix_transform(float out[4], const float m[16], const float point[3])
{
	for (int row = 0; row < 4; row++)
		out[row] = m[row] * point[0] + m[4 + row] * point[1] + m[8 + row] * point[2] +
			   m[12 + row];
}
