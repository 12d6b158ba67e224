/* SPDX-License-Identifier: MIT */
/*
 * The loops of draw/kernel.h give the same bits with every set of instructions that this processor
 * has: over random input, and in the streams of whole frames.
 */
#include "draw/kernel.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 256
#define ROUNDS 200

/* Numbers of all sizes, some of them zero and some none. */
static float any_number(uint64_t *seed, int magnitude)
{
	switch (test_below(seed, 100)) {
	case 0:
		return 0;
	case 1:
		return test_below(seed, 2) ? NAN : INFINITY;
	default:
		return (2 * test_unit(seed) - 1) *
		       ldexpf(1, test_between(seed, -magnitude, magnitude));
	}
}

static void fill(uint64_t *seed, float *number, size_t count, int magnitude)
{
	for (size_t i = 0; i < count; i++)
		number[i] = any_number(seed, magnitude);
}

/* What is no number differs in its bits, as operands may change places. */
static void settle(void *data, size_t size)
{
	float *number = data;

	for (size_t i = 0; i < size / sizeof(*number); i++)
		if (isnan(number[i]))
			number[i] = NAN;
}

static void vertices_are_the_same_with_all_instructions(void **unused)
{
	static struct accel_vertex_batch given, wanted, got;
	struct accel_state *state = state_shiny(10);
	uint64_t seed = test_seed();

	(void)unused;
	for (int n = 0; n < ROUNDS; n++) {
		struct accel_transform transform;
		int count = test_between(&seed, 1, ACCEL_BATCH + 1);

		fill(&seed, state->modelview, 16, n % 4 ? 1 : 60);
		if (n % 2)
			state->modelview[3] = state->modelview[7] = state->modelview[11] = 0;
		accel_geometry_init(&transform, state, SIDE, SIDE / 2);
		fill(&seed, &given.position[0][0], 10 * (size_t)ACCEL_BATCH, n % 8 ? 3 : 120);
		wanted = given;
		accel_kernel_baseline.transform(&transform, &wanted, count, n % 3);
		settle(&wanted.eye, sizeof(wanted.eye) + sizeof(wanted.normal));
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = given;
			accel_kernels[i]->transform(&transform, &got, count, n % 3);
			settle(&got.eye, sizeof(got.eye) + sizeof(got.normal));
			assert_memory_equal(&got.x, &wanted.x,
					    sizeof(got) - offsetof(struct accel_vertex_batch, x));
			assert_memory_equal(&got.z, &wanted.z, sizeof(got.z));
		}
	}
	accel_state_free(state);
}

/* Lights of all kinds; the brightness of some is none. */
static void any_lights(uint64_t *seed, struct accel_state *state)
{
	for (int i = 0; i < ACCEL_LIGHTS; i++) {
		struct accel_light light = ACCEL_LIGHT(.enabled = test_below(seed, 2),
						       .attenuation = { 1, 0.2f, 0.1f });
		float *colour[] = { light.ambient, light.diffuse, light.specular };

		for (int j = 0; j < 4; j++) {
			light.position[j] = 4 * test_unit(seed) - 2;
			for (int k = 0; k < 3 && test_below(seed, 4); k++)
				colour[k][j] = test_unit(seed);
		}
		if (test_below(seed, 3) == 0)
			light.position[3] = 0;
		if (test_below(seed, 2)) {
			light.spot_cutoff = 1 + 89 * test_unit(seed);
			light.spot_exponent = test_below(seed, 2) ? 128 * test_unit(seed) : 0;
		}
		assert_int_equal(accel_state_set_light(state, i, &light), 0);
	}
}

static void assert_same_light(const struct accel_light_batch *a, const struct accel_light_batch *b)
{
	assert_memory_equal(&a->colour, &b->colour,
			    offsetof(struct accel_light_batch, unit) -
				    offsetof(struct accel_light_batch, colour));
}

