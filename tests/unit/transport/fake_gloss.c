/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#include <xf86drm.h>

#include "fake_gloss_priv.h"

struct fake_gloss fake_gloss;
struct fake_state fake = { .lock = PTHREAD_MUTEX_INITIALIZER };

static struct file files[FILES];
static struct object objects[OBJECTS];

/* ---- objects ---- */

static bool object_fits(uint32_t kind, uint64_t base, uint64_t size, uint64_t *next)
{
	for (const struct object *o = objects; o < objects + OBJECTS; o++) {
		if (!o->uses || o->kind != kind || o->base >= base + size ||
		    base >= o->base + o->size)
			continue;
		*next = o->base + o->size;
		return false;
	}
	return true;
}

static struct object *object_new(uint32_t kind, uint64_t size)
{
	uint64_t base = 0, room = kind == DRM_GLOSS_GEM_HOST ? HOST_BYTES : FAKE_BOARD_BYTES;
	struct object *o = objects;

	while (base + size <= room && !object_fits(kind, base, size, &base))
		;
	while (o < objects + OBJECTS && o->uses)
		o++;
	if (base + size > room || o == objects + OBJECTS)
		return NULL;
	*o = (struct object){ .uses = 1, .kind = kind, .base = base, .size = size };
	if (kind == DRM_GLOSS_GEM_BOARD)
		memset(fake.board + base, 0, size);
	else
		fallocate(fake.host_fd, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, (off_t)base,
			  (off_t)size);
	return o;
}

struct object *fake_handle_find(const struct file *file, uint32_t handle)
{
	return handle && handle <= OBJECTS ? file->handle[handle - 1] : NULL;
}

static int handle_close(struct file *file, uint32_t handle)
{
	struct object *o = fake_handle_find(file, handle);

	if (!o)
		return -EINVAL;
	file->handle[handle - 1] = NULL;
	fake_gloss.handles--;
	if (o->kind == DRM_GLOSS_GEM_HOST)
		fake_gloss.host_bytes -= o->size;
	o->uses--;
	return 0;
}

/* ---- ioctls; called with the lock held ---- */

static int get_param(const struct file *file, struct drm_gloss_get_param *get)
{
	const uint64_t value[] = {
		[DRM_GLOSS_PARAM_VERSION] = fake_gloss.version,
		[DRM_GLOSS_PARAM_TILE_SIZE] = fake_gloss.tile_size,
		[DRM_GLOSS_PARAM_PIXELS_PER_CLOCK] = 8,
		[DRM_GLOSS_PARAM_MEMORY_SIZE] = FAKE_BOARD_BYTES,
		[DRM_GLOSS_PARAM_SLOTS] = GLOSS_SLOTS,
		[DRM_GLOSS_PARAM_STREAM_WORDS_MAX] = FAKE_WORDS_MAX,
	};

	(void)file;
	if (get->pad || get->param >= sizeof(value) / sizeof(value[0]))
		return -EINVAL;
	get->value = value[get->param];
	return 0;
}

static int gem_create(struct file *file, struct drm_gloss_gem_create *create)
{
	uint64_t size = (create->size + PAGE - 1) / PAGE * PAGE;
	struct object *o;
	uint32_t handle = 0;

	if (create->kind > DRM_GLOSS_GEM_BOARD || create->flags || create->pad || create->handle ||
	    !create->size || create->size > 1ull << 32)
		return -EINVAL;
	fake_gloss.creates++;
	while (handle < OBJECTS && file->handle[handle])
		handle++;
	o = handle < OBJECTS ? object_new(create->kind, size) : NULL;
	if (!o)
		return create->kind == DRM_GLOSS_GEM_BOARD ? -ENOSPC : -ENOMEM;
	file->handle[handle] = o;
	fake_gloss.handles++;
	if (create->kind == DRM_GLOSS_GEM_HOST)
		fake_gloss.host_bytes += size;
	create->handle = handle + 1;
	create->size = size;
	return 0;
}

