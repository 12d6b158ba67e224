// SPDX-License-Identifier: MIT
/*
 * port_usb as a bridge sees it: registers, synchronisation, jobs, events, and what may go wrong on a
 * cable.
 */
#include "port_usb_bench.h"

static const uint32_t idle = GLOSS_REG_STATUS_IDLE;
static const uint32_t running = GLOSS_REG_STATUS_RUNNING;
static const uint32_t lost = GLOSS_REG_STATUS_LOST;
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
		{ 0x084, 0, 0 },
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

static void check_counters(UsbBench &bench)
{
	static const uint32_t stalls[] = { GLOSS_REG_STALL_STREAM, GLOSS_REG_STALL_RASTER,
					   GLOSS_REG_STALL_TILE, GLOSS_REG_STALL_MEMORY,
					   GLOSS_REG_STALL_RESPONSE };
	uint64_t sum;

	TB_CHECK(bench.read(GLOSS_REG_JOBS) == bench.finished, "JOBS");
	TB_CHECK(bench.read(GLOSS_REG_PROGRESS) == bench.progress, "PROGRESS");
	sum = bench.read(GLOSS_REG_CLOCKS_LOW) | (uint64_t)bench.read(GLOSS_REG_CLOCKS_HIGH) << 32;
	TB_CHECK(sum == bench.time[0], "CLOCKS is %" PRIx64, sum);
	for (int n = 0; n < 5; n++)
		TB_CHECK(bench.read(stalls[n]) == (uint32_t)bench.time[1 + n], "stall counter %d", n);
	TB_CHECK(bench.read(GLOSS_REG_STATUS) == idle, "not idle when all is done");
}

static void random_stalls(UsbBench &bench)
{
	if (bench.random.chance(80))
		bench.unkind();
	else
		bench.kind();
}

/* A job, and all that can be seen of it; then the port is in order. */
static void check_works(UsbBench &bench)
{
	bench.send(bench.random_job());
	bench.wait();
	check_counters(bench);
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

		random_stalls(bench);
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
		check_works(bench);
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
		check_works(bench);
	}
}

/* ---- jobs ---- */

/* What is left of @faults when all of @events are taken out, in their order. */
static void check_events(std::deque<uint64_t> events, const std::deque<UsbJob> &jobs, bool all)
{
	for (const UsbJob &job : jobs) {
		uint64_t event = (uint64_t)job.sequence << 32 | GLOSS_USB_EVENT_MAGIC << 16 | job.answer.cause;

		if (!job.answer.cause)
			continue;
		if (!events.empty() && events.front() == event)
			events.pop_front();
		else
			TB_CHECK(!all, "the fault of %08x is no event", job.sequence);
	}
	TB_CHECK(events.empty(), "an event too many: %016" PRIx64, events.front());
}

static void jobs_of_all_lengths_with_all_stalls(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		std::deque<UsbJob> jobs;

		random_stalls(bench);
		bench.start();
		for (int count = bench.random.between(1, 12); count > 0; count--) {
			bench.send(bench.random_job());
			jobs.push_back(bench.jobs.back());
			if (bench.random.chance(50))
				bench.clock(bench.random.below(500));
		}
		bench.wait();
		bench.clock(10);
		check_events(bench.events, jobs, !bench.stalls);
		check_counters(bench);
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
			check_counters(bench);
		}
	}
}

/* Half of a stream, and half of its answer is a chunk: it leaves though nothing follows. */
static void a_full_chunk_does_not_wait(UsbBench &bench)
{
	UsbJob job = bench.job(104, 2 * GLOSS_USB_CHUNK_WORDS);
	uint64_t taken;

	bench.kind();
	bench.start();
	bench.wait();
	taken = bench.taken;
	bench.send(job);
	bench.out.resize(bench.out.size() - 52);
	bench.drain();
	taken = bench.taken - taken;
	TB_CHECK(taken == 1 + GLOSS_USB_CHUNK_WORDS, "%" PRIu64 " words came", taken);
	bench.out.assign(job.stream.end() - 52, job.stream.end());
	bench.wait();
	check_counters(bench);
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
	check_counters(bench);
}

