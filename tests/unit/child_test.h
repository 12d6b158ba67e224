/* SPDX-License-Identifier: MIT */
/* What is done in a child of fork(), and what is left undone there on purpose. */
#ifndef CHILD_TEST_H
#define CHILD_TEST_H

#include <sys/wait.h>
#include <unistd.h>

#include "accel_test.h"

/* The answer of @body in a child, 0 to 255; -1: it did not come to that. The child becomes another
 * program at its end, so that no checker looks there for what was not freed. */
static inline int child_run(int (*body)(void), unsigned int seconds)
{
	char command[16];
	pid_t child = fork();
	int status;

	assert_true(child >= 0);
	if (!child) {
		alarm(seconds);
		snprintf(command, sizeof(command), "exit %d", body());
		execl("/bin/sh", "sh", "-c", command, NULL);
		_exit(255);
	}
	assert_int_equal(waitpid(child, &status, 0), child);
	return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

#endif
