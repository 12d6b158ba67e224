// SPDX-License-Identifier: MIT
/*
 * A hostile board on the cable, for libFuzzer: whatever it says, the library opens it, gets
 * memory, runs jobs, waits and closes without an access outside, a hang or a leak. It is the
 * honest board (the C model) between whose words, registers and descriptors the input puts others.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fake_usb.h"
#include "fuzz_usb_board.h"
#include "fuzz_usb_input.h"
#include "transport/transport.h"

#define JOBS 6
#define PAGE_WORDS 1024u

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(bool condition)
{
	if (!condition)
		abort();
}

/* ---- its descriptors ---- */

static const char *text(unsigned int which, const char *right)
{
	const char *const texts[] = {
		right,
		NULL,
		"",
		"\x01\x7f\xff%s%n/../, \"quoted\" and longer than any name ought "
		"to be: 0123456789012345678901234567890123456789012345678901234567890123456789",
	};

	return texts[which & 3];
}

static void describe(struct fake_usb_board *board, const struct fuzz_usb_head *head)
{
	board->serial = text(head->texts, board->serial);
	board->product_text = text(head->texts >> 2, board->product_text);
	if (!(head->flags & FUZZ_USB_DESCRIPTORS))
		return;
	board->interface_class ^= head->interface_class;
	board->interface_subclass ^= head->interface_subclass;
	board->interface_protocol ^= head->interface_protocol;
	board->interfaces = head->interfaces % 3;
	board->endpoints = head->endpoints % (FAKE_USB_ENDPOINTS + 1);
	for (int n = 0; n < 3; n++) {
		board->endpoint[n].address ^= head->endpoint[n][0];
		board->endpoint[n].attributes ^= head->endpoint[n][1];
	}
}

static void plug_in(const struct fuzz_usb_head *head, const uint8_t *data, size_t size)
{
	struct fake_usb_board *board = &fake_usb.board[0];

	fake_usb_start(head->jobs);
	fake_usb_unplug(0);
	board->ops = fuzz_usb_board(head->flags, data, size);
	board->speed = head->flags & FUZZ_USB_SUPER ? LIBUSB_SPEED_SUPER : LIBUSB_SPEED_HIGH;
	describe(board, head);
	for (int n = 0; n < FUZZ_USB_FAULTS; n++) {
		enum fake_usb_fault fault = head->fault[n][0] % FAKE_USB_FAULTS;

		if (fault)
			fake_usb_arm(0, fault, head->fault[n][1],
				     16u * head->fault[n][2] * head->fault[n][2]);
	}
	fake_usb_fail(NULL, head->call, -1 - head->error % 12);
	fake_usb_plug(0, false);
}

/* ---- the host ---- */

struct job {
	uint32_t *stream, *response;
	uint64_t sequence;
	uint32_t response_words;
	bool submitted;
};

static uint32_t stream_fill(uint32_t *stream, uint32_t count)
{
	gloss_write_memory_pack(stream, &(struct gloss_write_memory){ .slot = 0 }, 2 + PAGE_WORDS);
	memset(stream + 3, 0x3c, 4 * PAGE_WORDS);
	gloss_read_memory_pack(stream + 3 + PAGE_WORDS,
			       &(struct gloss_read_memory){ .slot = 0, .count = count });
	return 3 + PAGE_WORDS + 3;
}

/* The response ends where its words do. */
static void job_submit(void *state, const struct accel_transport_slot *slot, struct job *job,
		       uint32_t words)
{
	struct accel_transport_job from = { .slot = slot, .slots = 1 };

	job->stream = malloc(4 * (2 * PAGE_WORDS));
	job->response = malloc(4 * (size_t)words + 1);
	check(job->stream && job->response);
	from.stream_words = stream_fill(job->stream, words);
	from.stream = job->stream;
	from.response = words ? job->response : NULL;
	from.response_words = job->response_words = words;
	job->submitted = !accel_transport_usb.submit(state, &from, &job->sequence);
	free(job->stream);
}

static void job_wait(void *state, struct job *job)
{
	struct gloss_status status;
	int err = 0;

	if (job->submitted)
		err = accel_transport_usb.wait(state, job->sequence, -1, &status);
	if (job->submitted && !err)
		check(status.response_words <= job->response_words);
	check(err != -ETIMEDOUT);
	free(job->response);
}

static void run_jobs(void *state, const struct fuzz_usb_head *head)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ_WRITE };
	unsigned int count = head->jobs % (JOBS + 1);
	struct job job[JOBS];

	if (accel_transport_usb.memory_new(state, 4ull * PAGE_WORDS, &slot.object))
		return;
	for (unsigned int n = 0; n < count; n++)
		job_submit(state, &slot, &job[n], head->response * (PAGE_WORDS / 64));
	for (unsigned int n = 0; n < count; n++)
		job_wait(state, &job[n]);
	accel_transport_usb.memory_free(state, slot.object);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct accel_transport_error error = { "" };
	struct accel_transport_info info;
	struct fuzz_usb_head head;
	void *state;

	if (size < sizeof(head))
		return 0;
	memcpy(&head, data, sizeof(head));
	plug_in(&head, data + sizeof(head), size - sizeof(head));
	if (!accel_transport_usb.open("", &state, &error)) {
		accel_transport_usb.info(state, &info);
		check(memchr(info.name, 0, sizeof(info.name)) != NULL);
		/* Those after a failure, too. */
		run_jobs(state, &head);
		run_jobs(state, &head);
		accel_transport_usb.close(state);
	}
	check(memchr(error.text, 0, sizeof(error.text)) != NULL);
	fake_usb_stop();
	return 0;
}
