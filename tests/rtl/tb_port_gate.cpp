// SPDX-License-Identifier: MIT
/*
 * port_gate between a master that is reset at any time and a memory that checks the rules of AXI4:
 * what the gate took of the master is done to the last beat, and nothing else.
 */
#include "Vport_gate.h"
#include "memory_axi.h"

static const uint32_t memory_words = 8192, beat_words = LANES;

class GateBench : public Bench<Vport_gate> {
public:
	explicit GateBench(uint64_t seed) : random(seed), axi(random, memory_words), expected(memory_words)
	{
		for (uint32_t at = 0; at < memory_words; at++)
			axi.words[at] = expected[at] = random.bits();
		top.stop_i = 0;
	}

	void unkind(bool on)
	{
		stalls = on;
		if (on)
			axi.unkind();
		else
			axi.steady(20);
	}

	/* The master may be reset: it forgets everything. */
	void forget()
	{
		write_offered = read_offered = false;
		writes.clear();
		reads.clear();
		data.clear();
		answers = 0;
	}

	/* Stops the gate, resets the master as soon as it may be, and opens the gate again. */
	void stop_and_reset()
	{
		uint64_t start = clocks;

		top.stop_i = 1;
		for (; !top.stopped_o; clock())
			TB_CHECK(clocks - start < 3000, "the gate does not stop");
		forget();
		master = false;
		for (; !top.idle_o; clock())
			TB_CHECK(clocks - start < 6000, "the gate does not come to rest");
		TB_CHECK(axi.quiet(), "idle, but memory is at work");
		check_memory();
		top.stop_i = 0;
		master = true;
	}

	/* Until all that the master began is done. */
	void finish()
	{
		more = false;
		for (int n = 0; write_offered || read_offered || !data.empty() || !reads.empty() || answers; n++) {
			TB_CHECK(n < 10000, "transfers hang");
			clock();
		}
		TB_CHECK(axi.quiet(), "memory is at work for nobody");
		settle();
		TB_CHECK(top.idle_o, "not idle when all is done");
		check_memory();
		more = true;
	}

	void clock()
	{
		drive();
		axi.drive(top, clocks);
		settle();
		sample();
		axi.sample(top, clocks);
		tick();
	}

	Random random;
	MemoryAxi<Vport_gate> axi;
	uint64_t beats = 0;			/* written */

private:
	struct Burst {
		uint32_t word, beats;
	};

	bool hold(Stall &stall) { return stalls && stall.now(); }

	Burst burst()
	{
		uint32_t length = stalls ? random.between(1, 16) : 16;

		return { random.below(memory_words / 2 / beat_words / 16) * 16 * beat_words, length };
	}

	/* Data are there before or after their address; reads are of the upper half, which nobody writes. */
	void drive()
	{
		if (master && more && !write_offered && writes.size() < 4 && !hold(aw_stall)) {
			write_offered = true;
			writes.push_back(burst());
			for (uint32_t n = 0; n < writes.back().beats; n++)
				data.push_back({ writes.back().word + n * beat_words,
					       n + 1 == writes.back().beats });
		}
		if (master && more && !read_offered && reads.size() < 100 && !hold(ar_stall)) {
			read_offered = true;
			read = burst();
			read.word += memory_words / 2;
		}
		top.master_awvalid_i = write_offered;
		if (write_offered) {
			top.master_awaddr_i = writes.back().word * 4;
			top.master_awlen_i = writes.back().beats - 1;
		}
		data_offered = !data.empty() && (data_offered || !hold(w_stall));
		top.master_wvalid_i = data_offered;
		if (data_offered && !data_waits)
			for (uint32_t l = 0; l < LANES; l++)
				tb_set(top.master_wdata_i, 32 * l, 32, random.bits());
		if (data_offered && !data_waits)
			top.master_wstrb_i = strobes();
		top.master_bready_i = 1;
		top.master_arvalid_i = read_offered;
		top.master_araddr_i = read.word * 4;
		top.master_arlen_i = read.beats - 1;
		top.master_rready_i = !hold(r_stall);
	}

