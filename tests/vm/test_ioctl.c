// SPDX-License-Identifier: MIT
/*
 * Every ioctl but SUBMIT with right and with bad arguments, and objects between files and
 * boards: the errors are those gloss_drm.h promises.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vm_test.h"
#include "gloss_node.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static struct client client, other;
static void *unmapped, *read_only;

static const unsigned long requests[] = {
	DRM_IOCTL_GLOSS_GET_PARAM,
	DRM_IOCTL_GLOSS_GEM_CREATE,
	DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET,
	DRM_IOCTL_GLOSS_SUBMIT,
};

/* ---- any ioctl ---- */

static void bad_pointers_are_refused(void **state)
{
	(void)state;
	for (size_t i = 0; i < COUNT(requests); i++) {
		assert_int_equal(node_ioctl(client.fd, requests[i], NULL), -EFAULT);
		assert_int_equal(node_ioctl(client.fd, requests[i], unmapped), -EFAULT);
		assert_int_equal(node_ioctl(client.fd, requests[i], (void *)-8ul), -EFAULT);
	}
	assert_true(client_works(&client));
}

/* The argument is read but the answer has no place: the object must not stay behind. */
static void an_answer_without_a_place_leaves_nothing(void **state)
{
	uint32_t before, after;

	(void)state;
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, 1, &before), 0);
	assert_int_equal(node_destroy(client.fd, before), 0);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_GET_PARAM, read_only), -EFAULT);
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, 1, &after), 0);
	assert_int_equal(node_destroy(client.fd, after), 0);
	assert_int_equal(before, after);
}

static void an_argument_needs_no_alignment(void **state)
{
	const struct drm_gloss_get_param get = { .param = DRM_GLOSS_PARAM_SLOTS };
	char bytes[sizeof(get) + 1];
	uint64_t value;

	(void)state;
	memcpy(bytes + 1, &get, sizeof(get));
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_GET_PARAM, bytes + 1), 0);
	memcpy(&value, bytes + 1 + offsetof(struct drm_gloss_get_param, value), sizeof(value));
	assert_int_equal(value, GLOSS_SLOTS);
}

static void unknown_ioctls_are_refused(void **state)
{
	struct drm_gloss_submit zero = { 0 };

	(void)state;
	for (unsigned int n = DRM_GLOSS_GET_CLOCKS + 1; n < 0x60; n++)
		assert_int_equal(node_ioctl(client.fd,
					    DRM_IOW(DRM_COMMAND_BASE + n, struct drm_gloss_submit),
					    &zero),
				 -EINVAL);
}

/* ---- GET_PARAM ---- */

static void parameters_are_plausible(void **state)
{
	static const struct {
		uint32_t param;
		uint64_t least, most;
	} rows[] = {
		{ DRM_GLOSS_PARAM_VERSION, GLOSS_VERSION, GLOSS_VERSION },
		{ DRM_GLOSS_PARAM_TILE_SIZE, 32, 64 },
		{ DRM_GLOSS_PARAM_PIXELS_PER_CLOCK, 1, 8 },
		{ DRM_GLOSS_PARAM_MEMORY_SIZE, NODE_PAGE, 1ull << 32 },
		{ DRM_GLOSS_PARAM_SLOTS, GLOSS_SLOTS, GLOSS_SLOTS },
		{ DRM_GLOSS_PARAM_STREAM_WORDS_MAX, NODE_PAGE, UINT32_MAX },
		{ DRM_GLOSS_PARAM_JOBS_LOST, 0, 0 },
		{ DRM_GLOSS_PARAM_JOB_LIMIT, 1, UINT32_MAX },
		{ DRM_GLOSS_PARAM_JOBS_QUEUED, 2, 1 << 20 },
	};
	uint64_t value;

	(void)state;
	for (size_t i = 0; i < COUNT(rows); i++) {
		assert_int_equal(node_param(client.fd, rows[i].param, &value), 0);
		assert_in_range(value, rows[i].least, rows[i].most);
	}
}

