// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Host objects
 *
 * Pages of shared memory, or those of a dma-buf. The board finds them through a list of
 * bus addresses, one for 4096 bytes. Pages are pinned and mapped, and the list is made,
 * when the object is first used in a job; that lasts until the object goes, so that jobs
 * after the first allocate nothing for it.
 *
 * Programs, driver and board use the pages without any synchronisation but the fences,
 * so the mapping must be coherent; elsewhere the object can not be used.
 *
 * A driver that is unbound must have nothing mapped, while an object lives as long as its
 * file. So there is a list of those that are mapped, which gloss_hosts_unmap() empties.
 */
#include <drm/drm_gem.h>
#include <drm/drm_managed.h>
#include <drm/drm_prime.h>
#include <drm/drm_print.h>
#include <linux/dma-buf.h>
#include <linux/dma-mapping.h>
#include <linux/slab.h>

#include "gloss_drv.h"

#define GLOSS_PAGES_PER_PAGE	(PAGE_SIZE / GLOSS_PAGE_BYTES)

static unsigned int gloss_host_entries(const struct gloss_host *host)
{
	return host->base.base.size / GLOSS_PAGE_BYTES;
}

static struct device *gloss_host_device(const struct gloss_host *host)
{
	return host->base.base.dev->dev;
}

/* Unmaps the pages of the first @entries of the list. */
static void gloss_host_unmap_pages(struct gloss_host *host, unsigned int entries)
{
	unsigned int i;

	for (i = 0; i < entries; i += GLOSS_PAGES_PER_PAGE)
		dma_unmap_page(gloss_host_device(host), le64_to_cpu(host->list[i]), PAGE_SIZE,
			       DMA_BIDIRECTIONAL);
}

static int gloss_host_check(const struct gloss_host *host, dma_addr_t address)
{
	if (dma_need_sync(gloss_host_device(host), address)) {
		drm_dbg(host->base.base.dev, "this machine's DMA is not coherent\n");
		return -EOPNOTSUPP;
	}
	return 0;
}

static int gloss_host_map_pages(struct gloss_host *host)
{
	struct device *dev = gloss_host_device(host);
	unsigned int entries = gloss_host_entries(host);
	unsigned int i, j;
	int ret;

	for (i = 0; i < entries; i += GLOSS_PAGES_PER_PAGE) {
		dma_addr_t address = dma_map_page(dev, host->base.pages[i / GLOSS_PAGES_PER_PAGE],
						  0, PAGE_SIZE, DMA_BIDIRECTIONAL);

		ret = -ENOMEM;
		if (dma_mapping_error(dev, address))
			goto unmap;
		for (j = 0; j < GLOSS_PAGES_PER_PAGE; j++)
			host->list[i + j] = cpu_to_le64(address + j * GLOSS_PAGE_BYTES);
		ret = gloss_host_check(host, address);
		if (ret) {
			i += GLOSS_PAGES_PER_PAGE;
			goto unmap;
		}
	}
	return 0;

unmap:
	gloss_host_unmap_pages(host, i);
	return ret;
}

/* The pages of an imported object are mapped already. */
static int gloss_host_list_pages(struct gloss_host *host)
{
	unsigned int entries = gloss_host_entries(host);
	unsigned int i, entry = 0;
	struct scatterlist *sg;
	u64 offset;
	int ret;

	for_each_sgtable_dma_sg(host->base.sgt, sg, i) {
		if (!IS_ALIGNED(sg_dma_address(sg) | sg_dma_len(sg), GLOSS_PAGE_BYTES)) {
			drm_dbg(host->base.base.dev, "a dma-buf in pieces of less than a page\n");
			return -EINVAL;
		}
		ret = gloss_host_check(host, sg_dma_address(sg));
		if (ret)
			return ret;
		for (offset = 0; offset < sg_dma_len(sg) && entry < entries;
		     offset += GLOSS_PAGE_BYTES)
			host->list[entry++] = cpu_to_le64(sg_dma_address(sg) + offset);
	}
	return entry == entries ? 0 : -EINVAL;
}

static int gloss_host_map_list(struct gloss_host *host)
{
	struct device *dev = gloss_host_device(host);

	host->list_address = dma_map_single(dev, host->list,
					    gloss_host_entries(host) * sizeof(*host->list),
					    DMA_TO_DEVICE);
	return dma_mapping_error(dev, host->list_address) ? -ENOMEM : 0;
}

static bool gloss_host_imported(const struct gloss_host *host)
{
	return host->attach;
}

static int gloss_host_make_list(struct gloss_host *host)
{
	int ret;

	host->list = kmalloc_array(gloss_host_entries(host), sizeof(*host->list),
				   GFP_KERNEL | __GFP_NOWARN);
	if (!host->list)
		return -ENOMEM;

	ret = gloss_host_imported(host) ? gloss_host_list_pages(host) : gloss_host_map_pages(host);
	if (ret)
		goto free;

	ret = gloss_host_map_list(host);
	if (ret)
		goto unmap;
	return 0;

unmap:
	if (!gloss_host_imported(host))
		gloss_host_unmap_pages(host, gloss_host_entries(host));
free:
	kfree(host->list);
	host->list = NULL;
	return ret;
}

static int gloss_host_pin(struct gloss_host *host)
{
	int ret;

	if (host->pinned || gloss_host_imported(host))
		return 0;

	ret = drm_gem_shmem_pin(&host->base);
	host->pinned = !ret;
	return ret;
}

