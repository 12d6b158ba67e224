/* SPDX-License-Identifier: MIT */
/*
 * port_pci between host memory and a stand-in for the core, and the driver's side of it: rings, jobs
 * with everything they need in host memory, and the check of each job at the clock of its interrupt.
 */
#ifndef TESTS_PORT_BENCH_H
#define TESTS_PORT_BENCH_H

#include "Vport_pci.h"
#include "gloss_packets.h"
#include "gloss_regs.h"
#include "port_access.h"
#include "port_core.h"
#include "port_host.h"

struct PortJob {
	uint32_t sequence, room;
	std::vector<uint32_t> stream;
	PortAnswer answer;
	std::vector<PortSlot> slots;
	uint32_t entry;                 /* in the ring */
	uint64_t table;                 /* of slots */
	std::vector<uint64_t> pages;    /* of the response */
	std::vector<uint32_t> expected; /* all words of these */
	std::vector<uint64_t> starts;   /* of what is its own: slot table, lists, pages */

	bool owns(uint64_t address) const
	{
		/* An entry of a list may come with the one before it. */
		auto near = [address](uint64_t start) { return address + 8 - start < 4096 + 8; };

		return std::any_of(starts.begin(), starts.end(), near);
	}
};

class PortBench : public PortAccess<Vport_pci>
{
      public:
	explicit PortBench(uint64_t seed) : PortAccess(seed), host(random), core(random)
	{
		kind();
	}

	/* Nothing stalls. */
	void kind(int latency = 20)
	{
		host.steady(latency);
		core.stalls = false;
	}

	void unkind()
	{
		host.unkind();
		core.stalls = true;
	}

	/* Resets the port, as a driver does, and forgets all jobs. Returns how long that took. */
	uint64_t reset_port()
	{
		uint64_t start = clocks;

		write(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET | random.below(2));
		while (read(GLOSS_REG_CONTROL))
			TB_CHECK(clocks - start < 2000, "the reset does not end");
		TB_CHECK(host.idle(), "reset, but DMA is under way");
		jobs.clear();
		tail = head = 0;
		progress = finished = 0;
		for (uint64_t &sum : time)
			sum = 0;
		return clocks - start;
	}

