/* SPDX-License-Identifier: MIT */
/* Objects by names, which are any numbers but 0. */
#ifndef GLOSS_NAMES_H
#define GLOSS_NAMES_H

#include <stdbool.h>
#include <stdint.h>

struct gloss_name {
	uint32_t name; /* 0: nothing has this place */
	void *object;  /* NULL: it was deleted */
};

struct gloss_names {
	struct gloss_name *place;
	uint32_t places, used; /* a power of two; those with a name, deleted or not */
	uint32_t live;         /* names with an object */
	uint32_t greatest;
};

void *gloss_names_find(const struct gloss_names *names, uint32_t name);
/* @object NULL: it has none any more, which never fails. False: out of memory, and nothing changed. */
bool gloss_names_set(struct gloss_names *names, uint32_t name, void *object);
/* The first of @count names in a row that nothing has; 0: there are none. */
uint32_t gloss_names_free_range(const struct gloss_names *names, uint32_t count);

#endif
