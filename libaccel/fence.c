// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"
#include "transport/thread.h"

/* A job that has not been waited for. */
struct fence_job {
	struct fence_job *next;
	uint64_t sequence;
	struct accel_buffer *buffer[GLOSS_SLOTS]; /* a reference each */
	unsigned int buffers;
};

struct accel_outcome {
	atomic_uint references;
	_Atomic enum accel_outcome_state state;
};

struct accel_fence {
	struct accel_device *device;      /* a reference, until it is detached */
	struct accel_fence *next;         /* of those detached */
	struct fence_job *first, **last;  /* in the order in which the board has them */
	struct fence_job *spare;          /* for accel_fence_add */
	uint64_t sequence;                /* of the last of its jobs */
	int result;                       /* of the first job that failed, or else of the last */
	struct accel_fence_status status; /* likewise */
	struct accel_outcome *outcome;    /* to be told, a reference; may be NULL */
};

struct accel_fence *accel_fence_new(struct accel_device *device)
{
	struct accel_fence *fence = calloc(1, sizeof(*fence));

	if (!fence)
		return NULL;
	fence->device = accel_device_ref(device);
	fence->last = &fence->first;
	return fence;
}

int accel_fence_reserve(struct accel_fence *fence)
{
	if (!fence->spare)
		fence->spare = malloc(sizeof(*fence->spare));
	return fence->spare ? 0 : -ENOMEM;
}

void accel_fence_add(struct accel_fence *fence, uint64_t sequence,
		     struct accel_buffer *const *buffer, unsigned int buffers)
{
	struct fence_job *job = fence->spare;

	fence->spare = NULL;
	*job = (struct fence_job){ .sequence = sequence };
	while (job->buffers < buffers) {
		job->buffer[job->buffers] = buffer[job->buffers];
		job->buffers++;
	}
	*fence->last = job;
	fence->last = &job->next;
	fence->sequence = sequence;
}

/* ---- what became of jobs ---- */

struct accel_outcome *accel_outcome_new(void)
{
	struct accel_outcome *outcome = calloc(1, sizeof(*outcome));

	if (outcome)
		outcome->references = 1;
	return outcome;
}

void accel_outcome_unref(struct accel_outcome *outcome)
{
	if (outcome && atomic_fetch_sub(&outcome->references, 1) == 1)
		free(outcome);
}

enum accel_outcome_state accel_outcome_look(const struct accel_outcome *outcome)
{
	return atomic_load(&outcome->state);
}

void accel_fence_tell(struct accel_fence *fence, struct accel_outcome *outcome)
{
	atomic_store(&outcome->state, ACCEL_OUTCOME_PENDING);
	atomic_fetch_add(&outcome->references, 1);
	fence->outcome = outcome;
}

/* When all jobs have ended. */
static void fence_tell(struct accel_fence *fence)
{
	if (!fence->outcome)
		return;
	atomic_store(&fence->outcome->state,
		     fence->result ? ACCEL_OUTCOME_FAILED : ACCEL_OUTCOME_DONE);
	accel_outcome_unref(fence->outcome);
	fence->outcome = NULL;
}

static const char *fence_fault_text(enum gloss_fault fault)
{
	static const char *const text[] = {
		[GLOSS_FAULT_NONE] = "none",
		[GLOSS_FAULT_OPCODE] = "unknown opcode",
		[GLOSS_FAULT_LENGTH] = "wrong length",
		[GLOSS_FAULT_VALUE] = "value out of range",
		[GLOSS_FAULT_ORDER] = "packet not allowed here",
		[GLOSS_FAULT_SLOT] = "access outside its slot or without the right",
		[GLOSS_FAULT_RESPONSE] = "response buffer too small",
		[GLOSS_FAULT_MEMORY] = "board memory failed",
	};

	return fault < sizeof(text) / sizeof(text[0]) ? text[fault] : "unknown fault";
}

