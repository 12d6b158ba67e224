/* SPDX-License-Identifier: MIT */
/*
 * Hands out ranges of an address space; it knows nothing of what is there. A
 * range is named by its base. Not locked: the caller sees to that.
 */
#ifndef ACCEL_RANGE_H
#define ACCEL_RANGE_H

#include <stdint.h>

#define ACCEL_RANGE_ALIGN 4096u

struct accel_range {
	uint64_t base;            /* multiple of ACCEL_RANGE_ALIGN */
	uint64_t size;            /* as asked for */
	struct accel_range *next; /* the one with the next higher base */
};

struct accel_range_space {
	uint64_t size;
	struct accel_range *first;
};

void accel_range_init(struct accel_range_space *space, uint64_t size);
void accel_range_fini(struct accel_range_space *space);

/* Takes the lowest gap that @size (not 0) fits in. -ENOMEM: there is none. */
int accel_range_new(struct accel_range_space *space, uint64_t size, uint64_t *base);
/* -EINVAL: no range starts at @base. */
int accel_range_free(struct accel_range_space *space, uint64_t base);
/* The range that starts at @base, or NULL. */
const struct accel_range *accel_range_find(const struct accel_range_space *space, uint64_t base);

#endif
