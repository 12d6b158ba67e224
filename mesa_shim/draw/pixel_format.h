/* SPDX-License-Identifier: MIT */
/* Formats and types of images in a program's memory: OpenGL 1.5, section 3.6.4 and 4.3.2. */
#ifndef GLOSS_PIXEL_FORMAT_H
#define GLOSS_PIXEL_FORMAT_H

#include <stdbool.h>
#include <stddef.h>

#include <GL/gl.h>

#define GLOSS_COMPONENTS 4

struct gloss_pixel_format {
	GLenum type;
	unsigned int components;
	/* Of each component, where in RGBA it is; LUMINANCE is red, green and blue together. */
	unsigned char from[GLOSS_COMPONENTS];
	bool luminance, reversed;
	bool index; /* its one component is an integer and stands for nothing from 0 to 1 */
	unsigned char bits[GLOSS_COMPONENTS]; /* of a packed type, from the most significant */
	size_t element, size;                 /* bytes, of an element and of a pixel */
};

/*
 * The error of the two together, or GL_NO_ERROR. Depth and indices are formats of one component.
 * With GL_BITMAP pixels are bits: gloss_pixel_store_bit reads them.
 */
GLenum gloss_pixel_format_find(GLenum format, GLenum type, struct gloss_pixel_format *out);
/* Writes one pixel. @rgba is in 0 to 1, or an index. */
void gloss_pixel_format_put(const struct gloss_pixel_format *format, bool swap, void *pixel,
			    const float rgba[4]);
/* Reads one pixel; components that it has not are 0, and alpha 1. */
void gloss_pixel_format_get(const struct gloss_pixel_format *format, bool swap, const void *pixel,
			    float rgba[4]);

#endif
