/* SPDX-License-Identifier: MIT */
/* What edges are found to need, and that both triangles of an edge find the same. */
#include "draw_mesh.h"
#include "draw_test.h"

struct fixture {
	struct accel_state *state;
	struct accel_pass pass;
	struct accel_draw_stats stats;
};

static void fixture_light(struct fixture *f)
{
	f->pass.lit = f->state->lighting;
	f->pass.interpolated = !f->pass.lit;
	accel_lighting_init(&f->pass.lighting, f->state, false);
}

static int setup(void **state)
{
	static struct fixture f;

	f = (struct fixture){ .state = state_shiny(60) };
	f.state->local_viewer = false;
	f.pass.state = f.state;
	f.pass.stats = &f.stats;
	fixture_light(&f);
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_state_free(f->state);
	return 0;
}

/* A lit vertex at pixel (x, 0) whose normal leans @degrees from the viewer towards x. */
static struct accel_vertex leaning(const struct fixture *f, int x, float degrees)
{
	struct accel_vertex vertex = vertex_at(x * 16, 0);
	float angle = degrees * 0.0174532925f;

	vertex.normal[0] = sinf(angle);
	vertex.normal[2] = cosf(angle);
	vertex.eye[0] = (float)x / 100;
	vertex.eye[2] = -5;
	accel_shading_vertex(&f->pass, &vertex, 0);
	return vertex;
}

static struct accel_edge edge_between(const struct fixture *f, const struct accel_vertex *a,
				      const struct accel_vertex *b)
{
	struct accel_edge edge;

	accel_shading_edge(&f->pass, a, b, 0, &edge);
	return edge;
}

/* A light straight ahead, so that highlights are where normals lean by 0 degrees. */
static void light_ahead(struct fixture *f, float shininess)
{
	struct accel_light light = f->state->light[0];

	light.position[0] = light.position[1] = 0;
	assert_int_equal(accel_state_set_light(f->state, 0, &light), 0);
	f->state->material[0].shininess = shininess;
	fixture_light(f);
}

static void normals_that_hardly_differ_give_a_straight_edge_without_a_sample(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a, b;
	struct accel_edge edge;

	light_ahead(f, 60);
	a = leaning(f, 0, 10);
	b = leaning(f, 50, 11);
	edge = edge_between(f, &a, &b);
	assert_false(edge.sampled || edge.curved || edge.split);
	for (int i = 0; i < 3; i++)
		assert_true(edge.colour[i] == (a.sample.colour[i] + b.sample.colour[i]) / 2);
}

static void a_wide_highlight_gives_a_curve_and_a_narrow_one_a_split(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a, b;
	struct accel_edge edge;

	light_ahead(f, 5);
	a = leaning(f, 0, -10);
	b = leaning(f, 50, 12);
	edge = edge_between(f, &a, &b);
	assert_true(edge.curved && !edge.split);
	light_ahead(f, 500);
	a = leaning(f, 0, -10);
	b = leaning(f, 50, 12);
	edge = edge_between(f, &a, &b);
	assert_true(edge.split);
}

static void a_highlight_that_can_not_be_seen_splits_nothing(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a, b;

	light_ahead(f, 500);
	a = leaning(f, 0, 40);
	b = leaning(f, 50, 62);
	assert_false(edge_between(f, &a, &b).split);
	/* Nor one without strength. */
	memset(f->state->material[0].specular, 0, sizeof(f->state->material[0].specular));
	light_ahead(f, 500);
	a = leaning(f, 0, -10);
	b = leaning(f, 50, 12);
	assert_false(edge_between(f, &a, &b).split);
}

static void short_edges_are_straight(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a, b;
	struct accel_edge edge;

	light_ahead(f, 500);
	a = leaning(f, 0, -10);
	b = leaning(f, 2, 12);
	edge = edge_between(f, &a, &b);
	assert_false(edge.curved || edge.split);
	b = leaning(f, 5, 12);
	edge = edge_between(f, &a, &b);
	assert_true(edge.curved && !edge.split);
}

