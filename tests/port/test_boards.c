// SPDX-License-Identifier: MIT
/*
 * Two boards behind board.h, on two hosts that are the same: after the same random jobs,
 * valid, damaged and with too little room, all registers, all of host memory and all of
 * board memory are the same too. So they are when the host refuses an address, as far as
 * rtl/gloss.xml says, and after a reset in the middle of anything.
 *
 * test_boards [-n ROUNDS] PLUGIN: the board of the plugin and that of the C model
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pci_jobs.h"

#define BATCHES 3

static const char *const kind_names[KINDS] = { "plain",   "late",  "paused", "poisoned",
					       "refused", "reset", "wild" };

/* ---- comparing ---- */

static bool comparable(uint32_t offset, bool stopped)
{
	if (offset == GLOSS_REG_CAPABILITIES ||
	    (offset >= GLOSS_REG_CLOCKS_LOW && offset <= GLOSS_REG_STALL_RESPONSE))
		return false;
	return !stopped || offset != GLOSS_REG_PROGRESS;
}

static int compare_registers(struct pci_test *test, bool stopped)
{
	for (uint32_t offset = 0; offset <= 0x100; offset += 4) {
		uint32_t model = port_host_read(&test->host[0], offset);
		uint32_t other = port_host_read(&test->host[1], offset);

		/* A list's entry may be read with the one beside it. */
		if (stopped && offset == GLOSS_REG_DMA_ERROR_LOW) {
			model &= ~15u;
			other &= ~15u;
		}
		if (model != other && comparable(offset, stopped))
			return differ(test, "register 0x%03x is 0x%08x, the model's 0x%08x", offset,
				      other, model);
	}
	if (test->host[0].events != test->host[1].events)
		return differ(test, "%u messages, the model's %u", test->host[1].events,
			      test->host[0].events);
	if (test->host[0].level != test->host[1].level)
		return differ(test, "INTx is %d, the model's %d", test->host[1].level,
			      test->host[0].level);
	return 0;
}

static int compare_host(const struct pci_test *test)
{
	return pair_compare_bytes(&test->pair, "host memory", test->host[0].memory,
				  test->host[1].memory, PORT_HOST_BYTES);
}

/* Makes what the boards may have left different the same. */
static void forgive_host(struct pci_test *test, uint64_t address, uint32_t bytes)
{
	uint64_t at = address - PORT_HOST_BASE;

	memcpy(test->host[1].memory + at, test->host[0].memory + at, bytes);
}

static void forgive_response(struct pci_test *test, const struct gloss_job_descriptor *d)
{
	uint64_t list = (uint64_t)d->response_list_high << 32 | (d->response_list_low & ~7u);

	for (uint64_t word = 0; word < d->response_words; word += PAGE_WORDS)
		forgive_host(test, port_host_word(&test->host[0], list, (uint32_t)word),
			     GLOSS_PAGE_BYTES);
}

/* ---- what is to be the same then ---- */

/* A stopped board says so, and asked for nothing but what its job has. */
static int check_stopped(struct pci_test *test, struct port_host *host)
{
	uint32_t n = port_host_read(host, GLOSS_REG_HEAD) - (test->first & 0xffff);
	uint32_t sequence = port_host_read(host, GLOSS_REG_FAULT_SEQUENCE);
	uint64_t address = (uint64_t)port_host_read(host, GLOSS_REG_DMA_ERROR_HIGH) << 32 |
			   port_host_read(host, GLOSS_REG_DMA_ERROR_LOW);
	bool descriptor = address == pci_jobs_entry(test, host->ring, 64, n);

	if (n >= test->jobs)
		return differ(test, "HEAD is %u, beyond the jobs", test->first + n);
	if (address - PORT_HOST_BASE >= PORT_HOST_BYTES)
		return differ(test, "the error is at 0x%" PRIx64 ", which no job has", address);
	if (sequence != (descriptor ? 0 : test->job[n].sequence))
		return differ(test, "the error is of the job 0x%08x, not 0x%08x", sequence,
			      test->job[n].sequence);
	if (port_host_read(host, GLOSS_REG_FAULT_CAUSE) != GLOSS_FAULT_DMA ||
	    port_host_read(host, GLOSS_REG_FAULT_OFFSET) ||
	    !(port_host_read(host, GLOSS_REG_INTERRUPT_STATUS) & GLOSS_REG_INTERRUPT_STATUS_DMA))
		return differ(test, "the board stopped and does not say why");
	test->errors++;
	return 0;
}

static bool is_stopped(struct port_host *host)
{
	return port_host_read(host, GLOSS_REG_STATUS) & GLOSS_REG_STATUS_DMA_ERROR;
}

static int reset(struct pci_test *test)
{
	for (uint32_t side = 0; side < 2; side++) {
		if (!port_host_reset(&test->host[side]))
			return differ(test, "board %u does not end its reset", side);
		test->host[side].events = 0;
	}
	test->started = false;
	return compare_registers(test, false);
}

/* Memory is compared after the reset, because until then a board may write. */

