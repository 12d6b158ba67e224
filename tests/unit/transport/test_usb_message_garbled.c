/* SPDX-License-Identifier: MIT */
/* The parser of what a board on USB sends, alone: words that no board says, whose checksum is
 * right. */
#include "usb_talk.h"

#define RESPONSE(count) (GLOSS_USB_RESPONSE_MAGIC << 16 | (count))
#define COMPLETION(cause) (GLOSS_USB_COMPLETION_MAGIC << 16 | (cause))

/* Says it to a parser that expects a job with room for 300 words and a stream of 50. */
static bool is_garbled(const uint32_t *words, size_t count)
{
	struct hearing hearing;

	talk.jobs = 1;
	talk.words = 0;
	talk.job[0].answer = (struct accel_usb_answer){ .sequence = 7,
							.stream_words = 50,
							.response = talk.job[0].response,
							.response_words = 300 };
	say_sync(NONCE);
	hear_start(&hearing);
	hear(&hearing, talk.word, 4);
	hear(&hearing, words, count);
	for (uint32_t n = 300; n < ROOM + 1; n++)
		assert_int_equal(talk.job[0].response[n], GUARD);
	return hearing.garbled;
}

/* A completion at the end of the words, all before which are zero or headers. */
static void seal(uint32_t *words, size_t count)
{
	words[count] = accel_usb_checksum(0, words + count - CHECKED, CHECKED);
}

static void every_wrong_field_is_found(void **state)
{
	static struct {
		const char *what;
		uint32_t word[8]; /* and the right checksum of a whole completion */
		size_t words;
		bool garbled;
	} table[] = {
		{ "a right one", { COMPLETION(0), 7, 50, 0 }, 4, false },
		{ "a right fault", { COMPLETION(1), 7, 49, 0 }, 4, false },
		{ "a fault at the end", { COMPLETION(4), 7, 50, 0 }, 4, false },
		{ "a right answer", { RESPONSE(2), 0, 0, COMPLETION(0), 7, 50, 2 }, 7, false },
		{ "no mark", { 0 }, 1, true },
		{ "another mark", { 0x5353 << 16 | 1 }, 1, true },
		{ "a sync", { GLOSS_USB_SYNC_MAGIC }, 1, true },
		{ "an empty chunk", { RESPONSE(0) }, 1, true },
		{ "a large chunk", { RESPONSE(257) }, 1, true },
		{ "the largest count", { RESPONSE(0xffff) }, 1, true },
		{ "a second last chunk", { RESPONSE(1), 0, RESPONSE(1) }, 3, true },
		{ "a bit in the middle", { COMPLETION(0x10) }, 1, true },
		{ "a high bit", { COMPLETION(0x8000) }, 1, true },
		{ "a cause of PCI", { COMPLETION(8), 7, 50, 0 }, 4, true },
		{ "a cause there is not", { COMPLETION(15), 7, 50, 0 }, 4, true },
		{ "another sequence", { COMPLETION(0), 8, 50, 0 }, 4, true },
		{ "an end too early", { COMPLETION(0), 7, 49, 0 }, 4, true },
		{ "an end too late", { COMPLETION(0), 7, 51, 0 }, 4, true },
		{ "a fault behind the end", { COMPLETION(1), 7, 51, 0 }, 4, true },
		{ "words not sent", { COMPLETION(0), 7, 50, 1 }, 4, true },
		{ "words too few", { RESPONSE(2), 0, 0, COMPLETION(0), 7, 50, 1 }, 7, true },
	};

	(void)state;
	for (size_t n = 0; n < sizeof(table) / sizeof(table[0]); n++) {
		if (table[n].words >= CHECKED)
			seal(table[n].word, table[n].words++);
		if (is_garbled(table[n].word, table[n].words) != table[n].garbled)
			fail_msg("%s", table[n].what);
	}
}

static void a_response_never_gets_more_than_its_room(void **state)
{
	uint32_t words[600] = { 0 };

	(void)state;
	words[0] = RESPONSE(256);
	words[257] = RESPONSE(44);
	assert_false(is_garbled(words, 302));
	words[257] = RESPONSE(45);
	assert_true(is_garbled(words, 258));
	words[257] = RESPONSE(256);
	assert_true(is_garbled(words, 600));
}

static void words_without_a_job_are_garbled(void **state)
{
	static const uint32_t words[] = { 0, RESPONSE(1), COMPLETION(0), GLOSS_USB_SYNC_MAGIC };
	struct hearing hearing;

	(void)state;
	talk.jobs = 0;
	talk.words = 0;
	say_sync(NONCE);
	for (size_t n = 0; n < sizeof(words) / sizeof(words[0]); n++) {
		hear_start(&hearing);
		hear(&hearing, talk.word, 4);
		assert_false(hearing.garbled);
		hear(&hearing, &words[n], 1);
		assert_true(hearing.garbled);
	}
}

static void what_was_garbled_stays_so_until_the_next_start(void **state)
{
	uint64_t seed = test_seed();
	struct hearing hearing;

	(void)state;
	make_talk(&seed, 1);
	hear_start(&hearing);
	hear(&hearing, talk.word, 4);
	hear(&hearing, &(uint32_t){ 0 }, 1);
	for (int n = 0; n < 3; n++) {
		assert_true(hearing.garbled);
		hearing.garbled = false;
		hear(&hearing, talk.word, talk.words);
	}
	hear_start(&hearing);
	hear(&hearing, talk.word, talk.words);
	check_all(&hearing);
}

/* Words that are likely to lead somewhere. */
static uint32_t likely_word(uint64_t *seed)
{
	switch (test_below(seed, 6)) {
	case 0:
		return RESPONSE(test_below(seed, 300));
	case 1:
		return RESPONSE(GLOSS_USB_CHUNK_WORDS);
	case 2:
		return COMPLETION(test_below(seed, 10));
	case 3:
		return talk.job[test_below(seed, talk.jobs)].answer.sequence;
	case 4:
		return talk.job[test_below(seed, talk.jobs)].answer.stream_words;
	default:
		return test_below(seed, ROOM);
	}
}

static void any_words_leave_what_is_not_theirs_alone(void **state)
{
	uint64_t seed = test_seed();
	unsigned int completions = 0;
	struct hearing hearing;

	(void)state;
	for (unsigned int round = 0; round < 20000; round++) {
		uint32_t word;

		make_talk(&seed, 1 + test_below(&seed, JOBS));
		hear_start(&hearing);
		hear(&hearing, talk.word, 4 + test_below(&seed, (uint32_t)talk.words - 4));
		for (unsigned int n = 0; n < 50 && !hearing.garbled; n++) {
			word = likely_word(&seed);
			hear(&hearing, &word, 1);
		}
		for (unsigned int n = 0; n < talk.jobs; n++)
			for (uint32_t i = talk.job[n].answer.response_words; i < ROOM + 1; i++)
				if (talk.job[n].response[i] != GUARD)
					fail_msg("word %u behind the room was written", i);
		completions += hearing.jobs;
	}
	assert_true(completions > 1000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_wrong_field_is_found),
		cmocka_unit_test(a_response_never_gets_more_than_its_room),
		cmocka_unit_test(words_without_a_job_are_garbled),
		cmocka_unit_test(what_was_garbled_stays_so_until_the_next_start),
		cmocka_unit_test(any_words_leave_what_is_not_theirs_alone),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
