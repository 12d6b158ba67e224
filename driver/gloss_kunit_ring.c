// SPDX-License-Identifier: GPL-2.0-only
/*
 * The ring without a board: registers and shared memory are plain memory here, and what a
 * board would write is written by the test.
 */
#include "gloss_ring.c"
#include "gloss_clocks.c"
#include "gloss_kunit.h"

struct ring_job {
	struct gloss_job job;
	struct drm_gloss_status status;
	unsigned int ended;	/* the how-manieth to end, from 1; 0: has not */
};

static unsigned int ring_ended;

void gloss_job_end(struct gloss_job *job, const struct drm_gloss_status *status)
{
	struct ring_job *ring_job = container_of(job, struct ring_job, job);

	job->state = GLOSS_JOB_ENDED;
	ring_job->status = *status;
	ring_job->ended = ++ring_ended;
}

int gloss_job_refusal(const struct gloss_job *job)
{
	return 0;
}

void gloss_job_refuse(struct gloss_job *job, int error)
{
	job->refused = error;
}

int gloss_device_start(struct gloss_device *gdev)
{
	return 0;
}

static int ring_test_init(struct kunit *test)
{
	struct gloss_device *gdev = kunit_kzalloc(test, sizeof(*gdev), GFP_KERNEL);

	KUNIT_ASSERT_NOT_NULL(test, gdev);
	gdev->registers = (void __iomem __force *)kunit_kzalloc(test, SZ_4K, GFP_KERNEL);
	KUNIT_ASSERT_NOT_NULL(test, (void __force *)gdev->registers);
	gdev->ring.shared = kunit_kzalloc(test, sizeof(*gdev->ring.shared), GFP_KERNEL);
	KUNIT_ASSERT_NOT_NULL(test, gdev->ring.shared);
	gdev->ring.address = 0x1000000000;
	mutex_init(&gdev->ring.push_lock);
	spin_lock_init(&gdev->ring.lock);
	INIT_LIST_HEAD(&gdev->ring.list);
	ring_ended = 0;
	test->priv = gdev;
	return 0;
}

static struct ring_job *ring_push_job_of(struct kunit *test, struct gloss_file *file)
{
	struct ring_job *job = kunit_kzalloc(test, sizeof(*job), GFP_KERNEL);

	KUNIT_ASSERT_NOT_NULL(test, job);
	job->job.file = file;
	gloss_ring_push(test->priv, &job->job);
	return job;
}

static struct ring_job *ring_push(struct kunit *test)
{
	return ring_push_job_of(test, NULL);
}

/* What the driver does after a reset. */
static void ring_restart(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;

	mutex_lock(&gdev->ring.push_lock);
	gloss_ring_rewind(&gdev->ring);
	KUNIT_EXPECT_EQ(test, gloss_ring_start(gdev), 0);
	mutex_unlock(&gdev->ring.push_lock);
}

/* What a board writes when it has ended the job in @entry. */
static void ring_complete(struct kunit *test, unsigned int entry, u32 sequence, u32 cause)
{
	struct gloss_device *gdev = test->priv;
	__le32 *word = gdev->ring.shared->completion[entry];

	word[GLOSS_COMPLETION_CAUSE_WORD] = cpu_to_le32(cause);
	word[GLOSS_COMPLETION_OFFSET_WORD] = cpu_to_le32(7);
	word[GLOSS_COMPLETION_RESPONSE_WORDS_WORD] = cpu_to_le32(3);
	word[GLOSS_COMPLETION_SEQUENCE_WORD] = cpu_to_le32(sequence);
}

static u32 ring_descriptor(struct kunit *test, unsigned int entry, unsigned int word)
{
	struct gloss_device *gdev = test->priv;

	return le32_to_cpu(gdev->ring.shared->descriptor[entry][word]);
}

