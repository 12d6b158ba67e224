// SPDX-License-Identifier: MIT
/*
 * Out of memory at the first allocation of a system call, then at the second, and so on
 * until the call needs no more: each time it either says so or does without, and the next
 * job runs. The runner looks for what leaked. As root, on a kernel with fault injection
 * (Documentation/fault-injection/).
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "gloss_node.h"
#include "vm_test.h"

#define BOARD_BYTES NODE_PAGE

/* More than any call here allocates. */
#define ALLOCATIONS_MOST 500

static struct client client;
static int fail_nth;

/* ---- fault injection ---- */

/* Copies from and to user memory fail in their turn too: also those of this file. */
static void inject(int n)
{
	char text[16];
	int length = snprintf(text, sizeof(text), "%d", n);

	for (int tries = 0; tries < 3; tries++)
		if (pwrite(fail_nth, text, (size_t)length, 0) == length)
			return;
	vm_fail("fail-nth: %s", strerror(errno));
}

/* Ends the injection; whether something was made to fail before. */
static bool injected(void)
{
	char text[16] = "";
	ssize_t length = pread(fail_nth, text, sizeof(text) - 1, 0);

	inject(0);
	return length > 0 && atoi(text) == 0;
}

/* Silent, and for allocations that may sleep too, which would else be left alone. */
static void configure(const char *what)
{
	static const char *const settings[][2] = {
		{ "verbose", "0" },
		{ "ignore-gfp-wait", "N" },
		{ "ignore-gfp-highmem", "N" },
		{ "min-order", "0" },
	};
	char path[128];

	for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); i++) {
		snprintf(path, sizeof(path), "/sys/kernel/debug/%s/%s", what, settings[i][0]);
		vm_write_file(path, settings[i][1]);
	}
}

/* ---- a system call that is short of memory ---- */

struct attempt {
	void (*prepare)(void);
	int (*call)(void);   /* the one under test */
	void (*undo)(void);  /* after it said 0 */
	void (*clean)(void); /* always */
};

/* The handle that the next object gets. */
static uint32_t free_handle;

static void nothing(void)
{
}

static uint32_t probe_handle(void)
{
	uint32_t handle;

	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, 1, &handle), 0);
	assert_int_equal(node_destroy(client.fd, handle), 0);
	return handle;
}

/* Fails allocation @n of the call; false: it has fewer. */
static bool fail_once(const struct attempt *attempt, int n, int *refused)
{
	bool more;
	int err;

	attempt->prepare();
	inject(n);
	err = attempt->call();
	more = injected();
	if (!err)
		attempt->undo();
	attempt->clean();
	if (err && (!more || (err != -ENOMEM && err != -EFAULT)))
		fail_msg("allocation %d: %s", n, strerror(-err));
	*refused += err != 0;
	return more;
}

static void fail_each(const struct attempt *attempt)
{
	int n = 1, refused = 0;

	free_handle = probe_handle();
	while (fail_once(attempt, n, &refused)) {
		assert_true(client_works(&client));
		assert_int_equal(probe_handle(), free_handle);
		assert_in_range(++n, 1, ALLOCATIONS_MOST);
	}
	print_message("%d allocations, %d refusals\n", n - 1, refused);
	assert_in_range(refused, 1, ALLOCATIONS_MOST);
}

/* ---- open and GEM_CREATE ---- */

static int opened;

static int call_open(void)
{
	opened = node_open(vm_env("GLOSS_NODE_MODEL"));
	return opened < 0 ? opened : 0;
}

static void undo_open(void)
{
	close(opened);
}

static void open_is_refused_or_right(void **state)
{
	(void)state;
	fail_each(&(struct attempt){ nothing, call_open, undo_open, nothing });
}

static uint32_t created;

/*
 * If it is the copy of the answer that fails, the object has been made, as by any DRM driver:
 * it is the file's, and its handle the one that was free.
 */
static int create(uint32_t kind)
{
	int err = node_create(client.fd, kind, 3 * NODE_PAGE, &created);

	if (err == -EFAULT)
		node_destroy(client.fd, free_handle);
	return err;
}

static int call_create_host(void)
{
	return create(DRM_GLOSS_GEM_HOST);
}

static int call_create_board(void)
{
	return create(DRM_GLOSS_GEM_BOARD);
}

static void undo_create(void)
{
	assert_int_equal(node_destroy(client.fd, created), 0);
}

