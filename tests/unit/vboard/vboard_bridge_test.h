/* SPDX-License-Identifier: MIT */
/*
 * A bridge between a host, which makes transfers and keeps what became of them, and a board that
 * sends back what it gets.
 */
#ifndef VBOARD_BRIDGE_TEST_H
#define VBOARD_BRIDGE_TEST_H

#include "accel_test.h"
#include "vboard/usb/vboard.h"

#define WORDS 4096u /* that the board holds */
#define PACKET 512u
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

static inline uint32_t board_read(struct gloss_usb_board *this, uint32_t offset)
{
	return offset == GLOSS_REG_NONCE ? this->nonce : 0;
}

static inline void board_write(struct gloss_usb_board *this, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_NONCE)
		this->nonce = value;
	else
		this->count = 0;
}

static inline uint32_t board_out(struct gloss_usb_board *this, const uint32_t *words,
				 uint32_t count)
{
	uint32_t room = this->room - this->count;

	if (count > room)
		count = room;
	memcpy(this->word + this->count, words, 4 * (size_t)count);
	this->count += count;
	return count;
}

static inline uint32_t board_in(struct gloss_usb_board *this, uint32_t *words, uint32_t room,
				bool *flush)
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

static inline bool board_work(struct gloss_usb_board *this)
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

static inline void take_ended(void *user, const struct vboard_usb_transfer *transfer,
			      enum vboard_usb_status status, void *data, uint32_t bytes)
{
	struct ended *one = &ended[ended_count++];

	(void)user;
	assert_in_range(ended_count, 1, 64);
	*one = (struct ended){ .id = transfer->id, .status = status, .bytes = bytes };
	if (transfer->endpoint == GLOSS_USB_ENDPOINT_IN && bytes)
		memcpy(one->word, data, bytes);
}

static inline int setup(void **state)
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

static inline int teardown(void **state)
{
	(void)state;
	vboard_usb_bridge_fini(&bridge);
	return 0;
}

static inline uint64_t out(const void *data, uint32_t bytes)
{
	void *copy = malloc(bytes ? bytes : 1);

	assert_non_null(copy);
	memcpy(copy, data, bytes);
	assert_true(
		vboard_usb_bridge_submit(&bridge, next_id, GLOSS_USB_ENDPOINT_OUT, copy, bytes));
	return next_id++;
}

static inline uint64_t in(uint32_t bytes)
{
	assert_true(vboard_usb_bridge_submit(&bridge, next_id, GLOSS_USB_ENDPOINT_IN, NULL, bytes));
	return next_id++;
}

/* @count words, counted from @first on, the last of them the end of a burst if @burst. */
static inline uint64_t out_words(uint32_t first, uint32_t count, bool burst)
{
	uint32_t words[WORDS];

	for (uint32_t n = 0; n < count; n++)
		words[n] = first + n;
	if (burst)
		words[count - 1] = BURST_END;
	return out(words, 4 * count);
}

static inline void work(void)
{
	int calls = 0;

	while (vboard_usb_bridge_work(&bridge))
		assert_in_range(++calls, 0, 10000);
}

/* The next transfer that ended, which is @id. */
static inline const struct ended *expect(uint64_t id, enum vboard_usb_status status, uint32_t bytes)
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

static inline void expect_nothing(void)
{
	unsigned int before = ended_count;

	work();
	assert_int_equal(ended_count, before);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
