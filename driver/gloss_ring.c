// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: The ring
 *
 * Jobs that the board has. It takes them in order, one at a time, from descriptors in
 * coherent memory; for each it writes a completion record there and then interrupts.
 * So in good times the driver writes one register for a job, and reads none.
 *
 * A record belongs to a job if it has the job's sequence number; else it is an older one.
 * These numbers go on counting through resets, and a job that is run again gets a new one.
 * None is zero, as that is what fresh memory has.
 */
#include <drm/drm_managed.h>
#include <linux/bitfield.h>
#include <linux/dma-mapping.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"
#include "gloss_trace.h"

int gloss_ring_init(struct gloss_device *gdev)
{
	struct gloss_ring *ring = &gdev->ring;

	int ret;

	ret = drmm_mutex_init(&gdev->drm, &ring->push_lock);
	if (ret)
		return ret;

	spin_lock_init(&ring->lock);
	spin_lock_init(&ring->fence_lock);
	INIT_LIST_HEAD(&ring->list);
	ring->fence_context = dma_fence_context_alloc(1);
	ring->shared = dmam_alloc_coherent(gdev->drm.dev, sizeof(*ring->shared), &ring->address,
					   GFP_KERNEL);
	return ring->shared ? 0 : -ENOMEM;
}

static void gloss_ring_put_address(__le32 *low, u64 address)
{
	low[0] = cpu_to_le32(lower_32_bits(address));
	low[1] = cpu_to_le32(upper_32_bits(address));
}

static void gloss_ring_put_slots(struct gloss_ring *ring, unsigned int entry,
				 const struct gloss_job *job)
{
	unsigned int i;

	for (i = 0; i < GLOSS_SLOTS; i++) {
		__le32 *word = ring->shared->slot[entry][i];

		word[GLOSS_SLOT_ENTRY_BASE_WORD] = cpu_to_le32(job->slot[i].base);
		word[GLOSS_SLOT_ENTRY_SIZE_WORD] = cpu_to_le32(job->slot[i].size);
		word[GLOSS_SLOT_ENTRY_RIGHTS_WORD] = cpu_to_le32(job->slot[i].rights);
	}
}

/* A job that must not run is an empty one to the board, so that it ends in its turn. */
static void gloss_ring_put(struct gloss_ring *ring, unsigned int entry,
			   const struct gloss_job *job)
{
	__le32 *word = ring->shared->descriptor[entry];

	memset(word, 0, sizeof(ring->shared->descriptor[entry]));
	word[GLOSS_JOB_DESCRIPTOR_SEQUENCE_WORD] = cpu_to_le32(job->sequence);
	gloss_ring_put_address(&word[GLOSS_JOB_DESCRIPTOR_SLOT_TABLE_LOW_WORD],
			       gloss_ring_address(ring, ring->shared->slot[entry]));
	gloss_ring_put_slots(ring, entry, job);
	if (job->refused)
		return;

	word[GLOSS_JOB_DESCRIPTOR_STREAM_WORDS_WORD] = cpu_to_le32(job->stream_words);
	gloss_ring_put_address(&word[GLOSS_JOB_DESCRIPTOR_STREAM_LIST_LOW_WORD],
			       job->stream_list);
	word[GLOSS_JOB_DESCRIPTOR_RESPONSE_WORDS_WORD] = cpu_to_le32(job->response_words);
	gloss_ring_put_address(&word[GLOSS_JOB_DESCRIPTOR_RESPONSE_LIST_LOW_WORD],
			       job->response_list);
}

/* Writes the job's descriptor; the board does not look before it is told the new tail. */
static void gloss_ring_add(struct gloss_ring *ring, struct gloss_job *job)
{
	int refusal;

	if (!++ring->sequence)
		ring->sequence++;
	job->sequence = ring->sequence;
	refusal = job->refused ? 0 : gloss_job_refusal(job);
	if (refusal)
		gloss_job_refuse(job, refusal);
	job->state = GLOSS_JOB_RUNNING;
	job->begun = ktime_get();
	gloss_ring_put(ring, ring->tail % GLOSS_RING_ENTRIES, job);
	ring->tail++;
	trace_gloss_run(job);
}

static void gloss_ring_tell_tail(struct gloss_device *gdev)
{
	lockdep_assert_held(&gdev->ring.push_lock);
	gloss_write(gdev, GLOSS_REG_TAIL, FIELD_PREP(GLOSS_REG_TAIL_JOBS, gdev->ring.tail));
}

/* Gives the board a job; while it sleeps, when it wakes up. Ends it if the board has gone. */
void gloss_ring_push(struct gloss_device *gdev, struct gloss_job *job)
{
	const struct drm_gloss_status gone = { .error = -ENODEV };
	struct gloss_ring *ring = &gdev->ring;
	unsigned long flags;
	bool added;

	mutex_lock(&ring->push_lock);
	spin_lock_irqsave(&ring->lock, flags);
	added = !gloss_device_gone(gdev);
	if (added) {
		if (list_empty(&ring->list))
			gloss_clocks_next(ring, job);
		list_add_tail(&job->ring_node, &ring->list);
		gloss_ring_add(ring, job);
	} else {
		gloss_job_end(job, &gone);
	}
	spin_unlock_irqrestore(&ring->lock, flags);

	if (added && !ring->asleep)
		gloss_ring_tell_tail(gdev);
	mutex_unlock(&ring->push_lock);
}

