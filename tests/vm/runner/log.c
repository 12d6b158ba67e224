// SPDX-License-Identifier: MIT
/*
 * Reads /dev/kmsg from where it stood when the tests began. A record is
 * "PRIORITY,SEQUENCE,MICROSECONDS,FLAGS;TEXT\n KEY=VALUE\n..."; programs that write there get
 * another facility than the kernel's, 0, and can so announce what they are about to provoke.
 */
#include "runner.h"

#include <errno.h>
#include <fcntl.h>
#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define NOTICE 5
#define EXPECTED 16
#define DIRECTIVE "gloss-test: "

struct text {
	char *start;
	size_t size;
};

/* What the kernel says of any module that did not come with it, and of a processor that QEMU
 * did not get to run for a while.
 */
static const char *const harmless[] = {
	"loading out-of-tree module taints kernel.",
	"hrtimer: interrupt took ",
	"sched: RT throttling activated",
	"clocksource: Long readout interval",
};

static int fd;
static regex_t expected[EXPECTED];
static int expected_count;
static struct text unexpected, kept;
static bool keep;

static void text_add(struct text *text, const char *line)
{
	size_t length = strlen(line);
	char *start = realloc(text->start, text->size + length + 2);

	if (!start)
		runner_die("no memory for the kernel log");
	text->start = start;
	/* NOLINTNEXTLINE(bugprone-not-null-terminated-result): the next one does that */
	memcpy(start + text->size, line, length);
	memcpy(start + text->size + length, "\n", 2);
	text->size += length + 1;
}

static char *text_take(struct text *text)
{
	char *start = text->start;

	*text = (struct text){ 0 };
	return start;
}

static void expect_nothing(void)
{
	while (expected_count)
		regfree(&expected[--expected_count]);
}

static void expect(const char *regex)
{
	if (expected_count == EXPECTED ||
	    regcomp(&expected[expected_count], regex, REG_EXTENDED | REG_NOSUB)) {
		text_add(&unexpected, "what a test expects can not be understood:");
		text_add(&unexpected, regex);
		return;
	}
	expected_count++;
}

static bool is_expected(const char *text)
{
	for (size_t i = 0; i < sizeof(harmless) / sizeof(harmless[0]); i++)
		if (strstr(text, harmless[i]))
			return true;
	for (int i = 0; i < expected_count; i++)
		if (!regexec(&expected[i], text, 0, NULL, 0))
			return true;
	return false;
}

static void directive(const char *text)
{
	if (!strncmp(text, "expect ", 7))
		expect(text + 7);
	else if (!strcmp(text, "end"))
		expect_nothing();
}

static void record(char *line)
{
	char *text = strchr(line, ';');
	unsigned int priority = (unsigned int)strtoul(line, NULL, 10);

	if (!text++)
		return;
	text[strcspn(text, "\n")] = '\0';
	if (priority / 8) {
		if (!strncmp(text, DIRECTIVE, strlen(DIRECTIVE)))
			directive(text + strlen(DIRECTIVE));
		return;
	}
	if (keep)
		text_add(&kept, text);
	if (priority % 8 < NOTICE && !is_expected(text))
		text_add(&unexpected, text);
}

int log_open(void)
{
	fd = open("/dev/kmsg", O_RDONLY | O_NONBLOCK | O_CLOEXEC);
	if (fd < 0 || lseek(fd, 0, SEEK_END) < 0)
		runner_die("/dev/kmsg: %s", strerror(errno));
	return fd;
}

void log_read(void)
{
	char line[8192];
	ssize_t got;

	for (;;) {
		got = read(fd, line, sizeof(line) - 1);
		if (got > 0) {
			line[got] = '\0';
			record(line);
		} else if (got < 0 && errno == EPIPE) {
			text_add(&unexpected, "the kernel log ran over, some of it is lost");
		} else if (got == 0 || errno != EINTR) {
			return;
		}
	}
}

char *log_take(void)
{
	log_read();
	expect_nothing();
	return text_take(&unexpected);
}

void log_keep(void)
{
	log_read();
	keep = true;
}

char *log_take_kept(void)
{
	log_read();
	keep = false;
	return text_take(&kept);
}
