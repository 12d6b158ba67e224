/* SPDX-License-Identifier: MIT */
/* How a frame is sent: its records in order and uncopied, in one job or in many. */
#include "bin_test.h"

static void many_records_keep_their_order(void **state)
{
	struct fixture *f = *state;
	struct gloss_triangle header;

	for (int i = 0; i < 2000; i++) {
		const struct accel_vertex a = vertex_at(0, 0), b = vertex_at(160, 160);
		const struct accel_vertex c = vertex_at(0, 160);
		const struct accel_vertex *const vertex[3] = { &a, &b, &c };
		struct accel_triangle triangle;
		struct accel_depth_plane plane;

		assert_true(triangle_ready(&triangle, &plane, vertex));
		triangle.constant[3] = (uint8_t)i;
		assert_int_equal(accel_bin_triangle(&f->bin, &triangle), 0);
	}
	submit(f, ACCEL_JOB_WORDS);
	for (int i = 0; i < 2000; i += 37) {
		gloss_triangle_unpack(packet(GLOSS_OP_TRIANGLE, i), &header);
		assert_int_equal(header.alpha, i & 0xff);
	}
	assert_int_equal(packets(GLOSS_OP_TRIANGLE), 2000);
}

static void a_frame_in_many_jobs_is_the_same_picture(void **state)
{
	struct fixture *f = *state;
	static uint32_t picture[2][128 * 256], depth[2][128 * 256];
	const size_t sizes[] = { ACCEL_JOB_WORDS, 1 };

	set_state(f, ACCEL_COMPARE_LESS, true, true);
	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0, 0xffffff);
	for (int i = 0; i < 40; i++)
		draw_at(f, i * 5, i * 2, 60);
	for (int i = 0; i < 2; i++) {
		/* A target of its own, or tiles would be left out that the first has cleared. */
		accel_target_free(f->target);
		assert_int_equal(accel_target_new(f->device, WIDTH, HEIGHT, &f->target), 0);
		submit(f, sizes[i]);
		assert_int_equal(accel_buffer_read(f->target->colour, 0, picture[i],
						   sizeof(picture[i])),
				 0);
		assert_int_equal(accel_buffer_read(f->target->depth, 0, depth[i], sizeof(depth[i])),
				 0);
		assert_true(i ? sent_jobs == 8 : sent_jobs == 1);
	}
	assert_memory_equal(picture[0], picture[1], sizeof(picture[0]));
	assert_memory_equal(depth[0], depth[1], sizeof(depth[0]));
}

/* A word is copied once: from where it was binned to where the board has it from. */
static void records_are_sent_from_their_bins(void **state)
{
	struct fixture *f = *state;
	const struct accel_chunk *chunk = NULL;
	int found = 0;

	set_state(f, ACCEL_COMPARE_ALWAYS, false, true);
	draw_at(f, 5, 5, 20);
	for (int i = 0; i < f->bin.columns * f->bin.rows; i++)
		if (f->bin.tile[i].drawn)
			chunk = f->bin.tile[i].chunk;
	assert_non_null(chunk);
	submit(f, ACCEL_JOB_WORDS);
	for (int i = 0; i < 16; i++)
		found += sent_part[i] == chunk->words;
	assert_int_equal(found, 1);
}

static void memory_that_is_short_is_told_from_a_part_that_was_drawn(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *fence = NULL;
	bool sent;

	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0, 0xffffff);
	for (uint32_t job = 1; job <= 8; job++) {
		spy_begin(f);
		refused_job = job;
		assert_int_equal(accel_frame_submit(&f->bin, f->stream, f->target, 1, &f->stats,
						    &fence, &sent),
				 job == 1 ? -ENOMEM : -EIO);
		assert_int_equal(sent, job > 1);
		assert_int_equal(sent_jobs, job - 1);
		f->device->ops = board;
		assert_null(fence);
	}
	submit(f, 1);
	assert_int_equal(sent_jobs, 8);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		bin_test(many_records_keep_their_order),
		bin_test(a_frame_in_many_jobs_is_the_same_picture),
		bin_test(records_are_sent_from_their_bins),
		bin_test(memory_that_is_short_is_told_from_a_part_that_was_drawn),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
