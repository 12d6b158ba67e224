// SPDX-License-Identifier: MIT
/* The draw calls of accel_draw.h: what they take, and when a frame begins and ends. */
#include <errno.h>
#include <stdlib.h>

#include "draw/content.h"
#include "draw/draw.h"

int accel_draw_new(struct accel_device *device, struct accel_draw **out)
{
	struct accel_draw *draw = calloc(1, sizeof(*draw));
	int err;

	if (!draw)
		return -ENOMEM;
	err = accel_slices_init(&draw->slices, device->threads, (int)device->info.tile_size);
	if (err)
		goto err_free;
	err = accel_stream_new(device, &draw->stream);
	if (err)
		goto err_free_slices;
	draw->device = accel_device_ref(device);
	accel_bin_init(&draw->bin, (int)device->info.tile_size);
	*out = draw;
	return 0;

err_free_slices:
	accel_slices_fini(&draw->slices, false);
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
		accel_content_unref(draw->target.content);
	}
	draw->has_target = false;
}

void accel_draw_lose(struct accel_draw *draw)
{
	draw_frame_empty(draw);
	draw->stats = (struct accel_draw_stats){ 0 };
}

void accel_draw_free(struct accel_draw *draw)
{
	if (!draw)
		return;
	draw_frame_empty(draw);
	accel_bin_free(&draw->bin);
	accel_slices_fini(&draw->slices, accel_device_is_inherited(draw->device));
	accel_stream_free(draw->stream);
	accel_device_unref(draw->device);
	free(draw);
}

int accel_draw_check_begun(const struct accel_draw *draw, const char *what)
{
	if (draw->has_target)
		return 0;
	accel_device_message(draw->device, "%s without a frame: call accel_draw_begin first", what);
	return -EINVAL;
}

int accel_draw_begin(struct accel_draw *draw, struct accel_target *target,
		     const struct accel_clear *given)
{
	struct accel_tile_clear clear;
	int err = accel_draw_clear_take(draw, given, &clear);

	if (err)
		return err;
	if (target->device != draw->device) {
		accel_device_message(draw->device, "a frame on a target of another device");
		return -EINVAL;
	}
	/* The reference to the target first, as the frame before may have the only one. */
	accel_buffer_ref(target->colour);
	accel_buffer_ref(target->depth);
	accel_content_ref(target->content);
	accel_draw_lose(draw);
	draw->target = *target;
	draw->has_target = true;
	draw->capture.call = NULL;
	err = accel_bin_begin(&draw->bin, target->width, target->height);
	if (err) {
		accel_draw_lose(draw);
		return err;
	}
	return accel_draw_clear_all(draw, &clear);
}

int accel_draw_discard(struct accel_draw *draw, unsigned int planes)
{
	int err = accel_draw_check_begun(draw, "a discard");

	if (err)
		return err;
	if (!planes || planes & ~(ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH)) {
		accel_device_message(draw->device,
				     "a discard of the planes %#x, which has to be "
				     "some of ACCEL_CLEAR_*",
				     planes);
		return -EINVAL;
	}
	draw->bin.discard |= planes;
	return 0;
}

/* The transform of the state that the pass is drawn by, unless it is that already. */
static void draw_derive_transform(struct accel_draw *draw)
{
	struct accel_pass *pass = &draw->pass;
	struct accel_derived *derived = &draw->derived;
	const int width = draw->target.width, height = draw->target.height;

	if (derived->geometry == pass->state->geometry_stamp && derived->width == width &&
	    derived->height == height && !pass->capture.call)
		return;
	accel_geometry_init(&pass->transform, pass->state, width, height);
	derived->geometry = pass->state->geometry_stamp;
	derived->width = width;
	derived->height = height;
	if (!pass->capture.call)
		return;
	accel_geometry_view(&pass->transform.window, pass->state);
	derived->geometry = 0;
}

