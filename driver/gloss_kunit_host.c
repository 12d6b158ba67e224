// SPDX-License-Identifier: GPL-2.0-only
/* The list of bus addresses of a dma-buf's pages, and how much a file may hold. */
#include "gloss_host.c"
#include "gloss_list.c"
#include "gloss_pages.c"
#include "gloss_share.c"
#include "gloss_kunit.h"

#define HOST_PAGES	4

struct host_piece {
	dma_addr_t address;
	unsigned int length;
};

static struct gloss_host_object *host_imported(struct kunit *test, const struct host_piece *pieces,
					       unsigned int count)
{
	struct gloss_host_object *host = kunit_kzalloc(test, sizeof(*host), GFP_KERNEL);
	struct gloss_device *gdev = kunit_kzalloc(test, sizeof(*gdev), GFP_KERNEL);
	struct sg_table *sgt = kunit_kzalloc(test, sizeof(*sgt), GFP_KERNEL);
	struct scatterlist *sg;
	unsigned int i;

	KUNIT_ASSERT_TRUE(test, host && gdev && sgt);
	gdev->drm.dev = kunit_kzalloc(test, sizeof(*gdev->drm.dev), GFP_KERNEL);
	host->list = kunit_kzalloc(test, HOST_PAGES * sizeof(*host->list), GFP_KERNEL);
	sgt->sgl = kunit_kzalloc(test, count * sizeof(*sgt->sgl), GFP_KERNEL);
	KUNIT_ASSERT_TRUE(test, gdev->drm.dev && host->list && sgt->sgl);

	host->base.base.dev = &gdev->drm;
	host->base.base.size = HOST_PAGES * GLOSS_PAGE_BYTES;
	host->base.sgt = sgt;
	sgt->nents = count;
	sg_init_table(sgt->sgl, count);
	for_each_sg(sgt->sgl, sg, count, i) {
		sg_dma_address(sg) = pieces[i].address;
		sg_dma_len(sg) = pieces[i].length;
	}
	return host;
}

static void host_list_has_each_page_of_each_piece(struct kunit *test)
{
	const struct host_piece pieces[] = {
		{ 0x1000, 0x1000 }, { 0x7fffff000, 0x2000 }, { 0x5000, 0x1000 },
	};
	struct gloss_host_object *host = host_imported(test, pieces, ARRAY_SIZE(pieces));

	KUNIT_ASSERT_EQ(test, gloss_list_import_pages(host), 0);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[0]), 0x1000);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[1]), 0x7fffff000);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[2]), 0x800000000);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[3]), 0x5000);
}

static void host_list_ends_with_the_object(struct kunit *test)
{
	const struct host_piece pieces[] = { { 0x1000, 0x3000 }, { 0x9000, 0x8000 } };
	struct gloss_host_object *host = host_imported(test, pieces, ARRAY_SIZE(pieces));

	KUNIT_ASSERT_EQ(test, gloss_list_import_pages(host), 0);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[3]), 0x9000);
}

static void host_list_is_refused_to_too_few_pages(struct kunit *test)
{
	const struct host_piece pieces[] = { { 0x1000, 0x3000 } };

	KUNIT_EXPECT_EQ(test, gloss_list_import_pages(host_imported(test, pieces, 1)), -EINVAL);
}

static void host_list_is_refused_to_parts_of_pages(struct kunit *test)
{
	const struct host_piece begins[] = { { 0x1800, 0x1000 }, { 0x4000, 0x4000 } };
	const struct host_piece ends[] = { { 0x1000, 0x1800 }, { 0x4000, 0x4000 } };

	KUNIT_EXPECT_EQ(test, gloss_list_import_pages(host_imported(test, begins, 2)), -EINVAL);
	KUNIT_EXPECT_EQ(test, gloss_list_import_pages(host_imported(test, ends, 2)), -EINVAL);
}

void gloss_file_put(struct gloss_file *gfile)
{
	kref_put(&gfile->ref, (void (*)(struct kref *))kfree);
}

