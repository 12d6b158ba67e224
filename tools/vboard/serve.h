/* SPDX-License-Identifier: MIT */
/* What the programs have in common that serve boards to QEMU. */
#ifndef VBOARD_SERVE_H
#define VBOARD_SERVE_H

#include <stdint.h>

#include "vboard/loop.h"
#include "vboard/options.h"

/* Before any other thread: SIGINT and SIGTERM end vboard_serve_run(). False: says why not. */
bool vboard_serve_init(void);

/* Is it a connected Unix socket? False: says that it is not, to board @name. */
bool vboard_serve_socket(const char *name, int fd);

/* Board memory of @size bytes, all zero; NULL: out of memory. */
void *vboard_serve_memory(uint64_t size);

/*
 * Runs the threads of @count boards, until all have ended, or one does with -ECANCELED, or a
 * signal comes. Says of those that failed why; @names are for that.
 */
enum vboard_exit vboard_serve_run(struct vboard_loop *const *loops, const char *const *names,
				  unsigned int count);

#endif
