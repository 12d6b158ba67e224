// SPDX-License-Identifier: MIT
/*
 * Points and lines that the library draws on the model, as the oracle has them: the same pixels, and
 * their colours and depths. GL_SCENES says how many random scenes there are, GLOSS_SEED which.
 */
#include <math.h>

#include "scene_random.h"

#define SCENES 300
#define STEP 1.0
/* What the library promises of perspective. */
#define STEPS_PERSPECTIVE 2.0

/* In pixels of the window. */
static struct oracle_vertex *pixel_vertex(struct scene *scene, double x, double y)
{
	return scene_vertex(scene, 2 * x / SCENE_SIDE - 1, 2 * y / SCENE_SIDE - 1, 0);
}

/* Where points lie between pixels, and which are theirs (3.3). */
static void points_are_squares_around_their_middle(void **state)
{
	for (int size = 1; size < 9; size++)
		for (int i = 0; i < 64; i++) {
			struct scene scene;

			scene_init(&scene, ORACLE_POINTS);
			scene.gl.point_size = size;
			pixel_vertex(&scene, 20 + i % 8 / 8.0, 30 + i / 8 / 8.0);
			scene_assert(*state, &scene, STEP, size * size);
		}
}

static void points_shrink_with_their_distance(void **state)
{
	struct scene scene;

	scene_init(&scene, ORACLE_POINTS);
	scene.gl.point_size = 20;
	scene.gl.point_least = 3;
	scene.gl.point_most = 12;
	scene.gl.point_attenuation[0] = 0.25;
	scene.gl.point_attenuation[2] = 8;
	for (int i = 0; i < 8; i++)
		scene_vertex(&scene, 0.2 * i - 0.8, 0.1 * i - 0.4, 0.1 * i - 0.5);
	scene_assert(*state, &scene, STEP, 100);
}

/* Two ends in each of sixteen directions, of each width. */
static void lines_are_so_many_pixels_at_each_place(void **state)
{
	for (int width = 1; width < 6; width++)
		for (int i = 0; i < 16; i++) {
			struct scene scene;
			double angle = 0.1 + 6.2831853 * i / 16;

			scene_init(&scene, ORACLE_LINES);
			scene.gl.line_width = width;
			pixel_vertex(&scene, 48, 48)->colour[0] = 0;
			pixel_vertex(&scene, 48 + 30 * cos(angle), 48 + 30 * sin(angle));
			scene_assert(*state, &scene, STEP, 10 * width);
		}
}

static void strips_and_loops_of_lines_meet(void **state)
{
	static const enum oracle_topology topologies[] = { ORACLE_LINE_STRIP, ORACLE_LINE_LOOP };

	for (int i = 0; i < 2; i++) {
		struct scene scene;

		scene_init(&scene, topologies[i]);
		for (int j = 0; j < 9; j++)
			pixel_vertex(&scene, 48.3 + 40 * cos(0.1 + j * 2.1),
				     48.3 + 40 * sin(0.1 + j * 2.1))
				->colour[j % 3] = 0;
		scene_assert(*state, &scene, STEP, 200);
	}
}

static void stipples_have_bits_for_so_many_pixels(void **state)
{
	for (int repeat = 1; repeat < 4; repeat++)
		for (int i = 0; i < 16; i++) {
			struct scene scene;
			double angle = 0.1 + 6.2831853 * i / 16;

			scene_init(&scene, ORACLE_LINES);
			scene.gl.stipple = 0x6b35;
			scene.gl.stipple_repeat = repeat;
			/* The second bit begins in the middle of a pixel. */
			pixel_vertex(&scene, 48.4375, 48.5625)->colour[1] = 0;
			pixel_vertex(&scene, 48 + 40 * cos(angle), 48 + 40 * sin(angle));
			scene_assert(*state, &scene, STEP, 5);
		}
}

static void random_strokes(uint64_t *seed, bool perspective, struct scene *scene)
{
	const enum oracle_topology topology = (enum oracle_topology)test_below(seed,
									       ORACLE_TRIANGLES);
	uint32_t vertices = 2 + test_below(seed, 7);

	scene_init(scene, topology);
	scene_random_state(seed, perspective, &scene->gl);
	/* All of the target, as fragments of what is wide may be outside of a viewport. */
	memcpy(scene->gl.viewport, (const double[4]){ 0, 0, SCENE_SIDE, SCENE_SIDE },
	       sizeof(scene->gl.viewport));
	scene->gl.point_size = scene_between(seed, 0, 12);
	scene->gl.line_width = scene_between(seed, 0, 6);
	if (topology == ORACLE_LINES && test_below(seed, 2)) {
		scene->gl.stipple = (unsigned int)test_below(seed, 1 << 16);
		scene->gl.stipple_repeat = 1 + (int)test_below(seed, 5);
	}
	for (uint32_t i = 0; i < vertices; i++) {
		struct oracle_vertex *vertex = scene_vertex(scene, scene_between(seed, -0.7, 0.7),
							    scene_between(seed, -0.7, 0.7),
							    scene_between(seed, -0.7, 0.7));

		scene_random_direction(seed, vertex->normal);
		scene_random_colour(seed, 1, vertex->colour);
	}
}

static void run_scenes(struct board *board, bool perspective, double steps)
{
	uint64_t seed = test_seed();
	int doubtful = 0;

	for (int n = 0; n < scene_count(SCENES); n++) {
		struct scene scene;

		random_strokes(&seed, perspective, &scene);
		if (scene_work_out(&scene)->doubtful) {
			doubtful++;
			continue;
		}
		scene_assert(board, &scene, steps, 0);
	}
	print_message("%d scenes, %d in doubt\n", scene_count(SCENES), doubtful);
	assert_true(doubtful < scene_count(SCENES) / 4 + 5);
}

static void random_strokes_are_within_a_step(void **state)
{
	run_scenes(*state, false, STEP);
}

static void in_perspective_random_strokes_are_as_near_as_promised(void **state)
{
	run_scenes(*state, true, STEPS_PERSPECTIVE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(points_are_squares_around_their_middle),
		cmocka_unit_test(points_shrink_with_their_distance),
		cmocka_unit_test(lines_are_so_many_pixels_at_each_place),
		cmocka_unit_test(strips_and_loops_of_lines_meet),
		cmocka_unit_test(stipples_have_bits_for_so_many_pixels),
		cmocka_unit_test(random_strokes_are_within_a_step),
		cmocka_unit_test(in_perspective_random_strokes_are_as_near_as_promised),
	};

	return cmocka_run_group_tests(tests, scene_setup, scene_teardown);
}
