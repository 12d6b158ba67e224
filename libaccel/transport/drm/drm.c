// SPDX-License-Identifier: MIT
/*
 * "drm:": a PCI board, through the kernel module gloss. A job is one host object with its
 * status, stream and response, and two ioctls, one to submit and one to wait: job n of a
 * device is point n of its one timeline syncobj.
 */
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xf86drm.h>

#include "gloss_drm.h"
#include "transport/drm/job.h"
#include "transport/drm/node.h"
#include "transport/thread.h"

_Static_assert((int)GLOSS_RIGHTS_READ == DRM_GLOSS_SLOT_READ &&
		       (int)GLOSS_RIGHTS_WRITE == DRM_GLOSS_SLOT_WRITE,
	       "rights of a slot");

struct transport_drm {
	int fd;
	uint32_t syncobj;
	uint64_t words_max; /* of a stream, and of a response */
	struct accel_transport_info info;
	struct accel_pool pool;      /* of struct accel_drm_buffer */
	uint64_t sequence;           /* of the last job; under the device's lock */
	pthread_mutex_t lock;        /* protects jobs */
	struct accel_job_table jobs; /* until they were waited for */
};

/* ---- opening ---- */

static int drm_param(int fd, enum drm_gloss_param param, uint64_t *value)
{
	struct drm_gloss_get_param get = { .param = param };
	int err = accel_drm_node_ioctl(fd, DRM_IOCTL_GLOSS_GET_PARAM, &get);

	*value = get.value;
	return err;
}

/* With its path, if there is room for it. */
static void drm_name(struct accel_transport_info *info, const char *path)
{
	const int room = sizeof(info->name);

	if (snprintf(info->name, room, "Gloss PCI board %s, %u-pixel tiles, %u lanes", path,
		     info->tile_size, info->pixels_per_clock) >= room)
		snprintf(info->name, room, "Gloss PCI board, %u-pixel tiles, %u lanes",
			 info->tile_size, info->pixels_per_clock);
}

static int drm_identify(struct transport_drm *transport, const char *path)
{
	const enum drm_gloss_param params[] = {
		DRM_GLOSS_PARAM_VERSION,          DRM_GLOSS_PARAM_TILE_SIZE,
		DRM_GLOSS_PARAM_PIXELS_PER_CLOCK, DRM_GLOSS_PARAM_MEMORY_SIZE,
		DRM_GLOSS_PARAM_STREAM_WORDS_MAX,
	};
	struct accel_transport_info *info = &transport->info;
	uint64_t value[sizeof(params) / sizeof(params[0])];
	int err;

	for (size_t i = 0; i < sizeof(params) / sizeof(params[0]); i++) {
		err = drm_param(transport->fd, params[i], &value[i]);
		if (err)
			return err;
	}
	*info = (struct accel_transport_info){
		.version = (uint32_t)value[0],
		.tile_size = (uint32_t)value[1],
		.pixels_per_clock = (uint32_t)value[2],
		.memory_size = value[3],
	};
	transport->words_max = value[4];
	drm_name(info, path);
	return 0;
}

static int transport_drm_open(const char *where, void **state, struct accel_transport_error *error)
{
	struct transport_drm *transport = calloc(1, sizeof(*transport));
	char path[PATH_MAX];
	int err;

	if (!transport)
		return -ENOMEM;
	transport->fd = accel_drm_node_open(where, path, sizeof(path), error);
	if (transport->fd < 0) {
		err = transport->fd;
		goto err_free;
	}
	err = drm_identify(transport, path);
	if (!err && drmSyncobjCreate(transport->fd, 0, &transport->syncobj))
		err = accel_drm_node_error(-errno);
	if (err)
		goto err_close;
	accel_pool_init(&transport->pool, &accel_drm_buffer_kind, &transport->fd);
	accel_job_table_init(&transport->jobs);
	pthread_mutex_init(&transport->lock, NULL);
	*state = transport;
	return 0;

err_close:
	accel_transport_say(error, "%s does not answer as a gloss module of this version: %s", path,
			    strerror(-err));
	close(transport->fd);
	err = err == -ENOMEM ? -ENOMEM : -ENODEV;
err_free:
	free(transport);
	return err;
}

static void transport_drm_close(void *state)
{
	struct transport_drm *transport = state;

	accel_job_table_fini(&transport->jobs, NULL);
	accel_pool_fini(&transport->pool);
	drmSyncobjDestroy(transport->fd, transport->syncobj);
	close(transport->fd);
	pthread_mutex_destroy(&transport->lock);
	free(transport);
}

