/* SPDX-License-Identifier: MIT */
/* The command line of a program that serves boards. */
#ifndef VBOARD_OPTIONS_H
#define VBOARD_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "vboard/pci/faults.h"
#include "vboard/usb/descriptors.h"
#include "vboard/usb/faults.h"

#define VBOARD_BOARDS 8
#define VBOARD_OPTIONS 16 /* of a board that only one program takes, at most */

/* One of these: a number from 0 to @max. */
struct vboard_option {
	const char *name;
	uint32_t max;
	uint32_t *value; /* keeps its default if the option is not given */
};

enum vboard_exit { VBOARD_OK, VBOARD_FAILED, VBOARD_USAGE };

struct vboard_options_board {
	const char *text; /* as given */
	char engine[16];
	int socket;
	uint32_t tile, lanes;
	uint64_t memory;
	struct {
		uint32_t slot; /* VBOARD_NO_SLOT: not given */
		struct vboard_faults_armed armed;
	} pci;
	struct {
		bool super; /* speed */
		char serial[VBOARD_USB_SERIAL_MAX + 1];
		struct vboard_usb_faults_armed armed;
	} usb;
};

/* What one program takes and another does not. */
struct vboard_program {
	const char *usage;
	bool qtest; /* it takes --qtest */
	/* Reads the options of a board. */
	enum vboard_exit (*parse)(struct vboard_options_board *board, const char *text);
};

extern const struct vboard_program vboard_program_pci, vboard_program_usb;

struct vboard_options {
	const struct vboard_program *program;
	const char *qtest; /* NULL: not given */
	bool verbose;
	bool done; /* --help and --version are all there was to do */
	unsigned int boards;
	struct vboard_options_board board[VBOARD_BOARDS];
};

/* All of these say on standard error what is wrong. */
enum vboard_exit vboard_options_parse(struct vboard_options *options,
				      const struct vboard_program *program, int argc, char **argv);
/* For ->parse: the options that every board has, and those of @own, which ends without a name. */
enum vboard_exit vboard_options_board(struct vboard_options_board *board, const char *text,
				      const struct vboard_option *own);
enum vboard_exit vboard_usage_error(const char *what, const char *why);

/* "PROGRAM: what: why" on standard error. */
void vboard_error(const char *what, const char *why);

#endif
