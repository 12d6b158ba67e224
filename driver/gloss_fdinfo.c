// SPDX-License-Identifier: GPL-2.0-only
/*
 * What /proc/<pid>/fdinfo says of an open node; the keys are those of
 * Documentation/gpu/drm-usage-stats.rst.
 */
#include <drm/drm_drv.h>
#include <drm/drm_file.h>
#include <drm/drm_gem.h>
#include <linux/dma-resv.h>
#include <linux/fs.h>
#include <linux/idr.h>
#include <linux/pci.h>
#include <linux/seq_file.h>

#include "gloss_drv.h"
#include "gloss_file.h"

struct gloss_fdinfo_region {
	u64 total, shared, resident, active;
};

struct gloss_fdinfo_sizes {
	struct gloss_fdinfo_region memory;	/* pages of the host */
	struct gloss_fdinfo_region board;
};

/* Of an imported object nobody here knows which pages are there; they are mapped for DMA. */
static u64 gloss_fdinfo_resident(const struct drm_gem_object *gem)
{
	if (!gem->filp)
		return gem->size;
	return (u64)READ_ONCE(gem->filp->f_mapping->nrpages) << PAGE_SHIFT;
}

static int gloss_fdinfo_add(int handle, void *object, void *data)
{
	const struct drm_gem_object *gem = object;
	struct gloss_fdinfo_sizes *sizes = data;
	struct gloss_fdinfo_region *region = &sizes->memory;

	/* A handle is in the table a moment before its object is. */
	if (!gem)
		return 0;
	if (gloss_gem_is_board(gem))
		region = &sizes->board;
	region->total += gem->size;
	region->resident += gloss_fdinfo_resident(gem);
	if (gem->handle_count > 1)
		region->shared += gem->size;
	if (!dma_resv_test_signaled(gem->resv, DMA_RESV_USAGE_BOOKKEEP))
		region->active += gem->size;
	return 0;
}

static void gloss_fdinfo_show_region(struct seq_file *m, const char *name,
				     const struct gloss_fdinfo_region *region)
{
	seq_printf(m, "drm-total-%s:\t%llu KiB\n", name, region->total / SZ_1K);
	seq_printf(m, "drm-shared-%s:\t%llu KiB\n", name, region->shared / SZ_1K);
	seq_printf(m, "drm-resident-%s:\t%llu KiB\n", name, region->resident / SZ_1K);
	seq_printf(m, "drm-active-%s:\t%llu KiB\n", name, region->active / SZ_1K);
}

/* The board is one engine. Of the job it has at the moment the time until now counts. */
static void gloss_fdinfo_show_engine(struct seq_file *m, struct gloss_file *gfile)
{
	struct drm_gloss_get_clocks clocks;

	seq_printf(m, "drm-engine-render:\t%llu ns\n",
		   gloss_ring_engine_ns(&gfile->gdev->ring, gfile));
	seq_puts(m, "drm-engine-capacity-render:\t1\n");
	/* Without drm-maxfreq: the board knows no rate of its clock. */
	if (!gloss_clocks_get(gfile, &clocks))
		seq_printf(m, "drm-cycles-render:\t%llu\n", clocks.clocks);
}

void gloss_fdinfo_show(struct seq_file *m, struct file *filp)
{
	struct drm_file *file = filp->private_data;
	struct drm_device *drm = file->minor->dev;
	struct gloss_file *gfile = to_gloss_file(file);
	struct gloss_fdinfo_sizes sizes = {};

	spin_lock(&file->table_lock);
	idr_for_each(&file->object_idr, gloss_fdinfo_add, &sizes);
	spin_unlock(&file->table_lock);

	seq_printf(m, "drm-driver:\t%s\n", drm->driver->name);
	seq_printf(m, "drm-pdev:\t%s\n", dev_name(drm->dev));
	seq_printf(m, "drm-client-id:\t%llu\n", gloss_file_client(gfile));
	gloss_fdinfo_show_engine(m, gfile);
	gloss_fdinfo_show_region(m, "memory", &sizes.memory);
	gloss_fdinfo_show_region(m, "board", &sizes.board);
}
