// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh_weld.h"

#define NONE UINT32_MAX

static uint64_t mix(uint64_t sum, const float *value, int count)
{
	for (int i = 0; i < count; i++) {
		uint32_t bits;

		memcpy(&bits, &value[i], sizeof(bits));
		sum = (sum ^ bits) * 0x9e3779b97f4a7c15;
		sum ^= sum >> 29;
	}
	return sum;
}

static uint32_t hash(const struct mesh *mesh, const struct weld_vertex *vertex)
{
	uint64_t sum = mix(0, vertex->position, 3);

	if (mesh->normal)
		sum = mix(sum, vertex->normal, 3);
	if (mesh->colour)
		sum = mix(sum, vertex->colour, 4);
	return (uint32_t)(sum >> 32);
}

static bool same_bits(const void *a, const void *b, size_t size)
{
	return !memcmp(a, b, size);
}

static bool is_vertex(const struct mesh *mesh, uint32_t number, const struct weld_vertex *vertex)
{
	return same_bits(mesh->position[number], vertex->position, sizeof(vertex->position)) &&
	       (!mesh->normal ||
		same_bits(mesh->normal[number], vertex->normal, sizeof(vertex->normal))) &&
	       (!mesh->colour ||
		same_bits(mesh->colour[number], vertex->colour, sizeof(vertex->colour)));
}

static uint32_t append(struct mesh *mesh, const struct weld_vertex *vertex)
{
	uint32_t number = mesh->vertices++;

	memcpy(mesh->position[number], vertex->position, sizeof(vertex->position));
	if (mesh->normal)
		memcpy(mesh->normal[number], vertex->normal, sizeof(vertex->normal));
	if (mesh->colour)
		memcpy(mesh->colour[number], vertex->colour, sizeof(vertex->colour));
	return number;
}

/* Where the vertex is, or is to be. */
static struct weld_slot *find(const struct weld *weld, uint32_t hash,
			      const struct weld_vertex *vertex)
{
	for (size_t i = hash;; i++) {
		struct weld_slot *slot = &weld->slot[i & (weld->slots - 1)];

		if (slot->number == NONE ||
		    (slot->hash == hash && is_vertex(weld->mesh, slot->number, vertex)))
			return slot;
	}
}

static int set_slots(struct weld *weld, size_t slots)
{
	struct weld_slot *slot = malloc(slots * sizeof(*slot));

	if (!slot)
		return -ENOMEM;
	memset(slot, 0xff, slots * sizeof(*slot));
	for (size_t i = 0; i < weld->slots; i++) {
		size_t to = weld->slot[i].hash;

		if (weld->slot[i].number == NONE)
			continue;
		while (slot[to & (slots - 1)].number != NONE)
			to++;
		slot[to & (slots - 1)] = weld->slot[i];
	}
	free(weld->slot);
	weld->slot = slot;
	weld->slots = slots;
	return 0;
}

/* Enough, if each comes six times as in a closed mesh; it grows if not. */
int weld_begin(struct weld *weld, struct mesh *mesh, uint64_t vertices)
{
	size_t slots = 4 * WELD_BLOCK;

	while (slots < vertices / 4)
		slots *= 2;
	*weld = (struct weld){ .mesh = mesh };
	return set_slots(weld, slots);
}

int weld_add(struct weld *weld, const struct weld_vertex *vertex, uint32_t count, uint32_t *number)
{
	uint32_t hashes[WELD_BLOCK];

	/* At most three quarters are used. */
	if (weld->mesh->vertices + (size_t)count > weld->slots / 4 * 3 &&
	    set_slots(weld, weld->slots * 2))
		return -ENOMEM;
	for (uint32_t i = 0; i < count; i++) {
		hashes[i] = hash(weld->mesh, &vertex[i]);
		__builtin_prefetch(&weld->slot[hashes[i] & (weld->slots - 1)]);
	}
	for (uint32_t i = 0; i < count; i++) {
		struct weld_slot *slot = find(weld, hashes[i], &vertex[i]);

		if (slot->number == NONE)
			*slot = (struct weld_slot){ hashes[i], append(weld->mesh, &vertex[i]) };
		number[i] = slot->number;
	}
	return 0;
}

void weld_end(struct weld *weld)
{
	free(weld->slot);
}
