// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh_place.h"

#define EMPTY UINT32_MAX
/* So many vertices ahead the table is asked for, which is larger than any cache. */
#define AHEAD 16

static uint32_t hash(const float position[3])
{
	uint64_t sum = 0;

	for (int i = 0; i < 3; i++) {
		float value = position[i] + 0.0f; /* -0 to 0 */
		uint32_t bits;

		memcpy(&bits, &value, sizeof(bits));
		sum = (sum ^ bits) * 0x9e3779b97f4a7c15;
		sum ^= sum >> 29;
	}
	return (uint32_t)(sum >> 32);
}

static bool equal(const float a[3], const float b[3])
{
	return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* A table of @size slots, a power of two, at most three quarters of them used. */
static void fill(const struct mesh *mesh, uint32_t *table, size_t size, uint32_t *place)
{
	size_t ahead[AHEAD] = { 0 };

	for (size_t i = 0; i < (size_t)mesh->vertices + AHEAD; i++) {
		size_t slot = ahead[i % AHEAD];

		if (i < mesh->vertices) {
			ahead[i % AHEAD] = hash(mesh->position[i]) & (size - 1);
			__builtin_prefetch(&table[ahead[i % AHEAD]]);
		}
		if (i < AHEAD)
			continue;
		while (table[slot] != EMPTY &&
		       !equal(mesh->position[table[slot]], mesh->position[i - AHEAD]))
			slot = (slot + 1) & (size - 1);
		if (table[slot] == EMPTY)
			table[slot] = (uint32_t)(i - AHEAD);
		place[i - AHEAD] = table[slot];
	}
}

static int find_places(const struct mesh *mesh, uint32_t *place)
{
	size_t size = 16;
	uint32_t *table;

	while (size / 4 * 3 < mesh->vertices)
		size *= 2;
	table = malloc(size * sizeof(*table));
	if (!table)
		return -ENOMEM;
	memset(table, 0xff, size * sizeof(*table));
	fill(mesh, table, size, place);
	free(table);
	return 0;
}

/* Counting sort: how many, where they begin, and each to its place. */
static void sort_corners(const struct mesh *mesh, struct places *places)
{
	const uint32_t *index = mesh->triangle[0];
	uint32_t corners = mesh->triangles * 3, *first = places->first, begin = 0;

	for (uint32_t i = 0; i < corners; i++)
		first[places->place[index[i]]]++;
	places->most = 1;
	for (uint32_t i = 0; i < mesh->vertices; i++) {
		uint32_t count = first[i];

		places->most = count > places->most ? count : places->most;
		first[i] = begin;
		begin += count;
	}
	/* Moves each beginning to its end, which is the next one's beginning. */
	for (uint32_t i = 0; i < corners; i++)
		places->corner[first[places->place[index[i]]]++] = i;
	memmove(first + 1, first, mesh->vertices * sizeof(*first));
	first[0] = 0;
}

int places_new(const struct mesh *mesh, struct places *places)
{
	int ret = -ENOMEM;

	places->place = calloc(mesh->vertices, sizeof(*places->place));
	places->first = calloc((size_t)mesh->vertices + 1, sizeof(*places->first));
	places->corner = calloc(mesh->triangles, 3 * sizeof(*places->corner));
	if (places->place && places->first && places->corner)
		ret = find_places(mesh, places->place);
	if (!ret)
		sort_corners(mesh, places);
	return ret;
}

void places_free(struct places *places)
{
	free(places->place);
	free(places->first);
	free(places->corner);
	memset(places, 0, sizeof(*places));
}
