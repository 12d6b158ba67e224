// SPDX-License-Identifier: MIT
/*
 * A board that fails in ways it can be brought back from: what fails is one job, and the
 * other files' jobs do not notice. As root, for the board's fault window.
 */
#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "gloss_node.h"
#include "vm_board.h"
#include "vm_test.h"

#define BOARD_BYTES NODE_PAGE

/* The runner loads the module so that a job without progress is late after this. */
#define TIMEOUT_MS 500

static struct client client, other;
static volatile uint32_t *window;

static void arm(uint32_t fault, uint32_t value)
{
	window[fault / 4] = value;
	assert_int_equal(window[fault / 4], value);
}

static uint64_t jobs_lost(const struct client *of)
{
	uint64_t lost;

	assert_int_equal(node_param(of->fd, DRM_GLOSS_PARAM_JOBS_LOST, &lost), 0);
	return lost;
}

static double now_ms(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void queue_all(struct client *of)
{
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		assert_int_equal(client_queue(of, n), 0);
}

/* The jobs of @of that did not end with 0; they have to have ended with @error. */
static int count_failed(struct client *of, int error)
{
	int failed = 0;

	for (uint32_t n = 0; n < CLIENT_QUEUE; n++) {
		int err = client_queue_wait(of, n);

		if (err) {
			assert_int_equal(err, error);
			failed++;
		}
	}
	return failed;
}

/* ---- a core that hangs ---- */

static void a_hung_core_fails_the_guilty_job_alone(void **state)
{
	double start = now_ms();

	(void)state;
	vm_expect("gloss ");
	arm(VBOARD_FAULT_HANG, 1);
	queue_all(&client);
	queue_all(&other);
	assert_int_equal(client_queue_wait(&client, 0), -EIO);
	assert_true(now_ms() - start >= TIMEOUT_MS / 2);
	assert_int_equal(count_failed(&client, -EIO), 1);
	assert_int_equal(count_failed(&other, -EIO), 0);
	vm_expect_end();
	assert_int_equal(jobs_lost(&client), 1);
	assert_int_equal(jobs_lost(&other), 0);
}

/* Jobs before and behind it are both in the ring. */
static void a_core_that_hangs_late_fails_one_job(void **state)
{
	(void)state;
	vm_expect("gloss ");
	arm(VBOARD_FAULT_HANG, CLIENT_QUEUE + 2);
	queue_all(&client);
	queue_all(&other);
	assert_int_equal(count_failed(&client, -EIO) + count_failed(&other, -EIO), 1);
	vm_expect_end();
	assert_int_equal(jobs_lost(&client) + jobs_lost(&other), 1);
}

static void hangs_one_after_the_other_are_recovered_from(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		vm_expect("gloss ");
		arm(VBOARD_FAULT_HANG, 1);
		assert_int_equal(client_run(&client, 0, 0), -EIO);
		assert_int_equal(client.status->error, -EIO);
		vm_expect_end();
		assert_true(client_works(&other));
	}
	assert_int_equal(jobs_lost(&client), 3);
}

static void board_memory_survives_a_hang(void **state)
{
	const uint32_t value = 0x5ca1ab1e;

	(void)state;
	assert_int_equal(client_run(&other, node_write(other.stream, 0, 64, &value, 1), 0), 0);
	vm_expect("gloss ");
	arm(VBOARD_FAULT_HANG, 1);
	assert_int_equal(client_run(&client, 0, 0), -EIO);
	vm_expect_end();
	assert_int_equal(client_run(&other, node_read(other.stream, 0, 64, 1), 1), 0);
	assert_int_equal(other.response[0], value);
}

/* ---- a host that refuses DMA ---- */

/* Runs a job whose @n-th access is refused; false: it had fewer. */
static bool refuse_access(uint32_t n)
{
	const uint32_t value = 7;
	uint32_t words = node_write(client.stream, 0, 0, &value, 1);
	int err;

	words += node_read(client.stream + words, 0, 0, 1);
	arm(VBOARD_FAULT_REFUSE_DMA, n);
	err = client_run(&client, words, 1);
	arm(VBOARD_FAULT_REFUSE_DMA, 0);
	assert_int_equal(client.status->error, err);
	assert_true(err == 0 || err == -EIO);
	return err;
}

