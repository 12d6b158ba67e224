// SPDX-License-Identifier: MIT
#include <errno.h>
#include <fcntl.h>
#include <linux/sync_file.h>
#include <poll.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>
#include <xf86drm.h>

#include "gloss_node.h"
#include "vm_test.h"

/* ---- one system call each ---- */

int node_ioctl(int fd, unsigned long request, const void *argument)
{
	return ioctl(fd, request, argument) < 0 ? -errno : 0;
}

int node_open(const char *path)
{
	int fd = open(path, O_RDWR | O_CLOEXEC);

	return fd < 0 ? -errno : fd;
}

int node_param(int fd, uint32_t param, uint64_t *value)
{
	struct drm_gloss_get_param get = { .param = param };
	int err = node_ioctl(fd, DRM_IOCTL_GLOSS_GET_PARAM, &get);

	*value = get.value;
	return err;
}

int node_create(int fd, uint32_t kind, uint64_t size, uint32_t *handle)
{
	struct drm_gloss_gem_create create = { .size = size, .kind = kind };
	int err = node_ioctl(fd, DRM_IOCTL_GLOSS_GEM_CREATE, &create);

	*handle = create.handle;
	return err;
}

int node_destroy(int fd, uint32_t handle)
{
	struct drm_gem_close close = { .handle = handle };

	return node_ioctl(fd, DRM_IOCTL_GEM_CLOSE, &close);
}

int node_mmap_offset(int fd, uint32_t handle, uint64_t *offset)
{
	struct drm_gloss_gem_mmap_offset map = { .handle = handle };
	int err = node_ioctl(fd, DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET, &map);

	*offset = map.offset;
	return err;
}

int node_submit(int fd, const struct drm_gloss_submit *submit)
{
	return node_ioctl(fd, DRM_IOCTL_GLOSS_SUBMIT, submit);
}

int node_sync_new(int fd, uint32_t *sync)
{
	return drmSyncobjCreate(fd, 0, sync) ? -errno : 0;
}

static int64_t deadline(int milliseconds)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec + (int64_t)milliseconds * 1000000;
}

int node_wait(int fd, uint32_t sync, uint64_t point, int milliseconds)
{
	int64_t until = deadline(milliseconds);

	if (point)
		return drmSyncobjTimelineWait(fd, &sync, &point, 1, until, 0, NULL);
	return drmSyncobjWait(fd, &sync, 1, until, 0, NULL);
}

static int file_error(int file)
{
	struct sync_file_info info = { .status = 0 };
	int err = node_ioctl(file, SYNC_IOC_FILE_INFO, &info);

	if (err)
		return err;
	return info.status > 0 ? 0 : info.status < 0 ? info.status : -EBUSY;
}

int node_fence_error(int fd, uint32_t sync)
{
	int file, err;

	if (drmSyncobjExportSyncFile(fd, sync, &file))
		return -errno;
	err = file_error(file);
	close(file);
	return err;
}

int node_file_wait(int file, int milliseconds)
{
	struct pollfd wait = { .fd = file, .events = POLLIN };

	if (poll(&wait, 1, milliseconds) < 0)
		return -errno;
	return file_error(file);
}

int node_buffer_new(int fd, uint64_t size, struct node_buffer *buffer)
{
	uint64_t offset;
	int err;

	*buffer = (struct node_buffer){ .size = size };
	err = node_create(fd, DRM_GLOSS_GEM_HOST, size, &buffer->handle);
	if (err)
		return err;
	err = node_mmap_offset(fd, buffer->handle, &offset);
	if (err)
		goto err_destroy;
	buffer->map = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, (off_t)offset);
	if (buffer->map == MAP_FAILED) {
		err = -errno;
		goto err_destroy;
	}
	return 0;

err_destroy:
	node_destroy(fd, buffer->handle);
	buffer->map = NULL;
	return err;
}

void node_buffer_free(int fd, struct node_buffer *buffer)
{
	if (!buffer->map)
		return;
	munmap(buffer->map, buffer->size);
	node_destroy(fd, buffer->handle);
	buffer->map = NULL;
}

