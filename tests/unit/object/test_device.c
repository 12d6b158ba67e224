/* SPDX-License-Identifier: MIT */
#include <pthread.h>

#include "list_test.h"
#include "share_test.h"

static void the_model_says_what_it_is(void **state)
{
	struct accel_device_info info;
	struct messages messages;
	struct accel_device *device;

	(void)state;
	device = device_open("model:tile=32,memory=1048576", &messages);
	accel_device_info(device, &info, sizeof(info));
	assert_int_equal(info.tile_size, 32);
	assert_int_equal(info.memory_size, 1048576);
	assert_int_not_equal(info.pixels_per_clock, 0);
	assert_non_null(strstr(info.name, "model"));
	accel_device_free(device);

	device = device_open("model:", &messages);
	accel_device_info(device, &info, sizeof(info));
	assert_int_equal(info.tile_size, 64);
	assert_int_equal(info.memory_size, 256 << 20);
	accel_device_free(device);
	assert_int_equal(messages.count, 0);
}

static void a_board_opens_without_a_name_or_a_colon(void **state)
{
	static const char *const names[] = { NULL, "auto", "auto:", "model" };
	struct accel_device *device;
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		assert_int_equal(accel_device_new(names[i], NULL, NULL, &device), 0);
		accel_device_free(device);
	}
}

static void a_wrong_name_is_refused_and_said(void **state)
{
	static const struct {
		const char *name, *message;
	} wrong[] = {
		{ "", "no kind of device is called \"\"" },
		{ ":", "no kind of device is called \":\"" },
		{ "mode", "no kind of device is called \"mode\"" },
		{ "models:", "no kind of device is called \"models:\"" },
		{ "Model:", "no kind of device is called \"Model:\"" },
		{ "aut", "no kind of device is called \"aut\"" },
		{ "auto:tile=32", "no kind of device is called \"auto:tile=32\"" },
		{ "model:tile=48", "\"model:\": tile takes a power of two from 32 to 64" },
		{ "model:lanes=4", "\"model:\": no option \"lanes=4\"" },
		{ "model:memory=4097", "\"model:\": memory takes a multiple of 4096" },
		{ "model:memory=0", "\"model:\": memory takes a multiple of 4096" },
		{ "model:memory=4294971392", "\"model:\": memory takes a multiple of 4096" },
		{ "model:threads=0", "\"model:\": threads takes a number from 1 to 64" },
		{ "model:threads=65", "\"model:\": threads takes a number from 1 to 64" },
		{ "sim:lanes=3", "\"sim:\": lanes takes a power of two from 1 to 8" },
		{ "sim:stalls=x", "\"sim:\": stalls takes" },
	};
	struct messages messages = { "", 0 };
	struct accel_device *device = NULL;
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_int_equal(accel_device_new(wrong[i].name, messages_take, &messages, &device),
				 -EINVAL);
		assert_null(device);
		assert_message(&messages, wrong[i].message);
		assert_int_equal(messages.count, (int)i + 1);
		assert_int_equal(accel_device_new(wrong[i].name, NULL, NULL, &device), -EINVAL);
	}
}

static void the_model_counts_no_clocks(void **state)
{
	struct accel_device_clocks clocks;
	struct messages messages;
	struct accel_device *device;

	(void)state;
	device = device_open("model:", &messages);
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks)), -ENOTSUP);
	accel_device_free(device);
}

static void model_and_simulator_are_in_the_list(void **state)
{
	struct listed listed = { .kind = "" };

	(void)state;
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_true(listed.count >= 2);
	assert_non_null(strstr(listed.text, "model:|C model, in this process\n"));
	assert_non_null(strstr(listed.text, "sim:|"));
}

static void list_use(void *data, const char *name, const char *line)
{
	struct accel_device *device;

	(void)line;
	if (strcmp(name, "model:") != 0)
		return;
	assert_int_equal(accel_device_new(name, NULL, NULL, &device), 0);
	accel_device_free(device);
	++*(int *)data;
}

static void a_listed_device_can_be_opened_at_once(void **state)
{
	int opened = 0;

	(void)state;
	assert_int_equal(accel_device_list(list_use, &opened), 0);
	assert_int_equal(opened, 1);
}

static void free_takes_null(void **state)
{
	(void)state;
	accel_device_free(NULL);
	accel_buffer_free(NULL);
	accel_target_free(NULL);
	accel_state_free(NULL);
	accel_stream_free(NULL);
	accel_fence_free(NULL);
}

static void objects_outlive_the_name_of_their_device(void **state)
{
	struct accel_stream *stream;
	struct accel_target *target;
	struct accel_buffer *buffer;
	struct messages messages;
	struct accel_device *device;
	uint32_t word = 7;

	(void)state;
	device = device_open("model:memory=1048576", &messages);
	assert_int_equal(accel_buffer_new(device, 4096, &buffer), 0);
	assert_int_equal(accel_target_new(device, 10, 10, &target), 0);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	accel_device_free(device);
	assert_int_equal(accel_buffer_write(buffer, 0, &word, 4), 0);
	accel_target_free(target);
	accel_stream_free(stream);
	assert_int_equal(accel_buffer_read(buffer, 0, &word, 4), 0);
	assert_int_equal(word, 7);
	accel_buffer_free(buffer);
}

/* What the library is called back with may go on to use it. */
static void use_the_device(void *data, const char *line)
{
	struct accel_device **device = data;
	struct accel_buffer *buffer;

	(void)line;
	if (!*device)
		return;
	assert_int_equal(accel_buffer_new(*device, 64, &buffer), 0);
	accel_buffer_free(buffer);
}

static void a_message_function_may_call_the_library(void **state)
{
	const uint32_t unknown = 0xff000000;
	struct accel_device *device = NULL;
	struct accel_stream *stream;
	struct accel_buffer *buffer;

	(void)state;
	assert_int_equal(accel_device_new("model:", use_the_device, &device, &device), 0);
	assert_int_equal(accel_buffer_new(device, 3, &buffer), -EINVAL);
	assert_int_equal(accel_buffer_new(device, 1u << 31, &buffer), -ENOMEM);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_stream_emit(stream, &unknown, 1), 0);
	assert_int_equal(accel_stream_finish(stream, NULL, 0), -EIO);
	accel_stream_free(stream);
	accel_device_free(device);
}

static void threads_share_a_device(void **state)
{
	(void)state;
	share_check("model:memory=65536");
}

static void *use_own_device(void *data)
{
	struct accel_device *device;
	void *wrong;

	(void)data;
	if (accel_device_new("model:memory=65536", NULL, NULL, &device))
		return "no device";
	wrong = share_device(device);
	accel_device_free(device);
	return wrong;
}

static void threads_have_devices_of_their_own(void **state)
{
	(void)state;
	share_run(use_own_device, NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_model_says_what_it_is),
		cmocka_unit_test(a_board_opens_without_a_name_or_a_colon),
		cmocka_unit_test(a_wrong_name_is_refused_and_said),
		cmocka_unit_test(the_model_counts_no_clocks),
		cmocka_unit_test(model_and_simulator_are_in_the_list),
		cmocka_unit_test(a_listed_device_can_be_opened_at_once),
		cmocka_unit_test(free_takes_null),
		cmocka_unit_test(objects_outlive_the_name_of_their_device),
		cmocka_unit_test(a_message_function_may_call_the_library),
		cmocka_unit_test(threads_share_a_device),
		cmocka_unit_test(threads_have_devices_of_their_own),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
