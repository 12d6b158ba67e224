/* SPDX-License-Identifier: MIT */
/* How "sim:" finds its plugin and lives with what it does; on plugins without a core. */
#include <unistd.h>

#include "accel_test.h"
#include "sim/sim.h"

static struct messages messages;

static int open_name(const char *name, struct accel_device **device)
{
	messages = (struct messages){ "", 0 };
	return accel_device_new(name, messages_take, &messages, device);
}

static int setup(void **state)
{
	(void)state;
	return setenv("GLOSS_SIM_PATH", getenv("FAKE_SIM_PATH"), 1);
}

static void a_missing_plugin_is_named_with_where_it_was_looked_for(void **state)
{
	struct accel_device *device;

	(void)state;
	setenv("GLOSS_SIM_PATH", "/nonexistent", 1);
	assert_int_equal(open_name("sim:tile=32,lanes=1", &device), -ENOSYS);
	assert_message(&messages, "accel-sim-t32-k1.so is not installed");
	assert_message(&messages, "$GLOSS_SIM_PATH");
	unsetenv("GLOSS_SIM_PATH");
	assert_int_equal(open_name("sim:tile=32,lanes=1", &device), -ENOSYS);
}

static void a_plugin_that_does_not_fit_is_refused(void **state)
{
	static const struct {
		const char *name, *message;
	} wrong[] = {
		{ "sim:lanes=2", "accel-sim-t64-k2.so is no simulator of this version" },
		{ "sim:lanes=4", "accel-sim-t64-k4.so is no simulator of this version" },
		{ "sim:lanes=8", "accel-sim-t64-k8.so is no simulator of this version" },
		{ "sim:tile=32,lanes=2", "accel-sim-t32-k2.so is no simulator of this version" },
		{ "sim:tile=32,lanes=4", "accel-sim-t32-k4.so" },
	};
	struct accel_device *device;
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_int_equal(open_name(wrong[i].name, &device), -ENOSYS);
		assert_message(&messages, wrong[i].message);
	}
}

static void a_plugin_out_of_memory_does_not_open(void **state)
{
	struct accel_device *device;

	(void)state;
	assert_int_equal(open_name("sim:lanes=1,memory=8192", &device), -ENOMEM);
}

/* A job of a word, and a packet that takes long or not. */
static int run(struct accel_device *device, uint32_t word, uint32_t packet, uint32_t response[2])
{
	const uint32_t words[] = { word, packet, 0, 0 };
	struct accel_stream *stream;
	int err;

	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_stream_emit(stream, words, 4), 0);
	err = accel_stream_finish(stream, response, 2);
	accel_stream_free(stream);
	return err;
}

static void options_reach_the_core(void **state)
{
	struct accel_device_info info;
	struct accel_device *device;
	uint32_t response[2];

	(void)state;
	assert_int_equal(open_name("sim:lanes=1,stalls=77,memory=16384", &device), 0);
	accel_device_info(device, &info, sizeof(info));
	assert_int_equal(info.tile_size, 64);
	assert_int_equal(info.pixels_per_clock, 1);
	assert_int_equal(info.memory_size, 16384);
	assert_int_equal(run(device, 0, 0, response), 0);
	assert_int_equal(response[1], 77);
	accel_device_free(device);
}

static void a_job_may_take_as_long_as_its_packets(void **state)
{
	static const struct {
		uint32_t packet, clocks;
	} packets[] = {
		{ (uint32_t)GLOSS_OP_TRIANGLE << 24 | 2, 64 * 64 },
		{ (uint32_t)GLOSS_OP_TILE_BEGIN << 24 | 2, 2 * 64 * 64 },
		{ (uint32_t)GLOSS_OP_TILE_END << 24 | 2, 2 * 64 * 64 },
		/* its payload is one past the stream's end */
		{ (uint32_t)GLOSS_OP_TRIANGLE << 24 | 3, 64 * 64 },
	};
	struct accel_device *device;
	uint32_t least[2], response[2];
	size_t i;

	(void)state;
	assert_int_equal(open_name("sim:lanes=1", &device), 0);
	assert_int_equal(run(device, 0, 0, least), 0);
	for (i = 0; i < sizeof(packets) / sizeof(packets[0]); i++) {
		assert_int_equal(run(device, 0, packets[i].packet, response), 0);
		assert_true(response[0] >= least[0] + packets[i].clocks);
	}
	accel_device_free(device);
}

static void a_core_that_hangs_or_breaks_a_rule_fails_its_job_only(void **state)
{
	static const int errors[] = { ETIME, EPROTO, ENOMEM };
	struct accel_device *device;
	uint32_t response[2];
	size_t i;

	(void)state;
	assert_int_equal(open_name("sim:lanes=1", &device), 0);
	for (i = 0; i < sizeof(errors) / sizeof(errors[0]); i++) {
		assert_int_equal(run(device, (uint32_t)errors[i], 0, response), -EIO);
		assert_message(&messages, "the board failed and was reset");
		assert_int_equal(run(device, 0, 0, response), 0);
	}
	accel_device_free(device);
}

static void clocks_add_up_over_jobs_that_ended(void **state)
{
	struct accel_device_clocks clocks;
	struct accel_device *device;
	uint32_t response[2];

	(void)state;
	assert_int_equal(open_name("sim:lanes=1", &device), 0);
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks)), 0);
	assert_int_equal(clocks.clocks, 0);
	assert_int_equal(run(device, 0, 0, response), 0);
	assert_int_equal(run(device, ETIME, 0, response), -EIO);
	assert_int_equal(run(device, 0, 0, response), 0);
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks)), 0);
	assert_int_equal(clocks.clocks, 2);
	assert_int_equal(clocks.stall_stream, 40);
	assert_int_equal(clocks.stall_raster, 600);
	assert_int_equal(clocks.stall_tile, 8000);
	assert_int_equal(clocks.stall_memory, 100000);
	assert_int_equal(clocks.stall_response, 1200000);
	accel_device_free(device);
}

static void a_plugin_beside_the_program_is_found(void **state)
{
	char program[4096], link[4200], fake[4200];
	struct accel_device *device;
	ssize_t length;

	(void)state;
	unsetenv("GLOSS_SIM_PATH");
	length = readlink("/proc/self/exe", program, sizeof(program) - 1);
	assert_true(length > 0);
	program[length] = '\0';
	*strrchr(program, '/') = '\0';
	snprintf(link, sizeof(link), "%s/sim", program);
	assert_non_null(realpath(getenv("FAKE_SIM_PATH"), fake));
	unlink(link);
	assert_int_equal(symlink(fake, link), 0);
	assert_int_equal(open_name("sim:lanes=1", &device), 0);
	accel_device_free(device);
	unlink(link);
}

#define sim_test(name) cmocka_unit_test_setup(name, setup)

int main(void)
{
	const struct CMUnitTest tests[] = {
		sim_test(a_missing_plugin_is_named_with_where_it_was_looked_for),
		sim_test(a_plugin_that_does_not_fit_is_refused),
		sim_test(a_plugin_out_of_memory_does_not_open),
		sim_test(options_reach_the_core),
		sim_test(a_job_may_take_as_long_as_its_packets),
		sim_test(a_core_that_hangs_or_breaks_a_rule_fails_its_job_only),
		sim_test(clocks_add_up_over_jobs_that_ended),
		sim_test(a_plugin_beside_the_program_is_found),
	};

	if (!getenv("FAKE_SIM_PATH")) {
		fprintf(stderr, "FAKE_SIM_PATH names no directory of plugins: see libaccel.mk\n");
		return 77;
	}
	return cmocka_run_group_tests(tests, NULL, NULL);
}
