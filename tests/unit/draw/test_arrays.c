/* SPDX-License-Identifier: MIT */
/* accel_draw_arrays: numbers of all types, lists of primitives, and vertices that can not be drawn. */
#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

#include "draw_fixture.h"

#define SIDE 64
#define BLACK 0x00000000u

static uint32_t pixels[2][SIDE * SIDE];

static int setup(void **state)
{
	struct accel_state *drawn;

	assert_int_equal(accel_state_new(&drawn), 0);
	*state = fixture_new(SIDE, drawn);
	return 0;
}

static void begin(struct fixture *f)
{
	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
}

static void finish(struct fixture *f, uint32_t *to)
{
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, to, SIDE * 4), 0);
}

static void picture(struct fixture *f, const struct accel_arrays *arrays,
		    const struct accel_elements *elements, uint32_t *to)
{
	begin(f);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, arrays, elements), 0);
	finish(f, to);
}

static void picture_of(struct fixture *f, const struct accel_arrays *arrays,
		       enum accel_topology topology, uint32_t count, uint32_t *to)
{
	const struct accel_primitive primitive = { topology, 0, count };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive,
							      .primitives = 1);

	picture(f, arrays, &elements, to);
}

static int count_of(const uint32_t *of, uint32_t value)
{
	int count = 0;

	for (int i = 0; i < SIDE * SIDE; i++)
		count += of[i] == value;
	return count;
}

static void assert_same_picture(void)
{
	assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
	assert_true(count_of(pixels[0], BLACK) < SIDE * (SIDE - 1));
}

/* A strip over the view. */
static const float square[4][2] = { { -1, -1 }, { 1, -1 }, { -1, 1 }, { 1, 1 } };

/* ---- numbers ---- */

/* A number, as each type has it, and what it stands for as it is and normalised. */
static const struct number {
	enum accel_type type;
	bool normalised;
	union {
		double double_;
		int32_t fixed;
		int8_t byte;
		uint8_t ubyte;
		int16_t short_;
		uint16_t ushort;
		int32_t int_;
		uint32_t uint;
	} is;
	uint32_t size;
	double stands_for;
} numbers[] = {
	{ ACCEL_TYPE_DOUBLE, false, { .double_ = 0.3 }, 8, 0.3 },
	{ ACCEL_TYPE_FIXED, false, { .fixed = 0x4000 }, 4, 0.25 },
	{ ACCEL_TYPE_FIXED, true, { .fixed = 0xc000 }, 4, 0.75 },
	{ ACCEL_TYPE_BYTE, false, { .byte = 1 }, 1, 1 },
	{ ACCEL_TYPE_BYTE, false, { .byte = -1 }, 1, -1 },
	{ ACCEL_TYPE_BYTE, true, { .byte = 63 }, 1, 127 / 255.0 },
	{ ACCEL_TYPE_BYTE, true, { .byte = -128 }, 1, -1 },
	{ ACCEL_TYPE_BYTE, true, { .byte = 0 }, 1, 1 / 255.0 },
	{ ACCEL_TYPE_UBYTE, false, { .ubyte = 1 }, 1, 1 },
	{ ACCEL_TYPE_UBYTE, true, { .ubyte = 51 }, 1, 0.2 },
	{ ACCEL_TYPE_SHORT, false, { .short_ = 1 }, 2, 1 },
	{ ACCEL_TYPE_SHORT, true, { .short_ = 16383 }, 2, 32767 / 65535.0 },
	{ ACCEL_TYPE_SHORT, true, { .short_ = -32768 }, 2, -1 },
	{ ACCEL_TYPE_USHORT, false, { .ushort = 1 }, 2, 1 },
	{ ACCEL_TYPE_USHORT, true, { .ushort = 39321 }, 2, 0.6 },
	{ ACCEL_TYPE_INT, false, { .int_ = 1 }, 4, 1 },
	{ ACCEL_TYPE_INT, true, { .int_ = 1073741823 }, 4, 2147483647 / 4294967295.0 },
	{ ACCEL_TYPE_INT, true, { .int_ = INT32_MIN }, 4, -1 },
	{ ACCEL_TYPE_UINT, false, { .uint = 1 }, 4, 1 },
	{ ACCEL_TYPE_UINT, true, { .uint = 2576980377u }, 4, 0.6 },
};

