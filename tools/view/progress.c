// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "view/view.h"

#define BAR 30
#define INTERVAL 0.1 /* seconds between lines */
#define PATIENCE 1   /* seconds of waiting that need no word */

static double now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

void progress_begin(struct progress *progress, int total)
{
	progress->shown = isatty(STDERR_FILENO);
	progress->total = total;
	progress->start = now();
	progress->last = 0;
	progress_show(progress, 0);
}

void progress_show(struct progress *progress, int done)
{
	static const char full[BAR + 1] = "##############################";
	double time = now();
	double rate = done / (time - progress->start + 1e-9);
	int left = done ? (int)((progress->total - done) / rate + 0.5) : 0;
	int filled = done * BAR / progress->total;

	if (!progress->shown || (time - progress->last < INTERVAL && done < progress->total))
		return;
	progress->last = time;
	fprintf(stderr, "\r[%-*.*s] %d/%d frames, %.1f a second, %d:%02d left\033[K", BAR, filled,
		full, done, progress->total, rate, left / 60, left % 60);
	fflush(stderr);
}

void progress_end(struct progress *progress)
{
	if (progress->shown)
		fputc('\n', stderr);
}

void waiting_begin(struct waiting *waiting, const char *what)
{
	waiting->what = what;
	waiting->start = now();
	waiting->shown = false;
}

void waiting_show(void *data)
{
	struct waiting *waiting = data;
	double seconds = now() - waiting->start;

	if (seconds < PATIENCE || !isatty(STDERR_FILENO))
		return;
	waiting->shown = true;
	fprintf(stderr, "\rreading %s, %d s\033[K", waiting->what, (int)seconds);
	fflush(stderr);
}

void waiting_end(struct waiting *waiting)
{
	if (waiting->shown)
		fputs("\r\033[K", stderr);
}
