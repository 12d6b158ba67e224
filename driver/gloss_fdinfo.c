// SPDX-License-Identifier: GPL-2.0-only
/*
 * What /proc/<pid>/fdinfo says of an open node; the keys are those of
 * Documentation/gpu/drm-usage-stats.rst.
 */
#include <drm/drm_drv.h>
#include <drm/drm_file.h>
#include <drm/drm_gem.h>
#include <linux/idr.h>
#include <linux/pci.h>
#include <linux/seq_file.h>

#include "gloss_drv.h"

struct gloss_fdinfo_sizes {
	u64 host, board;
};

static int gloss_fdinfo_add(int handle, void *object, void *data)
{
	const struct drm_gem_object *gem = object;
	struct gloss_fdinfo_sizes *sizes = data;

	/* A handle is in the table a moment before its object is. */
	if (!gem)
		return 0;
	if (gloss_gem_is_board(gem))
		sizes->board += gem->size;
	else
		sizes->host += gem->size;
	return 0;
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
	seq_printf(m, "drm-engine-gloss:\t%llu ns\n", (u64)atomic64_read(&gfile->engine_ns));
	seq_printf(m, "drm-memory-host:\t%llu KiB\n", sizes.host / SZ_1K);
	seq_printf(m, "drm-memory-board:\t%llu KiB\n", sizes.board / SZ_1K);
}
