/* SPDX-License-Identifier: MIT */
/*
 * Each error that accel.h promises, and a call that answers it: the table at the end.
 * test_errors.sh compares its rows with the comments of accel.h.
 */
#define _GNU_SOURCE
#include <math.h>

#include "transport/usb_test.h"

static struct messages messages;
static struct accel_device *device;
static struct accel_buffer *buffer;
static struct accel_target *target;
static struct accel_state *state_of_all;
static struct accel_draw *draw;
static struct accel_stream *stream;

static const float corner[3][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 } };
static const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						 .vertices = 3, .position = { .data = corner });

/* ---- what goes wrong ---- */

/* The next job. */
static void fail_board(void)
{
	fake_usb_arm(0, FAKE_USB_STALL_OUT, 1, 0);
}

static void unplug(void)
{
	fake_usb_unplug(0);
}

static void refuse_memory(void)
{
	fake_usb_limit_memory(1);
}

/* Halves, quarters and so on: fewer than there are slots. */
static void fill_memory(void)
{
	struct accel_buffer *rest;
	uint64_t size = FAKE_USB_BOARD_BYTES;

	for (; size >= 4096; size /= 2)
		while (!accel_buffer_new(device, size, &rest)) {
			/* The stream keeps it. */
			assert_in_range(accel_stream_slot(stream, rest, ACCEL_SLOT_READ), 0, 15);
			accel_buffer_free(rest);
		}
}

/* ---- devices ---- */

static int open_name(const char *name)
{
	struct accel_device *another;
	int err = accel_device_new(name, messages_take, &messages, &another);

	if (!err)
		accel_device_free(another);
	return err;
}

static int open_no_board(void)
{
	return open_name("usb:/NONE");
}

static int open_without_its_support(void)
{
	setenv("GLOSS_SIM_PATH", "/nonexistent", 1);
	return open_name("sim:tile=32,lanes=2");
}

static int open_without_permission(void)
{
	fake_usb.board[0].open_error = LIBUSB_ERROR_ACCESS;
	return open_name("usb:");
}

static int open_twice(void)
{
	return open_name("usb:");
}

static int open_no_name(void)
{
	return open_name("model:tile=33");
}

static int open_without_memory(void)
{
	fake_usb_fail("libusb_init", 1, LIBUSB_ERROR_NO_MEM);
	return open_name("usb:");
}

static void found(void *data, const char *name, const char *line)
{
	(void)data;
	(void)name;
	(void)line;
}

static int list_without_memory(void)
{
	fake_usb_fail("libusb_init", 1, LIBUSB_ERROR_NO_MEM);
	return accel_device_list(found, NULL);
}

static int clocks(void)
{
	struct accel_device_clocks sum;

	return accel_device_clocks(device, &sum, sizeof(sum));
}

static int clocks_of_a_model(void)
{
	assert_int_equal(accel_stream_finish(stream, NULL, 0), 0);
	return clocks();
}

static int clocks_of_a_board_that_does_not_answer(void)
{
	fake_usb_fail("libusb_control_transfer", 1, LIBUSB_ERROR_PIPE);
	return clocks();
}

static int clocks_of_no_board(void)
{
	unplug();
	return clocks();
}

/* ---- buffers and targets ---- */

static int new_buffer(uint64_t size)
{
	struct accel_buffer *another;

	return accel_buffer_new(device, size, &another);
}

static int buffer_of_three_bytes(void)
{
	return new_buffer(3);
}

static int buffer_in_full_memory(void)
{
	fill_memory();
	return new_buffer(4096);
}

static int write_word(void)
{
	uint32_t word = 1;

	return accel_buffer_write(buffer, 0, &word, 4);
}

static int write_behind_the_end(void)
{
	uint32_t word = 1;

	return accel_buffer_write(buffer, 4096, &word, 4);
}

static int write_to_a_board_that_fails(void)
{
	fail_board();
	return write_word();
}

static int write_to_no_board(void)
{
	unplug();
	return write_word();
}

static int read_word(void)
{
	uint32_t word;

	return accel_buffer_read(buffer, 0, &word, 4);
}

static int read_half_a_word(void)
{
	uint32_t word;

	return accel_buffer_read(buffer, 0, &word, 2);
}

static int read_of_a_board_that_fails(void)
{
	fail_board();
	return read_word();
}

static int read_of_no_board(void)
{
	unplug();
	return read_word();
}

static int new_target(int width, int height)
{
	struct accel_target *another;

	return accel_target_new(device, width, height, &another);
}

static int target_of_no_height(void)
{
	return new_target(1, 0);
}

static int target_in_full_memory(void)
{
	fill_memory();
	return new_target(1, 1);
}

static uint32_t pixels[64 * 64];

static int colour_with_a_short_pitch(void)
{
	return accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 4);
}

