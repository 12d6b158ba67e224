/* SPDX-License-Identifier: MIT */
/*
 * Files that appear whole or not at all: written beside their place under
 * another name, and renamed. What is not a regular file (a terminal, a pipe,
 * /dev/null) is written directly. One output is open at a time.
 */
#ifndef TOOLS_OUTPUT_H
#define TOOLS_OUTPUT_H

#include <stdio.h>

struct output {
	FILE *file;
	char *path;      /* where it is to be */
	char *temporary; /* NULL: written directly */
};

/* -errno */
int output_open(struct output *output, const char *path);
/* Closes the file and puts it in its place; on failure nothing is left. -errno */
int output_commit(struct output *output);
/* Closes the file and leaves nothing. */
void output_discard(struct output *output);

/* Makes SIGINT and SIGTERM remove the file being written and exit with 128 + the signal. */
void output_catch_signals(void);

#endif