/* A host that stops within a job is waited for, wherever it does. */
static void a_torn_job_waits_for_its_rest(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		UsbJob job = bench.job(bench.random.below(40), bench.random.below(300));
		size_t head = 4 + 4 * job.slots.size(), words = head + job.stream.size(), cut;
		std::deque<uint32_t> rest;

		random_stalls(bench);
		bench.start();
		bench.wait();
		bench.send(job);
		cut = bench.random.between(1, (int)words - 1);
		rest.assign(bench.out.begin() + cut, bench.out.end());
		bench.out.resize(cut);
		bench.drain();
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == (cut < head ? 0 : running), "STATUS of a job cut at %zu",
			 cut);
		TB_CHECK(bench.read(GLOSS_REG_JOBS) == 0 && bench.jobs.size() == 1, "it has ended");
		if (bench.random.chance(50)) {
			bench.out = rest;
			bench.wait();
			check_counters(bench);
		}
	}
}

/* ---- what may go wrong ---- */

static uint32_t no_head(Random &random)
{
	uint32_t word = GLOSS_USB_JOB_MAGIC << 8 | random.below(17);

	switch (random.below(3)) {
	case 0:
		return word ^ 1u << random.between(8, 31);
	case 1:
		return word | 1u << random.between(5, 7);
	default:
		return GLOSS_USB_JOB_MAGIC << 8 | random.between(17, 31);
	}
}

static void a_word_no_job_begins_with_loses_the_channel(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		random_stalls(bench);
		bench.start();
		for (int n = bench.random.below(3); n > 0; n--) {
			UsbJob job = bench.random_job();

			job.answer.cause = 0;
			bench.send(job);
		}
		bench.in_closed = bench.random.chance(30);
		bench.out.push_back(no_head(bench.random));
		if (bench.random.chance(70)) {
			bench.send_words(bench.random_job());
			bench.send_sync(bench.nonce);
			bench.send_words(bench.random_job());
		}
		bench.clock(bench.random.below(2000));
		bench.in_closed = false;
		bench.wait();
		bench.drain();
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == (idle | lost), "STATUS");
		TB_CHECK(bench.events.size() == 1 &&
			 bench.events[0] == (GLOSS_USB_EVENT_MAGIC << 16 | GLOSS_USB_EVENT_LOST), "events");
		bench.start();
		check_works(bench);
	}
}

static void four_events_wait(UsbBench &bench)
{
	std::deque<UsbJob> jobs;

	bench.kind();
	bench.start();
	bench.events_closed = true;
	for (int n = 0; n < 7; n++) {
		jobs.push_back(bench.job(3, 3));
		jobs.back().answer.cause = 1 + n;
		bench.send(jobs.back());
	}
	bench.wait();
	bench.events_closed = false;
	bench.clock(20);
	jobs.resize(4);
	check_events(bench.events, jobs, true);
	bench.send(bench.job(3, 3));
	bench.out.push_back(0);
	bench.wait();
	bench.clock(20);
	TB_CHECK(bench.events.back() == (GLOSS_USB_EVENT_MAGIC << 16 | GLOSS_USB_EVENT_LOST),
		 "no event after those that were dropped");
}

/* A fault is told to a host that does not read IN, and its job is counted. */
static void a_fault_does_not_wait_for_in(UsbBench &bench)
{
	for (uint32_t words : { 0, 10, 300 }) {
		UsbJob job = bench.job(10, words);

		job.answer.cause = 5;
		bench.kind();
		bench.start();
		bench.wait();
		bench.in_closed = true;
		bench.send(job);
		bench.clock(1000);
		check_events(bench.events, { job }, true);
		TB_CHECK(bench.read(GLOSS_REG_JOBS) == 1, "JOBS");
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == running, "its core has the next job");
		bench.in_closed = false;
		bench.wait();
		check_counters(bench);
	}
}

static void an_answer_nobody_takes_stops_out(UsbBench &bench)
{
	for (int round = 0; round < 10; round++) {
		uint64_t sent;

		random_stalls(bench);
		bench.start();
		bench.in_closed = true;
		for (int n = 0; n < 6; n++)
			bench.send(bench.job(bench.random.between(200, 1000), bench.random.between(300, 2000)));
		bench.clock(20000);
		sent = bench.sent;
		bench.clock(2000);
		TB_CHECK(!bench.out.empty() && bench.sent == sent, "OUT goes on");
		bench.in_closed = false;
		bench.wait();
		check_counters(bench);
	}
}

/* ---- reset ---- */

