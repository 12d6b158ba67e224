// SPDX-License-Identifier: MIT
/*
 * Two boards behind vboard/board/usb.h with the same OUT words, in pieces of their own: the same
 * words come on IN, with bursts that end at the same, the same events, and when nothing
 * moves any more, all registers and all of board memory are the same. So they are when the
 * host stops in the middle of a job, as far as rtl/gloss.xml says, when the channel is lost,
 * and after a reset in the middle of anything.
 *
 * test_usb_boards [-n ROUNDS] PLUGIN: the board of the plugin and that of the C model
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "usb_jobs.h"

#define BATCHES 3

static const char *const kind_names[KINDS] = { "plain", "full",     "torn",  "lost",
					       "head",  "checksum", "reset", "wild" };

/* ---- comparing ---- */

static bool comparable(const struct usb_test *test, uint32_t offset)
{
	if (offset == GLOSS_REG_CAPABILITIES ||
	    (offset >= GLOSS_REG_CLOCKS_LOW && offset <= GLOSS_REG_STALL_RESPONSE))
		return false;
	return !test->short_of_words || offset != GLOSS_REG_PROGRESS;
}

static int compare_registers(struct usb_test *test)
{
	for (uint32_t offset = 0; offset <= 0x100; offset += 4) {
		uint32_t model = usb_host_read(&test->host[0], offset);
		uint32_t other = usb_host_read(&test->host[1], offset);

		if (model != other && comparable(test, offset))
			return differ(test, "register 0x%03x is 0x%08x, the model's 0x%08x", offset,
				      other, model);
	}
	return 0;
}

/* Is what one board gave the same as far as the other came? */
static int compare_words(struct usb_test *test, const char *what, const struct usb_words *model,
			 const struct usb_words *other)
{
	uint32_t count = model->count < other->count ? model->count : other->count;

	for (uint32_t n = 0; n < count; n++)
		if (model->word[n] != other->word[n])
			return differ(test, "%s %u is 0x%08x, the model's 0x%08x", what, n,
				      other->word[n], model->word[n]);
	return 0;
}

static int compare_begun(struct usb_test *test)
{
	struct usb_host *model = &test->host[0], *other = &test->host[1];

	return compare_words(test, "IN word", &model->in, &other->in) ||
	       compare_words(test, "end of burst", &model->burst, &other->burst) ||
	       compare_words(test, "word of events", &model->event, &other->event);
}

static int compare_count(struct usb_test *test, const char *what, uint32_t model, uint32_t other)
{
	if (model != other)
		return differ(test, "%u %s, the model's are %u", other, what, model);
	return 0;
}

static int compare_channels(struct usb_test *test)
{
	struct usb_host *model = &test->host[0], *other = &test->host[1];

	if (compare_begun(test) || compare_count(test, "OUT words taken", model->sent, other->sent))
		return 1;
	if (test->short_of_words)
		return 0;
	return compare_count(test, "IN words", model->in.count, other->in.count) ||
	       compare_count(test, "bursts", model->burst.count, other->burst.count) ||
	       compare_count(test, "words of events", model->event.count, other->event.count);
}

/* ---- synchronisation ---- */

static uint32_t make_nonce(struct usb_test *test)
{
	return 1 + below(test, 0xffffffff);
}

/* What an earlier host had yet to send, a usb_sync of another one, the right one. */
static void make_sync(struct usb_test *test)
{
	usb_jobs_add_words(test, test->stale.word, test->stale.count);
	for (uint32_t side = 0; side < 2; side++) {
		if (test->stale.count % 2)
			usb_host_sync(&test->host[side], test->nonce + 1);
		usb_host_sync(&test->host[side], test->nonce);
	}
}

static void keep_stale(struct usb_test *test)
{
	const struct usb_words *out = &test->host[0].out;
	uint32_t from = below(test, out->count + 1);
	uint32_t count = below(test, out->count - from + 1);

	test->stale.count = 0;
	if (count && below(test, 2))
		usb_words_add(&test->stale, out->word + from, count < 3000 ? count : 3000);
}

static int reset(struct usb_test *test)
{
	for (uint32_t side = 0; side < 2; side++)
		if (!usb_host_reset(&test->host[side], test->nonce))
			return differ(test, "board %u does not end its reset", side);
	return compare_registers(test);
}

static int power_on(struct usb_test *test)
{
	for (uint32_t side = 0; side < 2; side++)
		test->ops[side]->reset(test->host[side].board);
	return compare_registers(test);
}

static int run_sync(struct usb_test *test)
{
	return usb_jobs_run(test, PLAIN, 0) || usb_jobs_run(test, PLAIN, 1) ||
	       compare_channels(test) || compare_registers(test);
}

/* A part of the usb_sync; the rest is stale after the next reset. */
static int tear_sync(struct usb_test *test)
{
	uint32_t words = 1 + below(test, GLOSS_USB_SYNC_WORDS - 1);

	if (reset(test))
		return 1;
	for (uint32_t side = 0; side < 2; side++) {
		usb_host_sync(&test->host[side], test->nonce);
		test->host[side].out.count = words;
	}
	test->stale.count = 0;
	usb_words_add(&test->stale, test->host[0].out.word + words, GLOSS_USB_SYNC_WORDS - words);
	return run_sync(test);
}

