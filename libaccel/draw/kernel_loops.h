/* SPDX-License-Identifier: MIT */
/*
 * All loops and their table, for each file that is compiled for a set of instructions and defines
 * KERNEL, KERNEL_NAME and kernel_runs(). Loops have no branches that depend on an element, calls
 * neither; what one element needs and another does not is worked out for both, and one of two
 * values taken.
 */
#include "draw/geometry_loop.h"
#include "draw/lighting_loop.h"
#include "draw/edge_loop.h"
#include "draw/pixel_loop.h"
#include "draw/setup_loop.h"
#include "draw/fit_loop.h"
#include "draw/few_loop.h"
#include "draw/small_loop.h"

const struct accel_kernel KERNEL = {
	.name = KERNEL_NAME,
	.runs = kernel_runs,
	.transform = loop_transform,
	.light = loop_light,
	.light_lamp = loop_light_lamp,
	.edge = loop_edge,
	.pixel = loop_pixel,
	.setup = loop_setup,
	.plane = loop_plane_batch,
	.fit = loop_fit,
	.few = loop_few,
	.small = loop_small,
};
