// SPDX-License-Identifier: MIT
/*
 * memory between the bench, which plays command and tile, and an AXI memory that checks: copies of
 * all alignments and lengths, rows of tiles in both directions, errors.
 */
#include "Vmemory.h"
#include "memory_axi.h"

static const uint32_t memory_words = 8192;

class MemoryBench : public Bench<Vmemory> {
public:
	explicit MemoryBench(uint64_t seed) : random(seed), axi(random, memory_words), expected(memory_words)
	{
		for (uint32_t at = 0; at < memory_words; at++)
			axi.words[at] = expected[at] = random.bits();
		top.memory_error_clear_i = 0;
	}

	void unkind(bool on)
	{
		stalls = on;
		if (on)
			axi.unkind();
		else
			axi.steady(20);
	}

	/* Until the copy is done: what is written is there and what is read has come. Returns its clocks. */
	uint64_t copy(bool write, uint32_t word, uint32_t count)
	{
		uint64_t start;

		for (uint32_t n = 0; n < count && write; n++) {
			payload.push_back(random.bits());
			expected[word + n] = payload.back();
		}
		for (uint32_t n = 0; n < count && !write; n++)
			answers.push_back(expected[word + n]);
		top.copy_valid_i = 1;
		tb_set(top.copy_i, 0, 16, count);
		tb_set(top.copy_i, 16, 32, word * 4);
		tb_set(top.copy_i, 48, 1, write);
		settle();
		while (!top.copy_ready_o)
			clock();
		start = clocks;
		clock();
		top.copy_valid_i = 0;
		for (settle(); !top.copy_idle_o; settle()) {
			TB_CHECK(clocks - start < 100 + 100 * count, "a copy of %u words hangs", count);
			clock();
		}
		TB_CHECK(payload.empty() && answers.empty() && axi.quiet(), "idle too early");
		return clocks - start;
	}

	void check_memory()
	{
		for (uint32_t at = 0; at < memory_words; at++)
			TB_CHECK(axi.words[at] == expected[at], "word %x is %08x, not %08x", at, axi.words[at],
				 expected[at]);
	}

	/* Rows are stored to the lower half of memory and loaded from the upper one, both at once. */
	void rows(int count)
	{
		store_rows = load_rows = stored_rows = count;
		for (int n = 0; store_rows || load_rows || stored_rows || !loaded.empty(); n++) {
			TB_CHECK(n < 1000 * count, "rows hang");
			clock();
		}
		TB_CHECK(beats.empty() && axi.quiet(), "acknowledged too early");
		check_memory();
	}

	void clock()
	{
		bool hold_data = stalls && data_stall.now();

		offered |= !payload.empty() && !hold_data;
		top.copy_data_valid_i = offered;
		if (offered)
			top.copy_data_i = payload.front();
		top.response_ready_i = !(stalls && response_stall.now());
		drive_rows();
		axi.drive(top, clocks);
		settle();
		if (offered && top.copy_data_ready_o) {
			payload.pop_front();
			offered = false;
		}
		sample_answer();
		sample_rows();
		axi.sample(top, clocks);
		tick();
	}

	Random random;
	MemoryAxi<Vmemory> axi;
	bool stalls = false;

private:
	struct Beat {
		uint32_t word[LANES];
		bool last;
	};

	void sample_answer()
	{
		if (!top.response_valid_o || !top.response_ready_i)
			return;
		TB_CHECK(top.response_count_o >= 1 && top.response_count_o <= answers.size(),
			 "%d words, %zu to come", top.response_count_o, answers.size());
		for (int n = 0; n < top.response_count_o; n++) {
			uint32_t word = tb_get(top.response_data_o, 32 * n, 32);

			TB_CHECK(word == answers.front(), "read %08x, not %08x", word, answers.front());
			answers.pop_front();
		}
	}

	/* A row's data are offered once its address is, as tile does. */
	void drive_rows()
	{
		if (!store_offered && store_rows && beats.empty() && !(stalls && store_stall.now())) {
			store_row = random.below(memory_words / 2 / TILE) * TILE;
			store_offered = true;
			for (int n = 0; n < TILE / LANES; n++)
				beats.push_back(new_beat(n));
		}
		top.store_valid_i = store_offered;
		top.store_address_i = store_row * 4;
		top.store_data_valid_i = !beats.empty();
		if (!beats.empty()) {
			for (int l = 0; l < LANES; l++)
				tb_set(top.store_data_i, 32 * l, 32, beats.front().word[l]);
			top.store_data_last_i = beats.front().last;
		}
		if (!load_offered && load_rows && !(stalls && load_stall.now())) {
			load_row = (memory_words / 2 / TILE + random.below(memory_words / 2 / TILE)) * TILE;
			load_offered = true;
		}
		top.load_valid_i = load_offered;
		top.load_address_i = load_row * 4;
	}

