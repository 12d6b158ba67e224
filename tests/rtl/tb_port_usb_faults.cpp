// SPDX-License-Identifier: MIT
/* port_usb when a host stops or goes wrong, does not read, or resets it. */
#include "port_usb_bench.h"

static const uint32_t idle = GLOSS_REG_STATUS_IDLE;
static const uint32_t running = GLOSS_REG_STATUS_RUNNING;

/* A host that stops within a job is waited for, wherever it does. */
static void a_torn_job_waits_for_its_rest(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		UsbJob job = bench.job(bench.random.below(40), bench.random.below(300));
		size_t head = 4 + 4 * job.slots.size(), words = head + job.stream.size() + 1, cut;
		std::deque<uint32_t> rest;

		bench.random_stalls();
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
			bench.check_counters();
		}
	}
}

/* All but its checksum is there: all but what ends its answer is, too, and nobody knows of a fault. */
static void the_checksum_is_waited_for(UsbBench &bench)
{
	for (uint32_t words : { 0, 1, 255, 256, 257, 600 }) {
		UsbJob job = bench.job(bench.random.below(40), words);
		uint64_t taken;
		uint32_t last;

		job.answer.cause = 3;
		bench.kind();
		bench.start();
		bench.wait();
		taken = bench.taken;
		bench.send(job);
		last = bench.out.back();
		bench.out.pop_back();
		bench.drain();
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == running && bench.read(GLOSS_REG_JOBS) == 0 &&
			 bench.read(GLOSS_REG_FAULT_CAUSE) == 0 && bench.events.empty(), "it has ended");
		TB_CHECK(bench.read(GLOSS_REG_PROGRESS) == job.stream.size() + words, "PROGRESS");
		taken = bench.taken - taken;
		TB_CHECK(taken == words / GLOSS_USB_CHUNK_WORDS * (1 + GLOSS_USB_CHUNK_WORDS),
			 "%" PRIu64 " words came", taken);
		bench.out.push_back(last);
		bench.wait();
		bench.check_events({ job }, true);
		bench.check_counters();
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
		bench.random_stalls();
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
		bench.wait_lost();
		bench.start();
		bench.check_works();
	}
}

/* A job of which @words are not right: the core has had it, and that is all. */
static void check_wrong(UsbBench &bench, const UsbJob &job, const std::vector<uint32_t> &words)
{
	bench.send_wrong(job, words);
	if (bench.random.chance(50)) {
		bench.send_words(bench.random_job());
		bench.send_sync(bench.nonce);
		bench.send_words(bench.random_job());
	}
	bench.wait_lost();
	TB_CHECK(bench.read(GLOSS_REG_JOBS) == bench.finished, "it is counted");
	TB_CHECK(bench.read(GLOSS_REG_FAULT_CAUSE) == 0, "its fault is known");
	TB_CHECK(bench.read(GLOSS_REG_PROGRESS) ==
		 bench.progress + job.stream.size() + job.answer.words.size(), "it was not executed");
	bench.start();
	bench.check_works();
}

static void a_wrong_checksum_loses_the_channel(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		for (uint32_t count : { 0, 1, 255, 256, 257, 512, 600 }) {
			UsbJob job = bench.job(bench.random.below(100), count);
			std::vector<uint32_t> words = bench.words_of(job);

			bench.random_stalls();
			bench.start();
			for (int n = bench.random.below(3); n > 0; n--) {
				UsbJob before = bench.random_job();

				before.answer.cause = 0;
				bench.send(before);
			}
			words.back() ^= 1u << bench.random.below(32);
			check_wrong(bench, job, words);
		}
	}
}

/* While the core is at work the channel is not lost: STATUS.idle would be wrong. */
static void a_wrong_checksum_waits_for_the_core(UsbBench &bench)
{
	UsbJob job = bench.job(0, 300);
	std::vector<uint32_t> words = bench.words_of(job);

	words.back()++;
	bench.kind();
	bench.start();
	bench.wait();
	bench.core.hung = true;
	bench.send_wrong(job, words);
	bench.drain();
	TB_CHECK(bench.read(GLOSS_REG_STATUS) == running && bench.events.empty(), "it has ended");
	bench.core.hung = false;
	bench.wait_lost();
	bench.start();
	bench.check_works();
}

/* From response_words to the checksum; the words before those are no part of it, or say where it is. */
static void one_wrong_bit_of_any_word_is_found(UsbBench &bench)
{
	UsbJob job = bench.job(9, 3);
	std::vector<uint32_t> words;

	job.slots.resize(2);
	words = bench.words_of(job);
	for (size_t n = 3; n < words.size(); n++) {
		uint32_t bit = 1u << bench.random.below(32);

		bench.random_stalls();
		bench.start();
		words[n] ^= bit;
		check_wrong(bench, job, words);
		words[n] ^= bit;
	}
}

static void a_word_lost_repeated_or_moved_is_found(UsbBench &bench)
{
	for (size_t n = 4; n < 4 + 12; n++) {
		UsbJob job = bench.job(12, 3);

		job.slots.clear();
		for (int kind = 0; kind < 3; kind++) {
			std::vector<uint32_t> words = bench.words_of(job);

			if (kind == 0) {
				words.erase(words.begin() + n);
				words.push_back(GLOSS_USB_JOB_MAGIC << 8);
			} else if (kind == 1) {
				words.insert(words.begin() + n, words[n]);
			} else {
				std::swap(words[n - 1], words[n]);
			}
			bench.random_stalls();
			bench.start();
			check_wrong(bench, job, words);
		}
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
	bench.check_events(jobs, true);
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
		bench.check_events({ job }, true);
		TB_CHECK(bench.read(GLOSS_REG_JOBS) == 1, "JOBS");
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == running, "its core has the next job");
		bench.in_closed = false;
		bench.wait();
		bench.check_counters();
	}
}

static void an_answer_nobody_takes_stops_out(UsbBench &bench)
{
	for (int round = 0; round < 10; round++) {
		uint64_t sent;

		bench.random_stalls();
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
		bench.check_counters();
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
	bench.check_works();
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
	bench.check_works();
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
			bench.out.back() ^= 1;
		if (bench.random.chance(20))
			bench.out.push_back(0);
		reset_after(bench, bench.random.below(bench.random.chance(50) ? 300 : 6000));
	}
}

void port_usb_faults(UsbBench &bench, int rounds)
{
	a_torn_job_waits_for_its_rest(bench, 4 * rounds);
	the_checksum_is_waited_for(bench);
	a_word_no_job_begins_with_loses_the_channel(bench, 3 * rounds);
	a_wrong_checksum_loses_the_channel(bench, rounds);
	a_wrong_checksum_waits_for_the_core(bench);
	one_wrong_bit_of_any_word_is_found(bench);
	a_word_lost_repeated_or_moved_is_found(bench);
	four_events_wait(bench);
	a_fault_does_not_wait_for_in(bench);
	an_answer_nobody_takes_stops_out(bench);
	a_reset_empties_the_fifo(bench);
	reset_at_each_clock(bench);
	reset_at_any_time(bench, 5 * rounds);
}
