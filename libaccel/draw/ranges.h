/* SPDX-License-Identifier: MIT */
/*
 * A mesh drawn by several threads. Its triangles are cut into ranges, and each is drawn as if it
 * were a mesh, with a group, a bin and counts of its own. The bins are appended in the order of the
 * mesh. What is worked out of a triangle depends on that triangle alone, so it does not matter
 * where a range ends, and the words are the same with any number of threads.
 */
#ifndef ACCEL_RANGES_H
#define ACCEL_RANGES_H

#include "draw/bin.h"
#include "draw/group.h"
#include "transport/workers.h"

struct accel_range;

struct accel_ranges {
	unsigned int threads; /* with the calling one */
	struct accel_workers workers;
	struct accel_group *group; /* of each thread */
	struct accel_range *range; /* what is worked on at a time; NULL with one thread */
	uint32_t ranges;
	struct accel_screen *screen; /* of each vertex of the mesh */
	uint32_t screens_room;
};

/* Memory for as many @threads, none of which is started; @ranges must not move. -ENOMEM. */
int accel_ranges_init(struct accel_ranges *ranges, unsigned int threads, int tile_size);
/* @inherited: in a child of fork(), which has none of the threads. */
void accel_ranges_fini(struct accel_ranges *ranges, bool inherited);
/*
 * Draws pass->mesh, which accel_mesh_begin() has looked at, in pass->bin. In a child of fork() the
 * calling thread does it alone. -EINVAL: a vertex is not finite, and a message says which; -ENOMEM.
 */
int accel_ranges_draw(struct accel_ranges *ranges, struct accel_pass *pass);

#endif