	uint32_t strobes()
	{
		uint32_t bits = 0;

		for (uint32_t l = 0; l < LANES; l++)
			bits |= (random.chance(80) ? 15u : 0) << 4 * l;
		return bits;
	}

	void sample()
	{
		TB_CHECK(!top.stop_i || (!top.master_awready_o && !top.master_arready_o &&
					 !top.master_bvalid_o && !top.master_rvalid_o), "stopped, but open");
		if (write_offered && top.master_awready_o) {
			write_offered = false;
			answers++;
		}
		data_waits = data_offered && !top.master_wready_o;
		if (data_offered && top.master_wready_o)
			sample_beat();
		if (top.master_bvalid_o) {
			TB_CHECK(answers > 0, "an answer to nothing");
			answers--;
		}
		if (read_offered && top.master_arready_o) {
			read_offered = false;
			for (uint32_t n = 0; n < read.beats; n++)
				reads.push_back({ read.word + n * beat_words, n + 1 == read.beats });
		}
		if (top.master_rvalid_o && top.master_rready_i)
			sample_read();
	}

	void sample_beat()
	{
		uint32_t word = data.front().word;

		TB_CHECK(!top.stopped_o, "a beat is taken behind a closed gate");
		if (data.front().last)
			writes.pop_front();
		data.pop_front();
		data_offered = false;
		beats++;
		for (uint32_t l = 0; l < LANES; l++)
			if (top.master_wstrb_i >> 4 * l & 1)
				expected[word + l] = tb_get(top.master_wdata_i, 32 * l, 32);
	}

	void sample_read()
	{
		TB_CHECK(!reads.empty(), "a beat that nobody asked for");
		for (uint32_t l = 0; l < LANES; l++)
			TB_CHECK(tb_get(top.master_rdata_o, 32 * l, 32) == expected[reads.front().word + l],
				 "another beat was read");
		TB_CHECK(top.master_rlast_o == reads.front().last, "RLAST");
		reads.pop_front();
	}

	void check_memory()
	{
		for (uint32_t at = 0; at < memory_words; at++)
			TB_CHECK(axi.words[at] == expected[at], "word %x is %08x, not %08x", at, axi.words[at],
				 expected[at]);
	}

	struct Beat {
		uint32_t word, last;
	};

	std::vector<uint32_t> expected;
	bool stalls = false, master = true, more = true;
	bool write_offered = false, read_offered = false, data_offered = false, data_waits = false;
	Burst read = { 0, 1 };
	std::deque<Burst> writes;		/* whose data are not all given */
	std::deque<Beat> data, reads;
	int answers = 0;			/* to come */
	Stall aw_stall{ random }, w_stall{ random }, ar_stall{ random }, r_stall{ random };
};

static void all_goes_through_an_open_gate(GateBench &bench)
{
	for (int round = 0; round < 20; round++) {
		bench.unkind(round % 2);
		for (int n = 0; n < 500; n++)
			bench.clock();
		bench.finish();
	}
}

static void a_beat_a_clock(GateBench &bench)
{
	uint64_t beats;

	bench.unkind(false);
	for (int n = 0; n < 100; n++)
		bench.clock();
	beats = bench.beats;
	for (int n = 0; n < 1000; n++)
		bench.clock();
	TB_CHECK(bench.beats - beats > 990, "%" PRIu64 " beats in 1000 clocks", bench.beats - beats);
	bench.finish();
}

static void a_master_is_reset_at_any_time(GateBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		bench.unkind(bench.random.chance(90));
		for (int n = bench.random.below(200); n > 0; n--)
			bench.clock();
		bench.stop_and_reset();
	}
	bench.finish();
}

int main(int argc, char **argv)
{
	static GateBench bench(tb_seed());

	all_goes_through_an_open_gate(bench);
	a_beat_a_clock(bench);
	a_master_is_reset_at_any_time(bench, argc > 1 ? atoi(argv[1]) : 1000);
	printf("tb_port_gate: K %d passed, %" PRIu64 " clocks\n", LANES, bench.clocks);
	return 0;
}
