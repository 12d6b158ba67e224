/* SPDX-License-Identifier: MIT */
/* A light, and its highlight between three vertices: highlight [DEVICE] >highlight.ppm */
#include <accel.h>
#include <stdio.h>

static const float corner[3][3] = { { -0.9f, -0.8f, 0 }, { 0.9f, -0.8f, 0 }, { 0, 0.9f, 0 } };
static const float normal[3][3] = { { -0.5f, -0.4f, 1 }, { 0.5f, -0.4f, 1 }, { 0, 0.5f, 1 } };
static const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						 .vertices = 3, .position = { .data = corner },
						 .normal = { .data = normal });
static const struct accel_material gold = ACCEL_MATERIAL(.diffuse = { 0.6f, 0.4f, 0.1f, 1 },
							 .specular = { 0.6f, 0.6f, 0.5f, 1 },
							 .shininess = 30);
static const struct accel_light lamp = ACCEL_LIGHT(.enabled = true, .position = { 0, 0, 1, 0 },
						   .diffuse = { 1, 1, 1, 1 },
						   .specular = { 1, 1, 1, 1 });

/* A state that lights with the lamp, from a viewer who is far away. */
static struct accel_state *lit(void)
{
	struct accel_state *state;

	if (accel_state_new(&state))
		return NULL;
	accel_state_set_lighting(state, true);
	accel_state_set_local_viewer(state, false);
	if (!accel_state_set_material(state, &gold, NULL) &&
	    !accel_state_set_light(state, 0, &lamp))
		return state;
	accel_state_free(state);
	return NULL;
}

int main(int argc, char **argv)
{
	static unsigned char pixel[256 * 256][4];
	struct accel_state *state = lit();
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;

	if (!state ||
	    accel_device_new(argc > 1 ? argv[1] : NULL, accel_message_print, NULL, &device) ||
	    accel_target_new(device, 256, 256, &target) || accel_draw_new(device, &draw) ||
	    accel_draw_begin(draw, target, NULL) || accel_draw_mesh(draw, state, &mesh) ||
	    accel_draw_finish(draw) ||
	    accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixel, 256 * 4))
		return 1;
	printf("P6 256 256 255\n");
	for (int i = 0; i < 256 * 256; i++)
		fwrite(pixel[i], 1, 3, stdout);

	accel_draw_free(draw);
	accel_target_free(target);
	accel_device_free(device);
	accel_state_free(state);
	return 0;
}
