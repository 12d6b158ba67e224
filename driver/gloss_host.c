// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Host objects
 *
 * Pages of shared memory, or those of a dma-buf. The board finds them through a list of
 * bus addresses, one for 4096 bytes (gloss_list.c). Pages are pinned and mapped, and the
 * list is made, when an object is first used in a job; that lasts until the object goes,
 * or until memory is short while no job uses it, so that jobs after the first allocate
 * nothing for it.
 *
 * All of that is done under the object's own lock: whoever submits waits for nobody else's
 * pages.
 *
 * Programs, driver and board use the pages without any synchronisation but the fences,
 * so the mapping must be coherent; elsewhere the object can not be used. What a program maps
 * is the shared memory itself, which counts in its size and may be swapped out.
 *
 * A driver that is unbound must have nothing mapped, while an object lives as long as its
 * file. So there is a list of all, which gloss_hosts_unmap() goes through.
 */
#include <drm/drm_drv.h>
#include <drm/drm_gem.h>
#include <drm/drm_managed.h>
#include <drm/drm_prime.h>
#include <drm/drm_print.h>
#include <linux/dma-buf.h>
#include <linux/dma-mapping.h>
#include <linux/mm.h>
#include <linux/pagemap.h>
#include <linux/slab.h>

#include "gloss_drv.h"
#include "gloss_file.h"

static unsigned long gloss_host_page_count(const struct gloss_host_object *host)
{
	return host->base.base.size >> PAGE_SHIFT;
}

static bool gloss_host_charge(struct gloss_host_object *host, struct gloss_file *file)
{
	unsigned long count = gloss_host_page_count(host);
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;

	return gloss_pages_charge(file, count) ||
	       (gloss_pages_shrink(hosts, count) && gloss_pages_charge(file, count));
}

/* The pages are charged to @file until they are unpinned. */
static int gloss_host_pin(struct gloss_host_object *host, struct gloss_file *file)
{
	struct page **pages;

	if (host->pages || gloss_host_imported(host))
		return 0;

	if (!gloss_host_charge(host, file)) {
		drm_dbg(host->base.base.dev, "%lu pages more are too many to pin\n",
			gloss_host_page_count(host));
		return -ENOMEM;
	}
	pages = gloss_pages_get(&host->base.base);
	if (IS_ERR(pages)) {
		gloss_pages_uncharge(file, gloss_host_page_count(host));
		return PTR_ERR(pages);
	}
	host->pages = pages;
	host->payer = file;
	return 0;
}

static void gloss_host_unpin(struct gloss_host_object *host)
{
	if (!host->pages)
		return;

	gloss_pages_put(&host->base.base, host->pages);
	host->pages = NULL;
	gloss_pages_uncharge(host->payer, gloss_host_page_count(host));
}

static int gloss_host_map(struct gloss_host_object *host, struct gloss_file *file)
{
	int ret;

	if (host->list)
		return 0;

	ret = gloss_host_pin(host, file) ?: gloss_list_make(host);
	if (ret)
		gloss_host_unpin(host);
	return ret;
}

/* Takes an object that no job uses off the list of these; under gloss_hosts.idle_lock. */
void gloss_host_set_busy(struct gloss_host_object *host)
{
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;

	if (list_empty(&host->idle))
		return;
	list_del_init(&host->idle);
	hosts->idle_pages -= gloss_host_page_count(host);
}

static void gloss_host_begin_use(struct gloss_host_object *host)
{
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;

	spin_lock(&hosts->idle_lock);
	host->uses++;
	gloss_host_set_busy(host);
	spin_unlock(&hosts->idle_lock);
}

/*
 * Makes sure that the board can reach the object, as long as the board is there, until
 * gloss_host_end_use(). Pages that have to be pinned for that are charged to @file.
 */
int gloss_host_use(struct gloss_host_object *host, struct gloss_file *file)
{
	int ret, idx;

	if (!drm_dev_enter(host->base.base.dev, &idx))
		return -ENODEV;

	ret = mutex_lock_interruptible(&host->lock);
	if (!ret) {
		ret = gloss_host_map(host, file);
		if (!ret)
			gloss_host_begin_use(host);
		mutex_unlock(&host->lock);
	}
	drm_dev_exit(idx);
	return ret;
}