static int gem_mmap_offset(const struct file *file, struct drm_gloss_gem_mmap_offset *map)
{
	const struct object *o = fake_handle_find(file, map->handle);

	if (map->pad)
		return -EINVAL;
	if (!o)
		return -ENOENT;
	map->offset = o->base;
	return o->kind == DRM_GLOSS_GEM_HOST ? 0 : -EINVAL;
}

/* A text as DRM_IOCTL_VERSION gives it: cut to the room, with its whole length. */
static void version_text(const char *text, char *to, __kernel_size_t *room)
{
	size_t length = strlen(text);

	if (*room)
		memcpy(to, text, *room < length ? *room : length);
	*room = length;
}

static int version(const struct file *file, struct drm_version *to)
{
	to->version_major = 1;
	version_text(fake_gloss.node[file->node].driver, to->name, &to->name_len);
	version_text("20260101", to->date, &to->date_len);
	version_text("a board of a test", to->desc, &to->desc_len);
	return 0;
}

static int gem_close(struct file *file, const struct drm_gem_close *gem)
{
	return gem->pad ? -EINVAL : handle_close(file, gem->handle);
}

/* Six numbers that differ, if the board has a clock. */
static int get_clocks(struct drm_gloss_get_clocks *clocks)
{
	if (!fake_gloss.has_clock)
		return -EOPNOTSUPP;
	*clocks = (struct drm_gloss_get_clocks){
		.clocks = 1ull << 40,
		2,
		3,
		4,
		5,
		6,
	};
	return 0;
}

static int dispatch(struct file *file, unsigned long request, void *argument)
{
	switch (request) {
	case DRM_IOCTL_VERSION:
		return version(file, argument);
	case DRM_IOCTL_GEM_CLOSE:
		return gem_close(file, argument);
	case DRM_IOCTL_SYNCOBJ_CREATE:
		return fake_syncobj_create(file, argument);
	case DRM_IOCTL_SYNCOBJ_DESTROY:
		return fake_syncobj_destroy(file, argument);
	case DRM_IOCTL_SYNCOBJ_TIMELINE_WAIT:
		return fake_syncobj_wait(file, argument);
	case DRM_IOCTL_SYNCOBJ_TRANSFER:
		return fake_syncobj_transfer(file, argument);
	case DRM_IOCTL_SYNCOBJ_HANDLE_TO_FD:
		return fake_syncobj_export(file, argument);
	case DRM_IOCTL_GLOSS_GET_PARAM:
		return get_param(file, argument);
	case DRM_IOCTL_GLOSS_GEM_CREATE:
		return gem_create(file, argument);
	case DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET:
		return gem_mmap_offset(file, argument);
	case DRM_IOCTL_GLOSS_SUBMIT:
		return fake_job_submit(file, argument);
	case DRM_IOCTL_GLOSS_GET_CLOCKS:
		return get_clocks(argument);
	default:
		return -ENOTTY;
	}
}

/* Whether this call is the one that is to fail. */
static bool fails(unsigned int number)
{
	return fake_gloss.fail_at &&
	       (!fake_gloss.fail_request || fake_gloss.fail_request == number) &&
	       !--fake_gloss.fail_at;
}

static int file_ioctl(struct file *file, unsigned long request, void *argument)
{
	fake_gloss.ioctls++;
	if (fails(_IOC_NR(request)))
		return -fake_gloss.fail_errno;
	return fake.gone ? -ENODEV : dispatch(file, request, argument);
}

/* ---- files ---- */

static struct file *file_find(int fd)
{
	for (struct file *file = files; file < files + FILES; file++)
		if (file->fd && file->fd == fd)
			return file;
	return NULL;
}