static int synchronise(struct usb_test *test)
{
	keep_stale(test);
	test->nonce = make_nonce(test);
	if ((below(test, 8) == 0 && power_on(test)) || (below(test, 8) == 0 && tear_sync(test)) ||
	    reset(test))
		return 1;
	make_sync(test);
	if (run_sync(test))
		return 1;
	if (!usb_host_echo(&test->host[0], test->nonce) || !usb_host_empty(&test->host[0]))
		return differ(test, "IN is not the echo of the usb_sync alone");
	test->synchronised = true;
	return 0;
}

/* ---- what is to be the same then ---- */

/* What is known after the jobs that ended is the same; the reset leaves memory as it is. */
static int check_torn(struct usb_test *test)
{
	if (synchronise(test))
		return 1;
	for (uint32_t n = 0; n < test->jobs; n++)
		pair_forgive_slots(&test->pair, test->slot[n]);
	return pair_compare_memory(&test->pair);
}

/* A job whose slots leave board memory may end in two ways, and may write where it likes. */
static int check_wild(struct usb_test *test)
{
	if (synchronise(test))
		return 1;
	memcpy(test->pair.memory[1], test->pair.memory[0], STREAM_RANDOM_MEMORY);
	return 0;
}

static int check_answers(struct usb_test *test)
{
	for (uint32_t n = 0; n < test->jobs; n++)
		if (!usb_host_answer(&test->host[0]))
			return differ(test, "job %u has no right answer", n);
	return usb_host_empty(&test->host[0]) ? 0 : differ(test, "more comes than answers");
}

static int check(struct usb_test *test, enum kind kind)
{
	if (kind == WILD)
		return check_wild(test);
	if (kind == RESET)
		return compare_begun(test) || check_torn(test);
	test->short_of_words = test->ops[1]->pixels_per_clock > 1 &&
			       (usb_host_read(&test->host[0], GLOSS_REG_STATUS) &
				GLOSS_REG_STATUS_RUNNING);
	if (compare_channels(test) || compare_registers(test))
		return 1;
	test->short_of_words = false;
	test->words += test->host[0].in.count;
	if (kind == TORN || kind == HEAD)
		return check_torn(test);
	if (kind == CHECKSUM)
		return pair_compare_memory(&test->pair) || synchronise(test);
	if (check_answers(test) || pair_compare_memory(&test->pair))
		return 1;
	return kind == LOST && synchronise(test);
}

static int run_batch(struct usb_test *test)
{
	enum kind kind = below(test, 2) ? PLAIN : (enum kind)below(test, KINDS);

	test->batches[kind]++;
	if (!test->synchronised && synchronise(test))
		return 1;
	usb_jobs_make(test, kind);
	return usb_jobs_run(test, kind, 0) || usb_jobs_run(test, kind, 1) || check(test, kind);
}

static int run_round(struct pair *pair)
{
	struct usb_test *test = (struct usb_test *)pair;
	int failed = 0;

	test->synchronised = false;
	for (uint32_t side = 0; side < 2; side++) {
		if (!usb_host_init(&test->host[side], test->ops[side], pair->memory[side],
				   STREAM_RANDOM_MEMORY)) {
			fprintf(stderr, "test_usb_boards: out of memory\n");
			exit(1);
		}
	}
	for (uint32_t batch = 0; batch < BATCHES && !failed; batch++)
		failed = run_batch(test);
	for (uint32_t side = 0; side < 2; side++)
		usb_host_fini(&test->host[side]);
	return failed;
}

/* Boards of one thread may end in any order; a plugin that can not do that crashes here. */
static void end_in_any_order(struct pair *pair, const struct gloss_usb_board_ops *ops)
{
	struct gloss_usb_board *board[2];

	for (uint32_t first = 0; first < 2; first++) {
		for (uint32_t n = 0; n < 2; n++)
			board[n] = ops->create(pair->memory[n], STREAM_RANDOM_MEMORY);
		for (uint32_t n = 0; n < 2; n++)
			if (board[n ^ first])
				ops->destroy(board[n ^ first]);
	}
}

static bool load(struct pair *pair, const void *symbol)
{
	struct usb_test *test = (struct usb_test *)pair;
	const struct gloss_usb_board_ops *ops = symbol;

	test->ops[1] = ops;
	test->ops[0] = ops->tile_size == 32 ? &gloss_usb_board_model_t32 :
					      &gloss_usb_board_model_t64;
	if (ops->abi != GLOSS_USB_BOARD_ABI || ops->version != GLOSS_VERSION)
		return false;
	end_in_any_order(pair, ops);
	return true;
}

static void report(const struct pair *pair, uint64_t rounds)
{
	const struct usb_test *test = (const struct usb_test *)pair;

	printf("test_usb_boards: T=%u K=%u: %" PRIu64 " rounds, %" PRIu64
	       " IN words compared; batches",
	       test->ops[1]->tile_size, test->ops[1]->pixels_per_clock, rounds, test->words);
	for (int n = 0; n < KINDS; n++)
		printf(" %s %" PRIu64, kind_names[n], test->batches[n]);
	printf("\n");
}

int main(int argc, char **argv)
{
	static const struct pair_test boards = {
		.program = "test_usb_boards",
		.symbol = GLOSS_USB_BOARD_SYMBOL,
		.load = load,
		.round = run_round,
		.report = report,
	};
	static struct usb_test test;
	int failed = pair_main(&test.pair, &boards, argc, argv);

	free(test.stale.word);
	return failed;
}