/* Else a submit would wait for other clients' pages. */
static void host_is_used_beside_one_that_is_locked(struct kunit *test)
{
	const struct host_piece pieces[] = { { 0x1000, 0x4000 } };
	struct gloss_host_object *pinned = host_imported(test, pieces, 1);
	struct gloss_host_object *host = host_imported(test, pieces, 1);

	mutex_init(&pinned->lock);
	mutex_init(&host->lock);
	INIT_LIST_HEAD(&host->idle);
	spin_lock_init(&to_gloss_device(host->base.base.dev)->hosts.idle_lock);
	mutex_lock(&pinned->lock);
	KUNIT_EXPECT_EQ(test, gloss_host_use(host, NULL), 0);
	KUNIT_EXPECT_EQ(test, host->uses, 1);
	gloss_host_end_use(host);
	mutex_unlock(&pinned->lock);
}

static void share_leaves_something_to_the_next_file(struct kunit *test)
{
	KUNIT_EXPECT_TRUE(test, gloss_share_allows(1000, 0, 0, 800, 80));
	KUNIT_EXPECT_FALSE(test, gloss_share_allows(1000, 0, 0, 801, 80));
	KUNIT_EXPECT_FALSE(test, gloss_share_allows(1000, 800, 800, 1, 80));
	KUNIT_EXPECT_TRUE(test, gloss_share_allows(1000, 800, 0, 160, 80));
	KUNIT_EXPECT_FALSE(test, gloss_share_allows(1000, 800, 0, 161, 80));
	KUNIT_EXPECT_TRUE(test, gloss_share_allows(1000, 960, 0, 32, 80));
}

static void share_of_all_is_all_that_is_left(struct kunit *test)
{
	KUNIT_EXPECT_TRUE(test, gloss_share_allows(1000, 0, 0, 1000, 100));
	KUNIT_EXPECT_FALSE(test, gloss_share_allows(1000, 0, 0, 1001, 100));
	KUNIT_EXPECT_TRUE(test, gloss_share_allows(1000, 900, 400, 100, 100));
	KUNIT_EXPECT_FALSE(test, gloss_share_allows(1000, 900, 400, 101, 100));
	KUNIT_EXPECT_FALSE(test, gloss_share_allows(1000, 900, 400, U64_MAX, 100));
}

static void share_is_given_back_whole(struct kunit *test)
{
	struct gloss_file *file = kzalloc(sizeof(*file), GFP_KERNEL);
	struct gloss_share share = { .total = 1000 };

	KUNIT_ASSERT_NOT_NULL(test, file);
	kref_init(&file->ref);
	spin_lock_init(&share.lock);
	KUNIT_EXPECT_TRUE(test, gloss_share_take(&share, GLOSS_SHARE_PAGES, file, 500));
	KUNIT_EXPECT_FALSE(test, gloss_share_take(&share, GLOSS_SHARE_PAGES, file, 501));
	KUNIT_EXPECT_EQ(test, file->held[GLOSS_SHARE_PAGES], 500);
	gloss_share_give_back(&share, GLOSS_SHARE_PAGES, file, 500);
	KUNIT_EXPECT_EQ(test, share.held, 0);
	KUNIT_EXPECT_EQ(test, file->held[GLOSS_SHARE_PAGES], 0);
	gloss_file_put(file);
}

static struct kunit_case host_cases[] = {
	KUNIT_CASE(host_list_has_each_page_of_each_piece),
	KUNIT_CASE(host_list_ends_with_the_object),
	KUNIT_CASE(host_list_is_refused_to_too_few_pages),
	KUNIT_CASE(host_list_is_refused_to_parts_of_pages),
	KUNIT_CASE(host_is_used_beside_one_that_is_locked),
	KUNIT_CASE(share_leaves_something_to_the_next_file),
	KUNIT_CASE(share_of_all_is_all_that_is_left),
	KUNIT_CASE(share_is_given_back_whole),
	{}
};

static struct kunit_suite host_suite = {
	.name = "gloss_host",
	.test_cases = host_cases,
};

kunit_test_suite(host_suite);
