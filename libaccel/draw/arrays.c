// SPDX-License-Identifier: MIT
/* What a draw call is given: whether it can be drawn, and which vertices of its arrays it needs. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "draw/draw_priv.h"

/*
 * Vertices between the lowest and the highest that are needed are all transformed, unless they are
 * more than these: then each element is.
 */
#define SPARSE_LEAST 1024u
#define SPARSE_FACTOR 4u

uint32_t accel_arrays_element(const struct accel_elements *elements, uint64_t i)
{
	const uint8_t *index = elements->index;
	uint16_t two;
	uint32_t four;

	if (!index)
		return i < UINT32_MAX ? (uint32_t)i : UINT32_MAX;
	switch (elements->index_type) {
	case ACCEL_TYPE_UBYTE:
		return index[i];
	case ACCEL_TYPE_USHORT:
		memcpy(&two, index + i * sizeof(two), sizeof(two));
		return two;
	default:
		memcpy(&four, index + i * sizeof(four), sizeof(four));
		return four;
	}
}

static int arrays_check_members(const struct accel_pass *pass)
{
	const struct accel_arrays *arrays = pass->arrays;

	if (arrays->position.data && !arrays->reserved)
		return 0;
	accel_device_message(pass->device, "a mesh %s",
			     arrays->reserved ? "whose reserved member is set" :
						"without positions");
	return -EINVAL;
}

static int arrays_check_elements(const struct accel_pass *pass)
{
	const struct accel_elements *elements = pass->elements;
	const enum accel_type type = elements->index_type;

	if (elements->index && type != ACCEL_TYPE_UBYTE && type != ACCEL_TYPE_USHORT &&
	    type != ACCEL_TYPE_UINT) {
		accel_device_message(pass->device,
				     "indices of type %u, which may be ACCEL_TYPE_UBYTE, "
				     "_USHORT or _UINT",
				     type);
		return -EINVAL;
	}
	for (uint32_t i = 0; i < elements->primitives; i++) {
		const enum accel_topology topology = elements->primitive[i].topology;

		if ((unsigned int)topology <= ACCEL_TOPOLOGY_POLYGON)
			continue;
		accel_device_message(pass->device,
				     "primitive %u is of topology %u, which is none of "
				     "ACCEL_TOPOLOGY_*",
				     i, topology);
		return -EINVAL;
	}
	return 0;
}

static int arrays_fetch(struct accel_pass *pass)
{
	const struct accel_arrays *arrays = pass->arrays;
	int err = accel_fetch_init(&pass->position, pass->device, ACCEL_ATTRIBUTE_POSITION,
				   &arrays->position);

	if (!err)
		err = accel_fetch_init(&pass->normal, pass->device, ACCEL_ATTRIBUTE_NORMAL,
				       &arrays->normal);
	if (!err)
		err = accel_fetch_init(&pass->colour, pass->device, ACCEL_ATTRIBUTE_COLOUR,
				       &arrays->colour);
	if (!err)
		err = accel_fetch_init(&pass->edge, pass->device, ACCEL_ATTRIBUTE_EDGE,
				       &arrays->edge);
	return err;
}

/* The vertices from @low to before @high are needed; none: @low is not less. */
struct range {
	uint64_t low, high;
};

static void arrays_range_indices(struct range *range, const struct accel_pass *pass,
				 const struct accel_primitive *primitive)
{
	const uint32_t vertices = pass->arrays->vertices;
	uint32_t low = UINT32_MAX, high = 0;

	for (uint32_t i = 0; i < primitive->count; i++) {
		uint32_t number = accel_arrays_element(pass->elements,
						       (uint64_t)primitive->first + i);

		if (number >= vertices)
			continue;
		low = number < low ? number : low;
		high = number > high ? number : high;
	}
	if (low > high)
		return;
	range->low = low < range->low ? low : range->low;
	range->high = high >= range->high ? (uint64_t)high + 1 : range->high;
}

static void arrays_range(struct range *range, const struct accel_pass *pass,
			 const struct accel_primitive *primitive)
{
	const uint64_t low = primitive->first;
	const uint64_t high = low + accel_primitives_elements(pass, primitive);

	if (pass->elements->index) {
		arrays_range_indices(range, pass, primitive);
		return;
	}
	if (low >= high)
		return;
	range->low = low < range->low ? low : range->low;
	range->high = high > range->high ? high : range->high;
}

static int arrays_gather(struct accel_pass *pass, struct accel_gather *gather, uint32_t elements)
{
	const struct accel_elements *of = pass->elements;
	uint32_t *to;

	if (elements > gather->room) {
		to = realloc(gather->number, elements * sizeof(*to));
		if (!to)
			return -ENOMEM;
		gather->number = to;
		gather->room = elements;
	}
	to = gather->number;
	for (uint32_t n = 0; n < of->primitives; n++) {
		const struct accel_primitive *primitive = &of->primitive[n];
		const uint32_t count = accel_primitives_elements(pass, primitive);

		for (uint32_t i = 0; i < count; i++)
			*to++ = accel_arrays_element(of, (uint64_t)primitive->first + i);
	}
	pass->gather = gather->number;
	pass->vertices = elements;
	return 0;
}

/* Which vertices are needed. */
static int arrays_need(struct accel_pass *pass, struct accel_gather *gather)
{
	const struct accel_elements *elements = pass->elements;
	struct range range = { UINT32_MAX, 0 };
	uint64_t count = 0;

	for (uint32_t i = 0; i < elements->primitives; i++) {
		const struct accel_primitive *primitive = &elements->primitive[i];

		count += accel_primitives_elements(pass, primitive);
		pass->triangles += accel_primitives_triangles(pass, primitive);
		arrays_range(&range, pass, primitive);
	}
	if (range.low >= range.high) {
		pass->triangles = 0;
		return 0;
	}
	pass->base = (uint32_t)range.low;
	pass->vertices = (uint32_t)(range.high - range.low);
	if (pass->vertices < SPARSE_LEAST || pass->vertices / SPARSE_FACTOR < count)
		return 0;
	return arrays_gather(pass, gather, (uint32_t)count);
}

int accel_arrays_check(struct accel_pass *pass)
{
	int err = arrays_check_members(pass);

	if (!err)
		err = arrays_check_elements(pass);
	return err ? err : arrays_fetch(pass);
}

int accel_arrays_begin(struct accel_pass *pass, struct accel_gather *gather)
{
	pass->base = 0;
	pass->gather = NULL;
	pass->triangles = 0;
	if (!pass->strict)
		return arrays_need(pass, gather);
	pass->vertices = pass->arrays->vertices;
	pass->triangles = accel_primitives_triangles(pass, pass->elements->primitive);
	return 0;
}
