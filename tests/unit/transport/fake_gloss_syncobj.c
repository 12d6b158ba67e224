/* SPDX-License-Identifier: MIT */
/* DRM syncobjs as the kernel has them: points of a time line, and sync files. */
#include <errno.h>
#include <fcntl.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "fake_gloss_priv.h"

#define NS_PER_S 1000000000

struct syncobj *fake_syncobj_find(struct file *file, uint32_t handle)
{
	struct syncobj *syncobj = &file->syncobj[handle - 1];

	return handle && handle <= SYNCOBJS && syncobj->used ? syncobj : NULL;
}

int fake_syncobj_create(struct file *file, struct drm_syncobj_create *create)
{
	if (create->flags)
		return -EINVAL;
	for (uint32_t i = 0; i < SYNCOBJS; i++) {
		if (file->syncobj[i].used)
			continue;
		file->syncobj[i] = (struct syncobj){ .used = true };
		create->handle = i + 1;
		fake_gloss.syncobjs++;
		return 0;
	}
	return -ENOMEM;
}

int fake_syncobj_destroy(struct file *file, const struct drm_syncobj_destroy *destroy)
{
	struct syncobj *syncobj = fake_syncobj_find(file, destroy->handle);

	if (destroy->pad || !syncobj)
		return -EINVAL;
	syncobj->used = false;
	fake_gloss.syncobjs--;
	return 0;
}

int fake_syncobj_wait(struct file *file, const struct drm_syncobj_timeline_wait *wait)
{
	const uint32_t *handle = (const void *)(uintptr_t)wait->handles;
	const uint64_t *point = (const void *)(uintptr_t)wait->points;
	const struct timespec deadline = { wait->timeout_nsec / NS_PER_S,
					   wait->timeout_nsec % NS_PER_S };
	struct syncobj *syncobj = fake_syncobj_find(file, *handle);

	if (wait->count_handles != 1 || wait->flags || wait->pad)
		return -EINVAL;
	if (!syncobj)
		return -ENOENT;
	if (*point > syncobj->submitted)
		return -EINVAL;
	fake_gloss.waits++;
	while (syncobj->signalled < *point)
		if (wait->timeout_nsec < 0 ||
		    pthread_cond_timedwait(&fake.changed, &fake.lock, &deadline) == ETIMEDOUT)
			return syncobj->signalled < *point ? -ETIME : 0;
	return 0;
}

int fake_syncobj_transfer(struct file *file, const struct drm_syncobj_transfer *transfer)
{
	struct syncobj *from = fake_syncobj_find(file, transfer->src_handle);
	struct syncobj *to = fake_syncobj_find(file, transfer->dst_handle);

	if (!from || !to)
		return -ENOENT;
	if (transfer->flags || transfer->pad || transfer->dst_point ||
	    transfer->src_point > from->submitted)
		return -EINVAL;
	to->source = from;
	to->point = transfer->src_point;
	return 0;
}

int fake_syncobj_export(struct file *file, struct drm_syncobj_handle *handle)
{
	struct syncobj *syncobj = fake_syncobj_find(file, handle->handle), *source;
	int i = 0;

	if (!syncobj)
		return -ENOENT;
	source = syncobj->source;
	if (handle->flags != DRM_SYNCOBJ_HANDLE_TO_FD_FLAGS_EXPORT_SYNC_FILE || handle->pad ||
	    !source)
		return -EINVAL;
	handle->fd = eventfd(source->signalled >= syncobj->point, EFD_CLOEXEC);
	if (handle->fd < 0 || source->signalled >= syncobj->point)
		return handle->fd < 0 ? -errno : 0;
	while (source->sync_file[i])
		i++;
	source->sync_file[i] = fcntl(handle->fd, F_DUPFD_CLOEXEC, 3);
	source->sync_point[i] = syncobj->point;
	return 0;
}

void fake_syncobj_signal(struct syncobj *syncobj)
{
	for (int i = 0; i < SYNC_FILES; i++) {
		if (!syncobj->sync_file[i] || syncobj->sync_point[i] > syncobj->signalled)
			continue;
		eventfd_write(syncobj->sync_file[i], 1);
		syscall(SYS_close, syncobj->sync_file[i]);
		syncobj->sync_file[i] = 0;
	}
}
