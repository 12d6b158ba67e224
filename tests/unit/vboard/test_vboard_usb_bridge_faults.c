/* SPDX-License-Identifier: MIT */
/* Each fault there is between the transfers on one side of a bridge and the words on the other. */
#include "still_clock.h"
#include "vboard_bridge_test.h"

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

#define COMPLETION (GLOSS_USB_COMPLETION_MAGIC << 16)
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

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_stall_halts_until_it_is_cleared),
		TEST(a_host_that_begins_anew_finds_no_halt),
		TEST(a_transfer_that_waits_counts_once),
		TEST(what_is_disarmed_does_not_happen_to_those_that_wait),
		TEST(a_short_transfer_leaves_the_rest_to_the_next),
		TEST(empty_transfers_come_before_words),
		TEST(a_lost_transfer_ends_well),
		TEST(a_completion_that_hangs_stays_until_the_reset),
		TEST(what_came_before_a_hang_is_there_after_the_reset),
		TEST(a_hang_that_is_disarmed_ends),
		TEST(messages_begin_anew_after_a_reset),
		TEST(a_delayed_completion_leaves_when_it_is_due),
		TEST(noise_is_sixteen_words),
		TEST(noise_goes_on_in_the_next_transfer_but_not_after_a_reset),
		TEST(counts_of_other_things_are_kept),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
