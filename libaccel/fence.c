// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"

struct accel_fence {
	struct accel_device *device;
	struct accel_buffer *buffer[GLOSS_SLOTS];	/* of the job, a reference each */
	unsigned int buffers;
	uint64_t sequence;
	bool running;
	int result;			/* of wait, once the job has ended */
	struct accel_fence_status status;
};

struct accel_fence *accel_fence_new(struct accel_device *device)
{
	struct accel_fence *fence = calloc(1, sizeof(*fence));

	if (fence)
		fence->device = accel_device_ref(device);
	return fence;
}

void accel_fence_begin(struct accel_fence *fence, uint64_t sequence,
		       struct accel_buffer *const *buffer, unsigned int buffers)
{
	while (fence->buffers < buffers) {
		fence->buffer[fence->buffers] = buffer[fence->buffers];
		fence->buffers++;
	}
	fence->sequence = sequence;
	fence->running = true;
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
	else if (err)
		accel_device_message(fence->device, "the job was lost: %s", strerror(-err));
}

static void fence_end(struct accel_fence *fence, int err, const struct gloss_status *status)
{
	fence->running = false;
	if (!err)
		fence->status = (struct accel_fence_status){
			.fault = status->cause,
			.offset = status->offset,
			.response_words = status->response_words,
		};
	fence->result = fence->status.fault ? -EIO : err;
	while (fence->buffers)
		accel_buffer_unref(fence->buffer[--fence->buffers]);
	fence_message(fence, err);
}

int accel_fence_wait(struct accel_fence *fence, int64_t timeout_ns,
		     struct accel_fence_status *status)
{
	struct accel_device *device = fence->device;
	struct gloss_status ended;
	int err;

	if (fence->running) {
		err = device->ops->wait(device->state, fence->sequence, timeout_ns, &ended);
		if (err == -ETIMEDOUT)
			return err;
		fence_end(fence, err, &ended);
	}
	if (status)
		*status = fence->status;
	return fence->result;
}

void accel_fence_free(struct accel_fence *fence)
{
	if (!fence)
		return;
	if (fence->running)
		accel_fence_wait(fence, -1, NULL);
	accel_device_unref(fence->device);
	free(fence);
}
