/* SPDX-License-Identifier: MIT */
/*
 * Parallelograms of two triangles anywhere in clip space, behind the eye too: each pixel whose ray
 * meets one in view is drawn once. A sliver that clipping makes may be turned over by snapping its
 * corners, and then draw a pixel on its border that its neighbour draws too: that is rare.
 */
#include "draw/draw.c"

#include "draw_fixture.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 128
#define RANDOM_SHAPES 3000

static uint8_t counts[SIDE * SIDE];

/* corner + s * along[0] + t * along[1], 0 <= s, t <= 1 */
struct parallelogram {
	float corner[3], along[2][3];
};

static double clip[3][4]; /* of the corner and the two directions */
static int twice;         /* pixels on a border that were drawn twice */

static int setup(void **state)
{
	*state = fixture_new(SIDE, state_shiny(60));
	return 0;
}

/* Where the ray through a point of the window meets the plane: in view if all but w are 0 to 1. */
struct meeting {
	double s, t, depth, w;
	bool turned; /* seen from behind */
};

static struct meeting ray_meets(double x, double y)
{
	double ndc[2] = { 2 * x / SIDE - 1, 1 - 2 * y / SIDE };
	double a[2][3], det, z;
	struct meeting m;

	/* clip x = ndc x * clip w, and the same for y: two equations in s and t. */
	for (int i = 0; i < 2; i++)
		for (int j = 0; j < 3; j++)
			a[i][j] = clip[j][i] - ndc[i] * clip[j][3];
	det = a[0][1] * a[1][2] - a[0][2] * a[1][1];
	m.s = (a[0][2] * a[1][0] - a[0][0] * a[1][2]) / det;
	m.t = (a[0][0] * a[1][1] - a[0][1] * a[1][0]) / det;
	z = clip[0][2] + m.s * clip[1][2] + m.t * clip[2][2];
	m.w = clip[0][3] + m.s * clip[1][3] + m.t * clip[2][3];
	m.depth = (z / m.w + 1) / 2;
	m.turned = det < 0;
	return m;
}

/* Of numbers around a pixel: 1 all are within 0 to 1, 0 none can be, 2 some may. */
static int within(const double value[5])
{
	double low = value[0], high = value[0];

	for (int i = 1; i < 5; i++) {
		low = fmin(low, value[i]);
		high = fmax(high, value[i]);
	}
	return low >= 0 && high <= 1 ? 1 : high < 0 || low > 1 ? 0 : 2;
}

/* How often the pixel is to be drawn; 2: it is so near a border that snapping decides. */
static int ray_counts(int x, int y)
{
	double s[5], t[5], depth[5];
	int behind = 0, turned = 0, each[3];

	for (int i = 0; i < 5; i++) {
		double across = i < 4 ? (i & 1 ? 0.125 : -0.125) : 0;
		double down = i < 4 ? (i & 2 ? 0.125 : -0.125) : 0;
		struct meeting m = ray_meets(x + 0.5 + across, y + 0.5 + down);

		s[i] = m.s;
		t[i] = m.t;
		depth[i] = m.depth;
		behind += m.w < 0;
		turned += m.turned;
	}
	if (behind == 5)
		return 0;
	if (behind || turned % 5)
		return 2;
	each[0] = within(s);
	each[1] = within(t);
	each[2] = within(depth);
	if (!each[0] || !each[1] || !each[2])
		return 0;
	return each[0] == 1 && each[1] == 1 && each[2] == 1 ? 1 : 2;
}

static void clip_place(const struct accel_transform *transform, const float at[3], double place[4])
{
	const float position[4] = { at[0], at[1], at[2], 1 };

	accel_geometry_clip_space(transform, position, place);
}

static void clip_corners(struct fixture *f, const struct parallelogram *p)
{
	struct accel_transform transform;
	const float origin[4] = { 0, 0, 0, 1 };
	double base[4];

	accel_geometry_init(&transform, f->state, SIDE, SIDE);
	clip_place(&transform, p->corner, clip[0]);
	accel_geometry_clip_space(&transform, origin, base);
	for (int i = 0; i < 2; i++) {
		clip_place(&transform, p->along[i], clip[1 + i]);
		for (int j = 0; j < 4; j++)
			clip[1 + i][j] -= base[j];
	}
}

static void draw_parallelogram(struct fixture *f, const struct parallelogram *p)
{
	struct coverage coverage = { SIDE, SIDE, counts, 0, 0 };
	float position[4][3];
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP,
						  .vertices = 4, .position = { .data = position });

	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 3; j++)
			position[i][j] = p->corner[j] + (i & 1 ? p->along[0][j] : 0) +
					 (i & 2 ? p->along[1][j] : 0);
	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	memset(counts, 0, sizeof(counts));
	records_of_bin(&f->draw->bin, coverage_record, &coverage);
	assert_int_equal(coverage.empty, 0);
}

static long check_parallelogram(struct fixture *f, const struct parallelogram *p, int n)
{
	long covered = 0;

	clip_corners(f, p);
	draw_parallelogram(f, p);
	for (int i = 0; i < SIDE * SIDE; i++) {
		int wanted = ray_counts(i % SIDE, i / SIDE);

		twice += counts[i] == 2 && wanted == 2;
		if (counts[i] > 2 || (wanted < 2 && counts[i] != wanted))
			fail_msg("shape %d: pixel %d,%d is drawn %d times, not %d", n, i % SIDE,
				 i / SIDE, counts[i], wanted);
		covered += counts[i];
	}
	return covered;
}

