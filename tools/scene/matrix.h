/* SPDX-License-Identifier: MIT */
/* 4x4 matrices as accel.h has them: floats, column by column, vectors are columns. */
#ifndef TOOLS_MATRIX_H
#define TOOLS_MATRIX_H

void matrix_identity(float m[16]);
/* m = a * b; m may be a or b. */
void matrix_multiply(float m[16], const float a[16], const float b[16]);

/* m = m * the transformation, as the calls of OpenGL do. */
void matrix_translate(float m[16], float x, float y, float z);
void matrix_scale(float m[16], float factor);
void matrix_rotate_x(float m[16], float degrees);
void matrix_rotate_y(float m[16], float degrees);
void matrix_rotate_z(float m[16], float degrees);

/* Projections. @fov is the angle from bottom to top in degrees, @half_height half the picture
 * in eye units, @aspect width by height. */
void matrix_perspective(float m[16], float fov, float aspect, float near, float far);
void matrix_orthographic(float m[16], float half_height, float aspect, float near, float far);

/* For normals: the transposed inverse of the upper 3x3, column by column; 0 if @m is singular. */
void matrix_normal(float n[9], const float m[16]);

void matrix_transform(float out[4], const float m[16], const float point[3]);

#endif
