// SPDX-License-Identifier: MIT
/*
 * port_pci as a driver sees it: registers, jobs, interrupts, and what may go wrong at a host.
 */
#include "port_bench.h"

static const uint32_t done = GLOSS_REG_INTERRUPT_STATUS_DONE;
static const uint32_t fault = GLOSS_REG_INTERRUPT_STATUS_FAULT;
static const uint32_t dma = GLOSS_REG_INTERRUPT_STATUS_DMA;

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

static void check_counters(PortBench &bench)
{
	static const uint32_t stalls[] = { GLOSS_REG_STALL_STREAM, GLOSS_REG_STALL_RASTER,
					   GLOSS_REG_STALL_TILE, GLOSS_REG_STALL_MEMORY,
					   GLOSS_REG_STALL_RESPONSE };
	uint64_t sum;

	TB_CHECK(bench.read(GLOSS_REG_HEAD) == (bench.tail & 0xffff), "HEAD");
	TB_CHECK(bench.read(GLOSS_REG_JOBS) == bench.finished, "JOBS");
	TB_CHECK(bench.read(GLOSS_REG_PROGRESS) == bench.progress, "PROGRESS");
	sum = bench.read(GLOSS_REG_CLOCKS_LOW) | (uint64_t)bench.read(GLOSS_REG_CLOCKS_HIGH) << 32;
	TB_CHECK(sum == bench.time[0], "CLOCKS is %" PRIx64, sum);
	for (int n = 0; n < 5; n++)
		TB_CHECK(bench.read(stalls[n]) == (uint32_t)bench.time[1 + n], "stall counter %d", n);
	TB_CHECK(bench.read(GLOSS_REG_STATUS) == GLOSS_REG_STATUS_IDLE, "not idle when all is done");
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
		check_counters(bench);
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
	check_counters(bench);
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
		check_counters(bench);
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

/* After a DMA error: what the registers say of the job that was next to end, and that all is still. */
static void check_error(PortBench &bench, const std::deque<PortJob> &jobs, uint32_t ended)
{
	uint64_t address, accesses;
	uint32_t sequence = bench.read(GLOSS_REG_FAULT_SEQUENCE), events;

	address = bench.read(GLOSS_REG_DMA_ERROR_LOW) | (uint64_t)bench.read(GLOSS_REG_DMA_ERROR_HIGH) << 32;
	if (address - bench.ring < 64 * 4)
		TB_CHECK(sequence == 0 && address == bench.ring + 64 * ended, "a descriptor, sequence %x", sequence);
	else
		TB_CHECK(sequence == jobs[ended].sequence && (jobs[ended].owns(address) ||
							      address == bench.records + 16 * ended),
			 "%" PRIx64 " is not of job %u, or %x is not its sequence", address, ended, sequence);
	TB_CHECK(bench.host.refusals.count(address), "%" PRIx64 " was not refused", address);
	TB_CHECK(bench.read(GLOSS_REG_FAULT_CAUSE) == GLOSS_FAULT_DMA, "FAULT_CAUSE");
	TB_CHECK(bench.read(GLOSS_REG_FAULT_OFFSET) == 0, "FAULT_OFFSET");
	events = bench.read(GLOSS_REG_INTERRUPT_STATUS);
	TB_CHECK((events & ~fault) == (ended ? done | dma : dma), "INTERRUPT_STATUS %u", events);
	TB_CHECK(bench.host.idle(), "told, but DMA is under way");
	accesses = bench.host.accesses;
	for (int n = 0; n < 200; n++)
		bench.clock();
	TB_CHECK(bench.host.accesses == accesses && bench.read(GLOSS_REG_HEAD) == ended, "not stopped");
}

/* Three jobs, one access of theirs refused, or all from one on: jobs before it end well. False: there were not so many. */
static bool refuse_access(PortBench &bench, int access)
{
	std::deque<PortJob> jobs;
	uint64_t messages, started;
	uint32_t ended;

	bench.start(2, done | dma);
	for (int n = 0; n < 3; n++)
		bench.prepare(bench.job(n ? bench.random.below(3000) : 10, bench.random.below(2) * 1100));
	jobs = bench.jobs;
	bench.host.refuse = access;
	bench.host.refuse_rest = bench.random.chance(50);
	messages = bench.messages;
	started = bench.core.jobs;
	bench.doorbell();
	while (!bench.jobs.empty() && bench.host.refusals.empty())
		bench.clock();
	if (bench.host.refusals.empty())
		return false;
	bench.wait_error();
	ended = bench.read(GLOSS_REG_HEAD);
	TB_CHECK(ended < 3 && bench.messages - messages == ended + 1, "HEAD %u, %" PRIu64 " messages", ended,
		 bench.messages - messages);
	for (uint32_t n = 0; n < 3; n++)
		TB_CHECK((bench.host.word(bench.records + 16 * n) == jobs[n].sequence) == (n < ended),
			 "completion of job %u, %u have ended", n, ended);
	if (bench.host.refusals.count(bench.ring + 64 * ended) || bench.host.refusals.count(jobs[ended].table))
		TB_CHECK(bench.core.jobs - started == ended, "a job starts of which not all was read");
	check_error(bench, jobs, ended);
	return true;
}

static void any_access_may_be_refused(PortBench &bench)
{
	int refused = 0;

	for (int access = 0; ; access += access < 60 ? bench.random.below(2) : bench.random.between(1, 10)) {
		if (bench.random.chance(50))
			bench.unkind();
		else
			bench.kind();
		if (refuse_access(bench, access))
			refused++;
		else if (access > 60)
			break;
	}
	TB_CHECK(refused > 60, "only %d accesses were refused", refused);
}

/* Whatever the port does, a reset ends it, and it works again. */
static void reset_at_any_time(PortBench &bench, int rounds)
{
	uint64_t longest = 0;

	for (int round = 0; round < rounds; round++) {
		bench.unkind();
		bench.start(3, done);
		for (int n = bench.random.between(1, 4); n > 0; n--)
			bench.prepare(bench.random_job());
		bench.doorbell();
		for (int n = bench.random.below(bench.random.chance(50) ? 300 : 6000); n > 0; n--)
			bench.clock();
		longest = std::max(longest, bench.reset_port());
		TB_CHECK(bench.read(GLOSS_REG_STATUS) == GLOSS_REG_STATUS_IDLE &&
			 bench.read(GLOSS_REG_HEAD) == 0 && bench.read(GLOSS_REG_TAIL) == 0 &&
			 bench.read(GLOSS_REG_PROGRESS) == 0 && !bench.top.irq_o, "not as after power-on");
		bench.start(3, done);
		bench.submit(bench.random_job());
		bench.wait();
		check_counters(bench);
	}
	printf("  the longest reset took %" PRIu64 " clocks\n", longest);
}

/* Random descriptors, lists of nothing, a TAIL far ahead: the port may stop, but reset brings it back. */
static void insane_descriptors(PortBench &bench, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		uint64_t somewhere;

		bench.unkind();
		bench.start(bench.random.below(3), 0);
		bench.host.strict = false;
		somewhere = bench.place(4096, 4096);
		for (uint32_t n = 0; n < 16 * bench.entries; n++) {
			uint32_t &word = bench.host.word(bench.ring + 4 * n);

			word = bench.random.bits() >> bench.random.below(32);
			if (bench.random.chance(60))
				word = n % 2 ? somewhere >> 32 : (uint32_t)somewhere;
		}
		for (uint32_t n = 0; n < 1024; n++)
			if (bench.random.chance(90))
				bench.host.word(somewhere + 4 * n) = n % 2 ? somewhere >> 32 : somewhere;
		bench.tail = bench.random.bits();
		bench.doorbell();
		for (int n = bench.random.below(5000); n > 0; n--)
			bench.clock();
		bench.start(3, done);
		bench.submit(bench.random_job());
		bench.wait();
		check_counters(bench);
	}
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
	any_access_may_be_refused(bench);
	reset_at_any_time(bench, 3 * rounds);
	insane_descriptors(bench, rounds);
	a_stream_comes_at_full_width(bench);
	a_response_goes_at_most_of_the_width(bench);
	an_empty_job_takes_few_clocks(bench);
	if (LANES == 8)
		counts_wrap(bench);
	printf("tb_port_pci: K %d, S %d passed, %" PRIu64 " clocks\n", LANES, STREAM, bench.clocks);
	return 0;
}
