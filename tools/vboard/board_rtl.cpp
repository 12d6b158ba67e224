// SPDX-License-Identifier: MIT
/*
 * The plugin of board.h: a Verilated board_pci, memory behind it, and a host before it.
 * BOARD_TILE, BOARD_LANES and BOARD_STREAM_BITS come from the build and are the
 * parameters the board was built with.
 */
#include <cstdio>
#include <cstdlib>
#include <new>

#include "Vboard_pci.h"
#include "board.h"
#include "board_host.h"
#include "gloss_regs.h"
#include "sim_memory.h"
#include "sim_port.h"
#include "verilated.h"

struct gloss_board {
public:
	gloss_board(const gloss_board_host *host, void *memory, uint64_t size)
		: host_(host), dma_(host), memory_(memory, size)
	{
		board_.memory_pages_i = size / GLOSS_PAGE_BYTES;
		reset();
	}

	void reset()
	{
		board_.rst_ni = 0;
		board_.reg_valid_i = 0;
		board_.host_rvalid_i = board_.host_bvalid_i = 0;
		board_.axi_rvalid_i = board_.axi_bvalid_i = 0;
		for (unsigned i = 0; i < ResetClocks; i++)
			edge();
		board_.rst_ni = 1;
		dma_.reset();
		memory_.reset();
		while (access(false, GLOSS_REG_CONTROL, 0) & GLOSS_REG_CONTROL_RESET)
			;
	}

	/* Clocks the board until it has answered: 0 for a write. */
	uint32_t access(bool write, uint32_t offset, uint32_t value)
	{
		uint32_t answer = Nobody;

		board_.reg_valid_i = 1;
		board_.reg_write_i = write;
		board_.reg_addr_i = offset;
		board_.reg_wdata_i = value;
		for (unsigned i = 0; i < AccessClocks; i++)
			if (clock(&answer))
				break;
		board_.reg_valid_i = 0;
		return answer;
	}

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
	static constexpr unsigned ResetClocks = 4;
	static constexpr unsigned AccessClocks = 16;
	static constexpr unsigned SliceClocks = 64, WorkSlices = 4;
	static constexpr uint32_t Nobody = ~0u; /* what a bus reads that nobody answers on */

	/* Nothing will change any more until a register is written. */
	bool idle()
	{
		const uint32_t still = GLOSS_REG_STATUS_IDLE | GLOSS_REG_STATUS_DMA_ERROR;

		return !(access(false, GLOSS_REG_CONTROL, 0) & GLOSS_REG_CONTROL_RESET) &&
		       (access(false, GLOSS_REG_STATUS, 0) & still);
	}

	void edge()
	{
		board_.clk_i = 0;
		board_.eval();
		board_.clk_i = 1;
		board_.eval();
	}

	/* One clock; true, and the answer, if a register access ends with it. */
	bool clock(uint32_t *answer = nullptr)
	{
		const char *violation = nullptr;

		dma_.drive(board_);
		memory_.drive(board_, stalls_);
		board_.clk_i = 0;
		board_.eval();
		dma_.sample(board_);
		memory_.sample(board_, stalls_, violation);
		if (violation)
			die(violation);
		bool ready = board_.reg_valid_i && board_.reg_ready_o;
		if (ready && answer)
			*answer = board_.reg_rdata_o;
		board_.clk_i = 1;
		board_.eval();
		interrupt();
		return ready;
	}

	void interrupt()
	{
		if (board_.irq_o != level_) {
			level_ = board_.irq_o;
			host_->level(host_->data, level_);
		}
		if (board_.irq_event_o)
			host_->event(host_->data);
	}

	/* A bug of the RTL; whatever comes after it proves nothing. */
	[[noreturn]] static void die(const char *violation)
	{
		std::fprintf(stderr, "board_pci breaks a rule of AXI: %s\n", violation);
		std::abort();
	}

	const gloss_board_host *host_;
	VerilatedContext context_;
	Vboard_pci board_{ &context_ };
	BoardHost<Vboard_pci, BOARD_STREAM_BITS> dma_;
	SimMemory<Vboard_pci, BOARD_LANES> memory_;
	SimStalls stalls_{ 0 };
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