static void ring_job_becomes_descriptor(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_job *job = kunit_kzalloc(test, sizeof(*job), GFP_KERNEL);
	u64 slots = gdev->ring.address + offsetof(struct gloss_ring_shared, slot);

	KUNIT_ASSERT_NOT_NULL(test, job);
	job->stream_words = 5;
	job->stream_list = 0x123456788;
	job->response_words = 6;
	job->response_list = 0x2abcdef00;
	job->slot[15].size = 64;
	gloss_ring_push(gdev, job);

	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 0), 1);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 1), 5);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 2), 0x23456788);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 3), 1);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 4), 6);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 6), 0xabcdef00);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 7), 2);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 8), lower_32_bits(slots));
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 9), upper_32_bits(slots));
	KUNIT_EXPECT_EQ(test, le32_to_cpu(gdev->ring.shared->slot[0][15][1]), 64);
	KUNIT_EXPECT_EQ(test, gloss_read(gdev, GLOSS_REG_TAIL), 1);
}

static void ring_ends_in_order_what_the_board_ended(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct ring_job *first = ring_push(test), *second = ring_push(test);
	struct ring_job *third = ring_push(test);

	ring_complete(test, 1, second->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 0);
	ring_complete(test, 0, first->job.sequence, 4);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 2);

	KUNIT_EXPECT_EQ(test, first->ended, 1);
	KUNIT_EXPECT_EQ(test, first->status.cause, 4);
	KUNIT_EXPECT_EQ(test, first->status.offset, 7);
	KUNIT_EXPECT_EQ(test, first->status.response_words, 3);
	KUNIT_EXPECT_EQ(test, second->ended, 2);
	KUNIT_EXPECT_EQ(test, second->status.cause, 0);
	KUNIT_EXPECT_EQ(test, third->ended, 0);
	KUNIT_EXPECT_FALSE(test, gloss_ring_idle(&gdev->ring));
	KUNIT_EXPECT_EQ(test, gdev->ring.fault.sequence, first->job.sequence);
}

static void ring_record_of_the_last_round_is_none(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	unsigned int i;

	for (i = 0; i < GLOSS_RING_ENTRIES; i++) {
		struct ring_job *job = ring_push(test);

		ring_complete(test, i, job->job.sequence, 0);
		KUNIT_ASSERT_EQ(test, gloss_ring_reap(&gdev->ring), 1);
	}
	ring_push(test);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 0);
}

static void ring_counts_wrap(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct ring_job *last, *next;

	gdev->ring.head = U16_MAX;
	gdev->ring.tail = U16_MAX;
	last = ring_push(test);
	next = ring_push(test);
	KUNIT_EXPECT_EQ(test, gloss_read(gdev, GLOSS_REG_TAIL), 1);

	ring_complete(test, GLOSS_RING_ENTRIES - 1, last->job.sequence, 0);
	ring_complete(test, 0, next->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 2);
	KUNIT_EXPECT_TRUE(test, gloss_ring_idle(&gdev->ring));
}

/* Zero is what memory of no job has. */
static void ring_sequence_is_never_zero(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;

	gdev->ring.sequence = U32_MAX;
	KUNIT_EXPECT_EQ(test, ring_push(test)->job.sequence, 1);
}

/* A job that hung the board is given to it again, as an empty one, and only that. */
static void ring_guilty_is_refused_when_it_comes_again(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_ring_fault fault = { .status.error = -EIO, .dma_address = 0x1234 };
	struct ring_job *first = ring_push(test), *guilty = ring_push(test);

	guilty->job.stream_words = 5;
	first->job.stream_words = 6;
	KUNIT_EXPECT_TRUE(test, gloss_ring_blame(&gdev->ring, guilty->job.sequence, &fault));
	KUNIT_EXPECT_EQ(test, gdev->ring.fault.sequence, guilty->job.sequence);
	KUNIT_EXPECT_EQ(test, gdev->ring.fault.dma_address, 0x1234);

	ring_restart(test);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 1), 6);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 1, 1), 0);
	ring_complete(test, 0, first->job.sequence, 0);
	ring_complete(test, 1, guilty->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 2);
	KUNIT_EXPECT_EQ(test, first->status.error, 0);
	KUNIT_EXPECT_EQ(test, guilty->status.error, -EIO);
}

