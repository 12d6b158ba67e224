/* SPDX-License-Identifier: MIT */
/* A board on USB that fails: what its jobs are told, that the next one is right, and when the
 * library gives up. */
#include <poll.h>
#include <sched.h>

#include "transport/usb/checksum.h"
#include "usb_test.h"

#define NS_PER_MS 1000000ll
#define WORDS 3000u

/* ---- a board between whose words and registers a test puts others ---- */

/* Set while the board is looked at by the thread of the link. */
static struct {
	_Atomic uint32_t progress, step; /* of PROGRESS, at each read */
	_Atomic unsigned int reads;      /* of it; before so many the board takes nothing */
	_Atomic unsigned int reads_to_work;
	_Atomic unsigned int completions;                    /* yet to come before one is a fault */
	_Atomic uint32_t forged[GLOSS_USB_COMPLETION_WORDS]; /* to come before all others */
	unsigned int left; /* words yet to come of the completion that is a fault */
	uint32_t checksum; /* of those before them: its job has no response */
} odd;

static uint32_t odd_read(struct gloss_usb_board *board, uint32_t offset)
{
	if (offset != GLOSS_REG_PROGRESS || !odd.step)
		return gloss_usb_board_model_t64.read(board, offset);
	odd.reads++;
	odd.progress += odd.step;
	return odd.progress;
}

/* A reset is to help. */
static void odd_write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL)
		odd.reads_to_work = 0;
	gloss_usb_board_model_t64.write(board, offset, value);
}

static uint32_t odd_out(struct gloss_usb_board *board, const uint32_t *words, uint32_t count)
{
	if (odd.reads < odd.reads_to_work)
		return 0;
	return gloss_usb_board_model_t64.out(board, words, count);
}

/* Makes the completion a fault that is due, with the checksum that it then has. */
static uint32_t odd_word(uint32_t word)
{
	if (odd.left && !--odd.left)
		return odd.checksum;
	if (word == GLOSS_USB_COMPLETION_MAGIC << 16 && odd.completions && !--odd.completions) {
		word |= GLOSS_FAULT_MEMORY;
		odd.left = GLOSS_USB_COMPLETION_WORDS - 1;
		odd.checksum = 0;
	}
	odd.checksum = accel_usb_checksum(odd.checksum, &word, 1);
	return word;
}

static uint32_t odd_in(struct gloss_usb_board *board, uint32_t *words, uint32_t room, bool *flush)
{
	uint32_t count;

	if (odd.forged[0] && room >= GLOSS_USB_COMPLETION_WORDS) {
		for (int i = 0; i < GLOSS_USB_COMPLETION_WORDS; i++)
			words[i] = odd.forged[i];
		odd.forged[0] = 0;
		*flush = false;
		return GLOSS_USB_COMPLETION_WORDS;
	}
	count = gloss_usb_board_model_t64.in(board, words, room, flush);
	for (uint32_t i = 0; i < count; i++)
		words[i] = odd_word(words[i]);
	return count;
}

static int odd_setup(void **state)
{
	static struct gloss_usb_board_ops board;
	struct accel_transport_error error = { "" };

	odd.step = odd.reads = odd.reads_to_work = odd.completions = odd.forged[0] = 0;
	odd.left = 0;
	board = gloss_usb_board_model_t64;
	board.read = odd_read;
	board.write = odd_write;
	board.out = odd_out;
	board.in = odd_in;
	fake_usb_start(test_seed());
	fake_usb_unplug(0);
	fake_usb.board[0].ops = &board;
	fake_usb_plug(0, true);
	return ops->open("", state, &error);
}

#define odd_test(name) cmocka_unit_test_setup_teardown(name, odd_setup, usb_teardown)

/* ---- what all can do ---- */

static void write_words(void *state, uint64_t object)
{
	const struct accel_transport_slot slot = { object, GLOSS_RIGHTS_WRITE };
	uint32_t stream[3 + 1000];
	const struct accel_transport_job job = {
		.stream = stream, .stream_words = 3 + 1000, .slot = &slot, .slots = 1
	};
	struct gloss_status status;

	for (uint32_t at = 0; at < WORDS; at += 1000) {
		const struct gloss_write_memory write = { .slot = 0, .offset = 4 * at };

		gloss_write_memory_pack(stream, &write, 2 + 1000);
		for (uint32_t i = 0; i < 1000; i++)
			stream[3 + i] = at + i + 1;
		run(state, &job, &status);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	}
}