	Beat new_beat(int n)
	{
		Beat beat;

		for (int l = 0; l < LANES; l++) {
			beat.word[l] = random.bits();
			expected[store_row + n * LANES + l] = beat.word[l];
		}
		beat.last = n + 1 == TILE / LANES;
		return beat;
	}

	void sample_rows()
	{
		if (store_offered && top.store_ready_o) {
			store_offered = false;
			store_rows--;
		}
		if (!beats.empty() && top.store_data_ready_o)
			beats.pop_front();
		TB_CHECK(!top.store_done_o || stored_rows > 0, "a row was stored that nobody asked for");
		stored_rows -= top.store_done_o;
		if (load_offered && top.load_ready_o) {
			load_offered = false;
			load_rows--;
			for (int n = 0; n < TILE; n++)
				loaded.push_back(expected[load_row + n]);
		}
		for (int l = 0; l < LANES && top.load_data_valid_o; l++) {
			uint32_t word = tb_get(top.load_data_o, 32 * l, 32);

			TB_CHECK(!loaded.empty() && word == loaded.front(), "loaded %08x", word);
			loaded.pop_front();
		}
	}

	std::vector<uint32_t> expected;
	std::deque<uint32_t> payload, answers, loaded;
	std::deque<Beat> beats;
	bool offered = false, store_offered = false, load_offered = false;
	int store_rows = 0, load_rows = 0, stored_rows = 0;
	uint32_t store_row = 0, load_row = 0;
	Stall data_stall{ random }, response_stall{ random }, store_stall{ random }, load_stall{ random };
};

/* Every first lane and every way to end, before and after a block of sixteen beats. */
static void copies_of_all_alignments_and_lengths(MemoryBench &bench)
{
	static const uint32_t base = 16 * LANES;

	for (uint32_t first = base - LANES; first <= base + LANES; first++) {
		for (uint32_t count = 1; count <= 3 * LANES + 2; count++) {
			bench.unkind(bench.random.chance(50));
			bench.copy(true, first, count);
			bench.copy(false, first - 1, count + 2);
			bench.copy(false, first, count);
		}
		bench.check_memory();
	}
}

static void long_copies(MemoryBench &bench, int copies)
{
	for (int n = 0; n < copies; n++) {
		uint32_t count = bench.random.between(1, 2000);
		uint32_t first = bench.random.below(memory_words - count);

		bench.unkind(bench.random.chance(70));
		bench.copy(bench.random.chance(50), first, count);
		bench.check_memory();
	}
	bench.copy(false, 0, memory_words);
}

static void a_word_written_and_a_beat_read_each_clock(MemoryBench &bench)
{
	uint64_t clocks;

	bench.unkind(false);
	clocks = bench.copy(true, 0, 2000);
	TB_CHECK(clocks < 2000 + 60, "%" PRIu64 " clocks to write 2000 words", clocks);
	clocks = bench.copy(false, 0, 1024 * LANES);
	TB_CHECK(clocks < 1024 + 60, "%" PRIu64 " clocks to read 1024 beats", clocks);
}

static void rows_of_tiles(MemoryBench &bench)
{
	for (int n = 0; n < 20; n++) {
		bench.unkind(n % 2);
		bench.rows(100);
		bench.copy(false, 0, 100);
	}
}

static void an_error_is_kept_until_it_is_cleared(MemoryBench &bench)
{
	bench.unkind(false);
	for (bool write : { true, false }) {
		for (int n : { 0, 1 }) {
			(write ? bench.axi.write_errors : bench.axi.read_errors) = n;
			bench.copy(write, 0, 17 * LANES);
			TB_CHECK(bench.top.memory_error_o, "an error is not seen");
			bench.copy(write, 0, 1);
			TB_CHECK(bench.top.memory_error_o, "an error is forgotten");
			bench.top.memory_error_clear_i = 1;
			bench.clock();
			bench.top.memory_error_clear_i = 0;
			TB_CHECK(!bench.top.memory_error_o, "an error is not cleared");
		}
	}
	bench.copy(true, 0, 100);
	TB_CHECK(!bench.top.memory_error_o, "an error from nowhere");
}

int main(int argc, char **argv)
{
	static MemoryBench bench(tb_seed());
	int copies = argc > 1 ? atoi(argv[1]) : 100;

	copies_of_all_alignments_and_lengths(bench);
	long_copies(bench, copies);
	a_word_written_and_a_beat_read_each_clock(bench);
	rows_of_tiles(bench);
	an_error_is_kept_until_it_is_cleared(bench);
	printf("tb_memory: T %d, K %d passed, %" PRIu64 " clocks\n", TILE, LANES, bench.clocks);
	return 0;
}
