// SPDX-License-Identifier: GPL-2.0-only
/* Board memory, and its clearing. */
#include "gloss_memory.c"
#include "gloss_clear.c"
#include "gloss_kunit.h"

#define MEMORY_SIZE	SZ_64M

static int memory_test_init(struct kunit *test)
{
	struct gloss_device *gdev = kunit_kzalloc(test, sizeof(*gdev), GFP_KERNEL);

	KUNIT_ASSERT_NOT_NULL(test, gdev);
	gdev->tile_size = 64;
	gdev->memory.size = MEMORY_SIZE;
	gdev->memory.granule = gloss_device_tile_bytes(gdev);
	mutex_init(&gdev->memory.lock);
	mutex_init(&gdev->clear.queue_lock);
	gdev->memory.share.total = MEMORY_SIZE;
	spin_lock_init(&gdev->memory.share.lock);
	drm_mm_init(&gdev->memory.mm, 0, MEMORY_SIZE);
	gloss_kunit_jobs_init(test);
	test->priv = gdev;
	return 0;
}

static void memory_test_exit(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct drm_mm_node *node, *next;

	drm_mm_for_each_node_safe(node, next, &gdev->memory.mm)
		drm_mm_remove_node(node);
	drm_mm_takedown(&gdev->memory.mm);
}

static struct gloss_board_object *memory_board(struct kunit *test, u64 size)
{
	struct gloss_board_object *board = kunit_kzalloc(test, sizeof(*board), GFP_KERNEL);
	struct gloss_device *gdev = test->priv;

	KUNIT_ASSERT_NOT_NULL(test, board);
	board->base.dev = &gdev->drm;
	board->base.size = size;
	kref_init(&board->base.refcount);
	spin_lock_init(&board->clear_lock);
	size = round_up(size, gdev->memory.granule);
	KUNIT_ASSERT_EQ(test, gloss_memory_insert(&gdev->memory, board, size), 0);
	return board;
}

/* Else clearing one object would clear some of the next. */
static void memory_objects_share_no_tile(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	u32 tile = gloss_device_tile_bytes(gdev);
	unsigned int i;

	for (i = 1; i < 20; i++) {
		struct gloss_board_object *board = memory_board(test, i * GLOSS_PAGE_BYTES);

		KUNIT_EXPECT_EQ(test, board->node.start % tile, 0);
		KUNIT_EXPECT_EQ(test, board->node.size % tile, 0);
		KUNIT_EXPECT_GE(test, board->node.size, i * GLOSS_PAGE_BYTES);
	}
}

static void memory_all_of_it_can_be_had(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_board_object none = {};

	memory_board(test, MEMORY_SIZE);
	KUNIT_EXPECT_EQ(test, gloss_memory_insert(&gdev->memory, &none, gdev->memory.granule),
			-ENOSPC);
}

/* Each job clears from where the last one stopped, and together they clear the node. */
static void memory_clear_covers_every_byte_once(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	u64 sizes[] = { 1, GLOSS_CLEAR_JOB_BYTES,
			GLOSS_CLEAR_JOB_BYTES + gloss_device_tile_bytes(gdev) };
	unsigned int i, j;

	for (i = 0; i < ARRAY_SIZE(sizes); i++) {
		struct gloss_board_object *board;
		u64 at;

		gloss_kunit_jobs_init(test);
		board = memory_board(test, sizes[i]);
		at = board->node.start;
		KUNIT_ASSERT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
		for (j = 0; j < gloss_kunit_jobs->count; j++) {
			KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->job[j].slot[0].base, at);
			KUNIT_EXPECT_PTR_EQ(test, gloss_kunit_jobs->job[j].clears, board);
			at += gloss_kunit_jobs->job[j].slot[0].size;
		}
		KUNIT_EXPECT_EQ(test, at, board->node.start + board->node.size);
		KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->pushed, gloss_kunit_jobs->count);
	}
}

static void memory_clear_job_may_only_write(struct kunit *test)
{
	KUNIT_ASSERT_EQ(test, gloss_clear_board(memory_board(test, 1), NULL, 0), 0);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->job[0].slot[0].rights, DRM_GLOSS_SLOT_WRITE);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->job[0].slot[1].size, 0);
}

static void memory_is_cleared_once(struct kunit *test)
{
	struct gloss_board_object *board = memory_board(test, 1);

	KUNIT_ASSERT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
	KUNIT_ASSERT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->pushed, 1);
}

