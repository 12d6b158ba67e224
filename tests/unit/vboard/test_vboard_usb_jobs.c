/* SPDX-License-Identifier: MIT */
/* Jobs of a board on a cable, and what becomes of them when the cable is pulled. */
#include "vboard_usb_test.h"

/* ---- jobs ---- */

static void jobs_go_out_and_answers_come_back(void **state)
{
	(void)state;
	synchronise();
	for (uint32_t n = 0; n < 20; n++)
		run_job(n);
	assert_int_equal(peer_read_register(&peer, 1, VBOARD_USB_FAULT_JOBS), 20);
	assert_int_equal(get(GLOSS_REG_JOBS), 20);
}

/* What is written to board memory is read back, by way of chunks. */
static void long_streams_and_answers_are_whole(void **state)
{
	enum { PACKETS = 7, EACH = GLOSS_LENGTH_MAX - 2, COUNT = PACKETS * EACH };
	static uint32_t stream[COUNT + 3 * PACKETS + 1 + GLOSS_READ_MEMORY_WORDS];
	const struct gloss_read_memory read = { .count = COUNT };
	const uint32_t chunks = (COUNT + GLOSS_USB_CHUNK_WORDS - 1) / GLOSS_USB_CHUNK_WORDS;
	const struct test_answer *answer;
	uint32_t at = 0, n = 0;

	(void)state;
	while (n < COUNT) {
		const struct gloss_write_memory write = { .offset = 4 * n };

		gloss_write_memory_pack(stream + at, &write, 2 + EACH);
		at += 3;
		do
			stream[at++] = n++;
		while (n % EACH);
	}
	gloss_read_memory_pack(stream + at, &read);
	synchronise();
	submit_job(1, stream, at + 1 + GLOSS_READ_MEMORY_WORDS, COUNT);
	answer = peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 1 << 20);
	assert_int_equal(answer->length, 4 * (COUNT + chunks + GLOSS_USB_COMPLETION_WORDS));
	for (n = 0; n < COUNT; n++) {
		uint32_t word;

		memcpy(&word, answer->data + 4 * (n + n / GLOSS_USB_CHUNK_WORDS + 1), 4);
		assert_int_equal(word, n);
	}
}

static void a_fault_is_an_event_that_waits_for_who_listens(void **state)
{
	struct usb_redir_start_interrupt_receiving_header start = { 0x82 };
	struct usb_redir_stop_interrupt_receiving_header stop = { 0x82 };
	const uint32_t wrong = 0xffffffff;
	struct gloss_usb_event event;
	uint32_t words[GLOSS_USB_EVENT_WORDS];

	(void)state;
	synchronise();
	submit_job(9, &wrong, 1, 0);
	peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	assert_int_equal(peer.interrupts, 0);
	peer.interrupt_status = -1;
	usbredirparser_send_start_interrupt_receiving(peer.parser, 1, &start);
	peer_until(&peer, peer.interrupts == 1);
	assert_int_equal(peer.interrupt_status, usb_redir_success);
	memcpy(words, peer.interrupt, sizeof(words));
	gloss_usb_event_unpack(words, &event);
	assert_int_equal(event.mark, GLOSS_USB_EVENT_MAGIC);
	assert_int_equal(event.sequence, 9);
	assert_int_not_equal(event.cause, 0);
	peer.interrupt_status = -1;
	usbredirparser_send_stop_interrupt_receiving(peer.parser, 2, &stop);
	peer_until(&peer, peer.interrupt_status == usb_redir_success);
	submit_job(10, &wrong, 1, 0);
	peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	assert_int_equal(peer.interrupts, 1);
}

static void a_stalled_endpoint_waits_for_the_host(void **state)
{
	const struct test_answer *answer;

	(void)state;
	synchronise();
	arm(VBOARD_USB_FAULT_STALL_OUT, 1);
	answer = peer_wait(&peer, submit_job(1, NULL, 0, 0));
	assert_int_equal(answer->status, usb_redir_stall);
	assert_int_equal(answer->length, 0);
	assert_int_equal(peer_wait(&peer, submit_job(1, NULL, 0, 0))->status, usb_redir_stall);
	assert_int_equal(peer_request(&peer, 0x82, 0, 0, 0x01, 2, NULL)->data[0], 1);
	clear_halt(GLOSS_USB_ENDPOINT_OUT);
	assert_int_equal(peer_request(&peer, 0x82, 0, 0, 0x01, 2, NULL)->data[0], 0);
	run_job(2);
	arm(VBOARD_USB_FAULT_STALL_IN, 1);
	submit_job(3, NULL, 0, 0);
	answer = peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	assert_int_equal(answer->status, usb_redir_stall);
	clear_halt(GLOSS_USB_ENDPOINT_IN);
	answer = peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	assert_int_equal(answer->length, 4 * GLOSS_USB_COMPLETION_WORDS);
}

