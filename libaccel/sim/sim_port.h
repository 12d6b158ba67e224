// SPDX-License-Identifier: MIT
/*
 * What the ports of a simulated core have in common: when they stall, whether
 * what waits is held, and words of a wide port.
 */
#ifndef ACCEL_SIM_PORT_H
#define ACCEL_SIM_PORT_H

#include <cstdint>
#include <cstring>

/* Verilator gives a port the smallest integer it fits, and above 64 bits an array of words. */
inline uint32_t sim_get(uint32_t port, unsigned)
{
	return port;
}
inline uint32_t sim_get(uint64_t port, unsigned i)
{
	return static_cast<uint32_t>(port >> 32 * i);
}
template <class Wide> uint32_t sim_get(const Wide &port, unsigned i)
{
	return port[i];
}

inline void sim_set(uint32_t &port, unsigned, uint32_t word)
{
	port = word;
}
inline void sim_set(uint64_t &port, unsigned i, uint32_t word)
{
	port = (port & ~(uint64_t{ 0xffffffff } << 32 * i)) | uint64_t{ word } << 32 * i;
}
template <class Wide> void sim_set(Wide &port, unsigned i, uint32_t word)
{
	port[i] = word;
}

enum class SimPort { Stream, Response, Status, Aw, W, B, Ar, R, Count };

/* Decides by a seed when ports stall. Seed 0: never. */
class SimStalls
{
      public:
	explicit SimStalls(uint64_t seed) : state_(seed)
	{
	}

	bool on() const
	{
		return state_ != 0;
	}

	/* Each job draws anew how often each port stalls: never, seldom, often, mostly. */
	void begin_job()
	{
		static const uint8_t rates[] = { 0, 32, 128, 224 };
		for (auto &rate : rate_)
			rate = on() ? rates[below(4)] : 0;
	}

	bool pass(SimPort port)
	{
		uint8_t rate = rate_[static_cast<unsigned>(port)];
		return rate == 0 || below(256) >= rate;
	}

	/* xorshift64*; only called when on. */
	uint32_t below(uint32_t limit)
	{
		state_ ^= state_ >> 12;
		state_ ^= state_ << 25;
		state_ ^= state_ >> 27;
		return static_cast<uint32_t>((state_ * 0x2545f4914f6cdd1d >> 32) * limit >> 32);
	}

      private:
	uint64_t state_;
	uint8_t rate_[static_cast<unsigned>(SimPort::Count)] = {};
};

/* Watches a port: what is valid and not taken stays valid and the same. */
template <unsigned Words> class SimHeld
{
      public:
	bool waiting() const
	{
		return waiting_;
	}
	void reset()
	{
		waiting_ = false;
	}

	bool holds(bool valid, bool ready, const uint32_t *words, unsigned count)
	{
		bool held = !waiting_ || (valid && std::memcmp(words_, words, 4 * count) == 0);
		waiting_ = valid && !ready;
		if (waiting_)
			std::memcpy(words_, words, 4 * count);
		return held;
	}

      private:
	bool waiting_ = false;
	uint32_t words_[Words] = {};
};

#endif
