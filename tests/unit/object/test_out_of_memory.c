/* SPDX-License-Identifier: MIT */
#include "out_of_memory.h"

static void the_model_unwinds_from_every_failure(void **state)
{
	(void)state;
	fail_each_call("model:", false);
}

static void the_simulator_unwinds_from_every_failure(void **state)
{
	(void)state;
	fail_each_call("sim:tile=32,lanes=1", false);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_model_unwinds_from_every_failure),
		cmocka_unit_test(the_simulator_unwinds_from_every_failure),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
