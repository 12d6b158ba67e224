/* SPDX-License-Identifier: MIT */
/* A board on USB that is odd: a test puts other values in place of what it says of its progress, and
 * other words among those that it sends. */
#ifndef USB_ODD_H
#define USB_ODD_H

#include "transport/usb/checksum.h"
#include "usb_test.h"

/* Set while the board is looked at by the thread of the link. */
static struct {
	_Atomic uint32_t progress, step; /* of PROGRESS, at each read */
	_Atomic unsigned int reads;      /* of it; before so many the board takes nothing */
	_Atomic unsigned int reads_to_work;
	_Atomic unsigned int completions;                    /* yet to come before one is a fault */
	_Atomic uint32_t forged[GLOSS_USB_COMPLETION_WORDS]; /* to come before all others */
	unsigned int left; /* words yet to come of the completion that is a fault */
	uint32_t checksum; /* of those before them: its job has no response */
} odd;

static inline uint32_t odd_read(struct gloss_usb_board *board, uint32_t offset)
{
	if (offset != GLOSS_REG_PROGRESS || !odd.step)
		return gloss_usb_board_model_t64.read(board, offset);
	odd.reads++;
	odd.progress += odd.step;
	return odd.progress;
}

/* A reset is to help. */
static inline void odd_write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL)
		odd.reads_to_work = 0;
	gloss_usb_board_model_t64.write(board, offset, value);
}

static inline uint32_t odd_out(struct gloss_usb_board *board, const uint32_t *words, uint32_t count)
{
	if (odd.reads < odd.reads_to_work)
		return 0;
	return gloss_usb_board_model_t64.out(board, words, count);
}

/* Makes the completion a fault that is due, with the checksum that it then has. */
static inline uint32_t odd_word(uint32_t word)
{
	if (odd.left && !--odd.left)
		return odd.checksum;
	if (word == GLOSS_USB_COMPLETION_MAGIC << 16 && odd.completions && !--odd.completions) {
		word |= GLOSS_FAULT_MEMORY;
		odd.left = GLOSS_USB_COMPLETION_WORDS - 1;
		odd.checksum = 0;
	}
	odd.checksum = accel_usb_checksum(odd.checksum, &word, 1);
	return word;
}

static inline uint32_t odd_in(struct gloss_usb_board *board, uint32_t *words, uint32_t room,
			      bool *flush)
{
	uint32_t count;

	if (odd.forged[0] && room >= GLOSS_USB_COMPLETION_WORDS) {
		for (int i = 0; i < GLOSS_USB_COMPLETION_WORDS; i++)
			words[i] = odd.forged[i];
		odd.forged[0] = 0;
		*flush = false;
		return GLOSS_USB_COMPLETION_WORDS;
	}
	count = gloss_usb_board_model_t64.in(board, words, room, flush);
	for (uint32_t i = 0; i < count; i++)
		words[i] = odd_word(words[i]);
	return count;
}

static inline int odd_setup(void **state)
{
	static struct gloss_usb_board_ops board;
	struct accel_transport_error error = { "" };

	odd.step = odd.reads = odd.reads_to_work = odd.completions = odd.forged[0] = 0;
	odd.left = 0;
	board = gloss_usb_board_model_t64;
	board.read = odd_read;
	board.write = odd_write;
	board.out = odd_out;
	board.in = odd_in;
	fake_usb_start(test_seed());
	fake_usb_unplug(0);
	fake_usb.board[0].ops = &board;
	fake_usb_plug(0, true);
	return ops->open("", state, &error);
}

#define odd_test(name) cmocka_unit_test_setup_teardown(name, odd_setup, usb_teardown)

#endif