/* The job at the ring's head, or NULL. */
static struct gloss_job *gloss_ring_first(struct gloss_ring *ring)
{
	lockdep_assert_held(&ring->lock);
	return list_first_entry_or_null(&ring->list, struct gloss_job, ring_node);
}

/* Whether the board has ended the job at the ring's head, and how. */
static bool gloss_ring_ended(struct gloss_ring *ring, const struct gloss_job *job,
			     struct drm_gloss_status *status)
{
	const __le32 *word = ring->shared->completion[ring->head % GLOSS_RING_ENTRIES];

	if (le32_to_cpu(READ_ONCE(word[GLOSS_COMPLETION_SEQUENCE_WORD])) != job->sequence)
		return false;

	/* The rest of the record, and the response, are not older than its sequence. */
	dma_rmb();
	*status = (struct drm_gloss_status) {
		.error = job->refused,
		.cause = FIELD_GET(GLOSS_COMPLETION_CAUSE,
				   le32_to_cpu(word[GLOSS_COMPLETION_CAUSE_WORD])),
		.offset = le32_to_cpu(word[GLOSS_COMPLETION_OFFSET_WORD]),
		.response_words = le32_to_cpu(word[GLOSS_COMPLETION_RESPONSE_WORDS_WORD]),
	};
	return true;
}

/* The board works for a job since it has it, but not before the job ahead has ended. */
static s64 gloss_ring_worked_ns(const struct gloss_ring *ring, const struct gloss_job *job,
				ktime_t now)
{
	ktime_t begun = ktime_after(job->begun, ring->idle) ? job->begun : ring->idle;

	return ktime_to_ns(ktime_sub(now, begun));
}

static s64 gloss_ring_worked_ms(const struct gloss_ring *ring, const struct gloss_job *job)
{
	return div_s64(gloss_ring_worked_ns(ring, job, ktime_get()), NSEC_PER_MSEC);
}

/* The board has ended a job, or was reset while it had it. */
static void gloss_ring_account(struct gloss_ring *ring, const struct gloss_job *job)
{
	ktime_t now = ktime_get();
	s64 ns = gloss_ring_worked_ns(ring, job, now);

	ring->idle = now;
	ring->busy_ns += ns;
	if (job->file)
		atomic64_add(ns, &job->file->engine_ns);
	gloss_clocks_ended(ring, job, ns);
}

/* How long the board has worked for @file, up to now. */
u64 gloss_ring_engine_ns(struct gloss_ring *ring, const struct gloss_file *file)
{
	const struct gloss_job *job;
	unsigned long flags;
	u64 ns;

	spin_lock_irqsave(&ring->lock, flags);
	ns = atomic64_read(&file->engine_ns);
	job = gloss_ring_first(ring);
	if (job && job->file == file)
		ns += gloss_ring_worked_ns(ring, job, ktime_get());
	spin_unlock_irqrestore(&ring->lock, flags);
	return ns;
}

static void gloss_ring_note_fault(struct gloss_ring *ring, const struct gloss_job *job,
				  const struct drm_gloss_status *status)
{
	ring->faults++;
	ring->fault = (struct gloss_ring_fault) {
		.sequence = job->sequence,
		.status = *status,
		.pid = job->file ? job->file->pid : 0,
		.time = ktime_get(),
	};
}

static void gloss_ring_end(struct gloss_ring *ring, struct gloss_job *job,
			   const struct drm_gloss_status *status)
{
	list_del(&job->ring_node);
	ring->head++;
	ring->jobs++;
	gloss_ring_account(ring, job);
	if (status->cause)
		gloss_ring_note_fault(ring, job, status);
	gloss_job_end(job, status);
}

/* Ends the jobs that the board has ended; returns how many. */
unsigned int gloss_ring_reap(struct gloss_ring *ring)
{
	struct drm_gloss_status status;
	struct gloss_job *job;
	unsigned int ended = 0;
	unsigned long flags;

	spin_lock_irqsave(&ring->lock, flags);
	while ((job = gloss_ring_first(ring)) && gloss_ring_ended(ring, job, &status)) {
		gloss_ring_end(ring, job, &status);
		ended++;
	}
	gloss_clocks_next(ring, job);
	spin_unlock_irqrestore(&ring->lock, flags);
	return ended;
}

/* Of the job at the ring's head: whoever asks twice knows whether its interrupt was lost. */
enum gloss_ring_news gloss_ring_news(struct gloss_ring *ring)
{
	struct drm_gloss_status status;
	const struct gloss_job *job;
	u32 before = ring->unheard;
	unsigned long flags;

