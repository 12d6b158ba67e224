/* SPDX-License-Identifier: MIT */
/*
 * A program that is compiled with headers of several versions, and draws a lit triangle. It prints
 * the sum of its pixels and what it was told; LATER: of a version that is still to come, whose
 * structs have a member @later.
 */
#include <accel.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#define SIDE 64

static const float corner[3][3] = { { -0.9f, -0.8f, 0 }, { 0.9f, -0.8f, 0 }, { 0, 0.9f, 0 } };
static const float normal[3][3] = { { -0.5f, -0.4f, 1 }, { 0.5f, -0.4f, 1 }, { 0, 0.5f, 1 } };

static struct accel_device *device;
static struct accel_target *target;
static struct accel_state *state;
static struct accel_draw *draw;

static int failed(const char *what, int err)
{
	fprintf(stderr, "%s: %s\n", what, strerror(-err));
	return 1;
}

static int draw_triangle(void)
{
	const struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH,
						     .rgba = { 0, 0, 1, 1 });
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3, .position = { .data = corner },
						  .normal = { .data = normal });
	int err = accel_draw_begin(draw, target, &clear);

	if (!err)
		err = accel_draw_mesh(draw, state, &mesh);
	return err ? err : accel_draw_finish(draw);
}

static int set_light(void)
{
	const struct accel_light lamp = ACCEL_LIGHT(.enabled = true, .position = { 0, 0, 1, 1 },
						    .diffuse = { 1, 1, 1, 1 });
	const struct accel_material red = ACCEL_MATERIAL(.diffuse = { 1, 0.2f, 0.2f, 1 });
	int err = accel_state_set_light(state, 0, &lamp);

	accel_state_set_lighting(state, true);
	return err ? err : accel_state_set_material(state, &red, NULL);
}

static int print_sum(void)
{
	uint32_t pixel[SIDE * SIDE], sum = 0;
	int err = accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixel, SIDE * 4);

	for (int i = 0; i < SIDE * SIDE && !err; i++)
		sum = sum * 31 + pixel[i];
	printf("pixels %08x\n", sum);
	return err;
}

static void print_answers(void)
{
	struct accel_device_info info;
	struct accel_draw_stats stats;

	memset(&info, 0xee, sizeof(info));
	memset(&stats, 0xee, sizeof(stats));
	accel_device_info(device, &info, sizeof(info));
	accel_draw_stats(draw, &stats, sizeof(stats));
	printf("tile size %u, triangles %u\n", info.tile_size, (unsigned int)stats.triangles_in);
#ifdef LATER
	printf("later %d\n", info.later || stats.later);
#endif
}

#ifdef LATER
/* What this library can not know is not ignored. */
static int print_refusals(void)
{
	const struct accel_light lamp = ACCEL_LIGHT(.later = 1);
	const struct accel_material red = ACCEL_MATERIAL(.later = 1);
	const struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH, .later = 1);
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .later = 1);
	int refused = accel_state_set_light(state, 0, &lamp) == -E2BIG;

	refused += accel_state_set_material(state, &red, NULL) == -E2BIG;
	refused += accel_draw_begin(draw, target, &clear) == -E2BIG;
	refused += !accel_draw_begin(draw, target, NULL) &&
		   accel_draw_mesh(draw, state, &mesh) == -E2BIG;
	printf("refused %d\n", refused);
	return 0;
}
#else
static int print_refusals(void)
{
	return 0;
}
#endif

int main(void)
{
	int err = accel_device_new("model:", NULL, NULL, &device);

	if (!err)
		err = accel_target_new(device, SIDE, SIDE, &target);
	if (!err)
		err = accel_draw_new(device, &draw);
	if (!err)
		err = accel_state_new(&state);
	if (!err)
		err = set_light();
	if (!err)
		err = draw_triangle();
	if (!err)
		err = print_sum();
	if (err)
		return failed("the program", err);
	print_answers();
	print_refusals();
	accel_draw_free(draw);
	accel_state_free(state);
	accel_target_free(target);
	accel_device_free(device);
	return 0;
}
