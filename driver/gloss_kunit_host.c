// SPDX-License-Identifier: GPL-2.0-only
/* The list of bus addresses of a dma-buf's pages. */
#include "gloss_host.c"
#include "gloss_kunit.h"

#define HOST_PAGES	4

struct host_piece {
	dma_addr_t address;
	unsigned int length;
};

static struct gloss_host *host_imported(struct kunit *test, const struct host_piece *pieces,
					unsigned int count)
{
	struct gloss_host *host = kunit_kzalloc(test, sizeof(*host), GFP_KERNEL);
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
	struct gloss_host *host = host_imported(test, pieces, ARRAY_SIZE(pieces));

	KUNIT_ASSERT_EQ(test, gloss_host_list_pages(host), 0);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[0]), 0x1000);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[1]), 0x7fffff000);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[2]), 0x800000000);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[3]), 0x5000);
}

static void host_list_ends_with_the_object(struct kunit *test)
{
	const struct host_piece pieces[] = { { 0x1000, 0x3000 }, { 0x9000, 0x8000 } };
	struct gloss_host *host = host_imported(test, pieces, ARRAY_SIZE(pieces));

	KUNIT_ASSERT_EQ(test, gloss_host_list_pages(host), 0);
	KUNIT_EXPECT_EQ(test, le64_to_cpu(host->list[3]), 0x9000);
}

static void host_list_is_refused_to_too_few_pages(struct kunit *test)
{
	const struct host_piece pieces[] = { { 0x1000, 0x3000 } };

	KUNIT_EXPECT_EQ(test, gloss_host_list_pages(host_imported(test, pieces, 1)), -EINVAL);
}

static void host_list_is_refused_to_parts_of_pages(struct kunit *test)
{
	const struct host_piece begins[] = { { 0x1800, 0x1000 }, { 0x4000, 0x4000 } };
	const struct host_piece ends[] = { { 0x1000, 0x1800 }, { 0x4000, 0x4000 } };

	KUNIT_EXPECT_EQ(test, gloss_host_list_pages(host_imported(test, begins, 2)), -EINVAL);
	KUNIT_EXPECT_EQ(test, gloss_host_list_pages(host_imported(test, ends, 2)), -EINVAL);
}

static struct kunit_case host_cases[] = {
	KUNIT_CASE(host_list_has_each_page_of_each_piece),
	KUNIT_CASE(host_list_ends_with_the_object),
	KUNIT_CASE(host_list_is_refused_to_too_few_pages),
	KUNIT_CASE(host_list_is_refused_to_parts_of_pages),
	{}
};

static struct kunit_suite host_suite = {
	.name = "gloss_host",
	.test_cases = host_cases,
};

kunit_test_suite(host_suite);
