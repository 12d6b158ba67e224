/* SPDX-License-Identifier: MIT */
/* A mesh that threads draw is the same stream, word for word, as with one; link with
 * --wrap=accel_engine_submit and of what allocates. */
#include <stdatomic.h>

#include "accel_priv.h"
#include "accel_test.h"
#include "child_test.h"

#define SIDE 300
/* A grid of vertices, and triangles enough for many slices. */
#define GRID 110u
#define VERTICES (GRID * GRID)
#define TRIANGLES (2 * (GRID - 1) * (GRID - 1))
#define WORDS_MAX (1u << 22)

static float position[VERTICES][3], normal[VERTICES][3], colour[VERTICES][4];
static uint32_t index_of[3 * TRIANGLES];

/* What was sent by a device. */
struct sent {
	uint32_t *words;
	size_t count;
	struct accel_draw_stats stats;
};

static struct sent *sent;

int __real_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);
int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);

int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence)
{
	assert_true(sent->count + job->stream_words <= WORDS_MAX);
	accel_transport_copy(job, sent->words + sent->count);
	sent->count += job->stream_words;
	return __real_accel_engine_submit(state, job, sequence);
}

/* ---- memory that runs out ---- */

static atomic_int allocations_left = -1; /* until one fails; below 0: none does */

static bool allocation_fails(void)
{
	int left = atomic_load(&allocations_left);

	while (left >= 0 && !atomic_compare_exchange_weak(&allocations_left, &left, left - 1))
		;
	return left == 0;
}

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_realloc(void *memory, size_t size);

void *__wrap_malloc(size_t size)
{
	return allocation_fails() ? NULL : __real_malloc(size);
}

void *__wrap_realloc(void *memory, size_t size)
{
	return allocation_fails() ? NULL : __real_realloc(memory, size);
}

/* ---- meshes ---- */

static float random_float(uint64_t *seed, float least, float most)
{
	return least + (most - least) * (float)test_below(seed, 1 << 20) / (1 << 20);
}

/* A wavy sheet with some dents; parts of it leave the view. */
static void mesh_fill(uint64_t *seed)
{
	float size = random_float(seed, 0.7f, 1.6f);

	for (uint32_t i = 0; i < VERTICES; i++) {
		position[i][0] = ((float)(i % GRID) / GRID * 2 - 1) * size;
		position[i][1] = ((float)(i / GRID) / GRID * 2 - 1) * size;
		position[i][2] = random_float(seed, -0.02f, 0.02f);
		normal[i][0] = random_float(seed, -0.5f, 0.5f);
		normal[i][1] = random_float(seed, -0.5f, 0.5f);
		normal[i][2] = 1;
		for (int j = 0; j < 4; j++)
			colour[i][j] = random_float(seed, 0, 1);
	}
	for (uint32_t i = 0; i < TRIANGLES; i++) {
		uint32_t x = i / 2 % (GRID - 1), y = i / 2 / (GRID - 1), a = y * GRID + x;
		uint32_t *to = &index_of[3 * i];
		bool turned = test_below(seed, 5) == 0;

		to[0] = i % 2 ? a + 1 : a;
		to[turned ? 2 : 1] = i % 2 ? a + GRID + 1 : a + 1;
		to[turned ? 1 : 2] = a + GRID;
	}
}

static struct accel_mesh mesh_of(uint64_t *seed)
{
	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
					    .vertices = VERTICES, .position = { .data = position },
					    .index = index_of, .indices = 3 * TRIANGLES);

	if (test_below(seed, 4))
		mesh.normal.data = normal;
	if (test_below(seed, 2))
		mesh.colour.data = colour;
	switch (test_below(seed, 9)) {
	case 0:
		mesh.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP;
		break;
	case 1:
		mesh.topology = ACCEL_TOPOLOGY_TRIANGLE_FAN;
		break;
	case 2:
		mesh.index = NULL;
		break;
	case 3:
		mesh.topology = ACCEL_TOPOLOGY_QUADS;
		break;
	case 4:
		mesh.topology = ACCEL_TOPOLOGY_QUAD_STRIP;
		break;
	case 5:
		mesh.topology = ACCEL_TOPOLOGY_POLYGON;
		break;
	default:
		break;
	}
	/* Large ones. */
	if (mesh.topology != ACCEL_TOPOLOGY_TRIANGLES)
		mesh.indices = 5000;
	/* Not always whole triangles, and not always as many as slices have. */
	if (test_below(seed, 2))
		mesh.indices -= test_below(seed, mesh.indices);
	return mesh;
}