static uint64_t object_with_words(void *state)
{
	uint64_t object;

	assert_int_equal(ops->memory_new(state, 4 * WORDS, &object), 0);
	write_words(state, object);
	return object;
}

static void assert_words(void *state, uint64_t object)
{
	uint32_t words[WORDS];

	assert_int_equal(read_words(state, object, words, WORDS), 0);
	for (uint32_t i = 0; i < WORDS; i++)
		assert_int_equal(words[i], i + 1);
}

/* ---- failures that pass ---- */

static void check_fault(void *state, uint64_t object, enum fake_usb_fault fault, uint32_t value)
{
	unsigned int resets = fake_usb.resets;
	uint32_t words[WORDS];
	int err;

	fake_usb_arm(0, fault, 1, value);
	err = read_words(state, object, words, WORDS);
	if (err != -EIO)
		fail_msg("%s: %s", fake_usb_fault_name(fault), strerror(-err));
	run_empty(state);
	fake_usb_disarm();
	assert_words(state, object);
	assert_int_equal(fake_usb.resets, resets + 1);
}

static void a_job_that_fails_is_told_and_the_next_is_right(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
	} faults[] = {
		{ FAKE_USB_STALL_OUT, 0 },   { FAKE_USB_STALL_IN, 0 },    { FAKE_USB_ERROR_OUT, 0 },
		{ FAKE_USB_ERROR_IN, 0 },    { FAKE_USB_OVERFLOW_IN, 0 }, { FAKE_USB_LOSE_OUT, 0 },
		{ FAKE_USB_LOSE_IN, 0 },     { FAKE_USB_REPEAT_IN, 0 },   { FAKE_USB_ODD_IN, 0 },
		{ FAKE_USB_GARBAGE_IN, 15 }, { FAKE_USB_GARBAGE_OUT, 0 }, { FAKE_USB_HANG_IN, 0 },
		{ FAKE_USB_HANG_OUT, 0 },
	};
	uint64_t object = object_with_words(*state);

	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++)
		check_fault(*state, object, faults[i].fault, faults[i].value);
	ops->memory_free(*state, object);
}

static void check_garbage(void *state, uint64_t object, enum fake_usb_fault fault, uint64_t at)
{
	uint32_t words[WORDS];
	int err;

	fake_usb_arm(0, fault, at, 0);
	err = read_words(state, object, words, WORDS);
	if (err != -EIO)
		fail_msg("%s at %llu: %s", fake_usb_fault_name(fault), (unsigned long long)at,
			 strerror(-err));
	fake_usb_disarm();
	assert_words(state, object);
}

/* Also where the words are the caller's. */
static void a_wrong_word_anywhere_is_found(void **state)
{
	const uint64_t out_words = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS + 3 +
				   GLOSS_USB_JOB_END_WORDS;
	const uint64_t in_words = WORDS +
				  (WORDS + GLOSS_USB_CHUNK_WORDS - 1) / GLOSS_USB_CHUNK_WORDS +
				  GLOSS_USB_COMPLETION_WORDS;
	uint64_t object = object_with_words(*state), seed = test_seed();

	for (uint64_t at = 1; at <= out_words; at++)
		check_garbage(*state, object, FAKE_USB_GARBAGE_OUT, at);
	for (uint64_t at = 1; at <= in_words; at += 1 + test_below(&seed, 100))
		check_garbage(*state, object, FAKE_USB_GARBAGE_IN, at);
	for (uint64_t n = 0; n < GLOSS_USB_COMPLETION_WORDS; n++)
		check_garbage(*state, object, FAKE_USB_GARBAGE_IN, in_words - n);
	ops->memory_free(*state, object);
}

static void a_wrong_word_to_be_written_is_found(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_WRITE };
	uint32_t stream[3 + WORDS / 3] = { 0 };
	const struct accel_transport_job job = {
		.stream = stream, .stream_words = 3 + WORDS / 3, .slot = &slot, .slots = 1
	};
	const uint64_t before = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS + 3;
	uint64_t seed = test_seed();
	struct gloss_status status;

	gloss_write_memory_pack(stream, &(struct gloss_write_memory){ .slot = 0 }, 2 + WORDS / 3);
	slot.object = object_with_words(*state);
	for (int n = 0; n < 50; n++) {
		fake_usb_arm(0, FAKE_USB_GARBAGE_OUT, before + 1 + test_below(&seed, WORDS / 3), 0);
		assert_int_equal(wait_for(*state, submit(*state, &job), &status), -EIO);
		run(*state, &job, &status);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	}
	ops->memory_free(*state, slot.object);
}

