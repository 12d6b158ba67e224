// SPDX-License-Identifier: MIT
/*
 * SUBMIT with one thing wrong at a time: the error is the one gloss_drm.h promises, nothing
 * is left behind, and the next job runs.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vm_test.h"
#include "gloss_node.h"

#define BOARD_BYTES (4 * NODE_PAGE)
#define KERNEL_ADDRESS 0xffff888000001000
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static struct client client, other;

/* What a row puts into a field: its value, or one of these. */
enum thing {
	VALUE,
	HOST,
	BOARD,
	CLOSED,
	FOREIGN,
	SIGNALLED,
	FRESH,
	SYNC_CLOSED,
	SYNC_FOREIGN,
	UNMAPPED,
	HALF_MAPPED,
	THINGS
};

static uint64_t thing[THINGS];
static uint32_t next_handle, next_sync;
static uint64_t board_free;

/* ---- a right job, in which all that is optional is there ---- */

static void prepare(struct client_job *job)
{
	const uint32_t value = 0x600d;
	uint32_t words = node_write(client.stream, 0, 0, &value, 1);

	words += node_read(client.stream + words, 0, 0, 1);
	client_prepare(&client, job, words, 1);
	job->submit.in_sync_count = 1;
	job->in[0].handle = (uint32_t)thing[SIGNALLED];
}

/* Handles are given out from below: what a refused job had left would take this one's place. */
static uint32_t probe_handle(void)
{
	uint32_t handle;

	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &handle), 0);
	assert_int_equal(node_destroy(client.fd, handle), 0);
	return handle;
}

static uint32_t probe_sync(void)
{
	uint32_t sync;

	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	assert_int_equal(drmSyncobjDestroy(client.fd, sync), 0);
	return sync;
}

static void nothing_is_left(const char *name)
{
	if (!client_works(&client))
		fail_msg("%s: the next job did not run", name);
	if (probe_handle() != next_handle || probe_sync() != next_sync)
		fail_msg("%s: a handle is left", name);
}

/* ---- rows ---- */

struct set {
	size_t at, bytes;
	enum thing thing;
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
		uint64_t value = set->thing == VALUE ? set->value : thing[set->thing];

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

		prepare(&job);
		apply(&job, &rows[i]);
		err = client_submit(&client, &job);
		if (err != rows[i].error) {
			print_error("%s: error %d, not %d\n", rows[i].name, err, rows[i].error);
			wrong++;
		}
		if (!err && node_wait(client.fd, client.timeline, client.point, vm_patience_ms()))
			fail_msg("%s: does not end", rows[i].name);
		nothing_is_left(rows[i].name);
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
	{ "slots in the kernel", -EFAULT, { SET(submit.slots, KERNEL_ADDRESS) } },
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
	  { SET(slot[0].offset, BOARD_BYTES), SET(slot[0].size, 4) } },
	{ "slot ends behind its object",
	  -EINVAL,
	  { SET(slot[0].offset, BOARD_BYTES - NODE_PAGE), SET(slot[0].size, NODE_PAGE + 4) } },
	{ "slot offset 2^32", -EINVAL, { SET(slot[0].offset, 1ull << 32), SET(slot[0].size, 4) } },
	{ "slot offset -4096",
	  -EINVAL,
	  { SET(slot[0].offset, -4096ull), SET(slot[0].size, 2 * NODE_PAGE) } },
	{ "slot size 0", -EINVAL, { SET(slot[0].size, 0) } },
	{ "slot size 2", -EINVAL, { SET(slot[0].size, 2) } },
	{ "slot size 4097", -EINVAL, { SET(slot[0].size, NODE_PAGE + 1) } },
	{ "slot larger than its object", -EINVAL, { SET(slot[0].size, BOARD_BYTES + 4) } },
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
	{ "in-syncs in the kernel", -EFAULT, { SET(submit.in_syncs, KERNEL_ADDRESS) } },
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
	  { SET(slot[0].offset, BOARD_BYTES - NODE_PAGE), SET(slot[0].size, NODE_PAGE) } },
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

/* ---- what a row can not say ---- */

static void a_bad_pointer_to_the_submission_is_refused(void **state)
{
	(void)state;
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT, NULL), -EFAULT);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT,
				    (void *)(uintptr_t)thing[UNMAPPED]),
			 -EFAULT);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT,
				    (void *)(uintptr_t)thing[HALF_MAPPED]),
			 -EFAULT);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT, (void *)KERNEL_ADDRESS),
			 -EFAULT);
	nothing_is_left("a bad pointer");
}

