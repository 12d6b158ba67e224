// SPDX-License-Identifier: MIT
/*
 * Board memory of one file is out of reach for another, whatever its streams say.
 *
 * Every job here is also given to the C model, with nothing in its memory but what
 * belongs to the file: answers, faults and memory must be the same, word for word. What
 * another file had to do with it would be a difference.
 */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "vm_test.h"
#include "gloss_node.h"
#include "model/model.h"
#include "stream_random.h"

#define OBJECT STREAM_RANDOM_MEMORY
#define SENTINEL 0xdeadc0deu

static uint64_t seed;
static uint32_t tile;

/* What the model thinks the intruder's object holds. */
static uint8_t shadow[OBJECT];
static uint32_t expected[CLIENT_RESPONSE_WORDS];

/* ---- the victim: a process with secrets on both sides of the intruder's object ---- */

struct victim {
	pid_t process;
	int ask, answer; /* pipes */
};

static uint32_t secret(uint32_t word)
{
	return (uint32_t)seed + word * 0x9e3779b1u;
}

/* Writes or checks the whole of @client's object, a job per so many words. */
static bool secrets(struct client *client, bool check)
{
	enum { AT_ONCE = 1024 };
	uint32_t words[AT_ONCE];

	for (uint32_t at = 0; at < OBJECT / 4; at += AT_ONCE) {
		uint32_t count;

		for (uint32_t i = 0; i < AT_ONCE; i++)
			words[i] = secret(at + i);
		if (check)
			count = node_read(client->stream, 0, 4 * at, AT_ONCE);
		else
			count = node_write(client->stream, 0, 4 * at, words, AT_ONCE);
		if (client_run(client, count, check ? AT_ONCE : 0))
			return false;
		if (check && memcmp(client->response, words, sizeof(words)) != 0)
			return false;
	}
	return true;
}

/* Speaks a byte when the secrets are there, and for each byte says whether they still are. */
static void victim_main(struct client *low, struct client *high, int ask, int answer)
{
	char told = secrets(low, false) && secrets(high, false);
	char byte;

	while (write(answer, &told, 1) == 1 && read(ask, &byte, 1) == 1)
		told = secrets(low, true) && secrets(high, true);
	_exit(0);
}

static bool victim_is_well(const struct victim *victim)
{
	char told = 0;

	return write(victim->ask, "?", 1) == 1 && read(victim->answer, &told, 1) == 1 && told;
}

/* A child has inherited @client: nothing of it is closed but what is this process's own. */
static void leave_to_child(struct client *client)
{
	munmap(client->host.map, client->host.size);
	close(client->fd);
}

/* Objects are made in the order low, intruder, high, so they can lie side by side. */
static void make_neighbours(struct victim *victim, struct client *intruder)
{
	struct client low, high;
	int ask[2], answer[2];
	char told;

	assert_int_equal(client_open(&low, vm_env("GLOSS_NODE_MODEL"), OBJECT), 0);
	assert_int_equal(client_open(intruder, vm_env("GLOSS_NODE_MODEL"), OBJECT), 0);
	assert_int_equal(client_open(&high, vm_env("GLOSS_NODE_MODEL"), OBJECT), 0);
	assert_int_equal(pipe(ask) | pipe(answer), 0);
	victim->process = fork();
	assert_int_not_equal(victim->process, -1);
	if (!victim->process) {
		close(intruder->fd);
		close(ask[1]);
		victim_main(&low, &high, ask[0], answer[1]);
	}
	victim->ask = ask[1];
	victim->answer = answer[0];
	close(ask[0]);
	close(answer[1]);
	leave_to_child(&low);
	leave_to_child(&high);
	assert_int_equal(read(victim->answer, &told, 1), 1);
	assert_int_equal(told, 1);
}

static void end_victim(struct victim *victim)
{
	assert_true(victim_is_well(victim));
	close(victim->ask);
	close(victim->answer);
	assert_int_equal(waitpid(victim->process, NULL, 0), victim->process);
}

/* ---- the intruder's jobs, and the model's word for them ---- */