static void what_the_protocol_allows_is_no_failure(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
	} faults[] = {
		{ FAKE_USB_SHORT_IN, 0 },      { FAKE_USB_EMPTY_IN, 1 },
		{ FAKE_USB_EMPTY_IN, 100 },    { FAKE_USB_STALL_EVENT, 0 },
		{ FAKE_USB_GARBAGE_EVENT, 0 }, { FAKE_USB_DELAY, 300000 },
	};
	uint64_t object = object_with_words(*state);

	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++) {
		fake_usb_arm(0, faults[i].fault, 1, faults[i].value);
		assert_words(*state, object);
		fake_usb_disarm();
	}
	assert_int_equal(fake_usb.resets, 1);
	ops->memory_free(*state, object);
}

static void every_job_that_is_outstanding_fails_and_is_forgotten(void **state)
{
	struct gloss_status status;
	uint64_t sequence[20];

	fake_usb_hold();
	for (int i = 0; i < 20; i++)
		sequence[i] = submit_empty(*state);
	fake_usb_arm(0, FAKE_USB_HANG_IN, 1, 0);
	fake_usb_release();
	for (int i = 19; i >= 0; i--) {
		assert_int_equal(wait_for(*state, sequence[i], &status), -EIO);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
		assert_int_equal(status.response_words, 0);
		assert_int_equal(ops->wait(*state, sequence[i], -1, &status), -EINVAL);
	}
	run_empty(*state);
}

static void every_thread_that_waits_is_told(void **state)
{
	struct waiter waiter[8];

	fake_usb_hold();
	start_waiters(*state, waiter, 8);
	fake_usb_arm(0, FAKE_USB_STALL_IN, 1, 0);
	fake_usb_release();
	join_waiters(waiter, 8, -EIO);
	run_empty(*state);
}

/* ---- time ---- */

struct instant {
	int64_t now, leapt;
};

static struct instant instant(void)
{
	return (struct instant){ fake_usb_now_ns(), fake_usb_leapt_ns() };
}

/* At most so much of the time that leapt, while all waited: what else passes is the machine's. */
static void assert_took_ms(struct instant since, int64_t least, int64_t most)
{
	assert_true(fake_usb_now_ns() - since.now >= least * NS_PER_MS);
	assert_in_range(fake_usb_leapt_ns() - since.leapt, 0, most * NS_PER_MS);
}

static void a_board_that_stands_still_is_given_two_seconds(void **state)
{
	struct gloss_status status;
	struct instant before;

	fake_usb_arm(0, FAKE_USB_HANG_IN, 1, 0);
	before = instant();
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
	assert_took_ms(before, 1900, 3500);
}

/* Nothing comes of its transfers, so the thread, which sleeps, is to be woken. */
static void a_board_that_stands_still_after_a_long_rest_is_given_no_more(void **state)
{
	struct gloss_status status;
	struct instant before = instant();

	fake_usb_rest(5000);
	fake_usb_arm(0, FAKE_USB_HANG_OUT, 1, 0);
	before = instant();
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
	assert_took_ms(before, 1900, 3500);
}

/* They do not end with a reset either. */
static void transfers_without_a_word_are_no_progress(void **state)
{
	struct gloss_status status;
	struct instant before = instant();

	fake_usb_arm(0, FAKE_USB_EMPTY_IN, 1, UINT32_MAX);
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -ENODEV);
	assert_took_ms(before, 1900, 15000);
	fake_usb_disarm();
}

