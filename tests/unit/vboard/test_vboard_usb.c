/* SPDX-License-Identifier: MIT */
/* A board on its cable, with its thread; the test is QEMU's usb-redir and the driver. */
#define _GNU_SOURCE
#include <sys/eventfd.h>
#include <unistd.h>

#include "gloss_packets.h"
#include "transport/usb/checksum.h"
#include "vboard_peer.h"
#include "vboard/usb/vboard.h"

#define NONCE 0x12345

static struct vboard_usb usb;
static struct test_peer peer;
static uint8_t board_memory[65536];

/* ---- power ---- */

static void plug_in(bool super, const struct vboard_usb_faults_armed *armed)
{
	int pair[2];

	assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair), 0);
	usb = (struct vboard_usb){
		.name = "board",
		.serial = "TEST7",
		.super = super,
		.loop = {
			.ops = &vboard_door_usb_loop,
			.data = &usb,
			.socket = pair[0],
			.ended = eventfd(0, EFD_CLOEXEC),
		},
		.bridge.ops = &gloss_usb_board_model_t64,
	};
	vboard_usb_faults_init(&usb.faults, armed);
	usb.bridge.board = usb.bridge.ops->create(board_memory, sizeof(board_memory));
	assert_non_null(usb.bridge.board);
	assert_true(vboard_door_usb_init(&usb));
	peer_init(&peer, pair[1]);
	assert_int_equal(vboard_loop_start(&usb.loop), 0);
}

static int setup(void **state)
{
	const struct vboard_usb_faults_armed nothing = { 0 };

	(void)state;
	plug_in(true, &nothing);
	peer_until(&peer, peer.connects);
	return 0;
}

static int setup_high(void **state)
{
	const struct vboard_usb_faults_armed nothing = { 0 };

	(void)state;
	plug_in(false, &nothing);
	peer_until(&peer, peer.connects);
	return 0;
}

/* What the thread ended with. */
static int end(void)
{
	eventfd_t ended;

	peer_fini(&peer);
	assert_int_equal(eventfd_read(usb.loop.ended, &ended), 0);
	vboard_loop_stop(&usb.loop);
	vboard_door_usb_fini(&usb);
	usb.bridge.ops->destroy(usb.bridge.board);
	close(usb.loop.socket);
	close(usb.loop.ended);
	return usb.loop.error;
}

static int teardown(void **state)
{
	(void)state;
	return end();
}

/* ---- the driver ---- */

static uint32_t get(uint16_t offset)
{
	return peer_read_register(&peer, 0, offset);
}

static void put(uint16_t offset, uint32_t value)
{
	peer_write_register(&peer, 0, offset, value);
}

static void arm(uint16_t offset, uint32_t value)
{
	peer_write_register(&peer, 1, offset, value);
}

static void put_sync(void)
{
	const struct gloss_usb_sync sync = {
		.mark = GLOSS_USB_SYNC_MAGIC,
		.nonce = NONCE,
		.nonce_complement = ~NONCE,
		.mark_complement = ~GLOSS_USB_SYNC_MAGIC,
	};
	uint32_t words[GLOSS_USB_SYNC_WORDS];
	const struct test_answer *answer;

	gloss_usb_sync_pack(words, &sync);
	answer = peer_transfer(&peer, GLOSS_USB_ENDPOINT_OUT, words, sizeof(words));
	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, sizeof(words));
	answer = peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, sizeof(words));
	assert_memory_equal(answer->data, words, sizeof(words));
}

static void synchronise(void)
{
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	while (get(GLOSS_REG_CONTROL))
		;
	put(GLOSS_REG_NONCE, NONCE);
	put_sync();
}

/* A job of @count words at @stream, in slot 0 of which all board memory is. */
static uint64_t submit_job(uint32_t sequence, const uint32_t *stream, uint32_t count,
			   uint32_t response_words)
{
	static uint32_t words[GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS + 200000 +
			      GLOSS_USB_JOB_END_WORDS];
	const uint32_t head = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS;
	const struct gloss_usb_job job = {
		.slots = 1,
		.mark = GLOSS_USB_JOB_MAGIC,
		.sequence = sequence,
		.stream_words = count,
		.response_words = response_words,
	};
	const struct gloss_slot_entry slot = {
		.size = sizeof(board_memory),
		.rights = GLOSS_RIGHTS_READ | GLOSS_RIGHTS_WRITE,
	};

	gloss_usb_job_pack(words, &job);
	gloss_slot_entry_pack(words + GLOSS_USB_JOB_WORDS, &slot);
	if (count)
		memcpy(words + head, stream, 4 * (size_t)count);
	words[head + count] = accel_usb_checksum(0, words + GLOSS_USB_JOB_STREAM_WORDS_WORD,
						 head + count - GLOSS_USB_JOB_STREAM_WORDS_WORD);
	return peer_submit(&peer, GLOSS_USB_ENDPOINT_OUT, words,
			   4 * (head + count + GLOSS_USB_JOB_END_WORDS));
}

