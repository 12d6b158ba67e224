/* SPDX-License-Identifier: GPL-2.0-only */
/* Which job is next. */
#ifndef GLOSS_TURN_H
#define GLOSS_TURN_H

#include <linux/list.h>
#include <linux/spinlock.h>

struct dma_fence;
struct gloss_file;

/* Jobs that are in the ring at once: the one that runs, and one for the board to go on with. */
#define GLOSS_JOBS_AHEAD	2

/* Who goes first. */
enum gloss_rank {
	GLOSS_RANK_OWN,			/* the driver's own jobs */
	GLOSS_RANK_HIGH,
	GLOSS_RANK_NORMAL,
	GLOSS_RANK_LOW,
	GLOSS_RANKS,
};

/* Jobs that have their turn, and those that wait for it. */
struct gloss_turns {
	spinlock_t lock;		/* protects the following members, and each gloss_turn */
	struct list_head waiting[GLOSS_RANKS];	/* gloss_turn.node */
	unsigned int taken;		/* by jobs that have not ended */
	unsigned int own;		/* jobs of the driver's own that have not had their turn */
	bool held;
	spinlock_t fence_lock;		/* of the fences of all turns */
};

enum gloss_turn_state {
	GLOSS_TURN_NONE,		/* not asked for */
	GLOSS_TURN_WAITING,
	GLOSS_TURN_HAD,
};

/* A job's turn. */
struct gloss_turn {
	struct gloss_file *file;	/* the job's */
	enum gloss_rank rank;
	enum gloss_turn_state state;
	bool counts;			/* in gloss_turns.taken */
	struct list_head node;
	struct dma_fence *fence;	/* signals when it is the job's turn */
};

/* gloss_turn.c */
void gloss_turns_init(struct gloss_turns *turns);
int gloss_turn_init(struct gloss_turns *turns, struct gloss_turn *turn, struct gloss_file *file,
		    u32 priority);
struct dma_fence *gloss_turn_ask(struct gloss_turns *turns, struct gloss_turn *turn);
void gloss_turn_end(struct gloss_turns *turns, struct gloss_turn *turn);
void gloss_turn_fini(struct gloss_turns *turns, struct gloss_turn *turn);
void gloss_turns_close(struct gloss_turns *turns, const struct gloss_file *file);
void gloss_turns_hold(struct gloss_turns *turns, bool hold);
bool gloss_turns_idle(struct gloss_turns *turns);

#endif