/* The slots of @job as the kernel takes them: whole words, and none without rights. */
static uint32_t kernel_slots(const struct client *client, struct accel_job *job,
			     struct drm_gloss_slot *slots)
{
	for (uint32_t i = 0; i < GLOSS_SLOTS; i++) {
		struct gloss_slot *slot = &job->slot[i];

		slot->size &= ~3u;
		if (!slot->size || !slot->rights)
			*slot = (struct gloss_slot){ 0 };
		slots[i] = (struct drm_gloss_slot){
			.handle = slot->size ? client->board : 0,
			.rights = slot->rights,
			.offset = slot->base,
			.size = slot->size,
		};
	}
	return GLOSS_SLOTS;
}

static void run_on_model(struct accel_job *job, struct gloss_status *status)
{
	static struct model model;

	assert_int_equal(model_init(&model, (int)tile, shadow, sizeof(shadow)), 0);
	job->response = expected;
	assert_int_equal(model_run(&model, job, status), 0);
}

static int fence_error(const struct gloss_status *status)
{
	return status->cause ? -EIO : 0;
}

/* The answer, and not a word behind it: what is there could be anybody's. */
static void compare_response(const struct client *client, uint32_t answered)
{
	assert_memory_equal(client->response, expected, 4 * (size_t)answered);
	for (uint32_t i = answered; i < CLIENT_RESPONSE_WORDS; i++)
		if (client->response[i] != SENTINEL)
			fail_msg("word %u behind an answer of %u was written", i, answered);
}

/* Only what the last job could have written. */
static void fill_response(struct client *client, uint32_t used)
{
	for (uint32_t i = 0; i < used; i++)
		client->response[i] = SENTINEL;
}

/* Runs @job, whose stream is in its own memory, on the board and on the model. */
static void run_on_both(struct client *client, struct accel_job *job)
{
	struct gloss_status status;
	struct client_job sent;

	memcpy(client->stream, job->stream, 4 * (size_t)job->stream_words);
	client_prepare(client, &sent, job->stream_words, job->response_words);
	sent.submit.slot_count = kernel_slots(client, job, sent.slot);
	assert_int_equal(client_submit(client, &sent), 0);
	run_on_model(job, &status);
	assert_int_equal(client_wait(client, vm_patience_ms()), fence_error(&status));
	assert_int_equal(client->status->error, 0);
	assert_int_equal(client->status->cause, status.cause);
	assert_int_equal(client->status->offset, status.offset);
	assert_int_equal(client->status->response_words, status.response_words);
	compare_response(client, status.response_words);
	fill_response(client, status.response_words);
}

/* The whole object: what a stream changed where the model did not is found too. */
static void compare_memory(struct client *client)
{
	enum { AT_ONCE = OBJECT / 4 / 4 };

	for (uint32_t at = 0; at < OBJECT / 4; at += AT_ONCE) {
		uint32_t words = node_read(client->stream, 0, 4 * at, AT_ONCE);

		assert_int_equal(client_run(client, words, AT_ONCE), 0);
		assert_memory_equal(client->response, shadow + 4 * (size_t)at, 4 * (size_t)AT_ONCE);
		fill_response(client, AT_ONCE);
	}
}

/* ---- tests ---- */

static void new_board_memory_reads_zero(struct client *client)
{
	memset(shadow, 0, sizeof(shadow));
	fill_response(client, CLIENT_RESPONSE_WORDS);
	compare_memory(client);
}

