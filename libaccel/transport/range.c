// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "transport/range.h"

void accel_range_init(struct accel_range_space *space, uint64_t size)
{
	space->size = size;
	space->first = NULL;
}

void accel_range_fini(struct accel_range_space *space)
{
	while (space->first) {
		struct accel_range *range = space->first;

		space->first = range->next;
		free(range);
	}
}

/* Does not overflow: @size is at most that of the space. */
static uint64_t range_align(uint64_t size)
{
	return (size + ACCEL_RANGE_ALIGN - 1) / ACCEL_RANGE_ALIGN * ACCEL_RANGE_ALIGN;
}

/* The link to put a range of @size behind and its base, or NULL. */
static struct accel_range **range_gap(struct accel_range_space *space, uint64_t size,
				      uint64_t *base)
{
	struct accel_range **link;

	*base = 0;
	for (link = &space->first; *link; link = &(*link)->next) {
		if ((*link)->base - *base >= size)
			return link;
		*base = (*link)->base + range_align((*link)->size);
	}
	return *base <= space->size && space->size - *base >= size ? link : NULL;
}

int accel_range_new(struct accel_range_space *space, uint64_t size, uint64_t *base)
{
	struct accel_range **link, *range;

	if (size > space->size)
		return -ENOMEM;
	link = range_gap(space, size, base);
	if (!link)
		return -ENOMEM;
	range = malloc(sizeof(*range));
	if (!range)
		return -ENOMEM;
	*range = (struct accel_range){ .base = *base, .size = size, .next = *link };
	*link = range;
	return 0;
}

int accel_range_free(struct accel_range_space *space, uint64_t base)
{
	struct accel_range **link;

	for (link = &space->first; *link; link = &(*link)->next) {
		struct accel_range *range = *link;

		if (range->base != base)
			continue;
		*link = range->next;
		free(range);
		return 0;
	}
	return -EINVAL;
}

const struct accel_range *accel_range_find(const struct accel_range_space *space, uint64_t base)
{
	const struct accel_range *range;

	for (range = space->first; range; range = range->next)
		if (range->base == base)
			return range;
	return NULL;
}
