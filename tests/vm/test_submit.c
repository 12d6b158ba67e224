// SPDX-License-Identifier: MIT
/*
 * What SUBMIT does with jobs: pointers, privileges, jobs that are empty, faulty or as large as they
 * may be, and objects that are closed while their jobs wait.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vm_submit.h"
#include "vm_test.h"

static void a_bad_pointer_to_the_submission_is_refused(void **state)
{
	(void)state;
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT, NULL), -EFAULT);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT,
				    (void *)(uintptr_t)submit_thing[UNMAPPED]),
			 -EFAULT);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT,
				    (void *)(uintptr_t)submit_thing[HALF_MAPPED]),
			 -EFAULT);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GLOSS_SUBMIT,
				    (void *)SUBMIT_KERNEL_ADDRESS),
			 -EFAULT);
	submit_nothing_is_left("a bad pointer");
}

static void pointers_need_no_alignment(void **state)
{
	static char slots[sizeof(struct drm_gloss_slot) + 1], in[sizeof(struct drm_gloss_sync) + 1];
	struct client_job job;

	(void)state;
	submit_prepare(&job);
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
	submit_prepare(&job);
	job.submit.priority = DRM_GLOSS_PRIORITY_HIGH;
	err = client_submit(&client, &job);
	assert_int_equal(err, geteuid() ? -EACCES : 0);
	if (!err)
		assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	submit_nothing_is_left("high priority");
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
	submit_nothing_is_left("zeros");
}

static void one_object_may_be_all_slots_and_buffers(void **state)
{
	struct client_job job;

	(void)state;
	submit_prepare(&job);
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
	submit_prepare(&job);
	for (uint32_t i = 0; i < DRM_GLOSS_SYNCS_MAX; i++) {
		in[i] = job.in[0];
		out[i] = job.out[i < DRM_GLOSS_SYNCS_MAX - 1 ? 0 : 1];
	}
	job.submit.in_syncs = (uintptr_t)in;
	job.submit.out_syncs = (uintptr_t)out;
	job.submit.in_sync_count = job.submit.out_sync_count = DRM_GLOSS_SYNCS_MAX;
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	submit_nothing_is_left("most syncs");
}

/* A refused job must not have touched its out-syncs: nothing of it happens. */
static void a_refused_job_leaves_its_syncs_alone(void **state)
{
	struct client_job job;

	(void)state;
	assert_int_equal(client_run(&client, 0, 0), 0);
	submit_prepare(&job);
	job.out[0].handle = (uint32_t)submit_thing[FRESH];
	job.submit.status_offset = 8;
	assert_int_equal(client_submit(&client, &job), -EINVAL);
	assert_int_equal(node_wait(client.fd, (uint32_t)submit_thing[FRESH], 0, 0), -EINVAL);
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
	submit_nothing_is_left("a faulty stream");
}

/* Jobs keep what they name: handles may be closed and maps removed while they wait. */
static void closed_objects_live_until_their_jobs_end(void **state)
{
	struct client brief;
	struct client_job job;
	uint32_t sync;

	(void)state;
	assert_int_equal(client_open(&brief, vm_env("GLOSS_NODE_MODEL"), SUBMIT_BOARD_BYTES), 0);
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

int main(void)
{
	const struct CMUnitTest tests[] = {
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

	return cmocka_run_group_tests(tests, submit_setup, submit_teardown);
}