static void run_job(uint32_t sequence)
{
	const struct test_answer *answer;
	struct gloss_usb_completion end;
	uint32_t words[GLOSS_USB_COMPLETION_WORDS];

	submit_job(sequence, NULL, 0, 0);
	answer = peer_transfer(&peer, GLOSS_USB_ENDPOINT_IN, NULL, 4096);
	assert_int_equal(answer->length, sizeof(words));
	memcpy(words, answer->data, sizeof(words));
	gloss_usb_completion_unpack(words, &end);
	assert_int_equal(end.mark, GLOSS_USB_COMPLETION_MAGIC);
	assert_int_equal(end.sequence, sequence);
	assert_int_equal(end.cause, 0);
}

static void clear_halt(uint8_t endpoint)
{
	assert_int_equal(peer_request(&peer, 0x02, 1, 0, endpoint, 0, NULL)->status,
			 usb_redir_success);
}

/* ---- what it says it is ---- */

static const struct test_answer *descriptor(uint16_t value, uint16_t length)
{
	return peer_request(&peer, 0x80, 6, value, 0, length, NULL);
}

static void assert_string(uint8_t index, const char *text)
{
	const struct test_answer *answer = descriptor(0x0300 | index, 255);

	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, 2 + 2 * strlen(text));
	assert_int_equal(answer->data[0], answer->length);
	for (size_t n = 0; text[n]; n++)
		assert_int_equal(answer->data[2 + 2 * n], text[n]);
}

/* Walks a configuration: each descriptor has its length, and they fill the whole. */
static void assert_configuration(const struct test_answer *answer, unsigned int companions)
{
	unsigned int interfaces = 0, endpoints = 0, said = 0, found = 0;
	uint32_t at;

	assert_int_equal(answer->data[2] | answer->data[3] << 8, answer->length);
	for (at = 0; at < answer->length; at += answer->data[at]) {
		assert_in_range(answer->data[at], 6, 9);
		interfaces += answer->data[at + 1] == 4;
		said += answer->data[at + 1] == 4 ? answer->data[at + 4] : 0;
		endpoints += answer->data[at + 1] == 5;
		found += answer->data[at + 1] == 0x30;
	}
	assert_int_equal(at, answer->length);
	assert_int_equal(interfaces, 2);
	assert_int_equal(endpoints, 5);
	assert_int_equal(said, 5);
	assert_int_equal(found, companions);
}

static void descriptors_fit_the_speed(bool super)
{
	const struct test_answer *answer = descriptor(0x0100, 64);

	assert_int_equal(answer->length, 18);
	assert_int_equal(answer->data[3], super ? 3 : 2);
	assert_int_equal(answer->data[8] | answer->data[9] << 8, GLOSS_USB_VENDOR);
	assert_int_equal(answer->data[10] | answer->data[11] << 8, GLOSS_USB_PRODUCT);
	assert_int_equal(descriptor(0x0100, 8)->length, 8);
	assert_configuration(descriptor(0x0200, 4096), super ? 5 : 0);
	assert_int_equal(descriptor(0x0f00, 4096)->status,
			 super ? usb_redir_success : usb_redir_stall);
	assert_string(1, "Gloss");
	assert_string(2, "Gloss board");
	assert_string(3, "TEST7");
	assert_int_equal(descriptor(0x0304, 255)->status, usb_redir_stall);
	assert_int_equal(descriptor(0x0201, 255)->status, usb_redir_stall);
	assert_int_equal(descriptor(0x0700, 255)->status, usb_redir_stall);
}

