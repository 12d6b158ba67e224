// SPDX-License-Identifier: MIT
/*
 * SUBMIT with one thing wrong at a time, a row each: the error is the one gloss_drm.h promises,
 * nothing is left behind, and the next job runs. What is just right is taken.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "vm_submit.h"
#include "vm_test.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* A field, and its value or what is to be there. */
struct set {
	size_t at, bytes;
	enum submit_thing thing;
	uint64_t value;
};

struct row {
	const char *name;
	int error;
	struct set set[3];
};

#define AT(field) offsetof(struct client_job, field), sizeof(((struct client_job *)0)->field)
/* clang-format off */
#define SET(field, value) { AT(field), VALUE, value }
#define SET_TO(field, thing) { AT(field), thing, 0 }
/* clang-format on */

static void apply(struct client_job *job, const struct row *row)
{
	for (size_t i = 0; i < COUNT(row->set) && row->set[i].bytes; i++) {
		const struct set *set = &row->set[i];
		uint64_t value = set->thing == VALUE ? set->value : submit_thing[set->thing];

		memcpy((char *)job + set->at, &value, set->bytes);
	}
}

/* Sends each; all that are answered otherwise are named. */
static void send_rows(const struct row *rows, size_t count)
{
	int wrong = 0;

	for (size_t i = 0; i < count; i++) {
		struct client_job job;
		int err;

		submit_prepare(&job);
		apply(&job, &rows[i]);
		err = client_submit(&client, &job);
		if (err != rows[i].error) {
			print_error("%s: error %d, not %d\n", rows[i].name, err, rows[i].error);
			wrong++;
		}
		if (!err && node_wait(client.fd, client.timeline, client.point, vm_patience_ms()))
			fail_msg("%s: does not end", rows[i].name);
		submit_nothing_is_left(rows[i].name);
	}
	assert_int_equal(wrong, 0);
}

static const struct row stream_rows[] = {
	{ "flags 2", -EINVAL, { SET(submit.flags, 2) } },
	{ "flags, highest", -EINVAL, { SET(submit.flags, 1u << 31) } },
	{ "priority 3", -EINVAL, { SET(submit.priority, 3) } },
	{ "priority -1", -EINVAL, { SET(submit.priority, ~0u) } },
	{ "no stream for the words", -ENOENT, { SET(submit.stream, 0) } },
	{ "stream never made", -ENOENT, { SET(submit.stream, 9999) } },
	{ "stream -1", -ENOENT, { SET(submit.stream, ~0u) } },
	{ "stream closed", -ENOENT, { SET_TO(submit.stream, CLOSED) } },
	{ "stream of another file", -ENOENT, { SET_TO(submit.stream, FOREIGN) } },
	{ "stream in board memory", -EINVAL, { SET_TO(submit.stream, BOARD) } },
	{ "stream without words", -EINVAL, { SET(submit.stream_words, 0) } },
	{ "offset of no stream",
	  -EINVAL,
	  { SET(submit.stream, 0), SET(submit.stream_words, 0),
	    SET(submit.stream_offset, NODE_PAGE) } },
	{ "stream longer than its object",
	  -EINVAL,
	  { SET(submit.stream_words, CLIENT_HOST_BYTES / 4 + 1) } },
	{ "stream of 2^30 + 1 words", -EINVAL, { SET(submit.stream_words, (1u << 30) + 1) } },
	{ "stream of 2^32 - 1 words", -EINVAL, { SET(submit.stream_words, ~0u) } },
	{ "stream offset 4", -EINVAL, { SET(submit.stream_offset, 4) } },
	{ "stream offset half a page", -EINVAL, { SET(submit.stream_offset, NODE_PAGE / 2) } },
	{ "stream behind its object", -EINVAL, { SET(submit.stream_offset, CLIENT_HOST_BYTES) } },
	{ "stream ends behind its object",
	  -EINVAL,
	  { SET(submit.stream_words, NODE_PAGE / 4 + 1),
	    SET(submit.stream_offset, CLIENT_HOST_BYTES - NODE_PAGE) } },
	{ "stream offset 2^32", -EINVAL, { SET(submit.stream_offset, 1ull << 32) } },
	{ "stream offset 2^63", -EINVAL, { SET(submit.stream_offset, 1ull << 63) } },
	{ "stream offset -4096", -EINVAL, { SET(submit.stream_offset, -4096ull) } },
};

