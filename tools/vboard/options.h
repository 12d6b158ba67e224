/* SPDX-License-Identifier: MIT */
/* The command line of vboard-pci. */
#ifndef VBOARD_OPTIONS_H
#define VBOARD_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "faults.h"

#define VBOARD_BOARDS 8

enum vboard_exit { VBOARD_OK, VBOARD_FAILED, VBOARD_USAGE };

struct vboard_options_board {
	const char *text;		/* as given */
	char engine[16];
	int socket;
	uint32_t slot;			/* VBOARD_NO_SLOT: not given */
	uint32_t tile, lanes;
	uint64_t memory;
	struct vboard_faults_armed armed;
};

struct vboard_options {
	const char *qtest;		/* NULL: not given */
	bool verbose;
	bool done;			/* --help and --version are all there was to do */
	unsigned int boards;
	struct vboard_options_board board[VBOARD_BOARDS];
};

/* Says on standard error what is wrong. */
enum vboard_exit vboard_options_parse(struct vboard_options *options, int argc, char **argv);

/* "vboard-pci: what: why" on standard error. */
void vboard_error(const char *what, const char *why);

#endif