/* Red is the number, and it is at an odd address. */
static void a_number_of_any_type_is_what_opengl_takes_it_for(void **state)
{
	for (size_t n = 0; n < sizeof(numbers) / sizeof(numbers[0]); n++) {
		const struct number *number = &numbers[n];
		double red = fmin(fmax(number->stands_for, 0), 1) * 255;
		uint8_t element[3 * 8 + 1] = { 0 };
		const struct accel_arrays arrays = ACCEL_ARRAYS(
				.vertices = 4, .position = { .data = square, .components = 2 },
				.colour = { .data = element + 1,
					    .type = number->type,
					    .components = 3,
					    .normalised = number->normalised,
					    .constant = true });
		int got;

		memcpy(element + 1, &number->is, number->size);
		picture_of(*state, &arrays, ACCEL_TOPOLOGY_TRIANGLE_STRIP, 4, pixels[0]);
		got = (int)(pixels[0][0] & 0xff);
		if (fabs(got - red) > 0.501)
			fail_msg("number %zu of type %u is %d, not %f", n, number->type, got, red);
		assert_int_equal(pixels[0][0] >> 24, 255);
	}
}

/* The same strip, of each type, and apart by a stride. */
static void positions_may_be_of_any_type(void **state)
{
	static const int at[4][2] = { { -3, -2 }, { 3, -2 }, { -1, 2 }, { 2, 1 } };
	static const float scale[16] = { 0.25f, 0, 0, 0, 0, 0.25f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
	struct {
		double d[4][2];
		int32_t fixed[4][2], i[4][2];
		int16_t s[4][2];
		int8_t b[4][2];
	} as;
	float floats[4][2];
	struct fixture *f = *state;
	struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 4,
						  .position = { .data = floats, .components = 2 });
	const struct {
		const void *data;
		enum accel_type type;
	} kinds[] = {
		{ as.d, ACCEL_TYPE_DOUBLE }, { as.fixed, ACCEL_TYPE_FIXED },
		{ as.i, ACCEL_TYPE_INT },    { as.s, ACCEL_TYPE_SHORT },
		{ as.b, ACCEL_TYPE_BYTE },
	};

	for (int i = 0; i < 8; i++) {
		const int value = at[i / 2][i % 2];

		floats[i / 2][i % 2] = (float)value;
		as.d[i / 2][i % 2] = as.i[i / 2][i % 2] = value;
		as.fixed[i / 2][i % 2] = value * 65536;
		as.s[i / 2][i % 2] = (int16_t)value;
		as.b[i / 2][i % 2] = (int8_t)value;
	}
	accel_state_set_modelview(f->state, scale);
	picture_of(f, &arrays, ACCEL_TOPOLOGY_TRIANGLE_STRIP, 4, pixels[0]);
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++) {
		arrays.position.data = kinds[i].data;
		arrays.position.type = kinds[i].type;
		picture_of(f, &arrays, ACCEL_TOPOLOGY_TRIANGLE_STRIP, 4, pixels[1]);
		assert_same_picture();
	}
}

/* Also where they are clipped. */
static void positions_may_be_homogeneous(void **state)
{
	static const float w[4] = { 2, 0.25f, 8, 1 };
	float plain[4][3] = { { -1, -1, -4 }, { 1, -1, 0.5f }, { -1, 1, 0 }, { 1, 1, 0.25f } };
	float homogeneous[4][4];
	struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 4,
						  .position = { .data = plain, .components = 3 });

	for (int i = 0; i < 4; i++) {
		for (int j = 0; j < 3; j++)
			homogeneous[i][j] = plain[i][j] * w[i];
		homogeneous[i][3] = w[i];
	}
	picture_of(*state, &arrays, ACCEL_TOPOLOGY_TRIANGLE_STRIP, 4, pixels[0]);
	arrays.position = (struct accel_array){ .data = homogeneous };
	picture_of(*state, &arrays, ACCEL_TOPOLOGY_TRIANGLE_STRIP, 4, pixels[1]);
	assert_same_picture();
}

/* ---- primitives ---- */

#define COLUMNS 8

/* Two rows of vertices over the view: vertex i + COLUMNS is above i. Each has a colour of its own. */
static float grid[2 * COLUMNS][2];
static uint8_t grid_colour[2 * COLUMNS][4];

