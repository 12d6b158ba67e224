// SPDX-License-Identifier: MIT
/* The draw calls of accel.h: what they take, and when a frame begins and ends. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>

#include "draw/draw_priv.h"

struct accel_draw {
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_bin bin;
	struct accel_target target;	/* of this frame, its buffers a reference each */
	bool has_target;
	bool submitted;			/* the counts are those of the frame before */
	struct accel_draw_stats stats;
	struct accel_vertex *vertex;	/* scratch, kept from mesh to mesh */
	uint32_t vertices;
	struct accel_edge_entry *cache;
	uint64_t passes;
};

int accel_draw_new(struct accel_device *device, struct accel_draw **out)
{
	struct accel_draw *draw = calloc(1, sizeof(*draw));
	int err;

	if (!draw)
		return -ENOMEM;
	draw->cache = calloc(ACCEL_EDGE_CACHE, sizeof(*draw->cache));
	if (!draw->cache) {
		err = -ENOMEM;
		goto err_free;
	}
	err = accel_stream_new(device, &draw->stream);
	if (err)
		goto err_free_cache;
	draw->device = accel_device_ref(device);
	accel_bin_init(&draw->bin, (int)device->info.tile_size);
	*out = draw;
	return 0;

err_free_cache:
	free(draw->cache);
err_free:
	free(draw);
	return err;
}

/* Forgets the frame. */
static void draw_frame_empty(struct accel_draw *draw)
{
	accel_bin_reset(&draw->bin);
	if (draw->has_target) {
		accel_buffer_unref(draw->target.colour);
		accel_buffer_unref(draw->target.depth);
	}
	draw->has_target = false;
}

/* Forgets it, and that it ever began. */
static void draw_frame_lose(struct accel_draw *draw)
{
	draw_frame_empty(draw);
	draw->stats = (struct accel_draw_stats){ 0 };
	draw->submitted = false;
}

void accel_draw_free(struct accel_draw *draw)
{
	if (!draw)
		return;
	draw_frame_empty(draw);
	accel_bin_free(&draw->bin);
	accel_stream_free(draw->stream);
	accel_device_unref(draw->device);
	free(draw->vertex);
	free(draw->cache);
	free(draw);
}

/* Before the first call of a frame does anything. */
static void draw_frame_begin(struct accel_draw *draw)
{
	if (draw->submitted)
		draw->stats = (struct accel_draw_stats){ 0 };
	draw->submitted = false;
}

static uint32_t draw_colour_word(const float rgba[4])
{
	uint32_t word = 0;

	for (int i = 0; i < 4; i++) {
		float value = rgba[i] < 0 ? 0 : rgba[i] > 1 ? 1 : rgba[i];

		word |= (uint32_t)(value * 255 + 0.5f) << 8 * i;
	}
	return word;
}

static bool draw_clear_valid(unsigned int mask, const float rgba[4], float depth)
{
	bool valid = mask && !(mask & ~(ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH));

	if (mask & ACCEL_CLEAR_COLOUR)
		valid = valid && rgba && isfinite(rgba[0]) && isfinite(rgba[1]) &&
			isfinite(rgba[2]) && isfinite(rgba[3]);
	if (mask & ACCEL_CLEAR_DEPTH)
		valid = valid && depth >= 0 && depth <= 1;
	return valid;
}

int accel_draw_clear(struct accel_draw *draw, unsigned int mask, const float rgba[4], float depth)
{
	struct accel_tile_clear clear = { .mask = mask };
	int err;

	if (!draw_clear_valid(mask, rgba, depth)) {
		accel_device_message(draw->device, "a clear of mask %u: a colour has four finite "
				     "numbers, a depth is 0 to 1", mask);
		return -EINVAL;
	}
	if (mask & ACCEL_CLEAR_COLOUR)
		clear.colour = draw_colour_word(rgba);
	if (mask & ACCEL_CLEAR_DEPTH)
		clear.depth = (uint32_t)((double)depth * ACCEL_DEPTH_MAX + 0.5);
	draw_frame_begin(draw);
	err = accel_bin_clear(&draw->bin, &clear);
	if (err)
		draw_frame_lose(draw);
	return err;
}

