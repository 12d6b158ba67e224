// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Turns
 *
 * The board runs jobs in the order of its ring, so each job in there delays all that come
 * later, whatever their priority. Therefore at most GLOSS_JOBS_AHEAD jobs are in the ring, and
 * the others wait here for their turn.
 *
 * The scheduler asks for a turn for the first job of an entity when all that this job depends
 * on is done. It does not ask for the next one before that has had its turn. So each entity
 * has at most one job in the line of its rank, and first come, first served makes entities
 * take turns, one job each; a higher rank goes first. This does not depend on how the
 * scheduler picks entities, which differs between kernels and is a parameter of theirs.
 */
#include <linux/dma-fence.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

static const enum gloss_rank gloss_turn_rank[GLOSS_PRIORITIES] = {
	[DRM_GLOSS_PRIORITY_HIGH] = GLOSS_RANK_HIGH,
	[DRM_GLOSS_PRIORITY_NORMAL] = GLOSS_RANK_NORMAL,
	[DRM_GLOSS_PRIORITY_LOW] = GLOSS_RANK_LOW,
};

void gloss_turns_init(struct gloss_turns *turns)
{
	unsigned int i;

	spin_lock_init(&turns->lock);
	spin_lock_init(&turns->fence_lock);
	for (i = 0; i < GLOSS_RANKS; i++)
		INIT_LIST_HEAD(&turns->waiting[i]);
}

static void gloss_turn_begin(struct gloss_turns *turns, struct gloss_turn *turn, bool counts)
{
	if (turn->state == GLOSS_TURN_WAITING)
		list_del(&turn->node);
	if (turn->rank == GLOSS_RANK_OWN)
		turns->own--;
	turn->state = GLOSS_TURN_HAD;
	turn->counts = counts;
	turns->taken += counts;
	dma_fence_signal(turn->fence);
}

/* The driver's own jobs go first, also those that the scheduler has not asked for yet. */
static struct gloss_turn *gloss_turns_next(struct gloss_turns *turns)
{
	unsigned int i, ranks = turns->own ? GLOSS_RANK_OWN + 1 : GLOSS_RANKS;

	for (i = 0; i < ranks; i++)
		if (!list_empty(&turns->waiting[i]))
			return list_first_entry(&turns->waiting[i], struct gloss_turn, node);
	return NULL;
}

static void gloss_turns_give(struct gloss_turns *turns)
{
	struct gloss_turn *next;

	lockdep_assert_held(&turns->lock);
	while (!turns->held && turns->taken < GLOSS_JOBS_AHEAD &&
	       (next = gloss_turns_next(turns)))
		gloss_turn_begin(turns, next, true);
}

/* For a job of @file and @priority, or the driver's own. Undone by gloss_turn_fini(). */
int gloss_turn_init(struct gloss_turns *turns, struct gloss_turn *turn, struct gloss_file *file,
		    u32 priority)
{
	unsigned long flags;

	turn->fence = gloss_fence_new();
	if (!turn->fence)
		return -ENOMEM;

	dma_fence_init(turn->fence, &gloss_fence_ops, &turns->fence_lock,
		       dma_fence_context_alloc(1), 1);
	turn->file = file;
	turn->rank = file ? gloss_turn_rank[priority] : GLOSS_RANK_OWN;
	if (!file) {
		spin_lock_irqsave(&turns->lock, flags);
		turns->own++;
		spin_unlock_irqrestore(&turns->lock, flags);
	}
	return 0;
}

/*
 * What a job that could run has yet to wait for: a fence, with a reference, or NULL if it is
 * its turn. Jobs of a closed file need none, as they are not run but cancelled.
 */
struct dma_fence *gloss_turn_ask(struct gloss_turns *turns, struct gloss_turn *turn)
{
	struct dma_fence *fence = NULL;
	unsigned long flags;

	spin_lock_irqsave(&turns->lock, flags);
	if (turn->state == GLOSS_TURN_NONE && turn->file && READ_ONCE(turn->file->closed)) {
		gloss_turn_begin(turns, turn, false);
	} else if (turn->state == GLOSS_TURN_NONE) {
		turn->state = GLOSS_TURN_WAITING;
		list_add_tail(&turn->node, &turns->waiting[turn->rank]);
		gloss_turns_give(turns);
	}
	if (turn->state == GLOSS_TURN_WAITING)
		fence = dma_fence_get(turn->fence);
	spin_unlock_irqrestore(&turns->lock, flags);
	return fence;
}

/* The job has ended, or will not run: the next one's turn. Does nothing the second time. */
void gloss_turn_end(struct gloss_turns *turns, struct gloss_turn *turn)
{
	unsigned long flags;

	spin_lock_irqsave(&turns->lock, flags);
	if (turn->state < GLOSS_TURN_HAD)
		gloss_turn_begin(turns, turn, false);
	turns->taken -= turn->counts;
	turn->counts = false;
	gloss_turns_give(turns);
	spin_unlock_irqrestore(&turns->lock, flags);
}

void gloss_turn_fini(struct gloss_turns *turns, struct gloss_turn *turn)
{
	gloss_turn_end(turns, turn);
	dma_fence_put(turn->fence);
}

/* After @file was closed: those of its jobs that wait for their turn wait no longer. */
void gloss_turns_close(struct gloss_turns *turns, const struct gloss_file *file)
{
	struct gloss_turn *turn, *next;
	unsigned long flags;
	unsigned int i;

	spin_lock_irqsave(&turns->lock, flags);
	for (i = 0; i < GLOSS_RANKS; i++)
		list_for_each_entry_safe(turn, next, &turns->waiting[i], node)
			if (turn->file == file)
				gloss_turn_begin(turns, turn, false);
	spin_unlock_irqrestore(&turns->lock, flags);
}

/* Until this is undone, no job has its turn. */
void gloss_turns_hold(struct gloss_turns *turns, bool hold)
{
	unsigned long flags;

	spin_lock_irqsave(&turns->lock, flags);
	turns->held = hold;
	gloss_turns_give(turns);
	spin_unlock_irqrestore(&turns->lock, flags);
}

/* Whether no job has its turn. */
bool gloss_turns_idle(struct gloss_turns *turns)
{
	return !READ_ONCE(turns->taken);
}
