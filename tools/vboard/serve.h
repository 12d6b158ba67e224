/* SPDX-License-Identifier: MIT */
/* What the programs have in common that serve boards to QEMU. */
#ifndef VBOARD_SERVE_H
#define VBOARD_SERVE_H

#include <stddef.h>
#include <stdint.h>

#include "vboard/load.h"
#include "vboard/loop.h"
#include "vboard/options.h"

/* A board that is served: the first member of what a program has of each. */
struct vboard_served {
	struct accel_plugin loaded;
	void *memory; /* of the board; all zero when it is made */
	uint64_t memory_size;
	struct vboard_loop *loop;
};

/* What one program does and another does not. */
struct vboard_serve_ops {
	struct vboard_load_bus bus;
	size_t size; /* of a board, which begins with its vboard_served */
	/*
	 * Makes a board as @options say and sets its ->loop, with all but ->ended. The rest of
	 * its vboard_served is set, and the rest of the board zero. False: out of memory.
	 */
	bool (*init)(void *board, const struct vboard_options_board *options);
	void (*fini)(void *board);
	/* Prints what it did. */
	void (*report)(const void *board);
	/*
	 * Both may be NULL. The first is called when all boards of @options are made, before any
	 * of them runs, and says why not if they are not to; the second when none runs any more.
	 */
	enum vboard_exit (*begin)(void *const *boards, const struct vboard_options *options);
	void (*end)(void *const *boards);
};

/*
 * All that a program does which serves boards to QEMU: reads the command line, makes the boards,
 * and runs their threads until all have ended, or one does with -ECANCELED, or SIGINT or SIGTERM
 * comes. Says on standard error what went wrong.
 */
enum vboard_exit vboard_serve(const struct vboard_serve_ops *ops,
			      const struct vboard_program *program, int argc, char **argv);

#endif
