// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Clearing
 *
 * Board memory changes hands, and must not take along what it holds. The board itself
 * clears it: there is a stream, made once, that sees slot 0 as a surface of one tile's
 * width, and in which each tile is begun with the colour zero and stored. A job with the
 * first so many tiles of that stream clears an object, several jobs a large one: each is
 * short, so that it does not hold up others for long.
 *
 * They are queued when a job first uses the object, as jobs of the same file and priority: a
 * file pays for what it uses with its own turns. Every job that uses the object comes after
 * them; if one fails or is cancelled, none of these is run, and the next SUBMIT that names the
 * object, whoever's, has it cleared anew. As the board runs jobs in order,
 * such a job may be in the ring already when the clearing ends. That is enough, since a stream
 * that is right and always the same does not fail but for a hang or a DMA error, and then the
 * board is reset and the ring looked through again.
 *
 * Only after a sleep does the driver clear for itself, all objects before all jobs.
 */
#include <drm/drm_managed.h>
#include <linux/bitfield.h>
#include <linux/dma-mapping.h>
#include <linux/sizes.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

/* How much one job clears, and the stream that does it with the smallest tiles. */
#define GLOSS_CLEAR_JOB_BYTES		SZ_1M
#define GLOSS_CLEAR_STREAM_BYTES	SZ_8K

/* What board and driver share: the stream, and the list of its pages. */
struct gloss_clear_shared {
	__le32 stream[GLOSS_CLEAR_STREAM_BYTES / sizeof(__le32)];
	__le64 list[GLOSS_CLEAR_STREAM_BYTES / GLOSS_PAGE_BYTES];
};

/* The packets of it, see rtl/INTERFACE.md. */
#define GLOSS_PACKET_OPCODE		GENMASK(31, 24)
#define GLOSS_PACKET_LENGTH		GENMASK(10, 0)
#define GLOSS_PACKET_COLOUR_SURFACE	0x08
#define GLOSS_COLOUR_SURFACE_SLOT	GENMASK(3, 0)
#define GLOSS_COLOUR_SURFACE_PITCH	GENMASK(31, 16)
#define GLOSS_PACKET_TILE_BEGIN		0x10
#define GLOSS_PACKET_TILE_END		0x11
#define GLOSS_TILE_END_COLOUR_OUTPUT	GENMASK(12, 11)
#define GLOSS_TILE_OUTPUT_STORE		1

#define GLOSS_CLEAR_START_WORDS		2
#define GLOSS_CLEAR_TILE_WORDS		6

static u32 gloss_clear_job_tiles(const struct gloss_device *gdev)
{
	return GLOSS_CLEAR_JOB_BYTES / gloss_device_tile_bytes(gdev);
}

static u32 gloss_clear_header(u32 opcode, u32 length)
{
	return FIELD_PREP(GLOSS_PACKET_OPCODE, opcode) | FIELD_PREP(GLOSS_PACKET_LENGTH, length);
}

static __le32 *gloss_clear_put(__le32 *to, u32 header, u32 first)
{
	*to++ = cpu_to_le32(header);
	*to++ = cpu_to_le32(first);
	return to;
}

/* A tile of colour and depth zero, whose colour goes to @offset and whose depth nowhere. */
static __le32 *gloss_clear_put_tile(__le32 *to, u32 offset)
{
	to = gloss_clear_put(to, gloss_clear_header(GLOSS_PACKET_TILE_BEGIN, 2), 0);
	*to++ = 0;
	to = gloss_clear_put(to, gloss_clear_header(GLOSS_PACKET_TILE_END, 2) |
			     FIELD_PREP(GLOSS_TILE_END_COLOUR_OUTPUT, GLOSS_TILE_OUTPUT_STORE),
			     offset);
	*to++ = 0;
	return to;
}

static void gloss_clear_put_stream(struct gloss_device *gdev, __le32 *to)
{
	u32 pitch = gdev->tile_size * sizeof(u32);
	unsigned int tile;

	to = gloss_clear_put(to, gloss_clear_header(GLOSS_PACKET_COLOUR_SURFACE, 1),
			     FIELD_PREP(GLOSS_COLOUR_SURFACE_SLOT, 0) |
			     FIELD_PREP(GLOSS_COLOUR_SURFACE_PITCH, pitch));
	for (tile = 0; tile < gloss_clear_job_tiles(gdev); tile++)
		to = gloss_clear_put_tile(to, tile * gloss_device_tile_bytes(gdev));
}

