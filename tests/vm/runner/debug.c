// SPDX-License-Identifier: MIT
/* What a kernel with checks of its own knows beyond its log. */
#include "runner.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define KMEMLEAK "/sys/kernel/debug/kmemleak"
#define DMA_ALL_ERRORS "/sys/kernel/debug/dma-api/all_errors"

static char *read_all(const char *path)
{
	char *text = NULL;
	size_t size = 0;
	FILE *file = fopen(path, "r");

	if (!file || getdelim(&text, &size, '\0', file) < 0) {
		free(text);
		text = NULL;
	}
	if (file)
		fclose(file);
	return text;
}

static bool write_all(const char *path, const char *text)
{
	int fd = open(path, O_WRONLY);
	bool written = fd >= 0 && write(fd, text, strlen(text)) > 0;

	if (fd >= 0)
		close(fd);
	return written;
}

/* An object counts as leaked when two scans in a row find nothing that points to it, and not in
 * its first five seconds.
 */
const char *debug_leaks(void)
{
	sleep(6);
	for (int i = 0; i < 2; i++)
		if (!write_all(KMEMLEAK, "scan"))
			return "this kernel has no " KMEMLEAK;
	return read_all(KMEMLEAK);
}

static bool says(const char *path, const char *expected)
{
	char *text = read_all(path);
	bool same = text && strstr(text, expected);

	free(text);
	return same;
}

/*
 * DMA_API_DEBUG counts the errors of all drivers, and is told on the command line to speak of ours
 * alone: of all of them, since the first that it counts is the last that it speaks of else.
 */
const char *debug_speak(void)
{
	return write_all(DMA_ALL_ERRORS, "1") ? NULL : "this kernel has no " DMA_ALL_ERRORS;
}

/* Each of these checkers turns itself off after its first report, or when it has no memory. */
const char *debug_state(void)
{
	if (!says("/sys/kernel/debug/dma-api/disabled", "N\n"))
		return "DMA_API_DEBUG is off";
	if (!says(DMA_ALL_ERRORS, "1\n"))
		return "DMA_API_DEBUG speaks of one error only";
	if (!says("/proc/lockdep_stats", "debug_locks:                             1\n"))
		return "lockdep is off";
	return NULL;
}

/* Of KTAP: cases are indented. */
const char *debug_kunit(void)
{
	char *lines = log_take_kept(), *line = lines;
	int passed = 0;

	while (line && *line) {
		char *end = strchr(line, '\n');

		line += strspn(line, " ");
		if (!strncmp(line, "not ok ", 7))
			return lines;
		passed += !strncmp(line, "ok ", 3);
		line = end ? end + 1 : NULL;
	}
	free(lines);
	return passed ? NULL : "no test ran";
}