/* Just inside, just outside and far outside of a slot, by each packet that names one. */
static void accesses_around_a_slot(struct client *client, uint32_t base, uint32_t size)
{
	const uint32_t offsets[] = {
		0,          4,      size - 8, size - 4, size,           size + 4, size + NODE_PAGE,
		OBJECT - 4, OBJECT, 1u << 31, -base,    -base - OBJECT, -OBJECT,  ~0u - 3,
		~0u - 7,
	};
	uint32_t stream[64], row = 4 * tile, words = 0;
	struct accel_job job = { .stream = stream };

	job.slot[3] = (struct gloss_slot){ base, size, GLOSS_RIGHTS_READ_WRITE };
	for (size_t i = 0; i < sizeof(offsets) / sizeof(offsets[0]); i++) {
		struct gloss_colour_surface surface = { 3, row };
		struct gloss_tile_begin load = { .colour_load = true, .colour = offsets[i] & -row };
		struct gloss_tile_end answer = { .colour_output = GLOSS_TILE_OUTPUT_ANSWER };

		job.response_words = 2;
		job.stream_words = node_read(stream, 3, offsets[i], 2);
		run_on_both(client, &job);
		job.stream_words = node_write(stream, 3, offsets[i], (uint32_t[]){ 1, 2 }, 2);
		run_on_both(client, &job);
		job.stream_words = node_fill(stream, 3, offsets[i] & -row, tile, 0xabcd);
		run_on_both(client, &job);
		gloss_colour_surface_pack(stream, &surface);
		words = 1 + GLOSS_COLOUR_SURFACE_WORDS;
		gloss_tile_begin_pack(stream + words, &load);
		words += 1 + GLOSS_TILE_BEGIN_WORDS;
		gloss_tile_end_pack(stream + words, &answer);
		job.stream_words = words + 1 + GLOSS_TILE_END_WORDS;
		job.response_words = tile * tile;
		run_on_both(client, &job);
	}
}

/* Slots that are empty, or allow only one of both. */
static void accesses_without_a_right(struct client *client)
{
	uint32_t stream[64];
	struct accel_job job = { .stream = stream, .response_words = 8 };

	job.slot[5] = (struct gloss_slot){ NODE_PAGE, NODE_PAGE, GLOSS_RIGHTS_READ };
	job.slot[6] = (struct gloss_slot){ NODE_PAGE, NODE_PAGE, GLOSS_RIGHTS_WRITE };
	for (uint32_t slot = 0; slot < GLOSS_SLOTS; slot++) {
		job.stream_words = node_read(stream, slot, 0, 8);
		run_on_both(client, &job);
		job.stream_words = node_write(stream, slot, 0, &slot, 1);
		run_on_both(client, &job);
	}
}

static void no_stream_reaches_another_files_memory(void **state)
{
	enum { JOBS = 400 };
	static struct stream_random random;
	struct victim victim;
	struct client intruder;

	(void)state;
	make_neighbours(&victim, &intruder);
	new_board_memory_reads_zero(&intruder);
	accesses_around_a_slot(&intruder, 0, NODE_PAGE);
	accesses_around_a_slot(&intruder, OBJECT - 5 * NODE_PAGE, 5 * NODE_PAGE);
	accesses_without_a_right(&intruder);
	compare_memory(&intruder);
	for (uint64_t n = 0; n < JOBS; n++) {
		stream_random_valid(&random, seed + n, (int)tile);
		if (n % 4)
			stream_random_damage(&random);
		run_on_both(&intruder, &random.job);
		if (n % 50 == 49)
			compare_memory(&intruder);
	}
	end_victim(&victim);
	client_close(&intruder);
}

/* A slot's end is the board's, not the driver's to check: two objects, each its own slots. */
static void slots_of_one_job_do_not_mix(void **state)
{
	struct client client;
	struct client_job job;
	const uint32_t value = 0x51075;
	uint32_t second, words;

	(void)state;
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), NODE_PAGE), 0);
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_BOARD, NODE_PAGE, &second), 0);
	words = node_write(client.stream, 1, 0, &value, 1);
	words += node_read(client.stream + words, 0, 0, 1);
	words += node_read(client.stream + words, 1, 0, 1);
	client_prepare(&client, &job, words, 2);
	job.submit.slot_count = 2;
	job.slot[1] = (struct drm_gloss_slot){ second, 3, 0, NODE_PAGE };
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	assert_int_equal(client.response[0], 0);
	assert_int_equal(client.response[1], value);
	client_close(&client);
}

static int setup(void **state)
{
	uint64_t value;
	int fd = node_open(vm_env("GLOSS_NODE_MODEL"));

	(void)state;
	signal(SIGPIPE, SIG_IGN);
	if (fd < 0 || node_param(fd, DRM_GLOSS_PARAM_TILE_SIZE, &value))
		return -1;
	tile = (uint32_t)value;
	seed = vm_seed();
	return close(fd);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(no_stream_reaches_another_files_memory),
		cmocka_unit_test(slots_of_one_job_do_not_mix),
	};

	return cmocka_run_group_tests(tests, setup, NULL);
}