/* Else a job could use what only the first try was for. */
static void memory_clear_that_fails_is_done_again(struct kunit *test)
{
	struct gloss_board_object *board = memory_board(test, MEMORY_SIZE / 2);
	unsigned int before;

	gloss_kunit_jobs->fail_at = 2;
	KUNIT_EXPECT_EQ(test, gloss_clear_board(board, NULL, 0), -EINTR);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->pushed, 1);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->freed, 1);

	before = gloss_kunit_jobs->count;
	gloss_kunit_jobs->fail_at = 0;
	KUNIT_EXPECT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->job[before].slot[0].base, board->node.start);
}

/* What the board gets of a clearing, and that it fails, is told by its jobs. */
static void memory_clear_that_failed_is_done_anew(struct kunit *test)
{
	struct gloss_board_object *board = memory_board(test, 2 * GLOSS_CLEAR_JOB_BYTES);
	struct gloss_job *job = gloss_kunit_jobs->job;

	KUNIT_ASSERT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
	KUNIT_ASSERT_EQ(test, gloss_kunit_jobs->pushed, 2);
	gloss_clear_begun(&job[0]);
	KUNIT_EXPECT_TRUE(test, gloss_clear_missing(board));
	gloss_clear_failed(&job[1]);
	KUNIT_ASSERT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
	KUNIT_ASSERT_EQ(test, gloss_kunit_jobs->pushed, 4);
	gloss_clear_begun(&job[2]);
	/* This is not one of those that matter now. */
	gloss_clear_begun(&job[1]);
	KUNIT_EXPECT_TRUE(test, gloss_clear_missing(board));
	gloss_clear_begun(&job[3]);
	KUNIT_EXPECT_FALSE(test, gloss_clear_missing(board));
	gloss_clear_failed(&job[0]);
	KUNIT_EXPECT_FALSE(test, gloss_clear_missing(board));
	KUNIT_ASSERT_EQ(test, gloss_clear_board(board, NULL, 0), 0);
	KUNIT_EXPECT_EQ(test, gloss_kunit_jobs->pushed, 4);
}

/* The words of a packet as rtl/INTERFACE.md has them, in the stream of each length. */
static void memory_clear_stream_is_a_tile_a_time(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_clear_shared *shared = kunit_kzalloc(test, sizeof(*shared), GFP_KERNEL);
	const __le32 *word;
	unsigned int i;

	KUNIT_ASSERT_NOT_NULL(test, shared);
	gloss_clear_put_stream(gdev, shared->stream);
	KUNIT_EXPECT_EQ(test, le32_to_cpu(shared->stream[0]), 0x08000001);
	KUNIT_EXPECT_EQ(test, le32_to_cpu(shared->stream[1]), 64 * 4 << 16);
	for (i = 0; i < gloss_clear_job_tiles(gdev); i++) {
		word = &shared->stream[GLOSS_CLEAR_START_WORDS + i * GLOSS_CLEAR_TILE_WORDS];
		KUNIT_EXPECT_EQ(test, le32_to_cpu(word[0]), 0x10000002);
		KUNIT_EXPECT_EQ(test, le32_to_cpu(word[1]), 0);
		KUNIT_EXPECT_EQ(test, le32_to_cpu(word[2]), 0);
		KUNIT_EXPECT_EQ(test, le32_to_cpu(word[3]), 0x11000802);
		KUNIT_EXPECT_EQ(test, le32_to_cpu(word[4]), i * 64 * 64 * 4);
		KUNIT_EXPECT_EQ(test, le32_to_cpu(word[5]), 0);
	}
	word = &shared->stream[GLOSS_CLEAR_START_WORDS + i * GLOSS_CLEAR_TILE_WORDS];
	KUNIT_EXPECT_LE(test, word - shared->stream, ARRAY_SIZE(shared->stream));
}

static struct kunit_case memory_cases[] = {
	KUNIT_CASE(memory_objects_share_no_tile),
	KUNIT_CASE(memory_all_of_it_can_be_had),
	KUNIT_CASE(memory_clear_covers_every_byte_once),
	KUNIT_CASE(memory_clear_job_may_only_write),
	KUNIT_CASE(memory_is_cleared_once),
	KUNIT_CASE(memory_clear_that_fails_is_done_again),
	KUNIT_CASE(memory_clear_that_failed_is_done_anew),
	KUNIT_CASE(memory_clear_stream_is_a_tile_a_time),
	{}
};

static struct kunit_suite memory_suite = {
	.name = "gloss_memory",
	.init = memory_test_init,
	.exit = memory_test_exit,
	.test_cases = memory_cases,
};

kunit_test_suite(memory_suite);