/* The same of its light. */
static void draw_derive_light(struct accel_draw *draw)
{
	struct accel_pass *pass = &draw->pass;
	struct accel_derived *derived = &draw->derived;

	if (derived->light == pass->state->light_stamp && derived->painted == pass->painted)
		return;
	accel_lighting_init(&pass->lighting, pass->state, pass->painted);
	derived->light = pass->state->light_stamp;
	derived->painted = pass->painted;
}

/* Draws those of the elements that pass has, all of one figure. */
static int draw_figure(struct accel_draw *draw)
{
	struct accel_pass *pass = &draw->pass;
	int err = accel_arrays_begin(pass, &draw->slices.gather);

	if (err || (!pass->triangles && !pass->strict))
		return err;
	draw_derive_transform(draw);
	if (pass->lit)
		draw_derive_light(draw);
	accel_bin_state(&draw->bin, pass->state, &pass->transform.window.visible);
	return accel_slices_draw(&draw->slices, pass);
}

/* Points, lines and outlines have the light of their vertices, linear between, whatever the shading. */
static int draw_strokes(struct accel_draw *draw, const struct accel_state *given)
{
	struct accel_state state = *given;
	struct accel_pass *pass = &draw->pass;

	if (state.shading != ACCEL_SHADING_FLAT)
		state.shading = ACCEL_SHADING_GOURAUD;
	pass->state = &state;
	pass->filled = given;
	pass->interpolated = true;
	pass->offset = false;
	return draw_figure(draw);
}

/* Is there a side that is seen and not filled? */
static bool draw_has_outlines(const struct accel_state *state)
{
	return (state->cull != ACCEL_CULL_FRONT && state->polygon_mode[0]) ||
	       (state->cull != ACCEL_CULL_BACK && state->polygon_mode[1]);
}

/* What a pass is, but for its figure and what is derived of its state. */
static void draw_pass_init(struct accel_draw *draw, const struct accel_state *state,
			   const struct accel_arrays *arrays, const struct accel_elements *elements,
			   bool strict)
{
	struct accel_pass *pass = &draw->pass;

	pass->device = draw->device;
	pass->state = state;
	pass->arrays = arrays;
	pass->elements = elements;
	pass->strict = strict;
	pass->capture = draw->capture;
	pass->lit = state->lighting;
	pass->painted = state->lighting && arrays->colour.data &&
			(state->tracks[0] || state->tracks[1]);
	pass->bin = &draw->bin;
	pass->stats = &draw->stats;
}

/* Draws of @most primitives from that of @part on those of the first one's figure: @part is these. */
static int draw_part(struct accel_draw *draw, const struct accel_state *state,
		     struct accel_elements *part, uint32_t most, bool one_by_one)
{
	struct accel_pass *pass = &draw->pass;

	pass->elements = part;
	pass->figure = accel_primitives_figure(part->primitive->topology);
	part->primitives = 1;
	while (part->primitives < most &&
	       accel_primitives_figure(part->primitive[part->primitives].topology) == pass->figure)
		part->primitives++;
	if (pass->figure == ACCEL_FIGURE_FILLED && one_by_one)
		pass->figure = ACCEL_FIGURE_POLYGONS;
	if (pass->figure != ACCEL_FIGURE_FILLED)
		return draw_strokes(draw, state);
	accel_pass_shade(pass, state);
	return draw_figure(draw);
}

/* @strict: what is not finite is an error. After -ENOMEM the frame is lost. */
static int draw_add(struct accel_draw *draw, const struct accel_state *state,
		    const struct accel_arrays *arrays, const struct accel_elements *elements,
		    bool strict)
{
	const bool one_by_one = draw->capture.call || draw_has_outlines(state);
	struct accel_elements part = *elements;
	int err;

	draw_pass_init(draw, state, arrays, elements, strict);
	err = accel_arrays_check(&draw->pass);
	for (uint32_t i = 0; i < elements->primitives && !err; i += part.primitives) {
		part.primitive = &elements->primitive[i];
		err = draw_part(draw, state, &part, elements->primitives - i, one_by_one);
	}
	if (err == -ENOMEM)
		accel_draw_lose(draw);
	return err;
}