/* ---- packets ---- */

uint32_t node_write(uint32_t *to, uint32_t slot, uint32_t offset, const uint32_t *words,
		    uint32_t count)
{
	struct gloss_write_memory write = { .slot = slot, .offset = offset };

	gloss_write_memory_pack(to, &write, GLOSS_WRITE_MEMORY_WORDS + count);
	memcpy(to + 1 + GLOSS_WRITE_MEMORY_WORDS, words, 4 * (size_t)count);
	return 1 + GLOSS_WRITE_MEMORY_WORDS + count;
}

uint32_t node_read(uint32_t *to, uint32_t slot, uint32_t offset, uint32_t count)
{
	struct gloss_read_memory read = { .slot = slot, .count = count, .offset = offset };

	gloss_read_memory_pack(to, &read);
	return 1 + GLOSS_READ_MEMORY_WORDS;
}

uint32_t node_fill(uint32_t *to, uint32_t slot, uint32_t offset, uint32_t tile, uint32_t value)
{
	struct gloss_colour_surface surface = { .slot = slot, .pitch = 4 * tile };
	struct gloss_tile_begin begin = { .colour = value };
	struct gloss_tile_end end = { .colour_output = GLOSS_TILE_OUTPUT_STORE, .colour = offset };
	uint32_t *at = to;

	gloss_colour_surface_pack(at, &surface);
	at += 1 + GLOSS_COLOUR_SURFACE_WORDS;
	gloss_tile_begin_pack(at, &begin);
	at += 1 + GLOSS_TILE_BEGIN_WORDS;
	gloss_tile_end_pack(at, &end);
	at += 1 + GLOSS_TILE_END_WORDS;
	return (uint32_t)(at - to);
}

uint32_t node_long(uint32_t *to, uint32_t room)
{
	const struct gloss_triangle triangle = {
		.geometry = GLOSS_GEOMETRY_COVERING,
		.shading = GLOSS_SHADING_SECOND_ORDER,
	};
	const struct gloss_tile_begin begin = { .colour = 1 };
	const struct gloss_tile_end end = { .colour_output = GLOSS_TILE_OUTPUT_DROP };
	uint32_t length = 1 + gloss_triangle_length(&triangle), words = 1 + GLOSS_TILE_BEGIN_WORDS;

	gloss_tile_begin_pack(to, &begin);
	while (words + length + 1 + GLOSS_TILE_END_WORDS <= room) {
		gloss_triangle_pack(to + words, &triangle);
		words += length;
	}
	gloss_tile_end_pack(to + words, &end);
	return words + 1 + GLOSS_TILE_END_WORDS;
}

/* ---- a file that runs jobs one at a time ---- */

static int client_objects(struct client *client, uint64_t board_size)
{
	int err = node_buffer_new(client->fd, CLIENT_HOST_BYTES, &client->host);

	if (err)
		return err;
	client->stream = client->host.map;
	client->response = client->stream + CLIENT_STREAM_WORDS;
	client->status = (void *)(client->response + CLIENT_RESPONSE_WORDS);
	client->board_size = board_size;
	if (board_size)
		err = node_create(client->fd, DRM_GLOSS_GEM_BOARD, board_size, &client->board);
	return err;
}

int client_open(struct client *client, const char *path, uint64_t board_size)
{
	int err;

	*client = (struct client){ .fd = node_open(path) };
	if (client->fd < 0)
		return client->fd;
	err = node_sync_new(client->fd, &client->done);
	if (err)
		return err;
	err = node_sync_new(client->fd, &client->timeline);
	for (uint32_t n = 0; n < CLIENT_QUEUE && !err; n++)
		err = node_sync_new(client->fd, &client->queued[n]);
	if (err)
		return err;
	return client_objects(client, board_size);
}

void client_close(struct client *client)
{
	if (client->fd < 0)
		return;
	node_buffer_free(client->fd, &client->host);
	close(client->fd);
	client->fd = -1;
}

