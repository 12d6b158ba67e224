/* SPDX-License-Identifier: MIT */
/* Triangles of one or two pixels: which they are, and that they have the light of their pixels. */
#include "draw/group.h"
#include "draw/kernel.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 64

struct fixture {
	uint64_t seed;
	struct accel_state *state;
	struct accel_pass pass;
	struct accel_vertex node[3];
	struct accel_patch patch;
	struct accel_setup setup;
};

static int setup(void **state)
{
	static struct fixture f;

	f = (struct fixture){ .seed = test_seed(), .state = state_shiny(60) };
	f.pass.state = f.state;
	f.pass.lit = true;
	f.pass.transform.window.visible = (struct accel_bounds){ 0, 0, SIDE, SIDE };
	accel_lighting_init(&f.pass.lighting, f.state, false);
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_state_free(f->state);
	return 0;
}

/* A triangle in @size sixteenths of a pixel, with any normals; false: it crosses no row. */
static bool any_triangle(struct fixture *f, int size)
{
	int x = test_between(&f->seed, 100, 800), y = test_between(&f->seed, 100, 800);

	for (int i = 0; i < 3; i++) {
		struct accel_vertex *vertex = &f->node[i];

		*vertex = vertex_at(x + test_between(&f->seed, 0, size),
				    y + test_between(&f->seed, 0, size));
		vertex->w = 1 + test_unit(&f->seed);
		for (int j = 0; j < 3; j++) {
			vertex->eye[j] = test_unit(&f->seed) - (j == 2 ? 4 : 0);
			vertex->normal[j] = test_unit(&f->seed) + (j == 2 ? 0.5f : -0.5f);
		}
		f->patch.vertex[i] = vertex;
	}
	return accel_surface_area(&f->node[0], &f->node[1], &f->node[2]) &&
	       accel_setup_init(&f->setup, f->patch.vertex);
}

static int count_pixels(const struct fixture *f)
{
	int count = 0;

	for (int y = 0; y < SIDE; y++)
		for (int x = 0; x < SIDE; x++)
			count += edge_functions_inside(f->patch.vertex, x, y);
	return count;
}

/* What is visible makes no difference, or parts of a picture would not be what the whole is. */
static void triangles_of_one_or_two_pixels_are_found(void **state)
{
	struct fixture *f = *state;
	int found[ACCEL_FEW + 1] = { 0 };

	for (int n = 0; n < 4000; n++) {
		struct accel_few few;
		int count;

		f->pass.transform.window.visible = (struct accel_bounds){ 0, n % 2 ? 30 : 0,
									  n % 3 ? SIDE : 30, SIDE };
		if (!any_triangle(f, 50))
			continue;
		count = count_pixels(f);
		accel_few_find(&few, &f->pass, &f->setup);
		assert_int_equal(few.count, count <= ACCEL_FEW ? count : 0);
		for (int i = 0; i < few.count; i++)
			assert_true(edge_functions_inside(f->patch.vertex, few.pixel[i].x,
							  few.pixel[i].y));
		found[few.count]++;
	}
	for (int i = 0; i <= ACCEL_FEW; i++)
		assert_true(found[i] > 100);
}

static void only_adaptive_shading_of_what_is_lit_has_them(void **state)
{
	struct fixture *f = *state;
	struct accel_few few;

	while (!any_triangle(f, 30) || count_pixels(f) != 1)
		;
	accel_few_find(&few, &f->pass, &f->setup);
	assert_int_equal(few.count, 1);
	f->pass.lit = false;
	accel_few_find(&few, &f->pass, &f->setup);
	assert_int_equal(few.count, 0);
	f->pass.lit = true;
	accel_state_set_shading(f->state, ACCEL_SHADING_QUADRATIC);
	accel_few_find(&few, &f->pass, &f->setup);
	assert_int_equal(few.count, 0);
}

/* The light at a pixel's centre, of positions and normals that are linear in space. */
static void light_at(const struct fixture *f, const struct accel_pixel *pixel, float colour[4])
{
	const struct accel_vertex centre = vertex_at(pixel->x * 16 + 8, pixel->y * 16 + 8);
	const float white[4] = { 1, 1, 1, 1 };
	double weight[3], sum = 0;
	float eye[3] = { 0 }, normal[3] = { 0 };
	struct accel_sample sample;

	for (int i = 0; i < 3; i++) {
		weight[i] = fabs((double)accel_surface_area(&centre, &f->node[(i + 1) % 3],
							    &f->node[(i + 2) % 3])) /
			    (double)f->node[i].w;
		sum += weight[i];
	}
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++) {
			eye[j] += (float)(weight[i] / sum) * f->node[i].eye[j];
			normal[j] += (float)(weight[i] / sum) * f->node[i].normal[j];
		}
	accel_lighting_sample(&f->pass.lighting, 0, eye, normal, white, &sample);
	memcpy(colour, sample.colour, sizeof(sample.colour));
}