static struct accel_arrays grid_arrays(void)
{
	for (int i = 0; i < 2 * COLUMNS; i++) {
		grid[i][0] = (float)(i % COLUMNS * 2) / (COLUMNS - 1) - 1;
		grid[i][1] = i < COLUMNS ? -1 : 1;
		grid_colour[i][0] = (uint8_t)(10 * i + 10);
		grid_colour[i][3] = 255;
	}
	return (struct accel_arrays)ACCEL_ARRAYS(.vertices = 2 * COLUMNS,
						 .position = { .data = grid, .components = 2 },
						 .colour = { .data = grid_colour,
							     .type = ACCEL_TYPE_UBYTE,
							     .normalised = true });
}

static uint32_t grid_value(int vertex)
{
	return (uint32_t)grid_colour[vertex][0] | 0xff000000;
}

/* Elements of a primitive over some of the view, and which vertices colour how much of it. */
static const struct row {
	enum accel_topology topology;
	uint32_t count;
	uint8_t index[12];
	struct {
		int vertex, pixels; /* 7 columns; in 64ths of the view's pixels, about */
	} flat[4];
} rows[] = {
	{ ACCEL_TOPOLOGY_TRIANGLES, 8, { 0, 7, 8, 15, 8, 7, 1, 2 }, { { 8, 32 }, { 7, 32 } } },
	{ ACCEL_TOPOLOGY_TRIANGLE_STRIP, 4, { 0, 7, 8, 15 }, { { 8, 32 }, { 15, 32 } } },
	{ ACCEL_TOPOLOGY_TRIANGLE_FAN, 4, { 0, 7, 15, 8 }, { { 15, 32 }, { 8, 32 } } },
	{ ACCEL_TOPOLOGY_QUADS, 4, { 0, 7, 15, 8 }, { { 8, 64 } } },
	{ ACCEL_TOPOLOGY_QUADS, 4, { 7, 15, 8, 0 }, { { 0, 64 } } },
	{ ACCEL_TOPOLOGY_QUADS, 11, { 0, 7, 15, 8, 8, 0, 7, 15, 1, 2, 3 }, { { 15, 64 } } },
	{ ACCEL_TOPOLOGY_QUAD_STRIP, 4, { 0, 8, 7, 15 }, { { 15, 64 } } },
	{ ACCEL_TOPOLOGY_QUAD_STRIP, 7, { 0, 8, 4, 12, 7, 15, 1 }, { { 12, 36 }, { 15, 27 } } },
	{ ACCEL_TOPOLOGY_POLYGON, 4, { 0, 7, 15, 8 }, { { 0, 64 } } },
	{ ACCEL_TOPOLOGY_POLYGON, 6, { 7, 15, 12, 8, 0, 3 }, { { 7, 64 } } },
	{ ACCEL_TOPOLOGY_POLYGON, 2, { 7, 15 }, { { 0, 0 } } },
	{ ACCEL_TOPOLOGY_QUADS, 3, { 0, 7, 15 }, { { 0, 0 } } },
	{ ACCEL_TOPOLOGY_QUAD_STRIP, 3, { 0, 7, 15 }, { { 0, 0 } } },
	{ ACCEL_TOPOLOGY_TRIANGLE_FAN, 0, { 0 }, { { 0, 0 } } },
};

/* With the colour of the vertex that OpenGL's table 2.12 names, and as it turns. */
static void what_is_filled_has_the_colour_of_its_provoking_vertex(void **state)
{
	const struct accel_arrays arrays = grid_arrays();
	struct fixture *f = *state;

	accel_state_set_shading(f->state, ACCEL_SHADING_FLAT);
	for (size_t n = 0; n < sizeof(rows) / sizeof(rows[0]); n++) {
		const struct accel_primitive primitive = { rows[n].topology, 0, rows[n].count };
		const struct accel_elements elements =
			ACCEL_ELEMENTS(.primitive = &primitive, .primitives = 1,
				       .index = rows[n].index, .index_type = ACCEL_TYPE_UBYTE);
		int left = SIDE * SIDE;

		picture(f, &arrays, &elements, pixels[0]);
		for (int i = 0; i < 4; i++) {
			int got = count_of(pixels[0], grid_value(rows[n].flat[i].vertex));

			if (abs(got - rows[n].flat[i].pixels * SIDE * SIDE / 64) > 2 * SIDE &&
			    rows[n].flat[i].pixels)
				fail_msg("row %zu: vertex %d colours %d pixels", n,
					 rows[n].flat[i].vertex, got);
			left -= rows[n].flat[i].pixels ? got : 0;
		}
		assert_int_equal(left, count_of(pixels[0], BLACK));
		assert_true(!rows[n].flat[0].pixels || left == 0);
	}
}

