// SPDX-License-Identifier: MIT
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/output.h"
#include "scene/picture.h"

/* Each test has a directory of its own, which is to be empty afterwards: it is removed as such. */
static int setup(void **state)
{
	char *directory = strdup("/tmp/test-picture-XXXXXX");

	*state = directory;
	return !mkdtemp(directory) || chdir(directory);
}

static int teardown(void **state)
{
	int ret = chdir("/") || rmdir(*state);

	free(*state);
	return ret;
}

static struct picture pattern(int width, int height)
{
	struct picture picture;

	assert_int_equal(picture_new(width, height, &picture), 0);
	for (int i = 0; i < width * height; i++)
		picture.pixel[i] = 0xff000000u | (uint32_t)i * 2654435761u >> 8;
	return picture;
}

static void assert_same(const struct picture *a, const struct picture *b)
{
	assert_int_equal(a->width, b->width);
	assert_int_equal(a->height, b->height);
	assert_memory_equal(a->pixel, b->pixel, (size_t)a->width * a->height * sizeof(*a->pixel));
}

static void what_was_written_is_read(void **state)
{
	static const int sizes[][2] = { { 1, 1 }, { 3, 2 }, { 101, 77 } };

	(void)state;
	for (int i = 0; i < 3; i++) {
		struct picture written = pattern(sizes[i][0], sizes[i][1]), read;

		assert_int_equal(picture_write(&written, "p.png"), 0);
		assert_int_equal(picture_read(&read, "p.png"), 0);
		assert_same(&written, &read);
		picture_free(&written);
		picture_free(&read);
	}
	unlink("p.png");
}

static void what_is_no_picture_is_refused(void **state)
{
	struct picture picture;
	FILE *file;

	(void)state;
	assert_int_equal(picture_new(0, 5, &picture), -EINVAL);
	assert_int_equal(picture_new(5, -1, &picture), -EINVAL);
	assert_int_equal(picture_new(1 << 20, 1 << 20, &picture), -EINVAL);
	assert_int_equal(picture_read(&picture, "missing.png"), -ENOENT);
	file = fopen("text.png", "w");
	assert_non_null(file);
	fputs("not a picture", file);
	fclose(file);
	assert_int_equal(picture_read(&picture, "text.png"), -EINVAL);
	unlink("text.png");
}

static void a_picture_cut_short_is_refused(void **state)
{
	struct picture picture = pattern(60, 60), read;
	struct stat status;

	(void)state;
	assert_int_equal(picture_write(&picture, "p.png"), 0);
	assert_int_equal(stat("p.png", &status), 0);
	assert_int_equal(truncate("p.png", status.st_size / 2), 0);
	assert_int_equal(picture_read(&read, "p.png"), -EINVAL);
	picture_free(&picture);
	unlink("p.png");
}

static void errors_of_the_place_are_told(void **state)
{
	struct picture picture = pattern(50, 50);

	(void)state;
	assert_int_equal(picture_write(&picture, "no/such/p.png"), -ENOENT);
	assert_int_equal(picture_write(&picture, "/dev/full"), -ENOSPC);
	assert_int_equal(picture_write(&picture, "."), -EISDIR);
	assert_int_equal(mkdir("d", 0700), 0);
	assert_int_equal(picture_write(&picture, "d"), -EISDIR);
	rmdir("d");
	picture_free(&picture);
}

/* A file may not grow beyond 512 bytes: as on a full disk, but without root. */
static void a_full_disk_leaves_the_old_file(void **state)
{
	struct picture old = pattern(4, 4), large = pattern(200, 200), read;
	struct rlimit limit, small;

	(void)state;
	assert_int_equal(picture_write(&old, "p.png"), 0);
	getrlimit(RLIMIT_FSIZE, &limit);
	small = limit;
	small.rlim_cur = 512;
	signal(SIGXFSZ, SIG_IGN);
	setrlimit(RLIMIT_FSIZE, &small);
	assert_int_equal(picture_write(&large, "p.png"), -EFBIG);
	assert_int_equal(picture_write(&large, "new.png"), -EFBIG);
	setrlimit(RLIMIT_FSIZE, &limit);
	signal(SIGXFSZ, SIG_DFL);
	assert_int_equal(picture_read(&read, "p.png"), 0);
	assert_same(&old, &read);
	picture_free(&old);
	picture_free(&large);
	picture_free(&read);
	unlink("p.png");
}

