// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "draw/ranges.h"

/*
 * Each thread is to have some ranges, as they take different times; but what two of them share is
 * worked twice, and a thread has to be worth waking.
 */
#define RANGES_OF_THREAD 8u
#define TRIANGLES_LEAST 2048u
#define TRIANGLES_MOST ACCEL_GROUP_FACES
#define RANGE_VERTICES 4096u

struct accel_range {
	struct accel_bin bin;
	struct accel_draw_stats stats;
	int err;
};

static int ranges_init_threads(struct accel_ranges *ranges, unsigned int threads, int tile_size)
{
	ranges->ranges = threads * RANGES_OF_THREAD;
	ranges->range = calloc(ranges->ranges, sizeof(*ranges->range));
	if (!ranges->range)
		return -ENOMEM;
	for (uint32_t i = 0; i < ranges->ranges; i++)
		accel_bin_init(&ranges->range[i].bin, tile_size);
	accel_workers_init(&ranges->workers, threads);
	return 0;
}

int accel_ranges_init(struct accel_ranges *ranges, unsigned int threads, int tile_size)
{
	int err = 0;

	*ranges = (struct accel_ranges){ .threads = threads };
	ranges->group = calloc(threads, sizeof(*ranges->group));
	if (!ranges->group)
		return -ENOMEM;
	if (threads > 1)
		err = ranges_init_threads(ranges, threads, tile_size);
	if (err)
		free(ranges->group);
	return err;
}

void accel_ranges_fini(struct accel_ranges *ranges, bool inherited)
{
	if (ranges->range && !inherited)
		accel_workers_fini(&ranges->workers);
	for (uint32_t i = 0; i < ranges->ranges; i++)
		accel_bin_free(&ranges->range[i].bin);
	for (unsigned int i = 0; i < ranges->threads; i++)
		accel_group_free(&ranges->group[i]);
	free(ranges->range);
	free(ranges->group);
	free(ranges->screen);
}

static int ranges_reserve_screens(struct accel_ranges *ranges, uint32_t vertices)
{
	size_t size;

	if (vertices <= ranges->screens_room)
		return 0;
	if (__builtin_mul_overflow(vertices, sizeof(*ranges->screen), &size))
		return -ENOMEM;
	free(ranges->screen);
	ranges->screens_room = 0;
	ranges->screen = malloc(size);
	if (!ranges->screen)
		return -ENOMEM;
	ranges->screens_room = vertices;
	return 0;
}

/* What the threads work on together. */
struct share {
	struct accel_ranges *ranges;
	const struct accel_pass *pass;
	uint32_t first;            /* triangle of the first range */
	uint32_t size;             /* triangles of a range */
	uint32_t end;              /* of all triangles */
	_Atomic uint32_t infinite; /* the first vertex that is not finite, or how many there are */
};

static uint32_t range_end(uint32_t first, uint32_t size, uint32_t end)
{
	return end - first < size ? end : first + size;
}

static uint32_t ranges_of(uint32_t count, uint32_t size)
{
	return count / size + (count % size != 0);
}

/* ---- vertices ---- */

static void ranges_transform_one(void *data, unsigned int worker, uint32_t item)
{
	struct share *share = data;
	const uint32_t vertices = share->pass->mesh->vertices, first = item * RANGE_VERTICES;
	const uint32_t end = range_end(first, RANGE_VERTICES, vertices);
	uint32_t found = accel_mesh_transform(share->pass, first, end);
	uint32_t least = atomic_load(&share->infinite);

	(void)worker;
	while (found < end && found < least &&
	       !atomic_compare_exchange_weak(&share->infinite, &least, found))
		;
}

static int ranges_transform(struct accel_ranges *ranges, const struct accel_pass *pass, bool alone)
{
	const uint32_t vertices = pass->mesh->vertices;
	struct share share = { .ranges = ranges, .pass = pass, .infinite = vertices };

	if (alone)
		share.infinite = accel_mesh_transform(pass, 0, vertices);
	else
		accel_workers_run(&ranges->workers, ranges_transform_one, &share,
				  ranges_of(vertices, RANGE_VERTICES));
	if (share.infinite == vertices)
		return 0;
	accel_device_message(pass->device, "vertex %u of the mesh is not finite", share.infinite);
	return -EINVAL;
}

/* ---- triangles ---- */

static void ranges_draw_one(void *data, unsigned int worker, uint32_t item)
{
	const struct share *share = data;
	const uint32_t first = share->first + item * share->size;
	struct accel_range *range = &share->ranges->range[item];
	struct accel_pass pass = *share->pass;

	range->stats = (struct accel_draw_stats){ 0 };
	pass.group = &share->ranges->group[worker];
	pass.bin = &range->bin;
	pass.stats = &range->stats;
	range->err = accel_bin_part_begin(&range->bin, share->pass->bin);
	if (!range->err)
		range->err = accel_group_reserve(pass.group, pass.mesh->vertices, share->size);
	if (!range->err)
		range->err = accel_mesh_draw(&pass, first,
					     range_end(first, share->size, share->end));
}

static void ranges_count(struct accel_draw_stats *to, const struct accel_draw_stats *from)
{
	to->triangles_in += from->triangles_in;
	to->culled += from->culled;
	to->clipped += from->clipped;
	to->flat += from->flat;
	to->linear += from->linear;
	to->second_order += from->second_order;
	to->split += from->split;
}

static int ranges_append(const struct accel_pass *pass, struct accel_range *range)
{
	ranges_count(pass->stats, &range->stats);
	return range->err ? range->err : accel_bin_append(pass->bin, &range->bin);
}

static uint32_t ranges_size(const struct accel_ranges *ranges, uint32_t triangles)
{
	uint32_t size = triangles / ranges->ranges + 1;

	if (size < TRIANGLES_LEAST)
		return TRIANGLES_LEAST;
	return size < TRIANGLES_MOST ? size : TRIANGLES_MOST;
}

static int ranges_draw_shared(struct accel_ranges *ranges, const struct accel_pass *pass,
			      uint32_t triangles)
{
	struct share share = { .ranges = ranges, .pass = pass, .end = triangles };
	int err = 0;

	share.size = ranges_size(ranges, triangles);
	while (share.first < triangles && !err) {
		uint32_t count = ranges_of(triangles - share.first, share.size);

		if (count > ranges->ranges)
			count = ranges->ranges;
		accel_workers_run(&ranges->workers, ranges_draw_one, &share, count);
		for (uint32_t i = 0; i < count && !err; i++)
			err = ranges_append(pass, &ranges->range[i]);
		share.first = range_end(share.first, count * share.size, triangles);
	}
	return err;
}

static int ranges_draw_alone(struct accel_ranges *ranges, struct accel_pass *pass,
			     uint32_t triangles)
{
	int err = accel_group_reserve(&ranges->group[0], pass->mesh->vertices, triangles);

	pass->group = &ranges->group[0];
	return err ? err : accel_mesh_draw(pass, 0, triangles);
}

int accel_ranges_draw(struct accel_ranges *ranges, struct accel_pass *pass)
{
	const uint32_t triangles = accel_mesh_triangles(pass->mesh);
	const bool alone = ranges->threads == 1 || accel_device_is_inherited(pass->device) ||
			   triangles <= TRIANGLES_LEAST;
	int err = ranges_reserve_screens(ranges, pass->mesh->vertices);

	pass->screen = ranges->screen;
	if (!err)
		err = ranges_transform(ranges, pass, alone);
	if (err)
		return err;
	return alone ? ranges_draw_alone(ranges, pass, triangles) :
		       ranges_draw_shared(ranges, pass, triangles);
}