static void unknown_parameters_are_refused(void **state)
{
	struct drm_gloss_get_param get = { .param = DRM_GLOSS_PARAM_VERSION, .pad = 1 };
	uint64_t value;

	(void)state;
	assert_int_equal(node_param(client.fd, DRM_GLOSS_PARAM_JOBS_QUEUED + 1, &value), -EINVAL);
	assert_int_equal(node_param(client.fd, ~0u, &value), -EINVAL);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_GET_PARAM, &get), -EINVAL);
}

/* ---- GEM_CREATE ---- */

static uint64_t param(uint32_t which)
{
	uint64_t value;

	assert_int_equal(node_param(client.fd, which, &value), 0);
	return value;
}

static uint64_t memory_size(void)
{
	return param(DRM_GLOSS_PARAM_MEMORY_SIZE);
}

static void bad_objects_are_refused(void **state)
{
	const struct drm_gloss_gem_create rows[] = {
		{ .size = 0, .kind = DRM_GLOSS_GEM_HOST },
		{ .size = 0, .kind = DRM_GLOSS_GEM_BOARD },
		{ .size = -1ull, .kind = DRM_GLOSS_GEM_HOST },
		{ .size = -1ull, .kind = DRM_GLOSS_GEM_BOARD },
		{ .size = -4096ull, .kind = DRM_GLOSS_GEM_HOST },
		{ .size = -4096ull, .kind = DRM_GLOSS_GEM_BOARD },
		{ .size = 1ull << 63, .kind = DRM_GLOSS_GEM_HOST },
		{ .size = 1ull << 63, .kind = DRM_GLOSS_GEM_BOARD },
		{ .size = 4 * param(DRM_GLOSS_PARAM_STREAM_WORDS_MAX) + 1,
		  .kind = DRM_GLOSS_GEM_HOST },
		{ .size = memory_size() + 1, .kind = DRM_GLOSS_GEM_BOARD },
		{ .size = (1ull << 32) + NODE_PAGE, .kind = DRM_GLOSS_GEM_BOARD },
		{ .size = 1, .kind = DRM_GLOSS_GEM_BOARD + 1 },
		{ .size = 1, .kind = ~0u },
		{ .size = 1, .kind = DRM_GLOSS_GEM_HOST, .flags = 1 },
		{ .size = 1, .kind = DRM_GLOSS_GEM_HOST, .flags = 1u << 31 },
		{ .size = 1, .kind = DRM_GLOSS_GEM_BOARD, .flags = 2 },
		{ .size = 1, .kind = DRM_GLOSS_GEM_HOST, .pad = 1 },
		{ .size = 1, .kind = DRM_GLOSS_GEM_BOARD, .pad = 1u << 31 },
	};

	(void)state;
	for (size_t i = 0; i < COUNT(rows); i++) {
		struct drm_gloss_gem_create create = rows[i];
		int err = node_ioctl(client.fd, DRM_IOCTL_GLOSS_GEM_CREATE, &create);

		if (err != -EINVAL)
			fail_msg("row %zu: %s", i, strerror(-err));
	}
	assert_true(client_works(&client));
}

static void sizes_are_rounded_up_to_pages(void **state)
{
	(void)state;
	for (uint32_t kind = DRM_GLOSS_GEM_HOST; kind <= DRM_GLOSS_GEM_BOARD; kind++) {
		for (uint64_t size = 1; size <= 2 * NODE_PAGE; size += 2047) {
			struct drm_gloss_gem_create create = { .size = size, .kind = kind };

			assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_GEM_CREATE, &create),
					 0);
			assert_int_equal(create.size,
					 (size + NODE_PAGE - 1) / NODE_PAGE * NODE_PAGE);
			assert_int_equal(node_destroy(client.fd, create.handle), 0);
		}
	}
}

