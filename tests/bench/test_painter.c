// SPDX-License-Identifier: MIT
/* What becomes of a painter that lacks something, fails or dies; and what a contest makes of times. */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "contest.h"

#define BUSY 0.02 /* seconds */

/* The scene's left says what a painter does. */
enum { DRAWS, FAILS, DIES };

static void *open_fake(const struct way *way, const struct scene *scene,
		       char message[PAINTER_MESSAGE])
{
	static int opened;

	(void)scene;
	snprintf(message, PAINTER_MESSAGE, way->driver ? "install %s" : "by %s", way->name);
	return way->driver ? NULL : &opened;
}

static int draw_fake(void *painter, const struct scene *scene)
{
	clock_t begin = clock();

	(void)painter;
	if (scene->left == DIES)
		_exit(1);
	while ((double)(clock() - begin) / CLOCKS_PER_SEC < BUSY)
		continue;
	return scene->left == FAILS ? -EIO : 0;
}

static int read_fake(void *painter, uint32_t *colour, uint32_t *depth)
{
	(void)painter;
	for (uint32_t i = 0; i < 6; i++) {
		colour[i] = i;
		depth[i] = 100 + i;
	}
	return 0;
}

static const struct painter_ops fake = { open_fake, draw_fake, read_fake };
static const struct way here = { .name = "here", .ops = &fake };
static const struct way missing = { .name = "it", .ops = &fake, .driver = "none" };

static struct scene scene_of(int what)
{
	return (struct scene){ .width = 3, .height = 2, .left = what };
}

static void what_a_painter_lacks_is_said(void **state)
{
	const struct scene scene = scene_of(DRAWS);
	char message[PAINTER_MESSAGE];
	struct painter painter;

	(void)state;
	assert_int_equal(painter_start(&painter, &missing, &scene, message), -ENODEV);
	assert_string_equal(message, "install it");
	painter_stop(&painter);
}

static void a_picture_comes_from_another_process(void **state)
{
	const struct scene scene = scene_of(DRAWS);
	char message[PAINTER_MESSAGE];
	struct painter painter;
	struct painter_cost cost;

	(void)state;
	assert_int_equal(painter_start(&painter, &here, &scene, message), 0);
	assert_string_equal(message, "by here");
	assert_int_not_equal(painter.process, getpid());
	assert_int_equal(painter_draw(&painter, &scene, &cost), 0);
	assert_true(cost.processor >= BUSY && cost.wall >= BUSY);
	assert_int_equal(painter.colour[5], 0);
	assert_int_equal(painter_picture(&painter, &scene), 0);
	assert_int_equal(painter.colour[5], 5);
	assert_int_equal(painter.depth[5], 105);
	painter_stop(&painter);
}

static void a_failure_is_returned_and_a_death_is_noticed(void **state)
{
	const struct scene good = scene_of(DRAWS), bad = scene_of(FAILS), deadly = scene_of(DIES);
	char message[PAINTER_MESSAGE];
	struct painter painter;

	(void)state;
	assert_int_equal(painter_start(&painter, &here, &good, message), 0);
	assert_int_equal(painter_draw(&painter, &bad, NULL), -EIO);
	assert_int_equal(painter_draw(&painter, &good, NULL), 0);
	assert_int_equal(painter_draw(&painter, &deadly, NULL), -EPIPE);
	assert_int_equal(painter_draw(&painter, &good, NULL), -EPIPE);
	painter_stop(&painter);
}

/* The quotients of a round each, not those of the medians. */
static void a_speed_is_the_median_of_quotients(void **state)
{
	static struct contest contest = {
		.rounds = { [CONTEST_GLOSS] = 4, [CONTEST_CPHONG] = 3 },
		.sample = { [CONTEST_GLOSS] = { 1, 2, 4, 8 }, [CONTEST_CPHONG] = { 10, 10, 80 } },
	};
	struct contest_spread cost = contest_cost(&contest, CONTEST_GLOSS);
	struct contest_spread speed = contest_speed(&contest, CONTEST_CPHONG);

	(void)state;
	assert_float_equal(cost.median, 3, 1e-9);
	assert_int_equal(cost.rounds, 4);
	assert_float_equal(speed.median, 10, 1e-9);
	assert_float_equal(speed.least, 5, 1e-9);
	assert_float_equal(speed.most, 20, 1e-9);
}

static void threads_gain_what_their_least_times_say(void **state)
{
	static struct contest contest = {
		.wall = { [CONTEST_GLOSS] = { 3, 5 }, [CONTEST_THREADS] = { 2, 3 } },
	};

	(void)state;
	assert_float_equal(contest_threads(&contest), 1.6, 1e-9);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_a_painter_lacks_is_said),
		cmocka_unit_test(a_picture_comes_from_another_process),
		cmocka_unit_test(a_failure_is_returned_and_a_death_is_noticed),
		cmocka_unit_test(a_speed_is_the_median_of_quotients),
		cmocka_unit_test(threads_gain_what_their_least_times_say),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
