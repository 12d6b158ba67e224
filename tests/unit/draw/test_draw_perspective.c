/* SPDX-License-Identifier: MIT */
/*
 * Vertex colours in perspective, against an interpolation of its own: in double precision, by the
 * ray through a pixel's centre.
 */
#include "draw_fixture.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 256
#define TRIANGLES 1500
#define STEPS 255.0

static uint32_t pixels[SIDE * SIDE];

/* Clip x, y are eye x, y; w is how far the eye is away. */
static void project(struct accel_state *state, float near, float far)
{
	const float projection[16] = { 1,
				       0,
				       0,
				       0,
				       0,
				       1,
				       0,
				       0,
				       0,
				       0,
				       (far + near) / (near - far),
				       -1,
				       0,
				       0,
				       2 * far * near / (near - far),
				       0 };

	accel_state_set_projection(state, projection);
}

static int setup(void **state)
{
	struct accel_state *drawn;

	assert_int_equal(accel_state_new(&drawn), 0);
	accel_state_set_shading(drawn, ACCEL_SHADING_GOURAUD);
	project(drawn, 0.5f, 2000);
	*state = fixture_new(SIDE, drawn);
	return 0;
}

/* A triangle in eye space. */
struct coloured {
	float position[3][3], colour[3][4];
};

static void draw_coloured(struct fixture *f, const struct coloured *t,
			  struct accel_draw_stats *stats)
{
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3,
						  .position = { .data = t->position },
						  .colour = { .data = t->colour });

	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	accel_draw_stats(f->draw, stats, sizeof(*stats));
}

/* The shares of the vertices in what the ray through a point of the window meets; false: none. */
static bool shares(const struct coloured *t, double x, double y, double share[3])
{
	double ndc[2] = { 2 * x / SIDE - 1, 1 - 2 * y / SIDE }, sum = 0;

	/* With p the vertices, share[0] p0 + share[1] p1 + share[2] p2 is along the ray. */
	for (int i = 0; i < 3; i++) {
		const float *p = t->position[(i + 1) % 3], *q = t->position[(i + 2) % 3];
		double a[2], b[2];

		for (int j = 0; j < 2; j++) {
			a[j] = (double)p[j] + ndc[j] * (double)p[2];
			b[j] = (double)q[j] + ndc[j] * (double)q[2];
		}
		share[i] = a[0] * b[1] - a[1] * b[0];
		sum += share[i];
	}
	for (int i = 0; i < 3; i++)
		share[i] /= sum;
	return sum != 0;
}

static double mix(const struct coloured *t, const double share[3], int channel)
{
	double value = 0;

	for (int i = 0; i < 3; i++)
		value += share[i] * (double)t->colour[i][channel];
	return STEPS * fmin(fmax(value, 0), 1);
}

/* Adds up how far the picture is off, over channels; pixels on the border are not looked at. */
struct off {
	double most, sum, alpha; /* of colour; of alpha */
	long count, far;         /* of them off by more than two steps */
	int x, y;
};

static void add_off(const struct coloured *t, struct off *off)
{
	for (int n = 0; n < SIDE * SIDE; n++) {
		double share[3];

		if (!shares(t, n % SIDE + 0.5, n / SIDE + 0.5, share) || share[0] < 0 ||
		    share[1] < 0 || share[2] < 0 || !(pixels[n] >> 24))
			continue;
		for (int i = 0; i < 4; i++) {
			double drawn = (double)(pixels[n] >> 8 * i & 0xff);
			double far = fabs(drawn - mix(t, share, i));

			off->sum += far;
			off->count++;
			off->far += far > 2;
			if (i == 3)
				off->alpha = fmax(off->alpha, far);
			if (i == 3 || far <= off->most)
				continue;
			off->most = far;
			off->x = n % SIDE;
			off->y = n / SIDE;
		}
	}
}

/* The least height of the triangle on the screen, pixels. Below one it is a sliver, whose colour
 * may change from one end to the other inside a pixel. */
static double height(const struct coloured *t)
{
	double x[3], y[3], most = 0;

	for (int i = 0; i < 3; i++) {
		x[i] = -(double)t->position[i][0] / (double)t->position[i][2] * SIDE / 2;
		y[i] = -(double)t->position[i][1] / (double)t->position[i][2] * SIDE / 2;
	}
	for (int i = 0; i < 3; i++)
		most = fmax(most, hypot(x[i] - x[(i + 1) % 3], y[i] - y[(i + 1) % 3]));
	return fabs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) / most;
}

/* Corners on the grid of 1/16 pixel, where snapping leaves them, w from 1 to @range. */
static void random_triangle(uint64_t *seed, float range, bool alpha, struct coloured *t)
{
	for (int i = 0; i < 3; i++) {
		float w = powf(range, test_unit(seed));

		for (int j = 0; j < 2; j++) {
			int at = test_between(seed, -SIDE * 8, SIDE * 8);

			t->position[i][j] = (float)at / (SIDE * 8) * w;
		}
		t->position[i][2] = -w;
		for (int j = 0; j < 4; j++)
			t->colour[i][j] = (float)test_below(seed, 2) * 0.7f +
					  0.3f * test_unit(seed);
		t->colour[i][3] = alpha ? t->colour[i][3] * 0.9f + 0.1f : 1;
	}
}

