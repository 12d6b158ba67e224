/* SPDX-License-Identifier: MIT */
/*
 * Host memory before the host_* ports: pages at any 64-bit address, and the rules of AXI4 checked:
 * what is valid stays until taken, bursts stay in 4 KiB, WLAST ends them, data come not before their
 * address. What is written can be seen from its answer on. An access may be refused by its number;
 * one of a page that is not there is the bench's failure if strict, else it is refused too.
 */
#ifndef TESTS_PORT_HOST_H
#define TESTS_PORT_HOST_H

#include <array>
#include <deque>
#include <map>
#include <set>
#include <vector>

#include "tb.h"

template <class Top> class PortHost
{
      public:
	static const uint32_t page_bytes = 4096;
	static const uint32_t beat_bytes = STREAM / 8;

	explicit PortHost(Random &random) : random(random)
	{
	}

	void steady(int clocks)
	{
		latency_min = latency_max = clocks;
		stalls = false;
	}

	void unkind()
	{
		latency_min = random.between(0, 20);
		latency_max = latency_min + random.between(0, 60);
		stalls = true;
	}

	/* A page with random content. */
	void map(uint64_t address)
	{
		for (uint32_t &word : pages[address / page_bytes])
			word = random.bits();
	}

	void unmap_all()
	{
		pages.clear();
	}

	uint32_t &word(uint64_t address)
	{
		auto page = pages.find(address / page_bytes);

		TB_CHECK(page != pages.end(), "no page at %" PRIx64, address);
		return page->second[address % page_bytes / 4];
	}

	bool idle() const
	{
		return reads.empty() && addresses.empty() && beats.empty() && answers.empty();
	}

	/* Inputs of this clock. */
	void drive(Top &top, uint64_t clock)
	{
		top.host_arready_i = reads.size() < 32 && !hold(ar_stall);
		top.host_awready_i = addresses.size() < 8 && !hold(aw_stall);
		top.host_wready_i = beats.size() < 256 && !hold(w_stall);
		r_offered = r_offered ||
			    (!reads.empty() && reads.front().due <= clock && !hold(r_stall));
		b_offered = b_offered ||
			    (!answers.empty() && answers.front().due <= clock && !hold(b_stall));
		top.host_rvalid_i = r_offered;
		top.host_bvalid_i = b_offered;
		if (r_offered)
			drive_beat(top);
		if (b_offered)
			drive_answer(top);
	}

	/* What the edge takes. */
	void sample(Top &top, uint64_t clock)
	{
		if (r_offered && top.host_rready_o) {
			r_offered = false;
			if (++reads.front().beat == reads.front().beats)
				reads.pop_front();
		}
		if (b_offered && top.host_bready_o) {
			b_offered = false;
			answers.pop_front();
		}
		sample_read(top, clock);
		sample_write(top, clock);
		sample_data(top);
		match(clock);
	}

	bool strict = true;
	int refuse = -1;             /* the access with this number, from now */
	bool refuse_rest = false;    /* and all after it */
	std::set<uint64_t> refusals; /* addresses that were */
	uint64_t accesses = 0;

      private:
	struct Burst {
		uint64_t address;
		uint32_t beats, beat;
		uint64_t due;
		bool bad;
		uint32_t bad_beat;
		std::vector<uint32_t> data;
		std::vector<uint32_t> strobes;
	};

	struct Beat {
		std::array<uint32_t, STREAM / 32> word;
		uint32_t strobes;
		bool last;
	};

	bool hold(Stall &stall)
	{
		return stalls && stall.now();
	}

	Burst burst(uint64_t address, uint32_t length, uint64_t clock)
	{
		Burst burst = { address, length + 1, 0, due(clock), false, 0, {}, {} };
		uint64_t last = address / beat_bytes * beat_bytes + burst.beats * beat_bytes - 1;

		TB_CHECK(address / page_bytes == last / page_bytes,
			 "burst of %u at %" PRIx64 " crosses 4 KiB", burst.beats, address);
		accesses++;
		burst.bad = refuse >= 0 && refuse-- == 0;
		if (burst.bad && refuse_rest)
			refuse = 0;
		if (!pages.count(address / page_bytes)) {
			TB_CHECK(!strict, "access to %" PRIx64 ", where nothing is", address);
			burst.bad = true;
		}
		burst.bad_beat = random.below(burst.beats);
		return burst;
	}

	uint64_t due(uint64_t clock)
	{
		return clock + random.between(latency_min, latency_max);
	}

	unsigned int refusal(const Burst &burst)
	{
		refusals.insert(burst.address);
		return burst.address >> 12 & 1 ? 2 : 3;
	}

	/* One beat of a refused burst says so; what it reads is nothing to rely on. */
	void drive_beat(Top &top)
	{
		const Burst &read = reads.front();
		uint64_t at = read.address / beat_bytes * beat_bytes + read.beat * beat_bytes;

		for (uint32_t n = 0; n < beat_bytes / 4; n++)
			tb_set(top.host_rdata_i, 32 * n, 32,
			       read.bad ? bad_word : word(at + 4 * n));
		top.host_rresp_i = read.bad && read.beat == read.bad_beat ? refusal(read) : 0;
		top.host_rlast_i = read.beat + 1 == read.beats;
	}

	void drive_answer(Top &top)
	{
		Burst &write = answers.front();

		top.host_bresp_i = write.bad ? refusal(write) : 0;
		for (uint32_t n = 0; n < write.data.size() && !write.bad; n++)
			if (write.strobes[n])
				word(write.address / beat_bytes * beat_bytes +
				     4 * n) = write.data[n];
	}

	void sample_read(Top &top, uint64_t clock)
	{
		TB_CHECK(!ar_waits || (top.host_arvalid_o && top.host_araddr_o == ar_address &&
				       top.host_arlen_o == ar_length),
			 "AR is taken back");
		ar_waits = top.host_arvalid_o && !top.host_arready_i;
		ar_address = top.host_araddr_o;
		ar_length = top.host_arlen_o;
		if (!top.host_arvalid_o || ar_waits)
			return;
		TB_CHECK(ar_address % beat_bytes == 0,
			 "AR at %" PRIx64 " is not a multiple of a beat", ar_address);
		reads.push_back(burst(ar_address, ar_length, clock));
		bad_word = random.bits();
	}

	void sample_write(Top &top, uint64_t clock)
	{
		TB_CHECK(!aw_waits || (top.host_awvalid_o && top.host_awaddr_o == aw_address &&
				       top.host_awlen_o == aw_length),
			 "AW is taken back");
		aw_waits = top.host_awvalid_o && !top.host_awready_i;
		aw_address = top.host_awaddr_o;
		aw_length = top.host_awlen_o;
		if (top.host_awvalid_o && !aw_waits)
			addresses.push_back(burst(aw_address, aw_length, clock));
	}

	void sample_data(Top &top)
	{
		Beat beat = {};

		for (uint32_t n = 0; n < beat_bytes / 4; n++)
			beat.word[n] = tb_get(top.host_wdata_o, 32 * n, 32);
		beat.strobes = top.host_wstrb_o;
		beat.last = top.host_wlast_o;
		TB_CHECK(!w_waits || (top.host_wvalid_o && beat.word == held.word &&
				      beat.strobes == held.strobes && beat.last == held.last),
			 "W is taken back");
		w_waits = top.host_wvalid_o && !top.host_wready_i;
		held = beat;
		TB_CHECK(!top.host_wvalid_o || full_bursts < addresses.size() + aw_waits,
			 "data come before their address");
		if (!top.host_wvalid_o || w_waits)
			return;
		beats.push_back(beat);
		full_bursts += beat.last;
	}

	/* Bursts whose address and data are both there. */
	void match(uint64_t clock)
	{
		while (!addresses.empty() && beats.size() >= addresses.front().beats) {
			Burst write = addresses.front();

			addresses.pop_front();
			full_bursts--;
			for (uint32_t n = 0; n < write.beats; n++)
				take(write, n + 1 == write.beats);
			write.due = due(clock);
			answers.push_back(write);
		}
	}

	void take(Burst &write, bool last)
	{
		const Beat &beat = beats.front();

		TB_CHECK(beat.last == last, "WLAST in the wrong place");
		for (uint32_t n = 0; n < beat_bytes / 4; n++) {
			uint32_t strobe = beat.strobes >> 4 * n & 15;

			TB_CHECK(strobe == 0 || strobe == 15, "half a word is written");
			write.data.push_back(beat.word[n]);
			write.strobes.push_back(strobe);
		}
		beats.pop_front();
	}

	Random &random;
	std::map<uint64_t, std::array<uint32_t, page_bytes / 4>> pages;
	int latency_min = 20, latency_max = 20;
	bool stalls = false, r_offered = false, b_offered = false;
	Stall ar_stall{ random }, r_stall{ random }, aw_stall{ random }, w_stall{ random },
		b_stall{ random };
	bool ar_waits = false, aw_waits = false, w_waits = false;
	uint64_t ar_address = 0, aw_address = 0;
	uint32_t ar_length = 0, aw_length = 0, bad_word = 0;
	Beat held = {};
	std::deque<Burst> reads, addresses, answers;
	std::deque<Beat> beats;
	size_t full_bursts = 0; /* in beats */
};

#endif