static void a_file_is_as_readable_as_the_mask_allows(void **state)
{
	struct picture picture = pattern(4, 4);
	mode_t mask = umask(027);
	struct stat status;

	(void)state;
	assert_int_equal(picture_write(&picture, "p.png"), 0);
	assert_int_equal(umask(mask), 027);
	assert_int_equal(stat("p.png", &status), 0);
	assert_int_equal(status.st_mode & 0777, 0640);
	picture_free(&picture);
	unlink("p.png");
}

static void a_link_stays_a_link(void **state)
{
	struct picture picture = pattern(4, 4), other = pattern(5, 4), read;
	struct stat status;

	(void)state;
	assert_int_equal(picture_write(&picture, "p.png"), 0);
	assert_int_equal(symlink("p.png", "l.png"), 0);
	assert_int_equal(picture_write(&other, "l.png"), 0);
	assert_int_equal(lstat("l.png", &status), 0);
	assert_true(S_ISLNK(status.st_mode));
	assert_int_equal(picture_read(&read, "p.png"), 0);
	assert_same(&other, &read);
	picture_free(&picture);
	picture_free(&other);
	picture_free(&read);
	unlink("p.png");
	unlink("l.png");
}

static void nothing_is_seen_before_the_end(void **state)
{
	struct output output;

	(void)state;
	assert_int_equal(output_open(&output, "f"), 0);
	fputs("half", output.file);
	fflush(output.file);
	assert_int_equal(access("f", F_OK), -1);
	output_discard(&output);
	assert_int_equal(access("f", F_OK), -1);
	assert_int_equal(output_open(&output, "f"), 0);
	assert_int_equal(output_commit(&output), 0);
	assert_int_equal(access("f", F_OK), 0);
	unlink("f");
}

/* In a process of its own, which a signal ends in the middle of a file. */
static void a_signal_leaves_nothing_and_tells_which(void **state)
{
	static const int signals[] = { SIGINT, SIGTERM };

	(void)state;
	for (int i = 0; i < 2; i++) {
		struct output output;
		int status;
		pid_t pid = fork();

		if (!pid) {
			output_catch_signals();
			if (!output_open(&output, "f") && fputs("half", output.file) >= 0)
				raise(signals[i]);
			_exit(0);
		}
		assert_int_equal(waitpid(pid, &status, 0), pid);
		assert_true(WIFEXITED(status));
		assert_int_equal(WEXITSTATUS(status), 128 + signals[i]);
	}
}

static void a_picture_is_copied_to_its_place(void **state)
{
	struct picture sheet, part = pattern(3, 2);

	(void)state;
	assert_int_equal(picture_new(8, 5, &sheet), 0);
	picture_copy(&sheet, 5, 3, &part);
	for (int y = 0; y < 5; y++)
		for (int x = 0; x < 8; x++)
			assert_int_equal(sheet.pixel[y * 8 + x],
					 x < 5 || y < 3 ? 0xff000000u :
							  part.pixel[(y - 3) * 3 + x - 5]);
	picture_free(&sheet);
	picture_free(&part);
}

static void text_is_drawn_inside_the_picture_only(void **state)
{
	/* An L, twice as large, and what is left of it at the border. */
	static const char *const wanted[] = {
		"..##........", "..##........", "..##........", "..##........", "..##........",
		"..##........", "..##........", "..##........", "..##........", "..##........",
		"..##........", "..##........", "..##########", "..##########",
	};
	struct picture picture;

	(void)state;
	assert_int_equal(picture_new(12, 14, &picture), 0);
	picture_text(&picture, 2, 0, "l", 2, 0xffffffff);
	for (int y = 0; y < 14; y++)
		for (int x = 0; x < 12; x++)
			assert_int_equal(picture.pixel[y * 12 + x] == 0xffffffff,
					 wanted[y][x] == '#');
	picture_text(&picture, -4, -3, "Gloss: 100.5 - ~", 3, 0xff0000ff);
	picture_text(&picture, 7, 12, "WWW", 1, 0xff0000ff);
	picture_free(&picture);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		CASE(what_was_written_is_read),
		CASE(what_is_no_picture_is_refused),
		CASE(a_picture_cut_short_is_refused),
		CASE(errors_of_the_place_are_told),
		CASE(a_full_disk_leaves_the_old_file),
		CASE(a_file_is_as_readable_as_the_mask_allows),
		CASE(a_link_stays_a_link),
		CASE(nothing_is_seen_before_the_end),
		CASE(a_signal_leaves_nothing_and_tells_which),
		CASE(a_picture_is_copied_to_its_place),
		CASE(text_is_drawn_inside_the_picture_only),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
