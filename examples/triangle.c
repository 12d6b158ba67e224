/* SPDX-License-Identifier: MIT */
/* A triangle with a colour at each corner: triangle [DEVICE] >triangle.ppm */
#include <accel.h>
#include <stdio.h>

static const float corner[3][3] = { { -0.9f, -0.8f, 0 }, { 0.9f, -0.8f, 0 }, { 0, 0.9f, 0 } };
static const float colour[3][4] = { { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 } };
static const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						 .vertices = 3, .position = { .data = corner },
						 .colour = { .data = colour });

int main(int argc, char **argv)
{
	static unsigned char pixel[256 * 256][4];
	struct accel_device *device;
	struct accel_target *target;
	struct accel_state *state;
	struct accel_draw *draw;

	if (accel_device_new(argc > 1 ? argv[1] : "auto", accel_message_print, stderr, &device) ||
	    accel_target_new(device, 256, 256, &target) || accel_draw_new(device, &draw) ||
	    accel_state_new(&state) || accel_draw_begin(draw, target, NULL) ||
	    accel_draw_mesh(draw, state, &mesh) || accel_draw_finish(draw) ||
	    accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixel, 256 * 4))
		return 1;
	printf("P6 256 256 255\n");
	for (int i = 0; i < 256 * 256; i++)
		fwrite(pixel[i], 1, 3, stdout);
	return 0;
}
