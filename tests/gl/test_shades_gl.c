// SPDX-License-Identifier: MIT
/*
 * What better shading than OpenGL's may change of a picture: not its vertices, nothing that is
 * straight, and the rest only towards the picture whose pixels are lit one by one.
 */
#include <math.h>

#include "scene_random.h"

#define SCENES 150
#define STEPS 255.0
#define RIM 7

/* Square steps. Where both are as good as they can be, rounding decides which is nearer. */
#define NOISE 0.25

/* The middle of a pixel about there, in NDC. */
static double pixel_middle(double at)
{
	return (double)(float)((2 * floor((at + 1) * SCENE_SIDE / 2) + 1) / SCENE_SIDE - 1);
}

/* A box from -1 to 1, its middle 3 away from the eye. */
static void look_along_z(struct oracle_state *gl)
{
	static const double view[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1 };
	static const double box[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -3, 1 };

	memcpy(gl->modelview, view, sizeof(view));
	memcpy(gl->projection, box, sizeof(box));
	gl->viewport[0] = gl->viewport[1] = 0;
	gl->viewport[2] = gl->viewport[3] = SCENE_SIDE;
}

/* A cap of a sphere: a fan whose vertices are in the middle of pixels, looked at along z. */
static void random_cap(uint64_t *seed, struct scene *scene)
{
	const struct oracle_vertex *middle;
	double bend = scene_between(seed, 0.2, 1);

	scene_init(scene, ORACLE_TRIANGLE_FAN);
	scene_random_state(seed, false, &scene->gl);
	scene->gl.lighting = true;
	scene->gl.flat = false;
	scene->gl.cull = ORACLE_CULL_NONE;
	scene->gl.normals = ORACLE_NORMALISED;
	look_along_z(&scene->gl);
	middle = scene_vertex(scene, pixel_middle(scene_between(seed, -0.2, 0.2)),
			      pixel_middle(scene_between(seed, -0.2, 0.2)), 0.5);
	for (int i = 0; i <= RIM; i++) {
		double angle = 6.2831853 * (i % RIM) / RIM;
		struct oracle_vertex *vertex = scene_vertex(scene, pixel_middle(0.8 * cos(angle)),
							    pixel_middle(0.8 * sin(angle)), 0);

		for (int j = 0; j < 2; j++)
			vertex->normal[j] = (double)(float)(bend * (vertex->position[j] -
								    middle->position[j]));
		scene_random_colour(seed, 1, vertex->colour);
		if (i == RIM)
			memcpy(vertex, &scene->vertex[1], sizeof(*vertex));
	}
}

static void draw(struct board *board, const struct scene *scene, struct drawing drawing[2])
{
	scene_draw(board, scene, ACCEL_SHADING_GOURAUD, &drawing[0]);
	scene_draw(board, scene, ACCEL_SHADING_ADAPTIVE, &drawing[1]);
	assert_memory_equal(drawing[0].depth, drawing[1].depth, sizeof(drawing[0].depth));
}

/* The most that a channel differs by at a pixel. */
static int apart(uint32_t a, uint32_t b)
{
	int most = 0;

	for (int bit = 0; bit < 32; bit += 8) {
		int off = abs((int)(a >> bit & 255) - (int)(b >> bit & 255));

		most = off > most ? off : most;
	}
	return most;
}

static int pixel_of(const struct oracle_vertex *vertex)
{
	int x = (int)floor((vertex->position[0] + 1) * SCENE_SIDE / 2);
	int y = (int)floor((vertex->position[1] + 1) * SCENE_SIDE / 2);

	return y * SCENE_SIDE + x;
}

static void at_vertices_adaptive_is_gouraud(void **state)
{
	static struct drawing drawing[2];
	uint64_t seed = test_seed();
	int compared = 0, farthest = 0;

	for (int n = 0; n < scene_count(SCENES); n++) {
		struct scene scene;
		const struct oracle_picture *picture;

		random_cap(&seed, &scene);
		picture = scene_work_out(&scene);
		draw(*state, &scene, drawing);
		for (int i = 0; i <= RIM; i++) {
			int pixel = pixel_of(&scene.vertex[i]);
			int off = apart(drawing[0].colour[pixel], drawing[1].colour[pixel]);

			if (!picture->pixel[pixel].drawn)
				continue;
			if (off > 1)
				fail_msg("scene %d: vertex %d is %08x, and by OpenGL %08x", n, i,
					 drawing[1].colour[pixel], drawing[0].colour[pixel]);
			farthest = off > farthest ? off : farthest;
			compared++;
		}
	}
	print_message("%d vertices, at most %d apart\n", compared, farthest);
	assert_true(compared > 2 * scene_count(SCENES));
}

