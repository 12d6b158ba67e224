/* SPDX-License-Identifier: MIT */
/*
 * Transfers on one side of a bridge, words on the other, and each fault between them. The board is
 * one that sends back what it gets.
 */
#include "accel_test.h"
#include "still_clock.h"
#include "vboard/usb/vboard.h"

#define WORDS 4096u /* that the board holds */
#define PACKET 512u
#define COMPLETION (GLOSS_USB_COMPLETION_MAGIC << 16)
#define BURST_END 0xb0b0b0b0 /* the board ends a burst behind this word */

struct gloss_usb_board {
	uint32_t word[WORDS];
	uint32_t count, room;
	uint32_t nonce;
};

struct ended {
	uint64_t id;
	enum vboard_usb_status status;
	uint32_t bytes;
	uint32_t word[WORDS];
};

static struct gloss_usb_board board;
static struct vboard_usb_faults faults;
static struct vboard_usb_bridge bridge;
static struct ended ended[64];
static unsigned int ended_count, expected;
static uint64_t next_id;

/* ---- the board ---- */

static uint32_t board_read(struct gloss_usb_board *this, uint32_t offset)
{
	return offset == GLOSS_REG_NONCE ? this->nonce : 0;
}

static void board_write(struct gloss_usb_board *this, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_NONCE)
		this->nonce = value;
	else
		this->count = 0;
}

static uint32_t board_out(struct gloss_usb_board *this, const uint32_t *words, uint32_t count)
{
	uint32_t room = this->room - this->count;

	if (count > room)
		count = room;
	memcpy(this->word + this->count, words, 4 * (size_t)count);
	this->count += count;
	return count;
}

static uint32_t board_in(struct gloss_usb_board *this, uint32_t *words, uint32_t room, bool *flush)
{
	uint32_t count = 0;

	*flush = false;
	while (count < room && count < this->count && !*flush) {
		*flush = this->word[count] == BURST_END;
		words[count] = this->word[count];
		count++;
	}
	this->count -= count;
	memmove(this->word, this->word + count, 4 * (size_t)this->count);
	return count;
}

static bool board_work(struct gloss_usb_board *this)
{
	(void)this;
	return false;
}

static const struct gloss_usb_board_ops ops = {
	.read = board_read,
	.write = board_write,
	.out = board_out,
	.in = board_in,
	.work = board_work,
};

/* ---- the host ---- */

static void take_ended(void *user, const struct vboard_usb_transfer *transfer,
		       enum vboard_usb_status status, void *data, uint32_t bytes)
{
	struct ended *one = &ended[ended_count++];

	(void)user;
	assert_in_range(ended_count, 1, 64);
	*one = (struct ended){ .id = transfer->id, .status = status, .bytes = bytes };
	if (transfer->endpoint == GLOSS_USB_ENDPOINT_IN && bytes)
		memcpy(one->word, data, bytes);
}

static int setup(void **state)
{
	const struct vboard_usb_faults_armed nothing = { 0 };

	(void)state;
	board = (struct gloss_usb_board){ .room = WORDS };
	vboard_usb_faults_init(&faults, &nothing);
	bridge = (struct vboard_usb_bridge){
		.ops = &ops,
		.board = &board,
		.faults = &faults,
		.packet_bytes = PACKET,
		.ended = take_ended,
	};
	vboard_usb_bridge_init(&bridge);
	memset(ended, 0, sizeof(ended));
	ended_count = 0;
	expected = 0;
	next_id = 1;
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	vboard_usb_bridge_fini(&bridge);
	return 0;
}

static uint64_t out(const void *data, uint32_t bytes)
{
	void *copy = malloc(bytes ? bytes : 1);

	assert_non_null(copy);
	memcpy(copy, data, bytes);
	assert_true(
		vboard_usb_bridge_submit(&bridge, next_id, GLOSS_USB_ENDPOINT_OUT, copy, bytes));
	return next_id++;
}