static void light_is_the_same_with_all_instructions(void **unused)
{
	static struct accel_light_batch given, wanted, got;
	uint64_t seed = test_seed();

	(void)unused;
	for (int n = 0; n < ROUNDS; n++) {
		struct accel_state *state = state_shiny(n % 5 ? 1000 * test_unit(&seed) : 0);
		int side = n % 2, count = test_between(&seed, 1, ACCEL_BATCH + 1);
		struct accel_lighting lighting;

		any_lights(&seed, state);
		accel_state_set_local_viewer(state, n & 2);
		accel_state_set_normals(state, (enum accel_normals)(n % 3));
		accel_state_set_colour_material(state, (enum accel_tracks)(n % 6),
						(enum accel_tracks)(n / 6 % 6));
		accel_lighting_init(&lighting, state, n & 4);
		fill(&seed, &given.eye[0][0], 11 * (size_t)ACCEL_BATCH, n % 8 ? 2 : 60);
		wanted = got = given;
		accel_kernel_baseline.light(&lighting, side, &wanted, count);
		settle(&wanted.shine, 3 * sizeof(wanted.shine));
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = given;
			accel_kernels[i]->light(&lighting, side, &got, count);
			settle(&got.shine, 3 * sizeof(got.shine));
			assert_same_light(&got, &wanted);
		}
		accel_state_free(state);
	}
}

/* Ends of an edge, often close to each other, often with the same lights. */
static void any_ends(uint64_t *seed, struct accel_edge_batch *batch, int i)
{
	for (int end = 0; end < 2; end++) {
		batch->x[end][i] = test_between(seed, 0, 1 << test_between(seed, 1, 21));
		batch->y[end][i] = test_between(seed, 0, 1 << test_between(seed, 1, 21));
		batch->lights[end][i] = (uint32_t)test_below(seed, 2);
		batch->shine[end][i] = 1 - ldexpf(test_unit(seed), -test_between(seed, 0, 8));
		if (test_below(seed, 2))
			batch->near[end][i] = batch->near_lamp[end][i] = 0;
	}
	for (int j = 0; j < 3 && test_below(seed, 2); j++) {
		batch->normal[1][j][i] = batch->normal[0][j][i] * (1 + test_unit(seed) / 16);
		batch->colour[1][j][i] = batch->colour[0][j][i] + test_unit(seed) / 16;
	}
}

static void ends_of_edges_are_the_same_with_all_instructions(void **unused)
{
	static struct accel_edge_batch given, wanted, got;
	uint64_t seed = test_seed();

	(void)unused;
	for (int n = 0; n < ROUNDS; n++) {
		struct accel_state *state = state_shiny(n % 5 ? 1000 * test_unit(&seed) : 0);
		int side = n % 2, count = test_between(&seed, 1, ACCEL_BATCH + 1);
		struct accel_lighting lighting;

		any_lights(&seed, state);
		accel_lighting_init(&lighting, state, false);
		fill(&seed, &given.w[0][0], 26 * (size_t)ACCEL_BATCH, n % 8 ? 2 : 60);
		for (int i = 0; i < ACCEL_BATCH; i++)
			any_ends(&seed, &given, i);
		wanted = given;
		accel_kernel_baseline.edge(&lighting, side, &wanted, count);
		settle(&wanted.spread, 5 * sizeof(wanted.spread));
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = given;
			accel_kernels[i]->edge(&lighting, side, &got, count);
			settle(&got.spread, 5 * sizeof(got.spread));
			assert_memory_equal(&got.spread, &wanted.spread, 6 * sizeof(got.spread));
		}
		accel_state_free(state);
	}
}

/* Triangles of all sizes; vertices of parts lie in finer units than those of meshes. */
static void any_triangle(uint64_t *seed, struct accel_setup_batch *batch, int i)
{
	int size = 1 << test_between(seed, 5, 22), unit = test_below(seed, 2) ? 64 : 1;
	int x = test_between(seed, 0, 2048 << ACCEL_WINDOW_BITS);
	int y = test_between(seed, 0, 2048 << ACCEL_WINDOW_BITS);

	for (int j = 0; j < 3; j++) {
		batch->x[j][i] = (x + test_between(seed, -size, size)) / unit * unit;
		batch->y[j][i] = (y + test_between(seed, -size, size)) / unit * unit;
	}
}