static void check_reset(UsbBench &bench)
{
	TB_CHECK(bench.read(GLOSS_REG_STATUS) == idle && bench.read(GLOSS_REG_NONCE) == 0 &&
		 bench.read(GLOSS_REG_PROGRESS) == 0 && bench.read(GLOSS_REG_JOBS) == 0 &&
		 bench.read(GLOSS_REG_FAULT_CAUSE) == 0, "not as after power-on");
	TB_CHECK(bench.events.empty(), "an event from before the reset");
}

/* What waits in the FIFO is from before the reset, even a sync that fits. */
static void a_reset_empties_the_fifo(UsbBench &bench)
{
	bench.kind();
	bench.start();
	bench.wait();
	bench.core.hung = true;
	bench.send(bench.job(200, 0));
	bench.out.resize(bench.out.size() - 100);
	bench.send_sync(0x1234);
	bench.drain();
	bench.reset_port();
	bench.write(GLOSS_REG_NONCE, 0x1234);
	bench.clock(1000);
	bench.start();
	check_works(bench);
}

/*
 * Resets after so many clocks of work, and checks that the port works again. What was not sent by then
 * comes before the next sync, or not at all.
 */
static uint64_t reset_after(UsbBench &bench, uint32_t count)
{
	uint64_t took;

	bench.clock(count);
	if (bench.random.chance(50))
		bench.drop_out();
	took = bench.reset_port();
	check_reset(bench);
	bench.start();
	check_works(bench);
	return took;
}

/* Something of everything, from the sync to a lost channel. False: it was over before it was reset. */
static bool reset_at(UsbBench &bench, uint32_t clock, uint64_t &longest)
{
	UsbJob empty = bench.job(0, 0);
	bool over;

	bench.kind();
	bench.start();
	bench.events_closed = bench.random.chance(50);
	bench.send(bench.job(23, 260));
	empty.slots.clear();
	bench.send(empty);
	bench.send(bench.job(9, 10));
	bench.out.push_back(0);
	bench.clock(clock);
	over = bench.out.empty() && bench.expected.empty();
	longest = std::max(longest, reset_after(bench, over ? 5 : 0));
	return !over;
}

static void reset_at_each_clock(UsbBench &bench)
{
	uint64_t longest = 0;
	uint32_t clock = 0;

	while (reset_at(bench, clock, longest))
		clock++;
	printf("  a reset at each of %u clocks, the longest took %" PRIu64 "\n", clock, longest);
	TB_CHECK(clock > 400, "all was over after %u clocks", clock);
}

static void reset_at_any_time(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		bench.unkind();
		bench.start();
		bench.in_closed = bench.random.chance(20);
		bench.events_closed = bench.random.chance(20);
		for (int n = bench.random.between(1, 4); n > 0; n--)
			bench.send(bench.random_job());
		if (bench.random.chance(20))
			bench.out.push_back(0);
		reset_after(bench, bench.random.below(bench.random.chance(50) ? 300 : 6000));
	}
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
	const int jobs = 20, own = 4 + 16 + 4;
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
	check_counters(bench);
}

int main(int argc, char **argv)
{
	static UsbBench bench(tb_seed());
	int rounds = argc > 1 ? atoi(argv[1]) : 20;

	registers_are_as_the_manual_says(bench);
	a_sync_is_found_in_any_words(bench, 10 * rounds);
	a_reset_forgets_half_a_sync(bench);
	jobs_of_all_lengths_with_all_stalls(bench, rounds);
	chunks_end_at_each_border(bench);
	a_full_chunk_does_not_wait(bench);
	registers_go_before_completions(bench);
	a_torn_job_waits_for_its_rest(bench, 4 * rounds);
	a_word_no_job_begins_with_loses_the_channel(bench, 3 * rounds);
	four_events_wait(bench);
	a_fault_does_not_wait_for_in(bench);
	an_answer_nobody_takes_stops_out(bench);
	a_reset_empties_the_fifo(bench);
	reset_at_each_clock(bench);
	reset_at_any_time(bench, 5 * rounds);
	out_comes_a_word_a_clock(bench);
	in_leaves_a_word_a_clock(bench);
	an_empty_job_takes_few_clocks(bench);
	the_next_job_waits_in_the_fifo(bench);
	printf("tb_port_usb: K %d, S %d passed, %" PRIu64 " clocks\n", LANES, STREAM, bench.clocks);
	return 0;
}
