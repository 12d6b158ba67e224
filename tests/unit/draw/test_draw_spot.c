/* SPDX-License-Identifier: MIT */
/* Spots, whose rims are steps: a curve through one must not overshoot it, up or down. */
#include "draw_fixture.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 160
#define SCENES 60
#define EDGES 100000
#define STEP (1 / 255.0f)
/* Steps that a surface may rise above the samples it goes through, but for a pixel or two on edges
 * that are too short to be split. */
#define SWELL 12
#define SWELL_MOST 60

static struct shape shape;
static uint32_t without[SIDE * SIDE], with[SIDE * SIDE];

static int setup(void **state)
{
	*state = fixture_new(SIDE, state_shiny(20));
	return 0;
}

/* A square of two triangles, the largest there are to a rim. */
static void shape_square(struct shape *s)
{
	const double normal[3] = { 0, 0, 1 };

	shape_begin(s);
	for (int i = 0; i < 4; i++)
		shape_vertex(s, (const double[3]){ i & 1 ? 1 : -1, i & 2 ? 1 : -1, 0 }, normal);
	shape_triangle(s, 0, 1, 2);
	shape_triangle(s, 2, 1, 3);
}

static void random_shape(uint64_t *seed)
{
	int n = test_between(seed, 3, 14);

	switch (test_below(seed, 4)) {
	case 0:
		shape_square(&shape);
		break;
	case 1:
		shape_sphere(&shape, n);
		break;
	case 2:
		shape_torus(&shape, n + 2);
		break;
	default:
		shape_drum(&shape, n);
	}
}

/* In front of a mesh that is @distance away, and pointed at it; every second has a hard rim. */
static struct accel_light random_spot(uint64_t *seed, float distance)
{
	struct accel_light light = ACCEL_LIGHT(.enabled = true, .attenuation = { 1, 0, 0 });

	for (int i = 0; i < 3; i++) {
		light.position[i] = 4 * test_unit(seed) - 2;
		light.spot_direction[i] = 0.6f * (2 * test_unit(seed) - 1) - light.position[i];
		light.diffuse[i] = 0.7f * test_unit(seed);
	}
	light.position[2] = test_unit(seed) * 2 + 0.7f - distance;
	light.position[3] = 1;
	light.spot_direction[2] = -1 - light.position[2] - distance;
	light.attenuation[1] = test_below(seed, 2) ? test_unit(seed) : 0;
	light.attenuation[2] = test_below(seed, 2) ? test_unit(seed) : 0;
	light.spot_exponent = test_below(seed, 2) ? 0 : (float)test_below(seed, 129);
	light.spot_cutoff = 2 + test_unit(seed) * (test_below(seed, 4) ? 28 : 88);
	return light;
}

static void light_off(struct accel_state *state, int i)
{
	const struct accel_light off = ACCEL_LIGHT(.position = { 0, 0, 1, 0 }, .spot_cutoff = 180);

	assert_int_equal(accel_state_set_light(state, i, &off), 0);
}

static void read_picture(struct fixture *f, uint32_t *pixels)
{
	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 1, 1, 1, 0 }, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
}

/* The brightest that the exact light gets anywhere on the mesh, seen by @side. */
static void brightest_light(const struct fixture *f, float most[3])
{
	struct accel_transform transform;
	struct accel_lighting lighting;
	const float white[4] = { 1, 1, 1, 1 };
	const int parts = (int)sqrt(240000.0 / shape.mesh.indices);

	accel_geometry_init(&transform, f->state, SIDE, SIDE);
	accel_lighting_init(&lighting, f->state, false);
	most[0] = most[1] = most[2] = 0;
	for (uint32_t n = 0; n < shape.mesh.indices; n += 3)
		for (int at = 0; at < (parts + 1) * (parts + 1); at++) {
			float part[3] = { (float)(at % (parts + 1)) / (float)parts,
					  (float)(at / (parts + 1)) / (float)parts };
			float eye[3] = { 0 }, normal[3] = { 0 };
			struct accel_sample sample;

			part[2] = 1 - part[0] - part[1];
			if (part[2] < 0)
				continue;
			for (int i = 0; i < 3; i++) {
				struct accel_vertex v;
				uint32_t index = shape.index[n + (uint32_t)i];

				accel_geometry_vertex(&transform, shape.position[index],
						      shape.normal[index], &v);
				for (int j = 0; j < 3; j++) {
					eye[j] += part[i] * v.eye[j];
					normal[j] += part[i] * v.normal[j];
				}
			}
			accel_lighting_sample(&lighting, 0, eye, normal, white, &sample);
			for (int i = 0; i < 3; i++)
				most[i] = fmaxf(most[i], sample.colour[i]);
		}
}

static int channel(uint32_t pixel, int i)
{
	return (int)(pixel >> 8 * i & 0xff);
}

/* How far the picture leaves what may be: below the one without spots, above the brightest. Returns
 * how many channels of pixels are above it by more than SWELL. */
static int compare(const float most[3], int *below, int *above)
{
	int swollen = 0;

	for (int n = 0; n < SIDE * SIDE; n++) {
		for (int i = 0; i < 3; i++) {
			int under = channel(without[n], i) - channel(with[n], i);
			int over = channel(with[n], i) - (int)(255 * fminf(most[i], 1) + 0.5f);

			if (channel(without[n], 3) == 0)
				continue;
			*below = under > *below ? under : *below;
			*above = over > *above ? over : *above;
			swollen += over > SWELL;
		}
	}
	return swollen;
}

