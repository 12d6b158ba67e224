// SPDX-License-Identifier: GPL-2.0-only
/* What of SUBMIT can be checked without looking up a handle. */
#include "gloss_submit.c"
#include "gloss_sync.c"
#include "gloss_kunit.h"

static struct drm_device *submit_device(struct kunit *test)
{
	struct gloss_device *gdev = kunit_kzalloc(test, sizeof(*gdev), GFP_KERNEL);

	KUNIT_ASSERT_NOT_NULL(test, gdev);
	return &gdev->drm;
}

static void submit_counts_have_limits(struct kunit *test)
{
	struct drm_device *drm = submit_device(test);
	struct drm_gloss_submit args = {
		.slot_count = GLOSS_SLOTS,
		.in_sync_count = DRM_GLOSS_SYNCS_MAX,
		.out_sync_count = DRM_GLOSS_SYNCS_MAX,
	};

	KUNIT_EXPECT_EQ(test, gloss_submit_check_counts(drm, &args), 0);
	args.slot_count++;
	KUNIT_EXPECT_EQ(test, gloss_submit_check_counts(drm, &args), -E2BIG);
	args.slot_count = 0;
	args.in_sync_count = U32_MAX;
	KUNIT_EXPECT_EQ(test, gloss_submit_check_counts(drm, &args), -E2BIG);
	args.in_sync_count = 0;
	args.out_sync_count++;
	KUNIT_EXPECT_EQ(test, gloss_submit_check_counts(drm, &args), -E2BIG);
}

static void submit_strides_are_the_sizes_of_what_is_there(struct kunit *test)
{
	struct drm_device *drm = submit_device(test);
	struct drm_gloss_submit args = {};

	KUNIT_EXPECT_EQ(test, gloss_submit_check_strides(drm, &args), 0);
	args.slot_stride = sizeof(struct drm_gloss_slot);
	KUNIT_EXPECT_EQ(test, gloss_submit_check_strides(drm, &args), -EINVAL);
	args.slot_count = 1;
	KUNIT_EXPECT_EQ(test, gloss_submit_check_strides(drm, &args), 0);
	args.out_sync_count = 1;
	KUNIT_EXPECT_EQ(test, gloss_submit_check_strides(drm, &args), -EINVAL);
	args.sync_stride = sizeof(struct drm_gloss_sync);
	KUNIT_EXPECT_EQ(test, gloss_submit_check_strides(drm, &args), 0);
}

static void submit_range_does_not_wrap(struct kunit *test)
{
	KUNIT_EXPECT_TRUE(test, gloss_submit_inside(0, 4096, 4096));
	KUNIT_EXPECT_TRUE(test, gloss_submit_inside(4096, 0, 4096));
	KUNIT_EXPECT_FALSE(test, gloss_submit_inside(1, 4096, 4096));
	KUNIT_EXPECT_FALSE(test, gloss_submit_inside(4097, 0, 4096));
	KUNIT_EXPECT_FALSE(test, gloss_submit_inside(U64_MAX, 2, 4096));
	KUNIT_EXPECT_FALSE(test, gloss_submit_inside(4096, U64_MAX, 4096));
	KUNIT_EXPECT_FALSE(test, gloss_submit_inside(U64_MAX - 4095, 4096, 4096));
}

static void submit_slot_is_inside_its_object(struct kunit *test)
{
	const struct drm_gloss_slot good = {
		.rights = DRM_GLOSS_SLOT_READ, .offset = 4096, .size = 4,
	};
	struct drm_gloss_slot slot = good;

	KUNIT_EXPECT_TRUE(test, gloss_submit_slot_valid(&slot, 8192));
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 4096));
	slot.size = 4100;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 8192));
	slot.size = 0;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 8192));
	slot.size = 2;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 8192));
	slot = good;
	slot.offset = 4092;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 8192));
	slot.offset = U64_MAX - 4095;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 8192));
}

/* The board's slot table has 32 bits for a size. */
static void submit_slot_is_below_4_gib(struct kunit *test)
{
	struct drm_gloss_slot slot = { .rights = DRM_GLOSS_SLOT_WRITE, .size = SZ_4G - 4 };

	KUNIT_EXPECT_TRUE(test, gloss_submit_slot_valid(&slot, SZ_8G));
	slot.size = SZ_4G;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, SZ_8G));
}

static void submit_slot_has_known_rights(struct kunit *test)
{
	struct drm_gloss_slot slot = { .size = 4 };

	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 4096));
	slot.rights = DRM_GLOSS_SLOT_READ | DRM_GLOSS_SLOT_WRITE;
	KUNIT_EXPECT_TRUE(test, gloss_submit_slot_valid(&slot, 4096));
	slot.rights = 4;
	KUNIT_EXPECT_FALSE(test, gloss_submit_slot_valid(&slot, 4096));
}

static struct kunit_case submit_cases[] = {
	KUNIT_CASE(submit_counts_have_limits),
	KUNIT_CASE(submit_strides_are_the_sizes_of_what_is_there),
	KUNIT_CASE(submit_range_does_not_wrap),
	KUNIT_CASE(submit_slot_is_inside_its_object),
	KUNIT_CASE(submit_slot_is_below_4_gib),
	KUNIT_CASE(submit_slot_has_known_rights),
	{}
};

static struct kunit_suite submit_suite = {
	.name = "gloss_submit",
	.test_cases = submit_cases,
};

kunit_test_suite(submit_suite);
