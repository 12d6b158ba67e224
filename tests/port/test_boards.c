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

#include "pair.h"
#include "port_host.h"

#define BATCHES 3
#define JOBS 4
#define PAGE_WORDS (GLOSS_PAGE_BYTES / 4)

/* What happens to a batch of jobs. */
enum kind {
	PLAIN,
	LATE,     /* completions are asked for again */
	PAUSED,   /* enable is taken away and given back */
	POISONED, /* an address of a job is refused */
	REFUSED,  /* some access, another one on each board */
	RESET,    /* at some time, another one on each board */
	WILD,     /* the last job is one that no driver submits */
	KINDS
};

static const char *const kind_names[KINDS] = { "plain",   "late",  "paused", "poisoned",
					       "refused", "reset", "wild" };

struct test {
	struct pair pair;                     /* first: a pair is the test */
	const struct gloss_board_ops *ops[2]; /* the model's, the plugin's */
	struct port_host host[2];
	bool started;

	struct gloss_job_descriptor job[JOBS];  /* of the batch */
	struct gloss_job_descriptor made[JOBS]; /* before they were made wild */
	struct gloss_slot slot[JOBS][GLOSS_SLOTS];
	uint32_t jobs, first; /* first: its number in HEAD's count */
	uint32_t sequence;

	uint64_t batches[KINDS], ended, errors;
};

static uint32_t below(struct test *test, uint32_t n)
{
	return pair_below(&test->pair, n);
}

#define differ(test, ...) pair_differ(&(test)->pair, __VA_ARGS__)

/* ---- comparing ---- */

static bool comparable(uint32_t offset, bool stopped)
{
	if (offset == GLOSS_REG_CAPABILITIES ||
	    (offset >= GLOSS_REG_CLOCKS_LOW && offset <= GLOSS_REG_STALL_RESPONSE))
		return false;
	return !stopped || offset != GLOSS_REG_PROGRESS;
}

static int compare_registers(struct test *test, bool stopped)
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

static int compare_host(const struct test *test)
{
	return pair_compare_bytes(&test->pair, "host memory", test->host[0].memory,
				  test->host[1].memory, PORT_HOST_BYTES);
}

/* Makes what the boards may have left different the same. */
static void forgive_host(struct test *test, uint64_t address, uint32_t bytes)
{
	uint64_t at = address - PORT_HOST_BASE;

	memcpy(test->host[1].memory + at, test->host[0].memory + at, bytes);
}

static void forgive_response(struct test *test, const struct gloss_job_descriptor *d)
{
	uint64_t list = (uint64_t)d->response_list_high << 32 | (d->response_list_low & ~7u);

	for (uint64_t word = 0; word < d->response_words; word += PAGE_WORDS)
		forgive_host(test, port_host_word(&test->host[0], list, (uint32_t)word),
			     GLOSS_PAGE_BYTES);
}

/* ---- jobs ---- */

/* Low bits that an address has no room for may be anything. */
static void dirty_list(struct test *test, uint32_t *low, uint32_t high, uint32_t words)
{
	uint64_t list = (uint64_t)high << 32 | *low;

	for (uint32_t n = 0; n < words; n += PAGE_WORDS) {
		uint32_t bits = below(test, GLOSS_PAGE_BYTES);

		for (uint32_t side = 0; side < 2; side++) {
			struct port_host *host = &test->host[side];

			port_host_set(host, list + n / PAGE_WORDS * 8,
				      port_host_get(host, list + n / PAGE_WORDS * 8) | bits);
		}
	}
	*low |= below(test, 8);
}

static void make_job(struct test *test, uint32_t n)
{
	struct stream_random *stream = &test->pair.stream;
	struct gloss_job_descriptor *d = &test->job[n];

	pair_make_job(&test->pair, test->ops[0]->tile_size);
	memcpy(test->slot[n], stream->job.slot, sizeof(test->slot[n]));
	for (uint32_t side = 0; side < 2; side++)
		*d = port_host_describe(&test->host[side], &stream->job, test->sequence);
	test->sequence += 1 + below(test, 0x10000000);
	if (below(test, 2)) {
		dirty_list(test, &d->stream_list_low, d->stream_list_high, d->stream_words);
		dirty_list(test, &d->response_list_low, d->response_list_high, d->response_words);
		d->slot_table_low |= below(test, 64);
	}
}

