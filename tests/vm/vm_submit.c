// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/mman.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vm_submit.h"
#include "vm_test.h"

uint64_t submit_thing[THINGS];
struct client client;

static struct client other;
static uint32_t next_handle, next_sync;
static uint64_t board_free;

void submit_prepare(struct client_job *job)
{
	const uint32_t value = 0x600d;
	uint32_t words = node_write(client.stream, 0, 0, &value, 1);

	words += node_read(client.stream + words, 0, 0, 1);
	client_prepare(&client, job, words, 1);
	job->submit.in_sync_count = 1;
	job->in[0].handle = (uint32_t)submit_thing[SIGNALLED];
}

/* Handles are given out from below: what a refused job had left would take this one's place. */
static uint32_t probe_handle(void)
{
	uint32_t handle;

	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &handle), 0);
	assert_int_equal(node_destroy(client.fd, handle), 0);
	return handle;
}

static uint32_t probe_sync(void)
{
	uint32_t sync;

	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	assert_int_equal(drmSyncobjDestroy(client.fd, sync), 0);
	return sync;
}

void submit_nothing_is_left(const char *name)
{
	if (!client_works(&client))
		fail_msg("%s: the next job did not run", name);
	if (probe_handle() != next_handle || probe_sync() != next_sync)
		fail_msg("%s: a handle is left", name);
}

/* Bytes of board memory that are free in one piece. */
static uint64_t largest_board_object(int fd)
{
	uint64_t size, best = 0, step;
	uint32_t handle;

	assert_int_equal(node_param(fd, DRM_GLOSS_PARAM_MEMORY_SIZE, &size), 0);
	for (step = size; step >= NODE_PAGE; step /= 2) {
		if (best + step > size ||
		    node_create(fd, DRM_GLOSS_GEM_BOARD, best + step, &handle))
			continue;
		best += step;
		assert_int_equal(node_destroy(fd, handle), 0);
	}
	return best;
}

static void make_addresses(void)
{
	char *pages = mmap(NULL, 2 * NODE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS,
			   -1, 0);

	assert_ptr_not_equal(pages, MAP_FAILED);
	munmap(pages + NODE_PAGE, NODE_PAGE);
	submit_thing[UNMAPPED] = (uintptr_t)pages + NODE_PAGE;
	submit_thing[HALF_MAPPED] = (uintptr_t)pages + NODE_PAGE - 8;
}

static void make_syncs(void)
{
	uint32_t sync;

	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	assert_int_equal(drmSyncobjSignal(client.fd, &sync, 1), 0);
	submit_thing[SIGNALLED] = sync;
	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	submit_thing[FRESH] = sync;
	for (int i = 0; i < 40; i++)
		assert_int_equal(node_sync_new(other.fd, &sync), 0);
	submit_thing[SYNC_FOREIGN] = sync;
	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	assert_int_equal(drmSyncobjDestroy(client.fd, sync), 0);
	submit_thing[SYNC_CLOSED] = sync;
}

static void make_handles(void)
{
	uint32_t handle;

	submit_thing[HOST] = client.host.handle;
	submit_thing[BOARD] = client.board;
	for (int i = 0; i < 40; i++)
		assert_int_equal(node_create(other.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &handle), 0);
	submit_thing[FOREIGN] = handle;
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &handle), 0);
	assert_int_equal(node_destroy(client.fd, handle), 0);
	submit_thing[CLOSED] = handle;
}

int submit_setup(void **state)
{
	(void)state;
	assert_int_equal(client_open(&other, vm_env("GLOSS_NODE_MODEL"), 0), 0);
	board_free = largest_board_object(other.fd);
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), SUBMIT_BOARD_BYTES), 0);
	make_addresses();
	make_syncs();
	make_handles();
	next_handle = probe_handle();
	next_sync = probe_sync();
	assert_true(client_works(&client));
	return 0;
}

int submit_teardown(void **state)
{
	(void)state;
	client_close(&client);
	assert_int_equal(largest_board_object(other.fd), board_free);
	client_close(&other);
	return 0;
}