static void pixels_are_the_same_with_all_instructions(void **unused)
{
	static struct accel_pixel_batch given, wanted, got;
	uint64_t seed = test_seed();

	(void)unused;
	for (int n = 0; n < ROUNDS; n++) {
		int count = test_between(&seed, 1, ACCEL_BATCH + 1);

		fill(&seed, &given.w[0][0], 36 * (size_t)ACCEL_BATCH, n % 8 ? 2 : 60);
		for (int i = 0; i < ACCEL_BATCH; i++) {
			int x = test_between(&seed, 0, SIDE), y = test_between(&seed, 0, SIDE);

			given.pixel[0][i] = x;
			given.pixel[1][i] = y;
			for (int j = 0; j < 3; j++) {
				given.x[j][i] = x * ACCEL_WINDOW_ONE +
						test_between(&seed, -(1 << 25), 1 << 25);
				given.y[j][i] = y * ACCEL_WINDOW_ONE +
						test_between(&seed, -(1 << 13), 1 << 13);
			}
		}
		wanted = given;
		accel_kernel_baseline.pixel(&wanted, count);
		settle(&wanted.light, 11 * sizeof(wanted.light.length));
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = given;
			accel_kernels[i]->pixel(&got, count);
			settle(&got.light, 11 * sizeof(got.light.length));
			assert_memory_equal(&got, &wanted, sizeof(got));
		}
	}
}

static void edges_are_the_same_with_all_instructions(void **unused)
{
	static struct accel_setup_batch given, wanted, got;
	uint64_t seed = test_seed();

	(void)unused;
	for (int n = 0; n < ROUNDS; n++) {
		const struct accel_bounds visible = { test_between(&seed, 0, 500), 100, 1500,
						      test_between(&seed, 100, 2048) };
		int count = test_between(&seed, 1, ACCEL_BATCH + 1);

		for (int i = 0; i < ACCEL_BATCH; i++)
			any_triangle(&seed, &given, i);
		wanted = given;
		accel_kernel_baseline.setup(&wanted, count, &visible);
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = given;
			accel_kernels[i]->setup(&got, count, &visible);
			for (int j = 0; j < count; j++) {
				struct accel_setup a = { 0 }, b = { 0 };

				assert_int_equal(accel_setup_draws(&got, j, &visible, &a),
						 accel_setup_draws(&wanted, j, &visible, &b));
				assert_memory_equal(&a, &b, sizeof(a));
			}
		}
	}
}

/* Triangles with light at their vertices and edges, some of them flat, some very steep. */
static void any_patch(uint64_t *seed, struct accel_vertex node[3], struct accel_edge edge[3],
		      struct accel_patch *patch)
{
	int size = 1 << test_between(seed, 3, 12);
	float change = ldexpf(1, -test_between(seed, 0, 12));
	bool curved = test_below(seed, 2);

	do
		for (int i = 0; i < 3; i++)
			node[i] = vertex_at(test_between(seed, 0, size),
					    test_between(seed, 0, size));
	while (!accel_surface_area(&node[0], &node[1], &node[2]));
	for (int i = 0; i < 3; i++) {
		edge[i] = (struct accel_edge){ .curved = curved };
		for (int j = 0; j < 4; j++)
			node[i].sample.colour[j] = 0.3f + change * test_unit(seed);
		for (int j = 0; j < 3; j++)
			edge[i].colour[j] = 0.3f + change * test_unit(seed);
		patch->vertex[i] = &node[i];
		patch->edge[i] = &edge[i];
	}
}

static void fit_gather(struct accel_fit_batch *batch, int i, const struct accel_patch *patch)
{
	for (int j = 0; j < 3; j++) {
		batch->x[j][i] = patch->vertex[j]->x;
		batch->y[j][i] = patch->vertex[j]->y;
		for (int k = 0; k < 3; k++) {
			batch->colour[j][k][i] = patch->vertex[j]->sample.colour[k];
			batch->colour[3 + j][k][i] = patch->edge[j]->colour[k];
		}
	}
	batch->curved[i] = patch->edge[0]->curved;
}

