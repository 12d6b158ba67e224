// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "draw/slices.h"

/*
 * Each thread is to have some slices, as they take different times; but what two of them share is
 * worked twice, and a thread has to be worth waking.
 */
#define SLICES_OF_THREAD 8u
#define TRIANGLES_LEAST 2048u
#define TRIANGLES_MOST ACCEL_GROUP_FACES
#define SLICE_VERTICES 4096u

struct accel_slice {
	struct accel_bin bin;
	struct accel_draw_stats stats;
	int err;
};

static int slices_init_threads(struct accel_slices *slices, unsigned int threads, int tile_size)
{
	slices->slices = threads * SLICES_OF_THREAD;
	slices->slice = calloc(slices->slices, sizeof(*slices->slice));
	if (!slices->slice)
		return -ENOMEM;
	for (uint32_t i = 0; i < slices->slices; i++)
		accel_bin_init(&slices->slice[i].bin, tile_size);
	accel_workers_init(&slices->workers, threads);
	return 0;
}

int accel_slices_init(struct accel_slices *slices, unsigned int threads, int tile_size)
{
	int err = 0;

	*slices = (struct accel_slices){ .threads = threads };
	slices->group = calloc(threads, sizeof(*slices->group));
	if (!slices->group)
		return -ENOMEM;
	if (threads > 1)
		err = slices_init_threads(slices, threads, tile_size);
	if (err)
		free(slices->group);
	return err;
}

void accel_slices_fini(struct accel_slices *slices, bool inherited)
{
	if (slices->slice && !inherited)
		accel_workers_fini(&slices->workers);
	for (uint32_t i = 0; i < slices->slices; i++)
		accel_bin_free(&slices->slice[i].bin);
	for (unsigned int i = 0; i < slices->threads; i++)
		accel_group_free(&slices->group[i]);
	free(slices->slice);
	free(slices->group);
	free(slices->screen);
	free(slices->gather.number);
}

static int slices_reserve_screens(struct accel_slices *slices, uint32_t vertices)
{
	size_t size;

	if (vertices <= slices->screens_room)
		return 0;
	if (__builtin_mul_overflow(vertices, sizeof(*slices->screen), &size))
		return -ENOMEM;
	free(slices->screen);
	slices->screens_room = 0;
	slices->screen = malloc(size);
	if (!slices->screen)
		return -ENOMEM;
	slices->screens_room = vertices;
	return 0;
}

/* What the threads work on together. */
struct share {
	struct accel_slices *slices;
	const struct accel_pass *pass;
	uint64_t first;            /* triangle of the first slice */
	uint32_t size;             /* triangles of a slice */
	uint64_t end;              /* of all triangles */
	_Atomic uint32_t infinite; /* the first vertex that is not finite, or how many there are */
};

static uint64_t slice_end(uint64_t first, uint64_t size, uint64_t end)
{
	return end - first < size ? end : first + size;
}

static uint64_t slices_of(uint64_t count, uint32_t size)
{
	return count / size + (count % size != 0);
}

/* ---- vertices ---- */

static void slices_transform_one(void *data, unsigned int worker, uint32_t item)
{
	struct share *share = data;
	const uint32_t vertices = share->pass->vertices, first = item * SLICE_VERTICES;
	const uint32_t end = (uint32_t)slice_end(first, SLICE_VERTICES, vertices);
	uint32_t found = accel_mesh_transform(share->pass, first, end);
	uint32_t least = atomic_load(&share->infinite);

	(void)worker;
	while (found < end && found < least &&
	       !atomic_compare_exchange_weak(&share->infinite, &least, found))
		;
}

static int slices_transform(struct accel_slices *slices, const struct accel_pass *pass, bool alone)
{
	const uint32_t vertices = pass->vertices;
	struct share share = { .slices = slices, .pass = pass, .infinite = vertices };

	if (alone)
		share.infinite = accel_mesh_transform(pass, 0, vertices);
	else
		accel_workers_run(&slices->workers, slices_transform_one, &share,
				  (uint32_t)slices_of(vertices, SLICE_VERTICES));
	if (share.infinite == vertices)
		return 0;
	accel_device_message(pass->device, "vertex %u of the mesh is not finite", share.infinite);
	return -EINVAL;
}

