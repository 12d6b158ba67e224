// SPDX-License-Identifier: MIT
/* Images of textures, as they are kept. */
#include <stdlib.h>
#include <string.h>

#include "texture/texture.h"

void gloss_texture_image_clear(struct gloss_texture_image *image)
{
	free(image->texel);
	*image = (struct gloss_texture_image){ 0 };
}

bool gloss_texture_image_set(struct gloss_texture_image *image,
			     const struct gloss_texture_image *like)
{
	/* At most 2050 times 2050, or 130 to the third. */
	const size_t texels = (size_t)like->width * (size_t)like->height * (size_t)like->depth;
	uint32_t *texel = calloc(texels + 1, sizeof(*texel));

	gloss_texture_image_clear(image);
	if (!texel)
		return false;
	*image = *like;
	image->texel = texel;
	return true;
}

uint32_t *gloss_texture_image_at(const struct gloss_texture_image *image, GLsizei x, GLsizei y,
				 GLsizei z)
{
	return image->texel +
	       ((size_t)z * (size_t)image->height + (size_t)y) * (size_t)image->width + x;
}

void gloss_texture_image_put(const struct gloss_texture_image *image, GLsizei x, GLsizei y,
			     GLsizei z, const float (*pixel)[4], GLsizei count)
{
	uint32_t *to = gloss_texture_image_at(image, x, y, z);

	for (GLsizei i = 0; i < count; i++)
		to[i] = gloss_texture_format_pack(image->format, pixel[i]);
}

static bool image_has(GLint at, GLsizei size, GLint border, GLsizei whole)
{
	return at >= -border && size <= whole - border && at <= whole - border - size;
}

bool gloss_texture_image_has(const struct gloss_texture_image *image, const GLint at[3],
			     const GLsizei size[3])
{
	const GLint border = image->border;

	/* Of an image with fewer dimensions the others have no border. */
	return image_has(at[0], size[0], border, image->width) &&
	       image_has(at[1], size[1], image->height > 1 ? border : 0, image->height) &&
	       image_has(at[2], size[2], image->depth > 1 ? border : 0, image->depth);
}

/* ---- smaller images ---- */

/* The mean of those texels of @image, up to eight, that become one. */
static uint32_t image_mean(const struct gloss_texture_image *image, GLsizei x, GLsizei y, GLsizei z)
{
	const bool depth = image->format->base == GL_DEPTH_COMPONENT;
	uint64_t sum[4] = { 0 }, count = 0;
	uint32_t mean = 0;

	for (GLsizei i = 0; i < 8; i++) {
		const GLsizei at[3] = { 2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2) };
		uint32_t texel;

		if (at[0] >= image->width || at[1] >= image->height || at[2] >= image->depth)
			continue;
		texel = *gloss_texture_image_at(image, at[0], at[1], at[2]);
		for (int j = 0; j < 4; j++)
			sum[j] += depth ? texel : texel >> 8 * j & 255;
		count++;
	}
	if (depth)
		return (uint32_t)((sum[0] + count / 2) / count);
	for (int j = 0; j < 4; j++)
		mean |= (uint32_t)((sum[j] + count / 2) / count) << 8 * j;
	return mean;
}

static GLsizei image_half(GLsizei size)
{
	return size > 1 ? size / 2 : 1;
}

static bool image_halve(const struct gloss_texture_image *from, struct gloss_texture_image *to)
{
	const struct gloss_texture_image like = {
		.width = image_half(from->width),
		.height = image_half(from->height),
		.depth = image_half(from->depth),
		.format = from->format,
	};

	if (!gloss_texture_image_set(to, &like))
		return false;
	for (GLsizei z = 0; z < to->depth; z++)
		for (GLsizei y = 0; y < to->height; y++)
			for (GLsizei x = 0; x < to->width; x++)
				*gloss_texture_image_at(to, x, y, z) = image_mean(from, x, y, z);
	return true;
}

void gloss_texture_generate(struct gloss_texture *texture, int face, GLint level)
{
	struct gloss_texture_image *image = texture->image[face];

	if (!texture->sampler.generate || level != texture->sampler.base || image[level].border ||
	    !image[level].format)
		return;
	for (; level + 1 < gloss_texture_levels(texture->kind) && level < texture->sampler.most;
	     level++) {
		if (image[level].width <= 1 && image[level].height <= 1 && image[level].depth <= 1)
			return;
		if (!image_halve(&image[level], &image[level + 1]))
			return;
	}
}
