/* SPDX-License-Identifier: MIT */
/* A board on its cable, with its thread; the test is QEMU's usb-redir and the driver. */
#ifndef VBOARD_USB_TEST_H
#define VBOARD_USB_TEST_H

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

static inline void plug_in(bool super, const struct vboard_usb_faults_armed *armed)
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

static inline int setup(void **state)
{
	const struct vboard_usb_faults_armed nothing = { 0 };

	(void)state;
	plug_in(true, &nothing);
	peer_until(&peer, peer.connects);
	return 0;
}

/* What the thread ended with. */
static inline int end(void)
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

static inline int teardown(void **state)
{
	(void)state;
	return end();
}

/* ---- the driver ---- */

static inline uint32_t get(uint16_t offset)
{
	return peer_read_register(&peer, 0, offset);
}

static inline void put(uint16_t offset, uint32_t value)
{
	peer_write_register(&peer, 0, offset, value);
}

static inline void arm(uint16_t offset, uint32_t value)
{
	peer_write_register(&peer, 1, offset, value);
}

static inline void put_sync(void)
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

static inline void synchronise(void)
{
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	while (get(GLOSS_REG_CONTROL))
		;
	put(GLOSS_REG_NONCE, NONCE);
	put_sync();
}

/* A job of @count words at @stream, in slot 0 of which all board memory is. */
static inline uint64_t submit_job(uint32_t sequence, const uint32_t *stream, uint32_t count,
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

static inline void run_job(uint32_t sequence)
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

static inline void clear_halt(uint8_t endpoint)
{
	assert_int_equal(peer_request(&peer, 0x02, 1, 0, endpoint, 0, NULL)->status,
			 usb_redir_success);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
