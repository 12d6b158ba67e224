// SPDX-License-Identifier: MIT
/*
 * What plugins of Verilated boards share: clock and reset, register accesses, and board
 * memory. The other ports are those of the board's bus: who derives from this drives and
 * samples them.
 */
#ifndef VBOARD_BOARD_SIM_H
#define VBOARD_BOARD_SIM_H

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "gloss_regs.h"
#include "sim/sim_memory.h"
#include "sim/sim_port.h"
#include "verilated.h"

template <class Board, unsigned Lanes> class BoardSim
{
      public:
	BoardSim(void *memory, uint64_t size) : memory_(memory, size)
	{
		board_.memory_pages_i = size / GLOSS_PAGE_BYTES;
	}

	/* Scopes of a board leave the context of the thread, which is that of the board made last. */
	virtual ~BoardSim()
	{
		Verilated::threadContextp(&context_);
	}

	/* Power on; its end is CONTROL.reset's, too. */
	void reset()
	{
		board_.rst_ni = 0;
		board_.reg_valid_i = 0;
		board_.axi_rvalid_i = board_.axi_bvalid_i = 0;
		still();
		for (unsigned i = 0; i < ResetClocks; i++)
			edge();
		board_.rst_ni = 1;
		memory_.reset();
		while (resetting())
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

      protected:
	static constexpr unsigned SliceClocks = 64, WorkSlices = 4; /* of work() */

	/* The bus at reset: nothing comes from it, and nothing is under way. */
	virtual void still() = 0;
	/* Sets the bus's inputs for the coming clock edge. */
	virtual void drive() = 0;
	/* Takes what the board hands over at this edge; @moved: something did at its memory. */
	virtual void sample(bool moved) = 0;
	/* The edge is past. */
	virtual void notice()
	{
	}

	bool resetting()
	{
		return access(false, GLOSS_REG_CONTROL, 0) & GLOSS_REG_CONTROL_RESET;
	}

	/* One clock; true, and the answer, if a register access ends with it. */
	bool clock(uint32_t *answer = nullptr)
	{
		const char *violation = nullptr;

		drive();
		memory_.drive(board_, stalls_);
		board_.clk_i = 0;
		board_.eval();
		bool moved = memory_.sample(board_, stalls_, violation);
		if (violation)
			die(violation);
		sample(moved);
		bool ready = board_.reg_valid_i && board_.reg_ready_o;
		if (ready && answer)
			*answer = board_.reg_rdata_o;
		board_.clk_i = 1;
		board_.eval();
		notice();
		return ready;
	}

      private:
	static constexpr unsigned ResetClocks = 4;
	static constexpr unsigned AccessClocks = 16;
	static constexpr uint32_t Nobody = ~0u; /* what a bus reads that nobody answers on */

	void edge()
	{
		board_.clk_i = 0;
		board_.eval();
		board_.clk_i = 1;
		board_.eval();
	}

	/* A bug of the RTL; whatever comes after it proves nothing. */
	[[noreturn]] static void die(const char *violation)
	{
		std::fprintf(stderr, "the board breaks a rule of AXI: %s\n", violation);
		std::abort();
	}

	VerilatedContext context_;

      protected:
	Board board_{ &context_ };

      private:
	SimMemory<Board, Lanes> memory_;
	SimStalls stalls_{ 0 };
};

#endif
