/* SPDX-License-Identifier: MIT */
/*
 * What the Verilator benches share: clock and reset, random numbers from one printed seed, random
 * stalls, ports of any width, and a check that says where and when it failed.
 *
 * A clock of a bench:
 *
 *	top.valid_i = ...;	inputs, for the clock that begins
 *	bench.settle();		outputs that depend on them are right now
 *	if (top.ready_o) ...	sample: this is what the edge will take
 *	bench.tick();		the rising edge
 */
#ifndef TESTS_TB_H
#define TESTS_TB_H

#include <cinttypes>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <verilated.h>

/* Numbers that only depend on the seed (splitmix64). */
class Random
{
      public:
	explicit Random(uint64_t seed) : state(seed)
	{
	}

	uint64_t bits64()
	{
		uint64_t z = state += 0x9e3779b97f4a7c15;

		z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
		z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
		return z ^ (z >> 31);
	}

	uint32_t bits()
	{
		return bits64() >> 32;
	}
	/* 0 <= result < count */
	uint32_t below(uint32_t count)
	{
		return (uint64_t)bits() * count >> 32;
	}
	/* low <= result <= high */
	int between(int low, int high)
	{
		return low + (int)below(high - low + 1);
	}
	bool chance(unsigned int percent)
	{
		return below(100) < percent;
	}

      private:
	uint64_t state;
};

/* The run's seed: GLOSS_SEED, or the time. Printed once, so that a failure can be repeated. */
inline uint64_t tb_seed()
{
	static uint64_t seed;
	static bool known;

	if (!known) {
		const char *text = getenv("GLOSS_SEED");

		seed = text && *text ? strtoull(text, nullptr, 0) : (uint64_t)time(nullptr);
		known = true;
		printf("seed %" PRIu64 " (GLOSS_SEED=%" PRIu64 " repeats this run)\n", seed, seed);
		fflush(stdout);
	}
	return seed;
}

/* The clock of the bench that is running, for messages. */
inline uint64_t &tb_clock()
{
	static uint64_t clock;

	return clock;
}

[[noreturn]] __attribute__((format(printf, 3, 4))) inline void tb_fail(const char *file, int line,
								       const char *format, ...)
{
	va_list args;

	fflush(stdout);
	fprintf(stderr, "%s:%d: clock %" PRIu64 ", seed %" PRIu64 ": ", file, line, tb_clock(),
		tb_seed());
	va_start(args, format);
	vfprintf(stderr, format, args);
	va_end(args);
	fputc('\n', stderr);
	exit(1);
}

/* TB_CHECK(condition, "what is wrong: %d", value) ends the bench if the condition is false. */
#define TB_CHECK(condition, ...)                                  \
	do {                                                      \
		if (!(condition))                                 \
			tb_fail(__FILE__, __LINE__, __VA_ARGS__); \
	} while (0)

/* Bits of a port: Verilator makes it an integer up to 64 bits and an array of words above. */
template <typename Port> uint64_t tb_get(const Port &port, unsigned int low, unsigned int width)
{
	return (uint64_t)port >> low & (width == 64 ? ~0ull : (1ull << width) - 1);
}

template <std::size_t Words>
uint64_t tb_get(const VlWide<Words> &port, unsigned int low, unsigned int width)
{
	uint64_t value = 0;

	for (unsigned int bit = 0; bit < width;) {
		unsigned int at = low + bit, word = at / 32, shift = at % 32;

		value |= (uint64_t)(port[word] >> shift) << bit;
		bit += 32 - shift;
	}
	return tb_get(value, 0, width);
}

template <typename Port>
void tb_set(Port &port, unsigned int low, unsigned int width, uint64_t value)
{
	uint64_t mask = (width == 64 ? ~0ull : (1ull << width) - 1) << low;

	port = (Port)(((uint64_t)port & ~mask) | (value << low & mask));
}

template <std::size_t Words>
void tb_set(VlWide<Words> &port, unsigned int low, unsigned int width, uint64_t value)
{
	for (unsigned int bit = 0; bit < width; bit++) {
		uint32_t &word = port[(low + bit) / 32];
		uint32_t mask = 1u << (low + bit) % 32;

		word = value >> bit & 1 ? word | mask : word & ~mask;
	}
}

/*
 * When to hold a handshake: stretches of never, seldom, often and nearly always, so that both
 * back-to-back traffic and long waits happen in every run.
 */
class Stall
{
      public:
	explicit Stall(Random &random) : random(random)
	{
	}

	/* Ask once a clock: true to hold. */
	bool now()
	{
		static const unsigned int percent[] = { 0, 0, 10, 50, 90 };

		if (left-- == 0) {
			left = random.between(10, 200);
			rate = percent[random.below(5)];
		}
		return random.chance(rate);
	}

      private:
	Random &random;
	unsigned int left = 0, rate = 0;
};

/* A module of registers without reset has no rst_ni. */
template <class Top> auto tb_reset(Top &top, int level, int) -> decltype(top.rst_ni, void())
{
	top.rst_ni = level;
}

template <class Top> void tb_reset(Top &, int, long)
{
}

/* A module under test with port clk_i. Registers without reset start with random bits. */
template <class Top> class Bench
{
      public:
	Bench() : top(prepare(context))
	{
		reset();
	}

	~Bench()
	{
		top.final();
	}

	/* Inputs of the first clock after this are still to be set. */
	void reset()
	{
		/* An edge of the reset, which has its effect before the first clock. */
		top.clk_i = 0;
		tb_reset(top, 1, 0);
		top.eval();
		tb_reset(top, 0, 0);
		top.eval();
		tick();
		tick();
		tb_reset(top, 1, 0);
	}

	void settle()
	{
		top.eval();
	}

	void tick()
	{
		top.clk_i = 1;
		top.eval();
		top.clk_i = 0;
		top.eval();
		tb_clock() = ++clocks;
	}

	uint64_t clocks = 0;

      private:
	static VerilatedContext *prepare(VerilatedContext &context)
	{
		context.randReset(2);
		context.randSeed((int)(tb_seed() & 0x7fffffff) | 1);
		return &context;
	}

	VerilatedContext context;

      public:
	Top top;
};

#endif