void gloss_host_end_use(struct gloss_host_object *host)
{
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;

	spin_lock(&hosts->idle_lock);
	if (!--host->uses && host->pages) {
		list_add_tail(&host->idle, &hosts->idle);
		hosts->idle_pages += gloss_host_page_count(host);
	}
	spin_unlock(&hosts->idle_lock);
}

/* Unpins an object that no job uses, if that takes no waiting; how many pages that were. */
unsigned long gloss_host_try_unpin(struct gloss_host_object *host)
{
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;
	unsigned long freed = 0;

	/* Who has it is about to use the object, and then to list it as idle again. */
	if (!mutex_trylock(&host->lock))
		return 0;

	spin_lock(&hosts->idle_lock);
	if (!host->uses && host->pages) {
		freed = gloss_host_page_count(host);
		gloss_host_set_busy(host);
	}
	spin_unlock(&hosts->idle_lock);
	if (freed) {
		gloss_list_unmake(host);
		gloss_host_unpin(host);
	}
	mutex_unlock(&host->lock);
	return freed;
}

static void gloss_host_unmap_import(struct gloss_host_object *host)
{
	if (gloss_host_imported(host) && host->base.sgt) {
		gloss_compat_dma_buf_unmap(host->attach, host->base.sgt);
		host->base.sgt = NULL;
	}
}

/*
 * The board has gone, and drm_dev_unplug() has returned: takes all objects from it, for good.
 * Their pages stay, as the jobs that end now write their status there.
 */
void gloss_hosts_unmap(struct gloss_device *gdev)
{
	struct gloss_hosts *hosts = &gdev->hosts;
	struct gloss_host_object *host;

	mutex_lock(&hosts->lock);
	list_for_each_entry(host, &hosts->list, node) {
		mutex_lock(&host->lock);
		gloss_list_unmake(host);
		gloss_host_unmap_import(host);
		mutex_unlock(&host->lock);
	}
	mutex_unlock(&hosts->lock);
}

int gloss_hosts_init(struct gloss_device *gdev)
{
	INIT_LIST_HEAD(&gdev->hosts.list);
	INIT_LIST_HEAD(&gdev->hosts.idle);
	spin_lock_init(&gdev->hosts.idle_lock);
	/* The pieces of a dma-buf may be as long as it likes. */
	dma_set_max_seg_size(gdev->drm.dev, UINT_MAX);
	return drmm_mutex_init(&gdev->drm, &gdev->hosts.lock);
}

static void gloss_host_free(struct drm_gem_object *object)
{
	struct gloss_host_object *host = to_gloss_host(object);
	struct gloss_hosts *hosts = &to_gloss_device(object->dev)->hosts;

	mutex_lock(&host->lock);
	spin_lock(&hosts->idle_lock);
	gloss_host_set_busy(host);
	spin_unlock(&hosts->idle_lock);
	gloss_list_unmake(host);
	gloss_host_unmap_import(host);
	gloss_host_unpin(host);
	mutex_unlock(&host->lock);

	/* Last, so that gloss_hosts_unmap() does not return while that is mapped. */
	mutex_lock(&hosts->lock);
	list_del(&host->node);
	mutex_unlock(&hosts->lock);
	mutex_destroy(&host->lock);
	drm_gem_shmem_free(&host->base);
}

/* For another driver, which reaches the pages through a dma-buf. No file is known to pay. */
static int gloss_host_pin_export(struct drm_gem_object *object)
{
	unsigned long count = object->size >> PAGE_SHIFT;
	int ret;

	if (!gloss_pages_charge(NULL, count))
		return -ENOMEM;

	ret = drm_gem_shmem_object_pin(object);
	if (ret)
		gloss_pages_uncharge(NULL, count);
	return ret;
}

static void gloss_host_unpin_export(struct drm_gem_object *object)
{
	drm_gem_shmem_object_unpin(object);
	gloss_pages_uncharge(NULL, object->size >> PAGE_SHIFT);
}

