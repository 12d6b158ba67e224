// SPDX-License-Identifier: MIT
#include <pthread.h>

#include "accel.h"
#include "stream_random.h"
#include "vm_stream.h"
#include "vm_test.h"

#define THREADS 4
#define DAMAGED_EVERY 3
#define WRITE_WORDS (GLOSS_LENGTH_MAX - 2)
#define READ_WORDS 65535u

/* One of the two devices, as a thread uses it for one job after the other. */
struct side {
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_buffer *buffer[GLOSS_SLOTS];
	struct accel_fence *fence[3]; /* of filling, the job, and reading back */
	struct accel_fence_status status;
	int result;
	uint32_t *response, *content;
	uint32_t content_words;
};

struct worker {
	pthread_t thread;
	struct accel_device *device[2]; /* the board, the model */
	int tile_size, jobs, done, faults;
	uint64_t seed;
	struct stream_random random;
	struct side side[2];
	uint8_t memory[STREAM_RANDOM_MEMORY]; /* what slots are filled with */
};

#define must(call)                                                     \
	do {                                                           \
		int must_err = (call);                                 \
                                                                       \
		if (must_err < 0)                                      \
			vm_fail("%s: %s", #call, strerror(-must_err)); \
	} while (0)

/* A slot of the library is not empty, has rights, and ends at a word. */
static uint32_t slot_words(const struct gloss_slot *slot)
{
	return slot->size < 4 ? 1 : slot->size / 4;
}

static unsigned int slot_rights(const struct gloss_slot *slot)
{
	return slot->rights ? (unsigned int)slot->rights : ACCEL_SLOT_READ;
}

static void name_slots(struct worker *worker, struct side *side, unsigned int rights)
{
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++)
		must(accel_stream_slot(side->stream, side->buffer[n],
				       rights ? rights : slot_rights(&worker->random.job.slot[n])));
}

static void emit_write(struct side *side, uint32_t slot, const uint8_t *from, uint32_t count)
{
	uint32_t words[1 + GLOSS_LENGTH_MAX];

	for (uint32_t at = 0; at < count;) {
		uint32_t now = count - at < WRITE_WORDS ? count - at : WRITE_WORDS;
		const struct gloss_write_memory packet = { .slot = slot, .offset = 4 * at };

		gloss_write_memory_pack(words, &packet, 2 + now);
		memcpy(words + 3, from + 4 * (size_t)at, 4 * (size_t)now);
		must(accel_stream_emit(side->stream, words, 3 + now));
		at += now;
	}
}

static void emit_read(struct side *side, uint32_t slot, uint32_t count)
{
	uint32_t words[1 + GLOSS_READ_MEMORY_WORDS];

	for (uint32_t at = 0; at < count;) {
		uint32_t now = count - at < READ_WORDS ? count - at : READ_WORDS;
		const struct gloss_read_memory packet = { .slot = slot,
							  .offset = 4 * at,
							  .count = now };

		gloss_read_memory_pack(words, &packet);
		must(accel_stream_emit(side->stream, words, 1 + GLOSS_READ_MEMORY_WORDS));
		at += now;
	}
}

/* Three jobs, none of which waits for the one before but on the board. */
static void submit(struct worker *worker, struct side *side)
{
	const struct accel_job *job = &worker->random.job;

	side->content_words = 0;
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
		uint32_t count = slot_words(&job->slot[n]);

		must(accel_buffer_new(side->device, 4ull * count, &side->buffer[n]));
		emit_write(side, n, worker->memory + job->slot[n].base, count);
		side->content_words += count;
	}
	name_slots(worker, side, ACCEL_SLOT_WRITE);
	must(accel_stream_submit(side->stream, NULL, 0, &side->fence[0]));

	name_slots(worker, side, 0);
	must(accel_stream_emit(side->stream, job->stream, job->stream_words));
	memset(side->response, 0, 4 * STREAM_RANDOM_RESPONSE);
	must(accel_stream_submit(side->stream, side->response, job->response_words,
				 &side->fence[1]));

	name_slots(worker, side, ACCEL_SLOT_READ);
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		emit_read(side, n, slot_words(&job->slot[n]));
	must(accel_stream_submit(side->stream, side->content, side->content_words,
				 &side->fence[2]));
}

static void finish(struct side *side)
{
	must(accel_fence_wait(side->fence[0], -1, NULL, 0));
	side->result = accel_fence_wait(side->fence[1], -1, &side->status, sizeof(side->status));
	must(accel_fence_wait(side->fence[2], -1, NULL, 0));
	for (int i = 0; i < 3; i++)
		accel_fence_free(side->fence[i]);
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++)
		accel_buffer_free(side->buffer[n]);
}