	/* A new ring of 2^log2 entries in empty host memory. */
	void start(uint32_t log2, uint32_t mask)
	{
		reset_port();
		host.unmap_all();
		host.strict = true;
		host.refuse = -1;
		host.refuse_rest = false;
		host.refusals.clear();
		core.hung = false;
		entries = 1u << std::min<uint32_t>(log2, GLOSS_RING_MAX_LOG2);
		ring = place(64 * entries, 64);
		records = place(16 * entries, 16);
		write(GLOSS_REG_RING_LOW, (uint32_t)ring | random.below(64));
		write(GLOSS_REG_RING_HIGH, ring >> 32);
		write(GLOSS_REG_RING_LOG2, log2);
		write(GLOSS_REG_COMPLETION_LOW, (uint32_t)records | random.below(16));
		write(GLOSS_REG_COMPLETION_HIGH, records >> 32);
		write(GLOSS_REG_INTERRUPT_MASK, mask);
		write(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
	}

	PortJob job(uint32_t stream_words, uint32_t answer_words)
	{
		PortJob job = {};

		job.sequence = random.bits();
		job.room = answer_words + (random.chance(50) ? random.below(5000) : 0);
		for (uint32_t n = 0; n < stream_words; n++)
			job.stream.push_back(random.bits());
		for (uint32_t n = 0; n < answer_words; n++)
			job.answer.words.push_back(random.bits());
		job.answer.cause = random.chance(30) ? random.between(1, 7) : 0;
		job.answer.offset = random.bits();
		for (uint32_t &count : job.answer.time)
			count = random.bits();
		for (int n = 0; n < 16; n++)
			job.slots.push_back({ random.bits(), random.bits(), random.below(4) });
		return job;
	}

	PortJob random_job()
	{
		static const uint32_t around[] = { 0, 1, 8, 64, 1024, 2048 };

		auto words = [this] {
			if (random.chance(20))
				return random.below(5000);
			uint32_t middle = around[random.below(6)];
			return (uint32_t)std::max(0, random.between((int)middle - 5, middle + 5));
		};
		uint32_t stream_words = words();
		return job(stream_words, random.chance(60) ? words() : 0);
	}

	/* Puts the job into host memory, but rings no bell. */
	void prepare(PortJob job)
	{
		uint64_t at = ring + 64 * (tail % entries);

		placed.clear();
		uint64_t stream_list = list(place_stream(job.stream));
		uint64_t response_list, table = place_slots(job.slots);

		for (uint32_t n = 0; n < (job.room + 1023) / 1024; n++)
			job.pages.push_back(place(4096, 4096));
		response_list = list(job.pages);
		for (uint64_t page : job.pages)
			for (uint32_t n = 0; n < 1024; n++)
				job.expected.push_back(host.word(page + 4 * n));
		std::copy(job.answer.words.begin(), job.answer.words.end(), job.expected.begin());

		for (int n = 0; n < 16; n++)
			host.word(at + 4 * n) = random.bits();
		host.word(at) = job.sequence;
		host.word(at + 4) = job.stream.size();
		set64(at + 8, stream_list | random.below(8));
		host.word(at + 16) = job.room;
		set64(at + 24, response_list | random.below(8));
		set64(at + 32, table | random.below(64));
		job.starts = placed;
		job.table = table;
		job.entry = tail++ % entries;
		core.answers.push_back(job.answer);
		jobs.push_back(job);
		last[job.entry] = job;
	}

	/* The job that is in the next entry once more. It has no response. */
	void repeat()
	{
		const PortJob &job = last[tail++ % entries];

		core.answers.push_back(job.answer);
		jobs.push_back(job);
	}

	void doorbell()
	{
		write(GLOSS_REG_TAIL, tail & 0xffff);
	}

	void submit(const PortJob &job)
	{
		prepare(job);
		doorbell();
	}

	bool full() const
	{
		return (uint32_t)(tail - head) == entries;
	}

	/* Until all jobs have ended; each sends a message. */
	void wait()
	{
		uint64_t start = clocks;

		while (!jobs.empty()) {
			TB_CHECK(clocks - start < 300000, "%zu jobs do not end", jobs.size());
			clock();
		}
	}

	/* Until the DMA error of a refused access is told. */
	void wait_error()
	{
		uint64_t start = clocks;

		while (!(read(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_DMA_ERROR))
			TB_CHECK(clocks - start < 300000, "a refused access is not told");
	}

	/* After wait(). */
	void check_counters()
	{
		static const uint32_t stalls[] = { GLOSS_REG_STALL_STREAM, GLOSS_REG_STALL_RASTER,
						   GLOSS_REG_STALL_TILE, GLOSS_REG_STALL_MEMORY,
						   GLOSS_REG_STALL_RESPONSE };
		uint64_t sum;

		TB_CHECK(read(GLOSS_REG_HEAD) == (tail & 0xffff), "HEAD");
		TB_CHECK(read(GLOSS_REG_JOBS) == finished, "JOBS");
		TB_CHECK(read(GLOSS_REG_PROGRESS) == progress, "PROGRESS");
		sum = read(GLOSS_REG_CLOCKS_LOW) | (uint64_t)read(GLOSS_REG_CLOCKS_HIGH) << 32;
		TB_CHECK(sum == time[0], "CLOCKS is %" PRIx64, sum);
		for (int n = 0; n < 5; n++)
			TB_CHECK(read(stalls[n]) == (uint32_t)time[1 + n], "stall counter %d", n);
		TB_CHECK(read(GLOSS_REG_STATUS) == GLOSS_REG_STATUS_IDLE,
			 "not idle when all is done");
	}

	using PortAccess::clock;

	void clock() override
	{
		host.drive(top, clocks);
		core.drive(top);
		drive_access();
		top.msi_ready_i = !bridge_waits;
		settle();
		if (top.msi_valid_o && top.msi_ready_i)
			message();
		sample_access();
		host.sample(top, clocks);
		core.sample(top);
		tick();
	}

	/* What is read of host memory is as the driver put it there. */
	uint64_t place(uint32_t bytes, uint32_t align)
	{
		uint64_t at = random.bits64() & ~(uint64_t)(align - 1);

		if (random.chance(10))
			at |= 0xffffffff00000000;
		if (random.chance(10))
			at &= 0xffffffff;
		for (uint64_t page = at & ~4095ull; page - (at & ~4095ull) < (at & 4095) + bytes;
		     page += 4096)
			host.map(page);
		placed.push_back(at);
		return at;
	}

	PortHost<Vport_pci> host;
	PortCore<Vport_pci> core;
	std::deque<PortJob> jobs; /* submitted and not ended */
	uint64_t ring = 0, records = 0, messages = 0;
	uint32_t entries = 1, tail = 0, head = 0;
	uint32_t progress = 0, finished = 0; /* as the registers must have it */
	uint64_t time[6] = {}, message_clock = 0;
	bool bridge_waits = false; /* before it takes a message, */
	uint32_t message_jobs = 1; /* which is for so many */

      private:
	/* At this clock the job at the head has ended, or those that a message waited for, with all their effects. */
	void message()
	{
		messages++;
		message_clock = clocks;
		if (core.seen.empty()) {
			TB_CHECK(!host.refusals.empty(), "a message of nothing");
			return;
		}
		for (uint32_t n = 0; n < message_jobs; n++) {
			TB_CHECK(!jobs.empty(), "a message too many");
			check(jobs.front());
			jobs.pop_front();
			head++;
		}
	}

	void check(const PortJob &job)
	{
		uint64_t record = records + 16 * job.entry;

		const PortSeen &seen = core.seen.front();
		TB_CHECK(seen.stream_words == job.stream.size() &&
				 seen.response_words == job.room && seen.stream == job.stream,
			 "the stream is not the job's");
		for (int n = 0; n < 16; n++) {
			PortSlot slot = job.slots[n];

			slot.base &= ~4095u;
			TB_CHECK(seen.slots[n] == slot, "slot %d is not the job's", n);
		}
		core.seen.pop_front();
		TB_CHECK(host.word(record) == job.sequence &&
				 host.word(record + 4) == job.answer.cause &&
				 host.word(record + 8) == job.answer.offset &&
				 host.word(record + 12) == job.answer.words.size(),
			 "its completion is wrong");
		for (size_t n = 0; n < job.expected.size(); n++)
			TB_CHECK(host.word(job.pages[n / 1024] + 4 * (n % 1024)) == job.expected[n],
				 "word %zu of the response is wrong", n);
		progress += job.stream.size() + job.answer.words.size();
		finished++;
		for (int n = 0; n < 6; n++)
			time[n] += TIME_COUNTERS * job.answer.time[n];
	}

	void set64(uint64_t at, uint64_t value)
	{
		host.word(at) = value;
		host.word(at + 4) = value >> 32;
	}

	/* Low bits of an entry are nothing. Often nothing is mapped behind the list. */
	uint64_t list(const std::vector<uint64_t> &pages)
	{
		uint64_t bytes = 8 * pages.size(), at;

		if (pages.empty())
			return random.bits64() & ~7ull;
		at = place(4096, 4096) + (random.chance(50) ? 4096 - bytes : 8 * random.below(64));
		for (size_t n = 0; n < pages.size(); n++)
			set64(at + 8 * n, pages[n] | random.below(4096));
		return at;
	}

	std::vector<uint64_t> place_stream(const std::vector<uint32_t> &stream)
	{
		std::vector<uint64_t> pages;

		for (size_t n = 0; n < stream.size(); n++) {
			if (n % 1024 == 0)
				pages.push_back(place(4096, 4096));
			host.word(pages.back() + 4 * (n % 1024)) = stream[n];
		}
		return pages;
	}

	uint64_t place_slots(const std::vector<PortSlot> &slots)
	{
		uint64_t table = place(256, 64);

		for (int n = 0; n < 16; n++) {
			host.word(table + 16 * n) = slots[n].base;
			host.word(table + 16 * n + 4) = slots[n].size;
			host.word(table + 16 * n + 8) = slots[n].rights | random.bits() << 2;
		}
		return table;
	}

	std::map<uint32_t, PortJob> last; /* by entry */
	std::vector<uint64_t> placed;
};

/* tb_port_pci_faults.cpp */
void port_pci_faults(PortBench &bench, int rounds);

#endif
