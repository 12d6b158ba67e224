// SPDX-License-Identifier: MIT
/* port_pci when the host refuses accesses, writes nonsense, or resets it. */
#include "port_bench.h"

static const uint32_t done = GLOSS_REG_INTERRUPT_STATUS_DONE;
static const uint32_t fault = GLOSS_REG_INTERRUPT_STATUS_FAULT;
static const uint32_t dma = GLOSS_REG_INTERRUPT_STATUS_DMA;

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
		bench.check_counters();
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
		bench.check_counters();
	}
}

void port_pci_faults(PortBench &bench, int rounds)
{
	any_access_may_be_refused(bench);
	reset_at_any_time(bench, 3 * rounds);
	insane_descriptors(bench, rounds);
}
