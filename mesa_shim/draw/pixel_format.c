// SPDX-License-Identifier: MIT
#include "draw/pixel_format.h"

#include <GL/glext.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "api/convert.h"

static const struct {
	GLenum format;
	unsigned char components, from[GLOSS_COMPONENTS];
	bool luminance;
} pixel_components[] = {
	{ GL_RED, 1, { 0 }, false },
	{ GL_GREEN, 1, { 1 }, false },
	{ GL_BLUE, 1, { 2 }, false },
	{ GL_ALPHA, 1, { 3 }, false },
	{ GL_RGB, 3, { 0, 1, 2 }, false },
	{ GL_RGBA, 4, { 0, 1, 2, 3 }, false },
	{ GL_BGR, 3, { 2, 1, 0 }, false },
	{ GL_BGRA, 4, { 2, 1, 0, 3 }, false },
	{ GL_ABGR_EXT, 4, { 3, 2, 1, 0 }, false },
	{ GL_LUMINANCE, 1, { 0 }, true },
	{ GL_LUMINANCE_ALPHA, 2, { 0, 3 }, true },
	{ GL_DEPTH_COMPONENT, 1, { 0 }, false },
	{ GL_COLOR_INDEX, 1, { 0 }, false },
	{ GL_STENCIL_INDEX, 1, { 0 }, false },
};

static const struct {
	GLenum type;
	unsigned char size, bits[GLOSS_COMPONENTS];
	bool reversed;
} pixel_types[] = {
	{ GL_BITMAP, 0, { 0 }, false },
	{ GL_UNSIGNED_BYTE, 1, { 0 }, false },
	{ GL_BYTE, 1, { 0 }, false },
	{ GL_UNSIGNED_SHORT, 2, { 0 }, false },
	{ GL_SHORT, 2, { 0 }, false },
	{ GL_UNSIGNED_INT, 4, { 0 }, false },
	{ GL_INT, 4, { 0 }, false },
	{ GL_FLOAT, 4, { 0 }, false },
	{ GL_UNSIGNED_BYTE_3_3_2, 1, { 3, 3, 2 }, false },
	{ GL_UNSIGNED_BYTE_2_3_3_REV, 1, { 3, 3, 2 }, true },
	{ GL_UNSIGNED_SHORT_5_6_5, 2, { 5, 6, 5 }, false },
	{ GL_UNSIGNED_SHORT_5_6_5_REV, 2, { 5, 6, 5 }, true },
	{ GL_UNSIGNED_SHORT_4_4_4_4, 2, { 4, 4, 4, 4 }, false },
	{ GL_UNSIGNED_SHORT_4_4_4_4_REV, 2, { 4, 4, 4, 4 }, true },
	{ GL_UNSIGNED_SHORT_5_5_5_1, 2, { 5, 5, 5, 1 }, false },
	{ GL_UNSIGNED_SHORT_1_5_5_5_REV, 2, { 5, 5, 5, 1 }, true },
	{ GL_UNSIGNED_INT_8_8_8_8, 4, { 8, 8, 8, 8 }, false },
	{ GL_UNSIGNED_INT_8_8_8_8_REV, 4, { 8, 8, 8, 8 }, true },
	{ GL_UNSIGNED_INT_10_10_10_2, 4, { 10, 10, 10, 2 }, false },
	{ GL_UNSIGNED_INT_2_10_10_10_REV, 4, { 10, 10, 10, 2 }, true },
};

static bool pixel_find_components(GLenum format, struct gloss_pixel_format *out)
{
	for (size_t i = 0; i < sizeof(pixel_components) / sizeof(*pixel_components); i++)
		if (pixel_components[i].format == format) {
			out->components = pixel_components[i].components;
			out->luminance = pixel_components[i].luminance;
			out->index = format == GL_COLOR_INDEX || format == GL_STENCIL_INDEX;
			memcpy(out->from, pixel_components[i].from, sizeof(out->from));
			return true;
		}
	return false;
}

static bool pixel_find_type(GLenum type, struct gloss_pixel_format *out)
{
	for (size_t i = 0; i < sizeof(pixel_types) / sizeof(*pixel_types); i++)
		if (pixel_types[i].type == type) {
			out->type = type;
			out->element = pixel_types[i].size;
			out->reversed = pixel_types[i].reversed;
			memcpy(out->bits, pixel_types[i].bits, sizeof(out->bits));
			return true;
		}
	return false;
}

GLenum gloss_pixel_format_find(GLenum format, GLenum type, struct gloss_pixel_format *out)
{
	if (!pixel_find_components(format, out) || !pixel_find_type(type, out))
		return GL_INVALID_ENUM;
	if (type == GL_BITMAP && !out->index)
		return GL_INVALID_ENUM;
	out->size = out->element * (out->bits[0] ? 1 : out->components);
	if (out->bits[0] && out->components != (out->bits[3] ? 4 : 3))
		return GL_INVALID_OPERATION;
	return GL_NO_ERROR;
}

/* The value of an element in its own bytes. */
static uint32_t pixel_load(const void *at, size_t size, bool swap)
{
	uint8_t byte;
	uint16_t half;
	uint32_t word;

	if (size == 1) {
		memcpy(&byte, at, 1);
		return byte;
	}
	if (size == 2) {
		memcpy(&half, at, 2);
		return swap ? __builtin_bswap16(half) : half;
	}
	memcpy(&word, at, 4);
	return swap ? __builtin_bswap32(word) : word;
}

