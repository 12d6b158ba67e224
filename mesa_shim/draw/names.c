// SPDX-License-Identifier: MIT
#include "draw/names.h"

#include <stdlib.h>

#define NAMES_FIRST 64u

/* The place of @name, or the empty one where it would be; there is always an empty one. */
static struct gloss_name *names_place(const struct gloss_names *names, uint32_t name)
{
	uint32_t at = name * 0x9e3779b1u;

	for (;; at++) {
		struct gloss_name *place = &names->place[at & (names->places - 1)];

		if (!place->name || place->name == name)
			return place;
	}
}

void *gloss_names_find(const struct gloss_names *names, uint32_t name)
{
	return name && names->places ? names_place(names, name)->object : NULL;
}

/* Room for one name more, at most half of the places taken; deleted ones are dropped. */
static bool names_grow(struct gloss_names *names)
{
	struct gloss_names grown = { .used = names->live,
				     .live = names->live,
				     .greatest = names->greatest };

	if (2 * (names->used + 1) <= names->places)
		return true;
	if (names->live > UINT32_MAX / 8)
		return false;
	/* At most a third are taken then, so that it is long to the next time. */
	for (grown.places = NAMES_FIRST; grown.places < 3 * (names->live + 1);)
		grown.places *= 2;
	grown.place = calloc(grown.places, sizeof(*grown.place));
	if (!grown.place)
		return false;
	for (uint32_t i = 0; i < names->places; i++)
		if (names->place[i].object)
			*names_place(&grown, names->place[i].name) = names->place[i];
	free(names->place);
	*names = grown;
	return true;
}

bool gloss_names_set(struct gloss_names *names, uint32_t name, void *object)
{
	const bool had = gloss_names_find(names, name);
	struct gloss_name *place;

	if (!name || (!object && !had))
		return true;
	if (!had && !names_grow(names))
		return false;
	place = names_place(names, name);
	names->used += !place->name;
	names->live += (uint32_t)(object != NULL) - (uint32_t)had;
	*place = (struct gloss_name){ name, object };
	if (name > names->greatest)
		names->greatest = name;
	return true;
}

/* Whether none of @count names from @first on is taken. */
static bool names_are_free(const struct gloss_names *names, uint32_t first, uint32_t count)
{
	for (uint32_t i = 0; i < count; i++)
		if (gloss_names_find(names, first + i))
			return false;
	return true;
}

uint32_t gloss_names_free_range(const struct gloss_names *names, uint32_t count)
{
	if (names->greatest <= UINT32_MAX - count)
		return names->greatest + 1;
	/* Somebody has taken a great one. */
	for (uint32_t first = 1; first <= UINT32_MAX - count && first < 1u << 24; first++)
		if (names_are_free(names, first, count))
			return first;
	return 0;
}
