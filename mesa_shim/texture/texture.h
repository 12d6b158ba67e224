/* SPDX-License-Identifier: MIT */
/*
 * Texture objects: images, converted, and how they are sampled. Contexts share them by name; each
 * context has default ones, named 0, and proxies of its own.
 */
#ifndef GLOSS_TEXTURE_H
#define GLOSS_TEXTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "state/attributes.h"

#define GLOSS_TEXTURE_SIZE 2048 /* of 1D and 2D */
#define GLOSS_TEXTURE_3D_SIZE 128
#define GLOSS_TEXTURE_CUBE_SIZE 1024
#define GLOSS_TEXTURE_LEVELS 12 /* of the greatest */
#define GLOSS_TEXTURE_FACES 6

struct gloss_context;
struct gloss_shared;

/* What an image is made of, for a name of glTexImage*. */
struct gloss_texture_format {
	GLenum internal;
	GLenum base; /* one of table 3.15 */
};

/* NULL: there is none of this name. */
const struct gloss_texture_format *gloss_texture_format_find(GLint internal);
/* Bits of a component by its name, as GL_TEXTURE_RED_SIZE; 0 also for what is no such name. */
GLint gloss_texture_format_bits(const struct gloss_texture_format *format, GLenum pname);
/* From RGBA, or from a depth in the first number, to what a texel is kept as, and back to what
 * glGetTexImage returns. */
uint32_t gloss_texture_format_pack(const struct gloss_texture_format *format, const float rgba[4]);
uint32_t gloss_texture_format_pack_bytes(const struct gloss_texture_format *format,
					 const uint8_t rgba[4]);
void gloss_texture_format_unpack(const struct gloss_texture_format *format, uint32_t texel,
				 float rgba[4]);

struct gloss_texture_image {
	GLsizei width, height, depth; /* with the border */
	GLint border;
	const struct gloss_texture_format *format; /* NULL: there is no image */
	uint32_t *texel;                           /* NULL: of a proxy */
};

struct gloss_texture {
	unsigned int references; /* guarded by the lock of the names, as @kind */
	GLuint name;
	int kind; /* enum gloss_texture_kind; -1: it was never bound */
	struct gloss_sampler sampler;
	struct gloss_texture_image image[GLOSS_TEXTURE_FACES][GLOSS_TEXTURE_LEVELS];
};

/* Of a context. Names in struct gloss_unit are those of @bound. */
struct gloss_textures {
	struct gloss_texture *bound[GLOSS_UNITS][GLOSS_TEXTURE_KINDS];
	struct gloss_texture *initial[GLOSS_TEXTURE_KINDS];
	struct gloss_texture *proxy[GLOSS_TEXTURE_KINDS];
};

/* False: out of memory. */
bool gloss_textures_init(struct gloss_context *context);
void gloss_textures_fini(struct gloss_context *context);
/* Binds what the attributes name, after these were restored. */
void gloss_textures_rebind(struct gloss_context *context);

void gloss_texture_free(struct gloss_texture *texture);

/* The texture that a command on a target is about. */
struct gloss_texture_place {
	struct gloss_texture *texture;
	int face;
	bool proxy;
};

/* The kind of a target that textures are bound to; -1: it is none. */
int gloss_texture_kind(GLenum target);
/* @dimensions of the image, 0: any. False: it is no such target, and nothing else happened. */
bool gloss_texture_find(struct gloss_context *context, GLenum target, int dimensions,
			struct gloss_texture_place *place);
/* Levels that textures of a kind may have, and their greatest size. */
int gloss_texture_levels(int kind);

/* Between these two no other thread changes or reads the images of what contexts share. */
void gloss_texture_lock(struct gloss_context *context);
void gloss_texture_unlock(struct gloss_context *context);

/* ---- image.c ---- */

/* An image without texels; its memory is given back. */
void gloss_texture_image_clear(struct gloss_texture_image *image);
/* Its size and format; texels are 0. False: out of memory, and it is cleared. */
bool gloss_texture_image_set(struct gloss_texture_image *image,
			     const struct gloss_texture_image *like);
/* Texel @x of row @y of slice @z, border counted. */
uint32_t *gloss_texture_image_at(const struct gloss_texture_image *image, GLsizei x, GLsizei y,
				 GLsizei z);
/* Texels in a row from there on, of pixels after transfer. */
void gloss_texture_image_put(const struct gloss_texture_image *image, GLsizei x, GLsizei y,
			     GLsizei z, const float (*pixel)[4], GLsizei count);
/* After the image of @level was given: the smaller ones, if they are to be made of it. */
void gloss_texture_generate(struct gloss_texture *texture, int face, GLint level);
/* The region of a command that replaces a part of an image: from the first texel that is none of
 * its border. False: it is not within the image. */
bool gloss_texture_image_has(const struct gloss_texture_image *image, const GLint at[3],
			     const GLsizei size[3]);

#endif
