// SPDX-License-Identifier: MIT
/*
 * Internal formats. Whatever resolution a program asks for, a texel is kept as four bytes, or as a
 * depth of 24 bits: OpenGL lets the library choose, and those are what the core is to have.
 */
#include "texture/texture.h"

#include <math.h>

#define DEPTH_MOST 0xffffffu

/* Those of OpenGL 1.5, and generic compressed ones, which OpenGL allows to be kept as they are. */
static const struct gloss_texture_format formats[] = {
	{ 1, GL_LUMINANCE },
	{ 2, GL_LUMINANCE_ALPHA },
	{ 3, GL_RGB },
	{ 4, GL_RGBA },
	{ GL_ALPHA, GL_ALPHA },
	{ GL_ALPHA4, GL_ALPHA },
	{ GL_ALPHA8, GL_ALPHA },
	{ GL_ALPHA12, GL_ALPHA },
	{ GL_ALPHA16, GL_ALPHA },
	{ GL_LUMINANCE, GL_LUMINANCE },
	{ GL_LUMINANCE4, GL_LUMINANCE },
	{ GL_LUMINANCE8, GL_LUMINANCE },
	{ GL_LUMINANCE12, GL_LUMINANCE },
	{ GL_LUMINANCE16, GL_LUMINANCE },
	{ GL_LUMINANCE_ALPHA, GL_LUMINANCE_ALPHA },
	{ GL_LUMINANCE4_ALPHA4, GL_LUMINANCE_ALPHA },
	{ GL_LUMINANCE6_ALPHA2, GL_LUMINANCE_ALPHA },
	{ GL_LUMINANCE8_ALPHA8, GL_LUMINANCE_ALPHA },
	{ GL_LUMINANCE12_ALPHA4, GL_LUMINANCE_ALPHA },
	{ GL_LUMINANCE12_ALPHA12, GL_LUMINANCE_ALPHA },
	{ GL_LUMINANCE16_ALPHA16, GL_LUMINANCE_ALPHA },
	{ GL_INTENSITY, GL_INTENSITY },
	{ GL_INTENSITY4, GL_INTENSITY },
	{ GL_INTENSITY8, GL_INTENSITY },
	{ GL_INTENSITY12, GL_INTENSITY },
	{ GL_INTENSITY16, GL_INTENSITY },
	{ GL_RGB, GL_RGB },
	{ GL_R3_G3_B2, GL_RGB },
	{ GL_RGB4, GL_RGB },
	{ GL_RGB5, GL_RGB },
	{ GL_RGB8, GL_RGB },
	{ GL_RGB10, GL_RGB },
	{ GL_RGB12, GL_RGB },
	{ GL_RGB16, GL_RGB },
	{ GL_RGBA, GL_RGBA },
	{ GL_RGBA2, GL_RGBA },
	{ GL_RGBA4, GL_RGBA },
	{ GL_RGB5_A1, GL_RGBA },
	{ GL_RGBA8, GL_RGBA },
	{ GL_RGB10_A2, GL_RGBA },
	{ GL_RGBA12, GL_RGBA },
	{ GL_RGBA16, GL_RGBA },
	{ GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT },
	{ GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT },
	{ GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT },
	{ GL_DEPTH_COMPONENT32, GL_DEPTH_COMPONENT },
	{ GL_COMPRESSED_ALPHA, GL_ALPHA },
	{ GL_COMPRESSED_LUMINANCE, GL_LUMINANCE },
	{ GL_COMPRESSED_LUMINANCE_ALPHA, GL_LUMINANCE_ALPHA },
	{ GL_COMPRESSED_INTENSITY, GL_INTENSITY },
	{ GL_COMPRESSED_RGB, GL_RGB },
	{ GL_COMPRESSED_RGBA, GL_RGBA },
};

const struct gloss_texture_format *gloss_texture_format_find(GLint internal)
{
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		if ((GLint)formats[i].internal == internal)
			return &formats[i];
	return NULL;
}

GLint gloss_texture_format_bits(const struct gloss_texture_format *format, GLenum pname)
{
	const GLenum base = format->base;
	const bool alpha = base == GL_ALPHA || base == GL_LUMINANCE_ALPHA || base == GL_RGBA;

	switch (pname) {
	case GL_TEXTURE_RED_SIZE:
	case GL_TEXTURE_GREEN_SIZE:
	case GL_TEXTURE_BLUE_SIZE:
		return base == GL_RGB || base == GL_RGBA ? 8 : 0;
	case GL_TEXTURE_ALPHA_SIZE:
		return alpha ? 8 : 0;
	case GL_TEXTURE_LUMINANCE_SIZE:
		return base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA ? 8 : 0;
	case GL_TEXTURE_INTENSITY_SIZE:
		return base == GL_INTENSITY ? 8 : 0;
	case GL_TEXTURE_DEPTH_SIZE:
		return base == GL_DEPTH_COMPONENT ? 24 : 0;
	default:
		return 0;
	}
}

static uint32_t format_word(uint32_t r, uint32_t g, uint32_t b, uint32_t a)
{
	return r | g << 8 | b << 16 | a << 24;
}

/* As it is sampled: what a base format has not is 0, and alpha 1 (table 3.21). */
uint32_t gloss_texture_format_pack_bytes(const struct gloss_texture_format *format,
					 const uint8_t rgba[4])
{
	const uint32_t red = rgba[0];

	switch (format->base) {
	case GL_ALPHA:
		return format_word(0, 0, 0, rgba[3]);
	case GL_LUMINANCE:
		return format_word(red, red, red, 255);
	case GL_LUMINANCE_ALPHA:
		return format_word(red, red, red, rgba[3]);
	case GL_INTENSITY:
		return format_word(red, red, red, red);
	case GL_RGB:
		return format_word(red, rgba[1], rgba[2], 255);
	default:
		return format_word(red, rgba[1], rgba[2], rgba[3]);
	}
}

uint32_t gloss_texture_format_pack(const struct gloss_texture_format *format, const float rgba[4])
{
	uint8_t bytes[4];

	if (format->base == GL_DEPTH_COMPONENT)
		return (uint32_t)((double)rgba[0] * DEPTH_MOST + 0.5);
	for (int i = 0; i < 4; i++)
		bytes[i] = (uint8_t)(rgba[i] * 255 + 0.5f);
	return gloss_texture_format_pack_bytes(format, bytes);
}

/* Table 6.1. */
void gloss_texture_format_unpack(const struct gloss_texture_format *format, uint32_t texel,
				 float rgba[4])
{
	const GLenum base = format->base;

	if (base == GL_DEPTH_COMPONENT) {
		rgba[0] = (float)((double)(texel & DEPTH_MOST) / DEPTH_MOST);
		return;
	}
	for (int i = 0; i < 4; i++)
		rgba[i] = (float)(texel >> 8 * i & 255) / 255;
	if (base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA || base == GL_INTENSITY)
		rgba[1] = rgba[2] = 0;
	if (base == GL_INTENSITY)
		rgba[3] = 1;
}
