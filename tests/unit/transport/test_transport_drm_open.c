/* SPDX-License-Identifier: MIT */
/* What "drm:" and "auto" find in /dev/dri, and what they say when that is nothing. */
#include <grp.h>
#include <unistd.h>
#include <xf86drm.h>

#include "accel_test.h"
#include "fake_gloss.h"
#include "list_test.h"

static struct messages messages;

static int open_name(const char *name, struct accel_device **device)
{
	*device = NULL;
	messages = (struct messages){ "", 0 };
	return accel_device_new(name, messages_take, &messages, device);
}

static int setup(void **state)
{
	(void)state;
	fake_gloss_start();
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	fake_gloss_stop();
	assert_int_equal(fake_gloss.files, 0);
	return 0;
}

static void assert_refused(const char *name, int err, const char *message)
{
	struct accel_device *device;

	assert_int_equal(open_name(name, &device), err);
	assert_null(device);
	assert_message(&messages, message);
	assert_int_equal(messages.count, 1);
	assert_int_equal(fake_gloss.files, 0);
	assert_true(strlen(messages.last) < 250);
}

static void assert_opens(const char *name, unsigned int node)
{
	struct accel_device *device;

	assert_int_equal(open_name(name, &device), 0);
	assert_int_equal(fake_gloss.files, 1);
	assert_int_equal(fake_gloss.opened, node);
	assert_int_equal(messages.count, 0);
	accel_device_free(device);
}

static void add_node(unsigned int node, const char *driver)
{
	fake_gloss.node[node] = (struct fake_node){ .present = true,
						    .mode = 0660,
						    .driver = driver };
}

static void the_board_says_what_it_is(void **state)
{
	struct accel_device_info info;
	struct accel_device *device;

	(void)state;
	assert_int_equal(open_name("drm:", &device), 0);
	accel_device_info(device, &info, sizeof(info));
	assert_string_equal(info.name,
			    "Gloss PCI board /dev/dri/renderD128, 64-pixel tiles, 8 lanes");
	assert_int_equal(info.tile_size, 64);
	assert_int_equal(info.pixels_per_clock, 8);
	assert_int_equal(info.memory_size, FAKE_BOARD_BYTES);
	accel_device_free(device);
}

/* A name that does not fit is left out. */
static void a_board_with_a_long_path_says_what_it_is(void **state)
{
	char name[] = "drm:/dev/dri/./././././././././renderD128";
	struct accel_device_info info;
	struct accel_device *device;

	(void)state;
	assert_int_equal(open_name(name, &device), 0);
	accel_device_info(device, &info, sizeof(info));
	assert_string_equal(info.name, "Gloss PCI board, 64-pixel tiles, 8 lanes");
	accel_device_free(device);
}

static void a_node_opens_by_its_path(void **state)
{
	(void)state;
	add_node(1, "gloss");
	assert_opens("drm:/dev/dri/renderD128", 0);
	assert_opens("drm:/dev/dri/renderD129", 1);
}

static void the_first_board_is_taken(void **state)
{
	(void)state;
	add_node(0, "i915");
	add_node(1, "gloss");
	add_node(2, "gloss");
	assert_opens("drm:", 1);
	assert_opens("drm", 1);
	assert_opens("auto", 1);
	assert_opens(NULL, 1);
}

/* Opening it could wake what sleeps. */
static void a_node_of_another_driver_is_not_opened_in_the_search(void **state)
{
	(void)state;
	add_node(0, "i915");
	add_node(1, "gloss");
	fake_gloss.opened = 9;
	fake_gloss.node[0].open_error = EACCES;
	assert_opens("drm:", 1);
	fake_gloss.node[1].driver = "amdgpu";
	fake_gloss.opened = 9;
	assert_refused("drm:", -ENODEV, "no Gloss board");
	assert_int_equal(fake_gloss.opened, 9);
}

