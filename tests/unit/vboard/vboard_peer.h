/* SPDX-License-Identifier: MIT */
/* QEMU's usb-redir, for tests: the other end of a USB board's cable. */
#ifndef VBOARD_PEER_H
#define VBOARD_PEER_H

#include <poll.h>
#include <sys/socket.h>
#include <usbredirparser.h>

#include "accel_test.h"

#define PEER_ANSWERS 4096

/* To a control or bulk transfer. */
struct test_answer {
	bool there;
	uint8_t status, endpoint;
	uint32_t length; /* that the head says */
	uint8_t *data;   /* as many bytes of IN; of OUT none */
};

struct test_peer {
	struct usbredirparser *parser;
	int socket;
	bool reads; /* or leaves what it is sent where it is */
	unsigned int connects, disconnects, interrupts;
	struct usb_redir_device_connect_header device;
	struct usb_redir_interface_info_header interfaces;
	struct usb_redir_ep_info_header endpoints;
	int configuration_status, configuration, setting_status, interrupt_status;
	uint8_t interrupt[8]; /* the last one */
	uint64_t next_id;
	struct test_answer answer[PEER_ANSWERS];
};

/* ---- what the board sends ---- */

static inline void peer_log(void *data, int level, const char *message)
{
	(void)data;
	if (level <= usbredirparser_warning)
		print_message("peer: %s\n", message);
}

static inline int peer_read(void *data, uint8_t *bytes, int count)
{
	struct test_peer *peer = data;
	ssize_t got = recv(peer->socket, bytes, (size_t)count, MSG_DONTWAIT);

	return got > 0 ? (int)got : got < 0 && errno == EAGAIN ? 0 : -1;
}

static inline int peer_write(void *data, uint8_t *bytes, int count)
{
	struct test_peer *peer = data;
	ssize_t sent = send(peer->socket, bytes, (size_t)count, MSG_DONTWAIT | MSG_NOSIGNAL);

	return sent >= 0 ? (int)sent : errno == EAGAIN ? 0 : -1;
}

static inline void peer_connect(void *data, struct usb_redir_device_connect_header *device)
{
	struct test_peer *peer = data;

	peer->device = *device;
	peer->connects++;
}

static inline void peer_disconnect(void *data)
{
	((struct test_peer *)data)->disconnects++;
}

static inline void peer_interfaces(void *data, struct usb_redir_interface_info_header *info)
{
	((struct test_peer *)data)->interfaces = *info;
}

static inline void peer_endpoints(void *data, struct usb_redir_ep_info_header *info)
{
	((struct test_peer *)data)->endpoints = *info;
}

static inline void peer_configured(void *data, uint64_t id,
				   struct usb_redir_configuration_status_header *status)
{
	struct test_peer *peer = data;

	(void)id;
	peer->configuration_status = status->status;
	peer->configuration = status->configuration;
}

static inline void peer_set(void *data, uint64_t id,
			    struct usb_redir_alt_setting_status_header *status)
{
	(void)id;
	((struct test_peer *)data)->setting_status = status->status;
}

static inline void peer_listening(void *data, uint64_t id,
				  struct usb_redir_interrupt_receiving_status_header *status)
{
	(void)id;
	((struct test_peer *)data)->interrupt_status = status->status;
}

static inline void peer_iso(void *data, uint64_t id,
			    struct usb_redir_iso_stream_status_header *status)
{
	(void)data, (void)id;
	assert_int_not_equal(status->status, usb_redir_success);
}

static inline void peer_streams(void *data, uint64_t id,
				struct usb_redir_bulk_streams_status_header *status)
{
	(void)data, (void)id;
	assert_int_not_equal(status->status, usb_redir_success);
}

static inline void peer_answer(struct test_peer *peer, uint64_t id, struct test_answer answer)
{
	assert_in_range(id, 0, PEER_ANSWERS - 1);
	assert_false(peer->answer[id].there);
	answer.there = true;
	peer->answer[id] = answer;
}

static inline void peer_control(void *data, uint64_t id,
				struct usb_redir_control_packet_header *head, uint8_t *bytes,
				int count)
{
	(void)count;
	peer_answer(data, id,
		    (struct test_answer){ .status = head->status,
					  .length = head->length,
					  .endpoint = head->endpoint,
					  .data = bytes });
}

static inline void peer_bulk(void *data, uint64_t id, struct usb_redir_bulk_packet_header *head,
			     uint8_t *bytes, int count)
{
	uint32_t length = head->length | (uint32_t)head->length_high << 16;

	(void)count;
	peer_answer(data, id,
		    (struct test_answer){ .status = head->status,
					  .length = length,
					  .endpoint = head->endpoint,
					  .data = bytes });
}

static inline void peer_interrupt(void *data, uint64_t id,
				  struct usb_redir_interrupt_packet_header *head, uint8_t *bytes,
				  int count)
{
	struct test_peer *peer = data;

	(void)id;
	if (head->status == usb_redir_success) {
		assert_int_equal(count, sizeof(peer->interrupt));
		memcpy(peer->interrupt, bytes, sizeof(peer->interrupt));
	}
	peer->interrupts++;
	usbredirparser_free_packet_data(peer->parser, bytes);
}

/* ---- beginning and end ---- */

static inline void peer_callbacks(struct usbredirparser *parser)
{
	parser->log_func = peer_log;
	parser->read_func = peer_read;
	parser->write_func = peer_write;
	parser->device_connect_func = peer_connect;
	parser->device_disconnect_func = peer_disconnect;
	parser->interface_info_func = peer_interfaces;
	parser->ep_info_func = peer_endpoints;
	parser->configuration_status_func = peer_configured;
	parser->alt_setting_status_func = peer_set;
	parser->interrupt_receiving_status_func = peer_listening;
	parser->iso_stream_status_func = peer_iso;
	parser->bulk_streams_status_func = peer_streams;
	parser->control_packet_func = peer_control;
	parser->bulk_packet_func = peer_bulk;
	parser->interrupt_packet_func = peer_interrupt;
}