static void random_colours_are_within_two_steps(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();
	struct accel_draw_stats stats;
	struct off off = { 0 };
	uint64_t drawn = 0;

	for (int n = 0; n < TRIANGLES; n++) {
		struct coloured t;

		random_triangle(&seed, 10, n % 4 == 0, &t);
		if (height(&t) < 1)
			continue;
		draw_coloured(f, &t, &stats);
		drawn += stats.flat + stats.linear + stats.second_order;
		add_off(&t, &off);
		if (off.most > 2 || off.alpha > 4)
			fail_msg("triangle %d: pixel %d,%d is off by %g, alpha by %g", n, off.x,
				 off.y, off.most, off.alpha);
	}
	print_message("of 255: mean %g, most %g, alpha %g; %g parts a triangle\n",
		      off.sum / (double)off.count, off.most, off.alpha, (double)drawn / TRIANGLES);
}

/* Two of its vertices are behind the eye, and it is seen from just above. */
static void a_ground_under_the_eye_is_right_up_to_the_horizon(void **state)
{
	struct fixture *f = *state;
	struct accel_draw_stats stats;
	uint64_t seed = test_seed();
	struct off off = { 0 };

	for (int n = 0; n < 60; n++) {
		struct coloured t = {
			.position = { { -30, -1, 6 }, { 30, -1, 4 }, { 0, -1, -40 } },
		};

		for (int i = 0; i < 3; i++) {
			t.position[i][0] += 4 * test_unit(&seed);
			t.position[i][1] -= test_unit(&seed);
			t.position[i][2] *= 1 + test_unit(&seed);
			for (int j = 0; j < 3; j++)
				t.colour[i][j] = (float)test_below(&seed, 2);
			t.colour[i][3] = 1;
		}
		draw_coloured(f, &t, &stats);
		assert_int_equal(stats.clipped, 1);
		add_off(&t, &off);
	}
	print_message("of 255: mean %g; %ld of %ld are off by more than 2, at most %g\n",
		      off.sum / (double)off.count, off.far, off.count, off.most);
	assert_true(off.count > 60 * SIDE * SIDE / 4);
	assert_true(off.sum / (double)off.count < 0.3);
	/* At the horizon, where the colours of half the ground are in a few pixels. */
	assert_true(off.far < off.count / 50 && off.most < 64);
}

/* What OpenGL lights are the vertices, also of a triangle that loses one at the near plane. */
static void light_is_that_of_the_vertices_though_they_are_clipped(void **state)
{
	static const float normal[3][3] = { { 0.6f, 0, 0.8f },
					    { -0.6f, 0, 0.8f },
					    { 0, 0.8f, 0.6f } };
	struct coloured t = { .position = { { -2, -1, -6 }, { 2, -1.5f, -4 }, { 0.2f, 1, 0.5f } } };
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3, .position = { .data = t.position },
						  .normal = { .data = normal });
	struct accel_state *shiny = state_shiny(5);
	struct accel_lighting lighting;
	struct fixture *f = *state;
	struct off off = { 0 };

	accel_state_set_lighting(f->state, true);
	assert_int_equal(accel_state_set_material(f->state, &shiny->material[0], NULL), 0);
	assert_int_equal(accel_state_set_light(f->state, 0, &shiny->light[0]), 0);
	accel_lighting_init(&lighting, f->state, false);
	for (int i = 0; i < 3; i++) {
		struct accel_sample sample;

		accel_lighting_sample(&lighting, 0, t.position[i], normal[i],
				      (const float[4]){ 1, 1, 1, 1 }, &sample);
		for (int j = 0; j < 4; j++)
			t.colour[i][j] = fminf(sample.colour[j], 1);
	}
	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	accel_state_free(shiny);
	add_off(&t, &off);
	print_message("of 255: mean %g, most %g\n", off.sum / (double)off.count, off.most);
	assert_true(off.count > SIDE * SIDE);
	assert_true(off.most <= 2);
}

/* One record of linear colours for each tile, as if there were no perspective. */
static void without_perspective_a_triangle_stays_one_of_linear_colours(void **state)
{
	struct fixture *f = *state;
	struct accel_draw_stats stats;

	for (int n = 0; n < 5; n++) {
		/* w from 2 to 2.01: a middle is 0.64 steps from the straight line. */
		const float w[5] = { 2, 2, 2.001f, 2.003f, 2.01f };
		struct coloured t = {
			.position = { { -2, -2, -w[n] }, { 2, -2, -w[4 - n] }, { -2, 2, -2 } },
			.colour = { { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 } }
		};

		draw_coloured(f, &t, &stats);
		assert_int_equal(stats.linear, 1);
		assert_int_equal(stats.flat + stats.second_order + stats.split, 0);
		assert_in_range(stats.records, 10, 16);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)
		TEST(random_colours_are_within_two_steps),
		TEST(a_ground_under_the_eye_is_right_up_to_the_horizon),
		TEST(light_is_that_of_the_vertices_though_they_are_clipped),
		TEST(without_perspective_a_triangle_stays_one_of_linear_colours),
#undef TEST
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