/* Makes sure that the board can reach the object, as long as it is there. */
int gloss_host_map(struct gloss_host *host)
{
	struct gloss_hosts *hosts = &to_gloss_device(host->base.base.dev)->hosts;
	int ret = 0;

	mutex_lock(&hosts->lock);
	if (hosts->gone) {
		ret = -ENODEV;
	} else if (!host->list) {
		ret = gloss_host_pin(host) ?: gloss_host_make_list(host);
		if (!ret)
			list_move(&host->node, &hosts->list);
	}
	mutex_unlock(&hosts->lock);
	return ret;
}

static void gloss_host_drop_list(struct gloss_host *host)
{
	unsigned int entries = gloss_host_entries(host);

	dma_unmap_single(gloss_host_device(host), host->list_address,
			 entries * sizeof(*host->list), DMA_TO_DEVICE);
	if (!gloss_host_imported(host))
		gloss_host_unmap_pages(host, entries);
	kfree(host->list);
	host->list = NULL;
}

static void gloss_host_unmap(struct gloss_host *host)
{
	if (host->list)
		gloss_host_drop_list(host);
	if (gloss_host_imported(host) && host->base.sgt) {
		gloss_compat_dma_buf_unmap(host->attach, host->base.sgt);
		host->base.sgt = NULL;
	}
	list_del_init(&host->node);
}

/* The board has gone: takes all objects from it, for good. Their pages stay. */
void gloss_hosts_unmap(struct gloss_device *gdev)
{
	struct gloss_hosts *hosts = &gdev->hosts;
	struct gloss_host *host, *next;

	mutex_lock(&hosts->lock);
	hosts->gone = true;
	list_for_each_entry_safe(host, next, &hosts->list, node)
		gloss_host_unmap(host);
	mutex_unlock(&hosts->lock);
}

int gloss_hosts_init(struct gloss_device *gdev)
{
	INIT_LIST_HEAD(&gdev->hosts.list);
	/* The pieces of a dma-buf may be as long as it likes. */
	dma_set_max_seg_size(gdev->drm.dev, UINT_MAX);
	return drmm_mutex_init(&gdev->drm, &gdev->hosts.lock);
}

static void gloss_host_free(struct drm_gem_object *object)
{
	struct gloss_host *host = to_gloss_host(object);
	struct gloss_hosts *hosts = &to_gloss_device(object->dev)->hosts;

	mutex_lock(&hosts->lock);
	gloss_host_unmap(host);
	mutex_unlock(&hosts->lock);
	if (host->pinned)
		drm_gem_shmem_unpin(&host->base);
	drm_gem_shmem_free(&host->base);
}

const struct drm_gem_object_funcs gloss_host_funcs = {
	.free = gloss_host_free,
	.print_info = drm_gem_shmem_object_print_info,
	.pin = drm_gem_shmem_object_pin,
	.unpin = drm_gem_shmem_object_unpin,
	.get_sg_table = drm_gem_shmem_object_get_sg_table,
	.vmap = drm_gem_shmem_object_vmap,
	.vunmap = drm_gem_shmem_object_vunmap,
	.mmap = drm_gem_shmem_object_mmap,
	.vm_ops = &drm_gem_shmem_vm_ops,
};

/* drm_driver.gem_create_object: the shmem helpers fill in the rest. */
struct drm_gem_object *gloss_host_new(struct drm_device *drm, size_t size)
{
	struct gloss_host *host = kzalloc(sizeof(*host), GFP_KERNEL);

	/* drm_gem_shmem_free() frees what it knows of, and with that all of it. */
	BUILD_BUG_ON(offsetof(struct gloss_host, base));
	if (!host)
		return ERR_PTR(-ENOMEM);

	INIT_LIST_HEAD(&host->node);
	host->base.base.funcs = &gloss_host_funcs;
	/* What programs and the board write reaches no dirty bit of a page table. */
	host->base.pages_mark_dirty_on_put = true;
	return &host->base.base;
}

struct drm_gem_object *gloss_host_create(struct gloss_device *gdev, size_t size)
{
	struct drm_gem_shmem_object *shmem = drm_gem_shmem_create(&gdev->drm, size);

	/* shmem's word for no memory for an inode; here it is board memory that may be full. */
	if (shmem == ERR_PTR(-ENOSPC))
		return ERR_PTR(-ENOMEM);
	return IS_ERR(shmem) ? ERR_CAST(shmem) : &shmem->base;
}

/* drm_driver.gem_prime_import_sg_table: the dma-buf is mapped from the start. */
struct drm_gem_object *gloss_host_import(struct drm_device *drm,
					 struct dma_buf_attachment *attach, struct sg_table *sgt)
{
	struct gloss_hosts *hosts = &to_gloss_device(drm)->hosts;
	struct drm_gem_object *object;

	if (!attach->dmabuf->size || attach->dmabuf->size > GLOSS_HOST_SIZE_MAX)
		return ERR_PTR(-EINVAL);

	mutex_lock(&hosts->lock);
	object = hosts->gone ? ERR_PTR(-ENODEV) :
			       drm_gem_shmem_prime_import_sg_table(drm, attach, sgt);
	if (!IS_ERR(object)) {
		struct gloss_host *host = to_gloss_host(object);

		host->attach = attach;
		list_add(&host->node, &hosts->list);
	}
	mutex_unlock(&hosts->lock);
	return object;
}
