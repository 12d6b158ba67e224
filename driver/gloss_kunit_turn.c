// SPDX-License-Identifier: GPL-2.0-only
/* Whose turn it is, without a scheduler: the test asks for turns, and ends them. */
#include "gloss_turn.c"
#include "gloss_fence.c"
#include "gloss_kunit.h"

struct turn_test {
	struct gloss_turns turns;
	struct gloss_file greedy, small;
};

static int turn_test_init(struct kunit *test)
{
	struct turn_test *t = kunit_kzalloc(test, sizeof(*t), GFP_KERNEL);

	KUNIT_ASSERT_NOT_NULL(test, t);
	gloss_turns_init(&t->turns);
	test->priv = t;
	return 0;
}

static struct gloss_turn *turn_new(struct kunit *test, struct gloss_file *file, u32 priority)
{
	struct gloss_turn *turn = kunit_kzalloc(test, sizeof(*turn), GFP_KERNEL);
	struct turn_test *t = test->priv;

	KUNIT_ASSERT_NOT_NULL(test, turn);
	KUNIT_ASSERT_EQ(test, gloss_turn_init(&t->turns, turn, file, priority), 0);
	return turn;
}

/* As the scheduler asks; whether it is the job's turn. */
static bool turn_is_given(struct kunit *test, struct gloss_turn *turn)
{
	struct turn_test *t = test->priv;
	struct dma_fence *fence = gloss_turn_ask(&t->turns, turn);

	KUNIT_EXPECT_EQ(test, !fence, dma_fence_is_signaled(turn->fence));
	dma_fence_put(fence);
	return !fence;
}

static void turn_fini(struct kunit *test, struct gloss_turn *turn)
{
	struct turn_test *t = test->priv;

	gloss_turn_fini(&t->turns, turn);
}

/* The ring is full, of the greedy file's jobs. */
static void turn_fill(struct kunit *test, struct gloss_turn *turn[GLOSS_JOBS_AHEAD])
{
	struct turn_test *t = test->priv;
	unsigned int i;

	for (i = 0; i < GLOSS_JOBS_AHEAD; i++) {
		turn[i] = turn_new(test, &t->greedy, DRM_GLOSS_PRIORITY_NORMAL);
		KUNIT_EXPECT_TRUE(test, turn_is_given(test, turn[i]));
	}
}

static void turn_of_the_next_comes_when_one_ends(struct kunit *test)
{
	struct gloss_turn *ring[GLOSS_JOBS_AHEAD], *next, *last;
	struct turn_test *t = test->priv;

	turn_fill(test, ring);
	next = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_NORMAL);
	last = turn_new(test, &t->greedy, DRM_GLOSS_PRIORITY_NORMAL);
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, next));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, last));
	gloss_turn_end(&t->turns, ring[0]);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, next));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, last));
	/* Once is enough. */
	turn_fini(test, ring[0]);
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, last));
	turn_fini(test, ring[1]);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, last));
	turn_fini(test, next);
	turn_fini(test, last);
	KUNIT_EXPECT_TRUE(test, gloss_turns_idle(&t->turns));
}

static void turn_of_a_higher_priority_comes_first(struct kunit *test)
{
	struct gloss_turn *ring[GLOSS_JOBS_AHEAD], *low, *normal, *high;
	struct turn_test *t = test->priv;

	turn_fill(test, ring);
	low = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_LOW);
	normal = turn_new(test, &t->greedy, DRM_GLOSS_PRIORITY_NORMAL);
	high = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_HIGH);
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, low));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, normal));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, high));
	turn_fini(test, ring[0]);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, high));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, normal));
	turn_fini(test, ring[1]);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, normal));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, low));
	turn_fini(test, high);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, low));
	turn_fini(test, normal);
	turn_fini(test, low);
}

/* Also before the scheduler has asked for them, so that nothing runs on memory not cleared. */
static void turn_of_the_driver_comes_before_all(struct kunit *test)
{
	struct turn_test *t = test->priv;
	struct gloss_turn *own = turn_new(test, NULL, 0), *more = turn_new(test, NULL, 0);
	struct gloss_turn *high = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_HIGH);

	KUNIT_EXPECT_FALSE(test, turn_is_given(test, high));
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, own));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, high));
	/* One that could not be queued holds up nobody. */
	turn_fini(test, more);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, high));
	turn_fini(test, own);
	turn_fini(test, high);
}

static void turn_of_a_closed_file_is_not_waited_for(struct kunit *test)
{
	struct gloss_turn *ring[GLOSS_JOBS_AHEAD], *waiting, *later, *other;
	struct turn_test *t = test->priv;

	turn_fill(test, ring);
	waiting = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_LOW);
	later = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_NORMAL);
	other = turn_new(test, &t->greedy, DRM_GLOSS_PRIORITY_NORMAL);
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, waiting));
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, other));
	t->small.closed = true;
	gloss_turns_close(&t->turns, &t->small);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, waiting));
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, later));
	/* They took nobody's place, and leave none. */
	turn_fini(test, waiting);
	turn_fini(test, later);
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, other));
	turn_fini(test, ring[0]);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, other));
	turn_fini(test, ring[1]);
	turn_fini(test, other);
}

static void turns_that_are_held_come_later(struct kunit *test)
{
	struct turn_test *t = test->priv;
	struct gloss_turn *turn = turn_new(test, &t->small, DRM_GLOSS_PRIORITY_NORMAL);

	gloss_turns_hold(&t->turns, true);
	KUNIT_EXPECT_FALSE(test, turn_is_given(test, turn));
	KUNIT_EXPECT_TRUE(test, gloss_turns_idle(&t->turns));
	gloss_turns_hold(&t->turns, false);
	KUNIT_EXPECT_TRUE(test, turn_is_given(test, turn));
	turn_fini(test, turn);
}

static struct kunit_case turn_cases[] = {
	KUNIT_CASE(turn_of_the_next_comes_when_one_ends),
	KUNIT_CASE(turn_of_a_higher_priority_comes_first),
	KUNIT_CASE(turn_of_the_driver_comes_before_all),
	KUNIT_CASE(turn_of_a_closed_file_is_not_waited_for),
	KUNIT_CASE(turns_that_are_held_come_later),
	{}
};

static void turn_suite_exit(struct kunit_suite *suite)
{
	/* Each fence holds a reference to this module. */
	rcu_barrier();
}

static struct kunit_suite turn_suite = {
	.name = "gloss_turn",
	.init = turn_test_init,
	.suite_exit = turn_suite_exit,
	.test_cases = turn_cases,
};

kunit_test_suite(turn_suite);
