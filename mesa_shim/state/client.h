/* SPDX-License-Identifier: MIT */
/* The state that glPushClientAttrib saves: how pixels lie in memory, and vertex arrays. */
#ifndef GLOSS_CLIENT_H
#define GLOSS_CLIENT_H

#include "state/attributes.h"

struct gloss_pixel_store {
	GLint row_length, skip_rows, skip_pixels, alignment, image_height, skip_images;
	GLboolean swap_bytes, lsb_first;
};

struct gloss_client_array {
	const void *pointer; /* or the offset in the buffer of the name @buffer */
	GLint size, stride, buffer;
	GLenum type;
	GLboolean enabled;
};

struct gloss_arrays {
	struct gloss_client_array position, normal, colour, index, edge, secondary, fog;
	struct gloss_client_array texcoord[GLOSS_UNITS];
	GLint active; /* texture unit of glTexCoordPointer */
	GLint array_buffer, element_buffer;
	GLint lock_first, lock_count;
};

struct gloss_client {
	struct gloss_pixel_store pack, unpack;
	struct gloss_arrays arrays;
};

void gloss_client_init(struct gloss_client *client);

#endif