void client_prepare(struct client *client, struct client_job *job, uint32_t words,
		    uint32_t response_words)
{
	*job = (struct client_job){
		.submit = {
			.stream = words ? client->host.handle : 0,
			.stream_words = words,
			.response = response_words ? client->host.handle : 0,
			.response_words = response_words,
			.response_offset = response_words ? 4 * CLIENT_STREAM_WORDS : 0,
			.status = client->host.handle,
			.status_offset = CLIENT_STATUS_OFFSET,
			.slot_count = client->board ? 1 : 0,
			.slots = (uintptr_t)job->slot,
			.in_syncs = (uintptr_t)job->in,
			.out_syncs = (uintptr_t)job->out,
			.out_sync_count = 2,
			.slot_stride = client->board ? sizeof(job->slot[0]) : 0,
			.sync_stride = sizeof(job->out[0]),
		},
		.slot = { {
			.handle = client->board,
			.rights = client->board ? DRM_GLOSS_SLOT_READ | DRM_GLOSS_SLOT_WRITE : 0,
			.size = client->board_size,
		} },
		.out = {
			{ .handle = client->done },
			{ client->timeline, DRM_GLOSS_SYNC_TIMELINE, client->point + 1 },
		},
	};
}

int client_submit(struct client *client, const struct client_job *job)
{
	int err;

	*client->status = (struct drm_gloss_status){ 1, ~0u, ~0u, ~0u };
	err = node_submit(client->fd, &job->submit);
	if (!err)
		client->point++;
	return err;
}

int client_wait(struct client *client, int milliseconds)
{
	int err = node_wait(client->fd, client->timeline, client->point, milliseconds);

	return err ? err : node_fence_error(client->fd, client->done);
}

int client_run(struct client *client, uint32_t words, uint32_t response_words)
{
	struct client_job job;
	int err;

	client_prepare(client, &job, words, response_words);
	err = client_submit(client, &job);
	return err ? err : client_wait(client, vm_patience_ms());
}

static uint32_t queue_value(uint32_t n)
{
	return 0x90b00000 + n;
}

static volatile struct drm_gloss_status *queue_status(struct client *client, uint32_t n)
{
	return client->status + 1 + n;
}

static uint32_t *queue_response(struct client *client, uint32_t n)
{
	return client->response + n * NODE_PAGE / 4;
}

int client_queue(struct client *client, uint32_t n)
{
	uint32_t value = queue_value(n), *stream = client->stream + n * NODE_PAGE / 4;
	uint32_t words = node_write(stream, 0, 4 * n, &value, 1);
	struct client_job job;

	words += node_read(stream + words, 0, 4 * n, 1);
	client_prepare(client, &job, words, 1);
	job.submit.stream_offset = n * NODE_PAGE;
	job.submit.response_offset += n * NODE_PAGE;
	job.submit.status_offset += (1 + n) * sizeof(*client->status);
	job.submit.out_sync_count = 1;
	job.out[0].handle = client->queued[n];
	*queue_response(client, n) = ~value;
	*queue_status(client, n) = (struct drm_gloss_status){ 1, ~0u, ~0u, ~0u };
	return node_submit(client->fd, &job.submit);
}

int client_queue_wait(struct client *client, uint32_t n)
{
	const volatile struct drm_gloss_status *status = queue_status(client, n);
	int err = node_wait(client->fd, client->queued[n], 0, vm_patience_ms());

	if (err)
		return err;
	err = node_fence_error(client->fd, client->queued[n]);
	if (status->error != err)
		return -EBADMSG;
	if (!err && (status->cause || *queue_response(client, n) != queue_value(n)))
		return -EBADMSG;
	return err;
}

bool client_works(struct client *client)
{
	uint32_t value = 0x10000 + (uint32_t)client->point, words = 0;

	if (client->board) {
		words = node_write(client->stream, 0, 0, &value, 1);
		words += node_read(client->stream + words, 0, 0, 1);
		client->response[0] = ~value;
	}
	if (client_run(client, words, words ? 1 : 0))
		return false;
	return !client->status->error && !client->status->cause &&
	       client->status->offset == words &&
	       client->status->response_words == (words ? 1 : 0) &&
	       (!words || client->response[0] == value);
}