static void quadratic_takes_every_midpoint_and_splits_nothing(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a, b;
	struct accel_edge edge;

	accel_state_set_shading(f->state, ACCEL_SHADING_QUADRATIC);
	light_ahead(f, 500);
	a = leaning(f, 0, -10);
	b = leaning(f, 50, 12);
	edge = edge_between(f, &a, &b);
	assert_true(edge.sampled && edge.curved && !edge.split);
}

/* The middle of the screen is farther from the nearer vertex in space. */
static void midpoints_are_where_the_screen_has_them(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a = vertex_at(0, 0), b = vertex_at(160, 320), middle;

	(void)f;
	a.w = 1;
	b.w = 3;
	b.eye[0] = 4;
	b.normal[1] = 8;
	b.sample.colour[2] = 1;
	accel_patch_middle(&a, &b, &middle);
	assert_true(middle.eye[0] == 1);
	assert_true(middle.normal[1] == 2);
	assert_true(middle.sample.colour[2] == 0.25f);
	assert_true(middle.w == 1.5f);
}

static void colours_without_light_are_corrected_for_perspective(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex a = vertex_at(0, 0), b = vertex_at(160, 320);
	struct accel_edge edge;

	accel_state_set_lighting(f->state, false);
	fixture_light(f);
	b.sample.colour[0] = 1;
	b.w = 2;
	edge = edge_between(f, &a, &b);
	assert_true(edge.curved);
	assert_float_equal(edge.colour[0], 1 / 3.0, 1e-6);
	b.w = 1.0001f;
	edge = edge_between(f, &a, &b);
	assert_false(edge.curved || edge.sampled);
}

static void random_direction(uint64_t *seed, float v[3], float length)
{
	for (int i = 0; i < 3; i++)
		v[i] = (2 * test_unit(seed) - 1) * length;
}

/* Neighbouring points of a surface that bends by up to @bend. */
static void random_pair(uint64_t *seed, const struct fixture *f, float bend, struct accel_vertex *a,
			struct accel_vertex *b)
{
	float away[3];

	*a = vertex_at(test_between(seed, 0, 4096), test_between(seed, 0, 4096));
	*b = vertex_at(test_between(seed, 0, 4096), test_between(seed, 0, 4096));
	random_direction(seed, a->normal, 1);
	random_direction(seed, a->eye, 2);
	random_direction(seed, b->normal, bend);
	random_direction(seed, away, 2 * bend);
	for (int i = 0; i < 3; i++) {
		b->normal[i] += a->normal[i];
		b->eye[i] = a->eye[i] + away[i];
	}
	a->w = 1 + test_unit(seed);
	b->w = 1 + test_unit(seed);
	accel_shading_vertex(&f->pass, a, 0);
	accel_shading_vertex(&f->pass, b, 0);
}

static void random_light(uint64_t *seed, struct fixture *f)
{
	struct accel_light *light = &f->state->light[0];

	random_direction(seed, light->position, 2);
	light->position[3] = (float)test_below(seed, 2);
	light->spot_cutoff = test_below(seed, 2) ? 30 : 180;
	random_direction(seed, light->spot_direction, 1);
	f->state->local_viewer = test_below(seed, 2);
	f->state->material[0].shininess = test_unit(seed) * test_unit(seed) * 1000;
	fixture_light(f);
}

static void assert_same_sample(const struct accel_sample *a, const struct accel_sample *b)
{
	assert_memory_equal(a->colour, b->colour, sizeof(a->colour));
	assert_memory_equal(&a->shine, &b->shine, sizeof(a->shine));
	assert_memory_equal(&a->near, &b->near, sizeof(a->near));
	assert_memory_equal(&a->near_lamp, &b->near_lamp, sizeof(a->near_lamp));
	assert_int_equal(a->facing, b->facing);
	assert_int_equal(a->in_cone, b->in_cone);
}

static void assert_same_vertex(const struct accel_vertex *a, const struct accel_vertex *b)
{
	assert_int_equal(a->x, b->x);
	assert_int_equal(a->y, b->y);
	assert_memory_equal(&a->w, &b->w, sizeof(a->w));
	assert_memory_equal(&a->z, &b->z, sizeof(a->z));
	assert_memory_equal(a->eye, b->eye, sizeof(a->eye));
	assert_memory_equal(a->normal, b->normal, sizeof(a->normal));
	assert_same_sample(&a->sample, &b->sample);
}

