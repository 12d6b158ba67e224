// SPDX-License-Identifier: MIT
/* What a terminal shows of a long wait; here it is a pseudo-terminal. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "view/progress.c"

static int terminal, before;

/* Standard error is the terminal's one end, what it shows is read at the other. */
static int setup(void **state)
{
	int end;

	(void)state;
	terminal = posix_openpt(O_RDWR | O_NOCTTY);
	if (terminal < 0 || grantpt(terminal) || unlockpt(terminal))
		return -1;
	end = open(ptsname(terminal), O_RDWR | O_NOCTTY);
	before = dup(STDERR_FILENO);
	if (end < 0 || before < 0 || dup2(end, STDERR_FILENO) < 0)
		return -1;
	close(end);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	dup2(before, STDERR_FILENO);
	close(before);
	return close(terminal);
}

/* A mark of the test's own ends what was to be shown. */
static void assert_shown(const char *begin, const char *end)
{
	char shown[256] = "";
	size_t length = 0;

	assert_int_equal(write(STDERR_FILENO, "#", 1), 1);
	while (!length || shown[length - 1] != '#') {
		ssize_t got = read(terminal, shown + length, sizeof(shown) - 1 - length);

		assert_true(got > 0);
		length += (size_t)got;
	}
	shown[length - 1] = '\0';
	length = strlen(shown);
	assert_true(!strncmp(shown, begin, strlen(begin)) && length >= strlen(end));
	assert_string_equal(shown + length - strlen(end), end);
	assert_true(*begin || !length);
}

static void a_short_wait_needs_no_word(void **state)
{
	struct waiting waiting;

	(void)state;
	waiting_begin(&waiting, "m.obj");
	waiting.start += 1000; /* however slow the machine */
	waiting_show(&waiting);
	waiting_end(&waiting);
	assert_shown("", "");
}

static void a_long_wait_is_shown_and_taken_away(void **state)
{
	struct waiting waiting;

	(void)state;
	waiting_begin(&waiting, "m.obj");
	/* A slow machine may make it longer. */
	waiting.start -= 7000;
	waiting_show(&waiting);
	assert_true(waiting.shown);
	waiting_end(&waiting);
	assert_shown("\rreading m.obj, 7", " s\033[K\r\033[K");
}

static void nothing_is_shown_where_there_is_no_terminal(void **state)
{
	int null = open("/dev/null", O_WRONLY), shown = dup(STDERR_FILENO);
	struct waiting waiting;

	(void)state;
	dup2(null, STDERR_FILENO);
	waiting_begin(&waiting, "m.obj");
	waiting.start -= 7000;
	waiting_show(&waiting);
	dup2(shown, STDERR_FILENO);
	assert_false(waiting.shown);
	close(null);
	close(shown);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		CASE(a_short_wait_needs_no_word),
		CASE(a_long_wait_is_shown_and_taken_away),
		CASE(nothing_is_shown_where_there_is_no_terminal),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
