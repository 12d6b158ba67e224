// SPDX-License-Identifier: MIT
/*
 * Any bytes as a job, for libFuzzer. The model must stay in its buffers and its
 * slots, which AddressSanitizer watches, and the decoder must find what the
 * model finds, as far as it can know.
 */
#include <sanitizer/asan_interface.h>
#include <stdlib.h>
#include <string.h>

#include "decode/decode.h"
#include "fuzz_input.h"
#include "model/model.h"

#define FILL 0x5a

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* FILL in all bytes between two inputs, and always. */
static uint8_t memory[FUZZ_MEMORY], filled[FUZZ_MEMORY];
static uint32_t response[FUZZ_ROOM_MASK];

static void check(bool condition)
{
	if (!condition)
		abort();
}

static struct gloss_slot slot_from(const uint8_t bytes[FUZZ_SLOT_BYTES])
{
	struct gloss_slot slot = {
		.base = bytes[0] % (FUZZ_MEMORY / FUZZ_PAGE) * FUZZ_PAGE,
		.size = (uint32_t)bytes[1] << 2 | (uint32_t)bytes[2] << 10 | (bytes[3] >> 2 & 3),
		.rights = (enum gloss_rights)(bytes[3] & 3),
	};

	if (slot.size > FUZZ_MEMORY - slot.base)
		slot.size = FUZZ_MEMORY - slot.base;
	return slot;
}

/* The stream gets a buffer that ends where it ends. False: no memory for it. */
static bool job_from(const uint8_t *data, size_t size, struct accel_job *job)
{
	uint32_t count = (uint32_t)((size - FUZZ_HEAD_BYTES) / 4);
	uint32_t *stream = malloc(4 * (size_t)count);

	job->response_words = (data[1] | (uint32_t)data[2] << 8 | (uint32_t)data[3] << 16) &
			      FUZZ_ROOM_MASK;
	job->response = response;
	job->stream = stream;
	job->stream_words = count;
	if (!stream)
		return false;
	for (uint32_t n = 0; n < count; n++) {
		const uint8_t *byte = data + FUZZ_HEAD_BYTES + 4 * (size_t)n;

		stream[n] = byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 |
			    (uint32_t)byte[3] << 24;
	}
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		job->slot[n] = slot_from(data + 4 + FUZZ_SLOT_BYTES * n);
	return true;
}

/* Opens to the model what a slot gives any right to, and the room in the response. */
static void poison(const struct accel_job *job)
{
	ASAN_POISON_MEMORY_REGION(memory, sizeof(memory));
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		if (job->slot[n].rights)
			ASAN_UNPOISON_MEMORY_REGION(memory + job->slot[n].base, job->slot[n].size);
	ASAN_POISON_MEMORY_REGION(response, sizeof(response));
	ASAN_UNPOISON_MEMORY_REGION(response, 4 * job->response_words);
}

/* Takes back what the job may have written; then what it could only read must be as it was. */
static void check_memory(const struct accel_job *job)
{
	ASAN_UNPOISON_MEMORY_REGION(memory, sizeof(memory));
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		if (job->slot[n].rights & GLOSS_RIGHTS_WRITE)
			memset(memory + job->slot[n].base, FILL, job->slot[n].size);
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		if (job->slot[n].rights == GLOSS_RIGHTS_READ)
			check(!memcmp(memory + job->slot[n].base, filled, job->slot[n].size));
}

/* What takes the slot table or the response to find, the decoder can not find. */
static void check_decoder(const struct accel_job *job, int tile_size,
			  const struct gloss_status *status)
{
	struct decode_packet last;
	enum gloss_fault fault = decode_stream(job->stream, job->stream_words,
					       (unsigned int)tile_size, &last);

	if (status->cause == GLOSS_FAULT_SLOT || status->cause == GLOSS_FAULT_RESPONSE) {
		check(fault == GLOSS_FAULT_NONE || last.fault_offset > status->offset);
		return;
	}
	check(fault == status->cause);
	check(fault == GLOSS_FAULT_NONE || last.fault_offset == status->offset);
}

static void run(const struct accel_job *job, int tile_size)
{
	static struct model model;
	struct gloss_status status;

	check(model_init(&model, tile_size, memory, sizeof(memory)) == 0);
	poison(job);
	check(model_run(&model, job, &status) == 0);
	check_memory(job);
	check(status.response_words <= job->response_words);
	check(status.cause || status.offset == job->stream_words);
	check_decoder(job, tile_size, &status);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct accel_job job;

	if (size < FUZZ_HEAD_BYTES)
		return 0;
	if (filled[0] != FILL) {
		memset(memory, FILL, sizeof(memory));
		memset(filled, FILL, sizeof(filled));
	}
	if (job_from(data, size, &job))
		run(&job, data[0] & 1 ? 64 : 32);
	free((void *)job.stream);
	return 0;
}
