/* SPDX-License-Identifier: MIT */
/*
 * What a bench of any port has: register accesses, and the gate before the core's memory, which
 * stops when it likes and is idle some time after.
 */
#ifndef TESTS_PORT_ACCESS_H
#define TESTS_PORT_ACCESS_H

#include "tb.h"

template <class Top> class PortAccess : public Bench<Top>
{
      public:
	explicit PortAccess(uint64_t seed) : random(seed)
	{
		top.memory_pages_i = 0x12345;
		top.reg_valid_i = 0;
	}

	virtual ~PortAccess() = default;

	uint32_t read(uint32_t offset)
	{
		return access(false, offset, 0);
	}
	void write(uint32_t offset, uint32_t value)
	{
		access(true, offset, value);
	}

	/* One clock: the port's bus and core, and drive_access and sample_access for the rest. */
	virtual void clock() = 0;

	void clock(uint64_t count)
	{
		while (count-- > 0)
			clock();
	}

	using Bench<Top>::top;
	using Bench<Top>::clocks;

	Random random;
	uint64_t access_clock = 0; /* in which the last one acted */

      protected:
	void drive_access()
	{
		if (!top.memory_stop_o)
			memory_wait = random.below(30);
		else if (memory_wait > 0)
			memory_wait--;
		top.memory_stopped_i = top.memory_stop_o && memory_wait < 15;
		top.memory_idle_i = memory_wait == 0 || !top.memory_stop_o;
		TB_CHECK(top.core_rst_no || !was_running || memory_wait < 15,
			 "the core is reset before its memory has stopped");
		was_running = top.core_rst_no;
	}

	void sample_access()
	{
		access_done = top.reg_valid_i && top.reg_ready_o;
		access_answer = top.reg_rdata_o;
	}

      private:
	uint32_t access(bool write, uint32_t offset, uint32_t value)
	{
		top.reg_valid_i = 1;
		top.reg_write_i = write;
		top.reg_addr_i = offset;
		top.reg_wdata_i = value;
		access_done = false;
		for (int n = 0; !access_done; n++) {
			TB_CHECK(n < 4, "a register does not answer");
			clock();
		}
		top.reg_valid_i = 0;
		access_clock = clocks - 1;
		return access_answer;
	}

	bool access_done = false, was_running = false;
	uint32_t access_answer = 0;
	int memory_wait = 0;
};

#endif
