/* SPDX-License-Identifier: MIT */
/* Transfers on one side of a bridge, words on the other. */
#include "vboard_bridge_test.h"

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

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_burst_ends_a_transfer),
		TEST(a_transfer_ends_when_it_is_full),
		TEST(a_burst_of_whole_packets_ends_with_an_empty_one),
		TEST(a_full_transfer_that_ends_with_a_short_packet_ends_the_burst),
		TEST(out_waits_for_room_and_keeps_its_order),
		TEST(bytes_that_fill_no_word_are_dropped),
		TEST(words_of_a_cancelled_transfer_are_the_next_ones),
		TEST(a_cancelled_out_is_as_far_as_the_board_took_it),
		TEST(a_host_may_use_a_number_twice),
		TEST(there_are_limits),
		TEST(so_many_bytes_wait_and_no_more),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