static void ring_first_is_guilty_when_none_is_named(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_ring_fault fault = { .status.error = -EIO };
	struct ring_job *first = ring_push(test), *second = ring_push(test);

	KUNIT_EXPECT_TRUE(test, gloss_ring_blame(&gdev->ring, 0, &fault));
	KUNIT_EXPECT_EQ(test, first->job.refused, -EIO);
	KUNIT_EXPECT_EQ(test, second->job.refused, 0);
}

static void ring_blames_nobody_for_a_board_that_hangs_on_nothing(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_ring_fault fault = {};
	unsigned int i;

	KUNIT_EXPECT_FALSE(test, gloss_ring_blame(&gdev->ring, 0, &fault));
	ring_push(test);
	for (i = 0; i < GLOSS_JOB_HANGS; i++)
		KUNIT_EXPECT_TRUE(test, gloss_ring_blame(&gdev->ring, 0, &fault));
	KUNIT_EXPECT_FALSE(test, gloss_ring_blame(&gdev->ring, 0, &fault));
}

static void ring_of_a_board_that_has_gone_takes_no_job(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct ring_job *before = ring_push(test), *after;

	gdev->gone = true;
	gloss_ring_fail(&gdev->ring, -ENODEV);
	after = ring_push(test);
	KUNIT_EXPECT_EQ(test, before->status.error, -ENODEV);
	KUNIT_EXPECT_EQ(test, after->status.error, -ENODEV);
	KUNIT_EXPECT_EQ(test, gloss_read(gdev, GLOSS_REG_TAIL), 1);
	KUNIT_EXPECT_TRUE(test, gloss_ring_idle(&gdev->ring));
}

/* A look may meet the record before the interrupt; and the next look another job's. */
static void ring_interrupt_is_lost_that_does_not_come(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct gloss_ring *ring = &gdev->ring;
	struct ring_job *first = ring_push(test), *second = ring_push(test);

	mutex_lock(&ring->push_lock);
	KUNIT_EXPECT_EQ(test, gloss_ring_news(ring), GLOSS_RING_NOTHING);
	ring_complete(test, 0, first->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_news(ring), GLOSS_RING_ENDED);
	KUNIT_EXPECT_EQ(test, first->ended, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(ring), 1);
	ring_complete(test, 1, second->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_news(ring), GLOSS_RING_ENDED);
	KUNIT_EXPECT_EQ(test, gloss_ring_news(ring), GLOSS_RING_UNHEARD);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(ring), 1);
	KUNIT_EXPECT_EQ(test, gloss_ring_news(ring), GLOSS_RING_NOTHING);
	mutex_unlock(&ring->push_lock);
}

/* From the first entry on, and records of before the reset are nobody's. */
static void ring_restarted_has_what_had_not_ended(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct ring_job *first = ring_push(test), *second = ring_push(test);
	u32 sequence = second->job.sequence;

	second->job.stream_words = 5;
	ring_complete(test, 0, first->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 1);
	ring_restart(test);
	KUNIT_EXPECT_FALSE(test, gloss_ring_idle(&gdev->ring));
	KUNIT_EXPECT_EQ(test, gloss_read(gdev, GLOSS_REG_TAIL), 1);
	KUNIT_EXPECT_EQ(test, ring_descriptor(test, 0, 1), 5);
	KUNIT_EXPECT_NE(test, second->job.sequence, sequence);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 0);
	KUNIT_EXPECT_EQ(test, second->ended, 0);

	ring_complete(test, 0, second->job.sequence, 0);
	KUNIT_EXPECT_EQ(test, gloss_ring_reap(&gdev->ring), 1);
}

static void ring_of_a_board_that_sleeps_is_told_when_it_wakes(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;

	gdev->ring.asleep = true;
	ring_push(test);
	KUNIT_EXPECT_FALSE(test, gloss_ring_idle(&gdev->ring));
	KUNIT_EXPECT_EQ(test, gloss_read(gdev, GLOSS_REG_TAIL), 0);
	ring_restart(test);
	KUNIT_EXPECT_EQ(test, gloss_read(gdev, GLOSS_REG_TAIL), 1);
}