static void gloss_clear_fini(struct drm_device *drm, void *data)
{
	struct gloss_device *gdev = to_gloss_device(drm);
	struct gloss_clear *clear = &gdev->clear;

	/* The board has gone, so all end by themselves. Those of the entity use it to the last. */
	wait_event(gdev->jobs_wait, !atomic_read(&gdev->jobs));
	drm_sched_entity_destroy(&clear->entity);
	mutex_destroy(&clear->lock);
	mutex_destroy(&clear->queue_lock);
}

static int gloss_clear_init_entity(struct gloss_device *gdev)
{
	struct drm_gpu_scheduler *sched = &gdev->sched;

	return drm_sched_entity_init(&gdev->clear.entity, DRM_SCHED_PRIORITY_KERNEL, &sched, 1,
				     NULL);
}

/*
 * A job of the driver's own has ended. An entity keeps its last job's fence, and that the module;
 * so that the module can be unloaded, the entity goes with the last job, and is made anew.
 */
void gloss_clear_ended(struct gloss_device *gdev)
{
	struct gloss_clear *clear = &gdev->clear;

	mutex_lock(&clear->queue_lock);
	if (!--clear->jobs) {
		drm_sched_entity_destroy(&clear->entity);
		/* It can not fail: there is a scheduler, as the first time. */
		gloss_clear_init_entity(gdev);
	}
	mutex_unlock(&clear->queue_lock);
}

static int gloss_clear_init_queue(struct gloss_device *gdev)
{
	int ret = gloss_clear_init_entity(gdev);

	if (ret)
		return ret;

	mutex_init(&gdev->clear.lock);
	mutex_init(&gdev->clear.queue_lock);
	return drmm_add_action_or_reset(&gdev->drm, gloss_clear_fini, NULL);
}

int gloss_clear_init(struct gloss_device *gdev)
{
	struct gloss_clear_shared *shared;
	dma_addr_t address;
	unsigned int i;

	shared = dmam_alloc_coherent(gdev->drm.dev, sizeof(*shared), &address, GFP_KERNEL);
	if (!shared)
		return -ENOMEM;

	gloss_clear_put_stream(gdev, shared->stream);
	for (i = 0; i < ARRAY_SIZE(shared->list); i++)
		shared->list[i] = cpu_to_le64(address + i * GLOSS_PAGE_BYTES);
	gdev->clear.list_address = address + offsetof(struct gloss_clear_shared, list);
	return gloss_clear_init_queue(gdev);
}

static int gloss_clear_push(struct gloss_job *job)
{
	struct ww_acquire_ctx ctx;
	int ret;

	drm_gem_object_get(&job->clears->base);
	ret = gloss_job_use(job, &job->clears->base, true);
	if (ret)
		return ret;

	ret = gloss_job_lock(job, &ctx);
	if (ret)
		return ret;

	dma_fence_put(gloss_job_push(job, &ctx));
	return 0;
}

/*
 * Queues a job of @file, or of the driver's own, that clears @tiles of @board, @offset bytes
 * from its start.
 */
static int gloss_clear_tiles(struct gloss_board_object *board, u64 offset, u32 tiles,
			     struct gloss_file *file, u32 priority)
{
	struct gloss_device *gdev = to_gloss_device(board->base.dev);
	struct gloss_job *job;
	int ret;

	job = gloss_job_new(gdev, file, priority);
	if (IS_ERR(job))
		return PTR_ERR(job);

	job->clears = board;
	job->clearing = board->clearing;
	job->stream_words = GLOSS_CLEAR_START_WORDS + tiles * GLOSS_CLEAR_TILE_WORDS;
	job->stream_list = gdev->clear.list_address;
	job->slot[0] = (struct gloss_job_slot) {
		.base = board->node.start + offset,
		.size = tiles * gloss_device_tile_bytes(gdev),
		.rights = DRM_GLOSS_SLOT_WRITE,
	};
	ret = gloss_clear_push(job);
	if (ret)
		gloss_job_free(job);
	else if (!file)
		gdev->clear.jobs++;
	return ret;
}