static void pointers_need_no_alignment(void **state)
{
	static char slots[sizeof(struct drm_gloss_slot) + 1], in[sizeof(struct drm_gloss_sync) + 1];
	struct client_job job;

	(void)state;
	prepare(&job);
	memcpy(slots + 1, &job.slot[0], sizeof(job.slot[0]));
	memcpy(in + 1, &job.in[0], sizeof(job.in[0]));
	job.submit.slots = (uintptr_t)slots + 1;
	job.submit.in_syncs = (uintptr_t)in + 1;
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	assert_int_equal(client.response[0], 0x600d);
}

static void high_priority_takes_a_privilege(void **state)
{
	struct client_job job;
	int err;

	(void)state;
	prepare(&job);
	job.submit.priority = DRM_GLOSS_PRIORITY_HIGH;
	err = client_submit(&client, &job);
	assert_int_equal(err, geteuid() ? -EACCES : 0);
	if (!err)
		assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	nothing_is_left("high priority");
}

static void an_empty_job_ends(void **state)
{
	(void)state;
	assert_int_equal(client_run(&client, 0, 0), 0);
	assert_int_equal(client.status->error, 0);
	assert_int_equal(client.status->cause, 0);
	assert_int_equal(client.status->offset, 0);
	assert_int_equal(client.status->response_words, 0);
}

static void a_submission_of_zeros_is_a_job(void **state)
{
	const struct drm_gloss_submit zero = { 0 };

	(void)state;
	assert_int_equal(node_submit(client.fd, &zero), 0);
	nothing_is_left("zeros");
}

static void one_object_may_be_all_slots_and_buffers(void **state)
{
	struct client_job job;

	(void)state;
	prepare(&job);
	for (uint32_t i = 1; i < GLOSS_SLOTS; i++)
		job.slot[i] = job.slot[0];
	job.submit.slot_count = GLOSS_SLOTS;
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	assert_int_equal(client.response[0], 0x600d);
}

/* As many syncs as there may be, all the same one on each side. */
static void most_syncs_are_taken(void **state)
{
	static struct drm_gloss_sync in[DRM_GLOSS_SYNCS_MAX], out[DRM_GLOSS_SYNCS_MAX];
	struct client_job job;

	(void)state;
	prepare(&job);
	for (uint32_t i = 0; i < DRM_GLOSS_SYNCS_MAX; i++) {
		in[i] = job.in[0];
		out[i] = job.out[i < DRM_GLOSS_SYNCS_MAX - 1 ? 0 : 1];
	}
	job.submit.in_syncs = (uintptr_t)in;
	job.submit.out_syncs = (uintptr_t)out;
	job.submit.in_sync_count = job.submit.out_sync_count = DRM_GLOSS_SYNCS_MAX;
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	nothing_is_left("most syncs");
}

/* A refused job must not have touched its out-syncs: nothing of it happens. */
static void a_refused_job_leaves_its_syncs_alone(void **state)
{
	struct client_job job;

	(void)state;
	assert_int_equal(client_run(&client, 0, 0), 0);
	prepare(&job);
	job.out[0].handle = (uint32_t)thing[FRESH];
	job.submit.status_offset = 8;
	assert_int_equal(client_submit(&client, &job), -EINVAL);
	assert_int_equal(node_wait(client.fd, (uint32_t)thing[FRESH], 0, 0), -EINVAL);
}

/* The fault of a stream is told in words, and its fence has an error. */
static void a_faulty_stream_is_told_of(void **state)
{
	(void)state;
	client.stream[0] = 0;
	client.stream[1] = 0xff000000;
	assert_int_equal(client_run(&client, 2, 0), -EIO);
	assert_int_equal(client.status->error, 0);
	assert_int_equal(client.status->cause, GLOSS_FAULT_OPCODE);
	assert_int_equal(client.status->offset, 1);
	assert_int_equal(client.status->response_words, 0);
	nothing_is_left("a faulty stream");
}