static void state_fill(struct accel_state *state, uint64_t *seed)
{
	const struct accel_light lamp = ACCEL_LIGHT(.enabled = true,
						    .position = { 0.3f, 0.2f, 0.8f,
								  (float)test_below(seed, 2) },
						    .diffuse = { 0.7f, 0.7f, 0.6f, 1 },
						    .specular = { 1, 1, 1, 1 });
	const struct accel_material material = ACCEL_MATERIAL(.ambient = { 0.1f, 0.1f, 0.1f, 1 },
							      .diffuse = { 0.8f, 0.6f, 0.4f, 1 },
							      .specular = { 0.5f, 0.5f, 0.5f, 1 },
							      .shininess = random_float(seed, 1,
											80));
	float projection[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1 };

	/* Some perspective, and at times with a part behind the eye. */
	projection[3] = random_float(seed, -0.9f, 0.9f);
	accel_state_set_projection(state, projection);
	assert_int_equal(accel_state_set_light(state, 0, &lamp), 0);
	assert_int_equal(accel_state_set_material(state, &material, NULL), 0);
	accel_state_set_lighting(state, test_below(seed, 4) != 0);
	accel_state_set_shading(state, (enum accel_shading)test_below(seed, 4));
	accel_state_set_cull(state, (enum accel_cull)test_below(seed, 3));
	accel_state_set_two_sided(state, test_below(seed, 2));
	accel_state_set_colour_material(state, (enum accel_tracks)test_below(seed, 6),
					(enum accel_tracks)test_below(seed, 6));
	accel_state_set_normals(state, (enum accel_normals)test_below(seed, 3));
	accel_state_set_front_face(state, test_below(seed, 2));
	accel_state_set_origin(state, test_below(seed, 2));
	accel_state_set_local_viewer(state, test_below(seed, 2));
	accel_state_set_depth(state, ACCEL_COMPARE_LEQUAL, true);
}

/* As three primitives that have parts of it in common, some triangles with no vertex, or few. */
static int draw_as_arrays(struct accel_draw *draw, const struct accel_state *state,
			  const struct accel_mesh *mesh, uint64_t *seed)
{
	const uint32_t count = mesh->index ? mesh->indices : mesh->vertices;
	const uint32_t cut = test_below(seed, count + 1), from = test_below(seed, cut + 1);
	const struct accel_primitive primitive[] = {
		{ mesh->topology, 0, cut },
		{ ACCEL_TOPOLOGY_TRIANGLES, from, count - from },
		{ mesh->topology, cut, count - cut },
	};
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = primitive,
							      .primitives = 3, .index = mesh->index,
							      .index_type = ACCEL_TYPE_UINT);
	const struct accel_arrays arrays = ACCEL_ARRAYS(
			.vertices = VERTICES - test_below(seed, 2) * test_below(seed, VERTICES),
			.position = { .data = position, .components = 3 }, .normal = mesh->normal,
			.colour = mesh->colour);

	return accel_draw_arrays(draw, state, &arrays, &elements);
}

/* Two frames, each of two meshes, as the seed says. */
static void draw_frames(const char *device_name, uint64_t seed)
{
	const float black[4] = { 0 };
	struct messages messages;
	struct accel_device *device = device_open(device_name, &messages);
	struct accel_target *target;
	struct accel_draw *draw;

	sent->count = 0;
	assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	for (int i = 0; i < 4; i++) {
		struct accel_state *state;
		struct accel_mesh mesh;

		assert_int_equal(accel_state_new(&state), 0);
		mesh_fill(&seed);
		mesh = mesh_of(&seed);
		state_fill(state, &seed);
		if (i % 2 == 0)
			assert_int_equal(draw_begin(draw, target, black, 1), 0);
		if (test_below(&seed, 2))
			assert_int_equal(accel_draw_mesh(draw, state, &mesh), 0);
		else
			assert_int_equal(draw_as_arrays(draw, state, &mesh, &seed), 0);
		if (i % 2)
			assert_int_equal(accel_draw_finish(draw), 0);
		accel_state_free(state);
	}
	accel_draw_stats(draw, &sent->stats, sizeof(sent->stats));
	accel_draw_free(draw);
	accel_target_free(target);
	accel_device_free(device);
}

static void any_number_of_threads_sends_the_same_words(void **state)
{
	static const char *const name[] = { "model:threads=1", "model:threads=2", "model:threads=5",
					    "model:" };
	struct sent one = { .words = malloc(WORDS_MAX * 4) };
	struct sent other = { .words = malloc(WORDS_MAX * 4) };
	uint64_t seed = test_seed();
	size_t words = 0;

	(void)state;
	for (int n = 0; n < 8; n++, seed++) {
		sent = &one;
		draw_frames(name[0], seed);
		words += one.count;
		sent = &other;
		draw_frames(name[1 + n % 3], seed);
		assert_int_equal(one.count, other.count);
		assert_memory_equal(one.words, other.words, one.count * 4);
		assert_memory_equal(&one.stats, &other.stats, sizeof(one.stats));
	}
	assert_true(words > 8000);
	free(one.words);
	free(other.words);
}

