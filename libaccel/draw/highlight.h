/* SPDX-License-Identifier: MIT */
/* Where highlights can be seen. */
#ifndef ACCEL_DRAW_HIGHLIGHT_H
#define ACCEL_DRAW_HIGHLIGHT_H

#include <math.h>

#include "draw/draw_priv.h"
#include "draw/loop.h"

/*
 * SH-HILITE: can a highlight be seen within an angle, of which @sine_squared is given, of points
 * where the half vector is @shine or more from the normal? With the half vector moving along the
 * surface (a near viewer, a near lamp) there is no closed form for its nearest approach; but it can
 * not come nearer than the angle that is left.
 */
LOOP_INLINE bool highlight_near(const struct accel_finish *finish, float shine, float sine_squared)
{
	float sine = sqrtf(sine_squared), cosine = sqrtf(1 - sine_squared);
	bool near = shine > finish->visible_cosine * cosine - finish->visible_sine * sine;

	return (finish->visible_cosine <= 1) & (!(sine_squared < 1) | near);
}

#endif