/* It says so itself, so it needs not be waited for; whatever events there were before. */
static void a_board_that_is_lost_is_given_no_time(void **state)
{
	static const uint32_t stream[] = { 0xff000000 };
	const struct accel_transport_job job = { .stream = stream, .stream_words = 1 };
	static const uint64_t at[] = { 1, GLOSS_USB_JOB_WORDS + GLOSS_USB_JOB_END_WORDS };
	struct gloss_status status;

	for (size_t n = 0; n < sizeof(at) / sizeof(at[0]); n++) {
		struct instant before = instant();

		for (int i = 0; i < 10; i++)
			run(*state, &job, &status);
		fake_usb_arm(0, FAKE_USB_GARBAGE_OUT, at[n], 0);
		assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
		assert_took_ms(before, 0, 1000);
		run_empty(*state);
	}
}

static void a_board_that_makes_progress_is_waited_for(void **state)
{
	static const uint32_t stream[1000];
	const struct accel_transport_job job = { .stream = stream, .stream_words = 1000 };
	struct gloss_status status;
	int64_t before = fake_usb_now_ns();

	odd.step = 1;
	odd.reads_to_work = 100;
	run(*state, &job, &status);
	assert_int_equal(status.offset, 1000);
	assert_true(fake_usb_now_ns() - before > 20000 * NS_PER_MS);
	assert_int_equal(fake_usb.resets, 1);
}

/* A register that runs wild is no work: a job has only so many words. */
static void a_board_that_makes_too_much_progress_is_not(void **state)
{
	static const uint32_t stream[1000];
	const struct accel_transport_job job = { .stream = stream, .stream_words = 1000 };
	struct gloss_status status;

	for (uint32_t step = 300; step; step = step == 300 ? 0x12345678 : 0) {
		odd.reads = 0;
		odd.step = step;
		odd.reads_to_work = 1000;
		assert_int_equal(wait_for(*state, submit(*state, &job), &status), -EIO);
		assert_in_range(odd.reads, 8, 20);
		run_empty(*state);
	}
}

/* ---- memory and failures ---- */

static void memory_whose_clearing_was_lost_is_cleared_again(void **state)
{
	uint32_t words[WORDS];
	unsigned int failed = 0;
	uint64_t object;
	int err;

	for (int i = 0; i < 5; i++) {
		assert_int_equal(ops->memory_new(*state, 4 * WORDS, &object), 0);
		for (int n = 0; n <= i; n++) {
			fake_usb_arm(0, n % 2 ? FAKE_USB_LOSE_OUT : FAKE_USB_ERROR_OUT, 1, 0);
			/* It may have failed, and been repeated, before there was a job that uses it. */
			err = read_words(*state, object, words, WORDS);
			assert_true(!err || err == -EIO);
			failed += err != 0;
		}
		assert_int_equal(read_words(*state, object, words, WORDS), 0);
		for (uint32_t n = 0; n < WORDS; n++)
			assert_int_equal(words[n], 0);
		write_words(*state, object);
		ops->memory_free(*state, object);
	}
	assert_true(failed);
}

struct submitter {
	pthread_t thread;
	void *state;
	uint64_t object;
	uint32_t words[WORDS];
	_Atomic bool started;
	int err;
};

static void *read_in_thread(void *data)
{
	struct submitter *submitter = data;
	const struct accel_transport_slot slot = { submitter->object, GLOSS_RIGHTS_READ };
	uint32_t stream[3];
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_read(stream, 0, 0, WORDS),
		.response = submitter->words,
		.response_words = WORDS,
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	uint64_t sequence;

	submitter->started = true;
	submitter->err = try_submit(submitter->state, &job, &sequence);
	if (!submitter->err)
		submitter->err = wait_for(submitter->state, sequence, &status);
	return NULL;
}

/* The clearing is lost while the job that needs it waits for its turn to be queued. */
static void memory_is_cleared_for_a_job_that_was_not_yet_queued(void **state)
{
	const uint32_t words = 2u << 20;
	uint32_t *stream = calloc(words, 4);
	struct submitter submitter = { .state = *state };
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ };
	struct accel_transport_job job = { .stream = stream,
					   .stream_words = words / 4,
					   .slot = &slot };
	struct gloss_status status;
	uint64_t sequence[2];

	assert_int_equal(ops->memory_new(*state, 4 * WORDS, &submitter.object), 0);
	slot.object = submitter.object;
	fake_usb_hold();
	sequence[0] = submit(*state, &job); /* keeps the cable busy */
	job.slots = 1;
	job.stream_words = words;
	sequence[1] = submit(*state, &job);
	assert_int_equal(pthread_create(&submitter.thread, NULL, read_in_thread, &submitter), 0);
	while (!submitter.started)
		sched_yield();
	poll(NULL, 0, 100);
	fake_usb_arm(0, FAKE_USB_ERROR_OUT, 1, 0);
	fake_usb_release();
	pthread_join(submitter.thread, NULL);
	for (int i = 0; i < 2; i++)
		assert_int_equal(wait_for(*state, sequence[i], &status), -EIO);
	assert_int_equal(submitter.err, 0);
	for (uint32_t n = 0; n < WORDS; n++)
		assert_int_equal(submitter.words[n], 0);
	ops->memory_free(*state, submitter.object);
	free(stream);
}