static void the_tables_fit_the_speed(uint8_t speed, uint16_t packet)
{
	assert_int_equal(peer.device.speed, speed);
	assert_int_equal(peer.device.vendor_id, GLOSS_USB_VENDOR);
	assert_int_equal(peer.interfaces.interface_count, 2);
	assert_int_equal(peer.interfaces.interface_subclass[0], GLOSS_USB_SUBCLASS);
	assert_int_equal(peer.endpoints.type[0x01], usb_redir_type_bulk);
	assert_int_equal(peer.endpoints.type[0x11], usb_redir_type_bulk);
	assert_int_equal(peer.endpoints.type[0x12], usb_redir_type_interrupt);
	assert_int_equal(peer.endpoints.interface[0x13], 1);
	assert_int_equal(peer.endpoints.max_packet_size[0x11], packet);
	assert_int_equal(peer.endpoints.type[0x04], usb_redir_type_invalid);
}

static void a_board_at_super_speed_says_so(void **state)
{
	(void)state;
	the_tables_fit_the_speed(usb_redir_speed_super, 1024);
	descriptors_fit_the_speed(true);
}

static void a_board_at_high_speed_says_so(void **state)
{
	(void)state;
	the_tables_fit_the_speed(usb_redir_speed_high, 512);
	descriptors_fit_the_speed(false);
}

static void configurations_and_settings_are_one_each(void **state)
{
	struct usb_redir_set_configuration_header configuration = { .configuration = 1 };
	struct usb_redir_set_alt_setting_header setting = { .interface = 1 };

	(void)state;
	peer.configuration_status = peer.setting_status = -1;
	usbredirparser_send_set_configuration(peer.parser, 1, &configuration);
	peer_until(&peer, peer.configuration_status == usb_redir_success);
	configuration.configuration = 2;
	usbredirparser_send_set_configuration(peer.parser, 2, &configuration);
	peer_until(&peer, peer.configuration_status == usb_redir_stall);
	usbredirparser_send_get_configuration(peer.parser, 3);
	peer_until(&peer, peer.configuration_status == usb_redir_success);
	assert_int_equal(peer.configuration, 1);
	usbredirparser_send_set_alt_setting(peer.parser, 4, &setting);
	peer_until(&peer, peer.setting_status == usb_redir_success);
	setting.alt = 1;
	usbredirparser_send_set_alt_setting(peer.parser, 5, &setting);
	peer_until(&peer, peer.setting_status == usb_redir_stall);
}

/* ---- requests ---- */

static void registers_are_read_and_written(void **state)
{
	(void)state;
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
	put(GLOSS_REG_NONCE, 0x11223344);
	assert_int_equal(get(GLOSS_REG_NONCE), 0x11223344);
	assert_int_equal(peer_read_register(&peer, 1, VBOARD_USB_FAULT_IDENTITY),
			 VBOARD_USB_FAULT_IDENTITY_VALUE);
	arm(VBOARD_USB_FAULT_REFUSE_CONTROL, 1);
	assert_int_equal(peer_request(&peer, 0xc1, 1, 0, 0, 4, NULL)->status, usb_redir_stall);
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
}

static void wrong_requests_are_stalled(void **state)
{
	static const struct {
		uint8_t type, request;
		uint16_t value, index, length;
	} wrong[] = {
		{ 0xc1, 1, 2, 0, 4 }, /* no offset of a register */
		{ 0xc1, 1, 0, 2, 4 }, /* no such interface */
		{ 0xc1, 1, 0, 0, 2 },    { 0xc1, 1, 0, 0, 8 },
		{ 0xc1, 2, 0, 0, 4 }, /* a write that reads */
		{ 0x41, 1, 0x80, 0, 4 }, { 0x41, 2, 0x80, 0, 8 },
		{ 0x40, 2, 0x80, 0, 4 }, /* of the device */
		{ 0xc0, 1, 0, 0, 4 },    { 0x80, 77, 0, 0, 4 },
		{ 0x02, 1, 0, 0x55, 0 }, /* no such endpoint */
		{ 0x02, 1, 1, 0x81, 0 }, /* no such feature */
		{ 0x82, 0, 0, 0x55, 2 }, { 0x81, 0, 0, 9, 2 },
	};
	const uint32_t data[2] = { 1, 1 };

	(void)state;
	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++)
		assert_int_equal(peer_request(&peer, wrong[i].type, wrong[i].request,
					      wrong[i].value, wrong[i].index, wrong[i].length, data)
					 ->status,
				 usb_redir_stall);
	assert_int_equal(get(GLOSS_REG_NONCE), 0);
}

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

/* ---- interface 1, and what there is not ---- */

