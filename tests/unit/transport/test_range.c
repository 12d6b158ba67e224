/* SPDX-License-Identifier: MIT */
#include "accel_test.h"
#include "transport/range.h"

#define PAGE 4096u
#define SPACE (64u * PAGE)

static int setup(void **state)
{
	static struct accel_range_space space;

	accel_range_init(&space, SPACE);
	*state = &space;
	return 0;
}

static int teardown(void **state)
{
	accel_range_fini(*state);
	return 0;
}

static void the_whole_space_is_one_range(void **state)
{
	uint64_t base;

	assert_int_equal(accel_range_new(*state, SPACE, &base), 0);
	assert_int_equal(base, 0);
	assert_int_equal(accel_range_new(*state, 1, &base), -ENOMEM);
}

static void more_than_the_space_is_refused(void **state)
{
	uint64_t base;

	assert_int_equal(accel_range_new(*state, SPACE + 1, &base), -ENOMEM);
	assert_int_equal(accel_range_new(*state, UINT64_MAX, &base), -ENOMEM);
}

static void a_freed_gap_is_found_again(void **state)
{
	uint64_t first, second, third, again;

	assert_int_equal(accel_range_new(*state, PAGE, &first), 0);
	assert_int_equal(accel_range_new(*state, 3 * PAGE, &second), 0);
	assert_int_equal(accel_range_new(*state, 1, &third), 0);
	assert_int_equal(accel_range_free(*state, second), 0);
	assert_int_equal(accel_range_new(*state, 3 * PAGE + 1, &again), 0);
	assert_true(again > third);
	assert_int_equal(accel_range_new(*state, 3 * PAGE, &again), 0);
	assert_int_equal(again, second);
}

static void only_a_base_names_a_range(void **state)
{
	uint64_t base;

	assert_int_equal(accel_range_new(*state, 2 * PAGE, &base), 0);
	assert_null(accel_range_find(*state, base + PAGE));
	assert_int_equal(accel_range_free(*state, base + PAGE), -EINVAL);
	assert_int_equal(accel_range_find(*state, base)->size, 2 * PAGE);
	assert_int_equal(accel_range_free(*state, base), 0);
	assert_int_equal(accel_range_free(*state, base), -EINVAL);
}

/* Owner of each page; a range may not take a page that has one. */
static void own(unsigned char *owner, uint64_t base, uint64_t size, unsigned char from,
		unsigned char to)
{
	uint64_t page;

	for (page = base / PAGE; page <= (base + size - 1) / PAGE; page++) {
		assert_int_equal(owner[page], from);
		owner[page] = to;
	}
}

static void random_ranges_never_overlap(void **state)
{
	unsigned char owner[SPACE / PAGE] = { 0 };
	struct {
		uint64_t base, size;
	} range[16] = { { 0, 0 } };
	uint64_t seed = test_seed();
	int i;

	for (i = 0; i < 20000; i++) {
		unsigned int at = test_below(&seed, 16);

		if (range[at].size) {
			own(owner, range[at].base, range[at].size, (unsigned char)(at + 1), 0);
			assert_int_equal(accel_range_free(*state, range[at].base), 0);
			range[at].size = 0;
			continue;
		}
		range[at].size = 1 + test_below(&seed, 12 * PAGE);
		if (accel_range_new(*state, range[at].size, &range[at].base)) {
			range[at].size = 0;
			continue;
		}
		assert_int_equal(range[at].base % PAGE, 0);
		assert_true(range[at].base + range[at].size <= SPACE);
		own(owner, range[at].base, range[at].size, 0, (unsigned char)(at + 1));
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(the_whole_space_is_one_range, setup, teardown),
		cmocka_unit_test_setup_teardown(more_than_the_space_is_refused, setup, teardown),
		cmocka_unit_test_setup_teardown(a_freed_gap_is_found_again, setup, teardown),
		cmocka_unit_test_setup_teardown(only_a_base_names_a_range, setup, teardown),
		cmocka_unit_test_setup_teardown(random_ranges_never_overlap, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
