// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Shares
 *
 * Board memory and pinned pages are scarce, and nothing takes them from a file that holds
 * them. So no file gets all: it may hold share_percent of what the others leave. Alone it has
 * most of it, and there is always something left for one more, and for one after that.
 *
 * What a file holds is charged to it until it is given back, whoever uses it meanwhile.
 */
#include <linux/kref.h>
#include <linux/math64.h>
#include <linux/minmax.h>
#include <linux/module.h>
#include <linux/spinlock.h>

#include "gloss_drv.h"
#include "gloss_file.h"

static unsigned int gloss_share_percent = 85;
module_param_named(share_percent, gloss_share_percent, uint, 0644);
MODULE_PARM_DESC(share_percent,
		 "Of what other files leave of board memory and of pages, one may hold so much");

/* Whether a file that holds @mine of @total, all files together @held, may have @more. */
static bool gloss_share_allows(u64 total, u64 held, u64 mine, u64 more, unsigned int percent)
{
	u64 left = total - (held - mine);

	return more <= total - held && mine + more <= mul_u64_u32_div(left, percent, 100);
}

/*
 * Charges @more to @file, which may be NULL where nobody is known to pay; false: it would
 * hold too much, or there is not so much.
 */
bool gloss_share_take(struct gloss_share *share, enum gloss_share_kind kind,
		      struct gloss_file *file, u64 more)
{
	unsigned int percent = min(READ_ONCE(gloss_share_percent), 100u);
	bool allowed;

	spin_lock(&share->lock);
	allowed = gloss_share_allows(share->total, share->held, file ? file->held[kind] : 0, more,
				     percent);
	if (allowed) {
		share->held += more;
		if (file) {
			file->held[kind] += more;
			kref_get(&file->ref);
		}
	}
	spin_unlock(&share->lock);
	return allowed;
}

/* Undoes gloss_share_take(); the file may be gone after this. */
void gloss_share_give_back(struct gloss_share *share, enum gloss_share_kind kind,
			   struct gloss_file *file, u64 less)
{
	spin_lock(&share->lock);
	share->held -= less;
	if (file)
		file->held[kind] -= less;
	spin_unlock(&share->lock);
	if (file)
		gloss_file_put(file);
}
