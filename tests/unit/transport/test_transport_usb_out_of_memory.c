/* SPDX-License-Identifier: MIT */
#include "fake_usb.h"
#include "out_of_memory.h"

static void the_cable_unwinds_from_every_failure(void **state)
{
	(void)state;
	fake_usb_start(1);
	fail_each_call("usb:", true);
	fake_usb_stop();
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_cable_unwinds_from_every_failure),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