static const struct row response_rows[] = {
	{ "no response for the words", -ENOENT, { SET(submit.response, 0) } },
	{ "response never made", -ENOENT, { SET(submit.response, 9999) } },
	{ "response closed", -ENOENT, { SET_TO(submit.response, CLOSED) } },
	{ "response of another file", -ENOENT, { SET_TO(submit.response, FOREIGN) } },
	{ "response in board memory", -EINVAL, { SET_TO(submit.response, BOARD) } },
	{ "response without words", -EINVAL, { SET(submit.response_words, 0) } },
	{ "offset of no response",
	  -EINVAL,
	  { SET(submit.response, 0), SET(submit.response_words, 0) } },
	{ "response longer than its object",
	  -EINVAL,
	  { SET(submit.response_words, CLIENT_HOST_BYTES / 4) } },
	{ "response of 2^32 - 1 words", -EINVAL, { SET(submit.response_words, ~0u) } },
	{ "response offset 4", -EINVAL, { SET(submit.response_offset, 4) } },
	{ "response behind its object",
	  -EINVAL,
	  { SET(submit.response_offset, CLIENT_HOST_BYTES) } },
	{ "response ends behind its object",
	  -EINVAL,
	  { SET(submit.response_words, NODE_PAGE / 4 + 1),
	    SET(submit.response_offset, CLIENT_HOST_BYTES - NODE_PAGE) } },
	{ "response offset 2^32", -EINVAL, { SET(submit.response_offset, 1ull << 32) } },
	{ "response offset -4096", -EINVAL, { SET(submit.response_offset, -4096ull) } },
	{ "status never made", -ENOENT, { SET(submit.status, 9999) } },
	{ "status closed", -ENOENT, { SET_TO(submit.status, CLOSED) } },
	{ "status of another file", -ENOENT, { SET_TO(submit.status, FOREIGN) } },
	{ "status in board memory", -EINVAL, { SET_TO(submit.status, BOARD) } },
	{ "offset of no status", -EINVAL, { SET(submit.status, 0) } },
	{ "status offset 8", -EINVAL, { SET(submit.status_offset, 8) } },
	{ "status behind its object", -EINVAL, { SET(submit.status_offset, CLIENT_HOST_BYTES) } },
	{ "status offset 2^32", -EINVAL, { SET(submit.status_offset, 1ull << 32) } },
	{ "status offset -16", -EINVAL, { SET(submit.status_offset, -16ull) } },
};

static const struct row slot_rows[] = {
	{ "one slot too many", -E2BIG, { SET(submit.slot_count, GLOSS_SLOTS + 1) } },
	{ "2^32 - 1 slots", -E2BIG, { SET(submit.slot_count, ~0u) } },
	{ "slot stride 0", -EINVAL, { SET(submit.slot_stride, 0) } },
	{ "slot stride too small", -EINVAL, { SET(submit.slot_stride, 23) } },
	{ "slot stride too large", -EINVAL, { SET(submit.slot_stride, 32) } },
	{ "slot stride of no slots", -EINVAL, { SET(submit.slot_count, 0) } },
	{ "slots at null", -EFAULT, { SET(submit.slots, 0) } },
	{ "slots unmapped", -EFAULT, { SET_TO(submit.slots, UNMAPPED) } },
	{ "slots end in an unmapped page", -EFAULT, { SET_TO(submit.slots, HALF_MAPPED) } },
	{ "slots in the kernel", -EFAULT, { SET(submit.slots, SUBMIT_KERNEL_ADDRESS) } },
	{ "slots at -1", -EFAULT, { SET(submit.slots, -1ull) } },
	{ "slot never made", -ENOENT, { SET(slot[0].handle, 9999) } },
	{ "slot closed", -ENOENT, { SET_TO(slot[0].handle, CLOSED) } },
	{ "slot of another file", -ENOENT, { SET_TO(slot[0].handle, FOREIGN) } },
	{ "slot in host memory", -EINVAL, { SET_TO(slot[0].handle, HOST) } },
	{ "slot without rights", -EINVAL, { SET(slot[0].rights, 0) } },
	{ "slot rights 4", -EINVAL, { SET(slot[0].rights, 4) } },
	{ "slot rights 7", -EINVAL, { SET(slot[0].rights, 7) } },
	{ "slot rights, highest", -EINVAL, { SET(slot[0].rights, 1u << 31 | 3) } },
	{ "slot offset 4", -EINVAL, { SET(slot[0].offset, 4), SET(slot[0].size, 4) } },
	{ "slot offset half a page",
	  -EINVAL,
	  { SET(slot[0].offset, NODE_PAGE / 2), SET(slot[0].size, 4) } },
	{ "slot behind its object",
	  -EINVAL,
	  { SET(slot[0].offset, SUBMIT_BOARD_BYTES), SET(slot[0].size, 4) } },
	{ "slot ends behind its object",
	  -EINVAL,
	  { SET(slot[0].offset, SUBMIT_BOARD_BYTES - NODE_PAGE),
	    SET(slot[0].size, NODE_PAGE + 4) } },
	{ "slot offset 2^32", -EINVAL, { SET(slot[0].offset, 1ull << 32), SET(slot[0].size, 4) } },
	{ "slot offset -4096",
	  -EINVAL,
	  { SET(slot[0].offset, -4096ull), SET(slot[0].size, 2 * NODE_PAGE) } },
	{ "slot size 0", -EINVAL, { SET(slot[0].size, 0) } },
	{ "slot size 2", -EINVAL, { SET(slot[0].size, 2) } },
	{ "slot size 4097", -EINVAL, { SET(slot[0].size, NODE_PAGE + 1) } },
	{ "slot larger than its object", -EINVAL, { SET(slot[0].size, SUBMIT_BOARD_BYTES + 4) } },
	{ "slot size 2^32", -EINVAL, { SET(slot[0].size, 1ull << 32) } },
	{ "slot size 2^32 + 4", -EINVAL, { SET(slot[0].size, (1ull << 32) + 4) } },
	{ "slot size -4", -EINVAL, { SET(slot[0].size, -4ull) } },
	{ "empty slot with rights", -EINVAL, { SET(slot[0].handle, 0), SET(slot[0].size, 0) } },
	{ "empty slot with a size", -EINVAL, { SET(slot[0].handle, 0), SET(slot[0].rights, 0) } },
	{ "empty slot with an offset",
	  -EINVAL,
	  { SET(submit.slot_count, 2), SET(slot[1].offset, NODE_PAGE) } },
	{ "last of 16 slots never made",
	  -ENOENT,
	  { SET(submit.slot_count, GLOSS_SLOTS), SET(slot[15].handle, 9999) } },
};

