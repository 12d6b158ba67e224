/* SPDX-License-Identifier: MIT */
/* The parser of what a board on USB sends, alone: right words in any pieces, and wrong ones. */
#include "accel_test.h"
#include "transport/usb/checksum.h"
#include "transport/usb/message.h"

#define JOBS 6
#define ROOM 1400u
#define WORDS_MAX 8192
#define NONCE 0x1234567u
#define GUARD 0x5a5a5a5au
#define CHECKED (GLOSS_USB_COMPLETION_WORDS - 1) /* words of a completion */

/* A job, and what its answer ought to be. */
struct job {
	struct accel_usb_answer answer;
	struct gloss_status status;
	uint32_t response[ROOM + 1]; /* a guard behind it */
	uint32_t expected[ROOM];
};

/* All that a board says from a reset on. */
struct talk {
	struct job job[JOBS];
	unsigned int jobs;
	uint32_t word[WORDS_MAX];
	size_t words;
};

static struct talk talk;

/* ---- making a conversation ---- */

static void say(uint32_t word)
{
	assert_true(talk.words < WORDS_MAX);
	talk.word[talk.words++] = word;
}

static void say_sync(uint32_t nonce)
{
	say(GLOSS_USB_SYNC_MAGIC);
	say(nonce);
	say(~nonce);
	say(~GLOSS_USB_SYNC_MAGIC);
}

static void say_response(const struct job *job, uint32_t count)
{
	uint32_t done = 0;

	while (done < count) {
		uint32_t now = count - done < GLOSS_USB_CHUNK_WORDS ? count - done :
								      GLOSS_USB_CHUNK_WORDS;

		say(GLOSS_USB_RESPONSE_MAGIC << 16 | now);
		while (now--)
			say(job->expected[done++]);
	}
}

static void say_completion(const struct job *job)
{
	uint32_t sum = accel_usb_checksum(0, job->expected, job->status.response_words);

	say(GLOSS_USB_COMPLETION_MAGIC << 16 | job->status.cause);
	say(job->answer.sequence);
	say(job->status.offset);
	say(job->status.response_words);
	say(accel_usb_checksum(sum, talk.word + talk.words - CHECKED, CHECKED));
}

/* Sizes around a chunk's are likely. */
static uint32_t any_count(uint64_t *seed, uint32_t room)
{
	static const uint32_t counts[] = { 0, 1, 255, 256, 257, 511, 512, 513 };
	uint32_t count = test_below(seed, 2) ? counts[test_below(seed, 8)] :
					       test_below(seed, ROOM + 1);

	return count > room ? room : count;
}

static void say_job(uint64_t *seed)
{
	struct job *job = &talk.job[talk.jobs++];
	uint32_t room = test_below(seed, 3) ? ROOM : any_count(seed, ROOM);
	uint32_t words = test_below(seed, 100000);
	uint32_t cause = test_below(seed, 2) ? test_below(seed, GLOSS_FAULT_MEMORY + 1) : 0;

	*job = (struct job){ .answer = { .sequence = (uint32_t)test_random(seed),
					 .stream_words = words,
					 .response = job->response,
					 .response_words = room } };
	job->status = (struct gloss_status){ .cause = (enum gloss_fault)cause,
					     .offset = cause ? test_below(seed, words + 1) : words,
					     .response_words = any_count(seed, room) };
	memset(job->response, 0x5a, sizeof(job->response));
	for (uint32_t n = 0; n < ROOM; n++)
		job->expected[n] = (uint32_t)test_random(seed);
	say_response(job, job->status.response_words);
	say_completion(job);
}

static void make_talk(uint64_t *seed, unsigned int jobs)
{
	talk.jobs = 0;
	talk.words = 0;
	say_sync(NONCE);
	while (talk.jobs < jobs)
		say_job(seed);
}

/* ---- hearing it ---- */

struct hearing {
	struct accel_usb_parser parser;
	unsigned int syncs, jobs; /* that have come */
	bool garbled;
};

static void hear_start(struct hearing *hearing)
{
	*hearing = (struct hearing){ .syncs = 0 };
	accel_usb_message_start(&hearing->parser, NONCE);
	for (unsigned int n = 0; n < talk.jobs; n++)
		memset(talk.job[n].response, 0x5a, sizeof(talk.job[n].response));
}

/* The words, which are then gone: the parser may not keep where they were. */
static void hear(struct hearing *hearing, const uint32_t *from, size_t count)
{
	uint32_t copy[WORDS_MAX];
	const uint32_t *words = copy;

	memcpy(copy, from, count * sizeof(*from));
	while (count && !hearing->garbled) {
		struct job *job = hearing->jobs < talk.jobs ? &talk.job[hearing->jobs] : NULL;

		switch (accel_usb_message_take(&hearing->parser, job ? &job->answer : NULL, &words,
					       &count)) {
		case ACCEL_USB_SYNC:
			hearing->syncs++;
			break;
		case ACCEL_USB_COMPLETION:
			hearing->jobs++;
			break;
		case ACCEL_USB_GARBLED:
			hearing->garbled = true;
			break;
		default:
			assert_int_equal(count, 0);
		}
	}
	memset(copy, 0xa5, sizeof(copy));
}

static void check_job(const struct job *job)
{
	uint32_t words = job->status.response_words;

	assert_int_equal(job->answer.status.cause, job->status.cause);
	assert_int_equal(job->answer.status.offset, job->status.offset);
	assert_int_equal(job->answer.status.response_words, words);
	assert_memory_equal(job->response, job->expected, 4 * words);
	for (uint32_t n = words; n < ROOM + 1; n++)
		assert_int_equal(job->response[n], GUARD);
}

static void check_all(const struct hearing *hearing)
{
	assert_false(hearing->garbled);
	assert_int_equal(hearing->syncs, 1);
	assert_int_equal(hearing->jobs, talk.jobs);
	for (unsigned int n = 0; n < talk.jobs; n++)
		check_job(&talk.job[n]);
}

/* ---- tests: what is right ---- */

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

/* ---- tests: what is wrong ---- */

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

#define RESPONSE(count) (GLOSS_USB_RESPONSE_MAGIC << 16 | (count))
#define COMPLETION(cause) (GLOSS_USB_COMPLETION_MAGIC << 16 | (cause))

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
		cmocka_unit_test(every_cut_of_a_right_conversation_gives_the_same),
		cmocka_unit_test(words_may_come_one_by_one_or_in_any_pieces),
		cmocka_unit_test(what_is_before_the_sync_is_dropped),
		cmocka_unit_test(only_the_whole_sync_with_its_nonce_counts),
		cmocka_unit_test(every_wrong_bit_of_an_answer_is_found),
		cmocka_unit_test(words_in_another_order_are_found),
		cmocka_unit_test(every_other_checksum_is_wrong),
		cmocka_unit_test(every_wrong_field_is_found),
		cmocka_unit_test(a_response_never_gets_more_than_its_room),
		cmocka_unit_test(words_without_a_job_are_garbled),
		cmocka_unit_test(what_was_garbled_stays_so_until_the_next_start),
		cmocka_unit_test(any_words_leave_what_is_not_theirs_alone),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
