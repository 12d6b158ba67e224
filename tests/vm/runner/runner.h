/* SPDX-License-Identifier: MIT */
/*
 * The guest's runner: loads the module, runs the tests of a plan one after the other, and watches
 * the kernel's log and the boards while it does. One file a noun:
 *
 * plan.c	what the launcher (tests/vm/run) wants
 * log.c	the kernel's log: what in it nobody announced
 * board.c	the boards in slots: where they are, and their nodes' owners, as udev would set them
 * usb.c	the boards on USB: their nodes' owners
 * program.c	runs a program and waits for it
 * debug.c	what the kernel of make check-kasan found
 * runner.c	the order of all this
 */
#ifndef RUNNER_H
#define RUNNER_H

#include <stdbool.h>
#include <stddef.h>

#define PLAN_MODULES 8
#define PLAN_TESTS 128
#define BOARDS 2
#define USB_BOARDS 2

struct plan_test {
	char *name;
	bool root;   /* or the ordinary user */
	int seconds; /* before it is killed */
};

struct plan {
	char *out, *source, *build, *driver, *modules, *seed, *points, *slow_text;
	char *term, *rows, *columns;
	char *modprobe[PLAN_MODULES];
	struct plan_test tests[PLAN_TESTS];
	int modprobes, test_count;
	unsigned int user;
	int slow; /* all has so many times its time */
	bool debug, interactive;
};

/* Ends the guest with a message if the plan can not be used. */
void plan_read(struct plan *plan, const char *path);

/* Ends the guest; @failed is what the launcher gets to know. */
__attribute__((noreturn)) void runner_end(bool failed);
__attribute__((noreturn, format(printf, 1, 2))) void runner_die(const char *format, ...);

/* Their results are for poll(): then call log_read(), board_event(). */
int log_open(void);
void log_read(void);
/* The unexpected lines since the last call, or NULL; no longer announced is what was until now. */
char *log_take(void);
/* Also keeps all lines from here on, for log_take_kept(). */
void log_keep(void);
char *log_take_kept(void);

struct board {
	char pci[64], node[32];
};

int board_open(unsigned int group_render);
/* Sets owner and mode of each node there is. */
void board_event(void);
/* Finds the boards that have a node, waiting for all at most @ms; returns how many. */
int board_find(struct board *boards, int ms);

/* Sets owner and mode of the boards' nodes; returns how many have one. */
int usb_own(unsigned int group_render);

struct program {
	char *const *argv;
	const char *output; /* a file, or NULL for the console */
	unsigned int uid, group;
	int seconds; /* 0: no limit */
	/* Results. */
	int status;  /* of waitpid() */
	bool late;   /* was killed */
	double took; /* seconds */
};

/* Returns when the program and all it started are gone. */
void program_run(struct program *program, int log_fd, int board_fd);
double program_clock(void);

/* Each returns what is wrong, or NULL. */
const char *debug_speak(void);
const char *debug_leaks(void);
const char *debug_state(void);
/* The tests of what was loaded since log_keep(). */
const char *debug_kunit(void);

#endif
