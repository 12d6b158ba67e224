/* SPDX-License-Identifier: MIT */
/* Each error that accel.h promises is reached: see errors.h. */
#define _GNU_SOURCE
#include "errors.h"

/*
 * Reached in other programs, as it takes memory of the program's own that runs out, or a driver:
 * accel_fence_wait -ETIME: test_transport_drm_library.c
 * accel_fence_fd -EMFILE: test_transport_drm_library.c
 * accel_fence_fd -EIO: test_transport_drm_library.c
 * accel_fence_fd -ENODEV: test_transport_drm_library.c
 * accel_device_finish -ETIME: test_transport_drm_library.c
 * accel_stream_submit -EIO: test_transport_drm_library.c
 * accel_stream_finish -ETIME: test_transport_drm_library.c
 * accel_draw_submit -EIO: test_transport_drm_library.c
 * accel_draw_submit -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_finish -ETIME: test_transport_drm_library.c
 * accel_draw_begin -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_clear -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_clear_masked -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_rectangles -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_mesh -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_arrays -ENOMEM: test_draw_out_of_memory.c
 */

struct fixture test;

/* Memory is cleared for the first job that uses it, by jobs of their own: a fault is not to hit those. */
static void use_all(void)
{
	uint32_t word = 0;

	assert_int_equal(accel_buffer_write(test.buffer, 0, &word, 4), 0);
	for (enum accel_plane plane = ACCEL_PLANE_COLOUR; plane <= ACCEL_PLANE_DEPTH; plane++)
		assert_int_equal(accel_target_read(test.target, plane, NULL, test.pixels, 256), 0);
}

static void begin(void)
{
	fake_usb_start(1);
	test.device = device_open("usb:", &test.messages);
	assert_int_equal(accel_buffer_new(test.device, 4096, &test.buffer), 0);
	assert_int_equal(accel_target_new(test.device, 64, 64, &test.target), 0);
	assert_int_equal(accel_state_new(&test.state), 0);
	assert_int_equal(accel_draw_new(test.device, &test.draw), 0);
	assert_int_equal(accel_stream_new(test.device, &test.stream), 0);
	use_all();
}

static void end(void)
{
	fake_usb_disarm();
	fake_usb_limit_memory(0);
	fake_usb_release();
	accel_stream_free(test.stream);
	accel_draw_free(test.draw);
	accel_state_free(test.state);
	accel_target_free(test.target);
	accel_buffer_free(test.buffer);
	accel_device_free(test.device);
	fake_usb_stop();
}

static void check_table(const struct reached *table)
{
	for (const struct reached *row = table; row->function; row++) {
		int err;

		begin();
		err = row->call();
		if (err != row->err)
			fail_msg("%s: row %td answers %s, not %s", row->function, row - table,
				 strerrorname_np(-err), strerrorname_np(-row->err));
		end();
	}
}

static void each_error_of_the_header_is_reached(void **state)
{
	(void)state;
	check_table(errors_device);
	check_table(errors_memory);
	check_table(errors_draw);
	check_table(errors_stream);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_error_of_the_header_is_reached),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