static void fence_message(struct accel_fence *fence, int err)
{
	if (fence->status.fault)
		accel_device_message(fence->device, "the job stopped at word %u of its stream: %s",
				     fence->status.offset,
				     fence_fault_text((enum gloss_fault)fence->status.fault));
	else if (err == -EIO)
		accel_device_message(fence->device, "the board failed and was reset");
	else if (err == -ETIME)
		accel_device_message(fence->device, "the job ran for longer than a job may and was "
						    "ended; draw less at a time");
	else if (err)
		accel_device_message(fence->device, "the job was lost: %s",
				     accel_device_why(fence->device, err));
}

/* The first job has ended, or with an error nobody knows; it is the fence's no more. */
static void fence_end(struct accel_fence *fence, int err, const struct gloss_status *status)
{
	struct fence_job *job = fence->first;

	fence->first = job->next;
	if (!fence->first)
		fence->last = &fence->first;
	while (job->buffers)
		accel_buffer_unref(job->buffer[--job->buffers]);
	free(job);
	if (fence->result)
		return;
	fence->status = (struct accel_fence_status){ .fault = 0 };
	if (!err)
		fence->status = (struct accel_fence_status){
			.fault = status->cause,
			.offset = status->offset,
			.response_words = status->response_words,
		};
	fence->result = fence->status.fault ? -EIO : err;
	fence_message(fence, err);
}

/* What is left of a time-out that began at @start. */
static int64_t fence_left(int64_t timeout_ns, int64_t start)
{
	int64_t passed;

	if (timeout_ns <= 0)
		return timeout_ns;
	passed = accel_thread_now_ns() - start;
	return passed < timeout_ns ? timeout_ns - passed : 0;
}

static int fence_wait_first(struct accel_fence *fence, int64_t timeout_ns)
{
	const struct accel_device *device = fence->device;
	struct gloss_status ended;
	int err, held;

	if (accel_device_is_inherited(device))
		return -ENODEV;
	held = accel_thread_hold_cancel();
	err = device->ops->wait(device->state, fence->first->sequence, timeout_ns, &ended);
	accel_thread_allow_cancel(held);
	if (err != -ETIMEDOUT)
		fence_end(fence, err, &ended);
	return err == -ETIMEDOUT ? err : 0;
}

int accel_fence_wait(struct accel_fence *fence, int64_t timeout_ns,
		     struct accel_fence_status *status, size_t size)
{
	int64_t start = timeout_ns > 0 ? accel_thread_now_ns() : 0, left = timeout_ns;
	int err;

	while (fence->first) {
		err = fence_wait_first(fence, left);
		if (err)
			return err;
		left = fence_left(timeout_ns, start);
	}
	fence_tell(fence);
	if (status)
		accel_sized_out(status, size, &fence->status, sizeof(fence->status));
	return fence->result;
}

int accel_fence_fd(struct accel_fence *fence)
{
	struct accel_device *device = fence->device;
	int fd, held;

	if (!device->ops->fence_fd) {
		accel_device_message(device,
				     "a fence of \"%s:\" has no file descriptor: \"drm:\" "
				     "has",
				     device->ops->scheme);
		return -ENOTSUP;
	}
	if (accel_device_is_inherited(device))
		return -ENODEV;
	held = accel_thread_hold_cancel();
	fd = device->ops->fence_fd(device->state, fence->sequence);
	accel_thread_allow_cancel(held);
	return fd;
}

/* In a child of fork() nothing ends any more. */
static void fence_forget(struct accel_fence *fence)
{
	static const struct gloss_status unknown;

	while (fence->first)
		fence_end(fence, -ENODEV, &unknown);
	fence_tell(fence);
}

void accel_fence_free(struct accel_fence *fence)
{
	if (!fence)
		return;
	if (accel_fence_wait(fence, -1, NULL, 0) == -ENODEV)
		fence_forget(fence);
	accel_device_unref(fence->device);
	free(fence->spare);
	free(fence);
}

