// SPDX-License-Identifier: MIT
/*
 * The host behind the host_* ports of a Verilated board: bursts become DMA of struct
 * gloss_board_host, each in one call, and are answered a fixed time later, in order.
 */
#ifndef VBOARD_BOARD_HOST_H
#define VBOARD_BOARD_HOST_H

#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

#include "vboard/board/board.h"
#include "sim/sim_port.h"

template <class Core, unsigned Bits> class BoardHost
{
      public:
	explicit BoardHost(const gloss_board_host *host) : host_(host)
	{
	}

	void reset()
	{
		reads_.clear();
		writes_.clear();
		answers_.clear();
		beats_.clear();
	}

	/* Sets the board's inputs for the coming clock edge. */
	void drive(Core &core)
	{
		now_++;
		core.host_arready_i = core.host_awready_i = core.host_wready_i = 1;
		drive_read(core);
		core.host_bvalid_i = !answers_.empty() && answers_.front().due <= now_;
		core.host_bresp_i = core.host_bvalid_i && answers_.front().refused ? SlaveError :
										     Okay;
	}

	/* Takes what the board hands over at this edge. */
	void sample(const Core &core)
	{
		if (core.host_rvalid_i && core.host_rready_o) {
			if (core.host_rlast_i)
				reads_.pop_front();
			else
				reads_.front().beat++;
		}
		if (core.host_bvalid_i && core.host_bready_o)
			answers_.pop_front();
		if (core.host_arvalid_o)
			reads_.push_back(burst(core.host_araddr_o, core.host_arlen_o));
		if (core.host_awvalid_o)
			writes_.push_back(burst(core.host_awaddr_o, core.host_awlen_o));
		if (core.host_wvalid_o)
			beats_.push_back(beat(core));
		while (!writes_.empty() && write(writes_.front())) {
			answers_.push_back(std::move(writes_.front()));
			writes_.pop_front();
		}
	}

      private:
	static constexpr unsigned Latency = 32;
	static constexpr unsigned BeatBytes = Bits / 8;
	static constexpr unsigned Okay = 0, SlaveError = 2;

	struct Burst {
		uint64_t address;
		unsigned beats, beat;
		uint64_t due;
		bool given, refused;
		std::vector<uint8_t> data; /* whole beats */
	};

	struct Beat {
		uint32_t word[Bits / 32];
		unsigned bytes; /* those enabled; they are the lowest */
	};

	Burst burst(uint64_t address, unsigned length) const
	{
		return { address, length + 1, 0, now_ + Latency, false, false, {} };
	}

	void read(Burst &burst)
	{
		unsigned skip = burst.address % BeatBytes;

		burst.given = true;
		burst.data.assign(burst.beats * BeatBytes, 0);
		burst.refused = host_->read(host_->data, burst.address, &burst.data[skip],
					    burst.beats * BeatBytes - skip) != GLOSS_DMA_DONE;
	}

	void drive_read(Core &core)
	{
		core.host_rvalid_i = !reads_.empty() && reads_.front().due <= now_;
		if (!core.host_rvalid_i)
			return;
		Burst &burst = reads_.front();
		if (!burst.given)
			read(burst);
		for (unsigned i = 0; i < Bits / 32; i++) {
			uint32_t word;

			std::memcpy(&word, &burst.data[burst.beat * BeatBytes + 4 * i], 4);
			sim_set(core.host_rdata_i, i, word);
		}
		core.host_rresp_i = burst.refused ? SlaveError : Okay;
		core.host_rlast_i = burst.beat + 1 == burst.beats;
	}

	static Beat beat(const Core &core)
	{
		Beat beat = {};

		for (unsigned i = 0; i < Bits / 32; i++)
			beat.word[i] = sim_get(core.host_wdata_o, i);
		for (unsigned strobes = core.host_wstrb_o; strobes & 1; strobes >>= 1)
			beat.bytes++;
		return beat;
	}

	/* Gives the burst its data, if they are all there. */
	bool gather(Burst &burst)
	{
		if (beats_.size() < burst.beats)
			return false;
		for (unsigned i = 0; i < burst.beats; i++) {
			const auto *bytes = reinterpret_cast<const uint8_t *>(beats_.front().word);

			burst.data.insert(burst.data.end(), bytes, bytes + beats_.front().bytes);
			beats_.pop_front();
		}
		burst.due = now_;
		burst.given = true;
		return true;
	}

	/* False: the burst, the oldest, is not written yet. */
	bool write(Burst &burst)
	{
		enum gloss_dma answer = GLOSS_DMA_DONE;

		if ((!burst.given && !gather(burst)) || burst.due > now_)
			return false;
		/* Unless a reset has taken the data back. */
		if (!burst.data.empty())
			answer = host_->write(host_->data, burst.address, burst.data.data(),
					      burst.data.size());
		burst.refused = answer == GLOSS_DMA_REFUSED;
		burst.due = now_ + Latency;
		return answer != GLOSS_DMA_LATER;
	}

	const gloss_board_host *host_;
	uint64_t now_ = 0;
	std::deque<Burst> reads_, writes_, answers_;
	std::deque<Beat> beats_;
};

#endif
