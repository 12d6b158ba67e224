/* SPDX-License-Identifier: MIT */
/* Vertex arrays as glVertexPointer and its like describe them. */
#ifndef GLOSS_ARRAY_H
#define GLOSS_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

#include "state/client.h"

struct gloss_context;

/* Bytes of a number of a type; 0: it is no type of arrays. */
size_t gloss_array_type_size(GLenum type);
/* Bytes from an element to the next. */
size_t gloss_array_stride(const struct gloss_client_array *array);
/* The first element, in memory or a buffer; NULL: there is none. @end, if not NULL: how many
 * elements there are, which is as many as you like in a program's memory. The caller holds buffer_lock,
 * and has the data as long as that. */
const void *gloss_array_data(const struct gloss_context *context,
			     const struct gloss_client_array *array, size_t *end);

#endif