static uint64_t in(uint32_t bytes)
{
	assert_true(vboard_usb_bridge_submit(&bridge, next_id, GLOSS_USB_ENDPOINT_IN, NULL, bytes));
	return next_id++;
}

/* @count words, counted from @first on, the last of them the end of a burst if @burst. */
static uint64_t out_words(uint32_t first, uint32_t count, bool burst)
{
	uint32_t words[WORDS];

	for (uint32_t n = 0; n < count; n++)
		words[n] = first + n;
	if (burst)
		words[count - 1] = BURST_END;
	return out(words, 4 * count);
}

static void work(void)
{
	int calls = 0;

	while (vboard_usb_bridge_work(&bridge))
		assert_in_range(++calls, 0, 10000);
}

/* The next transfer that ended, which is @id. */
static const struct ended *expect(uint64_t id, enum vboard_usb_status status, uint32_t bytes)
{
	const struct ended *one = &ended[expected];

	work();
	assert_in_range(expected, 0, ended_count - 1);
	assert_int_equal(one->id, id);
	assert_int_equal(one->status, status);
	assert_int_equal(one->bytes, bytes);
	expected++;
	return one;
}

static void expect_nothing(void)
{
	unsigned int before = ended_count;

	work();
	assert_int_equal(ended_count, before);
}

/* ---- without a fault ---- */

static void a_burst_ends_a_transfer(void **state)
{
	(void)state;
	expect(out_words(100, 3, true), VBOARD_USB_DONE, 12);
	assert_int_equal(expect(in(PACKET), VBOARD_USB_DONE, 12)->word[1], 101);
	in(PACKET);
	expect_nothing();
}

static void a_transfer_ends_when_it_is_full(void **state)
{
	const struct ended *one;

	(void)state;
	expect(out_words(0, 300, false), VBOARD_USB_DONE, 1200);
	one = expect(in(PACKET), VBOARD_USB_DONE, PACKET);
	assert_int_equal(one->word[127], 127);
	one = expect(in(PACKET), VBOARD_USB_DONE, PACKET);
	assert_int_equal(one->word[0], 128);
	in(PACKET);
	expect_nothing();
}

static void a_burst_of_whole_packets_ends_with_an_empty_one(void **state)
{
	(void)state;
	expect(out_words(0, PACKET / 4, true), VBOARD_USB_DONE, PACKET);
	expect(in(PACKET), VBOARD_USB_DONE, PACKET);
	expect(in(PACKET), VBOARD_USB_DONE, 0);
	expect(out_words(0, PACKET / 4, true), VBOARD_USB_DONE, PACKET);
	expect(in(2 * PACKET), VBOARD_USB_DONE, PACKET);
	in(PACKET);
	expect_nothing();
}

static void a_full_transfer_that_ends_with_a_short_packet_ends_the_burst(void **state)
{
	(void)state;
	expect(out_words(0, 3, true), VBOARD_USB_DONE, 12);
	expect(in(12), VBOARD_USB_DONE, 12);
	in(PACKET);
	expect_nothing();
}

static void out_waits_for_room_and_keeps_its_order(void **state)
{
	uint64_t first, second;

	(void)state;
	board.room = 100;
	first = out_words(0, 150, false);
	second = out_words(150, 50, true);
	expect_nothing();
	in(4 * 512);
	work();
	assert_int_equal(ended_count, 3);
	assert_int_equal(ended[0].id, first);
	assert_int_equal(ended[1].id, second);
	assert_int_equal(ended[2].bytes, 800);
	for (uint32_t n = 0; n < 199; n++)
		assert_int_equal(ended[2].word[n], n);
}

static void bytes_that_fill_no_word_are_dropped(void **state)
{
	const uint32_t words[] = { 1, BURST_END, 0xffffffff };

	(void)state;
	expect(out(words, 3), VBOARD_USB_DONE, 3);
	expect(out(words, 0), VBOARD_USB_DONE, 0);
	expect(out(words, 11), VBOARD_USB_DONE, 11);
	assert_int_equal(expect(in(PACKET), VBOARD_USB_DONE, 8)->word[0], 1);
}