static int colour_of_a_board_that_fails(void)
{
	fail_board();
	return accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 256);
}

static int colour_of_no_board(void)
{
	unplug();
	return accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 256);
}

static int depth_with_an_odd_pitch(void)
{
	return accel_target_read(target, ACCEL_PLANE_DEPTH, NULL, pixels, 258);
}

static int depth_of_a_board_that_fails(void)
{
	fail_board();
	return accel_target_read(target, ACCEL_PLANE_DEPTH, NULL, pixels, 256);
}

static int depth_of_no_board(void)
{
	unplug();
	return accel_target_read(target, ACCEL_PLANE_DEPTH, NULL, pixels, 256);
}

/* ---- state ---- */

static int ambient_of_nothing(void)
{
	const float rgba[4] = { 0, NAN, 0, 1 };

	return accel_state_set_ambient(state_of_all, rgba);
}

static int material_too_shiny(void)
{
	return accel_state_set_material(state_of_all,
					&(struct accel_material)ACCEL_MATERIAL(.shininess = 1001),
					NULL);
}

static int light_number_eight(void)
{
	return accel_state_set_light(state_of_all, 8,
				     &(struct accel_light)ACCEL_LIGHT(.enabled = false));
}

static int material_of_a_later_version(void)
{
	struct {
		struct accel_material now;
		uint64_t later;
	} material = { ACCEL_MATERIAL(), 1 };

	material.now.size = sizeof(material);
	return accel_state_set_material(state_of_all, &material.now, NULL);
}

static int light_of_a_later_version(void)
{
	struct {
		struct accel_light now;
		uint64_t later;
	} light = { ACCEL_LIGHT(), 1 };

	light.now.size = sizeof(light);
	return accel_state_set_light(state_of_all, 0, &light.now);
}

/* ---- draws ---- */

static int draw_mesh(void)
{
	assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
	return accel_draw_mesh(draw, state_of_all, &mesh);
}

static int begin_and(const struct accel_clear *clear)
{
	return accel_draw_begin(draw, target, clear);
}

static int begin_with_a_clear_of_what_is_not_there(void)
{
	static const struct accel_clear odd = ACCEL_CLEAR(.mask = 4);

	return begin_and(&odd);
}

/* A clear of a later version. */
static const struct {
	struct accel_clear now;
	uint64_t later;
} later_clear = { { .size = sizeof(later_clear), .mask = ACCEL_CLEAR_DEPTH }, 1 };

static int begin_with_a_clear_of_a_later_version(void)
{
	return begin_and(&later_clear.now);
}

static int clear_before_a_frame(void)
{
	static const struct accel_clear depth = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH);

	return accel_draw_clear(draw, &depth);
}

static int clear_of_a_later_version(void)
{
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_clear(draw, &later_clear.now);
}

static int mesh_without_positions(void)
{
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_mesh(draw, state_of_all,
			       &(struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
							      .vertices = 3));
}

static int mesh_of_a_later_version(void)
{
	struct {
		struct accel_mesh now;
		uint64_t later;
	} later = { mesh, 1 };

	later.now.size = sizeof(later);
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_mesh(draw, state_of_all, &later.now);
}

static int submit_draw(void)
{
	return accel_draw_submit(draw, NULL);
}

static int finish_draw(void)
{
	return accel_draw_finish(draw);
}

static int finish_a_frame_on_a_board_that_fails(void)
{
	assert_int_equal(draw_mesh(), 0);
	fail_board();
	return finish_draw();
}

static int submit_a_frame_to_no_board(void)
{
	assert_int_equal(draw_mesh(), 0);
	unplug();
	/* The board is missed when it is to do something. */
	assert_int_equal(accel_stream_finish(stream, NULL, 0), -ENODEV);
	return submit_draw();
}

static int finish_a_frame_on_no_board(void)
{
	assert_int_equal(draw_mesh(), 0);
	unplug();
	return finish_draw();
}

static int finish_a_frame_without_memory(void)
{
	assert_int_equal(draw_mesh(), 0);
	refuse_memory();
	return finish_draw();
}

/* ---- streams and fences ---- */

static int stream_too_long(void)
{
	return accel_stream_emit(stream, pixels, ACCEL_STREAM_WORDS_MAX + 1ull);
}

static int slot_number_sixteen(void)
{
	struct accel_buffer *another;
	int slot = 0;

	for (int n = 0; n < 17 && slot >= 0; n++) {
		assert_int_equal(accel_buffer_new(device, 4, &another), 0);
		slot = accel_stream_slot(stream, another, ACCEL_SLOT_READ);
		accel_buffer_free(another);
	}
	return slot;
}

static int slot_without_rights(void)
{
	return accel_stream_slot(stream, buffer, 0);
}

static int submit_stream(void)
{
	return accel_stream_submit(stream, NULL, 0, NULL);
}

