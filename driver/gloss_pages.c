// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Pages of host objects
 *
 * While the board may reach a page it has to stay where it is. Such pages can not be swapped
 * out, and count in the size of no process, so the OOM killer would not find who has them.
 * Therefore all boards together pin at most pin_percent of the machine's memory, and a file
 * gets its share of that (gloss_share.c). Whoever wants more is told so, and nobody is killed
 * for it. The pages themselves are charged to the control group of who submits first.
 *
 * Objects that no job uses stay pinned, as the next job comes soon, until memory is short:
 * then the shrinker gives back those that have been idle for longest, if there is swap space
 * for what they hold.
 */
#include <drm/drm_gem.h>
#include <drm/drm_managed.h>
#include <drm/drm_print.h>
#include <linux/mm.h>
#include <linux/module.h>
#include <linux/pagemap.h>
#include <linux/sched/signal.h>
#include <linux/shmem_fs.h>
#include <linux/swap.h>

#include "gloss_drv.h"
#include "gloss_file.h"

static unsigned int gloss_pin_percent = 50;
module_param_named(pin_percent, gloss_pin_percent, uint, 0444);
MODULE_PARM_DESC(pin_percent, "Of the machine's memory, all boards together pin so much");

/* Of all boards, in pages. */
static struct gloss_share gloss_pages_share = {
	.lock = __SPIN_LOCK_UNLOCKED(gloss_pages_share.lock),
};

bool gloss_pages_charge(struct gloss_file *file, unsigned long count)
{
	return gloss_share_take(&gloss_pages_share, GLOSS_SHARE_PAGES, file, count);
}

void gloss_pages_uncharge(struct gloss_file *file, unsigned long count)
{
	gloss_share_give_back(&gloss_pages_share, GLOSS_SHARE_PAGES, file, count);
}

static int gloss_pages_read(struct address_space *mapping, struct page **pages,
			    unsigned long count)
{
	/* Better no job than the OOM killer. */
	gfp_t gfp = mapping_gfp_mask(mapping) | __GFP_RETRY_MAYFAIL | __GFP_NOWARN;
	unsigned long i;

	for (i = 0; i < count; i++) {
		struct page *page;

		if (fatal_signal_pending(current))
			return -EINTR;
		page = shmem_read_mapping_page_gfp(mapping, i, gfp);
		/* That is shmem's word for memory that was not to be had. */
		if (page == ERR_PTR(-ENOSPC))
			return -ENOMEM;
		if (IS_ERR(page))
			return PTR_ERR(page);
		pages[i] = page;
		cond_resched();
	}
	return 0;
}

/* All pages of an object, pinned; give them to gloss_pages_put(). */
struct page **gloss_pages_get(struct drm_gem_object *object)
{
	struct address_space *mapping = object->filp->f_mapping;
	unsigned long count = object->size >> PAGE_SHIFT;
	struct page **pages;
	int ret;

	pages = kvcalloc(count, sizeof(*pages), GFP_KERNEL_ACCOUNT);
	if (!pages)
		return ERR_PTR(-ENOMEM);

	mapping_set_unevictable(mapping);
	ret = gloss_pages_read(mapping, pages, count);
	if (ret) {
		drm_gem_put_pages(object, pages, false, false);
		return ERR_PTR(ret);
	}
	return pages;
}

/* What the board wrote reached no dirty bit of a page table. */
void gloss_pages_put(struct drm_gem_object *object, struct page **pages)
{
	drm_gem_put_pages(object, pages, true, true);
}

/* ---- the shrinker ---- */

/* Not here: the last reference to an object may not be dropped while memory is reclaimed. */
static void gloss_pages_drop(struct gloss_host_object *host)
{
	if (!refcount_dec_not_one(&host->base.base.refcount.refcount))
		queue_work(to_gloss_device(host->base.base.dev)->free_wq, &host->put);
}

void gloss_pages_put_work(struct work_struct *work)
{
	struct gloss_host_object *host = container_of(work, struct gloss_host_object, put);

	drm_gem_object_put(&host->base.base);
}

/* The object that has been idle for longest, with a reference; it is in no list then. */
static struct gloss_host_object *gloss_pages_oldest(struct gloss_hosts *hosts)
{
	struct gloss_host_object *host, *found = NULL;

	spin_lock(&hosts->idle_lock);
	while (!found && !list_empty(&hosts->idle)) {
		host = list_first_entry(&hosts->idle, struct gloss_host_object, idle);
		gloss_host_set_busy(host);
		if (kref_get_unless_zero(&host->base.base.refcount))
			found = host;
	}
	spin_unlock(&hosts->idle_lock);
	return found;
}

/* Unpins idle objects until that was @wanted pages, or there are no more; how many it was. */
unsigned long gloss_pages_shrink(struct gloss_hosts *hosts, unsigned long wanted)
{
	unsigned long freed = 0;
	struct gloss_host_object *host;

	while (freed < wanted && get_nr_swap_pages() > 0 && (host = gloss_pages_oldest(hosts))) {
		freed += gloss_host_try_unpin(host);
		gloss_pages_drop(host);
	}
	return freed;
}

static unsigned long gloss_pages_count(struct shrinker *shrinker, struct shrink_control *sc)
{
	struct gloss_hosts *hosts = gloss_compat_shrinker_owner(shrinker);

	return get_nr_swap_pages() > 0 ? READ_ONCE(hosts->idle_pages) : 0;
}

static unsigned long gloss_pages_scan(struct shrinker *shrinker, struct shrink_control *sc)
{
	unsigned long freed = gloss_pages_shrink(gloss_compat_shrinker_owner(shrinker),
						 sc->nr_to_scan);

	return freed ?: SHRINK_STOP;
}

void gloss_pages_print(struct gloss_hosts *hosts, struct drm_printer *p)
{
	struct gloss_share *share = &gloss_pages_share;

	spin_lock(&share->lock);
	drm_printf(p, "host: pages pinned %llu of %llu, of all boards; idle %lu of this\n",
		   share->held, share->total, READ_ONCE(hosts->idle_pages));
	spin_unlock(&share->lock);
}

static void gloss_pages_fini(struct drm_device *drm, void *data)
{
	gloss_compat_shrinker_free(to_gloss_device(drm)->hosts.shrinker);
}

/* After gloss_sched_init(), whose queue the shrinker uses. */
int gloss_pages_init(struct gloss_device *gdev)
{
	gloss_pages_share.total = mult_frac(totalram_pages(), min(gloss_pin_percent, 100u), 100);
	gdev->hosts.shrinker = gloss_compat_shrinker_new(gloss_pages_count, gloss_pages_scan,
							 &gdev->hosts);
	if (!gdev->hosts.shrinker)
		return -ENOMEM;
	return drmm_add_action_or_reset(&gdev->drm, gloss_pages_fini, NULL);
}
