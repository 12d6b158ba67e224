// SPDX-License-Identifier: MIT
/* port_usb as a bridge sees it: registers, synchronisation, jobs and their answers, speed. */
#include "port_usb_bench.h"

static const uint32_t idle = GLOSS_REG_STATUS_IDLE;
static const uint32_t magic = GLOSS_USB_SYNC_MAGIC;

static void registers_are_as_the_manual_says(UsbBench &bench)
{
	static const struct {
		uint32_t offset, kept, start;
	} registers[] = {
		{ GLOSS_REG_IDENTITY, 0, GLOSS_IDENTITY },
		{ GLOSS_REG_VERSION, 0, GLOSS_VERSION },
		{ GLOSS_REG_CAPABILITIES, 0, LANES << 8 | TILE },
		{ GLOSS_REG_MEMORY_PAGES, 0, 0x12345 },
		{ GLOSS_REG_STATUS, 0, idle },
		{ GLOSS_REG_INTERRUPT_STATUS, 0, 0 },
		{ GLOSS_REG_INTERRUPT_MASK, 0, 0 },
		{ GLOSS_REG_RING_LOW, 0, 0 },
		{ GLOSS_REG_TAIL, 0, 0 },
		{ GLOSS_REG_FAULT_CAUSE, 0, 0 },
		{ GLOSS_REG_FAULT_OFFSET, 0, 0 },
		{ GLOSS_REG_FAULT_SEQUENCE, 0, 0 },
		{ GLOSS_REG_PROGRESS, 0, 0 },
		{ GLOSS_REG_JOBS, 0, 0 },
		{ GLOSS_REG_STALL_RESPONSE, 0, 0 },
		{ GLOSS_REG_NONCE, ~0u, 0 },
		{ 0x088, 0, 0 },
		{ 0x100 + GLOSS_REG_NONCE, 0, 0 },
		{ 0xfffc, 0, 0 },
	};

	bench.reset_port();
	for (int n = 0; n < 3; n++) {
		for (const auto &reg : registers)
			TB_CHECK(bench.read(reg.offset) == reg.start, "register %x reads %08x", reg.offset,
				 bench.read(reg.offset));
		for (const auto &reg : registers)
			bench.write(reg.offset, n ? bench.random.bits() : ~0u);
		for (const auto &reg : registers) {
			uint32_t value = bench.random.bits();

			bench.write(reg.offset, value);
			value = (value & reg.kept) | (reg.start & ~reg.kept);
			TB_CHECK(bench.read(reg.offset) == value, "register %x reads %08x, not %08x", reg.offset,
				 bench.read(reg.offset), value);
		}
		bench.write(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
		TB_CHECK(bench.read(GLOSS_REG_CONTROL) == 0, "CONTROL.enable is kept");
		bench.reset_port();
	}
}

/* Resets before and within jobs, and as many as there are. */
static void boot_outlasts_a_reset(UsbBench &bench)
{
	const uint32_t boot = bench.random.bits() | 1;

	bench.reset_port();
	TB_CHECK(bench.read(GLOSS_REG_BOOT) == 0, "BOOT is not 0 after power on");
	bench.write(GLOSS_REG_BOOT, boot);
	for (int n = 0; n < 20; n++) {
		bench.start();
		bench.send(bench.job(bench.random.between(1, 500), bench.random.between(0, 500)));
		bench.clock(bench.random.between(0, 2000));
		bench.reset_port();
		TB_CHECK(bench.read(GLOSS_REG_BOOT) == boot, "BOOT reads %08x, not %08x",
			 bench.read(GLOSS_REG_BOOT), boot);
	}
	bench.write(GLOSS_REG_BOOT, 0);
}

/* ---- synchronisation ---- */

/* How many of @words up to the end of a sync; those before @from end none. 0: there is no sync. */
static size_t sync_end(const std::vector<uint32_t> &words, uint32_t nonce, size_t from)
{
	for (size_t n = std::max<size_t>(from, 3); n < words.size(); n++)
		if (nonce && words[n - 3] == magic && words[n - 2] == nonce && words[n - 1] == ~nonce &&
		    words[n] == ~magic)
			return n + 1;
	return 0;
}

/* Words that often are a sync, or nearly. */
static std::vector<uint32_t> nearly_sync(Random &random, uint32_t nonce, uint32_t count)
{
	const uint32_t sync[] = { magic, nonce, ~nonce, ~magic };
	std::vector<uint32_t> words;

	while (words.size() < count)
		words.push_back(random.chance(75) ? sync[words.size() % 4] :
				random.chance(80) ? sync[random.below(4)] : random.bits());
	return words;
}

static void a_sync_is_found_in_any_words(UsbBench &bench, int rounds)
{
	int found = 0;

	for (int round = 0; round < rounds; round++) {
		const uint32_t nonces[] = { bench.random.bits() | 1, magic, ~magic, 1, ~0u, 0 };
		uint32_t nonce = nonces[bench.random.below(6)];
		std::vector<uint32_t> words = nearly_sync(bench.random, nonce, bench.random.below(60));
		size_t early = bench.random.chance(50) ? bench.random.below(words.size() + 1) : 0, end;

		bench.random_stalls();
		bench.drop_out();
		bench.reset_port();
		bench.write(GLOSS_REG_NONCE, early ? bench.random.bits() : nonce);
		bench.out.assign(words.begin(), words.begin() + early);
		bench.drain();
		bench.write(GLOSS_REG_NONCE, nonce);
		end = sync_end(words, nonce, early);
		bench.out.assign(words.begin() + early, end ? words.begin() + end : words.end());
		bench.nonce = nonce;
		if (end)
			bench.expect_echo();
		bench.drain();
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == idle, "STATUS");
		if (!end)
			continue;
		found++;
		bench.check_works();
	}
	TB_CHECK(found > rounds / 4, "only %d of %d were syncs", found, rounds);
}

