/* SPDX-License-Identifier: MIT */
/* A program that loads the library, and lets it go while its threads run. */
#include <dlfcn.h>
#include <unistd.h>

#include "accel_test.h"

static void the_library_stays_while_a_device_is_open(void **state)
{
	int (*open_device)(const char *, accel_message_fn, void *, struct accel_device **);
	void (*free_device)(struct accel_device *);
	struct accel_device *device;
	void *library;

	(void)state;
	for (int i = 0; i < 10; i++) {
		library = dlopen(ACCEL_SO, RTLD_NOW | RTLD_LOCAL);
		if (!library)
			fail_msg("%s", dlerror());
		*(void **)&open_device = dlsym(library, "accel_device_new");
		*(void **)&free_device = dlsym(library, "accel_device_free");
		assert_int_equal(open_device("model:", NULL, NULL, &device), 0);
		assert_int_equal(dlclose(library), 0);
		usleep(2000);
		free_device(device);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_library_stays_while_a_device_is_open),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