/* Of what turns clockwise nothing is drawn. */
static void quads_and_polygons_turn_as_their_vertices_do(void **state)
{
	static const uint8_t turned[][4] = {
		{ 0, 7, 15, 8 }, { 8, 15, 7, 0 }, { 0, 7, 8, 15 }, { 7, 0, 15, 8 }
	};
	static const enum accel_topology topology[] = { ACCEL_TOPOLOGY_QUADS,
							ACCEL_TOPOLOGY_POLYGON,
							ACCEL_TOPOLOGY_QUAD_STRIP };
	const struct accel_arrays arrays = grid_arrays();
	struct fixture *f = *state;

	accel_state_set_cull(f->state, ACCEL_CULL_BACK);
	for (int n = 0; n < 6; n++) {
		const struct accel_primitive primitive = { topology[n / 2], 0, 4 };
		const struct accel_elements elements = ACCEL_ELEMENTS(
				.primitive = &primitive, .primitives = 1,
				.index = turned[n / 2 == 2 ? 2 + n % 2 : n % 2],
				.index_type = ACCEL_TYPE_UBYTE);

		picture(f, &arrays, &elements, pixels[0]);
		assert_int_equal(count_of(pixels[0], BLACK), n % 2 ? SIDE * SIDE : 0);
	}
}

static void indices_may_be_of_three_types_at_any_address(void **state)
{
	static const uint8_t strip[6] = { 3, 0, 9, 11, 4, 15 };
	static const struct accel_primitive primitive = { ACCEL_TOPOLOGY_TRIANGLE_STRIP, 1, 5 };
	const struct accel_arrays arrays = grid_arrays();
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive, .primitives = 1,
							.index = strip,
							.index_type = ACCEL_TYPE_UBYTE);
	uint8_t odd[1 + 6 * 4];

	picture(*state, &arrays, &elements, pixels[0]);
	for (unsigned int size = 2; size <= 4; size += 2) {
		for (int i = 0; i < 6; i++) {
			const uint32_t wide = strip[i];

			memcpy(odd + 1 + (size_t)i * size, &wide, size);
		}
		elements.index = odd + 1;
		elements.index_type = size == 2 ? ACCEL_TYPE_USHORT : ACCEL_TYPE_UINT;
		picture(*state, &arrays, &elements, pixels[1]);
		assert_same_picture();
	}
}

static void primitives_of_one_call_are_as_if_drawn_one_by_one(void **state)
{
	static const struct accel_primitive primitive[] = {
		{ ACCEL_TOPOLOGY_QUAD_STRIP, 1, 7 },     { ACCEL_TOPOLOGY_TRIANGLES, 4, 2 },
		{ ACCEL_TOPOLOGY_POLYGON, 0, 5 },        { ACCEL_TOPOLOGY_TRIANGLE_FAN, 9, 0 },
		{ ACCEL_TOPOLOGY_TRIANGLE_STRIP, 3, 6 }, { ACCEL_TOPOLOGY_QUADS, 0, 9 },
	};
	static const uint16_t index[] = { 2, 10, 3, 11, 5, 13, 6, 14, 7, 15 };
	const uint32_t count = sizeof(primitive) / sizeof(primitive[0]);
	const struct accel_arrays arrays = grid_arrays();
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = primitive, .primitives = count,
							.index = index,
							.index_type = ACCEL_TYPE_USHORT);
	struct accel_draw_stats stats[2];
	struct fixture *f = *state;

	picture(f, &arrays, &elements, pixels[0]);
	accel_draw_stats(f->draw, &stats[0], sizeof(stats[0]));
	elements.primitives = 1;
	begin(f);
	for (uint32_t i = 0; i < count; i++) {
		elements.primitive = &primitive[i];
		assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	}
	finish(f, pixels[1]);
	accel_draw_stats(f->draw, &stats[1], sizeof(stats[1]));
	assert_same_picture();
	assert_memory_equal(&stats[0], &stats[1], sizeof(stats[0]));
	assert_int_equal(stats[0].triangles_in, 4 + 0 + 3 + 0 + 4 + 4);
}

/* ---- what can not be drawn ---- */

