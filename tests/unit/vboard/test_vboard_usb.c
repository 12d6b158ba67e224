/* SPDX-License-Identifier: MIT */
/* What a board on a cable says it is, and what it answers to requests and on its endpoints. */
#include "vboard_usb_test.h"

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

static int setup_high(void **state)
{
	const struct vboard_usb_faults_armed nothing = { 0 };

	(void)state;
	plug_in(false, &nothing);
	peer_until(&peer, peer.connects);
	return 0;
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

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_board_at_super_speed_says_so),
		cmocka_unit_test_setup_teardown(a_board_at_high_speed_says_so, setup_high,
						teardown),
		TEST(configurations_and_settings_are_one_each),
		TEST(registers_are_read_and_written),
		TEST(wrong_requests_are_stalled),
		TEST(the_plain_endpoints_take_and_give),
		TEST(a_host_that_does_not_read_gets_all_of_it_later),
		TEST(transfers_of_other_endpoints_are_refused),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
