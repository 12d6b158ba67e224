// SPDX-License-Identifier: MIT
#include "fuzz_usb_board.h"

#include <string.h>

#include "fuzz_usb_input.h"
#include "gloss_packets.h"
#include "gloss_regs.h"
#include "transport/usb/checksum.h"

#define ENDLESS_WORDS 64u

static struct {
	const struct gloss_usb_board_ops *honest;
	struct gloss_usb_board *board;
	uint8_t flags;
	const uint8_t *data;
	size_t left;
	uint32_t pass;    /* honest words yet to come */
	uint32_t made_up; /* words of a chunk yet to come */
	uint32_t nonce;
	/* Of the answer that leaves: words yet to come of a chunk, of a completion; its checksum. */
	uint32_t chunk, completion, checksum;
} hostile;

/* ---- the input: zeros behind its end ---- */

static uint8_t take(void)
{
	if (!hostile.left)
		return 0;
	hostile.left--;
	return *hostile.data++;
}

static uint32_t take_word(void)
{
	uint32_t word = take();

	for (int n = 1; n < 4; n++)
		word |= (uint32_t)take() << 8 * n;
	return word;
}

static struct gloss_usb_board *board_create(void *memory, uint64_t size)
{
	hostile.board = hostile.honest->create(memory, size);
	return hostile.board;
}

static void board_destroy(struct gloss_usb_board *board)
{
	hostile.honest->destroy(board);
}

static uint32_t board_read(struct gloss_usb_board *board, uint32_t offset)
{
	if (hostile.flags & FUZZ_USB_REGISTERS && hostile.left && take() >= 0xe0)
		return take_word();
	return hostile.honest->read(board, offset);
}

static void board_write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_NONCE)
		hostile.nonce = value;
	if (offset == GLOSS_REG_CONTROL)
		hostile.chunk = hostile.completion = hostile.checksum = 0;
	hostile.honest->write(board, offset, value);
}

static uint32_t board_out(struct gloss_usb_board *board, const uint32_t *words, uint32_t count)
{
	return hostile.honest->out(board, words, count);
}

static uint32_t honest_in(uint32_t *words, uint32_t room, bool *flush)
{
	return hostile.honest->in(hostile.board, words, room, flush);
}

static uint32_t in_passed(uint32_t *words, uint32_t room, bool *flush)
{
	uint32_t count = honest_in(words, room < hostile.pass ? room : hostile.pass, flush);

	hostile.pass -= count;
	return count;
}

static uint32_t in_made_up(uint32_t *words, uint32_t room)
{
	uint32_t count = 0;

	while (count < room && hostile.made_up) {
		words[count++] = 0x5a5a0000 + hostile.made_up;
		hostile.made_up--;
	}
	return count;
}

/* When the input has ended. */
static uint32_t in_after(uint32_t *words, uint32_t room, bool *flush)
{
	switch (hostile.flags & FUZZ_USB_AFTER) {
	case FUZZ_USB_AFTER_SILENCE:
		return 0;
	case FUZZ_USB_AFTER_ENDLESS:
		hostile.made_up = ENDLESS_WORDS;
		return in_made_up(words, room);
	default:
		return honest_in(words, room, flush);
	}
}

static uint32_t in_xor(uint32_t *words, bool *flush)
{
	uint32_t count = honest_in(words, 1, flush);

	words[0] ^= count ? take_word() : 0;
	return count;
}

static uint32_t in_dropped(uint32_t *words, uint32_t count)
{
	bool flush;

	while (count-- && honest_in(words, 1, &flush))
		;
	return 0;
}

static uint32_t take_half(void)
{
	uint32_t half = take();

	return half | (uint32_t)take() << 8;
}

static uint32_t in_chunk(uint32_t *words)
{
	uint32_t count = take_half();

	gloss_usb_response_pack(words, &(struct gloss_usb_response){
					       .count = count, .mark = GLOSS_USB_RESPONSE_MAGIC });
	hostile.made_up = count;
	return GLOSS_USB_RESPONSE_WORDS;
}

static uint32_t in_completion(uint32_t *words)
{
	struct gloss_usb_completion completion = { .mark = GLOSS_USB_COMPLETION_MAGIC };

	completion.cause = take() % 16u;
	completion.sequence = take();
	completion.offset = take_half();
	completion.response_words = take_half();
	gloss_usb_completion_pack(words, &completion);
	return GLOSS_USB_COMPLETION_WORDS;
}