/* As a list of primitives with @bad in place of one vertex; what is left is that of @without. */
static void check_dropped(struct fixture *f, struct accel_primitive primitive, int bad,
			  uint32_t beyond, struct accel_primitive without)
{
	static const float wrong[] = { NAN, INFINITY, -INFINITY };
	struct accel_arrays arrays = grid_arrays();
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &without, .primitives = 1);
	uint32_t index[2 * COLUMNS];

	picture(f, &arrays, &elements, pixels[0]);
	elements.primitive = &primitive;
	for (int i = 0; i < 3; i++) {
		grid_arrays();
		grid[bad][i % 2] = wrong[i];
		picture(f, &arrays, &elements, pixels[1]);
		assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
	}
	grid_arrays();
	for (uint32_t i = 0; i < 2 * COLUMNS; i++)
		index[i] = i == (uint32_t)bad ? beyond : i;
	elements.index = index;
	elements.index_type = ACCEL_TYPE_UINT;
	picture(f, &arrays, &elements, pixels[1]);
	assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
}

static void a_vertex_that_is_none_drops_its_primitive_alone(void **state)
{
	static const struct accel_primitive none = { ACCEL_TOPOLOGY_TRIANGLES, 0, 0 };
	struct fixture *f = *state;

	check_dropped(f, (struct accel_primitive){ ACCEL_TOPOLOGY_TRIANGLES, 7, 6 }, 7, 16,
		      (struct accel_primitive){ ACCEL_TOPOLOGY_TRIANGLES, 10, 3 });
	for (int bad = 6; bad < 10; bad++)
		check_dropped(f, (struct accel_primitive){ ACCEL_TOPOLOGY_QUADS, 6, 8 }, bad,
			      UINT32_MAX, (struct accel_primitive){ ACCEL_TOPOLOGY_QUADS, 10, 4 });
	check_dropped(f, (struct accel_primitive){ ACCEL_TOPOLOGY_QUAD_STRIP, 5, 6 }, 6, 100,
		      (struct accel_primitive){ ACCEL_TOPOLOGY_QUAD_STRIP, 7, 4 });
	check_dropped(f, (struct accel_primitive){ ACCEL_TOPOLOGY_TRIANGLE_STRIP, 6, 5 }, 6, 16,
		      (struct accel_primitive){ ACCEL_TOPOLOGY_TRIANGLE_STRIP, 7, 4 });
	for (int bad = 6; bad < 11; bad++)
		check_dropped(f, (struct accel_primitive){ ACCEL_TOPOLOGY_POLYGON, 6, 5 }, bad, 16,
			      none);
}

static void a_matrix_that_is_not_finite_draws_nothing(void **state)
{
	const struct accel_arrays arrays = grid_arrays();
	float matrix[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, NAN };
	struct fixture *f = *state;

	accel_state_set_modelview(f->state, matrix);
	picture_of(f, &arrays, ACCEL_TOPOLOGY_QUADS, 2 * COLUMNS, pixels[0]);
	assert_int_equal(count_of(pixels[0], BLACK), SIDE * SIDE);
}

/* Elements that no vertex of the arrays has, before and after those there are. */
static void elements_beyond_the_arrays_are_left_out(void **state)
{
	const struct accel_primitive primitive[] = { { ACCEL_TOPOLOGY_QUADS, 12, 8 },
						     { ACCEL_TOPOLOGY_TRIANGLES, UINT32_MAX, 3 },
						     { ACCEL_TOPOLOGY_POLYGON, 16, UINT32_MAX } };
	const struct accel_arrays arrays = grid_arrays();
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = primitive, .primitives = 1);
	struct accel_primitive whole = { ACCEL_TOPOLOGY_QUADS, 12, 4 };

	picture(*state, &arrays, &elements, pixels[1]);
	elements.primitive = &whole;
	picture(*state, &arrays, &elements, pixels[0]);
	assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
	elements.primitive = primitive + 1;
	elements.primitives = 2;
	picture(*state, &arrays, &elements, pixels[0]);
	assert_int_equal(count_of(pixels[0], BLACK), SIDE * SIDE);
}

/* ---- what is read ---- */