static void check_scene(struct fixture *f, uint64_t *seed, enum accel_shading shading)
{
	const struct accel_material matt = ACCEL_MATERIAL(.ambient = { 0.8f, 0.8f, 0.8f, 1 },
							  .diffuse = { 1, 1, 1, 1 });
	uint64_t scene = *seed;
	int lights = test_between(seed, 1, 4), below = 0, above = 0, swollen;
	float most[3];

	random_shape(seed);
	state_look(f->state, 3);
	accel_state_set_shading(f->state, shading);
	assert_int_equal(accel_state_set_material(f->state, &matt, NULL), 0);
	for (int i = 0; i < 4; i++)
		light_off(f->state, i);
	read_picture(f, without);
	for (int i = 0; i < lights; i++) {
		struct accel_light light = random_spot(seed, 3);

		assert_int_equal(accel_state_set_light(f->state, i, &light), 0);
	}
	read_picture(f, with);
	brightest_light(f, most);
	swollen = compare(most, &below, &above);
	/* One curve for a whole triangle may swell between its edges. */
	if (shading == ACCEL_SHADING_QUADRATIC)
		swollen = above = 0;
	if (below > 1 || swollen > 10 || above > SWELL_MOST)
		fail_msg("scene %#llx, shading %d: %d steps below the light without spots, "
			 "%d above the brightest there is",
			 (unsigned long long)scene, (int)shading, below, above);
}

static void spots_darken_no_pixel_and_overshoot_nothing(void **state)
{
	uint64_t seed = test_seed();

	for (int n = 0; n < SCENES; n++)
		check_scene(*state, &seed,
			    n % 3 ? ACCEL_SHADING_ADAPTIVE : ACCEL_SHADING_QUADRATIC);
}

/* The reported case: black fur around the cone. */
static void a_hard_rim_leaves_the_light_that_was_there(void **state)
{
	const struct accel_material plastic = ACCEL_MATERIAL(.ambient = { 0.8f, 0.75f, 0.65f, 1 },
							     .diffuse = { 0.6f, 0.6f, 0.6f, 1 },
							     .specular = { 0.5f, 0.5f, 0.5f, 1 },
							     .shininess = 30);
	struct accel_light light = ACCEL_LIGHT(.enabled = true, .position = { 0.6f, 0.5f, -1, 1 },
					       .diffuse = { 1, 1, 1, 1 },
					       .specular = { 1, 1, 1, 1 },
					       .attenuation = { 1, 0, 0 },
					       .spot_direction = { -0.6f, -0.5f, -2 },
					       .spot_cutoff = 12);
	struct fixture *f = *state;
	int below = 0, above = 0;

	shape_square(&shape);
	state_look(f->state, 3);
	assert_int_equal(accel_state_set_material(f->state, &plastic, NULL), 0);
	light_off(f->state, 0);
	read_picture(f, without);
	assert_int_equal(accel_state_set_light(f->state, 0, &light), 0);
	read_picture(f, with);
	compare((const float[3]){ 1, 1, 1 }, &below, &above);
	assert_true(below <= 1);
}

/* ---- edges: what a lamp adds to the curve is nowhere less than nothing ---- */

static struct accel_vertex random_vertex(uint64_t *seed)
{
	struct accel_vertex v = vertex_at(test_between(seed, 0, 4000), test_between(seed, 0, 4000));

	for (int i = 0; i < 3; i++) {
		v.eye[i] = 2 * test_unit(seed) - 1;
		v.normal[i] = 2 * test_unit(seed) - 1;
	}
	v.eye[2] -= 3;
	v.normal[2] = 1;
	v.w = -v.eye[2];
	return v;
}

/* The control points of an edge's curve under the lamps that are on. */
static struct accel_edge edge_under(const struct fixture *f, struct accel_vertex a,
				    struct accel_vertex b, float control[3])
{
	struct accel_pass pass = { .state = f->state, .lit = true };
	struct accel_edge edge;

	accel_lighting_init(&pass.lighting, f->state, false);
	accel_shading_vertex(&pass, &a, 0);
	accel_shading_vertex(&pass, &b, 0);
	accel_shading_edge(&pass, &a, &b, 0, &edge);
	for (int i = 0; i < 3; i++)
		control[i] = 2 * edge.colour[i] - (a.sample.colour[i] + b.sample.colour[i]) / 2;
	return edge;
}

static void a_spot_lowers_no_curve(void **state)
{
	uint64_t seed = test_seed();
	struct fixture *f = *state;
	int curved = 0;

	accel_state_set_shading(f->state, ACCEL_SHADING_QUADRATIC);
	for (int n = 0; n < EDGES; n++) {
		struct accel_vertex a = random_vertex(&seed), b = random_vertex(&seed);
		struct accel_light lamp[3];
		float all[3], less[3];
		int last = test_between(&seed, 0, 3);

		for (int i = 0; i < 3; i++) {
			lamp[i] = random_spot(&seed, 3);
			for (int j = 0; j < 3; j++)
				lamp[i].diffuse[j] *= 0.5f;
			assert_int_equal(accel_state_set_light(f->state, i, &lamp[i]), 0);
		}
		curved += edge_under(f, a, b, all).curved;
		light_off(f->state, last);
		edge_under(f, a, b, less);
		for (int i = 0; i < 3; i++)
			if (all[i] < less[i] - STEP / 8)
				fail_msg("edge %d: with spot %d the curve is at %g, without at %g",
					 n, last, (double)all[i], (double)less[i]);
	}
	assert_true(curved > EDGES / 2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)
		TEST(spots_darken_no_pixel_and_overshoot_nothing),
		TEST(a_hard_rim_leaves_the_light_that_was_there),
		TEST(a_spot_lowers_no_curve),
#undef TEST
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