static void words_of_a_cancelled_transfer_are_the_next_ones(void **state)
{
	uint64_t id;

	(void)state;
	expect(out_words(0, 10, false), VBOARD_USB_DONE, 40);
	id = in(PACKET);
	expect_nothing();
	vboard_usb_bridge_cancel(&bridge, id);
	expect(id, VBOARD_USB_CANCELLED, 0);
	vboard_usb_bridge_cancel(&bridge, id);
	expect(out_words(10, 10, true), VBOARD_USB_DONE, 40);
	assert_int_equal(expect(in(PACKET), VBOARD_USB_DONE, 80)->word[9], 9);
}

static void a_cancelled_out_is_as_far_as_the_board_took_it(void **state)
{
	uint64_t id;

	(void)state;
	board.room = 10;
	id = out_words(0, 20, false);
	expect_nothing();
	vboard_usb_bridge_cancel(&bridge, id);
	expect(id, VBOARD_USB_CANCELLED, 0);
	assert_int_equal(board.count, 10);
}

static void a_host_may_use_a_number_twice(void **state)
{
	(void)state;
	in(PACKET);
	next_id--;
	in(PACKET);
	out_words(0, 1, true);
	out_words(0, 2, true);
	work();
	assert_int_equal(ended_count, 4);
	vboard_usb_bridge_cancel(&bridge, 1);
	assert_int_equal(ended_count, 4);
}

static void there_are_limits(void **state)
{
	(void)state;
	assert_false(vboard_usb_bridge_submit(&bridge, 1, GLOSS_USB_ENDPOINT_IN, NULL,
					      VBOARD_USB_TRANSFER_MAX + 1));
	for (unsigned int n = 0; n < VBOARD_USB_TRANSFERS; n++)
		in(VBOARD_USB_TRANSFER_MAX);
	assert_false(vboard_usb_bridge_submit(&bridge, 1, GLOSS_USB_ENDPOINT_IN, NULL, PACKET));
	vboard_usb_bridge_drop(&bridge);
	in(PACKET);
	expect_nothing();
}

static void so_many_bytes_wait_and_no_more(void **state)
{
	uint32_t *big = calloc(1, VBOARD_USB_TRANSFER_MAX);
	uint32_t *more = malloc(4);
	uint64_t first = next_id;

	(void)state;
	assert_true(big && more);
	board.room = 0;
	for (uint32_t bytes = 0; bytes < VBOARD_USB_WAITING_MAX; bytes += VBOARD_USB_TRANSFER_MAX)
		out(big, VBOARD_USB_TRANSFER_MAX);
	assert_false(vboard_usb_bridge_submit(&bridge, 1, GLOSS_USB_ENDPOINT_OUT, more, 4));
	vboard_usb_bridge_cancel(&bridge, first);
	assert_true(vboard_usb_bridge_submit(&bridge, 1, GLOSS_USB_ENDPOINT_OUT, more, 4));
	free(big);
}

/* ---- faults ---- */

static void arm(uint32_t offset, uint32_t value)
{
	vboard_usb_faults_window_write(&faults, offset, value);
	assert_int_equal(vboard_usb_faults_window_read(&faults, offset), value);
}

static void a_stall_halts_until_it_is_cleared(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_STALL_OUT, 2);
	arm(VBOARD_USB_FAULT_STALL_IN, 2);
	expect(out_words(0, 1, true), VBOARD_USB_DONE, 4);
	expect(out_words(0, 1, true), VBOARD_USB_STALLED, 0);
	expect(out_words(0, 1, true), VBOARD_USB_STALLED, 0);
	*vboard_usb_bridge_halted(&bridge, GLOSS_USB_ENDPOINT_OUT) = false;
	expect(out_words(7, 2, true), VBOARD_USB_DONE, 8);
	expect(in(PACKET), VBOARD_USB_DONE, 4);
	expect(in(PACKET), VBOARD_USB_STALLED, 0);
	expect(in(PACKET), VBOARD_USB_STALLED, 0);
	*vboard_usb_bridge_halted(&bridge, GLOSS_USB_ENDPOINT_IN) = false;
	assert_int_equal(expect(in(PACKET), VBOARD_USB_DONE, 8)->word[0], 7);
	assert_null(vboard_usb_bridge_halted(&bridge, GLOSS_USB_ENDPOINT_EVENT));
}

