// SPDX-License-Identifier: MIT
/* What a program gets instead of a picture: for OpenGL's selection, feedback and raster position. */
#include <math.h>

#include "draw/draw.h"
#include "draw/geometry_window.h"

int accel_draw_capture(struct accel_draw *draw, accel_capture_fn call, void *data)
{
	int err = accel_draw_check_begun(draw, "a capture");

	if (!err)
		draw->capture = (struct accel_capture){ call, data };
	return err;
}

/* NaN is low. */
static float capture_between(double value, double low, double high)
{
	value = value > low ? value : low;
	return (float)(value < high ? value : high);
}

/* Not snapped to what pixels are found by. Clipping may miss by the rounding of its largest number. */
static void capture_vertex(const struct accel_window *window, const struct accel_corner *corner,
			   const struct accel_vertex *coloured,
			   struct accel_captured_vertex *captured)
{
	const double w = fmax(corner->clip[3], ACCEL_EYE_W_MIN), *guard = window->guard;
	double at[3];

	for (int i = 0; i < 3; i++)
		at[i] = corner->clip[i] / w * window->scale[i] + window->offset[i];
	captured->window[0] = capture_between(at[0], guard[0], guard[1]);
	captured->window[1] = capture_between(at[1], guard[2], guard[3]);
	captured->window[2] = capture_between(at[2], 0, 1);
	captured->window[3] = (float)w;
	for (int i = 0; i < 4; i++)
		captured->colour[i] = capture_between((double)coloured->sample.colour[i], 0, 1);
}

void accel_capture(const struct accel_pass *pass, enum accel_captured what,
		   const struct accel_corner *corner, uint32_t corners,
		   const struct accel_vertex *flat, struct accel_captured_vertex *captured)
{
	const bool is_flat = pass->state->shading == ACCEL_SHADING_FLAT;

	for (uint32_t i = 0; i < corners; i++)
		capture_vertex(&pass->transform.window, &corner[i],
			       is_flat ? flat : &corner[i].vertex, &captured[i]);
	pass->capture.call(pass->capture.data, what, captured, corners);
}