/* What was cleared is not cleared again, whatever comes. */
static void memory_keeps_its_words_over_a_failure(void **state)
{
	uint64_t object = object_with_words(*state);
	struct gloss_status status;

	for (int i = 0; i < 3; i++) {
		fake_usb_arm(0, FAKE_USB_ERROR_OUT, 1, 0);
		assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
		assert_words(*state, object);
	}
	ops->memory_free(*state, object);
}

static void memory_that_can_not_be_cleared_is_not_used(void **state)
{
	uint32_t words[WORDS];
	uint64_t object;
	int err;

	assert_int_equal(ops->memory_new(*state, 4 * WORDS, &object), 0);
	odd.completions = 1;
	/* 0: it was cleared again before there was a job that uses it. */
	err = read_words(*state, object, words, WORDS);
	assert_true(!err || err == -EIO);
	assert_int_equal(fake_usb.resets, 2);
	assert_int_equal(read_words(*state, object, words, WORDS), 0);
	for (uint32_t n = 0; n < WORDS; n++)
		assert_int_equal(words[n], 0);
	ops->memory_free(*state, object);
}

/* ---- a board that answers what it was not asked ---- */

static void a_job_can_not_end_before_it_is_sent(void **state)
{
	const uint32_t words = 2u << 20;
	uint32_t *stream = calloc(words, 4), forged[GLOSS_USB_COMPLETION_WORDS];
	const struct accel_transport_job job = { .stream = stream, .stream_words = words };
	struct gloss_status status;
	uint64_t sequence;

	fake_usb_hold();
	sequence = submit(*state, &job);
	gloss_usb_completion_pack(forged, &(struct gloss_usb_completion){
						  .mark = GLOSS_USB_COMPLETION_MAGIC,
						  .sequence = (uint32_t)sequence,
						  .offset = words });
	forged[GLOSS_USB_COMPLETION_CHECKSUM_WORD] = accel_usb_checksum(
		0, forged, GLOSS_USB_COMPLETION_CHECKSUM_WORD);
	for (int i = GLOSS_USB_COMPLETION_WORDS - 1; i >= 0; i--)
		odd.forged[i] = forged[i];
	fake_usb_release();
	assert_int_equal(wait_for(*state, sequence, &status), -EIO);
	run(*state, &job, &status);
	assert_int_equal(status.offset, words);
	free(stream);
}

/* ---- failures that do not pass ---- */

static void check_gone(void **state, struct waiter *waiter, int waiters)
{
	const struct accel_transport_job job = { .stream_words = 0 };
	struct accel_transport_error error = { "" };
	uint64_t sequence;

	join_waiters(waiter, waiters, -ENODEV);
	assert_int_equal(ops->submit(*state, &job, &sequence), -ENODEV);
	ops->close(*state);
	fake_usb_disarm();
	fake_usb_plug(0, true);
	assert_int_equal(ops->open("", state, &error), 0);
	run_empty(*state);
}

static void an_unplugged_board_ends_every_wait_and_call(void **state)
{
	struct waiter waiter[8];

	for (int i = 0; i < 20; i++) {
		fake_usb_hold();
		start_waiters(*state, waiter, 8);
		fake_usb_unplug(0);
		fake_usb_release();
		check_gone(state, waiter, 8);
	}
}

static void an_unplugged_board_is_noticed_without_a_job(void **state)
{
	struct accel_transport_job job = { .stream_words = 0 };
	struct gloss_status status;
	uint64_t sequence;
	int err = 0;

	fake_usb_unplug(0);
	while (!err) {
		err = ops->submit(*state, &job, &sequence);
		if (!err)
			assert_int_equal(wait_for(*state, sequence, &status), -ENODEV);
	}
	check_gone(state, NULL, 0);
}