static void a_host_that_begins_anew_finds_no_halt(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_STALL_OUT, 1);
	arm(VBOARD_USB_FAULT_STALL_IN, 1);
	expect(out_words(0, 1, true), VBOARD_USB_STALLED, 0);
	vboard_usb_bridge_drop(&bridge);
	expect(out_words(0, 1, true), VBOARD_USB_DONE, 4);
	expect(in(PACKET), VBOARD_USB_STALLED, 0);
	vboard_usb_bridge_drop(&bridge);
	expect(out_words(1, 1, true), VBOARD_USB_DONE, 4);
	assert_false(bridge.in_halted);
}

static void a_transfer_that_waits_counts_once(void **state)
{
	(void)state;
	board.room = 10;
	arm(VBOARD_USB_FAULT_LOSE_OUT, 3);
	out_words(0, 20, false);
	for (int n = 0; n < 5; n++)
		expect_nothing();
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_LOSE_OUT), 2);
}

static void what_is_disarmed_does_not_happen_to_those_that_wait(void **state)
{
	uint64_t id;

	(void)state;
	id = in(PACKET);
	arm(VBOARD_USB_FAULT_STALL_IN, 1);
	expect_nothing();
	arm(VBOARD_USB_FAULT_STALL_IN, 0);
	out_words(0, 1, true);
	work();
	assert_int_equal(ended[1].id, id);
	assert_int_equal(ended[1].status, VBOARD_USB_DONE);
}

static void a_short_transfer_leaves_the_rest_to_the_next(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_SHORT_IN, 1);
	expect(out_words(0, 7, true), VBOARD_USB_DONE, 28);
	expect(in(PACKET), VBOARD_USB_DONE, 12);
	assert_int_equal(expect(in(PACKET), VBOARD_USB_DONE, 16)->word[0], 3);
	in(PACKET);
	expect_nothing();
}

static void empty_transfers_come_before_words(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_EMPTY_IN, 2);
	expect(out_words(0, 2, true), VBOARD_USB_DONE, 8);
	expect(in(PACKET), VBOARD_USB_DONE, 0);
	expect(in(PACKET), VBOARD_USB_DONE, 0);
	expect(in(PACKET), VBOARD_USB_DONE, 8);
}

static void a_lost_transfer_ends_well(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_LOSE_OUT, 2);
	expect(out_words(0, 1, false), VBOARD_USB_DONE, 4);
	expect(out_words(1, 1, false), VBOARD_USB_DONE, 4);
	expect(out_words(2, 1, true), VBOARD_USB_DONE, 4);
	assert_int_equal(expect(in(PACKET), VBOARD_USB_DONE, 8)->word[1], BURST_END);
}

#define ANSWER_BYTES 32

/* A chunk of two words, and a completion behind it, whose number is @number. */
static uint64_t out_answer(uint32_t number)
{
	const uint32_t words[] = { GLOSS_USB_RESPONSE_MAGIC << 16 | 2,
				   COMPLETION,
				   1,
				   COMPLETION,
				   number,
				   0,
				   2,
				   BURST_END };

	return out(words, sizeof(words));
}

