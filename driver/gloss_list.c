// SPDX-License-Identifier: GPL-2.0-only
/*
 * The list by which the board finds the pages of a host object: bus addresses, one for 4096 bytes.
 * It is made of pages that are pinned, and maps them, or of a dma-buf, which is mapped already;
 * under gloss_host.lock.
 */
#include <drm/drm_print.h>
#include <linux/dma-mapping.h>
#include <linux/scatterlist.h>

#include "gloss_drv.h"

#define GLOSS_PAGES_PER_PAGE	(PAGE_SIZE / GLOSS_PAGE_BYTES)

static unsigned int gloss_list_entries(const struct gloss_host_object *host)
{
	return host->base.base.size / GLOSS_PAGE_BYTES;
}

static struct device *gloss_list_device(const struct gloss_host_object *host)
{
	return host->base.base.dev->dev;
}

/* Unmaps the pages of the first @entries of the list. */
static void gloss_list_unmap_pages(struct gloss_host_object *host, unsigned int entries)
{
	unsigned int i;

	for (i = 0; i < entries; i += GLOSS_PAGES_PER_PAGE)
		dma_unmap_page(gloss_list_device(host), le64_to_cpu(host->list[i]), PAGE_SIZE,
			       DMA_BIDIRECTIONAL);
}

static int gloss_list_check(const struct gloss_host_object *host, dma_addr_t address)
{
	if (dma_need_sync(gloss_list_device(host), address)) {
		drm_dbg(host->base.base.dev, "this machine's DMA is not coherent\n");
		return -EOPNOTSUPP;
	}
	return 0;
}

static int gloss_list_map_pages(struct gloss_host_object *host)
{
	struct device *dev = gloss_list_device(host);
	unsigned int entries = gloss_list_entries(host);
	unsigned int i, j;
	int ret;

	for (i = 0; i < entries; i += GLOSS_PAGES_PER_PAGE) {
		dma_addr_t address = dma_map_page(dev, host->pages[i / GLOSS_PAGES_PER_PAGE],
						  0, PAGE_SIZE, DMA_BIDIRECTIONAL);

		ret = -ENOMEM;
		if (dma_mapping_error(dev, address))
			goto unmap;
		for (j = 0; j < GLOSS_PAGES_PER_PAGE; j++)
			host->list[i + j] = cpu_to_le64(address + j * GLOSS_PAGE_BYTES);
		ret = gloss_list_check(host, address);
		if (ret) {
			i += GLOSS_PAGES_PER_PAGE;
			goto unmap;
		}
	}
	return 0;

unmap:
	gloss_list_unmap_pages(host, i);
	return ret;
}

/* The pages of an imported object are mapped already. */
static int gloss_list_import_pages(struct gloss_host_object *host)
{
	unsigned int entries = gloss_list_entries(host);
	unsigned int i, entry = 0;
	struct scatterlist *sg;
	u64 offset;
	int ret;

	for_each_sgtable_dma_sg(host->base.sgt, sg, i) {
		if (!IS_ALIGNED(sg_dma_address(sg) | sg_dma_len(sg), GLOSS_PAGE_BYTES)) {
			drm_dbg(host->base.base.dev, "a dma-buf in pieces of less than a page\n");
			return -EINVAL;
		}
		ret = gloss_list_check(host, sg_dma_address(sg));
		if (ret)
			return ret;
		for (offset = 0; offset < sg_dma_len(sg) && entry < entries;
		     offset += GLOSS_PAGE_BYTES)
			host->list[entry++] = cpu_to_le64(sg_dma_address(sg) + offset);
	}
	return entry == entries ? 0 : -EINVAL;
}

static size_t gloss_list_bytes(const struct gloss_host_object *host)
{
	return gloss_list_entries(host) * sizeof(*host->list);
}

/* The board reads the list as one array, so it can not be in pieces. */
static int gloss_list_new(struct gloss_host_object *host)
{
	host->list = dma_alloc_coherent(gloss_list_device(host), gloss_list_bytes(host),
					&host->list_address,
					GFP_KERNEL_ACCOUNT | __GFP_RETRY_MAYFAIL | __GFP_NOWARN);
	return host->list ? 0 : -ENOMEM;
}

static void gloss_list_delete(struct gloss_host_object *host)
{
	dma_free_coherent(gloss_list_device(host), gloss_list_bytes(host), host->list,
			  host->list_address);
	host->list = NULL;
}

int gloss_list_make(struct gloss_host_object *host)
{
	int ret;

	ret = gloss_list_new(host);
	if (ret)
		return ret;

	if (gloss_host_imported(host))
		ret = gloss_list_import_pages(host);
	else
		ret = gloss_list_map_pages(host);
	if (ret)
		gloss_list_delete(host);
	return ret;
}

void gloss_list_unmake(struct gloss_host_object *host)
{
	if (host->list) {
		if (!gloss_host_imported(host))
			gloss_list_unmap_pages(host, gloss_list_entries(host));
		gloss_list_delete(host);
	}
}
