/* SPDX-License-Identifier: MIT */
/* Pictures in memory and in files. */
#ifndef TOOLS_PICTURE_H
#define TOOLS_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

/* A glyph's box, with the gap to the next. */
#define PICTURE_GLYPH_WIDTH 6
#define PICTURE_GLYPH_HEIGHT 8

struct picture {
	int width, height; /* pixels */
	uint32_t *pixel;   /* row by row from the top; red, green, blue, alpha bytes */
};

/* A black, opaque picture. -EINVAL: a size not above 0; -ENOMEM. */
int picture_new(int width, int height, struct picture *picture);
void picture_free(struct picture *picture);

/* Copies @source to where its top left corner is (@x, @y); all of it must fit. */
void picture_copy(struct picture *picture, int x, int y, const struct picture *source);

/*
 * Writes letters (as capitals), digits and "-.:", each pixel of a glyph @scale pixels wide and
 * high; anything else is a blank. Cut off at the border.
 */
void picture_text(struct picture *picture, int x, int y, const char *text, int scale,
		  uint32_t colour);

/* Whether @path ends in .png or .ppm, or needs no ending: "-", a device, a pipe, a folder. */
bool picture_named(const char *path);
/*
 * Writes red, green and blue to a file that appears whole or not at all (output.h), as PPM if
 * @path ends in .ppm, else as PNG; "-" is standard output. -errno
 */
int picture_write(const struct picture *picture, const char *path);
/* -errno; -EINVAL: not a PNG file. */
int picture_read(struct picture *picture, const char *path);

#endif