static void of_two_boards_one_that_opens_is_taken(void **state)
{
	(void)state;
	add_node(1, "gloss");
	fake_gloss.node[0].open_error = EACCES;
	assert_opens("drm:", 1);
	fake_gloss.node[1].open_error = ENXIO;
	assert_refused("drm:", -EACCES, "not permitted: /dev/dri/renderD128");
}

static void no_board_is_said_with_what_to_do(void **state)
{
	(void)state;
	fake_gloss.node[0].present = false;
	assert_refused("drm:", -ENODEV, "the kernel module is loaded and has found none");
	fake_gloss.module_loaded = false;
	assert_refused("drm:", -ENODEV, "the kernel module is not loaded; try sudo modprobe gloss");
	add_node(2, "i915");
	assert_refused("drm:", -ENODEV, "no Gloss board");
}

static void a_missing_node_is_said_with_what_to_do(void **state)
{
	(void)state;
	assert_refused("drm:/dev/dri/renderD130", -ENODEV,
		       "there is no /dev/dri/renderD130; ls /dev/dri shows the nodes, "
		       "sudo modprobe gloss loads the module");
	assert_refused("drm:/nonexistent/node", -ENODEV, "there is no /nonexistent/node");
}

static void a_node_of_a_group_names_it(void **state)
{
	const struct group *users = getgrnam("users");

	(void)state;
	fake_gloss.node[0].open_error = EACCES;
	fake_gloss.node[0].group = users->gr_gid;
	assert_refused("drm:/dev/dri/renderD128", -EACCES,
		       "/dev/dri/renderD128 is for group users; add yourself with "
		       "sudo usermod -aG users $USER and log in again");
	fake_gloss.node[0].group = 123456789;
	fake_gloss.node[0].open_error = EPERM;
	assert_refused("drm:", -EACCES, "for group 123456789");
}

static void a_node_that_lets_no_group_in_says_so(void **state)
{
	static const unsigned int modes[] = { 0600, 0640, 0620 };
	char message[64];

	(void)state;
	fake_gloss.node[0].open_error = EACCES;
	for (size_t i = 0; i < sizeof(modes) / sizeof(modes[0]); i++) {
		fake_gloss.node[0].mode = modes[i];
		snprintf(message, sizeof(message), "of group root and mode %04o;", modes[i]);
		assert_refused("drm:/dev/dri/renderD128", -EACCES, message);
	}
}

static void what_is_no_gloss_node_is_named(void **state)
{
	(void)state;
	fake_gloss.node[0].driver = "i915";
	assert_refused("drm:/dev/dri/renderD128", -ENODEV,
		       "/dev/dri/renderD128 is driven by i915, not gloss");
	fake_gloss.node[0].driver = "glossy";
	assert_refused("drm:/dev/dri/renderD128", -ENODEV, "driven by glossy, not gloss");
	assert_refused("drm:/dev/null", -ENODEV, "/dev/null is no DRM node");
	assert_refused("drm:/tmp", -ENODEV, "/tmp: Is a directory");
	fake_gloss.node[0].open_error = EMFILE;
	assert_refused("drm:/dev/dri/renderD128", -ENODEV, "renderD128: Too many open files");
}

static void what_is_no_path_is_refused(void **state)
{
	static const char *const names[] = { "drm:renderD128", "drm:tile=32", "drm: ", "drm:0" };

	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		assert_refused(names[i], -EINVAL,
			       "give the path of a node, as in drm:/dev/dri/renderD128");
}

static void a_board_of_another_version_is_refused(void **state)
{
	(void)state;
	fake_gloss.version = GLOSS_VERSION + 1;
	assert_refused("drm:", -ENODEV, "the board speaks version 2 of the stream, not 1");
}

