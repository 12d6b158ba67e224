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

/* Draws those of the elements that pass has, all of one figure. */
static int draw_figure(struct accel_draw *draw, struct accel_pass *pass)
{
	const struct accel_state *state = pass->state;
	int err = accel_arrays_begin(pass, &draw->slices.gather);

	if (err || (!pass->triangles && !pass->strict))
		return err;
	accel_geometry_init(&pass->transform, state, draw->target.width, draw->target.height);
	if (pass->capture.call)
		accel_geometry_view(&pass->transform.window, state);
	if (pass->lit)
		accel_lighting_init(&pass->lighting, state, pass->painted);
	accel_bin_state(&draw->bin, state, &pass->transform.window.visible);
	return accel_slices_draw(&draw->slices, pass);
}

/* Those and outlines have the light of their vertices, linear between, whatever the shading is. */
static int draw_strokes(struct accel_draw *draw, const struct accel_pass *given)
{
	struct accel_state state = *given->state;
	struct accel_pass pass = *given;

	if (state.shading != ACCEL_SHADING_FLAT)
		state.shading = ACCEL_SHADING_GOURAUD;
	pass.state = &state;
	pass.filled = given->state;
	pass.interpolated = true;
	pass.offset = false;
	return draw_figure(draw, &pass);
}

/* Is there a side that is seen and not filled? */
static bool draw_has_outlines(const struct accel_state *state)
{
	return (state->cull != ACCEL_CULL_FRONT && state->polygon_mode[0]) ||
	       (state->cull != ACCEL_CULL_BACK && state->polygon_mode[1]);
}

/* @strict: what is not finite is an error. After -ENOMEM the frame is lost. */
static int draw_add(struct accel_draw *draw, const struct accel_state *state,
		    const struct accel_arrays *arrays, const struct accel_elements *elements,
		    bool strict)
{
	struct accel_pass pass = {
		.device = draw->device,
		.state = state,
		.arrays = arrays,
		.elements = elements,
		.strict = strict,
		.capture = draw->capture,
		.lit = state->lighting,
		.painted = state->lighting && arrays->colour.data &&
			   (state->tracks[0] || state->tracks[1]),
		.bin = &draw->bin,
		.stats = &draw->stats,
	};
	const bool one_by_one = draw->capture.call || draw_has_outlines(state);
	struct accel_elements part = *elements;
	int err = accel_arrays_check(&pass);

	accel_pass_shade(&pass, state);

	for (uint32_t i = 0; i < elements->primitives && !err; i += part.primitives) {
		part.primitive = &elements->primitive[i];
		pass.elements = &part;
		pass.figure = accel_primitives_figure(part.primitive->topology);
		part.primitives = 1;
		while (i + part.primitives < elements->primitives &&
		       accel_primitives_figure(part.primitive[part.primitives].topology) ==
			       pass.figure)
			part.primitives++;
		if (pass.figure == ACCEL_FIGURE_FILLED && one_by_one)
			pass.figure = ACCEL_FIGURE_POLYGONS;
		err = pass.figure == ACCEL_FIGURE_FILLED ? draw_figure(draw, &pass) :
							   draw_strokes(draw, &pass);
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
