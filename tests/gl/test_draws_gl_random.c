// SPDX-License-Identifier: MIT
/*
 * Random lit scenes, drawn by the library on the model and worked out by the oracle. GL_SCENES says
 * how many; GLOSS_SEED which.
 */
#include <math.h>

#include "scene_random.h"

#define SCENES 400

/*
 * Well inside of a triangle. A pixel on its rim is not compared: of a sliver a pixel wide the colour
 * may change by all of its range from one end to the other, and rounding a corner moves it so far.
 */
#define INSIDE 1.0
/*
 * The number itself rounds by half a step, and fixed point may be off by 0.15 more; a step is what
 * is asked for. In perspective, colours are second-order surfaces, for which the library promises 2
 * and for alpha, which is always linear in parts, 4.
 */
#define STEPS_STRAIGHT 1.0
#define STEPS_PERSPECTIVE 2.0

static void random_scene(uint64_t *seed, bool perspective, struct scene *scene)
{
	static const enum oracle_topology drawn[] = { ORACLE_TRIANGLES, ORACLE_TRIANGLE_STRIP,
						      ORACLE_TRIANGLE_FAN };
	uint32_t vertices = 3 + test_below(seed, 7);

	scene_init(scene, drawn[test_below(seed, 3)]);
	scene_random_state(seed, perspective, &scene->gl);
	for (uint32_t i = 0; i < vertices; i++) {
		struct oracle_vertex *vertex = scene_vertex(scene, scene_between(seed, -1, 1),
							    scene_between(seed, -1, 1),
							    scene_between(seed, -1, 1));

		scene_random_direction(seed, vertex->normal);
		scene_random_colour(seed, 1, vertex->colour);
	}
}

/* Of all scenes of a run. */
struct run {
	int scenes, doubtful;
	long covered, compared;
	double colour, mean;
};

static void check(struct board *board, const struct scene *scene, int n, double steps,
		  struct run *run)
{
	static struct drawing drawing;
	const struct oracle_picture *picture = scene_work_out(scene);
	struct difference d;

	run->scenes++;
	run->doubtful += picture->doubtful;
	if (picture->doubtful)
		return;
	scene_draw(board, scene, ACCEL_SHADING_GOURAUD, &drawing);
	d = scene_compare(&drawing, picture, INSIDE);
	if (d.coverage)
		fail_msg("scene %d: %d of %d pixels are drawn by one only", n, d.coverage,
			 d.covered);
	if (d.depth > 0)
		fail_msg("scene %d: depth is %g steps farther off than it may be", n, d.depth);
	if (d.colour > steps)
		fail_msg("scene %d: pixel %d,%d is off by %g of 255", n, d.x, d.y, d.colour);
	run->covered += d.covered;
	run->compared += d.compared;
	run->colour = fmax(run->colour, d.colour);
	run->mean += d.mean * d.compared;
}

static void run_scenes(struct board *board, bool perspective, double steps)
{
	uint64_t seed = test_seed();
	struct run run = { 0 };

	for (int n = 0; n < scene_count(SCENES); n++) {
		struct scene scene;

		random_scene(&seed, perspective, &scene);
		check(board, &scene, n, steps, &run);
	}
	print_message(
		"%d scenes, %d in doubt; %ld pixels, %ld compared: of 255 mean %.3f, most %.3f\n",
		run.scenes, run.doubtful, run.covered, run.compared,
		run.mean / (double)run.compared, run.colour);
	assert_true(run.doubtful < run.scenes / 4 + 5);
	assert_true(run.compared / run.scenes > 300);
}

static void without_perspective_scenes_are_within_a_step(void **state)
{
	run_scenes(*state, false, STEPS_STRAIGHT);
}

static void in_perspective_scenes_are_as_near_as_promised(void **state)
{
	run_scenes(*state, true, STEPS_PERSPECTIVE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(without_perspective_scenes_are_within_a_step),
		cmocka_unit_test(in_perspective_scenes_are_as_near_as_promised),
	};

	return cmocka_run_group_tests(tests, scene_setup, scene_teardown);
}
