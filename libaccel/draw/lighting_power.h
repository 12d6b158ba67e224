/* SPDX-License-Identifier: MIT */
/* The power function of a highlight and of a spot, without a branch. */
#ifndef ACCEL_DRAW_LIGHTING_POWER_H
#define ACCEL_DRAW_LIGHTING_POWER_H

#include "draw/loop.h"

/* log2 of a normal number: exponent, and the series of atanh on the rest, sqrt(1/2) to sqrt(2). */
LOOP_INLINE float loop_log2(float x)
{
	uint32_t bits;
	int exponent;
	float t, t2;

	memcpy(&bits, &x, sizeof(bits));
	exponent = (int32_t)(bits - 0x3f3504f3) >> 23;
	bits -= (uint32_t)exponent << 23;
	memcpy(&x, &bits, sizeof(x));
	t = (x - 1) / (x + 1);
	t2 = t * t;
	return (float)exponent +
	       t * (2.885390082f + t2 * (0.961796694f + t2 * (0.577078016f + t2 * 0.412198583f)));
}

/* 2^y for -126 <= y <= 0: the exponent, and Taylor's series on the rest, -1/2 to 1/2. */
LOOP_INLINE float loop_exp2(float y)
{
	int whole = (int)(y - 0.5f);
	float f = y - (float)whole;
	uint32_t bits = (uint32_t)(whole + 127) << 23;
	float scale;

	memcpy(&scale, &bits, sizeof(scale));
	return scale *
	       (1 +
		f * (0.693147181f +
		     f * (0.240226507f +
			  f * (0.0555041087f + f * (0.00961812911f +
						    f * (0.00133335581f + f * 0.000154035304f))))));
}

/*
 * @x to the power of @n, 0 <= x <= 1, 0 <= n; 0 below 2^-126. The C library's powf is exact to the
 * last bit, slower, and not the same in all of them.
 */
LOOP_INLINE float loop_power(float x, float n)
{
	bool some = x >= 0x1p-126f;
	float y = n * loop_log2(loop_choose(some, x, 1)), power;

	power = loop_choose(y > -126, y, -126);
	power = loop_exp2(loop_choose(power < 0, power, 0));
	power = loop_choose(y < 0, power, 1);
	power = loop_choose(some & (y > -126), power, 0);
	return loop_choose(n == 0, 1, power);
}

#endif