/* Words, addresses and slots out of all bounds. */
static void make_wild(struct test *test, struct gloss_job_descriptor *d)
{
	uint32_t words[GLOSS_JOB_DESCRIPTOR_WORDS];

	switch (below(test, 3)) {
	case 0:
		d->stream_words = ~below(test, 1000000);
		d->response_words = ~below(test, 1000000);
		break;
	case 1:
		for (uint32_t n = 0; n < GLOSS_SLOTS * GLOSS_SLOT_ENTRY_WORDS; n++) {
			uint64_t table = (uint64_t)d->slot_table_high << 32 |
					 (d->slot_table_low & ~63u);
			uint32_t word = (uint32_t)port_host_random(&test->pair.random);

			for (uint32_t side = 0; side < 2; side++)
				port_host_set(&test->host[side], table + 4 * n, word);
		}
		break;
	default:
		gloss_job_descriptor_pack(words, d);
		for (uint32_t n = 1; n < GLOSS_JOB_DESCRIPTOR_WORDS; n++)
			if (below(test, 2))
				words[n] = (uint32_t)port_host_random(&test->pair.random);
		gloss_job_descriptor_unpack(words, d);
	}
}

static void start(struct test *test)
{
	uint32_t log2 = below(test, 4) ? below(test, 4) : below(test, 16);
	uint32_t mask = below(test, 8);

	for (uint32_t side = 0; side < 2; side++)
		port_host_start(&test->host[side], log2, mask);
	test->first = 0;
	test->started = true;
}

static void make_jobs(struct test *test, enum kind kind)
{
	uint32_t most;

	if (!test->started)
		start(test);
	most = 1u << test->host[0].log2;
	test->jobs = 1 + below(test, most < JOBS ? most : JOBS);
	for (uint32_t n = 0; n < test->jobs; n++) {
		make_job(test, n);
		test->made[n] = test->job[n];
		if (kind == WILD && n == test->jobs - 1)
			make_wild(test, &test->job[n]);
		for (uint32_t side = 0; side < 2; side++)
			port_host_push(&test->host[side], &test->job[n]);
	}
}

/* ---- what happens to them ---- */

static uint64_t entry_address(const struct test *test, uint64_t array, uint32_t bytes, uint32_t n)
{
	return array + (uint64_t)bytes * ((test->first + n) & ((1u << test->host[0].log2) - 1));
}

/* An address that a job needs; 0 if it has none of that sort. */
static uint64_t pick_poison(struct test *test, uint32_t n, uint32_t *bytes)
{
	const struct gloss_job_descriptor *d = &test->job[n];
	uint64_t stream = (uint64_t)d->stream_list_high << 32 | (d->stream_list_low & ~7u);
	uint64_t response = (uint64_t)d->response_list_high << 32 | (d->response_list_low & ~7u);

	*bytes = 1;
	switch (below(test, 6)) {
	case 0:
		return entry_address(test, test->host[0].ring, 64, n);
	case 1:
		return (uint64_t)d->slot_table_high << 32 | (d->slot_table_low & ~63u);
	case 2:
		return d->stream_words ? stream + below(test, d->stream_words) / PAGE_WORDS * 8 : 0;
	case 3:
		*bytes = GLOSS_PAGE_BYTES;
		return d->stream_words ? port_host_word(&test->host[0], stream,
							below(test, d->stream_words) / PAGE_WORDS *
								PAGE_WORDS) :
					 0;
	case 4:
		*bytes = GLOSS_PAGE_BYTES;
		return d->response_words ? port_host_word(&test->host[0], response,
							  below(test, d->response_words) /
								  PAGE_WORDS * PAGE_WORDS) :
					   0;
	default:
		return entry_address(test, test->host[0].completion, 16, n);
	}
}

static void arm(struct test *test, enum kind kind)
{
	uint32_t bytes = 0, later = kind == LATE ? below(test, 20) : below(test, 2) * ~0u;
	uint64_t poison = kind == POISONED ? pick_poison(test, below(test, test->jobs), &bytes) : 0;

	for (uint32_t side = 0; side < 2; side++) {
		struct port_host *host = &test->host[side];

		host->later = kind == LATE || kind == RESET ? later : 0;
		host->accesses = 0;
		host->refuse = kind == REFUSED ? 1 + below(test, 200 * test->jobs) : 0;
		host->poison = poison;
		host->poison_bytes = poison ? bytes : 0;
	}
}

