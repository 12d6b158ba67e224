/* SPDX-License-Identifier: MIT */
/*
 * A mesh drawn by several threads. Its triangles are cut into slices, and each is drawn as if it
 * were a mesh, with a group, a bin and counts of its own. The bins are appended in the order of the
 * mesh. What is worked out of a triangle depends on that triangle alone, so it does not matter
 * where a slice ends, and the words are the same with any number of threads.
 */
#ifndef ACCEL_SLICES_H
#define ACCEL_SLICES_H

#include "draw/bin.h"
#include "draw/group.h"
#include "transport/workers.h"

struct accel_slice;

struct accel_slices {
	unsigned int threads; /* with the calling one */
	struct accel_workers workers;
	struct accel_group *group; /* of each thread */
	struct accel_slice *slice; /* what is worked on at a time; NULL with one thread */
	uint32_t slices;
	struct accel_screen *screen; /* of each vertex of the mesh */
	uint32_t screens_room;
	struct accel_gather gather;
};

/* Memory for as many @threads, none of which is started; @slices must not move. -ENOMEM. */
int accel_slices_init(struct accel_slices *slices, unsigned int threads, int tile_size);
/* @inherited: in a child of fork(), which has none of the threads. */
void accel_slices_fini(struct accel_slices *slices, bool inherited);
/*
 * Draws what accel_arrays_begin() has looked at, in pass->bin. In a child of fork() the calling
 * thread does it alone. -EINVAL: a vertex of a strict pass is not finite, and a message says which;
 * -ENOMEM.
 */
int accel_slices_draw(struct accel_slices *slices, struct accel_pass *pass);

#endif