int accel_fence_finish(struct accel_fence *fence)
{
	int err = accel_fence_wait(fence, -1, NULL, 0);

	accel_fence_free(fence);
	return err;
}

/* ---- jobs that nobody waits for ---- */

/* What a job's buffers have in board memory stays until the device knows that the job has ended. */
static void fence_job_release(struct fence_job *job)
{
	while (job->buffers) {
		struct accel_buffer *buffer = job->buffer[--job->buffers];

		accel_buffer_busy(buffer, job->sequence);
		accel_buffer_unref(buffer);
	}
}

static void fence_detach(struct accel_fence *fence)
{
	struct accel_device *device = fence->device;

	for (struct fence_job *job = fence->first; job; job = job->next)
		fence_job_release(job);
	pthread_mutex_lock(&device->detached.lock);
	*device->detached.last = fence;
	device->detached.last = &fence->next;
	device->detached.fences++;
	pthread_mutex_unlock(&device->detached.lock);
	accel_device_unref(device);
}

void accel_fence_give(struct accel_fence *fence, struct accel_fence **out)
{
	if (out)
		*out = fence;
	else
		fence_detach(fence);
}

void accel_fence_detached_init(struct accel_detached *detached)
{
	pthread_mutexattr_t attributes;

	*detached = (struct accel_detached){ .last = &detached->first };
	pthread_mutex_init(&detached->lock, NULL);
	/* A message function may call what has the turn already. */
	pthread_mutexattr_init(&attributes);
	pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK);
	pthread_mutex_init(&detached->turn, &attributes);
	pthread_mutexattr_destroy(&attributes);
}

void accel_fence_detached_fini(struct accel_detached *detached)
{
	pthread_mutex_destroy(&detached->turn);
	pthread_mutex_destroy(&detached->lock);
}

/* How many there are, and the first; others can only be added until the turn's holder drops it. */
static unsigned int fence_detached_look(struct accel_detached *detached, struct accel_fence **first)
{
	unsigned int fences;

	pthread_mutex_lock(&detached->lock);
	fences = detached->fences;
	*first = detached->first;
	pthread_mutex_unlock(&detached->lock);
	return fences;
}

static void fence_detached_drop(struct accel_detached *detached)
{
	struct accel_fence *fence;

	pthread_mutex_lock(&detached->lock);
	fence = detached->first;
	detached->first = fence->next;
	detached->fences--;
	if (!detached->first)
		detached->last = &detached->first;
	pthread_mutex_unlock(&detached->lock);
	if (fence->sequence > atomic_load(&detached->ended))
		atomic_store(&detached->ended, fence->sequence);
	free(fence->spare);
	free(fence);
}

/*
 * Called with the turn; takes those that have ended, or are to be waited for. Not those that come
 * meanwhile, or a thread that submits on and on would keep it here.
 */
static void fence_detached_take(struct accel_detached *detached, int64_t timeout_ns)
{
	struct accel_fence *fence;
	unsigned int left = fence_detached_look(detached, &fence);
	int err;

	for (; left; left--) {
		fence_detached_look(detached, &fence);
		err = accel_fence_wait(fence, timeout_ns, NULL, 0);
		if (err == -ETIMEDOUT)
			return;
		if (!detached->result)
			detached->result = err;
		fence_detached_drop(detached);
	}
}

void accel_fence_detached_reap(struct accel_detached *detached)
{
	struct accel_fence *first;

	if (!fence_detached_look(detached, &first) || pthread_mutex_trylock(&detached->turn))
		return;
	fence_detached_take(detached, 0);
	pthread_mutex_unlock(&detached->turn);
}

int accel_fence_detached_finish(struct accel_detached *detached)
{
	int result;

	if (pthread_mutex_lock(&detached->turn))
		return 0;
	fence_detached_take(detached, -1);
	result = detached->result;
	detached->result = 0;
	pthread_mutex_unlock(&detached->turn);
	return result;
}