static void a_completion_that_hangs_stays_until_the_reset(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_HANG, 2);
	expect(out_answer(1), VBOARD_USB_DONE, ANSWER_BYTES);
	expect(in(PACKET), VBOARD_USB_DONE, ANSWER_BYTES);
	expect(out_answer(2), VBOARD_USB_DONE, ANSWER_BYTES);
	expect(in(12), VBOARD_USB_DONE, 12);
	in(PACKET);
	expect_nothing();
	assert_int_equal(vboard_usb_faults_due(&faults), UINT64_MAX);
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_JOBS), 1);
	vboard_usb_bridge_write(&bridge, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	expect_nothing();
	out_answer(3);
	work();
	assert_int_equal(ended[ended_count - 1].bytes, ANSWER_BYTES);
	assert_int_equal(ended[ended_count - 1].word[4], 3);
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_JOBS), 2);
}

static void what_came_before_a_hang_is_there_after_the_reset(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_HANG, 1);
	expect(out_answer(1), VBOARD_USB_DONE, ANSWER_BYTES);
	in(PACKET);
	expect_nothing();
	vboard_usb_bridge_write(&bridge, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	out_answer(2);
	work();
	assert_int_equal(ended[ended_count - 1].bytes, 12 + ANSWER_BYTES);
}

static void a_hang_that_is_disarmed_ends(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_HANG, 1);
	expect(out_answer(1), VBOARD_USB_DONE, ANSWER_BYTES);
	in(PACKET);
	expect_nothing();
	arm(VBOARD_USB_FAULT_HANG, 0);
	work();
	assert_int_equal(ended_count, 2);
	assert_int_equal(ended[1].bytes, ANSWER_BYTES);
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_JOBS), 1);
}

static void messages_begin_anew_after_a_reset(void **state)
{
	const uint32_t torn[] = { GLOSS_USB_RESPONSE_MAGIC << 16 | 200, 1, 2 };

	(void)state;
	expect(out(torn, sizeof(torn)), VBOARD_USB_DONE, sizeof(torn));
	expect(in(sizeof(torn)), VBOARD_USB_DONE, sizeof(torn));
	vboard_usb_bridge_write(&bridge, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	expect(out_answer(1), VBOARD_USB_DONE, ANSWER_BYTES);
	expect(in(PACKET), VBOARD_USB_DONE, ANSWER_BYTES);
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_JOBS), 1);
}

static void a_delayed_completion_leaves_when_it_is_due(void **state)
{
	(void)state;
	arm(VBOARD_USB_FAULT_DELAY, 20000);
	expect(out_answer(1), VBOARD_USB_DONE, ANSWER_BYTES);
	in(PACKET);
	expect_nothing();
	assert_int_equal(vboard_usb_faults_due(&faults), vboard_now() + 20000000);
	time_passes(19999);
	work();
	expect_nothing();
	time_passes(1);
	work();
	assert_int_equal(ended[1].bytes, ANSWER_BYTES);
	assert_int_equal(vboard_usb_faults_due(&faults), UINT64_MAX);
}

/* Which of @count words that were counted from 0 on are noise: the first, and how many. */
static uint32_t noise(const struct ended *one, uint32_t count, uint32_t *first)
{
	uint32_t last = count - 1;

	for (*first = 0; one->word[*first] == *first; ++*first)
		assert_in_range(*first, 0, count - 2);
	while (one->word[last - 1] == last - 1)
		last--;
	return last - *first;
}

static void noise_is_sixteen_words(void **state)
{
	uint32_t first;

	(void)state;
	for (uint32_t n = 1; n <= 120; n += 7) {
		arm(VBOARD_USB_FAULT_GARBAGE, n);
		ended_count = 0;
		out_words(0, 200, true);
		in(PACKET * 4);
		work();
		assert_int_equal(ended_count, 2);
		assert_int_equal(ended[1].bytes, 800);
		assert_int_equal(noise(&ended[1], 200, &first), 16);
		assert_int_equal(first, n - 1);
	}
}