static inline void peer_init(struct test_peer *peer, int socket)
{
	static const int can[] = { usb_redir_cap_connect_device_version,
				   usb_redir_cap_ep_info_max_packet_size, usb_redir_cap_64bits_ids,
				   usb_redir_cap_32bits_bulk_length };
	uint32_t caps[USB_REDIR_CAPS_SIZE] = { 0 };

	memset(peer, 0, sizeof(*peer));
	peer->socket = socket;
	peer->reads = true;
	peer->next_id = 1;
	peer->parser = usbredirparser_create();
	peer->parser->priv = peer;
	peer_callbacks(peer->parser);
	for (size_t i = 0; i < sizeof(can) / sizeof(can[0]); i++)
		usbredirparser_caps_set_cap(caps, can[i]);
	usbredirparser_init(peer->parser, "a test", caps, USB_REDIR_CAPS_SIZE, 0);
}

static inline void peer_fini(struct test_peer *peer)
{
	for (int i = 0; i < PEER_ANSWERS; i++)
		usbredirparser_free_packet_data(peer->parser, peer->answer[i].data);
	usbredirparser_destroy(peer->parser);
	close(peer->socket);
}

/* ---- waiting ---- */

/* Sends and receives what can be, for at most @ms. False: the board is gone. */
static inline bool peer_move(struct test_peer *peer, int ms)
{
	struct pollfd polls = { .fd = peer->socket, .events = peer->reads ? POLLIN : 0 };

	if (usbredirparser_do_write(peer->parser) < 0)
		return false;
	if (usbredirparser_has_data_to_write(peer->parser))
		polls.events |= POLLOUT;
	poll(&polls, 1, ms);
	if (polls.revents & POLLIN && usbredirparser_do_read(peer->parser) < 0)
		return false;
	return !(polls.revents & (POLLHUP | POLLERR)) && usbredirparser_do_write(peer->parser) >= 0;
}

/* Until @condition holds; fails if that takes too long. */
#define peer_until(peer, condition)                              \
	do {                                                     \
		int peer_left = test_patience_ms();              \
                                                                 \
		while (!(condition)) {                           \
			if (!peer_move(peer, 1) || !peer_left--) \
				fail_msg("no %s", #condition);   \
		}                                                \
	} while (0)

/* Moves for @ms in which nothing is to be answered to @id. */
static inline void peer_nothing(struct test_peer *peer, uint64_t id, int ms)
{
	while (ms--) {
		assert_true(peer_move(peer, 1));
		assert_false(peer->answer[id].there);
	}
}

/* ---- transfers ---- */

static inline uint64_t peer_submit_control(struct test_peer *peer, uint8_t type, uint8_t request,
					   uint16_t value, uint16_t index, uint16_t length,
					   const void *data)
{
	struct usb_redir_control_packet_header head = {
		.endpoint = type & 0x80,
		.requesttype = type,
		.request = request,
		.value = value,
		.index = index,
		.length = length,
	};
	uint8_t copy[256];
	bool out = !(type & 0x80);

	if (out && data)
		memcpy(copy, data, length);
	usbredirparser_send_control_packet(peer->parser, peer->next_id, &head, out ? copy : NULL,
					   out ? length : 0);
	return peer->next_id++;
}

static inline uint64_t peer_submit(struct test_peer *peer, uint8_t endpoint, const void *data,
				   uint32_t bytes)
{
	struct usb_redir_bulk_packet_header head = {
		.endpoint = endpoint,
		.length = (uint16_t)bytes,
		.length_high = (uint16_t)(bytes >> 16),
	};
	bool out = !(endpoint & 0x80);

	/* The parser does not change it. */
	usbredirparser_send_bulk_packet(peer->parser, peer->next_id, &head,
					out ? (uint8_t *)(uintptr_t)data : NULL,
					out ? (int)bytes : 0);
	return peer->next_id++;
}

/* The answer to @id, which stays the peer's. */
static inline const struct test_answer *peer_wait(struct test_peer *peer, uint64_t id)
{
	peer_until(peer, peer->answer[id].there);
	return &peer->answer[id];
}

static inline const struct test_answer *peer_request(struct test_peer *peer, uint8_t type,
						     uint8_t request, uint16_t value,
						     uint16_t index, uint16_t length,
						     const void *data)
{
	return peer_wait(peer,
			 peer_submit_control(peer, type, request, value, index, length, data));
}

static inline const struct test_answer *peer_transfer(struct test_peer *peer, uint8_t endpoint,
						      const void *data, uint32_t bytes)
{
	return peer_wait(peer, peer_submit(peer, endpoint, data, bytes));
}

static inline void peer_write_register(struct test_peer *peer, uint16_t interface, uint16_t offset,
				       uint32_t value)
{
	const struct test_answer *answer = peer_request(peer, 0x41, 2, offset, interface, 4,
							&value);

	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, 4);
}

static inline uint32_t peer_read_register(struct test_peer *peer, uint16_t interface,
					  uint16_t offset)
{
	const struct test_answer *answer = peer_request(peer, 0xc1, 1, offset, interface, 4, NULL);
	uint32_t value;

	assert_int_equal(answer->status, usb_redir_success);
	assert_int_equal(answer->length, 4);
	memcpy(&value, answer->data, sizeof(value));
	return value;
}

#endif
