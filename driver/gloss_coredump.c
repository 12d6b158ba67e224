// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: What is kept of a job that was lost
 *
 * When the board is reset, the job to blame is written down: who sent it, the registers as
 * they were before the reset, its slots, and the first GLOSS_COREDUMP_PAGES pages of its stream.
 * The kernel offers that as /sys/class/devcoredump/devcd<n>/data until it is read or five minutes
 * have passed, one at a time; `gloss-decode --coredump` prints it in names. Whoever listens to
 * uevents learns that the board was reset, or is lost, where the kernel has such an event.
 *
 * Fences wait for the reset, so nothing is waited for there: pages are had at once or not at
 * all, and the text is made by a work afterwards.
 */
#include <drm/drm_drv.h>
#include <drm/drm_print.h>
#include <linux/devcoredump.h>
#include <linux/highmem.h>
#include <linux/slab.h>
#include <linux/utsname.h>
#include <linux/vmalloc.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

/* Of the stream, 256 Ki words. */
#define GLOSS_COREDUMP_PAGES		256
#define GLOSS_COREDUMP_LINE_WORDS	8
/* Room for all but the stream. */
#define GLOSS_COREDUMP_HEAD_BYTES	SZ_8K

#define GLOSS_COREDUMP_REG(name) { #name, GLOSS_REG_##name }

const struct debugfs_reg32 gloss_coredump_regs[GLOSS_COREDUMP_REGS] = {
	GLOSS_COREDUMP_REG(IDENTITY),
	GLOSS_COREDUMP_REG(VERSION),
	GLOSS_COREDUMP_REG(CAPABILITIES),
	GLOSS_COREDUMP_REG(MEMORY_PAGES),
	GLOSS_COREDUMP_REG(CONTROL),
	GLOSS_COREDUMP_REG(STATUS),
	GLOSS_COREDUMP_REG(INTERRUPT_STATUS),
	GLOSS_COREDUMP_REG(INTERRUPT_MASK),
	GLOSS_COREDUMP_REG(RING_LOW),
	GLOSS_COREDUMP_REG(RING_HIGH),
	GLOSS_COREDUMP_REG(RING_LOG2),
	GLOSS_COREDUMP_REG(HEAD),
	GLOSS_COREDUMP_REG(TAIL),
	GLOSS_COREDUMP_REG(COMPLETION_LOW),
	GLOSS_COREDUMP_REG(COMPLETION_HIGH),
	GLOSS_COREDUMP_REG(FAULT_CAUSE),
	GLOSS_COREDUMP_REG(FAULT_OFFSET),
	GLOSS_COREDUMP_REG(FAULT_SEQUENCE),
	GLOSS_COREDUMP_REG(DMA_ERROR_LOW),
	GLOSS_COREDUMP_REG(DMA_ERROR_HIGH),
	GLOSS_COREDUMP_REG(PROGRESS),
};

struct gloss_coredump {
	u32 reg[GLOSS_COREDUMP_REGS];
	struct gloss_ring_fault fault;
	u64 client;
	u32 stream_words, response_words;
	struct gloss_job_slot slot[GLOSS_SLOTS];
	unsigned int pages;		/* that follow, of the stream */
	struct page *page[GLOSS_COREDUMP_PAGES];
};

/* Before the reset. NULL: no memory, so there is no dump. */
struct gloss_coredump *gloss_coredump_new(struct gloss_device *gdev)
{
	struct gloss_coredump *dump = kzalloc(sizeof(*dump), GFP_NOWAIT | __GFP_NOWARN);
	unsigned int i;

	for (i = 0; dump && i < ARRAY_SIZE(dump->reg); i++)
		dump->reg[i] = gloss_read(gdev, gloss_coredump_regs[i].offset);
	return dump;
}

static void gloss_coredump_free(struct gloss_coredump *dump)
{
	while (dump->pages)
		__free_page(dump->page[--dump->pages]);
	kfree(dump);
}

static void gloss_coredump_note(struct gloss_coredump *dump, const struct gloss_job *job)
{
	dump->client = gloss_file_client(job->file);
	dump->stream_words = job->stream_words;
	dump->response_words = job->response_words;
	memcpy(dump->slot, job->slot, sizeof(dump->slot));
}

/*
 * Copies page @index of the stream, if it is the kernel's to read: an imported one is not. Under
 * the ring's lock, in which the job keeps its objects.
 */
static bool gloss_coredump_copy(const struct gloss_job *job, unsigned int index, struct page *to)
{
	const struct gloss_host_object *host = job->stream;
	u64 offset = job->stream_offset + (u64)index * PAGE_SIZE;
	unsigned int i;

	if (!host || !host->pages || (u64)index * PAGE_SIZE >= job->stream_words * sizeof(u32))
		return false;
	/* The stream begins at a page of the board's, which may be smaller than the machine's. */
	for (i = 0; i < PAGE_SIZE && offset + i < host->base.base.size; i += GLOSS_PAGE_BYTES)
		memcpy_page(to, i, host->pages[(offset + i) >> PAGE_SHIFT],
			    offset_in_page(offset + i), GLOSS_PAGE_BYTES);
	return true;
}