static int draw_set_target(struct accel_draw *draw, const struct accel_target *target)
{
	int err;

	if (draw->has_target && target->colour == draw->target.colour)
		return 0;
	if (draw->has_target || target->device != draw->device) {
		accel_device_message(draw->device, draw->has_target ?
				     "a frame drawn on two targets" :
				     "a target of another device");
		return -EINVAL;
	}
	err = accel_bin_begin(&draw->bin, target->width, target->height);
	if (err)
		return err;
	draw->target = *target;
	accel_buffer_ref(target->colour);
	accel_buffer_ref(target->depth);
	draw->has_target = true;
	return 0;
}

static int draw_reserve_vertices(struct accel_draw *draw, uint32_t count)
{
	struct accel_vertex *vertex;
	size_t size;

	if (count <= draw->vertices)
		return 0;
	if (__builtin_mul_overflow(count, sizeof(*vertex), &size))
		return -ENOMEM;
	vertex = realloc(draw->vertex, size);
	if (!vertex)
		return -ENOMEM;
	draw->vertex = vertex;
	draw->vertices = count;
	return 0;
}

static int draw_mesh_add(struct accel_draw *draw, struct accel_target *target,
			 const struct accel_state *state, const struct accel_mesh *mesh)
{
	struct accel_pass pass = {
		.device = draw->device,
		.state = state,
		.mesh = mesh,
		.lit = state->lighting,
		.painted = state->lighting && state->colour_material && mesh->colour.data,
		.interpolated = !state->lighting || state->shading == ACCEL_SHADING_GOURAUD,
		.bin = &draw->bin,
		.stats = &draw->stats,
	};
	int err = accel_mesh_begin(&pass);

	if (!err)
		err = draw_reserve_vertices(draw, mesh->vertices);
	if (err)
		return err;
	pass.vertex = draw->vertex;
	pass.cache = draw->cache;
	pass.number = ++draw->passes;
	accel_geometry_init(&pass.transform, state, target->width, target->height);
	accel_lighting_init(&pass.lighting, state, pass.painted);
	err = accel_mesh_transform(&pass);
	if (!err)
		err = draw_set_target(draw, target);
	if (err)
		return err;
	draw_frame_begin(draw);
	accel_bin_state(&draw->bin, state, &pass.transform.window.visible);
	return accel_mesh_draw(&pass);
}

int accel_draw_mesh(struct accel_draw *draw, struct accel_target *target,
		    const struct accel_state *state, const struct accel_mesh *mesh)
{
	struct accel_mesh known;
	int err = accel_sized_in(&known, sizeof(known), mesh);

	if (err) {
		accel_sized_message(draw->device, "mesh", "ACCEL_MESH", err);
		return err;
	}
	err = draw_mesh_add(draw, target, state, &known);
	if (err == -ENOMEM)
		draw_frame_lose(draw);
	return err;
}

void accel_draw_stats(const struct accel_draw *draw, struct accel_draw_stats *stats, size_t size)
{
	accel_sized_out(stats, size, &draw->stats, sizeof(draw->stats));
}

int accel_draw_submit(struct accel_draw *draw, struct accel_fence **out)
{
	struct accel_fence *fence;
	bool sent;
	int err;

	if (draw->bin.clear.mask && !draw->has_target) {
		accel_device_message(draw->device, "a frame that clears and has no target: draw a "
				     "mesh on it, which may have no triangles");
		return -EINVAL;
	}
	draw_frame_begin(draw);
	err = accel_frame_submit(&draw->bin, draw->stream, &draw->target, ACCEL_JOB_WORDS,
				 &draw->stats, &fence, &sent);
	if (err && !sent)
		return err;
	draw_frame_empty(draw);
	draw->submitted = true;
	if (err)
		return err;
	if (out) {
		*out = fence;
		return 0;
	}
	err = accel_fence_wait(fence, -1, NULL, 0);
	accel_fence_free(fence);
	return err;
}
