// SPDX-License-Identifier: MIT
/*
 * The plugin of usb.h: a Verilated board_usb and memory behind it. Each word that is
 * taken or given is a clock of the board, and no word is between it and the caller.
 * BOARD_TILE and BOARD_LANES come from the build and are the parameters the board was
 * built with.
 */
#include <new>

#include "Vboard_usb.h"
#include "vboard/board/sim.h"
#include "vboard/board/usb.h"

struct gloss_usb_board : private BoardSim<Vboard_usb, BOARD_LANES> {
public:
	gloss_usb_board(void *memory, uint64_t size) : BoardSim(memory, size) { reset(); }

	using BoardSim::access;
	using BoardSim::reset;

	void write(uint32_t offset, uint32_t value)
	{
		access(true, offset, value);
		quiet_ = 0;
	}

	uint32_t out(const uint32_t *words, uint32_t count)
	{
		uint32_t taken = 0;

		for (board_.out_valid_i = 1; taken < count && board_.out_ready_o; taken++) {
			board_.out_data_i = words[taken];
			clock();
		}
		board_.out_valid_i = 0;
		refused_ = taken < count;
		return taken;
	}

	uint32_t in(uint32_t *words, uint32_t room, bool *flush)
	{
		uint32_t count = 0;

		*flush = false;
		board_.in_ready_i = 1;
		for (unsigned gap = 0; count < room && gap < GapClocks && !*flush; clock()) {
			if (board_.in_valid_o) {
				words[count++] = board_.in_data_o;
				*flush = board_.in_flush_o;
				gap = 0;
			} else if (count) {
				gap++;
			} else {
				break;
			}
		}
		board_.in_ready_i = 0;
		return count;
	}

	bool event(uint32_t words[2])
	{
		if (!board_.event_valid_o)
			return false;
		words[0] = sim_get(board_.event_o, 0);
		words[1] = sim_get(board_.event_o, 1);
		board_.event_ready_i = 1;
		clock();
		board_.event_ready_i = 0;
		return true;
	}

	bool work()
	{
		const bool full = !board_.out_ready_o;

		for (unsigned slice = 0; slice < WorkSlices; slice++) {
			for (unsigned i = 0; i < SliceClocks; i++)
				clock();
			if (idle())
				return full && board_.out_ready_o;
			if (board_.in_valid_o)
				break;
		}
		return true;
	}

private:
	static constexpr unsigned GapClocks = 4; /* between words that leave one after the other */

	/*
	 * A core that waits for words, or for words to be taken, still draws what it has: up to
	 * a queue of triangles, each as large as a tile.
	 */
	static constexpr unsigned StillClocks = 128 * BOARD_TILE * BOARD_TILE / BOARD_LANES;

	/* Nothing will change any more until a register is written or a word moves. */
	bool idle()
	{
		uint32_t progress;

		if (resetting())
			return false;
		if (access(false, GLOSS_REG_STATUS, 0) & GLOSS_REG_STATUS_IDLE)
			return true;
		progress = access(false, GLOSS_REG_PROGRESS, 0);
		if (progress != progress_)
			quiet_ = 0;
		progress_ = progress;
		return quiet_ >= StillClocks;
	}

	/* There was no room for a word, and now there is. */
	bool again()
	{
		bool again = refused_ && board_.out_ready_o;

		refused_ = false;
		return again;
	}

	void still() override
	{
		board_.out_valid_i = board_.in_ready_i = board_.event_ready_i = 0;
		refused_ = false;
		quiet_ = 0;
	}

	void drive() override {}

	void sample(bool moved) override
	{
		if (moved || (board_.out_valid_i && board_.out_ready_o) ||
		    (board_.in_valid_o && board_.in_ready_i))
			quiet_ = 0;
		else
			quiet_++;
	}

	bool refused_ = false; /* the last word that was offered */
	unsigned quiet_ = 0; /* clocks since something moved */
	uint32_t progress_ = 0;
};

namespace
{

struct gloss_usb_board *create(void *memory, uint64_t size)
{
	try {
		return new gloss_usb_board(memory, size);
	} catch (const std::bad_alloc &) {
		return nullptr;
	}
}

void destroy(struct gloss_usb_board *board)
{
	delete board;
}

uint32_t read(struct gloss_usb_board *board, uint32_t offset)
{
	return board->access(false, offset, 0);
}

void write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	board->write(offset, value);
}

uint32_t out(struct gloss_usb_board *board, const uint32_t *words, uint32_t count)
{
	return board->out(words, count);
}

uint32_t in(struct gloss_usb_board *board, uint32_t *words, uint32_t room, bool *flush)
{
	return board->in(words, room, flush);
}

bool event(struct gloss_usb_board *board, uint32_t words[2])
{
	return board->event(words);
}

bool work(struct gloss_usb_board *board)
{
	return board->work();
}

void reset(struct gloss_usb_board *board)
{
	board->reset();
}

} /* namespace */

extern "C" const struct gloss_usb_board_ops gloss_usb_board;
const struct gloss_usb_board_ops gloss_usb_board = {
	GLOSS_USB_BOARD_ABI, GLOSS_VERSION, BOARD_TILE, BOARD_LANES, create, destroy, read, write,
	out, in, event, work, reset,
};
