/* SPDX-License-Identifier: MIT */
/* The parser of what a board on USB sends, alone: conversations in any pieces, whole ones and those
 * that the cable changed. */
#include "usb_talk.h"

static void every_cut_of_a_right_conversation_gives_the_same(void **state)
{
	uint64_t seed = test_seed();
	struct hearing hearing;

	(void)state;
	make_talk(&seed, JOBS);
	for (size_t cut = 0; cut <= talk.words; cut++) {
		hear_start(&hearing);
		hear(&hearing, talk.word, cut);
		hear(&hearing, talk.word + cut, talk.words - cut);
		check_all(&hearing);
	}
}

static void words_may_come_one_by_one_or_in_any_pieces(void **state)
{
	uint64_t seed = test_seed();
	struct hearing hearing;

	(void)state;
	for (uint32_t most = 1; most < 2000; most += 1 + most / 4) {
		make_talk(&seed, 1 + test_below(&seed, JOBS));
		hear_start(&hearing);
		for (size_t at = 0, now; at < talk.words; at += now) {
			now = 1 + test_below(&seed, most);
			now = now > talk.words - at ? talk.words - at : now;
			hear(&hearing, talk.word + at, now);
		}
		check_all(&hearing);
	}
}

/* Remains of another conversation, parts of a sync, and one with another nonce. */
static void what_is_before_the_sync_is_dropped(void **state)
{
	uint64_t seed = test_seed();
	struct hearing hearing;

	(void)state;
	for (unsigned int round = 0; round < 200; round++) {
		uint32_t before[64];

		make_talk(&seed, 1);
		for (unsigned int n = 0; n < 64; n++)
			before[n] = test_below(&seed, 2) ? talk.word[test_below(&seed, 4)] :
							   (uint32_t)test_random(&seed);
		before[63] = GLOSS_USB_SYNC_MAGIC;
		hear_start(&hearing);
		hear(&hearing, before, test_below(&seed, 65));
		if (hearing.syncs)
			continue; /* they were one by chance */
		hear(&hearing, talk.word, talk.words);
		check_all(&hearing);
	}
}

static void only_the_whole_sync_with_its_nonce_counts(void **state)
{
	struct hearing hearing;

	(void)state;
	talk.jobs = 0;
	talk.words = 0;
	say_sync(NONCE);
	for (unsigned int word = 0; word < 4; word++)
		for (unsigned int bit = 0; bit < 32; bit++) {
			hear_start(&hearing);
			talk.word[word] ^= 1u << bit;
			hear(&hearing, talk.word, 4);
			talk.word[word] ^= 1u << bit;
			assert_int_equal(hearing.syncs, 0);
			assert_false(hearing.garbled);
			hear(&hearing, talk.word, 4);
			assert_int_equal(hearing.syncs, 1);
		}
}

/* As if all were right. */
static bool is_taken(void)
{
	struct hearing hearing;

	hear_start(&hearing);
	hear(&hearing, talk.word, talk.words);
	return !hearing.garbled && hearing.jobs == talk.jobs;
}

static void every_wrong_bit_of_an_answer_is_found(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	make_talk(&seed, JOBS);
	assert_true(is_taken());
	for (size_t word = 4; word < talk.words; word++)
		for (unsigned int bit = 0; bit < 32; bit++) {
			talk.word[word] ^= 1u << bit;
			if (is_taken())
				fail_msg("bit %u of word %zu", bit, word);
			talk.word[word] ^= 1u << bit;
		}
}

static void swap_with_next(size_t word)
{
	uint32_t first = talk.word[word];

	talk.word[word] = talk.word[word + 1];
	talk.word[word + 1] = first;
}

static void words_in_another_order_are_found(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	make_talk(&seed, JOBS);
	for (size_t word = 4; word + 1 < talk.words; word++) {
		if (talk.word[word] == talk.word[word + 1])
			continue;
		swap_with_next(word);
		if (is_taken())
			fail_msg("word %zu and the next one", word);
		swap_with_next(word);
	}
}

static void every_other_checksum_is_wrong(void **state)
{
	uint64_t seed = test_seed();
	uint32_t right;

	(void)state;
	for (int round = 0; round < 1000; round++) {
		make_talk(&seed, 1);
		right = talk.word[talk.words - 1];
		talk.word[talk.words - 1] = (uint32_t)test_random(&seed);
		assert_int_equal(is_taken(), talk.word[talk.words - 1] == right);
		talk.word[talk.words - 1] = right;
		assert_true(is_taken());
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_cut_of_a_right_conversation_gives_the_same),
		cmocka_unit_test(words_may_come_one_by_one_or_in_any_pieces),
		cmocka_unit_test(what_is_before_the_sync_is_dropped),
		cmocka_unit_test(only_the_whole_sync_with_its_nonce_counts),
		cmocka_unit_test(every_wrong_bit_of_an_answer_is_found),
		cmocka_unit_test(words_in_another_order_are_found),
		cmocka_unit_test(every_other_checksum_is_wrong),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