static void a_refused_access_fails_the_job_that_made_it(void **state)
{
	double fastest = 1e9, start = now_ms();
	uint32_t n = 1;

	(void)state;
	vm_expect("gloss ");
	while (refuse_access(n)) {
		assert_true(client_works(&other));
		assert_true(client_works(&client));
		fastest = fmin(fastest, now_ms() - start);
		start = now_ms();
		n++;
	}
	vm_expect_end();
	/* At least the descriptor, a list, the stream, the response and the completion. */
	assert_in_range(n, 6, 100);
	assert_int_equal(jobs_lost(&other), 0);
	/* The board says so, there is nothing to be waited for; a busy machine may be slow at times. */
	assert_true(fastest < TIMEOUT_MS);
}

static void a_refused_access_leaves_queued_jobs_alone(void **state)
{
	(void)state;
	vm_expect("gloss ");
	arm(VBOARD_FAULT_REFUSE_DMA, 20);
	queue_all(&client);
	queue_all(&other);
	assert_int_equal(count_failed(&client, -EIO) + count_failed(&other, -EIO), 1);
	arm(VBOARD_FAULT_REFUSE_DMA, 0);
	vm_expect_end();
}

/* ---- interrupts and writes ---- */

/* What debugfs counts behind @name. */
static int count(const char *name)
{
	char path[128], text[2048] = "";
	const char *at;
	FILE *file;

	snprintf(path, sizeof(path), "/sys/kernel/debug/dri/%d/ring",
		 board_minor(vm_env("GLOSS_PCI_MODEL")));
	file = fopen(path, "r");
	assert_non_null(file);
	assert_in_range(fread(text, 1, sizeof(text) - 1, file), 1, sizeof(text));
	fclose(file);
	at = strstr(text, name);
	assert_non_null(at);
	return atoi(at + strlen(name));
}

static void a_lost_interrupt_costs_time_and_no_job(void **state)
{
	int resets = count("resets "), lost = count("lost interrupts ");

	(void)state;
	vm_expect("gloss ");
	for (int n = 0; n < 3; n++) {
		double start = now_ms();

		arm(VBOARD_FAULT_LOSE_INTERRUPTS, 1);
		assert_true(client_works(&client));
		assert_int_equal(window[VBOARD_FAULT_LOSE_INTERRUPTS / 4], 0);
		assert_true(now_ms() - start >= TIMEOUT_MS / 4);
	}
	vm_expect_end();
	assert_int_equal(count("lost interrupts "), lost + 3);
	assert_int_equal(count("resets "), resets);
	assert_int_equal(jobs_lost(&client), 0);
}

/* The next job's interrupt tells of the one before as well. */
static void a_lost_interrupt_among_others_costs_nothing(void **state)
{
	double fastest = 1e9;

	(void)state;
	arm(VBOARD_FAULT_SLOW, 5000);
	for (int n = 0; n < 10 && fastest >= TIMEOUT_MS - 50; n++) {
		double start = now_ms();

		arm(VBOARD_FAULT_LOSE_INTERRUPTS, 1);
		queue_all(&client);
		assert_int_equal(count_failed(&client, 0), 0);
		assert_int_equal(window[VBOARD_FAULT_LOSE_INTERRUPTS / 4], 0);
		fastest = fmin(fastest, now_ms() - start);
	}
	assert_true(fastest < TIMEOUT_MS - 50);
}

/* Without an interrupt too many: rung by nobody's job, it finds nothing to do. */
static void an_interrupt_without_a_job_is_harmless(void **state)
{
	(void)state;
	for (int n = 0; n < 10; n++)
		window[VBOARD_FAULT_DOORBELL / 4] = 1;
	assert_true(client_works(&client));
}

static void late_register_writes_are_waited_for(void **state)
{
	int before = count("resets ");

	(void)state;
	for (uint32_t late = 50; late <= 20000; late *= 20) {
		arm(VBOARD_FAULT_DELAY_WRITES, late);
		queue_all(&client);
		queue_all(&other);
		assert_int_equal(count_failed(&client, 0), 0);
		assert_int_equal(count_failed(&other, 0), 0);
	}
	assert_int_equal(count("resets "), before);
}

static void a_hang_with_late_register_writes_is_recovered_from(void **state)
{
	(void)state;
	vm_expect("gloss ");
	arm(VBOARD_FAULT_DELAY_WRITES, 3000);
	arm(VBOARD_FAULT_HANG, 1);
	assert_int_equal(client_run(&client, 0, 0), -EIO);
	queue_all(&other);
	assert_int_equal(count_failed(&other, 0), 0);
	vm_expect_end();
}