/* Of an array of 1 GiB two pages can be read, and those vertices are all that is needed. */
static void vertices_that_are_not_needed_are_not_read(void **state)
{
	const size_t size = (size_t)1 << 30, page = (size_t)sysconf(_SC_PAGESIZE);
	const uint32_t vertices = (uint32_t)(size / sizeof(square[0]));
	const uint32_t index[] = { 0, 1, vertices - 2, vertices - 1, vertices, vertices - 3, 1 };
	const struct accel_primitive primitive[] = { { ACCEL_TOPOLOGY_TRIANGLE_STRIP, 0, 4 },
						     { ACCEL_TOPOLOGY_TRIANGLES, 3, 3 } };
	const struct accel_primitive near_end = { ACCEL_TOPOLOGY_TRIANGLE_STRIP, vertices - 4, 4 };
	uint8_t *memory = mmap(NULL, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
			       -1, 0);
	struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = vertices,
						  .position = { .data = memory, .components = 2 });
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = primitive, .primitives = 2,
							.index = index,
							.index_type = ACCEL_TYPE_UINT);

	assert_true(memory != MAP_FAILED);
	assert_int_equal(mprotect(memory, page, PROT_READ | PROT_WRITE), 0);
	assert_int_equal(mprotect(memory + size - page, page, PROT_READ | PROT_WRITE), 0);
	memcpy(memory, square, 2 * sizeof(square[0]));
	memcpy(memory + size - 2 * sizeof(square[0]), square[2], 2 * sizeof(square[0]));
	picture(*state, &arrays, &elements, pixels[0]);
	memcpy(memory + size - sizeof(square), square, sizeof(square));
	elements = (struct accel_elements)ACCEL_ELEMENTS(.primitive = &near_end, .primitives = 1);
	picture(*state, &arrays, &elements, pixels[1]);
	assert_same_picture();
	assert_int_equal(count_of(pixels[0], BLACK), 0);
	munmap(memory, size);
}

/* ---- what is refused ---- */

static void refuse(struct fixture *f, const struct accel_arrays *arrays,
		   const struct accel_elements *elements, int err, const char *why)
{
	f->messages.last[0] = '\0';
	assert_int_equal(accel_draw_arrays(f->draw, f->state, arrays, elements), err);
	assert_message(&f->messages, why);
}

static void what_is_no_draw_is_refused(void **state)
{
	struct accel_primitive primitive = { ACCEL_TOPOLOGY_QUADS, 0, 4 };
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive, .primitives = 1);
	struct accel_arrays arrays = grid_arrays();
	struct fixture *f = *state;

	refuse(f, &arrays, &elements, -EINVAL, "without a frame");
	begin(f);
	arrays.reserved = 1;
	refuse(f, &arrays, &elements, -EINVAL, "reserved");
	arrays = grid_arrays();
	arrays.position.data = NULL;
	refuse(f, &arrays, &elements, -EINVAL, "without positions");
	arrays = grid_arrays();
	arrays.size = 0;
	refuse(f, &arrays, &elements, -EINVAL, "begin it with ACCEL_ARRAYS()");
	arrays = grid_arrays();
	elements.size = 1;
	refuse(f, &arrays, &elements, -EINVAL, "begin it with ACCEL_ELEMENTS()");
	elements.size = sizeof(elements);
	elements.index = grid;
	elements.index_type = ACCEL_TYPE_INT;
	refuse(f, &arrays, &elements, -EINVAL, "indices of type 7");
	elements.index = NULL;
	primitive.topology = (enum accel_topology)10;
	refuse(f, &arrays, &elements, -EINVAL, "primitive 0 is of topology 10");
	elements.primitives = 0;
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
}

#define arrays_test(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)

int main(void)
{
	const struct CMUnitTest tests[] = {
		arrays_test(a_number_of_any_type_is_what_opengl_takes_it_for),
		arrays_test(positions_may_be_of_any_type),
		arrays_test(positions_may_be_homogeneous),
		arrays_test(what_is_filled_has_the_colour_of_its_provoking_vertex),
		arrays_test(quads_and_polygons_turn_as_their_vertices_do),
		arrays_test(indices_may_be_of_three_types_at_any_address),
		arrays_test(primitives_of_one_call_are_as_if_drawn_one_by_one),
		arrays_test(a_vertex_that_is_none_drops_its_primitive_alone),
		arrays_test(a_matrix_that_is_not_finite_draws_nothing),
		arrays_test(elements_beyond_the_arrays_are_left_out),
		arrays_test(vertices_that_are_not_needed_are_not_read),
		arrays_test(what_is_no_draw_is_refused),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