static int finish_stream(void)
{
	return accel_stream_finish(stream, NULL, 0);
}

static int response_without_a_fence(void)
{
	return accel_stream_submit(stream, pixels, 1, NULL);
}

static int response_to_nowhere(void)
{
	return accel_stream_finish(stream, NULL, 1);
}

static void emit_a_fault(void)
{
	const uint32_t unknown = 0xff000000;

	assert_int_equal(accel_stream_emit(stream, &unknown, 1), 0);
}

static int finish_a_job_with_a_fault(void)
{
	emit_a_fault();
	return finish_stream();
}

/* The board is missed when it is to do something. */
static int submit_to_no_board(void)
{
	unplug();
	assert_int_equal(finish_stream(), -ENODEV);
	return submit_stream();
}

static int finish_a_job_on_no_board(void)
{
	unplug();
	return finish_stream();
}

static int finish_a_job_without_memory(void)
{
	refuse_memory();
	return finish_stream();
}

static int finish_after_a_fault(void)
{
	emit_a_fault();
	assert_int_equal(submit_stream(), 0);
	return accel_device_finish(device);
}

static int finish_without_a_board(void)
{
	unplug();
	return accel_device_finish(device);
}

static int finish_without_memory(void)
{
	refuse_memory();
	return accel_device_finish(device);
}

/* What the fence of a job answers, which is then freed. */
static int wait_of(int64_t timeout_ns)
{
	struct accel_fence *fence;
	int err;

	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	err = accel_fence_wait(fence, timeout_ns, NULL, 0);
	fake_usb_release();
	accel_fence_free(fence);
	return err;
}

static int wait_for_a_job_that_runs(void)
{
	fake_usb_hold();
	return wait_of(0);
}

static int wait_on_a_board_that_fails(void)
{
	fail_board();
	return wait_of(-1);
}

static int wait_on_no_board(void)
{
	struct accel_fence *fence;
	int err;

	fake_usb_hold();
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	unplug();
	err = accel_fence_wait(fence, -1, NULL, 0);
	accel_fence_free(fence);
	return err;
}

static int wait_without_memory(void)
{
	refuse_memory();
	return wait_of(-1);
}

/* A fence of a job that has ended. */
static int fence_fd(void)
{
	struct accel_fence *fence;
	int fd;

	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	fd = accel_fence_fd(fence);
	accel_fence_free(fence);
	return fd;
}

/* ---- the table ---- */

