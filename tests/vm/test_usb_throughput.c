// SPDX-License-Identifier: MIT
/*
 * How fast streams and answers move over USB, against plain bulk transfers on the same cable:
 * interface 1 of the virtual board, 64 KiB at a time, four in flight. Both in this run, in turns.
 */
#include "accel.h"
#include "gloss_packets.h"
#include "usb_plain.h"
#include "vm_test.h"

enum {
	ROUNDS = 15,
	JOBS = 8,            /* of a round, all submitted before one is waited for */
	JOB_BYTES = 4 << 20, /* of board memory that a job writes or reads */
	WRITE_WORDS = GLOSS_LENGTH_MAX - 2,
	READ_WORDS = 32768,
};

/* Streams that move less than this part of what plain transfers do are too slow. */
#define RATIO_LEAST 0.8

struct way {
	const char *name;
	uint8_t endpoint; /* of the plain transfers */
	void (*fill)(struct accel_stream *stream, struct accel_buffer *buffer);
	uint32_t response_words; /* of a job */
	double mb_s[ROUNDS], ratio[ROUNDS];
};

static uint32_t content[JOB_BYTES / 4], answer[JOBS][JOB_BYTES / 4];

#define must(call)                                                     \
	do {                                                           \
		int must_err = (call);                                 \
                                                                       \
		if (must_err < 0)                                      \
			vm_fail("%s: %s", #call, strerror(-must_err)); \
	} while (0)

static double now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

static double median(double *numbers)
{
	qsort(numbers, ROUNDS, sizeof(*numbers), compare);
	return numbers[ROUNDS / 2];
}

/* ---- jobs ---- */

static void fill_write(struct accel_stream *stream, struct accel_buffer *buffer)
{
	uint32_t words[1 + GLOSS_LENGTH_MAX];
	int slot = accel_stream_slot(stream, buffer, ACCEL_SLOT_WRITE);

	must(slot);
	for (uint32_t at = 0; at < JOB_BYTES / 4;) {
		uint32_t left = JOB_BYTES / 4 - at, count = left < WRITE_WORDS ? left : WRITE_WORDS;
		const struct gloss_write_memory packet = { .slot = (uint32_t)slot,
							   .offset = 4 * at };

		gloss_write_memory_pack(words, &packet, 2 + count);
		memcpy(words + 3, content + at, 4 * (size_t)count);
		must(accel_stream_emit(stream, words, 3 + count));
		at += count;
	}
}

static void fill_read(struct accel_stream *stream, struct accel_buffer *buffer)
{
	uint32_t words[1 + GLOSS_READ_MEMORY_WORDS];
	int slot = accel_stream_slot(stream, buffer, ACCEL_SLOT_READ);

	must(slot);
	for (uint32_t at = 0; at < JOB_BYTES / 4; at += READ_WORDS) {
		const struct gloss_read_memory packet = { .slot = (uint32_t)slot,
							  .offset = 4 * at,
							  .count = READ_WORDS };

		gloss_read_memory_pack(words, &packet);
		must(accel_stream_emit(stream, words, 1 + GLOSS_READ_MEMORY_WORDS));
	}
}

/* Seconds from the first job's submission to the last one's end; what is packed in advance is
 * not in it. */
static double run_jobs(struct accel_device *device, struct accel_buffer *buffer,
		       const struct way *way)
{
	struct accel_stream *stream[JOBS];
	struct accel_fence *fence[JOBS];
	double start;

	for (int n = 0; n < JOBS; n++) {
		must(accel_stream_new(device, &stream[n]));
		way->fill(stream[n], buffer);
	}
	start = now();
	for (int n = 0; n < JOBS; n++)
		must(accel_stream_submit(stream[n], answer[n], way->response_words, &fence[n]));
	for (int n = 0; n < JOBS; n++)
		must(accel_fence_wait(fence[n], -1, NULL, 0));
	start = now() - start;
	for (int n = 0; n < JOBS; n++) {
		accel_fence_free(fence[n]);
		accel_stream_free(stream[n]);
	}
	return start;
}

/* ---- rounds ---- */

static void fill_content(uint64_t seed)
{
	for (size_t n = 0; n < JOB_BYTES / 4; n++) {
		seed = seed * 6364136223846793005 + 1442695040888963407;
		content[n] = (uint32_t)(seed >> 32);
	}
}

static void check_answers(void)
{
	for (int n = 0; n < JOBS; n++)
		if (memcmp(answer[n], content, JOB_BYTES) != 0)
			vm_fail("what is read back is not what was written");
}

static void one_round(struct accel_device *device, struct accel_buffer *buffer,
		      struct usb_plain *plain, struct way *way, int round)
{
	const size_t bytes = (size_t)JOBS * JOB_BYTES;
	double bulk = usb_plain_move(plain, way->endpoint, bytes);
	double jobs = run_jobs(device, buffer, way);

	way->mb_s[round] = 1e-6 * (double)bytes / jobs;
	way->ratio[round] = bulk / jobs;
	VM_PRINT("%s: %.1f MB/s, plain %.1f MB/s\n", way->name, way->mb_s[round],
		 1e-6 * (double)bytes / bulk);
}

int main(void)
{
	struct way ways[] = {
		{ .name = "streams", .endpoint = USB_PLAIN_SINK, .fill = fill_write },
		{ .name = "answers",
		  .endpoint = USB_PLAIN_SOURCE,
		  .fill = fill_read,
		  .response_words = JOB_BYTES / 4 },
	};
	const char *board = vm_env("GLOSS_USB_MODEL");
	struct vm_figure figures[4];
	struct accel_device *device;
	struct accel_buffer *buffer;
	struct usb_plain *plain;

	if (atoi(vm_env("GLOSS_SLOW")) > 1)
		vm_skip("a kernel that does not check itself");
	fill_content(vm_seed());
	must(accel_device_new(board, NULL, NULL, &device));
	must(accel_buffer_new(device, JOB_BYTES, &buffer));
	plain = usb_plain_open(board);
	for (int round = 0; round < ROUNDS; round++)
		for (int n = 0; n < 2; n++)
			one_round(device, buffer, plain, &ways[n], round);
	check_answers();
	usb_plain_close(plain);
	accel_buffer_free(buffer);
	accel_device_free(device);

	figures[0] = (struct vm_figure){ "usb.stream_mb_s", median(ways[0].mb_s) };
	figures[1] = (struct vm_figure){ "usb.stream_vs_bulk", median(ways[0].ratio) };
	figures[2] = (struct vm_figure){ "usb.answer_mb_s", median(ways[1].mb_s) };
	figures[3] = (struct vm_figure){ "usb.answer_vs_bulk", median(ways[1].ratio) };
	vm_figures(figures, 4);
	if (figures[1].value < RATIO_LEAST)
		vm_fail("streams move at %.2f of plain transfers, less than %.1f", figures[1].value,
			RATIO_LEAST);
	return VM_PASS;
}
