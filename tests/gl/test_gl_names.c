// SPDX-License-Identifier: MIT
/* The table of objects by their names, against an array of all names. */
#include "accel_test.h"
#include "draw/names.h"

#define NAMES 500u
#define STEPS 20000

static int objects[NAMES];

static void names_are_what_was_set(void **state)
{
	struct gloss_names names = { .places = 0 };
	void *expected[NAMES] = { NULL };
	uint64_t seed = test_seed();
	uint32_t live = 0;

	(void)state;
	for (int step = 0; step < STEPS; step++) {
		uint32_t name = test_below(&seed, NAMES);
		void *object = name && test_below(&seed, 2) ? &objects[name] : NULL;

		assert_true(gloss_names_set(&names, name, object));
		live += (uint32_t)(object != NULL) - (uint32_t)(expected[name] != NULL);
		expected[name] = object;
		name = test_below(&seed, NAMES);
		assert_ptr_equal(gloss_names_find(&names, name), expected[name]);
		assert_int_equal(names.live, live);
	}
	free(names.place);
}

/* As a program does that makes a list each frame. */
static void a_table_of_few_names_stays_small(void **state)
{
	struct gloss_names names = { .places = 0 };

	(void)state;
	for (uint32_t name = 1; name < 100000; name++) {
		assert_true(gloss_names_set(&names, name, &objects[0]));
		assert_true(gloss_names_set(&names, name, NULL));
	}
	assert_int_equal(names.places, 64);
	free(names.place);
}

static void names_that_are_free_come_in_a_row(void **state)
{
	struct gloss_names names = { .places = 0 };

	(void)state;
	assert_int_equal(gloss_names_free_range(&names, 3), 1);
	assert_true(gloss_names_set(&names, 7, &objects[0]));
	assert_int_equal(gloss_names_free_range(&names, 3), 8);
	assert_true(gloss_names_set(&names, UINT32_MAX, &objects[0]));
	assert_int_equal(gloss_names_free_range(&names, 3), 1);
	assert_int_equal(gloss_names_free_range(&names, 7), 8);
	free(names.place);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(names_are_what_was_set),
		cmocka_unit_test(a_table_of_few_names_stays_small),
		cmocka_unit_test(names_that_are_free_come_in_a_row),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