/* Each call of an open, and each answer. */
static void a_module_that_answers_otherwise_is_refused(void **state)
{
	static const int errors[] = { EINVAL, EACCES, ENODEV, EOPNOTSUPP, ENOTTY, ENOMEM };
	struct accel_device *device;
	unsigned int calls, call;

	(void)state;
	assert_opens("drm:", 0);
	for (calls = fake_gloss.ioctls, call = 1; call < calls; call++) {
		for (size_t i = 0; i < sizeof(errors) / sizeof(errors[0]); i++) {
			int err;

			fake_gloss.fail_at = call;
			fake_gloss.fail_errno = errors[i];
			err = open_name("drm:", &device);
			assert_int_equal(err, errors[i] == ENOMEM ? -ENOMEM : -ENODEV);
			assert_message(&messages,
				       call > 2       ? "/dev/dri/renderD128 does not answer "
							"as a gloss module of this version" :
				       err == -ENOMEM ? "Cannot allocate memory" :
				       errors[i] == ENODEV ?
							"the board of /dev/dri/renderD128 is gone" :
							"/dev/dri/renderD128 is no DRM node");
			assert_int_equal(fake_gloss.fail_at, 0);
			assert_int_equal(fake_gloss.files, 0);
		}
	}
}

static void auto_takes_the_model_without_a_board_and_says_nothing(void **state)
{
	struct accel_device_info info;
	struct accel_device *device;

	(void)state;
	fake_gloss.node[0].present = fake_gloss.module_loaded = false;
	assert_int_equal(open_name("auto", &device), 0);
	accel_device_info(device, &info, sizeof(info));
	assert_non_null(strstr(info.name, "model"));
	assert_int_equal(messages.count, 0);
	accel_device_free(device);
}

static void auto_says_why_a_board_that_is_there_is_not_taken(void **state)
{
	struct accel_device *device;

	(void)state;
	fake_gloss.node[0].open_error = EACCES;
	assert_int_equal(open_name("auto", &device), 0);
	assert_message(&messages, "device \"drm:\": not permitted: /dev/dri/renderD128");
	assert_int_equal(messages.count, 1);
	accel_device_free(device);
}

static void every_board_is_listed_with_what_it_is_or_why_not(void **state)
{
	struct listed listed = { .kind = "drm:" };

	(void)state;
	add_node(1, "i915");
	add_node(2, "gloss");
	fake_gloss.node[2].open_error = ENXIO;
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_string_equal(listed.text,
			    "drm:/dev/dri/renderD128|Gloss PCI board /dev/dri/renderD128, "
			    "64-pixel tiles, 8 lanes\n"
			    "drm:/dev/dri/renderD130|/dev/dri/renderD130: No such device or "
			    "address\n");
	assert_int_equal(fake_gloss.files, 0);
	assert_int_equal(fake_gloss.left, 0);
	fake_gloss.node[0].present = fake_gloss.node[2].present = false;
	listed.count = 0;
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_int_equal(listed.count, 0);
}

#define drm_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		drm_test(the_board_says_what_it_is),
		drm_test(a_board_with_a_long_path_says_what_it_is),
		drm_test(a_node_opens_by_its_path),
		drm_test(the_first_board_is_taken),
		drm_test(a_node_of_another_driver_is_not_opened_in_the_search),
		drm_test(of_two_boards_one_that_opens_is_taken),
		drm_test(no_board_is_said_with_what_to_do),
		drm_test(a_missing_node_is_said_with_what_to_do),
		drm_test(a_node_of_a_group_names_it),
		drm_test(a_node_that_lets_no_group_in_says_so),
		drm_test(what_is_no_gloss_node_is_named),
		drm_test(what_is_no_path_is_refused),
		drm_test(a_board_of_another_version_is_refused),
		drm_test(a_module_that_answers_otherwise_is_refused),
		drm_test(auto_takes_the_model_without_a_board_and_says_nothing),
		drm_test(every_board_is_listed_with_what_it_is_or_why_not),
		drm_test(auto_says_why_a_board_that_is_there_is_not_taken),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
