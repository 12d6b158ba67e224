// SPDX-License-Identifier: GPL-2.0-only
/*
 * The ioctls for objects. The two kinds are in gloss_host.c and gloss_memory.c.
 */
#include <drm/drm_drv.h>
#include <drm/drm_gem.h>
#include <drm/drm_print.h>
#include <drm/drm_vma_manager.h>

#include "gloss_drv.h"
#include "gloss_file.h"

static u64 gloss_gem_size_max(struct gloss_device *gdev, u32 kind)
{
	switch (kind) {
	case DRM_GLOSS_GEM_HOST:
		return GLOSS_HOST_SIZE_MAX;
	case DRM_GLOSS_GEM_BOARD:
		return gdev->memory.size;
	default:
		return 0;
	}
}

static struct drm_gem_object *gloss_gem_new(struct gloss_device *gdev, struct drm_file *file,
					    u32 kind, u64 size)
{
	if (kind == DRM_GLOSS_GEM_HOST)
		return gloss_host_create(gdev, size);
	return gloss_board_create(gdev, to_gloss_file(file), size);
}

int gloss_gem_create_ioctl(struct drm_device *drm, void *data, struct drm_file *file)
{
	struct gloss_device *gdev = to_gloss_device(drm);
	struct drm_gloss_gem_create *args = data;
	struct drm_gem_object *object;
	int ret;

	if (gloss_device_gone(gdev))
		return -ENODEV;
	if (args->flags || args->pad || !args->size ||
	    args->size > gloss_gem_size_max(gdev, args->kind)) {
		drm_dbg(drm, "no object: kind %u, size %llu, flags %#x, pad %#x\n", args->kind,
			args->size, args->flags, args->pad);
		return -EINVAL;
	}

	object = gloss_gem_new(gdev, file, args->kind, PAGE_ALIGN(args->size));
	if (IS_ERR(object))
		return PTR_ERR(object);

	ret = drm_gem_handle_create(file, object, &args->handle);
	if (!ret)
		args->size = object->size;
	drm_gem_object_put(object);
	return ret;
}

int gloss_gem_mmap_offset_ioctl(struct drm_device *drm, void *data, struct drm_file *file)
{
	struct drm_gloss_gem_mmap_offset *args = data;
	struct drm_gem_object *object;
	int ret = -EINVAL;

	if (args->pad)
		return -EINVAL;

	object = drm_gem_object_lookup(file, args->handle);
	if (!object)
		return -ENOENT;

	if (gloss_gem_is_host(object) && !object->import_attach) {
		args->offset = drm_vma_node_offset_addr(&object->vma_node);
		ret = 0;
	} else {
		drm_dbg(drm, "object %u can not be mapped\n", args->handle);
	}
	drm_gem_object_put(object);
	return ret;
}