/* Those of one triangle by itself are what they have to be. */
static void surfaces_are_the_same_with_all_instructions(void **unused)
{
	static struct accel_fit_batch batch;
	uint64_t seed = test_seed();
	int fitted = 0;

	(void)unused;
	for (int n = 0; n < 40 * ROUNDS; n++) {
		struct accel_vertex node[3];
		struct accel_edge edge[3];
		struct accel_patch patch;
		struct accel_triangle wanted, got;
		struct accel_basis basis;

		any_patch(&seed, node, edge, &patch);
		memset(&wanted, 0, sizeof(wanted));
		accel_surface_basis(&basis, patch.vertex);
		accel_surface_patch(&wanted, &basis, &patch);
		for (int i = 0; i < n % 9 + 1; i++)
			fit_gather(&batch, i, &patch);
		for (int i = 0; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			accel_kernels[i]->fit(&batch, n % 9 + 1);
			memset(&got, 0, sizeof(got));
			accel_surface_fitted(&got, &batch, n % 9, &patch);
			if (wanted.shading == GLOSS_SHADING_FLAT)
				memset(got.channel, 0, 3 * sizeof(got.channel[0]));
			assert_memory_equal(&got, &wanted, sizeof(got));
			fitted += batch.fits[n % 9] && !batch.flat[n % 9];
		}
	}
	assert_true(fitted > 1000);
}

/* Numbers that often fit a small record, and sometimes are any. */
static void any_words(uint64_t *seed, void *words, size_t count, int most)
{
	uint32_t *word = words;

	for (size_t i = 0; i < count; i++)
		word[i] = (uint32_t)(test_random(seed) >> 32) >> test_below(seed, (uint32_t)most) ^
			  (test_below(seed, 2) ? ~0u : 0);
}

static void any_small(uint64_t *seed, struct accel_leaf_batch *batch, int i)
{
	const int x = test_between(seed, -20, SIDE), y = test_between(seed, -20, SIDE);

	batch->fits[i] = test_below(seed, 8) ? ~0u : 0;
	batch->x0[i] = x;
	batch->y0[i] = y;
	batch->x1[i] = x + test_between(seed, 1, 17);
	batch->y1[i] = y + test_between(seed, 1, 17);
	batch->anchor_x[i] = (x + test_between(seed, 0, 16)) & ~7;
	batch->fit.at_x[i] = x + test_between(seed, 0, 16);
	batch->fit.at_y[i] = y + test_between(seed, 0, 16);
	batch->fit.form[i] = test_below(seed, 3);
	for (int j = 0; j < 4; j++)
		batch->fit.level[j][i] = test_below(seed, 256);
}

static void small_records_are_the_same_with_all_instructions(void **unused)
{
	static struct accel_leaf_batch given, wanted, got;
	uint64_t seed = test_seed();
	int fits = 0;

	(void)unused;
	for (int n = 0; n < ROUNDS; n++) {
		int count = test_between(&seed, 1, ACCEL_BATCH + 1);

		any_words(&seed, given.fit.surface, sizeof(given.fit.surface) / 4, 24);
		any_words(&seed, given.depth_z, 3 * (size_t)ACCEL_BATCH, 30);
		for (int i = 0; i < ACCEL_BATCH; i++)
			any_small(&seed, &given, i);
		wanted = given;
		accel_kernel_baseline.small(&wanted, count, 64);
		for (int i = 0; i < count; i++)
			fits += wanted.fits[i] != 0;
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			got = given;
			accel_kernels[i]->small(&got, count, 64);
			assert_memory_equal(&got, &wanted, sizeof(got));
		}
	}
	assert_true(fits > ROUNDS);
}

/* ---- streams ---- */

static uint64_t checksum;

int __real_accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count);
int __wrap_accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count);

