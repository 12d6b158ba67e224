/* SPDX-License-Identifier: MIT */
/* The engine with a board that does what the test says. */
#define _GNU_SOURCE
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include "accel_test.h"
#include "transport/engine.h"

#define PAGE 4096u

/* A board that stops at each job until it is let go, and answers with the job's first word. */
struct board {
	struct accel_engine engine;
	pthread_mutex_t lock;
	pthread_cond_t changed;
	int allowed, ran;
	uint32_t order[64];
	int error; /* of the next jobs */
};

static int board_run(void *data, const struct accel_job *job, struct gloss_status *status)
{
	struct board *board = data;

	pthread_mutex_lock(&board->lock);
	while (board->ran >= board->allowed)
		pthread_cond_wait(&board->changed, &board->lock);
	board->order[board->ran++ % 64] = job->stream_words ? job->stream[0] : 0;
	*status = (struct gloss_status){ .offset = job->stream_words };
	if (job->response_words)
		job->response[0] = job->slot[0].base + job->slot[0].size;
	pthread_mutex_unlock(&board->lock);
	return board->error;
}

static void board_allow(struct board *board, int jobs)
{
	pthread_mutex_lock(&board->lock);
	board->allowed += jobs;
	pthread_cond_broadcast(&board->changed);
	pthread_mutex_unlock(&board->lock);
}

static int setup(void **state)
{
	static struct board board;

	board = (struct board){ .allowed = 0 };
	pthread_mutex_init(&board.lock, NULL);
	pthread_cond_init(&board.changed, NULL);
	*state = &board;
	return accel_engine_init(&board.engine, 64 * PAGE, board_run, &board);
}

static int teardown(void **state)
{
	struct board *board = *state;

	board_allow(board, 1000);
	accel_engine_fini(&board->engine);
	pthread_cond_destroy(&board->changed);
	pthread_mutex_destroy(&board->lock);
	return 0;
}

static uint64_t submit(struct board *board, uint32_t word)
{
	const struct accel_transport_job job = { .stream = &word, .stream_words = 1 };
	uint64_t sequence;

	assert_int_equal(accel_engine_submit(&board->engine, &job, &sequence), 0);
	return sequence;
}

static void jobs_run_in_order_and_are_waited_for_in_any(void **state)
{
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence[8];
	uint32_t i;

	for (i = 0; i < 8; i++)
		sequence[i] = submit(board, i);
	board_allow(board, 8);
	for (i = 8; i-- > 0;)
		assert_int_equal(accel_engine_wait(board, sequence[i ^ 3], -1, &status), 0);
	for (i = 0; i < 8; i++)
		assert_int_equal(board->order[i], i);
	sequence[0] = submit(board, 99);
	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence[0], -1, &status), 0);
	assert_int_equal(board->order[8], 99);
}

static void a_wait_for_a_running_job_times_out(void **state)
{
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence = submit(board, 1);

	assert_int_equal(accel_engine_wait(board, sequence, 0, &status), -ETIMEDOUT);
	assert_int_equal(accel_engine_wait(board, sequence, 20000000, &status), -ETIMEDOUT);
	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence, INT64_MAX, &status), 0);
	assert_int_equal(status.offset, 1);
}

static void a_job_is_waited_for_once(void **state)
{
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence = submit(board, 1);

	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence, -1, &status), 0);
	assert_int_equal(accel_engine_wait(board, sequence, -1, &status), -EINVAL);
	assert_int_equal(accel_engine_wait(board, sequence + 1, -1, &status), -EINVAL);
}

static void a_failed_board_takes_the_next_job(void **state)
{
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence;

	board->error = -ETIME;
	sequence = submit(board, 1);
	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence, -1, &status), -EIO);
	board->error = 0;
	sequence = submit(board, 2);
	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence, -1, &status), 0);
}

static void the_stream_is_copied(void **state)
{
	uint32_t word = 5;
	const struct accel_transport_job job = { .stream = &word, .stream_words = 1 };
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence;

	assert_int_equal(accel_engine_submit(board, &job, &sequence), 0);
	word = 6;
	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence, -1, &status), 0);
	assert_int_equal(board->order[0], 5);
}

static size_t allocated(void)
{
	struct mallinfo2 info = mallinfo2();

	return info.uordblks + info.hblkhd;
}

/* The sanitizers have another malloc, of which this knows nothing. */
static void streams_of_ended_jobs_are_gone_before_they_are_waited_for(void **state)
{
	static uint32_t words[1 << 16];
	const struct accel_transport_job job = { .stream = words, .stream_words = 1 << 16 };
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence[64];
	size_t before = allocated();

	for (int i = 0; i < 64; i++)
		assert_int_equal(accel_engine_submit(board, &job, &sequence[i]), 0);
	board_allow(board, 64);
	assert_int_equal(accel_engine_wait(board, sequence[63], -1, &status), 0);
	assert_true(allocated() < before + sizeof(words));
	for (int i = 0; i < 63; i++)
		assert_int_equal(accel_engine_wait(board, sequence[i], -1, &status), 0);
}

static void *wait_for_room(void *data)
{
	accel_engine_wait_for_room(data);
	return NULL;
}

