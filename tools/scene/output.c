// SPDX-License-Identifier: MIT
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene/output.h"

/* What the signal handler removes. */
static char unfinished[PATH_MAX];

static void interrupted(int number)
{
	if (unfinished[0])
		unlink(unfinished);
	_exit(128 + number);
}

void output_catch_signals(void)
{
	struct sigaction action = { .sa_handler = interrupted };

	sigemptyset(&action.sa_mask);
	sigaddset(&action.sa_mask, SIGINT);
	sigaddset(&action.sa_mask, SIGTERM);
	sigaction(SIGINT, &action, NULL);
	sigaction(SIGTERM, &action, NULL);
}

/* While a file appears or disappears and its name is noted. */
static void hold_signals(int how)
{
	sigset_t set;

	sigemptyset(&set);
	sigaddset(&set, SIGINT);
	sigaddset(&set, SIGTERM);
	sigprocmask(how, &set, NULL);
}

/* mkstemp makes files for the owner only; a picture is as readable as any other. */
static int open_temporary(char *template)
{
	mode_t mask = umask(0);
	int fd;

	umask(mask);
	hold_signals(SIG_BLOCK);
	fd = mkstemp(template);
	if (fd >= 0)
		memcpy(unfinished, template, strlen(template) + 1);
	hold_signals(SIG_UNBLOCK);
	if (fd >= 0)
		fchmod(fd, 0666 & ~mask);
	return fd;
}

static void forget(struct output *output)
{
	free(output->path);
	free(output->temporary);
	memset(output, 0, sizeof(*output));
}

static int open_beside(struct output *output)
{
	size_t size = strlen(output->path) + sizeof(".XXXXXX");
	int fd;

	if (size > sizeof(unfinished))
		return -ENAMETOOLONG;
	output->temporary = malloc(size);
	if (!output->temporary)
		return -ENOMEM;
	snprintf(output->temporary, size, "%s.XXXXXX", output->path);
	fd = open_temporary(output->temporary);
	return fd < 0 ? -errno : fd;
}

/* Takes the temporary file away or to its place. */
static int finish(struct output *output, int error)
{
	if (output->temporary) {
		hold_signals(SIG_BLOCK);
		if (!error && rename(output->temporary, output->path))
			error = -errno;
		if (error)
			unlink(output->temporary);
		unfinished[0] = '\0';
		hold_signals(SIG_UNBLOCK);
	}
	forget(output);
	return error;
}

int output_open(struct output *output, const char *path)
{
	struct stat status;
	int fd;

	memset(output, 0, sizeof(*output));
	/* A symbolic link stays one. */
	output->path = realpath(path, NULL);
	if (!output->path)
		output->path = strdup(path);
	if (!output->path)
		return -ENOMEM;
	if (!stat(output->path, &status) && !S_ISREG(status.st_mode)) {
		fd = open(output->path, O_WRONLY | O_CLOEXEC);
		fd = fd < 0 ? -errno : fd;
	} else {
		fd = open_beside(output);
	}
	if (fd < 0) {
		forget(output);
		return fd;
	}
	output->file = fdopen(fd, "wb");
	if (output->file)
		return 0;
	close(fd);
	return finish(output, -ENOMEM);
}

int output_commit(struct output *output)
{
	int error = 0;

	errno = 0;
	if (ferror(output->file) || fflush(output->file))
		error = errno ? -errno : -EIO;
	if (fclose(output->file) && !error)
		error = -errno;
	return finish(output, error);
}

void output_discard(struct output *output)
{
	fclose(output->file);
	finish(output, -ECANCELED);
}
