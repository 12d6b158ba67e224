/* SPDX-License-Identifier: MIT */
/*
 * A process of its own for what reads a file from anywhere: it may crash, want all memory or never
 * end, and the caller gets an error and a line that says so.
 */
#ifndef TOOLS_MESH_CHILD_H
#define TOOLS_MESH_CHILD_H

#include <stdint.h>

#include "scene/mesh.h"

struct child_limits {
	uint64_t memory;      /* bytes of address space */
	unsigned int seconds; /* of processor time */
};

/* What a mesh file may take: half of the machine's memory, but 1 to 16 GiB; ten minutes. */
struct child_limits child_limits_default(void);

/* Puts @mesh together; runs in the child. As mesh_load on failure. */
typedef int (*child_fn)(const char *path, const struct mesh_options *options, struct mesh *mesh,
			char message[MESH_MESSAGE]);

/*
 * Calls @load in a child and copies what it made into @mesh. The child ends with this process, has
 * no standard streams, leaves no core and prints nothing. Errors are those of @load, and -EPROTO
 * (it crashed), -ETIME (the seconds are over), -ENOMEM; @message says which.
 */
int child_run(child_fn load, const char *path, const struct mesh_options *options,
	      const struct child_limits *limits, struct mesh *mesh, char message[MESH_MESSAGE]);

#endif