/* Both boards met the same address, in the same job. */
static int check_poisoned(struct pci_test *test)
{
	uint32_t n = port_host_read(&test->host[0], GLOSS_REG_HEAD) - (test->first & 0xffff);

	if (compare_registers(test, true) || check_stopped(test, &test->host[0]) || reset(test))
		return 1;
	forgive_response(test, &test->job[n]);
	pair_forgive_slots(&test->pair, test->slot[n]);
	return compare_host(test) || pair_compare_memory(&test->pair);
}

/* Each board was torn away from the batch at another job; both had ended @ended of them. */
static int check_torn(struct pci_test *test, uint32_t ended)
{
	if (reset(test))
		return 1;
	for (uint32_t n = ended; n < test->jobs; n++) {
		forgive_response(test, &test->made[n]);
		forgive_host(test, pci_jobs_entry(test, test->host[0].completion, 16, n), 16);
	}
	memcpy(test->pair.memory[1], test->pair.memory[0], STREAM_RANDOM_MEMORY);
	return compare_host(test);
}

/* What becomes of a wild job is not compared: the boards end it, and go on after a reset. */
static int check_refused(struct pci_test *test, enum kind kind)
{
	uint32_t least = kind == WILD ? test->jobs - 1 : test->jobs;

	for (uint32_t side = 0; side < 2; side++) {
		struct port_host *host = &test->host[side];
		uint32_t ended = (port_host_read(host, GLOSS_REG_HEAD) - test->first) & 0xffff;

		if (kind == REFUSED && is_stopped(host) && check_stopped(test, host))
			return 1;
		least = ended < least ? ended : least;
	}
	return check_torn(test, least);
}

static int check(struct pci_test *test, enum kind kind)
{
	bool stopped = is_stopped(&test->host[0]) || is_stopped(&test->host[1]);

	if (kind == RESET)
		return check_torn(test, 0);
	if (kind == WILD || (kind == REFUSED && stopped))
		return check_refused(test, kind);
	if (stopped)
		return check_poisoned(test);
	if (compare_registers(test, false) || compare_host(test) ||
	    pair_compare_memory(&test->pair))
		return 1;
	test->ended += test->jobs;
	test->first += test->jobs;
	if (below(test, 2))
		for (uint32_t side = 0; side < 2; side++)
			port_host_write(&test->host[side], GLOSS_REG_INTERRUPT_STATUS, 7);
	return 0;
}

static int run_batch(struct pci_test *test)
{
	enum kind kind = below(test, 2) ? PLAIN : (enum kind)below(test, KINDS);

	test->batches[kind]++;
	pci_jobs_make(test, kind);
	pci_jobs_arm(test, kind);
	return pci_jobs_run(test, kind, 0) || pci_jobs_run(test, kind, 1) || check(test, kind);
}

static int run_round(struct pair *pair)
{
	struct pci_test *test = (struct pci_test *)pair;
	int failed = 0;

	test->started = false;
	for (uint32_t side = 0; side < 2; side++) {
		if (!port_host_init(&test->host[side], test->ops[side], pair->memory[side],
				    STREAM_RANDOM_MEMORY, pair->seed)) {
			fprintf(stderr, "test_boards: out of memory\n");
			exit(1);
		}
	}
	for (uint32_t batch = 0; batch < BATCHES && !failed; batch++)
		failed = run_batch(test);
	for (uint32_t side = 0; side < 2; side++)
		port_host_fini(&test->host[side]);
	return failed;
}

/* Boards of one thread may end in any order; a plugin that can not do that crashes here. */
static void end_in_any_order(struct pair *pair, const struct gloss_board_ops *ops)
{
	static const struct gloss_board_host nobody;
	struct gloss_board *board[2];

	for (uint32_t first = 0; first < 2; first++) {
		for (uint32_t n = 0; n < 2; n++)
			board[n] = ops->create(&nobody, pair->memory[n], STREAM_RANDOM_MEMORY);
		for (uint32_t n = 0; n < 2; n++)
			if (board[n ^ first])
				ops->destroy(board[n ^ first]);
	}
}

static bool load(struct pair *pair, const void *symbol)
{
	struct pci_test *test = (struct pci_test *)pair;
	const struct gloss_board_ops *ops = symbol;

	test->ops[1] = ops;
	test->ops[0] = ops->tile_size == 32 ? &gloss_board_model_t32 : &gloss_board_model_t64;
	if (ops->abi != GLOSS_BOARD_ABI || ops->version != GLOSS_VERSION)
		return false;
	end_in_any_order(pair, ops);
	return true;
}

static void report(const struct pair *pair, uint64_t rounds)
{
	const struct pci_test *test = (const struct pci_test *)pair;

	printf("test_boards: T=%u K=%u: %" PRIu64 " rounds, %" PRIu64 " jobs compared, %" PRIu64
	       " DMA errors; batches",
	       test->ops[1]->tile_size, test->ops[1]->pixels_per_clock, rounds, test->ended,
	       test->errors);
	for (int n = 0; n < KINDS; n++)
		printf(" %s %" PRIu64, kind_names[n], test->batches[n]);
	printf("\n");
}

int main(int argc, char **argv)
{
	static const struct pair_test boards = {
		.program = "test_boards",
		.symbol = GLOSS_BOARD_SYMBOL,
		.load = load,
		.round = run_round,
		.report = report,
	};
	static struct pci_test test;

	return pair_main(&test.pair, &boards, argc, argv);
}
