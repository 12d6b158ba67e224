/* SPDX-License-Identifier: MIT */
/* A board on a cable whose host is broken: packets that have anything in them, or are none. */
#include "vboard_usb_test.h"

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

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(packets_with_anything_in_them_do_no_harm),
		cmocka_unit_test(bytes_that_are_no_packets_end_the_board),
		cmocka_unit_test(a_host_that_goes_in_the_middle_of_a_packet_ends_the_board_well),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