static void random_vector(uint64_t *seed, float v[3], float length)
{
	for (int i = 0; i < 3; i++)
		v[i] = (2 * test_unit(seed) - 1) * length;
}

static void random_shapes_are_drawn_where_rays_meet_them(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();
	struct accel_draw_stats stats;
	long covered = 0, shapes = 0;
	uint64_t clipped = 0;

	twice = 0;
	for (int n = 0; n < RANDOM_SHAPES; n++) {
		float size = ldexpf(1, test_between(&seed, -2, 10));
		struct parallelogram p = { .corner = { 0 } };
		long now;

		random_vector(&seed, p.corner, size);
		random_vector(&seed, p.along[0], 2 * size);
		random_vector(&seed, p.along[1], 2 * size);
		state_look(f->state, test_unit(&seed) * size);
		accel_state_set_lighting(f->state, test_below(&seed, 2));
		now = check_parallelogram(f, &p, n);
		covered += now;
		shapes += now > 0;
		accel_draw_stats(f->draw, &stats, sizeof(stats));
		clipped += stats.clipped;
	}
	print_message("%ld shapes with %ld pixels, %llu triangles clipped\n", shapes, covered,
		      (unsigned long long)clipped);
	assert_true(shapes > RANDOM_SHAPES / 8);
	assert_in_range(twice, 0, 4);
	assert_true(clipped > RANDOM_SHAPES / 8);
}

/* A floor from behind the viewer to beyond the far plane, and to all sides. */
static void a_floor_without_end_is_drawn_to_the_horizon(void **state)
{
	struct fixture *f = *state;
	const struct parallelogram p = { { -1e6f, -1, 1e6f }, { { 2e6f, 0, 0 }, { 0, 0, -2e6f } } };
	const float still[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

	accel_state_set_modelview(f->state, still);
	assert_true(check_parallelogram(f, &p, 0) > SIDE * SIDE / 3);
}

struct huge {
	struct picture picture;
	uint32_t colour[SIDE * SIDE], depth[SIDE * SIDE];
};

static void draw_floor(struct fixture *f, float size, float turn, struct huge *huge)
{
	const struct parallelogram p = { { -size, -1, size },
					 { { 2 * size, 0, 0 }, { 0, 0, -2 * size } } };
	const float c = cosf(turn), s = sinf(turn),
		    look[16] = { c,  -s * 0.28f, s * 0.96f, 0, 0, 0.96f, 0.28f, 0,
				 -s, -c * 0.28f, c * 0.96f, 0, 0, 0,     0,     1 };

	memset(huge, 0, sizeof(*huge));
	huge->picture = (struct picture){ SIDE, huge->colour, huge->depth };
	accel_state_set_modelview(f->state, look);
	draw_parallelogram(f, &p);
	records_of_bin(&f->draw->bin, picture_record, &huge->picture);
}

/* What is seen of it is the same. Single numbers end where a float does. */
static void a_floor_of_any_size_is_the_same_floor(void **state)
{
	static const float sizes[] = { 1e6f, 1e9f, 1e13f, 1e16f, 1e20f, 1e25f, 1e27f };
	static struct huge large, huge;
	static uint8_t wanted[SIDE * SIDE];
	struct fixture *f = *state;

	for (int turn = 0; turn < 12; turn++) {
		long covered = 0;

		draw_floor(f, 1e3f, 0.55f * (float)turn, &large);
		memcpy(wanted, counts, sizeof(counts));
		for (size_t i = 0; i < sizeof(sizes) / sizeof(*sizes); i++) {
			draw_floor(f, sizes[i], 0.55f * (float)turn, &huge);
			for (int at = 0; at < SIDE * SIDE; at++) {
				int64_t depth = (int64_t)huge.depth[at] - large.depth[at];

				covered += counts[at];
				if (counts[at] != wanted[at] || llabs(depth) > 64)
					fail_msg("size %g, turn %d, pixel %d: drawn %d times, not "
						 "%d, depth %lld off",
						 (double)sizes[i], turn, at, counts[at], wanted[at],
						 (long long)depth);
			}
		}
		assert_true(covered > SIDE * SIDE / 8);
	}
}

static void what_is_behind_the_viewer_or_beside_the_view_draws_nothing(void **state)
{
	struct fixture *f = *state;
	const struct parallelogram p[] = {
		{ { -1, -1, 3 }, { { 2, 0, 0 }, { 0, 2, 0 } } },
		{ { 50, -1, -5 }, { { 2, 0, 0 }, { 0, 2, 0 } } },
		{ { -1, -1, -3000 }, { { 2, 0, 0 }, { 0, 2, 0 } } },
	};
	const float still[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
	struct accel_draw_stats stats;

	accel_state_set_modelview(f->state, still);
	for (int i = 0; i < 3; i++) {
		assert_int_equal(check_parallelogram(f, &p[i], i), 0);
		accel_draw_stats(f->draw, &stats, sizeof(stats));
		assert_int_equal(stats.culled, 2);
		assert_int_equal(stats.triangles_in, 2);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(random_shapes_are_drawn_where_rays_meet_them, setup,
						fixture_free),
		cmocka_unit_test_setup_teardown(a_floor_without_end_is_drawn_to_the_horizon, setup,
						fixture_free),
		cmocka_unit_test_setup_teardown(a_floor_of_any_size_is_the_same_floor, setup,
						fixture_free),
		cmocka_unit_test_setup_teardown(
			what_is_behind_the_viewer_or_beside_the_view_draws_nothing, setup,
			fixture_free),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