/* One page at a time: the job may end, and go, as soon as the lock is not held. */
static bool gloss_coredump_add(struct gloss_ring *ring, struct gloss_coredump *dump)
{
	struct page *page = alloc_page(GFP_NOWAIT | __GFP_NOWARN | __GFP_ZERO);
	const struct gloss_job *job;
	unsigned long flags;
	bool added = false;

	if (!page)
		return false;

	spin_lock_irqsave(&ring->lock, flags);
	job = gloss_ring_find(ring, dump->fault.sequence);
	if (job) {
		gloss_coredump_note(dump, job);
		added = gloss_coredump_copy(job, dump->pages, page);
	}
	spin_unlock_irqrestore(&ring->lock, flags);
	if (added)
		dump->page[dump->pages++] = page;
	else
		__free_page(page);
	return added;
}

/*
 * After the reset: @fault says whose job is to blame. Takes over @dump, which may be NULL. A job
 * that was ended because its file was closed is not worth one.
 */
void gloss_coredump_job(struct gloss_device *gdev, struct gloss_coredump *dump,
			const struct gloss_ring_fault *fault)
{
	if (dump && fault->status.error != -ECANCELED) {
		dump->fault = *fault;
		while (dump->pages < GLOSS_COREDUMP_PAGES && gloss_coredump_add(&gdev->ring, dump))
			;
		dump = xchg(&gdev->coredump, dump);
	}
	if (dump)
		gloss_coredump_free(dump);
	queue_work(gdev->free_wq, &gdev->report);
}

/* ---- the text ---- */

static u32 gloss_coredump_words(const struct gloss_coredump *dump)
{
	return min_t(u64, dump->stream_words, dump->pages * PAGE_SIZE / sizeof(u32));
}

static void gloss_coredump_print_head(struct drm_printer *p, struct gloss_device *gdev,
				      const struct gloss_coredump *dump)
{
	unsigned int i;

	drm_printf(p, "gloss coredump 1\nkernel: %s\nboard: %s\n", init_utsname()->release,
		   dev_name(gdev->drm.dev));
	drm_printf(p, "job: %u\nprocess: %d\nclient: %llu\nerror: %d\ncause: %s\n",
		   dump->fault.sequence, dump->fault.pid, dump->client, dump->fault.status.error,
		   gloss_fault_name(dump->fault.status.cause));
	drm_printf(p, "dma address: %#llx\nresponse: %u words\n", dump->fault.dma_address,
		   dump->response_words);
	for (i = 0; i < ARRAY_SIZE(dump->reg); i++)
		drm_printf(p, "register %s: %#010x\n", gloss_coredump_regs[i].name, dump->reg[i]);
	for (i = 0; i < GLOSS_SLOTS; i++)
		if (dump->slot[i].rights)
			drm_printf(p, "slot %u: base %#x, size %#x, rights %u\n", i,
				   dump->slot[i].base, dump->slot[i].size, dump->slot[i].rights);
}

static void gloss_coredump_print_stream(struct drm_printer *p, const struct gloss_coredump *dump)
{
	u32 words = gloss_coredump_words(dump), at;

	drm_printf(p, "stream: %u words, here %u\n", dump->stream_words, words);
	for (at = 0; at < words; at++) {
		const __le32 *page = kmap_local_page(dump->page[at * sizeof(u32) / PAGE_SIZE]);
		u32 word = le32_to_cpu(page[at % (PAGE_SIZE / sizeof(u32))]);
		bool last = at + 1 == words || !((at + 1) % GLOSS_COREDUMP_LINE_WORDS);

		kunmap_local(page);
		drm_printf(p, "%08x%c", word, last ? '\n' : ' ');
	}
}

static void gloss_coredump_offer(struct gloss_device *gdev, const struct gloss_coredump *dump)
{
	size_t size = GLOSS_COREDUMP_HEAD_BYTES + (size_t)gloss_coredump_words(dump) *
		      strlen("01234567 ");
	struct drm_print_iterator text = { .remain = size };
	struct drm_printer p;

	text.data = vzalloc(size);
	if (!text.data)
		return;

	p = drm_coredump_printer(&text);
	gloss_coredump_print_head(&p, gdev, dump);
	gloss_coredump_print_stream(&p, dump);
	/* Whose memory it is from then on. */
	dev_coredumpv(gdev->drm.dev, text.data, size - text.remain, GFP_KERNEL);
}

static void gloss_coredump_work(struct work_struct *work)
{
	struct gloss_device *gdev = container_of(work, struct gloss_device, report);
	struct gloss_coredump *dump = xchg(&gdev->coredump, NULL);

	if (dump) {
		gloss_coredump_offer(gdev, dump);
		gloss_coredump_free(dump);
	}
	gloss_compat_wedged(&gdev->drm, !gloss_device_gone(gdev));
}

void gloss_coredump_init(struct gloss_device *gdev)
{
	INIT_WORK(&gdev->report, gloss_coredump_work);
}