/* Jobs keep what they name: handles may be closed and maps removed while they wait. */
static void closed_objects_live_until_their_jobs_end(void **state)
{
	struct client brief;
	struct client_job job;
	uint32_t sync;

	(void)state;
	assert_int_equal(client_open(&brief, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES), 0);
	brief.stream[0] = 0;
	for (int i = 0; i < 50; i++) {
		client_prepare(&brief, &job, CLIENT_STREAM_WORDS, 0);
		assert_int_equal(client_submit(&brief, &job), 0);
	}
	assert_int_equal(node_destroy(brief.fd, brief.host.handle), 0);
	assert_int_equal(node_destroy(brief.fd, brief.board), 0);
	assert_int_equal(node_wait(brief.fd, brief.timeline, brief.point, vm_patience_ms()), 0);
	assert_int_equal(brief.status->error, 0);
	assert_int_equal(brief.status->offset, CLIENT_STREAM_WORDS);
	assert_int_equal(node_sync_new(brief.fd, &sync), 0);
	munmap(brief.host.map, brief.host.size);
	close(brief.fd);
}

/* ---- set up ---- */

/* Bytes of board memory that are free in one piece. */
static uint64_t largest_board_object(int fd)
{
	uint64_t size, best = 0, step;
	uint32_t handle;

	assert_int_equal(node_param(fd, DRM_GLOSS_PARAM_MEMORY_SIZE, &size), 0);
	for (step = size; step >= NODE_PAGE; step /= 2) {
		if (best + step > size ||
		    node_create(fd, DRM_GLOSS_GEM_BOARD, best + step, &handle))
			continue;
		best += step;
		assert_int_equal(node_destroy(fd, handle), 0);
	}
	return best;
}

static void make_addresses(void)
{
	char *pages = mmap(NULL, 2 * NODE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS,
			   -1, 0);

	assert_ptr_not_equal(pages, MAP_FAILED);
	munmap(pages + NODE_PAGE, NODE_PAGE);
	thing[UNMAPPED] = (uintptr_t)pages + NODE_PAGE;
	thing[HALF_MAPPED] = (uintptr_t)pages + NODE_PAGE - 8;
}

static void make_syncs(void)
{
	uint32_t sync;

	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	assert_int_equal(drmSyncobjSignal(client.fd, &sync, 1), 0);
	thing[SIGNALLED] = sync;
	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	thing[FRESH] = sync;
	for (int i = 0; i < 40; i++)
		assert_int_equal(node_sync_new(other.fd, &sync), 0);
	thing[SYNC_FOREIGN] = sync;
	assert_int_equal(node_sync_new(client.fd, &sync), 0);
	assert_int_equal(drmSyncobjDestroy(client.fd, sync), 0);
	thing[SYNC_CLOSED] = sync;
}

static void make_handles(void)
{
	uint32_t handle;

	thing[HOST] = client.host.handle;
	thing[BOARD] = client.board;
	for (int i = 0; i < 40; i++)
		assert_int_equal(node_create(other.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &handle), 0);
	thing[FOREIGN] = handle;
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &handle), 0);
	assert_int_equal(node_destroy(client.fd, handle), 0);
	thing[CLOSED] = handle;
}

static int setup(void **state)
{
	(void)state;
	assert_int_equal(client_open(&other, vm_env("GLOSS_NODE_MODEL"), 0), 0);
	board_free = largest_board_object(other.fd);
	assert_int_equal(client_open(&client, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES), 0);
	make_addresses();
	make_syncs();
	make_handles();
	next_handle = probe_handle();
	next_sync = probe_sync();
	assert_true(client_works(&client));
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	client_close(&client);
	assert_int_equal(largest_board_object(other.fd), board_free);
	client_close(&other);
	return 0;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_bad_stream_is_refused),
		cmocka_unit_test(a_bad_response_or_status_is_refused),
		cmocka_unit_test(a_bad_slot_is_refused),
		cmocka_unit_test(a_bad_sync_is_refused),
		cmocka_unit_test(what_is_just_right_is_taken),
		cmocka_unit_test(a_bad_pointer_to_the_submission_is_refused),
		cmocka_unit_test(pointers_need_no_alignment),
		cmocka_unit_test(high_priority_takes_a_privilege),
		cmocka_unit_test(an_empty_job_ends),
		cmocka_unit_test(a_submission_of_zeros_is_a_job),
		cmocka_unit_test(one_object_may_be_all_slots_and_buffers),
		cmocka_unit_test(most_syncs_are_taken),
		cmocka_unit_test(a_refused_job_leaves_its_syncs_alone),
		cmocka_unit_test(a_faulty_stream_is_told_of),
		cmocka_unit_test(closed_objects_live_until_their_jobs_end),
	};

	return cmocka_run_group_tests(tests, setup, teardown);
}
