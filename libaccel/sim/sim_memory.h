// SPDX-License-Identifier: MIT
/*
 * Board memory behind the core's AXI port, for sim_wrapper.cpp. What is written
 * can be read only from its B response on, the latest AXI allows, so that a core
 * that reads without waiting for it gets the old words.
 */
#ifndef ACCEL_SIM_MEMORY_H
#define ACCEL_SIM_MEMORY_H

#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

#include "sim/sim_port.h"

template <class Core, unsigned Lanes> class SimMemory
{
      public:
	SimMemory(void *bytes, uint64_t size) : bytes_(static_cast<uint8_t *>(bytes)), size_(size)
	{
	}

	void reset()
	{
		reads_.clear();
		writes_.clear();
		answers_.clear();
		ahead_.clear();
		r_valid_ = b_valid_ = false;
		aw_.reset();
		w_.reset();
		ar_.reset();
	}

	bool idle() const
	{
		return reads_.empty() && writes_.empty() && answers_.empty() && ahead_.empty();
	}

	/* Sets the core's inputs for the coming clock edge. */
	void drive(Core &core, SimStalls &stalls)
	{
		now_++;
		core.axi_arready_i = reads_.size() < Outstanding && stalls.pass(SimPort::Ar);
		core.axi_awready_i = writes_.size() + answers_.size() < Outstanding &&
				     stalls.pass(SimPort::Aw);
		core.axi_wready_i = ahead_.size() < Ahead && stalls.pass(SimPort::W);
		drive_read(core, stalls);
		drive_answer(core, stalls);
	}

	/* Takes what the core hands over at this edge; says whether anything moved. */
	bool sample(Core &core, SimStalls &stalls, const char *&violation)
	{
		bool moved = sample_read(core, stalls, violation);
		return sample_write(core, stalls, violation) || moved;
	}

      private:
	static constexpr unsigned BeatBytes = 4 * Lanes;
	static constexpr unsigned Outstanding = 8;
	static constexpr unsigned Ahead = 64; /* W beats taken before their AW */
	static constexpr unsigned Latency = 20;
	static constexpr unsigned Okay = 0, SlaveError = 2;

	struct Beat {
		uint32_t word[Lanes];
		uint32_t strobes;
		bool last;
	};

	struct Burst {
		uint64_t address;
		unsigned beats, done;
		uint64_t due;
		bool early; /* a read of memory as it is when it is asked for, not given */
		std::vector<Beat> data;
	};

	uint64_t due(SimStalls &stalls)
	{
		return now_ + (stalls.on() ? stalls.below(64) : Latency);
	}

	bool inside(uint64_t address) const
	{
		return address + BeatBytes <= size_;
	}

	Burst burst(uint32_t address, unsigned length, SimStalls &stalls, const char *&violation)
	{
		Burst burst = {
			address / BeatBytes * BeatBytes, length + 1, 0, due(stalls), false, {}
		};
		if (burst.address / 4096 !=
		    (burst.address + uint64_t{ burst.beats } * BeatBytes - 1) / 4096)
			violation = "a burst crosses a 4 KiB boundary";
		return burst;
	}

	Beat load(uint64_t address) const
	{
		Beat beat = {};
		if (inside(address))
			std::memcpy(beat.word, bytes_ + address, BeatBytes);
		return beat;
	}

	bool store(uint64_t address, const Beat &beat)
	{
		if (!inside(address))
			return false;
		const auto *from = reinterpret_cast<const uint8_t *>(beat.word);
		for (unsigned i = 0; i < BeatBytes; i++)
			if (beat.strobes >> i & 1)
				bytes_[address + i] = from[i];
		return true;
	}

	void drive_read(Core &core, SimStalls &stalls)
	{
		if (!r_valid_ && !reads_.empty() && reads_.front().due <= now_ &&
		    stalls.pass(SimPort::R)) {
			Burst &burst = reads_.front();
			uint64_t address = burst.address + uint64_t{ burst.done } * BeatBytes;
			Beat beat = burst.early ? burst.data[burst.done] : load(address);
			for (unsigned i = 0; i < Lanes; i++)
				sim_set(core.axi_rdata_i, i, beat.word[i]);
			core.axi_rresp_i = inside(address) ? Okay : SlaveError;
			core.axi_rlast_i = burst.done + 1 == burst.beats;
			r_valid_ = true;
		}
		core.axi_rvalid_i = r_valid_;
	}

	void drive_answer(Core &core, SimStalls &stalls)
	{
		if (!b_valid_ && !answers_.empty() && answers_.front().due <= now_ &&
		    stalls.pass(SimPort::B)) {
			Burst &burst = answers_.front();
			bool okay = true;
			for (unsigned i = 0; i < burst.beats; i++)
				okay = store(burst.address + uint64_t{ i } * BeatBytes,
					     burst.data[i]) &&
				       okay;
			core.axi_bresp_i = okay ? Okay : SlaveError;
			b_valid_ = true;
		}
		core.axi_bvalid_i = b_valid_;
	}

	bool sample_read(Core &core, SimStalls &stalls, const char *&violation)
	{
		bool asked = core.axi_arvalid_o && core.axi_arready_i;
		bool taken = r_valid_ && core.axi_rready_o;
		const uint32_t held[] = { core.axi_araddr_o, core.axi_arlen_o };
		if (!ar_.holds(core.axi_arvalid_o, core.axi_arready_i, held, 2))
			violation = "AR changed before it was taken";
		if (taken) {
			r_valid_ = false;
			if (++reads_.front().done == reads_.front().beats)
				reads_.pop_front();
		}
		if (asked) {
			reads_.push_back(
				burst(core.axi_araddr_o, core.axi_arlen_o, stalls, violation));
			Burst &burst = reads_.back();
			burst.early = !stalls.on() || stalls.below(2);
			for (unsigned i = 0; burst.early && i < burst.beats; i++)
				burst.data.push_back(
					load(burst.address + uint64_t{ i } * BeatBytes));
		}
		return asked || taken;
	}

	bool sample_write(Core &core, SimStalls &stalls, const char *&violation)
	{
		bool asked = core.axi_awvalid_o && core.axi_awready_i;
		bool given = core.axi_wvalid_o && core.axi_wready_i;
		bool answered = b_valid_ && core.axi_bready_o;
		const uint32_t held[] = { core.axi_awaddr_o, core.axi_awlen_o };
		if (!aw_.holds(core.axi_awvalid_o, core.axi_awready_i, held, 2))
			violation = "AW changed before it was taken";
		if (answered) {
			b_valid_ = false;
			answers_.pop_front();
		}
		if (asked)
			writes_.push_back(
				burst(core.axi_awaddr_o, core.axi_awlen_o, stalls, violation));
		sample_beat(core, violation);
		while (!writes_.empty() && !ahead_.empty())
			fill(stalls, violation);
		return asked || given || answered;
	}

	void sample_beat(Core &core, const char *&violation)
	{
		uint32_t held[Lanes + 2];
		Beat beat;
		if (!core.axi_wvalid_o && !w_.waiting())
			return;
		for (unsigned i = 0; i < Lanes; i++)
			held[i] = beat.word[i] = sim_get(core.axi_wdata_o, i);
		held[Lanes] = beat.strobes = core.axi_wstrb_o;
		held[Lanes + 1] = beat.last = core.axi_wlast_o;
		if (!w_.holds(core.axi_wvalid_o, core.axi_wready_i, held, Lanes + 2))
			violation = "W changed before it was taken";
		if (core.axi_wvalid_o && core.axi_wready_i)
			ahead_.push_back(beat);
	}

	/* Gives the oldest beat to the oldest burst that lacks one. */
	void fill(SimStalls &stalls, const char *&violation)
	{
		Burst &burst = writes_.front();
		burst.data.push_back(ahead_.front());
		ahead_.pop_front();
		bool full = burst.data.size() == burst.beats;
		if (burst.data.back().last != full)
			violation = "WLAST is not at the burst's last beat";
		if (!full)
			return;
		burst.due = due(stalls);
		answers_.push_back(std::move(burst));
		writes_.pop_front();
	}

	uint8_t *bytes_;
	uint64_t size_;
	uint64_t now_ = 0;
	std::deque<Burst> reads_, writes_, answers_;
	std::deque<Beat> ahead_;
	bool r_valid_ = false, b_valid_ = false;
	SimHeld<2> aw_, ar_;
	SimHeld<Lanes + 2> w_;
};

#endif
