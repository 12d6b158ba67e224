// SPDX-License-Identifier: MIT
#include "runner.h"

#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define DEATH_SECONDS 20

double program_clock(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static void redirect(const char *output)
{
	int in = open("/dev/null", O_RDONLY);
	int out = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);

	if (in < 0 || out < 0) {
		fprintf(stderr, "%s: %s\n", output, strerror(errno));
		_exit(126);
	}
	dup2(in, STDIN_FILENO);
	dup2(out, STDOUT_FILENO);
	dup2(out, STDERR_FILENO);
	close(in);
	close(out);
}

__attribute__((noreturn)) static void child(const struct program *program)
{
	gid_t groups[] = { program->group };

	setsid();
	if (program->output)
		redirect(program->output);
	else
		ioctl(STDIN_FILENO, TIOCSCTTY, 1);
	if (setgroups(program->uid ? 1 : 0, groups) || setgid(program->uid) ||
	    setuid(program->uid) || chdir("/tmp"))
		_exit(126);
	execvp(program->argv[0], program->argv);
	fprintf(stderr, "%s: %s\n", program->argv[0], strerror(errno));
	_exit(127);
}

/* Where in the kernel the tasks of a process are, for who reads why it did not end. */
static void print_stack(pid_t pid)
{
	char command[128];

	snprintf(command, sizeof(command),
		 "for task in /proc/%d/task/*; do cat $task/comm $task/stack; done", pid);
	fflush(stdout);
	if (system(command))
		printf("no stack of process %d\n", pid);
}

/* True if the process ended before @until on program_clock(); 0: waits for ever. */
static bool wait_until(pid_t pid, double until, int *status, int log_fd, int board_fd)
{
	int pid_fd = (int)syscall(SYS_pidfd_open, pid, 0);
	struct pollfd fds[] = { { pid_fd, POLLIN, 0 },
				{ log_fd, POLLIN, 0 },
				{ board_fd, POLLIN, 0 } };
	bool ended = false;

	while (!ended) {
		double left = until ? until - program_clock() : 1;

		if (left <= 0)
			break;
		poll(fds, 3, left < 1 ? (int)(left * 1000) + 1 : 1000);
		if (fds[1].revents)
			log_read();
		if (fds[2].revents)
			board_event();
		ended = waitpid(pid, status, WNOHANG) == pid;
	}
	close(pid_fd);
	return ended;
}

/* What it left running would trouble the next one. */
static void kill_rest(pid_t group)
{
	double until = program_clock() + DEATH_SECONDS;

	kill(-group, SIGKILL);
	while (!kill(-group, 0) && program_clock() < until) {
		while (waitpid(-1, NULL, WNOHANG) > 0)
			;
		usleep(1000);
	}
	while (waitpid(-1, NULL, WNOHANG) > 0)
		;
}

void program_run(struct program *program, int log_fd, int board_fd)
{
	double start = program_clock(), until = program->seconds ? start + program->seconds : 0;
	pid_t pid;

	fflush(stdout);
	pid = fork();
	if (pid < 0)
		runner_die("fork: %s", strerror(errno));
	if (!pid)
		child(program);
	program->late = !wait_until(pid, until, &program->status, log_fd, board_fd);
	if (program->late) {
		print_stack(pid);
		kill(-pid, SIGKILL);
		if (!wait_until(pid, program_clock() + DEATH_SECONDS, &program->status, log_fd,
				board_fd)) {
			print_stack(pid);
			runner_die("%s can not be killed, the kernel holds it", program->argv[0]);
		}
	}
	kill_rest(pid);
	program->took = program_clock() - start;
}