/* All at once, and one by one only if one of them is bad. */
static int draw_check_index(const struct accel_draw *draw, const struct accel_mesh *mesh)
{
	uint32_t bad = 0, i = 0;

	for (uint32_t n = 0; n < mesh->indices; n++)
		bad |= mesh->index[n] >= mesh->vertices;
	if (!bad)
		return 0;
	while (mesh->index[i] < mesh->vertices)
		i++;
	accel_device_message(draw->device, "index %u is of vertex %u, and the mesh has %u", i,
			     mesh->index[i], mesh->vertices);
	return -EINVAL;
}

int accel_draw_mesh(struct accel_draw *draw, const struct accel_state *state,
		    const struct accel_mesh *given)
{
	int err = accel_draw_check_begun(draw, "a mesh");
	struct accel_primitive primitive;
	struct accel_elements elements;
	struct accel_arrays arrays;
	struct accel_mesh mesh;

	if (err)
		return err;
	err = accel_sized_in(&mesh, sizeof(mesh), given);
	if (err) {
		accel_sized_message(draw->device, "mesh", "ACCEL_MESH", err);
		return err;
	}
	if (mesh.index)
		err = draw_check_index(draw, &mesh);
	if (err)
		return err;
	if (!mesh.position.components)
		mesh.position.components = 3;
	primitive = (struct accel_primitive){ mesh.topology, 0,
					      mesh.index ? mesh.indices : mesh.vertices };
	elements = (struct accel_elements)ACCEL_ELEMENTS(.primitive = &primitive, .primitives = 1,
							 .index = mesh.index,
							 .index_type = ACCEL_TYPE_UINT);
	arrays = (struct accel_arrays)ACCEL_ARRAYS(.vertices = mesh.vertices,
						   .reserved = mesh.reserved,
						   .position = mesh.position, .normal = mesh.normal,
						   .colour = mesh.colour);
	return draw_add(draw, state, &arrays, &elements, true);
}

int accel_draw_arrays(struct accel_draw *draw, const struct accel_state *state,
		      const struct accel_arrays *given_arrays,
		      const struct accel_elements *given_elements)
{
	int err = accel_draw_check_begun(draw, "arrays");
	struct accel_elements elements;
	struct accel_arrays arrays;

	if (err)
		return err;
	err = accel_sized_in(&arrays, sizeof(arrays), given_arrays);
	if (err) {
		accel_sized_message(draw->device, "set of arrays", "ACCEL_ARRAYS", err);
		return err;
	}
	err = accel_sized_in(&elements, sizeof(elements), given_elements);
	if (err) {
		accel_sized_message(draw->device, "list of elements", "ACCEL_ELEMENTS", err);
		return err;
	}
	return draw_add(draw, state, &arrays, &elements, false);
}

void accel_draw_stats(const struct accel_draw *draw, struct accel_draw_stats *stats, size_t size)
{
	accel_sized_out(stats, size, &draw->stats, sizeof(draw->stats));
}

/* *@fence is that of the frame. */
static int draw_send(struct accel_draw *draw, struct accel_fence **fence)
{
	bool sent;
	int err = accel_draw_check_begun(draw, "a submit");

	if (err)
		return err;
	err = accel_frame_submit(&draw->bin, draw->stream, &draw->target, ACCEL_JOB_WORDS,
				 &draw->stats, fence, &sent);
	if (!err || sent)
		draw_frame_empty(draw);
	return err;
}

int accel_draw_submit(struct accel_draw *draw, struct accel_fence **out)
{
	struct accel_fence *fence;
	int err = draw_send(draw, &fence);

	if (!err)
		accel_fence_give(fence, out);
	return err;
}

int accel_draw_finish(struct accel_draw *draw)
{
	struct accel_fence *fence;
	int err = draw_send(draw, &fence);

	return err ? err : accel_fence_finish(fence);
}
