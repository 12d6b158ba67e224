/* SPDX-License-Identifier: MIT */
/* Smaller, larger, between, and the product of directions, as the stages take them. */
#ifndef ACCEL_NUMBER_H
#define ACCEL_NUMBER_H

static inline int number_min(int a, int b)
{
	return a < b ? a : b;
}

static inline int number_max(int a, int b)
{
	return a > b ? a : b;
}

static inline int number_clamp(int value, int low, int high)
{
	return value < low ? low : value > high ? high : value;
}

static inline float number_larger(float a, float b)
{
	return a > b ? a : b;
}

static inline float number_dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

#endif
