/* SPDX-License-Identifier: MIT */
/* A job for the kernel: one host object with its status, its stream and room for its response. */
#ifndef ACCEL_DRM_JOB_H
#define ACCEL_DRM_JOB_H

#include "transport/drm/buffer.h"
#include "transport/job_table.h"
#include "transport/transport.h"

/* Where things are in a job's host object: the stream follows the status, then the response. */
#define DRM_STATUS_OFFSET 0
#define DRM_STREAM_OFFSET 4096u

struct accel_drm_job {
	struct accel_job_entry entry; /* first, so that an entry is its job */
	struct accel_drm_buffer *buffer;
	uint64_t response_offset; /* in the buffer */
	uint32_t *response;       /* the caller's */
	uint32_t response_words;
};

/* A job with its stream in a buffer of @pool. -ENOMEM, or as accel_pool_get. */
int accel_drm_job_new(struct accel_pool *pool, const struct accel_transport_job *from,
		      struct accel_drm_job **job);
/* What became of a job that has ended; its response goes to its caller. -EIO, -ENODEV, -ETIME. */
int accel_drm_job_result(const struct accel_drm_job *job, struct gloss_status *status);

#endif