/* ---- triangles ---- */

static void slices_draw_one(void *data, unsigned int worker, uint32_t item)
{
	const struct share *share = data;
	const uint64_t first = share->first + (uint64_t)item * share->size;
	struct accel_slice *slice = &share->slices->slice[item];
	struct accel_pass pass = *share->pass;

	slice->stats = (struct accel_draw_stats){ 0 };
	pass.group = &share->slices->group[worker];
	pass.bin = &slice->bin;
	pass.stats = &slice->stats;
	slice->err = accel_bin_part_begin(&slice->bin, share->pass->bin);
	if (!slice->err)
		slice->err = accel_group_reserve(pass.group, pass.vertices, share->size);
	if (!slice->err)
		slice->err = accel_mesh_draw(&pass, first,
					     slice_end(first, share->size, share->end));
}

static void slices_count(struct accel_draw_stats *to, const struct accel_draw_stats *from)
{
	to->triangles_in += from->triangles_in;
	to->culled += from->culled;
	to->clipped += from->clipped;
	to->flat += from->flat;
	to->linear += from->linear;
	to->second_order += from->second_order;
	to->split += from->split;
}

static int slices_append(const struct accel_pass *pass, struct accel_slice *slice)
{
	slices_count(pass->stats, &slice->stats);
	return slice->err ? slice->err : accel_bin_append(pass->bin, &slice->bin);
}

static uint32_t slices_size(const struct accel_slices *slices, uint64_t triangles)
{
	uint64_t size = triangles / slices->slices + 1;

	if (size < TRIANGLES_LEAST)
		return TRIANGLES_LEAST;
	return size < TRIANGLES_MOST ? (uint32_t)size : TRIANGLES_MOST;
}

static int slices_draw_shared(struct accel_slices *slices, const struct accel_pass *pass)
{
	const uint64_t triangles = pass->triangles;
	struct share share = { .slices = slices, .pass = pass, .end = triangles };
	int err = 0;

	share.size = slices_size(slices, triangles);
	while (share.first < triangles && !err) {
		uint64_t left = slices_of(triangles - share.first, share.size);
		uint32_t count = left < slices->slices ? (uint32_t)left : slices->slices;

		accel_workers_run(&slices->workers, slices_draw_one, &share, count);
		for (uint32_t i = 0; i < count && !err; i++)
			err = slices_append(pass, &slices->slice[i]);
		share.first = slice_end(share.first, (uint64_t)count * share.size, triangles);
	}
	return err;
}

static int slices_draw_alone(struct accel_slices *slices, struct accel_pass *pass)
{
	const uint64_t triangles = pass->triangles;
	const uint32_t most = triangles < UINT32_MAX ? (uint32_t)triangles : UINT32_MAX;
	int err = accel_group_reserve(&slices->group[0], pass->vertices, most);

	pass->group = &slices->group[0];
	if (err)
		return err;
	if (pass->figure == ACCEL_FIGURE_POINTS)
		return accel_points_draw(pass);
	if (pass->figure == ACCEL_FIGURE_LINES)
		return accel_lines_draw(pass);
	if (pass->figure == ACCEL_FIGURE_POLYGONS)
		return accel_polygons_draw(pass);
	return accel_mesh_draw(pass, 0, triangles);
}

int accel_slices_draw(struct accel_slices *slices, struct accel_pass *pass)
{
	const bool alone = slices->threads == 1 || accel_device_is_inherited(pass->device) ||
			   pass->triangles <= TRIANGLES_LEAST ||
			   pass->figure != ACCEL_FIGURE_FILLED;
	int err = slices_reserve_screens(slices, pass->vertices);

	pass->screen = slices->screen;
	if (!err)
		err = slices_transform(slices, pass, alone);
	if (err || !pass->triangles)
		return err;
	return alone ? slices_draw_alone(slices, pass) : slices_draw_shared(slices, pass);
}