/* The first words of a sync count for nothing behind a reset. */
static void a_reset_forgets_half_a_sync(UsbBench &bench)
{
	for (size_t half = 1; half < 4; half++) {
		bench.drop_out();
		bench.kind();
		bench.reset_port();
		bench.write(GLOSS_REG_NONCE, 0x1234);
		bench.send_sync(0x1234);
		bench.out.resize(half);
		bench.drain();
		bench.reset_port();
		bench.write(GLOSS_REG_NONCE, 0x1234);
		bench.send_sync(0x1234);
		bench.out.erase(bench.out.begin(), bench.out.begin() + half);
		bench.drain();
		bench.start();
		bench.check_works();
	}
}

/* ---- jobs ---- */

static void jobs_of_all_lengths_with_all_stalls(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		std::deque<UsbJob> jobs;

		bench.random_stalls();
		bench.start();
		for (int count = bench.random.between(1, 12); count > 0; count--) {
			bench.send(bench.random_job());
			jobs.push_back(bench.jobs.back());
			if (bench.random.chance(50))
				bench.clock(bench.random.below(500));
		}
		bench.wait();
		bench.clock(10);
		bench.check_events(jobs, !bench.stalls);
		bench.check_counters();
	}
}

static void chunks_end_at_each_border(UsbBench &bench)
{
	for (uint32_t words : { 0, 254, 255, 256, 257, 258, 510, 511, 512, 513, 514, 767, 768, 769, 1024 }) {
		for (int n = 0; n < 3; n++) {
			if (n)
				bench.unkind();
			else
				bench.kind();
			bench.start();
			bench.send(bench.job(bench.random.below(2) * 300, words));
			bench.send(bench.job(0, words));
			bench.wait();
			bench.check_counters();
		}
	}
}

/* Half of a stream, and half of its answer is a chunk: it leaves though nothing follows. */
static void a_full_chunk_does_not_wait(UsbBench &bench)
{
	UsbJob job = bench.job(104, 2 * GLOSS_USB_CHUNK_WORDS);
	std::deque<uint32_t> rest;
	uint64_t taken;

	bench.kind();
	bench.start();
	bench.wait();
	taken = bench.taken;
	bench.send(job);
	rest.assign(bench.out.end() - 53, bench.out.end());
	bench.out.resize(bench.out.size() - 53);
	bench.drain();
	taken = bench.taken - taken;
	TB_CHECK(taken == 1 + GLOSS_USB_CHUNK_WORDS, "%" PRIu64 " words came", taken);
	bench.out = rest;
	bench.wait();
	bench.check_counters();
}

