// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "gloss_drm.h"
#include "transport/drm/job.h"

#define PAGE 4096u

static uint64_t job_page_align(uint64_t bytes)
{
	return (bytes + PAGE - 1) / PAGE * PAGE;
}

/* The stream goes to the job's buffer, and a status in case the kernel gives none. */
static void job_fill(const struct accel_drm_job *job, const struct accel_transport_job *from)
{
	const struct drm_gloss_status lost = { .error = -EIO };
	uint8_t *map = job->buffer->map;

	memcpy(map + DRM_STATUS_OFFSET, &lost, sizeof(lost));
	accel_transport_copy(from, map + DRM_STREAM_OFFSET);
}

int accel_drm_job_new(struct accel_pool *pool, const struct accel_transport_job *from,
		      struct accel_drm_job **out)
{
	struct accel_drm_job *job = malloc(sizeof(*job));
	struct accel_pool_buffer *buffer;
	int err;

	if (!job)
		return -ENOMEM;
	*job = (struct accel_drm_job){
		.response_offset = DRM_STREAM_OFFSET +
				   job_page_align(4 * (uint64_t)from->stream_words),
		.response = from->response,
		.response_words = from->response_words,
	};
	err = accel_pool_get(pool, job->response_offset + 4 * (uint64_t)from->response_words,
			     &buffer);
	if (err) {
		free(job);
		return err;
	}
	job->buffer = (struct accel_drm_buffer *)buffer;
	job_fill(job, from);
	*out = job;
	return 0;
}

/* What a job's @error in its status is to who waits for it. */
static int job_error(int error)
{
	switch (error) {
	case -ENODEV:
	case -ECANCELED:
		return -ENODEV;
	case -ETIME:
		return error;
	default:
		return -EIO;
	}
}

int accel_drm_job_result(const struct accel_drm_job *job, struct gloss_status *status)
{
	const uint8_t *map = job->buffer->map;
	struct drm_gloss_status ended;
	uint32_t words;

	memcpy(&ended, map + DRM_STATUS_OFFSET, sizeof(ended));
	if (ended.error)
		return job_error(ended.error);
	words = ended.response_words < job->response_words ? ended.response_words :
							     job->response_words;
	*status = (struct gloss_status){
		.cause = (enum gloss_fault)ended.cause,
		.offset = ended.offset,
		.response_words = words,
	};
	if (words)
		memcpy(job->response, map + job->response_offset, (size_t)words * sizeof(uint32_t));
	return 0;
}
