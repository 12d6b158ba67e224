// SPDX-License-Identifier: GPL-2.0-only
/*
 * Board memory, and the objects in it. Only jobs reach them, and only through the ranges
 * in their slot tables; so such an object can not be mapped, and not be exported.
 */
#include <drm/drm_gem.h>
#include <drm/drm_managed.h>
#include <drm/drm_mm.h>
#include <linux/slab.h>

#include "gloss_drv.h"
#include "gloss_file.h"

static void gloss_memory_fini(struct drm_device *drm, void *data)
{
	drm_mm_takedown(&to_gloss_device(drm)->memory.mm);
}

int gloss_memory_init(struct gloss_device *gdev)
{
	struct gloss_memory *memory = &gdev->memory;
	int ret;

	/* Whole pages for slots, and whole tiles to be cleared by. */
	memory->granule = max_t(u32, GLOSS_PAGE_BYTES, gloss_device_tile_bytes(gdev));
	ret = drmm_mutex_init(&gdev->drm, &memory->lock);
	if (ret)
		return ret;

	spin_lock_init(&memory->share.lock);
	memory->share.total = round_down(memory->size, memory->granule);
	drm_mm_init(&memory->mm, 0, memory->share.total);
	return drmm_add_action_or_reset(&gdev->drm, gloss_memory_fini, NULL);
}

static int gloss_memory_insert(struct gloss_memory *memory, struct gloss_board_object *board,
			       u64 size)
{
	int ret;

	mutex_lock(&memory->lock);
	ret = drm_mm_insert_node_generic(&memory->mm, &board->node, size, memory->granule, 0,
					 DRM_MM_INSERT_BEST);
	mutex_unlock(&memory->lock);
	return ret;
}

/* A range of @size bytes that @file pays for; it is the board's from then on. */
static int gloss_memory_take(struct gloss_memory *memory, struct gloss_file *file,
			     struct gloss_board_object *board, u64 size)
{
	int ret;

	size = round_up(size, memory->granule);
	if (!gloss_share_take(&memory->share, GLOSS_SHARE_MEMORY, file, size))
		return -ENOSPC;

	ret = gloss_memory_insert(memory, board, size);
	if (ret)
		gloss_share_give_back(&memory->share, GLOSS_SHARE_MEMORY, file, size);
	else
		board->payer = file;
	return ret;
}

/*
 * A range of board memory. Ranges of objects that are closed are free when the last job
 * which used them is, and that is a moment after the job's fence signalled; so look again
 * after such a moment.
 */
static int gloss_memory_find(struct gloss_device *gdev, struct gloss_file *file,
			     struct gloss_board_object *board, u64 size)
{
	int ret = gloss_memory_take(&gdev->memory, file, board, size);
	long left;

	if (ret != -ENOSPC || !atomic_read(&gdev->jobs_ended))
		return ret;

	left = wait_event_interruptible_timeout(gdev->jobs_wait, !atomic_read(&gdev->jobs_ended),
						HZ / 10);
	return left < 0 ? left : gloss_memory_take(&gdev->memory, file, board, size);
}

static void gloss_board_free(struct drm_gem_object *object)
{
	struct gloss_board_object *board = to_gloss_board(object);
	struct gloss_memory *memory = &to_gloss_device(object->dev)->memory;

	if (drm_mm_node_allocated(&board->node)) {
		u64 size = board->node.size;

		mutex_lock(&memory->lock);
		drm_mm_remove_node(&board->node);
		mutex_unlock(&memory->lock);
		gloss_share_give_back(&memory->share, GLOSS_SHARE_MEMORY, board->payer, size);
	}
	if (board->clearer)
		gloss_file_put(board->clearer);
	drm_gem_object_release(object);
	kfree(board);
}

static struct dma_buf *gloss_board_export(struct drm_gem_object *object, int flags)
{
	return ERR_PTR(-EOPNOTSUPP);
}

const struct drm_gem_object_funcs gloss_board_funcs = {
	.free = gloss_board_free,
	.export = gloss_board_export,
};

/* An object of @file's share; its memory is cleared when it is first used. */
struct drm_gem_object *gloss_board_create(struct gloss_device *gdev, struct gloss_file *file,
					  u64 size)
{
	struct gloss_board_object *board;
	int ret;

	board = kzalloc(sizeof(*board), GFP_KERNEL_ACCOUNT);
	if (!board)
		return ERR_PTR(-ENOMEM);

	spin_lock_init(&board->clear_lock);
	board->base.funcs = &gloss_board_funcs;
	drm_gem_private_object_init(&gdev->drm, &board->base, size);
	ret = gloss_memory_find(gdev, file, board, size);
	if (ret) {
		drm_gem_object_put(&board->base);
		return ERR_PTR(ret);
	}
	return &board->base;
}

/* The first object that begins at @from or after it, with a reference; or NULL. */
static struct gloss_board_object *gloss_memory_next(struct gloss_memory *memory, u64 from)
{
	struct gloss_board_object *found = NULL;
	struct drm_mm_node *node;

	mutex_lock(&memory->lock);
	drm_mm_for_each_node(node, &memory->mm) {
		struct gloss_board_object *board =
			container_of(node, struct gloss_board_object, node);

		if (node->start >= from && kref_get_unless_zero(&board->base.refcount)) {
			found = board;
			break;
		}
	}
	mutex_unlock(&memory->lock);
	return found;
}

/* The board was without power: who knows what its memory holds. */
void gloss_memory_clear(struct gloss_device *gdev)
{
	struct gloss_board_object *board;
	u64 from = 0;

	while ((board = gloss_memory_next(&gdev->memory, from))) {
		from = board->node.start + board->node.size;
		gloss_clear_again(board);
		drm_gem_object_put(&board->base);
	}
}