static const struct reached {
	const char *function;
	int err;
	int (*call)(void);
} table[] = {
	{ "accel_device_list", -ENOMEM, list_without_memory },
	{ "accel_device_new", -ENODEV, open_no_board },
	{ "accel_device_new", -ENOSYS, open_without_its_support },
	{ "accel_device_new", -EACCES, open_without_permission },
	{ "accel_device_new", -EBUSY, open_twice },
	{ "accel_device_new", -EINVAL, open_no_name },
	{ "accel_device_new", -ENOMEM, open_without_memory },
	{ "accel_device_new", -EIO, write_to_a_board_that_fails }, /* what it says of jobs */
	{ "accel_device_clocks", -ENOTSUP, clocks_of_a_model },
	{ "accel_device_clocks", -EIO, clocks_of_a_board_that_does_not_answer },
	{ "accel_device_clocks", -ENODEV, clocks_of_no_board },
	{ "accel_device_finish", -EIO, finish_after_a_fault },
	{ "accel_device_finish", -ENODEV, finish_without_a_board },
	{ "accel_device_finish", -ENOMEM, finish_without_memory },
	{ "accel_buffer_new", -EINVAL, buffer_of_three_bytes },
	{ "accel_buffer_new", -ENOMEM, buffer_in_full_memory },
	{ "accel_buffer_write", -EINVAL, write_behind_the_end },
	{ "accel_buffer_write", -EIO, write_to_a_board_that_fails },
	{ "accel_buffer_write", -ENODEV, write_to_no_board },
	{ "accel_buffer_read", -EINVAL, read_half_a_word },
	{ "accel_buffer_read", -EIO, read_of_a_board_that_fails },
	{ "accel_buffer_read", -ENODEV, read_of_no_board },
	{ "accel_target_new", -EINVAL, target_of_no_height },
	{ "accel_target_new", -ENOMEM, target_in_full_memory },
	{ "accel_target_read", -EINVAL, colour_with_a_short_pitch },
	{ "accel_target_read", -EIO, colour_of_a_board_that_fails },
	{ "accel_target_read", -ENODEV, colour_of_no_board },
	{ "accel_target_read", -EINVAL, depth_with_an_odd_pitch },
	{ "accel_target_read", -EIO, depth_of_a_board_that_fails },
	{ "accel_target_read", -ENODEV, depth_of_no_board },
	{ "accel_state_set_ambient", -EINVAL, ambient_of_nothing },
	{ "accel_state_set_material", -EINVAL, material_too_shiny },
	{ "accel_state_set_light", -EINVAL, light_number_eight },
	{ "accel_state_set_material", -E2BIG, material_of_a_later_version },
	{ "accel_state_set_light", -E2BIG, light_of_a_later_version },
	{ "accel_draw_begin", -EINVAL, begin_with_a_clear_of_what_is_not_there },
	{ "accel_draw_begin", -E2BIG, begin_with_a_clear_of_a_later_version },
	{ "accel_draw_clear", -EINVAL, clear_before_a_frame },
	{ "accel_draw_clear", -E2BIG, clear_of_a_later_version },
	{ "accel_draw_mesh", -EINVAL, mesh_without_positions },
	{ "accel_draw_mesh", -E2BIG, mesh_of_a_later_version },
	{ "accel_draw_submit", -EINVAL, submit_draw },
	{ "accel_draw_submit", -ENODEV, submit_a_frame_to_no_board },
	{ "accel_draw_finish", -EINVAL, finish_draw },
	{ "accel_draw_finish", -EIO, finish_a_frame_on_a_board_that_fails },
	{ "accel_draw_finish", -ENODEV, finish_a_frame_on_no_board },
	{ "accel_draw_finish", -ENOMEM, finish_a_frame_without_memory },
	{ "accel_stream_emit", -E2BIG, stream_too_long },
	{ "accel_stream_slot", -ENOSPC, slot_number_sixteen },
	{ "accel_stream_slot", -EINVAL, slot_without_rights },
	{ "accel_stream_submit", -EINVAL, response_without_a_fence },
	{ "accel_stream_submit", -ENODEV, submit_to_no_board },
	{ "accel_stream_finish", -EINVAL, response_to_nowhere },
	{ "accel_stream_finish", -EIO, finish_a_job_with_a_fault },
	{ "accel_stream_finish", -ENODEV, finish_a_job_on_no_board },
	{ "accel_stream_finish", -ENOMEM, finish_a_job_without_memory },
	{ "accel_fence_wait", -ETIMEDOUT, wait_for_a_job_that_runs },
	{ "accel_fence_wait", -EIO, wait_on_a_board_that_fails },
	{ "accel_fence_wait", -ENODEV, wait_on_no_board },
	{ "accel_fence_wait", -ENOMEM, wait_without_memory },
	{ "accel_fence_fd", -ENOTSUP, fence_fd },
};

/* Reached in other programs, as it takes memory of the program's own that runs out, or a driver:
 * accel_fence_wait -ETIME: test_transport_drm.c
 * accel_fence_fd -EMFILE: test_transport_drm.c
 * accel_fence_fd -EIO: test_transport_drm.c
 * accel_fence_fd -ENODEV: test_transport_drm.c
 * accel_device_finish -ETIME: test_transport_drm.c
 * accel_stream_submit -EIO: test_transport_drm.c
 * accel_stream_finish -ETIME: test_transport_drm.c
 * accel_draw_submit -EIO: test_transport_drm.c
 * accel_draw_submit -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_finish -ETIME: test_transport_drm.c
 * accel_draw_begin -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_clear -ENOMEM: test_draw_out_of_memory.c
 * accel_draw_mesh -ENOMEM: test_draw_out_of_memory.c */

/* Memory is cleared for the first job that uses it, by jobs of their own: a fault is not to hit those. */
static void use_all(void)
{
	uint32_t word = 0;

	assert_int_equal(accel_buffer_write(buffer, 0, &word, 4), 0);
	for (enum accel_plane plane = ACCEL_PLANE_COLOUR; plane <= ACCEL_PLANE_DEPTH; plane++)
		assert_int_equal(accel_target_read(target, plane, NULL, pixels, 256), 0);
}

static void begin(void)
{
	fake_usb_start(1);
	device = device_open("usb:", &messages);
	assert_int_equal(accel_buffer_new(device, 4096, &buffer), 0);
	assert_int_equal(accel_target_new(device, 64, 64, &target), 0);
	assert_int_equal(accel_state_new(&state_of_all), 0);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	use_all();
}

static void end(void)
{
	fake_usb_disarm();
	fake_usb_limit_memory(0);
	fake_usb_release();
	accel_stream_free(stream);
	accel_draw_free(draw);
	accel_state_free(state_of_all);
	accel_target_free(target);
	accel_buffer_free(buffer);
	accel_device_free(device);
	fake_usb_stop();
}

static void each_error_of_the_header_is_reached(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
		int err;

		begin();
		err = table[i].call();
		if (err != table[i].err)
			fail_msg("%s: row %zu answers %s, not %s", table[i].function, i,
				 strerrorname_np(-err), strerrorname_np(-table[i].err));
		end();
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_error_of_the_header_is_reached),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