/* ---- jobs that take long ---- */

/* Together they take longer than the one that is late. */
static void slow_jobs_are_not_late(void **state)
{
	int before = count("resets ");

	(void)state;
	arm(VBOARD_FAULT_SLOW, 1000 * TIMEOUT_MS / 5);
	queue_all(&client);
	assert_int_equal(client_run(&other, 0, 0), 0);
	assert_int_equal(count_failed(&client, 0), 0);
	assert_int_equal(count("resets "), before);
	assert_int_equal(jobs_lost(&client), 0);
}

/* Runs a job of @room bytes to its right end; for how long, in milliseconds. */
static int long_job(uint32_t room)
{
	struct node_buffer buffer;
	struct client_job job;
	double start;
	int took;

	assert_int_equal(node_buffer_new(client.fd, room, &buffer), 0);
	client_prepare(&client, &job, 1, 0);
	job.submit.stream = buffer.handle;
	job.submit.stream_words = node_long(buffer.map, room / 4);
	start = now_ms();
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	took = (int)(now_ms() - start);
	assert_int_equal(client.status->offset, job.submit.stream_words);
	node_buffer_free(client.fd, &buffer);
	return took;
}

/* How long is enough work for that hangs on the machine. */
static void a_long_job_that_proceeds_is_not_late(void **state)
{
	enum { ROOM = 24 << 20, ROOM_MAX = 192 << 20 };
	uint32_t room = ROOM;
	int took;

	(void)state;
	while ((took = long_job(room)) < 2 * TIMEOUT_MS && room < ROOM_MAX)
		room *= 2;
	print_message("the long job of %u bytes took %d ms\n", room, took);
	assert_true(took >= 2 * TIMEOUT_MS);
	assert_int_equal(jobs_lost(&client), 0);
}

/* ---- set up ---- */

static int setup(void **state)
{
	(void)state;
	window = vm_faults("GLOSS_PCI_MODEL");
	assert_int_equal(window[VBOARD_FAULT_IDENTITY / 4], VBOARD_FAULT_IDENTITY_VALUE);
	return 0;
}

static int open_files(void **state)
{
	(void)state;
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES), 0);
	assert_int_equal(client_open(&other, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES), 0);
	/* Both, so that the jobs which clear their memory are not among those that a test counts. */
	assert_true(client_works(&client));
	assert_true(client_works(&other));
	return 0;
}

static int close_files(void **state)
{
	static const uint32_t faults[] = {
		VBOARD_FAULT_DELAY_WRITES, VBOARD_FAULT_LOSE_INTERRUPTS,
		VBOARD_FAULT_HANG,         VBOARD_FAULT_REFUSE_DMA,
		VBOARD_FAULT_SLOW,
	};

	(void)state;
	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++)
		window[faults[i] / 4] = 0;
	assert_true(client_works(&client));
	assert_true(client_works(&other));
	assert_int_equal(window[VBOARD_FAULT_BUS_MASTER_ERRORS / 4], 0);
	client_close(&client);
	client_close(&other);
	return 0;
}

#define fault_test(name) cmocka_unit_test_setup_teardown(name, open_files, close_files)

int main(void)
{
	const struct CMUnitTest tests[] = {
		fault_test(a_hung_core_fails_the_guilty_job_alone),
		fault_test(a_core_that_hangs_late_fails_one_job),
		fault_test(hangs_one_after_the_other_are_recovered_from),
		fault_test(board_memory_survives_a_hang),
		fault_test(a_refused_access_fails_the_job_that_made_it),
		fault_test(a_refused_access_leaves_queued_jobs_alone),
		fault_test(a_lost_interrupt_costs_time_and_no_job),
		fault_test(a_lost_interrupt_among_others_costs_nothing),
		fault_test(an_interrupt_without_a_job_is_harmless),
		fault_test(late_register_writes_are_waited_for),
		fault_test(a_hang_with_late_register_writes_is_recovered_from),
		fault_test(slow_jobs_are_not_late),
		fault_test(a_long_job_that_proceeds_is_not_late),
	};

	return cmocka_run_group_tests(tests, setup, NULL);
}