static void assert_same_edge(const struct accel_edge *a, const struct accel_edge *b)
{
	assert_same_sample(&a->middle, &b->middle);
	assert_memory_equal(a->colour, b->colour, sizeof(a->colour));
	assert_memory_equal(&a->spread, &b->spread, sizeof(a->spread));
	assert_int_equal(a->sampled, b->sampled);
	assert_int_equal(a->curved, b->curved);
	assert_int_equal(a->split, b->split);
}

static void an_edge_is_the_same_from_both_sides_to_the_bit(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();
	int split = 0, curved = 0, straight = 0;

	for (int n = 0; n < 100000; n++) {
		struct accel_vertex a, b, there, back;
		struct accel_edge to, from;

		random_light(&seed, f);
		random_pair(&seed, f, test_unit(&seed), &a, &b);
		to = edge_between(f, &a, &b);
		from = edge_between(f, &b, &a);
		assert_same_edge(&to, &from);
		accel_patch_middle(&a, &b, &there);
		accel_patch_middle(&b, &a, &back);
		assert_same_vertex(&there, &back);
		split += to.split;
		curved += to.curved;
		straight += !to.split && !to.curved;
	}
	assert_true(split > 1000 && curved > 1000 && straight > 1000);
}

/* Edges that are not split: the light all along is near what is drawn. */
static void what_is_drawn_is_near_the_light_all_along_an_edge(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();
	double sum = 0;
	int count = 0, far = 0;

	for (int n = 0; n < 100000; n++) {
		struct accel_vertex a, b, points[9];
		struct accel_edge edge;

		random_light(&seed, f);
		f->state->light[0].spot_cutoff = 180;
		fixture_light(f);
		random_pair(&seed, f, test_unit(&seed), &a, &b);
		edge = edge_between(f, &a, &b);
		if (edge.split)
			continue;
		points[0] = a;
		points[8] = b;
		for (int step = 8; step > 1; step /= 2)
			for (int i = 0; i < 8; i += step) {
				accel_patch_middle(&points[i], &points[i + step],
						   &points[i + step / 2]);
				accel_shading_vertex(&f->pass, &points[i + step / 2], 0);
			}
		for (int i = 0; i < 9; i++) {
			float t = (float)i / 8;
			float drawn = (1 - t) * (1 - 2 * t) * a.sample.colour[0] +
				      4 * t * (1 - t) * edge.colour[0] +
				      t * (2 * t - 1) * b.sample.colour[0];
			float error = fminf(drawn, 1) - fminf(points[i].sample.colour[0], 1);

			far += fabsf(error) > 20 / 255.0f;
			sum += (double)error * (double)error;
			count++;
		}
	}
	print_message("of 255: root mean square %g, %d of %d are off by more than 20\n",
		      255 * sqrt(sum / count), far, count);
	assert_true(sqrt(sum / count) < 0.7 / 255);
	/* Normals that turn about in a few pixels, and a lamp that touches the surface. */
	assert_true(far < count / 5000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			normals_that_hardly_differ_give_a_straight_edge_without_a_sample, setup,
			teardown),
		cmocka_unit_test_setup_teardown(
			a_wide_highlight_gives_a_curve_and_a_narrow_one_a_split, setup, teardown),
		cmocka_unit_test_setup_teardown(a_highlight_that_can_not_be_seen_splits_nothing,
						setup, teardown),
		cmocka_unit_test_setup_teardown(short_edges_are_straight, setup, teardown),
		cmocka_unit_test_setup_teardown(quadratic_takes_every_midpoint_and_splits_nothing,
						setup, teardown),
		cmocka_unit_test_setup_teardown(midpoints_are_where_the_screen_has_them, setup,
						teardown),
		cmocka_unit_test_setup_teardown(colours_without_light_are_corrected_for_perspective,
						setup, teardown),
		cmocka_unit_test_setup_teardown(an_edge_is_the_same_from_both_sides_to_the_bit,
						setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_drawn_is_near_the_light_all_along_an_edge,
						setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
