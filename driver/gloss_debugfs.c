// SPDX-License-Identifier: GPL-2.0-only
/* What to look at when something is wrong: files in /sys/kernel/debug/dri/<node>. */
#include <drm/drm_debugfs.h>
#include <drm/drm_drv.h>
#include <drm/drm_file.h>
#include <drm/drm_print.h>
#include <linux/debugfs.h>
#include <linux/seq_file.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

static struct gloss_device *gloss_debugfs_device(struct seq_file *m)
{
	const struct drm_info_node *node = m->private;

	return to_gloss_device(node->minor->dev);
}

#define GLOSS_DEBUGFS_REG(name) { #name, GLOSS_REG_##name }

static const struct debugfs_reg32 gloss_debugfs_counts[] = {
	GLOSS_DEBUGFS_REG(JOBS),
	GLOSS_DEBUGFS_REG(CLOCKS_LOW),
	GLOSS_DEBUGFS_REG(CLOCKS_HIGH),
	GLOSS_DEBUGFS_REG(STALL_STREAM),
	GLOSS_DEBUGFS_REG(STALL_RASTER),
	GLOSS_DEBUGFS_REG(STALL_TILE),
	GLOSS_DEBUGFS_REG(STALL_MEMORY),
	GLOSS_DEBUGFS_REG(STALL_RESPONSE),
};

/* -ENODEV when the board is gone: nothing to read then. */
static int gloss_debugfs_print_regs(struct seq_file *m, const struct debugfs_reg32 *regs,
				    int count)
{
	struct gloss_device *gdev = gloss_debugfs_device(m);
	int idx;

	if (!drm_dev_enter(&gdev->drm, &idx))
		return -ENODEV;
	debugfs_print_regs32(m, regs, count, gdev->registers, "");
	drm_dev_exit(idx);
	return 0;
}

static int gloss_debugfs_registers(struct seq_file *m, void *unused)
{
	return gloss_debugfs_print_regs(m, gloss_coredump_regs, GLOSS_COREDUMP_REGS);
}

/* What the board counts since its reset. */
static int gloss_debugfs_counters(struct seq_file *m, void *unused)
{
	return gloss_debugfs_print_regs(m, gloss_debugfs_counts, ARRAY_SIZE(gloss_debugfs_counts));
}

static void gloss_debugfs_print_job(struct seq_file *m, const struct gloss_job *job)
{
	seq_printf(m, "job %u: client %llu pid %d, stream %u words, response %u, given %lld us ago\n",
		   job->sequence, gloss_file_client(job->file), job->file ? job->file->pid : 0,
		   job->stream_words, job->response_words,
		   ktime_us_delta(ktime_get(), job->begun));
}

static int gloss_debugfs_ring(struct seq_file *m, void *unused)
{
	struct gloss_device *gdev = gloss_debugfs_device(m);
	struct gloss_ring *ring = &gdev->ring;
	const struct gloss_job *job;

	spin_lock_irq(&ring->lock);
	seq_printf(m, "head %u, tail %u, of %lu entries; last sequence %u\n",
		   ring->head, ring->tail, GLOSS_RING_ENTRIES, ring->sequence);
	seq_printf(m, "ended %llu, with a fault %llu, busy %llu us\n", ring->jobs, ring->faults,
		   div_u64(ring->busy_ns, NSEC_PER_USEC));
	seq_printf(m, "resets %d, lost interrupts %d\n", atomic_read(&gdev->resets),
		   atomic_read(&gdev->interrupts_lost));
	list_for_each_entry(job, &ring->list, ring_node)
		gloss_debugfs_print_job(m, job);
	spin_unlock_irq(&ring->lock);
	return 0;
}

static int gloss_debugfs_fault(struct seq_file *m, void *unused)
{
	struct gloss_device *gdev = gloss_debugfs_device(m);
	struct gloss_ring_fault fault;

	spin_lock_irq(&gdev->ring.lock);
	fault = gdev->ring.fault;
	spin_unlock_irq(&gdev->ring.lock);

	if (!fault.sequence) {
		seq_puts(m, "none\n");
		return 0;
	}
	seq_printf(m, "job %u of pid %d, %lld ms ago\n", fault.sequence, fault.pid,
		   ktime_ms_delta(ktime_get(), fault.time));
	seq_printf(m, "error %d, cause %s, at word %u of the stream\n", fault.status.error,
		   gloss_fault_name(fault.status.cause), fault.status.offset);
	if (fault.dma_address)
		seq_printf(m, "refused access to %#llx\n", fault.dma_address);
	return 0;
}

/* Board memory, what is taken and what is free; and pages of the host. */
static int gloss_debugfs_memory(struct seq_file *m, void *unused)
{
	struct gloss_device *gdev = gloss_debugfs_device(m);
	struct drm_printer p = drm_seq_file_printer(m);

	mutex_lock(&gdev->memory.lock);
	drm_mm_print(&gdev->memory.mm, &p);
	mutex_unlock(&gdev->memory.lock);
	gloss_pages_print(&gdev->hosts, &p);
	return 0;
}

static const struct drm_info_list gloss_debugfs_files[] = {
	{ "ring", gloss_debugfs_ring },
	{ "fault", gloss_debugfs_fault },
	{ "registers", gloss_debugfs_registers },
	{ "counters", gloss_debugfs_counters },
	{ "memory", gloss_debugfs_memory },
};

void gloss_debugfs_init(struct drm_minor *minor)
{
	drm_debugfs_create_files(gloss_debugfs_files, ARRAY_SIZE(gloss_debugfs_files),
				 minor->debugfs_root, minor);
}