/* Of the job at the head what it has not used up, of others all they have. */
static void ring_job_has_a_limit(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct ring_job *first;
	int error;

	KUNIT_EXPECT_EQ(test, gloss_ring_left_ms(&gdev->ring, 700, &error), 700);
	first = ring_push(test);
	ring_push(test);
	first->job.begun = ktime_sub_ms(first->job.begun, 300);
	KUNIT_EXPECT_LE(test, gloss_ring_left_ms(&gdev->ring, 700, &error), 400);
	KUNIT_EXPECT_GT(test, gloss_ring_left_ms(&gdev->ring, 1000000, &error), 0);
	KUNIT_EXPECT_LE(test, gloss_ring_left_ms(&gdev->ring, 300, &error), 0);
	KUNIT_EXPECT_EQ(test, error, -ETIME);
}

static void ring_job_of_a_closed_file_has_a_lower_limit(struct kunit *test)
{
	struct gloss_file *closed = kunit_kzalloc(test, sizeof(*closed), GFP_KERNEL);
	struct gloss_device *gdev = test->priv;
	struct ring_job *first, *second;
	int error;

	KUNIT_ASSERT_NOT_NULL(test, closed);
	first = ring_push(test);
	second = ring_push_job_of(test, closed);
	closed->closed = true;
	KUNIT_EXPECT_EQ(test, gloss_ring_left_ms(&gdev->ring, 1000000, &error),
			GLOSS_CLOSED_LIMIT_MS);
	KUNIT_EXPECT_EQ(test, gloss_ring_left_ms(&gdev->ring, GLOSS_CLOSED_LIMIT_MS / 2, &error),
			GLOSS_CLOSED_LIMIT_MS / 2);
	KUNIT_EXPECT_EQ(test, error, -ETIME);

	ring_complete(test, 0, first->job.sequence, 0);
	gloss_ring_reap(&gdev->ring);
	gdev->ring.idle = 0;
	second->job.begun = ktime_sub_ms(second->job.begun, GLOSS_CLOSED_LIMIT_MS);
	KUNIT_EXPECT_LE(test, gloss_ring_left_ms(&gdev->ring, 1000000, &error), 0);
	KUNIT_EXPECT_EQ(test, error, -ECANCELED);
}

/* The time of one job ends where that of the next begins. */
static void ring_time_is_counted_once(struct kunit *test)
{
	struct gloss_device *gdev = test->priv;
	struct ring_job *first = ring_push(test), *second = ring_push(test);
	ktime_t begun = first->job.begun;

	ring_complete(test, 0, first->job.sequence, 0);
	gloss_ring_reap(&gdev->ring);
	ring_complete(test, 1, second->job.sequence, 0);
	gloss_ring_reap(&gdev->ring);
	KUNIT_EXPECT_EQ(test, gdev->ring.busy_ns,
			(u64)ktime_to_ns(ktime_sub(gdev->ring.idle, begun)));
}

static struct kunit_case ring_cases[] = {
	KUNIT_CASE(ring_job_becomes_descriptor),
	KUNIT_CASE(ring_ends_in_order_what_the_board_ended),
	KUNIT_CASE(ring_record_of_the_last_round_is_none),
	KUNIT_CASE(ring_counts_wrap),
	KUNIT_CASE(ring_sequence_is_never_zero),
	KUNIT_CASE(ring_guilty_is_refused_when_it_comes_again),
	KUNIT_CASE(ring_first_is_guilty_when_none_is_named),
	KUNIT_CASE(ring_blames_nobody_for_a_board_that_hangs_on_nothing),
	KUNIT_CASE(ring_of_a_board_that_has_gone_takes_no_job),
	KUNIT_CASE(ring_restarted_has_what_had_not_ended),
	KUNIT_CASE(ring_of_a_board_that_sleeps_is_told_when_it_wakes),
	KUNIT_CASE(ring_interrupt_is_lost_that_does_not_come),
	KUNIT_CASE(ring_job_has_a_limit),
	KUNIT_CASE(ring_job_of_a_closed_file_has_a_lower_limit),
	KUNIT_CASE(ring_time_is_counted_once),
	{}
};

static struct kunit_suite ring_suite = {
	.name = "gloss_ring",
	.init = ring_test_init,
	.test_cases = ring_cases,
};

kunit_test_suite(ring_suite);