static void a_host_object_is_refused_or_right(void **state)
{
	(void)state;
	fail_each(&(struct attempt){ nothing, call_create_host, undo_create, nothing });
}

/* What was made is what it should be: cleared, whatever was short of memory meanwhile. */
static void undo_create_board(void)
{
	struct client_job job;

	client_prepare(&client, &job, node_read(client.stream, 0, 0, 3 * NODE_PAGE / 4),
		       3 * NODE_PAGE / 4);
	job.slot[0].handle = created;
	job.slot[0].size = 3 * NODE_PAGE;
	memset(client.response, 0xff, 3 * NODE_PAGE);
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	for (uint32_t i = 0; i < 3 * NODE_PAGE / 4; i++)
		assert_int_equal(client.response[i], 0);
	undo_create();
}

static void a_board_object_is_refused_or_right(void **state)
{
	(void)state;
	fail_each(&(struct attempt){ nothing, call_create_board, undo_create_board, nothing });
}

/* ---- GEM_MMAP_OFFSET ---- */

static int call_offset(void)
{
	uint64_t offset;

	return node_mmap_offset(client.fd, created, &offset);
}

static void prepare_object(void)
{
	assert_int_equal(call_create_host(), 0);
}

static void an_offset_is_refused_or_right(void **state)
{
	(void)state;
	fail_each(&(struct attempt){ prepare_object, call_offset, nothing, undo_create });
}

/* ---- SUBMIT ---- */

static struct node_buffer stream, response;
static struct client_job job;
static uint32_t signalled;

/* With all there is, and host objects that no job has used, which have no pages yet. */
static void prepare_submit(void)
{
	uint32_t words;

	assert_int_equal(node_buffer_new(client.fd, 2 * NODE_PAGE, &stream), 0);
	assert_int_equal(node_buffer_new(client.fd, 4 * NODE_PAGE, &response), 0);
	words = node_write(stream.map, 3, 0, (uint32_t[]){ 0x511b }, 1);
	words += node_read((uint32_t *)stream.map + words, 3, 0, 1);
	client_prepare(&client, &job, words, 1);
	job.submit.stream = stream.handle;
	job.submit.response = response.handle;
	job.submit.response_offset = 0;
	for (int i = 1; i < 4; i++)
		job.slot[i] = job.slot[0];
	job.submit.slot_count = 4;
	job.in[0].handle = signalled;
	job.in[1] = (struct drm_gloss_sync){ client.timeline, DRM_GLOSS_SYNC_TIMELINE,
					     client.point };
	job.submit.in_sync_count = 2;
}

static int call_submit(void)
{
	return client_submit(&client, &job);
}

static void undo_submit(void)
{
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	assert_int_equal(*(uint32_t *)response.map, 0x511b);
}

static void clean_submit(void)
{
	node_buffer_free(client.fd, &stream);
	node_buffer_free(client.fd, &response);
}

static void a_job_is_refused_or_right(void **state)
{
	(void)state;
	fail_each(&(struct attempt){ prepare_submit, call_submit, undo_submit, clean_submit });
}

/* ---- dma-buf ---- */

static int call_export(void)
{
	return drmPrimeHandleToFD(client.fd, client.host.handle, DRM_CLOEXEC, &opened) ? -errno : 0;
}

static void an_export_is_refused_or_right(void **state)
{
	(void)state;
	fail_each(&(struct attempt){ nothing, call_export, undo_open, nothing });
}

/* ---- set up ---- */

static int setup(void **state)
{
	(void)state;
	fail_nth = open("/proc/thread-self/fail-nth", O_RDWR | O_CLOEXEC);
	if (fail_nth < 0)
		vm_skip("no /proc/thread-self/fail-nth: the kernel has no fault injection");
	configure("failslab");
	configure("fail_page_alloc");
	configure("fail_usercopy");
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES), 0);
	assert_int_equal(node_sync_new(client.fd, &signalled), 0);
	assert_int_equal(drmSyncobjSignal(client.fd, &signalled, 1), 0);
	assert_true(client_works(&client));
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	client_close(&client);
	return close(fail_nth);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(open_is_refused_or_right),
		cmocka_unit_test(a_host_object_is_refused_or_right),
		cmocka_unit_test(a_board_object_is_refused_or_right),
		cmocka_unit_test(an_offset_is_refused_or_right),
		cmocka_unit_test(a_job_is_refused_or_right),
		cmocka_unit_test(an_export_is_refused_or_right),
	};

	return cmocka_run_group_tests(tests, setup, teardown);
}