static void compare_words(const char *what, uint64_t seed, const uint32_t *board,
			  const uint32_t *model, uint32_t count)
{
	for (uint32_t n = 0; n < count; n++)
		if (board[n] != model[n])
			vm_fail("job %#" PRIx64 ": word %u of %s: board %08x, model %08x", seed, n,
				what, board[n], model[n]);
}

static void compare(const struct worker *worker, uint64_t seed)
{
	const struct side *board = &worker->side[0], *model = &worker->side[1];

	if (board->result != model->result || board->status.fault != model->status.fault ||
	    board->status.offset != model->status.offset ||
	    board->status.response_words != model->status.response_words)
		vm_fail("job %#" PRIx64 ": board %d, fault %u at %u, %u answered; "
			"model %d, fault %u at %u, %u answered",
			seed, board->result, board->status.fault, board->status.offset,
			board->status.response_words, model->result, model->status.fault,
			model->status.offset, model->status.response_words);
	compare_words("the answers", seed, board->response, model->response,
		      STREAM_RANDOM_RESPONSE);
	compare_words("all slots", seed, board->content, model->content, board->content_words);
}

static void *work(void *data)
{
	struct worker *worker = data;

	for (int job = 0; job < worker->jobs; job++) {
		uint64_t seed = worker->seed + (uint64_t)job * 0xbf58476d1ce4e5b9;

		stream_random_valid(&worker->random, seed, worker->tile_size);
		if (job % DAMAGED_EVERY == DAMAGED_EVERY - 1)
			stream_random_damage(&worker->random);
		stream_random_memory(worker->memory, STREAM_RANDOM_MEMORY, seed);
		for (int i = 0; i < 2; i++)
			submit(worker, &worker->side[i]);
		for (int i = 0; i < 2; i++)
			finish(&worker->side[i]);
		compare(worker, seed);
		worker->faults += worker->side[0].status.fault != 0;
		worker->done++;
	}
	return NULL;
}

static void worker_start(struct worker *worker)
{
	for (int i = 0; i < 2; i++) {
		struct side *side = &worker->side[i];

		side->device = worker->device[i];
		side->response = malloc(4 * STREAM_RANDOM_RESPONSE);
		side->content = malloc(STREAM_RANDOM_MEMORY);
		if (!side->response || !side->content)
			vm_fail("out of memory");
		must(accel_stream_new(side->device, &side->stream));
	}
	if (pthread_create(&worker->thread, NULL, work, worker))
		vm_fail("no thread");
}

static void worker_join(struct worker *worker)
{
	pthread_join(worker->thread, NULL);
	for (int i = 0; i < 2; i++) {
		accel_stream_free(worker->side[i].stream);
		free(worker->side[i].response);
		free(worker->side[i].content);
	}
}

static void say(void *data, const char *message)
{
	(void)data;
	fprintf(stderr, "%s\n", message);
}

/* A fault has its message; there are many of them here, and the test compares them itself. */
static struct accel_device *open_device(const char *name)
{
	struct accel_device *device;

	if (accel_device_new(name, NULL, NULL, &device))
		accel_device_new(name, say, NULL, &device);
	else
		return device;
	vm_fail("%s does not open", name);
}

void vm_stream_test(const char *board, int jobs, uint64_t seed)
{
	static struct worker workers[THREADS];
	struct accel_device *device[2];
	struct accel_device_info info;
	int done = 0, faults = 0;
	char model[32];

	device[0] = open_device(board);
	accel_device_info(device[0], &info, sizeof(info));
	snprintf(model, sizeof(model), "model:tile=%u", info.tile_size);
	device[1] = open_device(model);
	for (int i = 0; i < THREADS; i++) {
		workers[i] = (struct worker){
			.device = { device[0], device[1] },
			.tile_size = (int)info.tile_size,
			.jobs = jobs / THREADS,
			.seed = seed + (uint64_t)i * 0x9e3779b97f4a7c15,
		};
		worker_start(&workers[i]);
	}
	for (int i = 0; i < THREADS; i++) {
		worker_join(&workers[i]);
		done += workers[i].done;
		faults += workers[i].faults;
	}
	accel_device_free(device[0]);
	accel_device_free(device[1]);
	VM_PRINT("%s: %d jobs of %d threads as on the model, %d of them with a fault\n", info.name,
		 done, THREADS, faults);
}