static const struct row sync_rows[] = {
	{ "one in-sync too many", -E2BIG, { SET(submit.in_sync_count, DRM_GLOSS_SYNCS_MAX + 1) } },
	{ "one out-sync too many",
	  -E2BIG,
	  { SET(submit.out_sync_count, DRM_GLOSS_SYNCS_MAX + 1) } },
	{ "2^32 - 1 in-syncs", -E2BIG, { SET(submit.in_sync_count, ~0u) } },
	{ "2^32 - 1 out-syncs", -E2BIG, { SET(submit.out_sync_count, ~0u) } },
	{ "sync stride 0", -EINVAL, { SET(submit.sync_stride, 0) } },
	{ "sync stride too small", -EINVAL, { SET(submit.sync_stride, 15) } },
	{ "sync stride too large", -EINVAL, { SET(submit.sync_stride, 24) } },
	{ "sync stride of no syncs",
	  -EINVAL,
	  { SET(submit.in_sync_count, 0), SET(submit.out_sync_count, 0) } },
	{ "in-syncs at null", -EFAULT, { SET(submit.in_syncs, 0) } },
	{ "in-syncs unmapped", -EFAULT, { SET_TO(submit.in_syncs, UNMAPPED) } },
	{ "in-syncs in the kernel", -EFAULT, { SET(submit.in_syncs, SUBMIT_KERNEL_ADDRESS) } },
	{ "out-syncs at null", -EFAULT, { SET(submit.out_syncs, 0) } },
	{ "out-syncs unmapped", -EFAULT, { SET_TO(submit.out_syncs, UNMAPPED) } },
	{ "out-syncs end in an unmapped page", -EFAULT, { SET_TO(submit.out_syncs, HALF_MAPPED) } },
	{ "in-sync 0", -ENOENT, { SET(in[0].handle, 0) } },
	{ "in-sync never made", -ENOENT, { SET(in[0].handle, 9999) } },
	{ "in-sync closed", -ENOENT, { SET_TO(in[0].handle, SYNC_CLOSED) } },
	{ "in-sync of another file", -ENOENT, { SET_TO(in[0].handle, SYNC_FOREIGN) } },
	{ "in-sync without a fence", -EINVAL, { SET_TO(in[0].handle, FRESH) } },
	{ "in-sync flag 2", -EINVAL, { SET(in[0].flags, 2) } },
	{ "in-sync flags, highest", -EINVAL, { SET(in[0].flags, 1u << 31) } },
	{ "in-sync with a point and no timeline", -EINVAL, { SET(in[0].point, 1) } },
	{ "in-sync timeline, point 0", -EINVAL, { SET(in[0].flags, DRM_GLOSS_SYNC_TIMELINE) } },
	{ "in-sync timeline without such a point",
	  -EINVAL,
	  { SET_TO(in[0].handle, FRESH), SET(in[0].flags, DRM_GLOSS_SYNC_TIMELINE),
	    SET(in[0].point, 7) } },
	{ "out-sync 0", -ENOENT, { SET(out[0].handle, 0) } },
	{ "out-sync never made", -ENOENT, { SET(out[0].handle, 9999) } },
	{ "out-sync closed", -ENOENT, { SET_TO(out[0].handle, SYNC_CLOSED) } },
	{ "last out-sync closed", -ENOENT, { SET_TO(out[1].handle, SYNC_CLOSED) } },
	{ "out-sync of another file", -ENOENT, { SET_TO(out[0].handle, SYNC_FOREIGN) } },
	{ "out-sync flag 2", -EINVAL, { SET(out[0].flags, 2) } },
	{ "out-sync with a point and no timeline", -EINVAL, { SET(out[0].point, 1) } },
	{ "out-sync timeline, point 0", -EINVAL, { SET(out[1].point, 0) } },
};

