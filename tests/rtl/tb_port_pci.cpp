// SPDX-License-Identifier: MIT
/*
 * port_pci as a driver sees it: registers, jobs, interrupts, and how long they take. What may go
 * wrong at a host is in tb_port_pci_faults.cpp.
 */
#include "port_bench.h"

static const uint32_t done = GLOSS_REG_INTERRUPT_STATUS_DONE;
static const uint32_t fault = GLOSS_REG_INTERRUPT_STATUS_FAULT;

static void registers_are_as_the_manual_says(PortBench &bench)
{
	static const struct {
		uint32_t offset, kept, start;
	} registers[] = {
		{ GLOSS_REG_IDENTITY, 0, GLOSS_IDENTITY },
		{ GLOSS_REG_VERSION, 0, GLOSS_VERSION },
		{ GLOSS_REG_CAPABILITIES, 0, GLOSS_RING_MAX_LOG2 << 16 | LANES << 8 | TILE },
		{ GLOSS_REG_MEMORY_PAGES, 0, 0x12345 },
		{ GLOSS_REG_STATUS, 0, GLOSS_REG_STATUS_IDLE },
		{ GLOSS_REG_INTERRUPT_STATUS, 0, 0 },
		{ GLOSS_REG_INTERRUPT_MASK, 7, 0 },
		{ GLOSS_REG_RING_LOW, ~0u, 0 },
		{ GLOSS_REG_RING_HIGH, ~0u, 0 },
		{ GLOSS_REG_RING_LOG2, 15, 0 },
		{ GLOSS_REG_HEAD, 0, 0 },
		{ GLOSS_REG_TAIL, 0xffff, 0 },
		{ GLOSS_REG_COMPLETION_LOW, ~0u, 0 },
		{ GLOSS_REG_COMPLETION_HIGH, ~0u, 0 },
		{ GLOSS_REG_FAULT_CAUSE, 0, 0 },
		{ GLOSS_REG_FAULT_OFFSET, 0, 0 },
		{ GLOSS_REG_FAULT_SEQUENCE, 0, 0 },
		{ GLOSS_REG_DMA_ERROR_LOW, 0, 0 },
		{ GLOSS_REG_DMA_ERROR_HIGH, 0, 0 },
		{ GLOSS_REG_PROGRESS, 0, 0 },
		{ 0x05c, 0, 0 },
		{ GLOSS_REG_JOBS, 0, 0 },
		{ GLOSS_REG_STALL_RESPONSE, 0, 0 },
		{ 0x080, 0, 0 },
		{ 0x100 + GLOSS_REG_TAIL, 0, 0 },
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
			TB_CHECK(bench.read(reg.offset) == value || reg.offset == GLOSS_REG_STATUS,
				 "register %x reads %08x, not %08x", reg.offset, bench.read(reg.offset), value);
		}
		bench.reset_port();
	}
}

/* Rings of all sizes, wrapped; each job is checked when its message is sent. */
static void jobs_of_all_lengths_with_all_stalls(PortBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		if (bench.random.chance(80))
			bench.unkind();
		else
			bench.kind();
		bench.start(bench.random.below(round % 8 ? 4 : 16), done);
		for (int count = bench.random.between(1, 12); count > 0; count--) {
			while (bench.full())
				bench.clock();
			bench.prepare(bench.random_job());
			if (bench.full() || bench.random.chance(60))
				bench.doorbell();
			for (int n = bench.random.chance(50) ? bench.random.below(500) : 0; n > 0; n--)
				bench.clock();
		}
		bench.doorbell();
		bench.wait();
		bench.check_counters();
	}
}

/* HEAD and TAIL go over 2^16. */
static void counts_wrap(PortBench &bench)
{
	bench.kind(1);
	bench.start(1, done);
	for (int n = 0; n < 65536 + 3; n++) {
		while (bench.full())
			bench.clock();
		if (n < 2) {
			PortJob job = bench.job(0, 0);

			job.room = 0;
			bench.prepare(job);
		} else {
			bench.repeat();
		}
		bench.doorbell();
	}
	bench.wait();
	bench.check_counters();
}

/* While a job runs all of the next one is here; then it starts at once. */
static void the_next_job_is_read_ahead(PortBench &bench)
{
	uint64_t accesses, started;

	bench.kind(64);
	bench.start(3, done);
	bench.core.hung = true;
	bench.submit(bench.job(100, 0));
	bench.submit(bench.job(5000, 10));
	for (int n = 0; n < 1000; n++)
		bench.clock();
	TB_CHECK(bench.core.running, "no job started");
	TB_CHECK(bench.read(GLOSS_REG_STATUS) == GLOSS_REG_STATUS_RUNNING, "not running");
	accesses = bench.host.accesses;
	for (int n = 0; n < 1000; n++)
		bench.clock();
	TB_CHECK(bench.host.accesses == accesses, "DMA goes on while nothing moves");
	bench.core.hung = false;
	while (bench.jobs.size() == 2)
		bench.clock();
	started = bench.core.jobs;
	for (int n = 0; bench.core.jobs == started; n++) {
		TB_CHECK(n < 30, "the next job takes %d clocks to start", n);
		bench.clock();
	}
	bench.wait();
}