static void dim(double colour[4], double times)
{
	for (int i = 0; i < 3; i++)
		colour[i] = (double)(float)(colour[i] / times);
}

/* One normal, and light from afar without highlights, of which nothing is brighter than 1: that
 * would be limited at vertices by the one, and at pixels by the other. */
static void straighten(struct scene *scene)
{
	for (int i = 0; i < scene->vertices; i++) {
		memset(scene->vertex[i].normal, 0, sizeof(scene->vertex[i].normal));
		scene->vertex[i].normal[2] = 1;
		dim(scene->vertex[i].colour, 4);
	}
	dim(scene->gl.ambient, 4);
	for (int i = 0; i < ORACLE_LIGHTS; i++) {
		struct oracle_light *light = &scene->gl.light[i];

		light->position[3] = 0;
		light->spot_cutoff = 180;
		dim(light->ambient, 10);
		dim(light->diffuse, 10);
	}
	for (int i = 0; i < ORACLE_SIDES; i++) {
		struct oracle_material *material = &scene->gl.material[i];

		memset(material->emission, 0, sizeof(material->emission));
		memset(material->specular, 0, sizeof(material->specular));
		scene->gl.follow[i] &= ~ORACLE_SPECULAR;
	}
}

/* The same to the bit, but where all of a triangle is so nearly one colour that it is made one. */
static void what_is_straight_is_gouraud(void **state)
{
	static struct drawing drawing[2];
	uint64_t seed = test_seed();
	int same = 0;

	for (int n = 0; n < scene_count(SCENES); n++) {
		struct scene scene;

		random_cap(&seed, &scene);
		straighten(&scene);
		draw(*state, &scene, drawing);
		for (int i = 0; i < SCENE_PIXELS; i++)
			if (apart(drawing[0].colour[i], drawing[1].colour[i]) > 1)
				fail_msg("scene %d: pixel %d is %08x, and by OpenGL %08x", n, i,
					 drawing[1].colour[i], drawing[0].colour[i]);
		same += !memcmp(drawing[0].colour, drawing[1].colour, sizeof(drawing[0].colour));
	}
	print_message("%d of %d scenes are the same to the bit\n", same, scene_count(SCENES));
	assert_true(same > scene_count(SCENES) * 3 / 4);
}

/* Of all channels of colour, in steps. */
static double mean_square(const struct drawing *drawing, const struct oracle_picture *picture)
{
	double sum = 0;
	int count = 0;

	for (int i = 0; i < SCENE_PIXELS; i++)
		for (int j = 0; j < 3 && picture->pixel[i].drawn; j++) {
			double off = (double)(drawing->colour[i] >> 8 * j & 255) -
				     STEPS * picture->pixel[i].colour[j];

			sum += off * off;
			count++;
		}
	return count ? sum / count : 0;
}

static void adaptive_is_nearer_to_lit_pixels_than_gouraud(void **state)
{
	static struct drawing drawing[2];
	uint64_t seed = test_seed();
	double total[2] = { 0 };

	for (int n = 0; n < scene_count(SCENES); n++) {
		const struct oracle_picture *picture;
		struct scene scene;
		double off[2];

		random_cap(&seed, &scene);
		scene.gl.lit_pixels = true;
		picture = scene_work_out(&scene);
		draw(*state, &scene, drawing);
		for (int i = 0; i < 2; i++) {
			off[i] = mean_square(&drawing[i], picture);
			total[i] += off[i];
		}
		if (off[1] > off[0] + NOISE)
			fail_msg("scene %d: mean square %g, and of Gouraud %g", n, off[1], off[0]);
	}
	print_message("mean square of adaptive shading %g, of Gouraud %g\n",
		      total[1] / scene_count(SCENES), total[0] / scene_count(SCENES));
	assert_true(total[1] < total[0] / 2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(at_vertices_adaptive_is_gouraud),
		cmocka_unit_test(what_is_straight_is_gouraud),
		cmocka_unit_test(adaptive_is_nearer_to_lit_pixels_than_gouraud),
	};

	return cmocka_run_group_tests(tests, scene_setup, scene_teardown);
}
