/* SPDX-License-Identifier: GPL-2.0-only */
/*
 * Tracepoints of a job's life. A job is known by its scheduler fence, context and
 * number, from gloss_submit on, and by its sequence while the board has it. The
 * client is what drm-client-id of /proc/.../fdinfo says; 0: the driver's own job.
 */
#undef TRACE_SYSTEM
#define TRACE_SYSTEM gloss

#if !defined(GLOSS_TRACE_H) || defined(TRACE_HEADER_MULTI_READ)
#define GLOSS_TRACE_H

#include <linux/tracepoint.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

DECLARE_EVENT_CLASS(gloss_job,
	TP_PROTO(const struct gloss_job *job),
	TP_ARGS(job),
	TP_STRUCT__entry(
		__field(int, node)
		__field(u64, client)
		__field(u64, context)
		__field(u64, number)
		__field(u32, sequence)
		__field(u32, stream_words)
	),
	TP_fast_assign(
		__entry->node = job->gdev->drm.render->index;
		__entry->client = gloss_file_client(job->file);
		__entry->context = job->base.s_fence->finished.context;
		__entry->number = job->base.s_fence->finished.seqno;
		__entry->sequence = job->sequence;
		__entry->stream_words = job->stream_words;
	),
	TP_printk("renderD%d client=%llu fence=%llu:%llu sequence=%u stream_words=%u",
		  __entry->node, __entry->client, __entry->context, __entry->number,
		  __entry->sequence, __entry->stream_words)
);

/* The scheduler has got a job. */
DEFINE_EVENT(gloss_job, gloss_submit,
	TP_PROTO(const struct gloss_job *job),
	TP_ARGS(job)
);

/* The board has got a job. */
DEFINE_EVENT(gloss_job, gloss_run,
	TP_PROTO(const struct gloss_job *job),
	TP_ARGS(job)
);

DECLARE_EVENT_CLASS(gloss_end,
	TP_PROTO(const struct gloss_job *job, const struct drm_gloss_status *status),
	TP_ARGS(job, status),
	TP_STRUCT__entry(
		__field(int, node)
		__field(u64, client)
		__field(u64, context)
		__field(u64, number)
		__field(u32, sequence)
		__field(s32, error)
		__field(u32, cause)
		__field(u32, offset)
		__field(u32, response_words)
	),
	TP_fast_assign(
		__entry->node = job->gdev->drm.render->index;
		__entry->client = gloss_file_client(job->file);
		__entry->context = job->base.s_fence->finished.context;
		__entry->number = job->base.s_fence->finished.seqno;
		__entry->sequence = job->sequence;
		__entry->error = status->error;
		__entry->cause = status->cause;
		__entry->offset = status->offset;
		__entry->response_words = status->response_words;
	),
	TP_printk("renderD%d client=%llu fence=%llu:%llu sequence=%u error=%d cause=%u offset=%u response_words=%u",
		  __entry->node, __entry->client, __entry->context, __entry->number,
		  __entry->sequence, __entry->error, __entry->cause, __entry->offset,
		  __entry->response_words)
);

/* A job has ended, in whatever way. */
DEFINE_EVENT(gloss_end, gloss_done,
	TP_PROTO(const struct gloss_job *job, const struct drm_gloss_status *status),
	TP_ARGS(job, status)
);

/* It has, and badly: error or cause is not zero. */
DEFINE_EVENT(gloss_end, gloss_fault,
	TP_PROTO(const struct gloss_job *job, const struct drm_gloss_status *status),
	TP_ARGS(job, status)
);

/* The board is reset, because of the job with this sequence. */
TRACE_EVENT(gloss_reset,
	TP_PROTO(const struct gloss_device *gdev, const struct gloss_job *guilty),
	TP_ARGS(gdev, guilty),
	TP_STRUCT__entry(
		__field(int, node)
		__field(u64, client)
		__field(u32, sequence)
	),
	TP_fast_assign(
		__entry->node = gdev->drm.render->index;
		__entry->client = guilty ? gloss_file_client(guilty->file) : 0;
		__entry->sequence = guilty ? guilty->sequence : 0;
	),
	TP_printk("renderD%d client=%llu sequence=%u",
		  __entry->node, __entry->client, __entry->sequence)
);

#endif

#undef TRACE_INCLUDE_PATH
#undef TRACE_INCLUDE_FILE
#define TRACE_INCLUDE_PATH .
#define TRACE_INCLUDE_FILE gloss_trace
#include <trace/define_trace.h>
