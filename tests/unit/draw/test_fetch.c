/* SPDX-License-Identifier: MIT */
/* Arrays of a mesh: where elements lie, what they consist of, and what is not read. */
#include "draw/draw_priv.h"
#include "accel_test.h"

#define SIDE 64

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_state *state;
	struct accel_draw *draw;
};

static const float position[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { -1, 1, 0 }, { 1, 1, 0 } };
static const float colour[4][4] = {
	{ 1, 0, 0, 1 }, { 0, 1, 0, 0.2f }, { 0, 0, 1, 0.8f }, { 0.4f, 0.6f, 0, 1 }
};

static int setup(void **state)
{
	static struct fixture f;

	f.device = device_open("model:", &f.messages);
	assert_int_equal(accel_target_new(f.device, SIDE, SIDE, &f.target), 0);
	assert_int_equal(accel_state_new(&f.state), 0);
	assert_int_equal(accel_draw_new(f.device, &f.draw), 0);
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_draw_free(f->draw);
	accel_state_free(f->state);
	accel_target_free(f->target);
	accel_device_free(f->device);
	return 0;
}

static struct accel_mesh strip(struct accel_array positions, struct accel_array colours)
{
	return (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP,
					     .vertices = 4, .position = positions,
					     .colour = colours);
}

static void picture(struct fixture *f, const struct accel_mesh *mesh, uint32_t *pixels)
{
	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
}

/* The pictures are the same, and of something. */
static void check_same(struct fixture *f, struct accel_mesh mesh, struct accel_mesh as)
{
	static uint32_t pixels[2][SIDE * SIDE];
	int drawn = 0;

	picture(f, &mesh, pixels[0]);
	picture(f, &as, pixels[1]);
	assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
	for (int i = 0; i < SIDE * SIDE; i++)
		drawn += pixels[0][i] != 0;
	assert_true(drawn > SIDE);
}

static struct accel_mesh packed(void)
{
	return strip((struct accel_array){ .data = position },
		     (struct accel_array){ .data = colour });
}

static void vertices_may_be_interleaved(void **state)
{
	struct {
		float colour[4];
		char tag;
		float position[3];
	} vertex[4];

	for (int i = 0; i < 4; i++) {
		memcpy(vertex[i].colour, colour[i], sizeof(colour[i]));
		memcpy(vertex[i].position, position[i], sizeof(position[i]));
	}
	check_same(*state,
		   strip((struct accel_array){ .data = vertex[0].position,
					       .stride = sizeof(vertex[0]) },
			 (struct accel_array){ .data = vertex[0].colour,
					       .stride = sizeof(vertex[0]) }),
		   packed());
}

static void elements_may_be_at_any_address(void **state)
{
	uint8_t bytes[4 * 31 + 1];

	for (int i = 0; i < 4; i++) {
		memcpy(bytes + 1 + 31 * i, position[i], sizeof(position[i]));
		memcpy(bytes + 14 + 31 * i, colour[i], sizeof(colour[i]));
	}
	check_same(*state,
		   strip((struct accel_array){ .data = bytes + 1, .stride = 31 },
			 (struct accel_array){ .data = bytes + 14, .stride = 31 }),
		   packed());
}

static void colours_may_be_bytes(void **state)
{
	uint8_t bytes[4][4];

	for (int i = 0; i < 16; i++)
		bytes[i / 4][i % 4] = (uint8_t)(colour[i / 4][i % 4] * 255 + 0.5f);
	check_same(*state,
		   strip((struct accel_array){ .data = position },
			 (struct accel_array){
				 .data = bytes, .type = ACCEL_TYPE_UBYTE, .normalised = true }),
		   packed());
}

static void alpha_and_z_may_be_left_out(void **state)
{
	static const float flat[4][2] = { { -1, -1 }, { 1, -1 }, { -1, 1 }, { 1, 1 } };
	float rgb[4][3], opaque[4][4];

	for (int i = 0; i < 4; i++) {
		memcpy(rgb[i], colour[i], sizeof(rgb[i]));
		memcpy(opaque[i], colour[i], sizeof(opaque[i]));
		opaque[i][3] = 1;
	}
	check_same(*state,
		   strip((struct accel_array){ .data = flat, .components = 2 },
			 (struct accel_array){ .data = rgb, .components = 3 }),
		   strip((struct accel_array){ .data = position },
			 (struct accel_array){ .data = opaque }));
}