/* ---- listing ---- */

struct drm_listing {
	accel_device_list_fn found;
	void *data;
	int err;
};

/* Another program's use of the board does not mind one more that looks. */
static void drm_list_node(void *data, const char *path)
{
	struct accel_transport_error error = { "" };
	char name[PATH_MAX + sizeof("drm:")];
	struct transport_drm *transport;
	struct drm_listing *list = data;
	void *state;
	int err;

	snprintf(name, sizeof(name), "drm:%s", path);
	err = transport_drm_open(path, &state, &error);
	if (err == -ENOMEM)
		list->err = err;
	if (err) {
		list->found(list->data, name, *error.text ? error.text : strerror(-err));
		return;
	}
	transport = state;
	list->found(list->data, name, transport->info.name);
	transport_drm_close(state);
}

static int transport_drm_list(accel_device_list_fn found, void *data)
{
	struct drm_listing list = { found, data, 0 };
	int err = accel_drm_node_list(drm_list_node, &list);

	return err ? err : list.err;
}

static void transport_drm_info(void *state, struct accel_transport_info *info)
{
	const struct transport_drm *transport = state;

	*info = transport->info;
}

/* ---- board memory: an object of the library is a GEM handle, and a size above it ---- */

static uint32_t drm_object_handle(uint64_t object)
{
	return (uint32_t)object;
}

static uint64_t drm_object_size(uint64_t object)
{
	return object >> 32;
}

static int transport_drm_memory_new(void *state, uint64_t size, uint64_t *object)
{
	struct drm_gloss_gem_create create = { .size = size, .kind = DRM_GLOSS_GEM_BOARD };
	struct transport_drm *transport = state;
	int err;

	err = accel_drm_node_ioctl(transport->fd, DRM_IOCTL_GLOSS_GEM_CREATE, &create);
	if (!err)
		*object = size << 32 | create.handle;
	return err;
}

static void transport_drm_memory_free(void *state, uint64_t object)
{
	struct drm_gem_close close = { .handle = drm_object_handle(object) };
	struct transport_drm *transport = state;

	accel_drm_node_ioctl(transport->fd, DRM_IOCTL_GEM_CLOSE, &close);
}

/* ---- submitting ---- */

/* A slot without rights is an empty one to the kernel; to a stream it is the same. */
static void drm_fill_slots(const struct accel_transport_job *from, struct drm_gloss_slot *slot)
{
	for (uint32_t i = 0; i < from->slots; i++) {
		slot[i] = (struct drm_gloss_slot){ 0 };
		if (from->slot[i].rights)
			slot[i] = (struct drm_gloss_slot){
				.handle = drm_object_handle(from->slot[i].object),
				.rights = from->slot[i].rights,
				.size = drm_object_size(from->slot[i].object),
			};
	}
}

/* As point @sequence. */
static int drm_job_submit(const struct transport_drm *transport, const struct accel_drm_job *job,
			  const struct accel_transport_job *from, uint64_t sequence)
{
	struct drm_gloss_slot slot[GLOSS_SLOTS];
	const struct drm_gloss_sync ended = {
		.handle = transport->syncobj,
		.flags = DRM_GLOSS_SYNC_TIMELINE,
		.point = sequence,
	};
	struct drm_gloss_submit submit = {
		.stream_words = from->stream_words,
		.response_words = from->response_words,
		.status = job->buffer->handle,
		.status_offset = DRM_STATUS_OFFSET,
		.slot_count = from->slots,
		.slots = (uintptr_t)slot,
		.slot_stride = from->slots ? sizeof(slot[0]) : 0,
		.out_syncs = (uintptr_t)&ended,
		.out_sync_count = 1,
		.sync_stride = sizeof(ended),
	};

	if (from->stream_words) {
		submit.stream = job->buffer->handle;
		submit.stream_offset = DRM_STREAM_OFFSET;
	}
	if (from->response_words) {
		submit.response = job->buffer->handle;
		submit.response_offset = job->response_offset;
	}
	drm_fill_slots(from, slot);
	return accel_drm_node_ioctl(transport->fd, DRM_IOCTL_GLOSS_SUBMIT, &submit);
}

