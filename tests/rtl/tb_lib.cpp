// SPDX-License-Identifier: MIT
/*
 * The streams of rtl/lib, one program for each: what goes in comes out once, in order, whatever the
 * stalls; without stalls a word goes through every clock; held back, it holds as much as it says.
 * TOP is the module, CAPACITY how many words it holds.
 */
#include <deque>

#include "tb.h"

#define PASTE2(a, b) a##b
#define PASTE(a, b) PASTE2(a, b)
#define QUOTE2(a) #a
#define QUOTE(a) QUOTE2(a)
#define VTOP PASTE(V, TOP)
#include QUOTE(VTOP.h)

static const unsigned int width = 37;

class StreamBench : public Bench<VTOP> {
public:
	explicit StreamBench(uint64_t seed) : random(seed) {}

	/* One clock; true if a word came out. */
	bool clock(bool offer, bool take)
	{
		bool sent, got;

		if (!offered)
			word = tb_get(random.bits64(), 0, width);
		offered |= offer;
		top.valid_i = offered;
		top.data_i = word;
		top.ready_i = take;
		settle();
		sent = offered && top.ready_o;
		got = top.valid_o && take;
		TB_CHECK(!top.valid_o || !held.empty(), "a word comes out that did not go in");
		TB_CHECK(!top.valid_o || top.data_o == held.front(),
			 "%" PRIx64 " came out instead of %" PRIx64, (uint64_t)top.data_o,
			 held.front());
		TB_CHECK(!waiting || top.valid_o, "a word was taken back");
		if (got)
			held.pop_front();
		if (sent) {
			held.push_back(word);
			offered = false;
		}
		waiting = top.valid_o && !take;
		tick();
		return got;
	}

	Random random;
	std::deque<uint64_t> held;

private:
	bool offered = false, waiting = false;
	uint64_t word = 0;
};

static void in_order_with_any_stalls(StreamBench &bench)
{
	Stall in(bench.random), out(bench.random);

	for (int n = 0; n < 200000; n++)
		bench.clock(!in.now(), !out.now());
}

static void a_word_every_clock(StreamBench &bench)
{
	int got = 0;

	for (int n = 0; n < 20; n++)
		bench.clock(true, true);
	for (int n = 0; n < 1000; n++)
		got += bench.clock(true, true);
	TB_CHECK(got == 1000, "%d words in 1000 clocks", got);
}

static void holds_what_it_says(StreamBench &bench)
{
	for (int n = 0; n < 200; n++)
		bench.clock(true, false);
	TB_CHECK(bench.held.size() == CAPACITY, "holds %zu words", bench.held.size());
	while (!bench.held.empty())
		bench.clock(false, true);
}

static void empty_after_reset(StreamBench &bench)
{
	bench.clock(true, false);
	bench.clock(true, false);
	bench.top.valid_i = 0;
	bench.reset();
	bench.held.clear();
	bench.settle();
	TB_CHECK(!bench.top.valid_o, "a word survived reset");
}

int main()
{
	StreamBench bench(tb_seed());

	in_order_with_any_stalls(bench);
	a_word_every_clock(bench);
	holds_what_it_says(bench);
	empty_after_reset(bench);
	printf("tb_lib: %s passed, %" PRIu64 " clocks\n", QUOTE(TOP), bench.clocks);
	return 0;
}