/* Of a channel at a pixel, as the core adds it up. */
static int level_at(const struct accel_triangle *triangle, int channel,
		    const struct accel_pixel *pixel)
{
	const struct accel_surface *s = &triangle->channel[channel];
	uint32_t x = (uint32_t)(pixel->x - triangle->x), y = (uint32_t)(pixel->y - triangle->y);

	if (triangle->shading == GLOSS_SHADING_FLAT)
		return triangle->constant[channel];
	assert_int_equal(triangle->shading, GLOSS_SHADING_LINEAR);
	return (int32_t)(s->i + x * s->dx + y * s->dy) >> GLOSS_COLOUR_FRACTION;
}

static void each_of_their_pixels_has_the_light_that_is_there(void **state)
{
	struct fixture *f = *state;
	int seen = 0;

	for (int n = 0; n < 4000; n++) {
		struct accel_few few, *const list[1] = { &few };
		struct accel_triangle triangle;
		struct accel_few_batch batch;
		struct accel_fit_batch fit;

		if (!any_triangle(f, 40))
			continue;
		accel_few_find(&few, &f->pass, &f->setup);
		if (!few.count)
			continue;
		accel_few_light(&f->pass, &f->patch, list, 1);
		accel_few_put(&few, 0, &batch, &fit);
		accel_kernel()->few(&batch, &fit, 0, 1);
		accel_surface_few(&triangle, &fit, 0);
		for (int i = 0; i < few.count; i++, seen++)
			for (int j = 0; j < 3; j++) {
				float colour[4], most;

				light_at(f, &few.pixel[i], colour);
				most = colour[j] < 1 ? colour[j] : 1;
				assert_true(abs((int)(most * 255 + 0.5f) -
						level_at(&triangle, j, &few.pixel[i])) <= 1);
			}
		assert_false(triangle.alpha_linear);
	}
	assert_true(seen > 1000);
}

/* Any two pixels, of any colours that light has; alpha differs now and then. */
static struct accel_few any_few(uint64_t *seed)
{
	struct accel_few few = { .count = test_between(seed, 1, ACCEL_FEW + 1) };

	few.pixel[0] = (struct accel_pixel){ test_between(seed, 0, SIDE),
					     test_between(seed, 0, SIDE) };
	few.pixel[1] = (struct accel_pixel){ few.pixel[0].x + test_between(seed, -3, 4),
					     few.pixel[0].y + test_between(seed, 1, 4) };
	for (int i = 0; i < 4; i++) {
		few.colour[0][i] = (i < 3 ? ACCEL_COLOUR_MAX : 1) * test_unit(seed);
		few.colour[1][i] = few.colour[0][i];
		if (test_below(seed, 2))
			few.colour[1][i] *= test_unit(seed);
	}
	return few;
}

static void they_are_the_same_with_all_instructions(void **state)
{
	static struct accel_few_batch batch;
	static struct accel_fit_batch wanted, got;
	struct fixture *f = *state;

	for (int n = 0; n < 500; n++) {
		const int first = test_between(&f->seed, 0, ACCEL_BATCH);

		memset(&wanted, 0, sizeof(wanted));
		for (int i = 0; i < ACCEL_BATCH; i++) {
			const struct accel_few few = any_few(&f->seed);

			accel_few_put(&few, i, &batch, &wanted);
		}
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = wanted;
			accel_kernels[i]->few(&batch, &got, first, ACCEL_BATCH);
			accel_kernel_baseline.few(&batch, &wanted, first, ACCEL_BATCH);
			assert_memory_equal(&got, &wanted, sizeof(got));
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(triangles_of_one_or_two_pixels_are_found, setup,
						teardown),
		cmocka_unit_test_setup_teardown(only_adaptive_shading_of_what_is_lit_has_them,
						setup, teardown),
		cmocka_unit_test_setup_teardown(each_of_their_pixels_has_the_light_that_is_there,
						setup, teardown),
		cmocka_unit_test_setup_teardown(they_are_the_same_with_all_instructions, setup,
						teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