static void one_element_may_be_that_of_all_vertices(void **state)
{
	const float all[4][4] = {
		{ 1, 0.5f, 0, 1 }, { 1, 0.5f, 0, 1 }, { 1, 0.5f, 0, 1 }, { 1, 0.5f, 0, 1 }
	};

	check_same(*state,
		   strip((struct accel_array){ .data = position },
			 (struct accel_array){ .data = all, .stride = 1000, .constant = true }),
		   strip((struct accel_array){ .data = position },
			 (struct accel_array){ .data = all }));
}

/* A triangle that leaves the view is fetched a second time. */
static void clipped_vertices_are_fetched_with_their_stride(void **state)
{
	static const float near[4][3] = { { -1, -1, -3 }, { 1, -1, 0 }, { -1, 1, 0 }, { 1, 1, 2 } };
	float wide[4][5];

	for (int i = 0; i < 4; i++)
		memcpy(wide[i], near[i], sizeof(near[i]));
	check_same(*state,
		   strip((struct accel_array){ .data = wide, .stride = sizeof(wide[0]) },
			 (struct accel_array){ .data = colour }),
		   strip((struct accel_array){ .data = near },
			 (struct accel_array){ .data = colour }));
}

static void refuse(struct fixture *f, struct accel_mesh mesh, const char *why)
{
	f->messages.last[0] = '\0';
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), -EINVAL);
	assert_message(&f->messages, why);
}

static void what_is_not_read_is_refused(void **state)
{
	static const uint8_t most[3] = { 4, 3, 4 }, least[3] = { 2, 3, 3 };
	static const char *const name[3] = { "positions of ", "normals of ", "colours of " };

	for (int i = 0; i < 3; i++) {
		struct accel_mesh mesh = packed();
		struct accel_array *array[3] = { &mesh.position, &mesh.normal, &mesh.colour };

		array[i]->data = colour;
		for (unsigned int components = 1; components < 256; components++) {
			array[i]->components = (uint8_t)components;
			if (components < least[i] || components > most[i])
				refuse(*state, mesh, name[i]);
		}
		array[i]->components = 0;
		for (size_t j = 0; j < sizeof(array[i]->reserved); j++) {
			array[i]->reserved[j] = 1;
			refuse(*state, mesh, "whose reserved bytes are set");
			array[i]->reserved[j] = 0;
		}
		array[i]->type = (enum accel_type)(ACCEL_TYPE_UINT + 1);
		refuse(*state, mesh, "which is none of ACCEL_TYPE_*");
		array[i]->type = (enum accel_type) - 1;
		refuse(*state, mesh, "which is none of ACCEL_TYPE_*");
	}
}

static void topologies_that_are_none_are_refused(void **state)
{
	struct accel_mesh mesh = packed();

	for (int topology = -1; topology < 12; topology++) {
		mesh.topology = (enum accel_topology)topology;
		if (topology < 0 || topology > ACCEL_TOPOLOGY_POLYGON)
			refuse(*state, mesh, "which is none of ACCEL_TOPOLOGY_*");
	}
}

static void a_mesh_has_its_size(void **state)
{
	struct {
		struct accel_mesh now;
		uint64_t later;
	} mesh = { packed(), 0 };
	struct fixture *f = *state;

	mesh.now.size = 0;
	refuse(f, mesh.now, "begin it with ACCEL_MESH()");
	mesh.now = packed();
	mesh.now.reserved = 1;
	refuse(f, mesh.now, "reserved");
	mesh.now.reserved = 0;
	mesh.now.size = sizeof(mesh);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh.now), 0);
	mesh.later = 1;
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh.now), -E2BIG);
	assert_message(&f->messages, "the program needs a newer library");
}

#define fetch_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		fetch_test(vertices_may_be_interleaved),
		fetch_test(elements_may_be_at_any_address),
		fetch_test(colours_may_be_bytes),
		fetch_test(alpha_and_z_may_be_left_out),
		fetch_test(one_element_may_be_that_of_all_vertices),
		fetch_test(clipped_vertices_are_fetched_with_their_stride),
		fetch_test(what_is_not_read_is_refused),
		fetch_test(topologies_that_are_none_are_refused),
		fetch_test(a_mesh_has_its_size),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