static uint32_t in_sync(uint32_t *words)
{
	gloss_usb_sync_pack(words,
			    &(struct gloss_usb_sync){ .mark = GLOSS_USB_SYNC_MAGIC,
						      .nonce = hostile.nonce,
						      .nonce_complement = ~hostile.nonce,
						      .mark_complement = ~GLOSS_USB_SYNC_MAGIC });
	return GLOSS_USB_SYNC_WORDS;
}

static uint32_t in_raw(uint32_t *words, uint32_t count, uint32_t room)
{
	count = count < room ? count : room;
	for (uint32_t n = 0; n < count; n++)
		words[n] = take_word();
	return count;
}

/* What has no room for a completion waits for the next packet. */
static uint32_t in_any(uint32_t *words, uint32_t room, bool *flush)
{
	uint8_t piece;

	*flush = false;
	if (hostile.pass)
		return in_passed(words, room, flush);
	if (hostile.made_up)
		return in_made_up(words, room);
	if (!hostile.left)
		return in_after(words, room, flush);
	if (room < GLOSS_USB_COMPLETION_WORDS)
		return honest_in(words, room, flush);
	piece = take();
	if (piece < 0x80) {
		hostile.pass = 4u * piece + 1;
		return in_passed(words, room, flush);
	}
	switch (piece & 0xf0) {
	case 0xa0:
		return in_xor(words, flush);
	case 0xb0:
		return in_dropped(words, (piece & 0xfu) + 1);
	case 0xc0:
		return in_chunk(words);
	case 0xd0:
		return in_completion(words);
	case 0xe0:
		return in_sync(words);
	case 0xf0:
		*flush = true;
		return 0;
	default:
		return in_raw(words, (piece & 0x1fu) + 1, room);
	}
}

/* What a word of a completion becomes: the last one is its checksum. */
static uint32_t seal_completion(uint32_t word)
{
	uint32_t sum = hostile.checksum;

	if (--hostile.completion) {
		hostile.checksum = accel_usb_checksum(sum, &word, 1);
		return word;
	}
	hostile.checksum = 0;
	return hostile.flags & FUZZ_USB_CHECKSUMS ? word : sum;
}

/* What a word that leaves becomes. */
static uint32_t seal(uint32_t word)
{
	if (hostile.completion)
		return seal_completion(word);
	if (hostile.chunk) {
		hostile.chunk--;
		hostile.checksum = accel_usb_checksum(hostile.checksum, &word, 1);
	} else if (word >> 16 == GLOSS_USB_RESPONSE_MAGIC) {
		hostile.chunk = word & 0xffff;
	} else if (word >> 16 == GLOSS_USB_COMPLETION_MAGIC) {
		hostile.completion = GLOSS_USB_COMPLETION_WORDS;
		return seal_completion(word);
	}
	return word;
}

static uint32_t board_in(struct gloss_usb_board *board, uint32_t *words, uint32_t room, bool *flush)
{
	uint32_t count = in_any(words, room, flush);

	(void)board;
	for (uint32_t n = 0; n < count; n++)
		words[n] = seal(words[n]);
	return count;
}

static bool board_event(struct gloss_usb_board *board, uint32_t words[2])
{
	return hostile.honest->event(board, words);
}

static bool board_work(struct gloss_usb_board *board)
{
	return hostile.honest->work(board);
}

static void board_reset(struct gloss_usb_board *board)
{
	hostile.honest->reset(board);
}

static const struct gloss_usb_board_ops hostile_ops = {
	.abi = GLOSS_USB_BOARD_ABI,
	.version = GLOSS_VERSION,
	.tile_size = 64,
	.pixels_per_clock = 1,
	.create = board_create,
	.destroy = board_destroy,
	.read = board_read,
	.write = board_write,
	.out = board_out,
	.in = board_in,
	.event = board_event,
	.work = board_work,
	.reset = board_reset,
};

const struct gloss_usb_board_ops *fuzz_usb_board(uint8_t flags, const uint8_t *data, size_t size)
{
	memset(&hostile, 0, sizeof(hostile));
	hostile.honest = flags & FUZZ_USB_SMALL ? &gloss_usb_board_model_t32 :
						  &gloss_usb_board_model_t64;
	hostile.flags = flags;
	hostile.data = data;
	hostile.left = size;
	return &hostile_ops;
}