static void pixel_store(void *at, size_t size, bool swap, uint32_t value)
{
	const uint8_t byte = (uint8_t)value;
	const uint16_t half = swap ? __builtin_bswap16((uint16_t)value) : (uint16_t)value;
	const uint32_t word = swap ? __builtin_bswap32(value) : value;

	if (size == 1)
		memcpy(at, &byte, 1);
	else if (size == 2)
		memcpy(at, &half, 2);
	else
		memcpy(at, &word, 4);
}

/* Table 4.7: what 0 to 1 is as an integer, or the bits of a float. */
static uint32_t pixel_from_float(GLenum type, float value)
{
	const double v = (double)value;
	uint32_t bits;

	switch (type) {
	case GL_UNSIGNED_BYTE:
		return (uint32_t)(v * 255 + 0.5);
	case GL_BYTE:
		return (uint32_t)(int32_t)floor((255 * v - 1) / 2 + 0.5);
	case GL_UNSIGNED_SHORT:
		return (uint32_t)(v * 65535 + 0.5);
	case GL_SHORT:
		return (uint32_t)(int32_t)floor((65535 * v - 1) / 2 + 0.5);
	case GL_UNSIGNED_INT:
		return (uint32_t)(v * 4294967295.0 + 0.5);
	case GL_INT:
		return (uint32_t)(int32_t)floor((4294967295.0 * v - 1) / 2);
	default:
		memcpy(&bits, &value, sizeof(bits));
		return bits;
	}
}

static uint32_t pixel_from_index(GLenum type, float value)
{
	uint32_t bits;

	if (type != GL_FLOAT)
		return (uint32_t)(int32_t)value;
	memcpy(&bits, &value, sizeof(bits));
	return bits;
}

static float pixel_to_index(GLenum type, uint32_t bits)
{
	float value;

	switch (type) {
	case GL_BYTE:
		return (int8_t)bits;
	case GL_SHORT:
		return (int16_t)bits;
	case GL_INT:
		return (float)(int32_t)bits;
	case GL_FLOAT:
		memcpy(&value, &bits, sizeof(value));
		return value;
	default:
		return (float)bits;
	}
}

static float pixel_to_float(GLenum type, uint32_t bits)
{
	float value;

	switch (type) {
	case GL_UNSIGNED_BYTE:
		return gloss_from_ub((GLubyte)bits);
	case GL_BYTE:
		return gloss_from_b((GLbyte)bits);
	case GL_UNSIGNED_SHORT:
		return gloss_from_us((GLushort)bits);
	case GL_SHORT:
		return gloss_from_s((GLshort)bits);
	case GL_UNSIGNED_INT:
		return gloss_from_ui(bits);
	case GL_INT:
		return gloss_from_i((GLint)bits);
	default:
		memcpy(&value, &bits, sizeof(value));
		return value;
	}
}

/* Where component @i of a packed type is: its lowest bit. */
static unsigned int pixel_shift(const struct gloss_pixel_format *format, unsigned int i)
{
	unsigned int below = 0;

	if (format->reversed) {
		while (i)
			below += format->bits[--i];
		return below;
	}
	while (++i < GLOSS_COMPONENTS)
		below += format->bits[i];
	return below;
}

void gloss_pixel_format_put(const struct gloss_pixel_format *format, bool swap, void *pixel,
			    const float rgba[4])
{
	uint32_t packed = 0;

	for (unsigned int i = 0; i < format->components; i++) {
		float value = rgba[format->from[i]];

		if (format->luminance && i == 0)
			value = fminf(rgba[0] + rgba[1] + rgba[2], 1);
		if (format->index)
			pixel_store(pixel, format->element, swap,
				    pixel_from_index(format->type, value));
		else if (format->bits[0])
			packed |= (uint32_t)(value * (float)((1u << format->bits[i]) - 1) + 0.5f)
				  << pixel_shift(format, i);
		else
			pixel_store((char *)pixel + i * format->element, format->element, swap,
				    pixel_from_float(format->type, value));
	}
	if (format->bits[0])
		pixel_store(pixel, format->element, swap, packed);
}

void gloss_pixel_format_get(const struct gloss_pixel_format *format, bool swap, const void *pixel,
			    float rgba[4])
{
	uint32_t packed = pixel_load(pixel, format->element, swap);

	rgba[0] = rgba[1] = rgba[2] = 0;
	rgba[3] = 1;
	if (format->index) {
		rgba[0] = pixel_to_index(format->type, packed);
		return;
	}
	for (unsigned int i = 0; i < format->components; i++) {
		uint32_t most = (1u << format->bits[i]) - 1;

		if (format->bits[0])
			rgba[format->from[i]] = (float)(packed >> pixel_shift(format, i) & most) /
						(float)most;
		else
			rgba[format->from[i]] = pixel_to_float(
				format->type, pixel_load((const char *)pixel + i * format->element,
							 format->element, swap));
	}
	if (format->luminance)
		rgba[1] = rgba[2] = rgba[0];
}