static int gloss_host_mmap(struct drm_gem_object *object, struct vm_area_struct *vma)
{
	int ret;

	if (gloss_host_imported(to_gloss_host(object)))
		return drm_gem_shmem_object_mmap(object, vma);
	if (gloss_compat_is_cow_mapping(vma))
		return -EINVAL;

	/* Of the object's own file, without the object's place in the node. */
	vma->vm_pgoff -= drm_vma_node_start(&object->vma_node);
	ret = gloss_compat_mmap(object->filp, vma);
	if (ret)
		return ret;

	vma_set_file(vma, object->filp);
	gloss_compat_vm_flags_set(vma, VM_DONTEXPAND);
	/* The reference that was for the mapping, which has its file's now. */
	drm_gem_object_put(object);
	return 0;
}

const struct drm_gem_object_funcs gloss_host_funcs = {
	.free = gloss_host_free,
	.print_info = drm_gem_shmem_object_print_info,
	.pin = gloss_host_pin_export,
	.unpin = gloss_host_unpin_export,
	.get_sg_table = drm_gem_shmem_object_get_sg_table,
	.vmap = drm_gem_shmem_object_vmap,
	.vunmap = drm_gem_shmem_object_vunmap,
	.mmap = gloss_host_mmap,
	.vm_ops = &drm_gem_shmem_vm_ops,
};

/* drm_driver.gem_create_object: the shmem helpers fill in the rest. */
struct drm_gem_object *gloss_host_new(struct drm_device *drm, size_t size)
{
	struct gloss_host_object *host = kzalloc(sizeof(*host), GFP_KERNEL_ACCOUNT);

	/* drm_gem_shmem_free() frees what it knows of, and with that all of it. */
	BUILD_BUG_ON(offsetof(struct gloss_host_object, base));
	if (!host)
		return ERR_PTR(-ENOMEM);

	mutex_init(&host->lock);
	INIT_LIST_HEAD(&host->node);
	INIT_LIST_HEAD(&host->idle);
	INIT_WORK(&host->put, gloss_pages_put_work);
	host->base.base.funcs = &gloss_host_funcs;
	/* What another driver writes reaches no dirty bit of a page table. */
	host->base.pages_mark_dirty_on_put = true;
	return &host->base.base;
}

static void gloss_hosts_add(struct gloss_host_object *host)
{
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;

	mutex_lock(&hosts->lock);
	list_add(&host->node, &hosts->list);
	mutex_unlock(&hosts->lock);
}

struct drm_gem_object *gloss_host_create(struct gloss_device *gdev, size_t size)
{
	struct drm_gem_shmem_object *shmem = drm_gem_shmem_create(&gdev->drm, size);

	/* shmem's word for no memory for an inode; here it is board memory that may be full. */
	if (shmem == ERR_PTR(-ENOSPC))
		return ERR_PTR(-ENOMEM);
	if (IS_ERR(shmem))
		return ERR_CAST(shmem);

	/* A program that touches what it mapped waits for memory, as for any of its own. */
	mapping_set_gfp_mask(shmem->base.filp->f_mapping, GFP_HIGHUSER);
	gloss_hosts_add(to_gloss_host(&shmem->base));
	return &shmem->base;
}

/* drm_driver.gem_prime_import_sg_table: the dma-buf is mapped from the start. */
struct drm_gem_object *gloss_host_import(struct drm_device *drm,
					 struct dma_buf_attachment *attach, struct sg_table *sgt)
{
	struct drm_gem_object *object;
	int idx;

	if (!attach->dmabuf->size || attach->dmabuf->size > GLOSS_HOST_SIZE_MAX)
		return ERR_PTR(-EINVAL);
	if (!drm_dev_enter(drm, &idx))
		return ERR_PTR(-ENODEV);

	object = drm_gem_shmem_prime_import_sg_table(drm, attach, sgt);
	if (!IS_ERR(object)) {
		to_gloss_host(object)->attach = attach;
		gloss_hosts_add(to_gloss_host(object));
	}
	drm_dev_exit(idx);
	return object;
}
