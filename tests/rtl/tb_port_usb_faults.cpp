// SPDX-License-Identifier: MIT
/* port_usb when a host stops or goes wrong, does not read, or resets it. */
#include "port_usb_bench.h"

static const uint32_t idle = GLOSS_REG_STATUS_IDLE;
static const uint32_t running = GLOSS_REG_STATUS_RUNNING;
static const uint32_t lost = GLOSS_REG_STATUS_LOST;

/* A host that stops within a job is waited for, wherever it does. */
static void a_torn_job_waits_for_its_rest(UsbBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		UsbJob job = bench.job(bench.random.below(40), bench.random.below(300));
		size_t head = 4 + 4 * job.slots.size(), words = head + job.stream.size(), cut;
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
		bench.wait();
		bench.drain();
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == (idle | lost), "STATUS");
		TB_CHECK(bench.events.size() == 1 &&
			 bench.events[0] == (GLOSS_USB_EVENT_MAGIC << 16 | GLOSS_USB_EVENT_LOST), "events");
		bench.start();
		bench.check_works();
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
			bench.out.push_back(0);
		reset_after(bench, bench.random.below(bench.random.chance(50) ? 300 : 6000));
	}
}

void port_usb_faults(UsbBench &bench, int rounds)
{
	a_torn_job_waits_for_its_rest(bench, 4 * rounds);
	a_word_no_job_begins_with_loses_the_channel(bench, 3 * rounds);
	four_events_wait(bench);
	a_fault_does_not_wait_for_in(bench);
	an_answer_nobody_takes_stops_out(bench);
	a_reset_empties_the_fifo(bench);
	reset_at_each_clock(bench);
	reset_at_any_time(bench, 5 * rounds);
}
