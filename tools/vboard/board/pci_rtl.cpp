// SPDX-License-Identifier: MIT
/*
 * The plugin of board.h: a Verilated board_pci, memory behind it, and a host before it.
 * BOARD_TILE, BOARD_LANES and BOARD_STREAM_BITS come from the build and are the
 * parameters the board was built with.
 */
#include <new>

#include "Vboard_pci.h"
#include "vboard/board/board.h"
#include "vboard/board/host.h"
#include "vboard/board/sim.h"

struct gloss_board : private BoardSim<Vboard_pci, BOARD_LANES> {
public:
	gloss_board(const gloss_board_host *host, void *memory, uint64_t size)
		: BoardSim(memory, size), host_(host), dma_(host)
	{
		board_.msi_ready_i = 1;
		reset();
	}

	using BoardSim::access;
	using BoardSim::reset;

	bool work()
	{
		for (unsigned slice = 0; slice < WorkSlices; slice++) {
			for (unsigned i = 0; i < SliceClocks; i++)
				clock();
			if (idle())
				return false;
		}
		return true;
	}

private:
	/* Nothing will change any more until a register is written. */
	bool idle()
	{
		const uint32_t still = GLOSS_REG_STATUS_IDLE | GLOSS_REG_STATUS_DMA_ERROR;

		return !resetting() && (access(false, GLOSS_REG_STATUS, 0) & still);
	}

	void still() override
	{
		board_.host_rvalid_i = board_.host_bvalid_i = 0;
		dma_.reset();
	}

	void drive() override { dma_.drive(board_); }
	void sample(bool) override { dma_.sample(board_); }

	void notice() override
	{
		if (board_.irq_o != level_) {
			level_ = board_.irq_o;
			host_->level(host_->data, level_);
		}
		if (board_.msi_valid_o)
			host_->event(host_->data);
	}

	const gloss_board_host *host_;
	BoardHost<Vboard_pci, BOARD_STREAM_BITS> dma_;
	bool level_ = false;
};

namespace
{

struct gloss_board *create(const struct gloss_board_host *host, void *memory, uint64_t size)
{
	try {
		return new gloss_board(host, memory, size);
	} catch (const std::bad_alloc &) {
		return nullptr;
	}
}

void destroy(struct gloss_board *board)
{
	delete board;
}

uint32_t read(struct gloss_board *board, uint32_t offset)
{
	return board->access(false, offset, 0);
}

void write(struct gloss_board *board, uint32_t offset, uint32_t value)
{
	board->access(true, offset, value);
}

bool work(struct gloss_board *board)
{
	return board->work();
}

void reset(struct gloss_board *board)
{
	board->reset();
}

} /* namespace */

extern "C" const struct gloss_board_ops gloss_board;
const struct gloss_board_ops gloss_board = {
	GLOSS_BOARD_ABI, GLOSS_VERSION, BOARD_TILE, BOARD_LANES, create, destroy, read, write, work,
	reset,
};
