/* SPDX-License-Identifier: MIT */
#include "fake_gloss.h"
#include "out_of_memory.h"

static void the_kernel_module_unwinds_from_every_failure(void **state)
{
	(void)state;
	fake_gloss_start();
	fail_each_call("drm:", true);
	assert_int_equal(fake_gloss.files, 0);
	assert_int_equal(fake_gloss.left, 0);
	assert_int_equal(fake_gloss_mappings(), 0);
	fake_gloss_stop();
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_kernel_module_unwinds_from_every_failure),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