/* With enable 0 nothing starts, not even what was read ahead; what runs ends. */
static void a_disabled_board_ends_what_it_runs(PortBench &bench)
{
	for (int round = 0; round < 10; round++) {
		bench.unkind();
		bench.start(3, done);
		for (int n = 0; n < 6; n++)
			bench.submit(bench.random_job());
		for (int n = bench.random.below(3000); n > 0; n--)
			bench.clock();
		bench.write(GLOSS_REG_CONTROL, 0);
		while (!(bench.read(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_IDLE))
			;
		uint64_t jobs = bench.core.jobs, accesses = bench.host.accesses;

		for (int n = 0; n < 500; n++)
			bench.clock();
		TB_CHECK(!bench.core.running && bench.core.jobs == jobs &&
			 bench.host.accesses == accesses && bench.host.idle(), "idle, but at work");
		TB_CHECK(bench.read(GLOSS_REG_HEAD) == bench.head, "HEAD of an idle board");
		bench.write(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
		bench.wait();
		bench.check_counters();
	}
}

/* One message a job whose event has its mask bit, whether or not anything was cleared. */
static void interrupts_follow_mask_and_status(PortBench &bench)
{
	for (uint32_t mask = 0; mask < 8; mask++) {
		for (int faulty = 0; faulty < 2; faulty++) {
			uint32_t status = faulty ? done | fault : done;

			bench.kind();
			bench.start(2, mask);
			for (int n = 1; n <= 3; n++) {
				PortJob job = bench.job(10, 2);
				uint64_t messages = bench.messages;

				job.answer.cause = faulty ? 5 : 0;
				bench.submit(job);
				while (bench.read(GLOSS_REG_HEAD) != (uint32_t)n)
					;
				TB_CHECK(bench.messages - messages == ((status & mask) != 0),
					 "%" PRIu64 " messages with mask %u", bench.messages - messages, mask);
				TB_CHECK(bench.read(GLOSS_REG_INTERRUPT_STATUS) == status, "status");
				TB_CHECK(bench.top.irq_o == ((status & mask) != 0), "level");
				TB_CHECK(bench.read(GLOSS_REG_FAULT_CAUSE) == job.answer.cause, "cause");
				if (faulty)
					TB_CHECK(bench.read(GLOSS_REG_FAULT_OFFSET) == job.answer.offset &&
						 bench.read(GLOSS_REG_FAULT_SEQUENCE) == job.sequence, "fault");
			}
			bench.write(GLOSS_REG_INTERRUPT_MASK, ~mask);
			TB_CHECK(bench.top.irq_o == ((status & ~mask) != 0), "level of another mask");
			bench.write(GLOSS_REG_INTERRUPT_STATUS, done);
			TB_CHECK(bench.read(GLOSS_REG_INTERRUPT_STATUS) == (status & ~done), "not cleared");
			bench.write(GLOSS_REG_INTERRUPT_STATUS, 7);
			TB_CHECK(!bench.top.irq_o && !bench.read(GLOSS_REG_INTERRUPT_STATUS), "not cleared");
		}
	}
}

/* Cleared in the very clock it happens, an event is not lost: its bit stays until it is cleared again. */
static void an_event_goes_before_its_clearing(PortBench &bench)
{
	int together = 0;

	bench.start(2, done);
	for (int n = 0; n < 40; n++) {
		uint64_t messages = bench.messages;

		bench.kind(bench.random.between(5, 20));
		bench.submit(bench.job(1, 0));
		while (bench.messages == messages) {
			bench.write(GLOSS_REG_INTERRUPT_STATUS, done);
			bench.clock();
		}
		/* The message is sent a clock after the event. */
		if (bench.message_clock != bench.access_clock + 1)
			continue;
		TB_CHECK(bench.read(GLOSS_REG_INTERRUPT_STATUS) & done, "an event is lost");
		together++;
	}
	TB_CHECK(together > 0, "no event met its clearing");
}

/*
 * A message that its bridge has not taken waits, and is for what happens meanwhile, too. What happens
 * in the very clock in which it is taken has a message of its own.
 */
static void a_message_waits_for_its_bridge(PortBench &bench)
{
	int together = 0, span = 0;

	for (int n = 0; n < 70; n++) {
		uint64_t messages, start;

		bench.kind(5);
		bench.start(2, done);
		messages = bench.messages;
		bench.bridge_waits = true;
		bench.submit(bench.job(1, 0));
		while (!bench.top.irq_o)
			bench.clock();
		bench.write(GLOSS_REG_INTERRUPT_STATUS, done);
		TB_CHECK(!bench.top.irq_o && bench.top.msi_valid_o, "a message does not wait");

		bench.submit(bench.job(1, 0));
		start = bench.clocks;
		for (int wait = span - 3 + n % 7; n && wait > 0 && !bench.top.irq_o; wait--)
			bench.clock();
		if (n && !bench.top.irq_o) {
			bench.bridge_waits = false;
			bench.clock();
			bench.bridge_waits = true;
			together += bench.top.irq_o;
		}
		while (!bench.top.irq_o)
			bench.clock();
		if (!n)
			span = bench.clocks - start;
		TB_CHECK(bench.top.msi_valid_o, "no message of the second job");

		bench.message_jobs = bench.jobs.size();
		bench.bridge_waits = false;
		bench.clock();
		bench.message_jobs = 1;
		for (int after = 0; after < 50; after++)
			bench.clock();
		TB_CHECK(bench.jobs.empty() && bench.messages - messages <= 2 && !bench.top.msi_valid_o,
			 "%" PRIu64 " messages of two jobs", bench.messages - messages);
	}
	TB_CHECK(together > 0, "no job ended as the message of another was taken");
}

static void a_stream_comes_at_full_width(PortBench &bench)
{
	const uint32_t words = 20000, beats = words / (STREAM / 32);

	for (int latency : { 64, 128 }) {
		uint64_t start;
		double share;

		bench.kind(latency);
		bench.start(0, done);
		bench.prepare(bench.job(words, 0));
		bench.doorbell();
		while (!bench.core.running)
			bench.clock();
		start = bench.clocks;
		bench.wait();
		share = (double)beats / (bench.clocks - start - 2 * latency);
		printf("  stream, host latency %d: %.3f beats of %d bits a clock\n", latency, share, STREAM);
		TB_CHECK(share > 0.97, "a stream of %u beats took %" PRIu64 " clocks", beats,
			 bench.clocks - start);
	}
}

static void a_response_goes_at_most_of_the_width(PortBench &bench)
{
	const uint32_t words = 20000, beats = words / (STREAM / 32);
	uint64_t start;
	double share;

	bench.kind(64);
	bench.start(0, done);
	bench.prepare(bench.job(0, words));
	bench.doorbell();
	while (!bench.core.running)
		bench.clock();
	start = bench.clocks;
	bench.wait();
	share = (double)beats / (bench.clocks - start - 3 * 64);
	printf("  response, host latency 64: %.3f beats of %d bits a clock\n", share, STREAM);
	TB_CHECK(share > 0.8, "a response of %u beats took %" PRIu64 " clocks", beats, bench.clocks - start);
}

/*
 * An empty job waits for the host three times: descriptor, slot table, completion; one with a short
 * stream four times. Besides there are the beats it reads, the 16 slots to copy, and little else.
 */
static void an_empty_job_takes_few_clocks(PortBench &bench)
{
	static const int latency = 64, beats = (64 + 256) * 8 / STREAM, slots = 16;

	for (int words : { 0, 1 }) {
		int trips = words ? 4 : 3, own;
		uint64_t start;

		bench.kind(latency);
		bench.start(0, done);
		bench.prepare(bench.job(words, 0));
		start = bench.clocks;
		bench.doorbell();
		bench.wait();
		own = bench.message_clock - start - trips * latency;
		printf("  a job of %d words: %d times the host's latency and %d clocks\n", words, trips, own);
		TB_CHECK(own < beats + slots + 24, "an empty job takes %d clocks of its own", own);
	}
}

int main(int argc, char **argv)
{
	static PortBench bench(tb_seed());
	int rounds = argc > 1 ? atoi(argv[1]) : 20;

	registers_are_as_the_manual_says(bench);
	jobs_of_all_lengths_with_all_stalls(bench, rounds);
	the_next_job_is_read_ahead(bench);
	a_disabled_board_ends_what_it_runs(bench);
	interrupts_follow_mask_and_status(bench);
	an_event_goes_before_its_clearing(bench);
	a_message_waits_for_its_bridge(bench);
	port_pci_faults(bench, rounds);
	a_stream_comes_at_full_width(bench);
	a_response_goes_at_most_of_the_width(bench);
	an_empty_job_takes_few_clocks(bench);
	if (LANES == 8)
		counts_wrap(bench);
	printf("tb_port_pci: K %d, S %d passed, %" PRIu64 " clocks\n", LANES, STREAM, bench.clocks);
	return 0;
}