static void the_plain_endpoints_take_and_give(void **state)
{
	static uint8_t bytes[3 << 20];
	const struct test_answer *answer;

	(void)state;
	answer = peer_transfer(&peer, 0x03, bytes, sizeof(bytes));
	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, sizeof(bytes));
	answer = peer_transfer(&peer, 0x83, NULL, sizeof(bytes));
	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, sizeof(bytes));
	assert_int_equal(peer_request(&peer, 0x02, 3, 0, 0x83, 0, NULL)->status, usb_redir_success);
	assert_int_equal(peer_transfer(&peer, 0x83, NULL, 512)->status, usb_redir_stall);
	clear_halt(0x83);
	assert_int_equal(peer_transfer(&peer, 0x83, NULL, 512)->length, 512);
}

/* The board waits, and does not hoard what the host asked for. */
static void a_host_that_does_not_read_gets_all_of_it_later(void **state)
{
	enum { TRANSFERS = 64, BYTES = 1 << 20 };
	static uint8_t bytes[8 << 20];

	(void)state;
	peer.reads = false;
	for (int n = 0; n < TRANSFERS; n++)
		peer_submit(&peer, 0x83, NULL, BYTES);
	for (int n = 0; n < 50; n++)
		assert_true(peer_move(&peer, 1));
	peer_submit(&peer, 0x03, bytes, sizeof(bytes));
	for (int n = 0; n < 50; n++)
		assert_true(peer_move(&peer, 1));
	assert_true(usbredirparser_has_data_to_write(peer.parser));
	peer.reads = true;
	for (uint64_t id = 1; id <= TRANSFERS; id++)
		assert_int_equal(peer_wait(&peer, id)->length, BYTES);
	assert_int_equal(peer_wait(&peer, TRANSFERS + 1)->length, sizeof(bytes));
}

static void transfers_of_other_endpoints_are_refused(void **state)
{
	struct usb_redir_start_iso_stream_header iso = { .endpoint = 0x84 };
	struct usb_redir_alloc_bulk_streams_header streams = { .endpoints = 2, .no_streams = 4 };
	struct usb_redir_start_interrupt_receiving_header listen = { .endpoint = 0x85 };
	struct usb_redir_iso_packet_header iso_out = { .endpoint = 0x04, .length = 4 };
	struct usb_redir_interrupt_packet_header interrupt_out = { .endpoint = 0x05, .length = 4 };
	uint8_t word[4] = { 0 };

	(void)state;
	assert_int_equal(peer_transfer(&peer, 0x04, "word", 4)->status, usb_redir_inval);
	assert_int_equal(peer_transfer(&peer, 0x84, NULL, 4)->status, usb_redir_inval);
	assert_int_equal(peer_transfer(&peer, 0x81, NULL, VBOARD_USB_TRANSFER_MAX + 1)->status,
			 usb_redir_inval);
	usbredirparser_send_start_iso_stream(peer.parser, 1, &iso);
	usbredirparser_send_alloc_bulk_streams(peer.parser, 2, &streams);
	usbredirparser_send_iso_packet(peer.parser, 4, &iso_out, word, sizeof(word));
	usbredirparser_send_interrupt_packet(peer.parser, 5, &interrupt_out, word, sizeof(word));
	peer.interrupt_status = -1;
	usbredirparser_send_start_interrupt_receiving(peer.parser, 3, &listen);
	peer_until(&peer, peer.interrupt_status == usb_redir_inval);
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
}

/* ---- a host that is broken ---- */