	lockdep_assert_held(&ring->push_lock);
	spin_lock_irqsave(&ring->lock, flags);
	job = gloss_ring_first(ring);
	ring->unheard = job && gloss_ring_ended(ring, job, &status) ? job->sequence : 0;
	spin_unlock_irqrestore(&ring->lock, flags);
	if (!ring->unheard)
		return GLOSS_RING_NOTHING;
	return ring->unheard == before ? GLOSS_RING_UNHEARD : GLOSS_RING_ENDED;
}

/* Ends all jobs of the ring with @error. */
void gloss_ring_fail(struct gloss_ring *ring, int error)
{
	const struct drm_gloss_status status = { .error = error };
	struct gloss_job *job;
	unsigned long flags;

	spin_lock_irqsave(&ring->lock, flags);
	while ((job = gloss_ring_first(ring)))
		gloss_ring_end(ring, job, &status);
	spin_unlock_irqrestore(&ring->lock, flags);
}

/* The job of the ring with @sequence, or NULL; under its lock. */
struct gloss_job *gloss_ring_find(struct gloss_ring *ring, u32 sequence)
{
	struct gloss_job *job;

	lockdep_assert_held(&ring->lock);
	list_for_each_entry(job, &ring->list, ring_node)
		if (job->sequence == sequence)
			return job;
	return NULL;
}

/*
 * Finds who is to blame for a reset: the job with @sequence, or else the first. It will not
 * be run again, but end with the error of @fault, which is completed. False: there is nobody
 * to blame, as not even an empty job can be run.
 */
bool gloss_ring_blame(struct gloss_ring *ring, u32 sequence, struct gloss_ring_fault *fault)
{
	struct gloss_job *job;
	unsigned long flags;
	bool found;

	spin_lock_irqsave(&ring->lock, flags);
	job = gloss_ring_find(ring, sequence) ?: gloss_ring_first(ring);
	found = job && job->hangs++ < GLOSS_JOB_HANGS;
	if (found) {
		trace_gloss_reset(job->gdev, job);
		gloss_job_refuse(job, fault->status.error);
		gloss_ring_note_fault(ring, job, &fault->status);
		ring->fault.dma_address = fault->dma_address;
		*fault = ring->fault;
	}
	spin_unlock_irqrestore(&ring->lock, flags);
	return found;
}

/* For how long the job at the ring's head has run; 0 without one. */
s64 gloss_ring_ran_ms(struct gloss_ring *ring)
{
	const struct gloss_job *job;
	unsigned long flags;
	s64 ran = 0;

	spin_lock_irqsave(&ring->lock, flags);
	job = gloss_ring_first(ring);
	if (job)
		ran = gloss_ring_worked_ms(ring, job);
	spin_unlock_irqrestore(&ring->lock, flags);
	return ran;
}

static bool gloss_ring_job_closed(const struct gloss_job *job)
{
	return job->file && READ_ONCE(job->file->closed);
}

/*
 * In how many milliseconds a job of the ring can have run too long. If that is not positive,
 * the job at its head has, and is to end with @error.
 */
s64 gloss_ring_left_ms(struct gloss_ring *ring, unsigned int limit_ms, int *error)
{
	unsigned int closed_ms = min_t(unsigned int, limit_ms, GLOSS_CLOSED_LIMIT_MS);
	const struct gloss_job *job, *first;
	unsigned long flags;
	s64 left = limit_ms;

	spin_lock_irqsave(&ring->lock, flags);
	first = gloss_ring_first(ring);
	*error = first && gloss_ring_job_closed(first) ? -ECANCELED : -ETIME;
	list_for_each_entry(job, &ring->list, ring_node) {
		s64 limit = gloss_ring_job_closed(job) ? closed_ms : limit_ms;

		/* An empty job to the board. */
		if (job->refused)
			continue;
		if (job == first)
			limit -= gloss_ring_worked_ms(ring, job);
		left = min(left, limit);
	}
	spin_unlock_irqrestore(&ring->lock, flags);
	return left;
}

/* Between a reset and gloss_ring_start(): writes the ring anew, from its first entry on. */
void gloss_ring_rewind(struct gloss_ring *ring)
{
	struct gloss_job *job;
	unsigned long flags;

	spin_lock_irqsave(&ring->lock, flags);
	job = gloss_ring_first(ring);
	if (job)
		gloss_ring_account(ring, job);
	gloss_clocks_reset(ring);
	ring->head = 0;
	ring->tail = 0;
	ring->seen_head = 0;
	ring->seen_progress = 0;
	ring->seen = ktime_get();
	memset(ring->shared->completion, 0, sizeof(ring->shared->completion));
	list_for_each_entry(job, &ring->list, ring_node)
		gloss_ring_add(ring, job);
	spin_unlock_irqrestore(&ring->lock, flags);
}

/* Starts the board, which has been reset, on the jobs that the ring has. */
int gloss_ring_start(struct gloss_device *gdev)
{
	int ret = gloss_device_start(gdev);

	if (!ret && !gloss_ring_idle(&gdev->ring))
		gloss_ring_tell_tail(gdev);
	return ret;
}

bool gloss_ring_idle(struct gloss_ring *ring)
{
	return list_empty_careful(&ring->list);
}