/* Takes board memory until there is none, and finds all of it again afterwards. */
static void board_memory_ends_with_enospc(void **state)
{
	uint64_t chunk = memory_size() / 8, first = 0;
	uint32_t handle[8];

	(void)state;
	for (int round = 0; round < 3; round++) {
		uint64_t count = 0;
		int err;

		while (!(
			err = node_create(client.fd, DRM_GLOSS_GEM_BOARD, chunk, &handle[count]))) {
			assert_in_range(handle[count], 1, UINT32_MAX);
			if (++count == COUNT(handle))
				break;
		}
		if (count < COUNT(handle))
			assert_int_equal(err, -ENOSPC);
		assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_BOARD, memory_size(),
					     &handle[7]),
				 -ENOSPC);
		if (!round)
			first = count;
		assert_int_equal(count, first);
		while (count > 0)
			assert_int_equal(node_destroy(client.fd, handle[--count]), 0);
	}
	assert_in_range(first, 1, 7);
}

/* ---- GEM_MMAP_OFFSET and mmap ---- */

static void only_host_objects_have_an_offset(void **state)
{
	struct drm_gloss_gem_mmap_offset map = { .handle = client.host.handle, .pad = 1 };
	uint64_t offset;
	uint32_t stale;

	(void)state;
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET, &map), -EINVAL);
	assert_int_equal(node_mmap_offset(client.fd, client.board, &offset), -EINVAL);
	assert_int_equal(node_mmap_offset(client.fd, 0, &offset), -ENOENT);
	assert_int_equal(node_mmap_offset(client.fd, ~0u, &offset), -ENOENT);
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, 1, &stale), 0);
	assert_int_equal(node_destroy(client.fd, stale), 0);
	assert_int_equal(node_mmap_offset(client.fd, stale, &offset), -ENOENT);
	assert_int_equal(node_destroy(client.fd, stale), -EINVAL);
}

static int try_map(int fd, uint64_t offset, uint64_t size)
{
	void *map = mmap(NULL, size, PROT_READ, MAP_SHARED, fd, (off_t)offset);

	if (map == MAP_FAILED)
		return -errno;
	munmap(map, size);
	return 0;
}

static void maps_reach_only_objects_of_the_file(void **state)
{
	uint64_t offset;

	(void)state;
	assert_int_equal(node_mmap_offset(client.fd, client.host.handle, &offset), 0);
	assert_int_equal(try_map(client.fd, offset, CLIENT_HOST_BYTES), 0);
	assert_int_not_equal(try_map(client.fd, offset, CLIENT_HOST_BYTES + NODE_PAGE), 0);
	assert_int_not_equal(try_map(client.fd, offset + CLIENT_HOST_BYTES, NODE_PAGE), 0);
	assert_int_not_equal(try_map(client.fd, 0, NODE_PAGE), 0);
	assert_int_equal(try_map(other.fd, offset, NODE_PAGE), -EACCES);
}

/* ---- dma-buf ---- */

static void board_objects_are_not_exported(void **state)
{
	int file = -1;

	(void)state;
	assert_int_not_equal(drmPrimeHandleToFD(client.fd, client.board, DRM_CLOEXEC, &file), 0);
	assert_int_equal(drmPrimeHandleToFD(client.fd, 9999, DRM_CLOEXEC, &file), -1);
	assert_int_equal(errno, ENOENT);
	assert_int_equal(file, -1);
}

static int export_host(void)
{
	int file;

	assert_int_equal(drmPrimeHandleToFD(client.fd, client.host.handle, DRM_CLOEXEC | DRM_RDWR,
					    &file),
			 0);
	return file;
}

static void an_export_comes_home_as_the_same_object(void **state)
{
	int file = export_host();
	uint32_t handle;

	(void)state;
	assert_int_equal(drmPrimeFDToHandle(client.fd, file, &handle), 0);
	assert_int_equal(handle, client.host.handle);
	close(file);
	assert_true(client_works(&client));
}

