/* SPDX-License-Identifier: MIT */
/*
 * An AXI4 memory for the ports of module memory that checks what the master may do: valid and its
 * payload stay until taken, bursts end inside 4 KiB, data come not before their address and end where
 * it said. Responses come in order after any time.
 */
#ifndef TESTS_MEMORY_AXI_H
#define TESTS_MEMORY_AXI_H

#include <deque>
#include <vector>

#include "tb.h"

template <class Top> class MemoryAxi
{
      public:
	/* When an address of a write is taken. */
	enum Address { ANY_TIME, WITH_DATA, AFTER_DATA };

	MemoryAxi(Random &random, size_t size) : words(size), random(random)
	{
	}

	void steady(int clocks)
	{
		latency_min = latency_max = clocks;
		stalls = false;
		address = ANY_TIME;
	}

	void unkind()
	{
		latency_min = random.between(0, 10);
		latency_max = latency_min + random.between(0, 40);
		stalls = true;
		address = (Address)random.below(3);
	}

	/* Inputs of this clock. */
	void drive(Top &top, uint64_t clock)
	{
		top.axi_arready_i = !hold(ar_stall) && reads.size() < 64;
		top.axi_rvalid_i = r_offered ||
				   (!reads.empty() && reads.front().due <= clock && !hold(r_stall));
		r_offered = top.axi_rvalid_i;
		top.axi_bvalid_i = !writes.empty() && writes.front().due <= clock;
		top.axi_wready_i = !hold(w_stall);
		top.axi_awready_i = !hold(aw_stall) && (address == ANY_TIME ||
							(address == WITH_DATA &&
							 (top.axi_wvalid_o || !data.empty())) ||
							(address == AFTER_DATA && full_bursts > 0));
		top.axi_bresp_i = top.axi_bvalid_i ? take_error(write_errors) : 3;
		top.axi_rresp_i = 3;
		if (top.axi_rvalid_i)
			drive_beat(top);
	}

	/* What the edge takes. */
	void sample(Top &top, uint64_t clock)
	{
		sample_read(top, clock);
		sample_address(top);
		sample_data(top);
		if (top.axi_bvalid_i && top.axi_bready_o)
			writes.pop_front();
		match(clock);
	}

	bool quiet() const
	{
		return reads.empty() && writes.empty() && addresses.empty() && data.empty();
	}

	std::vector<uint32_t> words;
	int write_errors = -1, read_errors = -1; /* responses until one is an error */

      private:
	static const uint32_t beat_bytes = 4 * LANES;

	struct Burst {
		uint32_t address;
		int beats;
		uint64_t due;
		int beat;
	};

	struct Beat {
		uint32_t word[LANES];
		uint32_t strobe;
		bool last;
	};

	bool hold(Stall &stall)
	{
		return stalls && stall.now();
	}

	static unsigned int take_error(int &count)
	{
		static const unsigned int okay = 0, slave_error = 2;

		return count >= 0 && count-- == 0 ? slave_error : okay;
	}

	Burst burst(uint32_t address, unsigned int length, uint64_t clock)
	{
		Burst burst = { address, (int)length + 1,
				clock + 1 + random.between(latency_min, latency_max), 0 };
		uint32_t last = address + burst.beats * beat_bytes - 1;

		TB_CHECK(address % beat_bytes == 0 && last / 4 < words.size(), "burst at %08x",
			 address);
		TB_CHECK(address / 4096 == last / 4096, "burst of %d at %08x crosses 4 KiB",
			 burst.beats, address);
		return burst;
	}

	void drive_beat(Top &top)
	{
		const Burst &read = reads.front();

		if (beat_is_new)
			read_resp = take_error(read_errors);
		beat_is_new = false;
		top.axi_rresp_i = read_resp;
		for (int l = 0; l < LANES; l++)
			tb_set(top.axi_rdata_i, 32 * l, 32,
			       words[read.address / 4 + read.beat * LANES + l]);
		top.axi_rlast_i = read.beat + 1 == read.beats;
	}

	void sample_read(Top &top, uint64_t clock)
	{
		TB_CHECK(!ar_waits || (top.axi_arvalid_o && top.axi_araddr_o == ar_address),
			 "AR is taken back");
		ar_waits = top.axi_arvalid_o && !top.axi_arready_i;
		ar_address = top.axi_araddr_o;
		if (top.axi_arvalid_o && top.axi_arready_i)
			reads.push_back(burst(top.axi_araddr_o, top.axi_arlen_o, clock));
		if (!top.axi_rvalid_i || !top.axi_rready_o)
			return;
		r_offered = false;
		beat_is_new = true;
		if (++reads.front().beat == reads.front().beats)
			reads.pop_front();
	}

	void sample_address(Top &top)
	{
		TB_CHECK(!aw_waits || (top.axi_awvalid_o && top.axi_awaddr_o == aw_address),
			 "AW is taken back");
		aw_waits = top.axi_awvalid_o && !top.axi_awready_i;
		aw_address = top.axi_awaddr_o;
		if (top.axi_awvalid_o && top.axi_awready_i)
			addresses.push_back(burst(top.axi_awaddr_o, top.axi_awlen_o, 0));
	}

	void sample_data(Top &top)
	{
		TB_CHECK(!w_waits || top.axi_wvalid_o, "W is taken back");
		w_waits = top.axi_wvalid_o && !top.axi_wready_i;
		if (!top.axi_wvalid_o)
			return;
		TB_CHECK((int)addresses.size() + aw_waits > full_bursts,
			 "data come before their address");
		if (!top.axi_wready_i)
			return;
		Beat beat;

		for (int l = 0; l < LANES; l++)
			beat.word[l] = tb_get(top.axi_wdata_o, 32 * l, 32);
		beat.strobe = top.axi_wstrb_o;
		beat.last = top.axi_wlast_o;
		full_bursts += beat.last;
		data.push_back(beat);
	}

	/* Bursts whose address and data are both there. */
	void match(uint64_t clock)
	{
		while (!addresses.empty() && (int)data.size() >= addresses.front().beats) {
			Burst write = addresses.front();

			for (int n = 0; n < write.beats; n++) {
				TB_CHECK(data.front().last == (n + 1 == write.beats),
					 "last beat in the wrong place");
				store(write.address + n * beat_bytes, data.front());
				data.pop_front();
			}
			full_bursts--;
			addresses.pop_front();
			write.due = clock + 1 + random.between(latency_min, latency_max);
			writes.push_back(write);
		}
	}

	void store(uint32_t address, const Beat &beat)
	{
		for (int l = 0; l < LANES; l++) {
			uint32_t strobe = beat.strobe >> 4 * l & 15;

			TB_CHECK(strobe == 0 || strobe == 15, "half a word is written");
			if (strobe)
				words[address / 4 + l] = beat.word[l];
		}
	}

	Random &random;
	int latency_min = 20, latency_max = 20;
	bool stalls = false, r_offered = false, beat_is_new = true;
	unsigned int read_resp = 0;
	Address address = ANY_TIME;
	Stall ar_stall{ random }, r_stall{ random }, aw_stall{ random }, w_stall{ random };
	bool ar_waits = false, aw_waits = false, w_waits = false;
	uint32_t ar_address = 0, aw_address = 0;
	int full_bursts = 0; /* in data */

	std::deque<Burst> reads;
	std::deque<Burst> addresses, writes; /* without data; to be acknowledged */
	std::deque<Beat> data;               /* without address */
};

#endif