/* Whatever of a new start fails, and three times: not more, and not without end. */
static void a_board_that_does_not_start_again_is_gone(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
	} faults[] = {
		{ FAKE_USB_REFUSE_CONTROL, 1000 },
		{ FAKE_USB_HANG_CONTROL, 1000 },
		{ FAKE_USB_RESET_LASTS, UINT32_MAX },
	};
	struct waiter waiter[4];

	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++) {
		unsigned int resets = fake_usb.resets;

		fake_usb_hold();
		start_waiters(*state, waiter, 4);
		fake_usb_arm(0, faults[i].fault, 1, faults[i].value);
		fake_usb_arm(0, FAKE_USB_ERROR_IN, 1, 0);
		fake_usb_release();
		check_gone(state, waiter, 4);
		assert_in_range(fake_usb.resets - resets, 1, 4);
	}
}

static void a_start_that_fails_twice_is_tried_again(void **state)
{
	struct gloss_status status;

	fake_usb_arm(0, FAKE_USB_ERROR_IN, 1, 0);
	fake_usb_arm(0, FAKE_USB_REFUSE_CONTROL, 1, 1);
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
	run_empty(*state);
}

static void a_board_may_be_closed_while_it_starts_again(void **state)
{
	struct accel_transport_error error = { "" };
	struct gloss_status status;
	uint64_t sequence;

	for (int i = 0; i < 20; i++) {
		fake_usb_arm(0, i % 2 ? FAKE_USB_HANG_IN : FAKE_USB_STALL_IN, 1, 0);
		sequence = submit_empty(*state);
		fake_usb_arm(0, FAKE_USB_HANG_IN, 1, 0);
		assert_int_equal(wait_for(*state, sequence, &status), -EIO);
		ops->close(*state);
		fake_usb_disarm();
		assert_int_equal(ops->open("", state, &error), 0);
		run_empty(*state);
	}
}

/* ---- a host before this one ---- */

static void remains_of_another_host_do_no_harm(void **state)
{
	static const uint32_t stream[100000];
	const struct accel_transport_job job = { .stream = stream, .stream_words = 100000 };
	struct accel_transport_error error = { "" };
	struct gloss_status status;
	uint64_t sequence;

	for (int i = 0; i < 10; i++) {
		fake_usb_arm(0, FAKE_USB_KILL, 1 + (uint64_t)i * 37, 1);
		sequence = submit(*state, &job);
		assert_int_equal(wait_for(*state, sequence, &status), -ENODEV);
		ops->close(*state);
		fake_usb_disarm();
		assert_int_equal(ops->open("", state, &error), 0);
		run(*state, &job, &status);
		assert_int_equal(status.offset, 100000);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(a_job_that_fails_is_told_and_the_next_is_right),
		usb_test(a_wrong_word_anywhere_is_found),
		usb_test(a_wrong_word_to_be_written_is_found),
		usb_test(what_the_protocol_allows_is_no_failure),
		usb_test(every_job_that_is_outstanding_fails_and_is_forgotten),
		usb_test(every_thread_that_waits_is_told),
		usb_test(a_board_that_stands_still_is_given_two_seconds),
		usb_test(a_board_that_stands_still_after_a_long_rest_is_given_no_more),
		usb_test(transfers_without_a_word_are_no_progress),
		usb_test(a_board_that_is_lost_is_given_no_time),
		odd_test(a_board_that_makes_progress_is_waited_for),
		odd_test(a_board_that_makes_too_much_progress_is_not),
		usb_test(memory_whose_clearing_was_lost_is_cleared_again),
		usb_test(memory_is_cleared_for_a_job_that_was_not_yet_queued),
		usb_test(memory_keeps_its_words_over_a_failure),
		odd_test(memory_that_can_not_be_cleared_is_not_used),
		odd_test(a_job_can_not_end_before_it_is_sent),
		usb_test(an_unplugged_board_ends_every_wait_and_call),
		usb_test(an_unplugged_board_is_noticed_without_a_job),
		usb_test(a_board_that_does_not_start_again_is_gone),
		usb_test(a_start_that_fails_twice_is_tried_again),
		usb_test(a_board_may_be_closed_while_it_starts_again),
		usb_test(remains_of_another_host_do_no_harm),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