static int transport_drm_submit(void *state, const struct accel_transport_job *from,
				uint64_t *sequence)
{
	struct transport_drm *transport = state;
	struct accel_drm_job *job;
	int err;

	if (from->slots > GLOSS_SLOTS || from->stream_words > transport->words_max ||
	    from->response_words > transport->words_max)
		return -EINVAL;
	err = accel_drm_job_new(&transport->pool, from, &job);
	if (err)
		return err;
	err = drm_job_submit(transport, job, from, transport->sequence + 1);
	if (err) {
		accel_pool_put(&transport->pool, &job->buffer->pooled);
		free(job);
		return err;
	}
	*sequence = ++transport->sequence;
	pthread_mutex_lock(&transport->lock);
	accel_job_table_put(&transport->jobs, &job->entry, *sequence);
	pthread_mutex_unlock(&transport->lock);
	return 0;
}

/* ---- waiting ---- */

/* The clock of the kernel's waits, saturated. */
static int64_t drm_deadline(int64_t timeout_ns)
{
	int64_t now_ns = accel_thread_now_ns();

	return timeout_ns < 0 || timeout_ns > INT64_MAX - now_ns ? INT64_MAX : now_ns + timeout_ns;
}

static int drm_wait_point(struct transport_drm *transport, uint64_t point, int64_t timeout_ns)
{
	int err;

	err = drmSyncobjTimelineWait(transport->fd, &transport->syncobj, &point, 1,
				     drm_deadline(timeout_ns), 0, NULL);
	return err == -ETIME ? -ETIMEDOUT : accel_drm_node_error(err);
}

/* NULL: no such job. */
static struct accel_drm_job *drm_job_take(struct transport_drm *transport, uint64_t sequence)
{
	struct accel_job_entry *entry;

	pthread_mutex_lock(&transport->lock);
	entry = accel_job_table_find(&transport->jobs, sequence);
	if (entry)
		accel_job_table_take(&transport->jobs, entry);
	pthread_mutex_unlock(&transport->lock);
	return (struct accel_drm_job *)entry;
}

static int transport_drm_wait(void *state, uint64_t sequence, int64_t timeout_ns,
			      struct gloss_status *status)
{
	struct transport_drm *transport = state;
	struct accel_drm_job *job;
	int err;

	err = drm_wait_point(transport, sequence, timeout_ns);
	if (err == -ETIMEDOUT)
		return err;
	job = drm_job_take(transport, sequence);
	if (!job)
		return -EINVAL;
	*status = (struct gloss_status){ .cause = GLOSS_FAULT_NONE };
	if (err) {
		accel_drm_buffer_drop(transport->fd, job->buffer);
	} else {
		err = accel_drm_job_result(job, status);
		accel_pool_put(&transport->pool, &job->buffer->pooled);
	}
	free(job);
	return err;
}

static int drm_fd_error(int err)
{
	return err == -EMFILE || err == -ENFILE ? -EMFILE : accel_drm_node_error(err);
}

/* A sync file is made of a syncobj without points, to which the job's point is copied. */
static int transport_drm_fence_fd(void *state, uint64_t sequence)
{
	const struct transport_drm *transport = state;
	int fd = -1, err = 0;
	uint32_t syncobj;

	if (drmSyncobjCreate(transport->fd, 0, &syncobj))
		return drm_fd_error(-errno);
	if (drmSyncobjTransfer(transport->fd, syncobj, 0, transport->syncobj, sequence, 0) ||
	    drmSyncobjExportSyncFile(transport->fd, syncobj, &fd))
		err = drm_fd_error(-errno);
	drmSyncobjDestroy(transport->fd, syncobj);
	return err ? err : fd;
}

/* The kernel counts of this file's jobs alone, from its opening on. */
static int transport_drm_clocks(void *state, struct accel_device_clocks *clocks)
{
	const struct transport_drm *transport = state;
	struct drm_gloss_get_clocks get = { .clocks = 0 };
	int err = accel_drm_node_ioctl(transport->fd, DRM_IOCTL_GLOSS_GET_CLOCKS, &get);

	if (err)
		return err == -ENODEV ? -ENODEV : -ENOTSUP;
	*clocks = (struct accel_device_clocks){
		.clocks = get.clocks,
		.stall_stream = get.stall_stream,
		.stall_raster = get.stall_raster,
		.stall_tile = get.stall_tile,
		.stall_memory = get.stall_memory,
		.stall_response = get.stall_response,
	};
	return 0;
}

const struct accel_transport_ops accel_transport_drm = {
	.scheme = "drm",
	.open = transport_drm_open,
	.list = transport_drm_list,
	.close = transport_drm_close,
	.info = transport_drm_info,
	.memory_new = transport_drm_memory_new,
	.memory_free = transport_drm_memory_free,
	.submit = transport_drm_submit,
	.wait = transport_drm_wait,
	.fence_fd = transport_drm_fence_fd,
	.clocks = transport_drm_clocks,
};
