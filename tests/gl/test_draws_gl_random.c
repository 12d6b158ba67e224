// SPDX-License-Identifier: MIT
/*
 * Random lit scenes, drawn by the library on the model and worked out by the oracle. GL_SCENES says
 * how many; GLOSS_SEED which.
 */
#include <math.h>

#include "scene.h"

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

static int scenes(void)
{
	const char *given = getenv("GL_SCENES");
	int count = given ? atoi(given) : 0;

	return count > 0 ? count : SCENES;
}

static double unit(uint64_t *seed)
{
	return (double)(test_random(seed) >> 40) * 0x1p-24;
}

/* A whole float. */
static double between(uint64_t *seed, double low, double high)
{
	return (double)(float)(low + (high - low) * unit(seed));
}

static void random_colour(uint64_t *seed, double most, double out[4])
{
	for (int i = 0; i < 4; i++)
		out[i] = between(seed, 0, most);
}

static void random_direction(uint64_t *seed, double out[3])
{
	double length;

	do {
		for (int i = 0; i < 3; i++)
			out[i] = between(seed, -1, 1);
		length = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
	} while (length > 1 || length < 0.01);
}

/* Turned around two axes, scaled, and away from the eye. */
static void random_modelview(uint64_t *seed, double away, double out[16])
{
	double a = between(seed, 0, 6.3), b = between(seed, 0, 6.3);
	const double turned[9] = { cos(b), sin(b) * sin(a),  -sin(b) * cos(a), 0, cos(a), sin(a),
				   sin(b), -cos(b) * sin(a), cos(b) * cos(a) };
	double scale = between(seed, 0.5, 1.5);

	memset(out, 0, 16 * sizeof(*out));
	for (int column = 0; column < 3; column++) {
		double own = test_below(seed, 4) ? scale : between(seed, 0.5, 1.5);

		for (int row = 0; row < 3; row++)
			out[4 * column + row] = (double)(float)(own * turned[3 * column + row]);
	}
	out[12] = between(seed, -0.5, 0.5);
	out[13] = between(seed, -0.5, 0.5);
	out[14] = -away;
	out[15] = 1;
}

/* Boxes and frusta whose near and far planes cut some of what is drawn. */
static void random_projection(uint64_t *seed, bool perspective, double out[16])
{
	double near = between(seed, 1.5, 2.5), far = between(seed, 3.5, 5), wide = 1.2;

	memset(out, 0, 16 * sizeof(*out));
	if (perspective) {
		out[0] = out[5] = (double)2.2f;
		out[10] = (double)(float)((far + near) / (near - far));
		out[11] = -1;
		out[14] = (double)(float)(2 * far * near / (near - far));
		return;
	}
	out[0] = out[5] = (double)(float)(1 / wide);
	out[10] = (double)(float)(2 / (near - far));
	out[14] = (double)(float)((far + near) / (near - far));
	out[15] = 1;
}

static void random_light(uint64_t *seed, struct oracle_light *light)
{
	bool point = test_below(seed, 2);

	light->enabled = true;
	random_direction(seed, light->position);
	random_colour(seed, 0.2, light->ambient);
	random_colour(seed, 1, light->diffuse);
	random_colour(seed, 1, light->specular);
	if (!point)
		return;
	for (int i = 0; i < 3; i++)
		light->position[i] = (double)(float)(3 * light->position[i]);
	light->position[3] = 1;
	light->attenuation[0] = between(seed, 0.5, 1);
	light->attenuation[1] = between(seed, 0, 0.5);
	light->attenuation[2] = between(seed, 0, 0.2);
	if (test_below(seed, 2))
		return;
	light->spot_cutoff = between(seed, 20, 90);
	light->spot_exponent = between(seed, 0, 20);
	/* About towards the middle of what is drawn. */
	for (int i = 0; i < 3; i++)
		light->spot_direction[i] = (double)(float)((i == 2 ? -3 : 0) - light->position[i]);
}

static void random_material(uint64_t *seed, struct oracle_material *material)
{
	random_colour(seed, 0.2, material->emission);
	random_colour(seed, 1, material->ambient);
	random_colour(seed, 1, material->diffuse);
	random_colour(seed, 1, material->specular);
	material->shininess = test_below(seed, 2) ? between(seed, 1, 128) : between(seed, 1, 8);
}

static void random_state(uint64_t *seed, bool perspective, struct oracle_state *gl)
{
	random_modelview(seed, 3, gl->modelview);
	random_projection(seed, perspective, gl->projection);
	gl->lighting = test_below(seed, 8);
	gl->local_viewer = test_below(seed, 2);
	gl->two_sided = test_below(seed, 2);
	gl->flat = !test_below(seed, 6);
	gl->cull = (enum oracle_cull)(test_below(seed, 4) ? 0 : 1 + test_below(seed, 2));
	if (!test_below(seed, 4))
		gl->follow[0] = gl->follow[1] = ORACLE_AMBIENT | ORACLE_DIFFUSE;
	random_colour(seed, 0.5, gl->ambient);
	for (int i = 0; i < ORACLE_SIDES; i++)
		random_material(seed, &gl->material[i]);
	for (uint32_t i = test_below(seed, 4); i < 4; i++)
		random_light(seed, &gl->light[test_below(seed, ORACLE_LIGHTS)]);
	if (!test_below(seed, 4)) {
		gl->viewport[0] = 10;
		gl->viewport[1] = 7;
		gl->viewport[2] = 61;
		gl->viewport[3] = 77;
	}
}

static void random_scene(uint64_t *seed, bool perspective, struct scene *scene)
{
	static const enum oracle_topology drawn[] = { ORACLE_TRIANGLES, ORACLE_TRIANGLE_STRIP,
						      ORACLE_TRIANGLE_FAN };
	uint32_t vertices = 3 + test_below(seed, 7);

	scene_init(scene, drawn[test_below(seed, 3)]);
	random_state(seed, perspective, &scene->gl);
	for (uint32_t i = 0; i < vertices; i++) {
		struct oracle_vertex *vertex = scene_vertex(scene, between(seed, -1, 1),
							    between(seed, -1, 1),
							    between(seed, -1, 1));

		random_direction(seed, vertex->normal);
		random_colour(seed, 1, vertex->colour);
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

	for (int n = 0; n < scenes(); n++) {
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