static void a_cancelled_transfer_is_answered_once(void **state)
{
	uint64_t id;

	(void)state;
	synchronise();
	id = peer_submit(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	peer_nothing(&peer, id, 20);
	usbredirparser_send_cancel_data_packet(peer.parser, id);
	assert_int_equal(peer_wait(&peer, id)->status, usb_redir_cancelled);
	usbredirparser_send_cancel_data_packet(peer.parser, id);
	run_job(1);
}

static void what_hangs_is_reset(void **state)
{
	uint64_t id;

	(void)state;
	synchronise();
	arm(VBOARD_USB_FAULT_HANG, 1);
	submit_job(1, NULL, 0, 0);
	id = peer_submit(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	peer_nothing(&peer, id, 50);
	usbredirparser_send_cancel_data_packet(peer.parser, id);
	peer_wait(&peer, id);
	synchronise();
	run_job(2);
}

/* ---- the cable ---- */

static void a_pulled_cable_ends_everything_without_an_answer(void **state)
{
	uint64_t in, out;

	(void)state;
	synchronise();
	arm(VBOARD_USB_FAULT_REPLUG, 30);
	arm(VBOARD_USB_FAULT_UNPLUG, 2);
	in = peer_submit(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	out = submit_job(1, NULL, 0, 0);
	peer_until(&peer, peer.disconnects == 1);
	peer_until(&peer, peer.connects == 2);
	assert_false(peer.answer[in].there);
	assert_false(peer.answer[out].there);
	/* The board has its own power. */
	assert_int_equal(get(GLOSS_REG_NONCE), NONCE);
	synchronise();
	run_job(1);
}

static void a_cable_can_be_pulled_at_once_and_for_ever(void **state)
{
	uint64_t id;

	(void)state;
	arm(VBOARD_USB_FAULT_UNPLUG, VBOARD_USB_FAULT_UNPLUG_NOW);
	peer_until(&peer, peer.disconnects == 1);
	id = peer_submit_control(&peer, 0xc1, 1, 0, 0, 4, NULL);
	peer_nothing(&peer, id, 50);
	assert_int_equal(peer.connects, 1);
}

/* What it sends before it knows that the board is gone reaches nobody. */
static void a_host_has_to_notice_before_the_cable_is_back(void **state)
{
	const uint32_t unplug = VBOARD_USB_FAULT_UNPLUG_NOW, nonce = 1;
	uint64_t sink, control;

	(void)state;
	put(GLOSS_REG_NONCE, NONCE);
	arm(VBOARD_USB_FAULT_REPLUG, 1);
	peer.reads = false;
	peer_submit_control(&peer, 0x41, 2, VBOARD_USB_FAULT_UNPLUG, 1, 4, &unplug);
	for (int n = 0; n < 30; n++)
		assert_true(peer_move(&peer, 1));
	sink = peer_submit(&peer, 0x03, "word", 4);
	control = peer_submit_control(&peer, 0x41, 2, GLOSS_REG_NONCE, 0, 4, &nonce);
	for (int n = 0; n < 30; n++)
		assert_true(peer_move(&peer, 1));
	peer.reads = true;
	peer_until(&peer, peer.connects == 2);
	assert_int_equal(get(GLOSS_REG_NONCE), NONCE);
	assert_false(peer.answer[sink].there);
	assert_false(peer.answer[control].there);
}

static void a_reset_of_the_bus_is_none_of_the_board(void **state)
{
	uint64_t id;

	(void)state;
	synchronise();
	id = peer_submit(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	arm(VBOARD_USB_FAULT_STALL_OUT, 1);
	peer_wait(&peer, submit_job(1, NULL, 0, 0));
	usbredirparser_send_reset(peer.parser);
	assert_int_equal(get(GLOSS_REG_NONCE), NONCE);
	run_job(2);
	assert_false(peer.answer[id].there);
}

static void the_program_ends_when_it_is_told_to(void **state)
{
	setup(state);
	synchronise();
	arm(VBOARD_USB_FAULT_EXIT, 1);
	submit_job(1, NULL, 0, 0);
	while (peer_move(&peer, 10))
		;
	assert_int_equal(end(), -ECANCELED);
}

static void faults_are_armed_from_the_start(void **state)
{
	const struct vboard_usb_faults_armed armed = { .unplug = 1, .replug = 1 };

	(void)state;
	plug_in(true, &armed);
	peer_until(&peer, peer.connects);
	peer_submit(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	peer_until(&peer, peer.connects == 2);
	assert_int_equal(end(), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(jobs_go_out_and_answers_come_back),
		TEST(long_streams_and_answers_are_whole),
		TEST(a_fault_is_an_event_that_waits_for_who_listens),
		TEST(a_stalled_endpoint_waits_for_the_host),
		TEST(a_cancelled_transfer_is_answered_once),
		TEST(what_hangs_is_reset),
		TEST(a_pulled_cable_ends_everything_without_an_answer),
		TEST(a_cable_can_be_pulled_at_once_and_for_ever),
		TEST(a_host_has_to_notice_before_the_cable_is_back),
		TEST(a_reset_of_the_bus_is_none_of_the_board),
		cmocka_unit_test(the_program_ends_when_it_is_told_to),
		cmocka_unit_test(faults_are_armed_from_the_start),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