/* A packet that has any of usbredir's types, and of the rest little that is right. */
static size_t random_packet(uint8_t *bytes, uint64_t *seed)
{
	static const struct {
		uint32_t type, length; /* of what follows the head */
	} known[] = {
		{ usb_redir_reset, 0 },
		{ usb_redir_set_configuration, 1 },
		{ usb_redir_get_configuration, 0 },
		{ usb_redir_set_alt_setting, 2 },
		{ usb_redir_get_alt_setting, 1 },
		{ usb_redir_start_iso_stream, 3 },
		{ usb_redir_stop_iso_stream, 1 },
		{ usb_redir_start_interrupt_receiving, 1 },
		{ usb_redir_stop_interrupt_receiving, 1 },
		{ usb_redir_alloc_bulk_streams, 8 },
		{ usb_redir_free_bulk_streams, 4 },
		{ usb_redir_cancel_data_packet, 0 },
		{ usb_redir_filter_reject, 0 },
		{ usb_redir_filter_filter, 4 },
		{ usb_redir_device_disconnect_ack, 0 },
		{ usb_redir_start_bulk_receiving, 10 },
		{ usb_redir_stop_bulk_receiving, 5 },
		{ usb_redir_control_packet, 10 },
		{ usb_redir_bulk_packet, 10 },
		{ usb_redir_iso_packet, 4 },
		{ usb_redir_interrupt_packet, 4 },
		{ usb_redir_hello, 68 },
		{ usb_redir_device_connect, 10 },
		{ 99, 4 },
	};
	size_t n = test_below(seed, sizeof(known) / sizeof(known[0]));
	struct usb_redir_header head = { .type = known[n].type,
					 .length = known[n].length,
					 .id = test_below(seed, 8) };
	bool odd = test_below(seed, 200) == 0;

	if (odd)
		head.length = test_below(seed, 300);
	memcpy(bytes, &head, sizeof(head));
	for (uint32_t at = 0; at < head.length; at++)
		bytes[sizeof(head) + at] = (uint8_t)test_random(seed);
	/* An endpoint that there is, and an IN transfer or request: those have no data. */
	if (head.length && test_below(seed, 8))
		bytes[sizeof(head)] = (uint8_t[]){ 0x80, 0x81, 0x82, 0x83 }[test_below(seed, 4)];
	return sizeof(head) + head.length;
}

static bool send_all(const uint8_t *bytes, size_t count)
{
	while (count) {
		ssize_t sent = send(peer.socket, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT);
		uint8_t read[4096];

		if (sent < 0 && errno != EAGAIN)
			return false;
		while (recv(peer.socket, read, sizeof(read), MSG_DONTWAIT) > 0)
			;
		bytes += sent > 0 ? sent : 0;
		count -= sent > 0 ? (size_t)sent : 0;
	}
	return true;
}

static void packets_with_anything_in_them_do_no_harm(void **state)
{
	uint64_t seed = test_seed();
	int ended = 0;

	for (int round = 0; round < 100; round++) {
		uint8_t packet[512];
		int error;

		setup(state);
		for (int n = 0; n < 300; n++)
			if (!send_all(packet, random_packet(packet, &seed)))
				break;
		error = end();
		assert_true(error == 0 || error == -EPROTO);
		ended += error != 0;
	}
	assert_in_range(ended, 1, 100);
}

static void bytes_that_are_no_packets_end_the_board(void **state)
{
	uint8_t bytes[4096];

	setup(state);
	memset(bytes, 0xff, sizeof(bytes));
	send_all(bytes, sizeof(bytes));
	while (peer_move(&peer, 10))
		;
	assert_int_equal(end(), -EPROTO);
}

static void a_host_that_goes_in_the_middle_of_a_packet_ends_the_board_well(void **state)
{
	const struct usb_redir_header head = { .type = usb_redir_bulk_packet, .length = 100000 };

	setup(state);
	send_all((const uint8_t *)&head, sizeof(head));
	assert_int_equal(end(), 0);
}

#define usb_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(a_board_at_super_speed_says_so),
		cmocka_unit_test_setup_teardown(a_board_at_high_speed_says_so, setup_high,
						teardown),
		usb_test(configurations_and_settings_are_one_each),
		usb_test(registers_are_read_and_written),
		usb_test(wrong_requests_are_stalled),
		usb_test(jobs_go_out_and_answers_come_back),
		usb_test(long_streams_and_answers_are_whole),
		usb_test(a_fault_is_an_event_that_waits_for_who_listens),
		usb_test(a_stalled_endpoint_waits_for_the_host),
		usb_test(a_cancelled_transfer_is_answered_once),
		usb_test(what_hangs_is_reset),
		usb_test(a_pulled_cable_ends_everything_without_an_answer),
		usb_test(a_cable_can_be_pulled_at_once_and_for_ever),
		usb_test(a_host_has_to_notice_before_the_cable_is_back),
		usb_test(a_reset_of_the_bus_is_none_of_the_board),
		cmocka_unit_test(the_program_ends_when_it_is_told_to),
		cmocka_unit_test(faults_are_armed_from_the_start),
		usb_test(the_plain_endpoints_take_and_give),
		usb_test(a_host_that_does_not_read_gets_all_of_it_later),
		usb_test(transfers_of_other_endpoints_are_refused),
		cmocka_unit_test(packets_with_anything_in_them_do_no_harm),
		cmocka_unit_test(bytes_that_are_no_packets_end_the_board),
		cmocka_unit_test(a_host_that_goes_in_the_middle_of_a_packet_ends_the_board_well),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