/* In place of the C library's, for libdrm too. */
int ioctl(int fd, unsigned long request, ...);
int ioctl(int fd, unsigned long request, ...)
{
	struct file *file;
	va_list arguments;
	void *argument;
	int err;

	va_start(arguments, request);
	argument = va_arg(arguments, void *);
	va_end(arguments);
	pthread_mutex_lock(&fake.lock);
	file = file_find(fd);
	err = file ? file_ioctl(file, request, argument) : 0;
	pthread_mutex_unlock(&fake.lock);
	if (!file)
		return (int)syscall(SYS_ioctl, fd, request, argument);
	errno = -err;
	return err ? -1 : 0;
}

int fake_file_open(unsigned int node)
{
	struct file *file = files;
	int fd = -EMFILE;

	pthread_mutex_lock(&fake.lock);
	while (file < files + FILES && file->fd)
		file++;
	if (file < files + FILES) {
		fd = fcntl(fake.host_fd, F_DUPFD_CLOEXEC, 3);
		*file = (struct file){ .fd = fd, .node = node };
		fake_gloss.files++;
		fake_gloss.opened = node;
	}
	pthread_mutex_unlock(&fake.lock);
	return fd;
}

void fake_file_close(int fd)
{
	struct file *file;

	pthread_mutex_lock(&fake.lock);
	file = file_find(fd);
	if (file) {
		for (uint32_t handle = 1; handle <= OBJECTS; handle++)
			fake_gloss.left += !handle_close(file, handle);
		for (uint32_t i = 0; i < SYNCOBJS; i++) {
			fake_gloss.left += file->syncobj[i].used;
			fake_gloss.syncobjs -= file->syncobj[i].used;
		}
		fake_gloss.files--;
		file->fd = 0;
	}
	pthread_mutex_unlock(&fake.lock);
}

/* ---- what a test does ---- */

static void fake_set(bool *flag, bool value)
{
	pthread_mutex_lock(&fake.lock);
	*flag = value;
	pthread_cond_broadcast(&fake.changed);
	pthread_mutex_unlock(&fake.lock);
}

static void start_clock(void)
{
	pthread_condattr_t attributes;

	pthread_condattr_init(&attributes);
	pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
	pthread_cond_init(&fake.changed, &attributes);
	pthread_condattr_destroy(&attributes);
}

void fake_gloss_start(void)
{
	fake_gloss = (struct fake_gloss){
		.node[0] = { .present = true, .mode = 0660, .driver = "gloss" },
		.module_loaded = true,
		.version = GLOSS_VERSION,
		.tile_size = 64,
	};
	memset(objects, 0, sizeof(objects));
	memset(files, 0, sizeof(files));
	fake.held = fake.gone = false;
	fake.lose_error = 0;
	fake.host_fd = memfd_create("gloss", MFD_CLOEXEC);
	if (fake.host_fd < 0 || ftruncate(fake.host_fd, HOST_BYTES))
		abort();
	fake.host = mmap(NULL, HOST_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED, fake.host_fd, 0);
	if (fake.host == MAP_FAILED)
		abort();
	start_clock();
	fake_job_start();
}

void fake_gloss_stop(void)
{
	fake_job_stop();
	pthread_cond_destroy(&fake.changed);
	munmap(fake.host, HOST_BYTES);
	close(fake.host_fd);
}

void fake_gloss_hold(void)
{
	fake_set(&fake.held, true);
}

void fake_gloss_release(void)
{
	fake_set(&fake.held, false);
}

void fake_gloss_lose(unsigned int after, int error)
{
	pthread_mutex_lock(&fake.lock);
	fake.lose_after = after;
	fake.lose_error = error;
	pthread_mutex_unlock(&fake.lock);
}

void fake_gloss_unplug(void)
{
	fake_set(&fake.gone, true);
}

/* Its own mapping is one. */
unsigned int fake_gloss_mappings(void)
{
	FILE *maps = fopen("/proc/self/maps", "r");
	unsigned int count = 0;
	char line[512];

	while (maps && fgets(line, sizeof(line), maps))
		count += strstr(line, "memfd:gloss") != NULL;
	if (maps)
		fclose(maps);
	return count - 1;
}