static void noise_goes_on_in_the_next_transfer_but_not_after_a_reset(void **state)
{
	(void)state;
	for (int reset = 0; reset < 2; reset++) {
		ended_count = 0;
		arm(VBOARD_USB_FAULT_GARBAGE, 3);
		out_words(0, 4, false);
		in(16);
		work();
		if (reset)
			vboard_usb_bridge_write(&bridge, GLOSS_REG_CONTROL,
						GLOSS_REG_CONTROL_RESET);
		out_words(0, 32, false);
		in(128);
		work();
		assert_int_equal(ended[1].word[1], 1);
		assert_int_not_equal(ended[1].word[2], 2);
		if (reset)
			assert_int_equal(ended[3].word[0], 0);
		else
			assert_int_not_equal(ended[3].word[0], 0);
		assert_int_equal(ended[3].word[14], 14);
	}
}

static void counts_of_other_things_are_kept(void **state)
{
	static const uint32_t others[] = { VBOARD_USB_FAULT_REPLUG, VBOARD_USB_FAULT_UNPLUG };

	(void)state;
	for (size_t i = 0; i < 2; i++)
		arm(others[i], 9);
	arm(VBOARD_USB_FAULT_REFUSE_CONTROL, 2);
	arm(VBOARD_USB_FAULT_EXIT, 2);
	assert_false(vboard_usb_faults_refuse(&faults));
	assert_true(vboard_usb_faults_refuse(&faults));
	assert_false(vboard_usb_faults_refuse(&faults));
	assert_false(vboard_usb_faults_exit(&faults));
	assert_true(vboard_usb_faults_exit(&faults));
	for (int n = 0; n < 8; n++)
		assert_false(vboard_usb_faults_unplug(&faults));
	assert_true(vboard_usb_faults_unplug(&faults));
	assert_false(vboard_usb_faults_unplug(&faults));
	vboard_usb_faults_window_write(&faults, VBOARD_USB_FAULT_JOBS, 9);
	vboard_usb_faults_window_write(&faults, 0x1000, 9);
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_JOBS), 0);
	assert_int_equal(vboard_usb_faults_window_read(&faults, 0x1000), 0);
	assert_int_equal(vboard_usb_faults_window_read(&faults, VBOARD_USB_FAULT_IDENTITY),
			 VBOARD_USB_FAULT_IDENTITY_VALUE);
}

#define bridge_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		bridge_test(a_burst_ends_a_transfer),
		bridge_test(a_transfer_ends_when_it_is_full),
		bridge_test(a_burst_of_whole_packets_ends_with_an_empty_one),
		bridge_test(a_full_transfer_that_ends_with_a_short_packet_ends_the_burst),
		bridge_test(out_waits_for_room_and_keeps_its_order),
		bridge_test(bytes_that_fill_no_word_are_dropped),
		bridge_test(words_of_a_cancelled_transfer_are_the_next_ones),
		bridge_test(a_cancelled_out_is_as_far_as_the_board_took_it),
		bridge_test(a_host_may_use_a_number_twice),
		bridge_test(there_are_limits),
		bridge_test(so_many_bytes_wait_and_no_more),
		bridge_test(a_stall_halts_until_it_is_cleared),
		bridge_test(a_host_that_begins_anew_finds_no_halt),
		bridge_test(a_transfer_that_waits_counts_once),
		bridge_test(what_is_disarmed_does_not_happen_to_those_that_wait),
		bridge_test(a_short_transfer_leaves_the_rest_to_the_next),
		bridge_test(empty_transfers_come_before_words),
		bridge_test(a_lost_transfer_ends_well),
		bridge_test(a_completion_that_hangs_stays_until_the_reset),
		bridge_test(what_came_before_a_hang_is_there_after_the_reset),
		bridge_test(a_hang_that_is_disarmed_ends),
		bridge_test(messages_begin_anew_after_a_reset),
		bridge_test(a_delayed_completion_leaves_when_it_is_due),
		bridge_test(noise_is_sixteen_words),
		bridge_test(noise_goes_on_in_the_next_transfer_but_not_after_a_reset),
		bridge_test(counts_of_other_things_are_kept),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