static void work_some(struct test *test, struct port_host *host, uint32_t most)
{
	for (uint32_t n = below(test, most + 1); n; n--)
		host->ops->work(host->board);
}

/* All at once, or one after the other while the board is at work. */
static void doorbell(struct test *test, struct port_host *host)
{
	uint32_t tail = host->tail - test->jobs;

	while (below(test, 2) && tail != host->tail) {
		port_host_write(host, GLOSS_REG_TAIL, ++tail);
		work_some(test, host, 2);
	}
	port_host_ring(host);
}

static int pause_board(struct test *test, struct port_host *host)
{
	uint32_t head;

	work_some(test, host, 5);
	port_host_write(host, GLOSS_REG_CONTROL, 0);
	head = port_host_read(host, GLOSS_REG_HEAD);
	if (!port_host_work(host))
		return differ(test, "a board does not end its job with enable 0");
	head = (port_host_read(host, GLOSS_REG_HEAD) - head) & 0xffff;
	if (head > 1)
		return differ(test, "a board ends %u jobs with enable 0", head);
	if (port_host_read(host, GLOSS_REG_STATUS) != GLOSS_REG_STATUS_IDLE)
		return differ(test, "a board is not idle after its job with enable 0");
	port_host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
	return 0;
}

static int run_side(struct test *test, enum kind kind, uint32_t side)
{
	struct port_host *host = &test->host[side];

	doorbell(test, host);
	if (kind == PAUSED && pause_board(test, host))
		return 1;
	if (kind == RESET)
		work_some(test, host, 20);
	else if (!port_host_work(host))
		return differ(test, "board %u does not end its jobs", side);
	return 0;
}

/* ---- what is to be the same then ---- */

/* A stopped board says so, and asked for nothing but what its job has. */
static int check_stopped(struct test *test, struct port_host *host)
{
	uint32_t n = port_host_read(host, GLOSS_REG_HEAD) - (test->first & 0xffff);
	uint32_t sequence = port_host_read(host, GLOSS_REG_FAULT_SEQUENCE);
	uint64_t address = (uint64_t)port_host_read(host, GLOSS_REG_DMA_ERROR_HIGH) << 32 |
			   port_host_read(host, GLOSS_REG_DMA_ERROR_LOW);
	bool descriptor = address == entry_address(test, host->ring, 64, n);

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

static int reset(struct test *test)
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
static int check_poisoned(struct test *test)
{
	uint32_t n = port_host_read(&test->host[0], GLOSS_REG_HEAD) - (test->first & 0xffff);

	if (compare_registers(test, true) || check_stopped(test, &test->host[0]) || reset(test))
		return 1;
	forgive_response(test, &test->job[n]);
	pair_forgive_slots(&test->pair, test->slot[n]);
	return compare_host(test) || pair_compare_memory(&test->pair);
}

/* Each board was torn away from the batch at another job; both had ended @ended of them. */
static int check_torn(struct test *test, uint32_t ended)
{
	if (reset(test))
		return 1;
	for (uint32_t n = ended; n < test->jobs; n++) {
		forgive_response(test, &test->made[n]);
		forgive_host(test, entry_address(test, test->host[0].completion, 16, n), 16);
	}
	memcpy(test->pair.memory[1], test->pair.memory[0], STREAM_RANDOM_MEMORY);
	return compare_host(test);
}

/* What becomes of a wild job is not compared: the boards end it, and go on after a reset. */
static int check_refused(struct test *test, enum kind kind)
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

static int check(struct test *test, enum kind kind)
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

static int run_batch(struct test *test)
{
	enum kind kind = below(test, 2) ? PLAIN : (enum kind)below(test, KINDS);

	test->batches[kind]++;
	make_jobs(test, kind);
	arm(test, kind);
	return run_side(test, kind, 0) || run_side(test, kind, 1) || check(test, kind);
}

static int run_round(struct pair *pair)
{
	struct test *test = (struct test *)pair;
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
	struct test *test = (struct test *)pair;
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
	const struct test *test = (const struct test *)pair;

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
	static struct test test;

	return pair_main(&test.pair, &boards, argc, argv);
}