static void the_first_vertex_that_is_not_finite_is_told(void **state)
{
	static const char *const name[] = { "model:threads=1", "model:threads=4" };
	static uint32_t words[1 << 16];
	struct sent some = { .words = words };
	uint64_t seed = 1;

	(void)state;
	sent = &some;
	mesh_fill(&seed);
	position[5000][1] = position[VERTICES - 1][2] = (float)(1e300 * 1e300);
	for (int i = 0; i < 2; i++) {
		const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
							  .vertices = VERTICES,
							  .position = { .data = position },
							  .index = index_of,
							  .indices = 3 * TRIANGLES);
		struct messages messages;
		struct accel_device *device = device_open(name[i], &messages);
		struct accel_target *target;
		struct accel_state *drawn;
		struct accel_draw *draw;

		assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
		assert_int_equal(accel_draw_new(device, &draw), 0);
		assert_int_equal(accel_state_new(&drawn), 0);
		assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
		assert_int_equal(accel_draw_mesh(draw, drawn, &mesh), -EINVAL);
		assert_message(&messages, "vertex 5000 of the mesh is not finite");
		assert_int_equal(messages.count, 1);
		accel_state_free(drawn);
		accel_draw_free(draw);
		accel_target_free(target);
		accel_device_free(device);
	}
}

/* Whichever thread it is that gets no memory, the frame is lost, and the next is as ever. */
static void memory_that_a_thread_does_not_get_loses_the_frame(void **state)
{
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = VERTICES,
						  .position = { .data = position },
						  .index = index_of, .indices = 3 * 5000);
	static uint32_t words[1 << 20];
	struct sent some = { .words = words };
	struct messages messages;
	struct accel_device *device = device_open("model:threads=3", &messages);
	struct accel_target *target;
	struct accel_state *drawn;
	uint64_t seed = 1;
	size_t wanted = 0;
	int err = -ENOMEM, failed = 0;

	(void)state;
	sent = &some;
	mesh_fill(&seed);
	assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
	assert_int_equal(accel_state_new(&drawn), 0);
	for (int n = 0; err; n++) {
		struct accel_draw *draw;

		assert_int_equal(accel_draw_new(device, &draw), 0);
		assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
		allocations_left = n;
		err = accel_draw_mesh(draw, drawn, &mesh);
		allocations_left = -1;
		if (err) {
			failed++;
			assert_int_equal(err, -ENOMEM);
			assert_int_equal(accel_draw_mesh(draw, drawn, &mesh), -EINVAL);
			assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
			assert_int_equal(accel_draw_mesh(draw, drawn, &mesh), 0);
		}
		some.count = 0;
		assert_int_equal(accel_draw_finish(draw), 0);
		if (!wanted)
			wanted = some.count;
		assert_int_equal(some.count, wanted);
		accel_draw_free(draw);
	}
	assert_true(wanted > 1000);
	assert_true(failed > 10);
	accel_state_free(drawn);
	accel_target_free(target);
	accel_device_free(device);
}

/* What a child draws on. */
static struct {
	struct accel_draw *draw;
	struct accel_state *state;
	struct accel_mesh mesh;
} inherited;

static int child_draws(void)
{
	int err = accel_draw_mesh(inherited.draw, inherited.state, &inherited.mesh);

	accel_draw_free(inherited.draw);
	return err ? 1 : 0;
}

/* It has none of the threads, and must not wait for them. */
static void a_child_of_fork_draws_alone(void **state)
{
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	uint64_t seed = 1;

	(void)state;
	mesh_fill(&seed);
	inherited.mesh = (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						       .vertices = VERTICES,
						       .position = { .data = position },
						       .index = index_of, .indices = 3 * TRIANGLES);
	device = device_open("model:threads=4", &messages);
	assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
	assert_int_equal(accel_draw_new(device, &inherited.draw), 0);
	assert_int_equal(accel_state_new(&inherited.state), 0);
	assert_int_equal(accel_draw_begin(inherited.draw, target, NULL), 0);
	assert_int_equal(accel_draw_mesh(inherited.draw, inherited.state, &inherited.mesh), 0);
	assert_int_equal(child_run(child_draws, test_patience_s()), 0);
	accel_state_free(inherited.state);
	accel_draw_free(inherited.draw);
	accel_target_free(target);
	accel_device_free(device);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(any_number_of_threads_sends_the_same_words),
		cmocka_unit_test(the_first_vertex_that_is_not_finite_is_told),
		cmocka_unit_test(memory_that_a_thread_does_not_get_loses_the_frame),
		cmocka_unit_test(a_child_of_fork_draws_alone),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
