/* SPDX-License-Identifier: MIT */
/* Buffer objects: memory of the library that contexts share. */
#ifndef GLOSS_BUFFER_H
#define GLOSS_BUFFER_H

#include <stddef.h>
#include <stdint.h>

struct gloss_context;

struct gloss_buffer {
	uint8_t *data;
	size_t size;
	unsigned int usage, access; /* access: of the mapping, 0 without one */
};

/* NULL: there is none of this name. The caller holds buffer_lock, and has the buffer as long as that. */
struct gloss_buffer *gloss_buffer_find(const struct gloss_context *context, int name);
void gloss_buffer_free(struct gloss_buffer *buffer);

#endif