/* The records of a frame; what is around them says which tiles are clear already. */
int __wrap_accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		uint64_t mixed = checksum ^ words[i];

		checksum = test_random(&mixed);
	}
	return __real_accel_stream_lend(stream, words, count);
}

/* A point close to the mesh, and a spot, beside the light that the state has. */
static void add_lamps(struct accel_state *state)
{
	struct accel_light lamp = ACCEL_LIGHT(.enabled = true, .position = { -1, 0.7f, -2, 1 },
					      .ambient = { 0, 0.1f, 0, 1 },
					      .diffuse = { 0.5f, 0.2f, 0, 1 },
					      .specular = { 0, 0.3f, 0, 1 },
					      .attenuation = { 1, 0.2f, 0.1f });

	assert_int_equal(accel_state_set_light(state, 1, &lamp), 0);
	lamp.position[0] = 1;
	lamp.spot_direction[2] = -1;
	lamp.spot_exponent = 5;
	lamp.spot_cutoff = 20;
	assert_int_equal(accel_state_set_light(state, 2, &lamp), 0);
}

/* The checksum of frame @n: all shadings, seen from near and far, with one light and more. */
static uint64_t stream_of(struct accel_draw *draw, struct accel_target *target,
			  const struct shape *shape, int n)
{
	struct accel_state *state = state_shiny(n & 1 ? 80 : 10);
	struct accel_mesh mesh = shape->mesh;

	if (n & 2)
		add_lamps(state);
	state_look(state, n & 4 ? 1.3f : 3.2f);
	accel_state_set_two_sided(state, n & 8);
	accel_state_set_local_viewer(state, n & 2);
	accel_state_set_shading(state, (enum accel_shading)(n >> 4 & 3));
	if (n & 64)
		mesh.normal.data = NULL;
	checksum = 0;
	assert_int_equal(draw_begin(draw, target, (const float[4]){ 0, 0, 0, 1 }, 1), 0);
	assert_int_equal(accel_draw_mesh(draw, state, &mesh), 0);
	assert_int_equal(accel_draw_finish(draw), 0);
	accel_state_free(state);
	return checksum;
}

static void streams_are_the_same_with_all_instructions(void **unused)
{
	static struct shape shape;
	struct messages messages;
	struct accel_target *target;
	struct accel_device *device;
	struct accel_draw *draw;

	(void)unused;
	shape_torus(&shape, 24);
	device = device_open("model:", &messages);
	assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	for (int n = 0; n < 128; n++) {
		uint64_t wanted;

		accel_kernel_set(&accel_kernel_baseline);
		wanted = stream_of(draw, target, &shape, n);
		for (int i = 1; accel_kernels[i]; i++) {
			if (!accel_kernels[i]->runs())
				continue;
			accel_kernel_set(accel_kernels[i]);
			assert_int_equal(stream_of(draw, target, &shape, n), wanted);
		}
	}
	accel_kernel_set(NULL);
	accel_draw_free(draw);
	accel_target_free(target);
	accel_device_free(device);
}

static void the_library_takes_the_last_that_runs(void **unused)
{
	const struct accel_kernel *last = NULL;

	(void)unused;
	for (int i = 0; accel_kernels[i]; i++)
		if (accel_kernels[i]->runs())
			last = accel_kernels[i];
	assert_ptr_equal(accel_kernels[0], &accel_kernel_baseline);
	assert_ptr_equal(accel_kernel(), last);
	print_message("%s\n", last->name);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(vertices_are_the_same_with_all_instructions),
		cmocka_unit_test(light_is_the_same_with_all_instructions),
		cmocka_unit_test(ends_of_edges_are_the_same_with_all_instructions),
		cmocka_unit_test(pixels_are_the_same_with_all_instructions),
		cmocka_unit_test(edges_are_the_same_with_all_instructions),
		cmocka_unit_test(surfaces_are_the_same_with_all_instructions),
		cmocka_unit_test(small_records_are_the_same_with_all_instructions),
		cmocka_unit_test(streams_are_the_same_with_all_instructions),
		cmocka_unit_test(the_library_takes_the_last_that_runs),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