static void what_is_queued_is_bounded(void **state)
{
	const uint32_t count = ENGINE_QUEUED_MAX / 4 / 2;
	uint32_t *words = calloc(count, sizeof(*words));
	const struct accel_transport_job job = { .stream = words, .stream_words = count };
	struct gloss_status status;
	struct board *board = *state;
	uint64_t sequence[2];
	pthread_t thread;

	for (int i = 0; i < 2; i++) {
		accel_engine_wait_for_room(board);
		assert_int_equal(accel_engine_submit(board, &job, &sequence[i]), 0);
	}
	assert_int_equal(pthread_create(&thread, NULL, wait_for_room, board), 0);
	usleep(20000);
	assert_int_equal(pthread_tryjoin_np(thread, NULL), EBUSY);
	board_allow(board, 1);
	pthread_join(thread, NULL);
	board_allow(board, 1);
	for (int i = 0; i < 2; i++)
		assert_int_equal(accel_engine_wait(board, sequence[i], -1, &status), 0);
	free(words);
}

static void a_slot_is_as_large_as_was_asked_for(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ };
	uint32_t response;
	struct accel_transport_job job = {
		.slot = &slot,
		.slots = 1,
		.response = &response,
		.response_words = 1,
	};
	struct gloss_status status;
	struct board *board = *state;
	uint64_t first, sequence;

	assert_int_equal(accel_engine_memory_new(board, 8, &first), 0);
	assert_int_equal(accel_engine_memory_new(board, 12, &slot.object), 0);
	assert_int_equal(accel_engine_submit(board, &job, &sequence), 0);
	board_allow(board, 1);
	assert_int_equal(accel_engine_wait(board, sequence, -1, &status), 0);
	assert_int_equal(response, PAGE + 12);
	accel_engine_memory_free(board, slot.object);
	accel_engine_memory_free(board, first);
}

static void a_job_with_an_unknown_object_is_refused(void **state)
{
	const struct accel_transport_slot slot = { .object = 1, .rights = GLOSS_RIGHTS_READ };
	struct accel_transport_job job = { .slot = &slot, .slots = 1 };
	struct board *board = *state;
	uint64_t sequence;

	assert_int_equal(accel_engine_submit(board, &job, &sequence), -EINVAL);
	job.slots = GLOSS_SLOTS + 1;
	assert_int_equal(accel_engine_submit(board, &job, &sequence), -EINVAL);
}

static void memory_is_zero_when_it_changes_hands(void **state)
{
	struct board *board = *state;
	uint8_t *memory = board->engine.memory;
	uint64_t object, i, before;

	assert_int_equal(accel_engine_memory_new(board, PAGE, &before), 0);
	memset(memory + before, 0x11, PAGE);
	assert_int_equal(accel_engine_memory_new(board, PAGE + 100, &object), 0);
	memset(memory + object, 0x5a, PAGE + 100);
	accel_engine_memory_free(board, object);
	assert_int_equal(accel_engine_memory_new(board, 2 * PAGE, &object), 0);
	for (i = 0; i < 2 * PAGE; i++)
		assert_int_equal(memory[object + i], 0);
	assert_int_equal(memory[before + PAGE - 1], 0x11);
}

static void the_end_runs_what_is_queued(void **state)
{
	struct board *board = *state;

	submit(board, 1);
	submit(board, 2);
	board_allow(board, 2);
	accel_engine_fini(&board->engine);
	assert_int_equal(board->ran, 2);
	assert_int_equal(accel_engine_init(&board->engine, PAGE, board_run, board), 0);
}

static void *wait_for_one(void *argument)
{
	void **of = argument;
	struct gloss_status status;

	return (void *)(intptr_t)accel_engine_wait(of[0], (uint64_t)(uintptr_t)of[1], -1, &status);
}

static void many_threads_wait_while_another_submits(void **state)
{
	struct board *board = *state;
	void *argument[16][2], *result;
	pthread_t thread[16];
	uint32_t i;

	for (i = 0; i < 16; i++) {
		argument[i][0] = board;
		argument[i][1] = (void *)(uintptr_t)submit(board, i);
		pthread_create(&thread[i], NULL, wait_for_one, argument[i]);
		if (i % 2)
			board_allow(board, 2);
	}
	for (i = 0; i < 16; i++) {
		pthread_join(thread[i], &result);
		assert_null(result);
	}
}

static volatile sig_atomic_t signalled_thread_is_main;
static pthread_t main_thread;

static void on_signal(int number)
{
	(void)number;
	/* NOLINTNEXTLINE(bugprone-signal-handler): it compares two numbers */
	signalled_thread_is_main = pthread_equal(pthread_self(), main_thread) != 0;
}

/* With the signal blocked here, it would go to the engine's thread if that took any. */
static void signals_stay_with_the_program(void **state)
{
	sigset_t usr1, old, pending;

	(void)state;
	main_thread = pthread_self();
	signal(SIGUSR1, on_signal);
	sigemptyset(&usr1);
	sigaddset(&usr1, SIGUSR1);
	pthread_sigmask(SIG_BLOCK, &usr1, &old);
	kill(getpid(), SIGUSR1);
	usleep(20000);
	sigpending(&pending);
	assert_true(sigismember(&pending, SIGUSR1));
	pthread_sigmask(SIG_SETMASK, &old, NULL);
	assert_true(signalled_thread_is_main);
}

#define engine_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		engine_test(jobs_run_in_order_and_are_waited_for_in_any),
		engine_test(a_wait_for_a_running_job_times_out),
		engine_test(a_job_is_waited_for_once),
		engine_test(a_failed_board_takes_the_next_job),
		engine_test(the_stream_is_copied),
		engine_test(streams_of_ended_jobs_are_gone_before_they_are_waited_for),
		engine_test(what_is_queued_is_bounded),
		engine_test(a_slot_is_as_large_as_was_asked_for),
		engine_test(a_job_with_an_unknown_object_is_refused),
		engine_test(memory_is_zero_when_it_changes_hands),
		engine_test(the_end_runs_what_is_queued),
		engine_test(many_threads_wait_while_another_submits),
		engine_test(signals_stay_with_the_program),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