/* Those of a former clearing count no more, whatever becomes of them. */
static void gloss_clear_start(struct gloss_board_object *board, struct gloss_file *file, u32 jobs)
{
	struct gloss_file *before;
	unsigned long flags;

	if (file)
		kref_get(&file->ref);
	spin_lock_irqsave(&board->clear_lock, flags);
	before = board->clearer;
	board->clearer = file;
	board->clearing++;
	board->unclear = jobs;
	board->clear_failed = false;
	spin_unlock_irqrestore(&board->clear_lock, flags);
	if (before)
		gloss_file_put(before);
}

static void gloss_clear_fail(struct gloss_board_object *board, u32 clearing)
{
	unsigned long flags;

	spin_lock_irqsave(&board->clear_lock, flags);
	if (clearing == board->clearing)
		board->clear_failed = true;
	spin_unlock_irqrestore(&board->clear_lock, flags);
}

/* A job that clears will not, or did not. */
void gloss_clear_failed(const struct gloss_job *job)
{
	gloss_clear_fail(job->clears, job->clearing);
}

/* The board gets a job that clears. */
void gloss_clear_begun(const struct gloss_job *job)
{
	struct gloss_board_object *board = job->clears;
	unsigned long flags;

	spin_lock_irqsave(&board->clear_lock, flags);
	if (job->clearing == board->clearing)
		board->unclear--;
	spin_unlock_irqrestore(&board->clear_lock, flags);
}

/* Whether a job that names the object must not be run now. */
bool gloss_clear_missing(struct gloss_board_object *board)
{
	unsigned long flags;
	bool missing;

	spin_lock_irqsave(&board->clear_lock, flags);
	missing = board->unclear || board->clear_failed;
	spin_unlock_irqrestore(&board->clear_lock, flags);
	return missing;
}

/* Whether the clearing that was queued is none any more: also one whose jobs will be cancelled. */
static bool gloss_clear_lost(struct gloss_board_object *board)
{
	unsigned long flags;
	bool lost;

	spin_lock_irqsave(&board->clear_lock, flags);
	lost = board->clear_failed ||
	       (board->unclear && board->clearer && READ_ONCE(board->clearer->closed));
	spin_unlock_irqrestore(&board->clear_lock, flags);
	return lost;
}

/* On an error some of it may be queued. */
static int gloss_clear_queue(struct gloss_board_object *board, struct gloss_file *file,
			     u32 priority)
{
	const struct gloss_device *gdev = to_gloss_device(board->base.dev);
	u32 tile_bytes = gloss_device_tile_bytes(gdev);
	u64 left = board->node.size / tile_bytes;
	u64 offset = 0;
	int ret = 0;

	gloss_clear_start(board, file, DIV_ROUND_UP_ULL(left, gloss_clear_job_tiles(gdev)));
	while (left && !ret) {
		u32 tiles = min_t(u64, left, gloss_clear_job_tiles(gdev));

		ret = gloss_clear_tiles(board, offset, tiles, file, priority);
		offset += (u64)tiles * tile_bytes;
		left -= tiles;
	}
	if (ret)
		gloss_clear_fail(board, board->clearing);
	return ret;
}

/*
 * Makes sure that an object is cleared before a job of @file and @priority that is locked after
 * this.
 */
int gloss_clear_board(struct gloss_board_object *board, struct gloss_file *file, u32 priority)
{
	struct gloss_clear *clear = &to_gloss_device(board->base.dev)->clear;
	int ret;

	/* Pairs with the release below. */
	if (smp_load_acquire(&board->cleared) && !gloss_clear_lost(board))
		return 0;

	ret = mutex_lock_interruptible(&clear->queue_lock);
	if (ret)
		return ret;
	if (!board->cleared || gloss_clear_lost(board))
		ret = gloss_clear_queue(board, file, priority);
	/* Whoever sees this finds the fences of the clearing in the object's reservation. */
	smp_store_release(&board->cleared, !ret);
	mutex_unlock(&clear->queue_lock);
	return ret;
}

/* Clears an object again before the jobs that are queued. */
void gloss_clear_again(struct gloss_board_object *board)
{
	struct gloss_clear *clear = &to_gloss_device(board->base.dev)->clear;

	mutex_lock(&clear->queue_lock);
	/* If that fails, the next job that names it tries again. */
	if (board->cleared)
		gloss_clear_queue(board, NULL, 0);
	mutex_unlock(&clear->queue_lock);
}
