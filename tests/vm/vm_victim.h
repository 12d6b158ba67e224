/* SPDX-License-Identifier: MIT */
/* Processes that are killed in the midst of what they do; include this after cmocka.h. */
#ifndef VM_VICTIM_H
#define VM_VICTIM_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

/*
 * Runs @victim in a process, and returns when it has returned there: from then on the process does
 * nothing, until victim_kill(). What @victim stores at its argument is stored at @told here.
 */
static inline pid_t victim_start(bool (*victim)(uint32_t *told), uint32_t *told)
{
	uint32_t word = 0;
	pid_t process;
	int ready[2];

	assert_int_equal(pipe(ready), 0);
	process = fork();
	assert_int_not_equal(process, -1);
	if (!process) {
		if (victim(&word) && write(ready[1], &word, sizeof(word)) == sizeof(word))
			pause();
		_exit(1);
	}
	close(ready[1]);
	assert_int_equal(read(ready[0], &word, sizeof(word)), sizeof(word));
	close(ready[0]);
	if (told)
		*told = word;
	return process;
}

/* Kills it, and waits until all that it had is closed. */
static inline void victim_kill(pid_t process)
{
	int status;

	assert_int_equal(kill(process, SIGKILL), 0);
	assert_int_equal(waitpid(process, &status, 0), process);
	assert_true(WIFSIGNALED(status));
}

#endif
