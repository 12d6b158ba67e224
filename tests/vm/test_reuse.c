// SPDX-License-Identifier: MIT
/* Memory that had another owner reads zero: board memory of a process that ended or was killed, and
 * pages of the host. */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "vm_test.h"
#include "gloss_node.h"

#define SENTINEL 0xdeadc0deu

static uint64_t seed;
static uint32_t tile;

static uint32_t secret(uint32_t at)
{
	return (uint32_t)seed + at * 0x9e3779b1u;
}

/* Tiles of one job; as many as a stream has room for. */
#define FILL_TILES 512

static int fill_object(struct client *client, uint32_t handle, uint64_t size)
{
	uint64_t bytes = 4 * (uint64_t)tile * tile, at = 0;
	int err = 0;

	while (at < size && !err) {
		struct client_job job;
		uint32_t words = 0;

		for (int n = 0; n < FILL_TILES && at < size; n++, at += bytes)
			words += node_fill(client->stream + words, 0, (uint32_t)at, tile,
					   secret((uint32_t)at));
		client_prepare(client, &job, words, 0);
		job.slot[0] = (struct drm_gloss_slot){ handle, 3, 0, size };
		job.submit.slot_count = 1;
		job.submit.slot_stride = sizeof(job.slot[0]);
		err = client_submit(client, &job);
		if (!err)
			err = client_wait(client, vm_patience_ms());
	}
	return err;
}

/* Is the object all zero? */
static bool is_clear(struct client *client, uint32_t handle, uint64_t size)
{
	enum { AT_ONCE = CLIENT_RESPONSE_WORDS / 2 };
	static const uint32_t zero[AT_ONCE];

	for (uint64_t at = 0; at < size; at += 4 * AT_ONCE) {
		uint32_t count = size - at < 4 * AT_ONCE ? (uint32_t)(size - at) / 4 : AT_ONCE;
		struct client_job job;

		client_prepare(client, &job, node_read(client->stream, 0, (uint32_t)at, count),
			       count);
		job.slot[0] = (struct drm_gloss_slot){ handle, DRM_GLOSS_SLOT_READ, 0, size };
		job.submit.slot_count = 1;
		job.submit.slot_stride = sizeof(job.slot[0]);
		client->response[0] = SENTINEL;
		client->response[count - 1] = SENTINEL;
		if (client_submit(client, &job) || client_wait(client, vm_patience_ms()) ||
		    memcmp(client->response, zero, 4 * (size_t)count) != 0)
			return false;
	}
	return true;
}

/* What is done to each object while all of board memory is taken, the large ones first. */
typedef int (*object_fn)(struct client *client, uint32_t handle, uint64_t size);

static int check_object(struct client *client, uint32_t handle, uint64_t size)
{
	return is_clear(client, handle, size) ? 0 : -EBADMSG;
}

static int with_all_memory(struct client *client, uint64_t memory, uint64_t least, object_fn what,
			   uint64_t *taken)
{
	uint32_t handle;
	int err;

	*taken = 0;
	for (uint64_t size = memory; size >= least; size /= 2) {
		while (!(err = node_create(client->fd, DRM_GLOSS_GEM_BOARD, size, &handle))) {
			err = what(client, handle, size);
			if (err)
				return err;
			*taken += size;
		}
		if (err != -ENOSPC)
			return err;
	}
	return 0;
}

/* Fills all of board memory and is then killed, or ends by itself. */
static void leave_secrets(uint64_t memory, bool killed)
{
	pid_t process = fork();
	int status;

	assert_int_not_equal(process, -1);
	if (!process) {
		struct client client;
		uint64_t taken;

		if (client_open(&client, vm_env("GLOSS_NODE_MODEL"), 0) ||
		    with_all_memory(&client, memory, 4 * (uint64_t)tile * tile, fill_object,
				    &taken) ||
		    taken < memory / 2)
			_exit(1);
		if (killed)
			kill(getpid(), SIGKILL);
		_exit(0);
	}
	assert_int_equal(waitpid(process, &status, 0), process);
	assert_true(killed ? WIFSIGNALED(status) : WIFEXITED(status) && !WEXITSTATUS(status));
}

static void memory_of_a_gone_process_reads_zero(void **state)
{
	struct client client;
	uint64_t memory, taken, again;

	(void)state;
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), 0), 0);
	assert_int_equal(node_param(client.fd, DRM_GLOSS_PARAM_MEMORY_SIZE, &memory), 0);
	leave_secrets(memory, false);
	assert_int_equal(with_all_memory(&client, memory, NODE_PAGE, check_object, &taken), 0);
	client_close(&client);
	leave_secrets(memory, true);
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), 0), 0);
	assert_int_equal(with_all_memory(&client, memory, NODE_PAGE, check_object, &again), 0);
	assert_int_equal(taken, again);
	assert_in_range(taken, memory / 2, memory);
	client_close(&client);
}

/* A host object's pages come from memory that others had; none of that is to be seen. */
static void new_host_memory_reads_zero(void **state)
{
	enum { BYTES = 1 << 20 };
	int fd = node_open(vm_env("GLOSS_NODE_MODEL"));

	(void)state;
	assert_in_range(fd, 0, 1 << 20);
	for (int round = 0; round < 8; round++) {
		struct node_buffer buffer;
		const uint32_t *words;

		assert_int_equal(node_buffer_new(fd, BYTES, &buffer), 0);
		words = buffer.map;
		for (size_t i = 0; i < BYTES / 4; i++)
			if (words[i])
				fail_msg("word %zu is 0x%08x", i, words[i]);
		memset(buffer.map, 0xa5, BYTES);
		node_buffer_free(fd, &buffer);
	}
	close(fd);
}

static int setup(void **state)
{
	uint64_t value;
	int fd = node_open(vm_env("GLOSS_NODE_MODEL"));

	(void)state;
	if (fd < 0 || node_param(fd, DRM_GLOSS_PARAM_TILE_SIZE, &value))
		return -1;
	tile = (uint32_t)value;
	seed = vm_seed();
	return close(fd);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(memory_of_a_gone_process_reads_zero),
		cmocka_unit_test(new_host_memory_reads_zero),
	};

	return cmocka_run_group_tests(tests, setup, NULL);
}