/* The stream of @client's object, sent by @user as its object @handle. */
static void run_shared_stream(struct client *user, uint32_t handle)
{
	const uint32_t value = 0xdab0f;
	struct client_job job;
	uint32_t words = node_write(client.stream, 0, 0, &value, 1);

	words += node_read(client.stream + words, 0, 0, 1);
	client_prepare(user, &job, words, 1);
	job.submit.stream = handle;
	user->response[0] = 0;
	assert_int_equal(client_submit(user, &job), 0);
	assert_int_equal(client_wait(user, vm_patience_ms()), 0);
	assert_int_equal(user->response[0], value);
}

static void another_file_runs_an_exported_stream(void **state)
{
	int file = export_host();
	uint32_t handle;

	(void)state;
	assert_int_equal(drmPrimeFDToHandle(other.fd, file, &handle), 0);
	close(file);
	run_shared_stream(&other, handle);
	assert_int_equal(node_destroy(other.fd, handle), 0);
	assert_true(client_works(&client));
}

/* A response lands in memory that the file which exported it sees. */
static void another_board_uses_an_exported_object(void **state)
{
	struct client board;
	struct client_job job;
	uint64_t offset;
	int file = export_host();
	uint32_t handle, words;

	(void)state;
	assert_int_equal(client_open(&board, vm_env("GLOSS_NODE_RTL"), 2 * NODE_PAGE), 0);
	assert_int_equal(drmPrimeFDToHandle(board.fd, file, &handle), 0);
	close(file);
	assert_int_equal(node_mmap_offset(board.fd, handle, &offset), -EINVAL);
	run_shared_stream(&board, handle);
	words = node_read(board.stream, 0, 0, 1);
	client_prepare(&board, &job, words, 1);
	job.submit.response = handle;
	client.response[0] = 0;
	assert_int_equal(client_submit(&board, &job), 0);
	assert_int_equal(client_wait(&board, vm_patience_ms()), 0);
	assert_int_equal(client.response[0], 0xdab0f);
	client_close(&board);
	assert_true(client_works(&client));
}

/* ---- set up ---- */

static int setup(void **state)
{
	const struct drm_gloss_get_param get = { .param = DRM_GLOSS_PARAM_SLOTS };

	(void)state;
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), 2 * NODE_PAGE), 0);
	assert_int_equal(client_open(&other, vm_env("GLOSS_NODE_MODEL"), 2 * NODE_PAGE), 0);
	unmapped = mmap(NULL, NODE_PAGE, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	read_only = mmap(NULL, NODE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1,
			 0);
	assert_ptr_not_equal(unmapped, MAP_FAILED);
	assert_ptr_not_equal(read_only, MAP_FAILED);
	memcpy(read_only, &get, sizeof(get));
	return mprotect(read_only, NODE_PAGE, PROT_READ);
}

static int teardown(void **state)
{
	(void)state;
	client_close(&client);
	client_close(&other);
	return 0;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(bad_pointers_are_refused),
		cmocka_unit_test(an_answer_without_a_place_leaves_nothing),
		cmocka_unit_test(an_argument_needs_no_alignment),
		cmocka_unit_test(unknown_ioctls_are_refused),
		cmocka_unit_test(parameters_are_plausible),
		cmocka_unit_test(unknown_parameters_are_refused),
		cmocka_unit_test(bad_objects_are_refused),
		cmocka_unit_test(sizes_are_rounded_up_to_pages),
		cmocka_unit_test(board_memory_ends_with_enospc),
		cmocka_unit_test(only_host_objects_have_an_offset),
		cmocka_unit_test(maps_reach_only_objects_of_the_file),
		cmocka_unit_test(board_objects_are_not_exported),
		cmocka_unit_test(an_export_comes_home_as_the_same_object),
		cmocka_unit_test(another_file_runs_an_exported_stream),
		cmocka_unit_test(another_board_uses_an_exported_object),
	};

	return cmocka_run_group_tests(tests, setup, teardown);
}