/* When a usb_completion is there, the registers have its job. */
static void registers_go_before_completions(UsbBench &bench)
{
	bench.kind();
	bench.start();
	for (uint32_t n = 1; n <= 20; n++) {
		UsbJob job = bench.job(bench.random.below(10), bench.random.below(10));

		job.answer.cause = bench.random.between(1, 7);
		bench.send(job);
		bench.wait();
		TB_CHECK(bench.read(GLOSS_REG_JOBS) == n, "JOBS");
		TB_CHECK(bench.read(GLOSS_REG_FAULT_CAUSE) == job.answer.cause &&
			 bench.read(GLOSS_REG_FAULT_OFFSET) == job.answer.offset &&
			 bench.read(GLOSS_REG_FAULT_SEQUENCE) == job.sequence, "fault");
	}
	bench.check_counters();
}

/* ---- speed ---- */

static void out_comes_a_word_a_clock(UsbBench &bench)
{
	const uint32_t words = 20000;
	uint64_t start;
	double share;

	bench.kind();
	bench.start();
	bench.wait();
	start = bench.clocks;
	bench.send(bench.job(words, 0));
	bench.wait();
	share = (double)words / (bench.taken_clock - start);
	printf("  OUT: %.3f words a clock\n", share);
	TB_CHECK(share > 0.99, "a stream of %u words took %" PRIu64 " clocks", words, bench.taken_clock - start);
}

static void in_leaves_a_word_a_clock(UsbBench &bench)
{
	const uint32_t words = 20000;
	uint64_t start, taken;
	double share;

	bench.kind();
	bench.start();
	bench.wait();
	start = bench.clocks;
	taken = bench.taken;
	bench.send(bench.job(0, words));
	bench.wait();
	share = (double)(bench.taken - taken) / (bench.taken_clock - start);
	printf("  IN: %.3f words a clock\n", share);
	TB_CHECK(share > 0.97, "a response of %u words took %" PRIu64 " clocks", words, bench.taken_clock - start);
}

/* With the next job's words in the FIFO. */
static void an_empty_job_takes_few_clocks(UsbBench &bench)
{
	const int jobs = 20, own = 4 + 16 + 5;
	uint64_t start;
	double clocks;

	bench.kind();
	bench.start();
	bench.wait();
	start = bench.clocks;
	for (int n = 0; n < jobs; n++) {
		UsbJob job = bench.job(0, 0);

		job.slots.clear();
		bench.send(job);
	}
	bench.wait();
	clocks = (double)(bench.taken_clock - start) / jobs;
	printf("  an empty job: %.1f clocks\n", clocks);
	TB_CHECK(clocks < own + 12, "an empty job takes %.1f clocks", clocks);
}

/* What waits for a job that runs is taken from the bridge, as much as the FIFO holds. */
static void the_next_job_waits_in_the_fifo(UsbBench &bench)
{
	UsbJob next = bench.job(400, 0);

	next.slots.clear();
	bench.kind();
	bench.start();
	bench.wait();
	bench.core.hung = true;
	bench.send(bench.job(100, 0));
	bench.send(next);
	bench.clock(1000);
	TB_CHECK(bench.out.empty() && bench.core.running, "it does not");
	bench.core.hung = false;
	bench.wait();
	bench.check_counters();
}

int main(int argc, char **argv)
{
	static UsbBench bench(tb_seed());
	int rounds = argc > 1 ? atoi(argv[1]) : 20;

	registers_are_as_the_manual_says(bench);
	boot_outlasts_a_reset(bench);
	a_sync_is_found_in_any_words(bench, 10 * rounds);
	a_reset_forgets_half_a_sync(bench);
	jobs_of_all_lengths_with_all_stalls(bench, rounds);
	chunks_end_at_each_border(bench);
	a_full_chunk_does_not_wait(bench);
	registers_go_before_completions(bench);
	port_usb_faults(bench, rounds);
	out_comes_a_word_a_clock(bench);
	in_leaves_a_word_a_clock(bench);
	an_empty_job_takes_few_clocks(bench);
	the_next_job_waits_in_the_fifo(bench);
	printf("tb_port_usb: K %d, S %d passed, %" PRIu64 " clocks\n", LANES, STREAM, bench.clocks);
	return 0;
}