/* The last that are still right. */
static const struct row right_rows[] = {
	{ "explicit sync", 0, { SET(submit.flags, DRM_GLOSS_SUBMIT_EXPLICIT_SYNC) } },
	{ "priority low", 0, { SET(submit.priority, DRM_GLOSS_PRIORITY_LOW) } },
	{ "stream at its object's end",
	  0,
	  { SET(submit.stream_words, NODE_PAGE / 4),
	    SET(submit.stream_offset, CLIENT_HOST_BYTES - NODE_PAGE) } },
	{ "response at its object's end",
	  0,
	  { SET(submit.response_words, NODE_PAGE / 4),
	    SET(submit.response_offset, CLIENT_HOST_BYTES - NODE_PAGE) } },
	{ "response of one word more than a page", 0, { SET(submit.response_words, 1025) } },
	{ "status at its object's end", 0, { SET(submit.status_offset, CLIENT_HOST_BYTES - 16) } },
	{ "no status", 0, { SET(submit.status, 0), SET(submit.status_offset, 0) } },
	{ "slot at its object's end",
	  0,
	  { SET(slot[0].offset, SUBMIT_BOARD_BYTES - NODE_PAGE), SET(slot[0].size, NODE_PAGE) } },
	{ "slot of one word", 0, { SET(slot[0].size, 4) } },
	{ "slot only read", 0, { SET(slot[0].rights, DRM_GLOSS_SLOT_READ) } },
	{ "slot only written", 0, { SET(slot[0].rights, DRM_GLOSS_SLOT_WRITE) } },
	{ "empty slots up to the last", 0, { SET(submit.slot_count, GLOSS_SLOTS) } },
	{ "no slots, pointer ignored",
	  0,
	  { SET(submit.slot_count, 0), SET(submit.slot_stride, 0), SET(submit.slots, 1) } },
	{ "no in-syncs, pointer ignored",
	  0,
	  { SET(submit.in_sync_count, 0), SET(submit.in_syncs, 1) } },
	{ "one in-sync twice",
	  0,
	  { SET(submit.in_sync_count, 2), SET_TO(in[1].handle, SIGNALLED) } },
};

static void a_bad_stream_is_refused(void **state)
{
	(void)state;
	send_rows(stream_rows, COUNT(stream_rows));
}

static void a_bad_response_or_status_is_refused(void **state)
{
	(void)state;
	send_rows(response_rows, COUNT(response_rows));
}

static void a_bad_slot_is_refused(void **state)
{
	(void)state;
	send_rows(slot_rows, COUNT(slot_rows));
}

static void a_bad_sync_is_refused(void **state)
{
	(void)state;
	send_rows(sync_rows, COUNT(sync_rows));
}

static void what_is_just_right_is_taken(void **state)
{
	(void)state;
	send_rows(right_rows, COUNT(right_rows));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_bad_stream_is_refused),
		cmocka_unit_test(a_bad_response_or_status_is_refused),
		cmocka_unit_test(a_bad_slot_is_refused),
		cmocka_unit_test(a_bad_sync_is_refused),
		cmocka_unit_test(what_is_just_right_is_taken),
	};

	return cmocka_run_group_tests(tests, submit_setup, submit_teardown);
}
