/* SPDX-License-Identifier: MIT */
/* What is left of a job when an ioctl of "drm:" fails, and what the caller is told. */
#define _GNU_SOURCE
#include "drm_test.h"

/* A life with every call; its first error. */
static int live(void *state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_WRITE };
	uint32_t stream[4], response;
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_write(stream, 0, 0, 3),
		.response = &response,
		.response_words = 1,
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	uint64_t sequence;
	int err;

	err = ops->memory_new(state, 4096, &slot.object);
	if (err)
		return err;
	err = ops->submit(state, &job, &sequence);
	if (!err)
		err = ops->wait(state, sequence, -1, &status);
	ops->memory_free(state, slot.object);
	return err;
}

static void fail_one(void **state, unsigned int request, unsigned int at, int error, int answer)
{
	ops->close(*state);
	assert_int_equal(fake_gloss.left, 0);
	fake_gloss_stop();
	assert_int_equal(drm_setup(state), 0);
	fake_gloss.fail_request = request;
	fake_gloss.fail_errno = error;
	fake_gloss.fail_at = at;
	if (live(*state) != answer)
		fail_msg("call %u of ioctl %#x failed with %s, and the answer was not %s", at,
			 request, strerrorname_np(error), strerrorname_np(-answer));
	assert_int_equal(fake_gloss.fail_at, 0);
	assert_int_equal(live(*state), 0);
}

static void every_answer_of_every_ioctl_is_told(void **state)
{
	static const struct {
		int error, answer;
	} errors[] = {
		{ EINTR, 0 },        { EAGAIN, 0 },       { ENOMEM, -ENOMEM }, { ENODEV, -ENODEV },
		{ EINVAL, -EINVAL }, { ENOENT, -EINVAL }, { ENOSPC, -ENOMEM }, { EFAULT, -EIO },
		{ EACCES, -EIO },    { E2BIG, -EIO },
	};
	/* The first object is in board memory, the second in host memory. */
	static const struct {
		unsigned int number, at;
	} calls[] = {
		{ GLOSS(GEM_CREATE), 1 },
		{ GLOSS(GEM_CREATE), 2 },
		{ GLOSS(GEM_MMAP_OFFSET), 1 },
		{ GLOSS(SUBMIT), 1 },
		{ _IOC_NR(DRM_IOCTL_SYNCOBJ_TIMELINE_WAIT), 1 },
	};

	for (size_t i = 0; i < sizeof(errors) / sizeof(errors[0]); i++)
		for (size_t j = 0; j < sizeof(calls) / sizeof(calls[0]); j++)
			fail_one(state, calls[j].number, calls[j].at, errors[i].error,
				 errors[i].answer);
}

static void a_job_that_the_kernel_refused_has_no_number(void **state)
{
	uint64_t sequence, first = submit_empty(*state);
	const struct accel_transport_job job = { .stream_words = 0 };
	struct gloss_status status;

	fake_gloss.fail_request = GLOSS(SUBMIT);
	fake_gloss.fail_errno = ENOMEM;
	fake_gloss.fail_at = 1;
	assert_int_equal(ops->submit(*state, &job, &sequence), -ENOMEM);
	assert_int_equal(submit_empty(*state), first + 1);
	assert_int_equal(wait_for(*state, first, &status), 0);
	assert_int_equal(wait_for(*state, first + 1, &status), 0);
}

/* The kernel may still write to it, so it is not for another job. */
static void the_memory_of_a_job_whose_wait_failed_is_not_used_again(void **state)
{
	struct gloss_status status;
	uint64_t sequence;

	fake_gloss_hold();
	sequence = submit_empty(*state);
	fake_gloss.fail_request = _IOC_NR(DRM_IOCTL_SYNCOBJ_TIMELINE_WAIT);
	fake_gloss.fail_errno = ENOMEM;
	fake_gloss.fail_at = 1;
	assert_int_equal(wait_for(*state, sequence, &status), -ENOMEM);
	assert_int_equal(fake_gloss.handles, 0);
	fake_gloss_release();
	run_empty(*state);
	assert_int_equal(fake_gloss.creates, 2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		drm_test(every_answer_of_every_ioctl_is_told),
		drm_test(a_job_that_the_kernel_refused_has_no_number),
		drm_test(the_memory_of_a_job_whose_wait_failed_is_not_used_again),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
