// SPDX-License-Identifier: MIT
#include <errno.h>
#include <limits.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "scene/output.h"
#include "scene/picture.h"

#define OPAQUE 0xff000000u

int picture_new(int width, int height, struct picture *picture)
{
	if (width <= 0 || height <= 0 || width > INT_MAX / 4 / height)
		return -EINVAL;
	picture->width = width;
	picture->height = height;
	picture->pixel = malloc((size_t)width * height * sizeof(*picture->pixel));
	if (!picture->pixel)
		return -ENOMEM;
	for (int i = 0; i < width * height; i++)
		picture->pixel[i] = OPAQUE;
	return 0;
}

void picture_free(struct picture *picture)
{
	free(picture->pixel);
	memset(picture, 0, sizeof(*picture));
}

void picture_copy(struct picture *picture, int x, int y, const struct picture *source)
{
	for (int row = 0; row < source->height; row++)
		memcpy(picture->pixel + (size_t)(y + row) * picture->width + x,
		       source->pixel + (size_t)row * source->width,
		       source->width * sizeof(*source->pixel));
}

/* libpng wants bytes; alpha is left out, for a viewer would blend with it. */
static uint8_t *rgb_bytes(const struct picture *picture)
{
	size_t pixels = (size_t)picture->width * picture->height;
	uint8_t *bytes = malloc(pixels * 3);

	for (size_t i = 0; bytes && i < pixels; i++)
		for (int channel = 0; channel < 3; channel++)
			bytes[i * 3 + channel] = (uint8_t)(picture->pixel[i] >> 8 * channel);
	return bytes;
}

static bool ends_in(const char *path, const char *ending)
{
	size_t length = strlen(path), size = strlen(ending);

	return length > size && !strcasecmp(path + length - size, ending);
}

bool picture_named(const char *path)
{
	struct stat status;

	return ends_in(path, ".png") || ends_in(path, ".ppm") || !strcmp(path, "-") ||
	       (!stat(path, &status) && !S_ISREG(status.st_mode));
}

static int write_png(const struct picture *picture, const uint8_t *bytes, FILE *file)
{
	png_image image = {
		.version = PNG_IMAGE_VERSION,
		.width = picture->width,
		.height = picture->height,
		.format = PNG_FORMAT_RGB,
	};

	return png_image_write_to_stdio(&image, file, 0, bytes, 0, NULL) ? 0 : -EIO;
}

static int write_ppm(const struct picture *picture, const uint8_t *bytes, FILE *file)
{
	size_t pixels = (size_t)picture->width * picture->height;

	fprintf(file, "P6\n%d %d\n255\n", picture->width, picture->height);
	return fwrite(bytes, 3, pixels, file) == pixels ? 0 : -EIO;
}

static int write_to(const struct picture *picture, const char *path, FILE *file)
{
	uint8_t *bytes = rgb_bytes(picture);
	int error;

	if (!bytes)
		return -ENOMEM;
	errno = 0;
	error = ends_in(path, ".ppm") ? write_ppm(picture, bytes, file) :
					write_png(picture, bytes, file);
	if (error && errno)
		error = -errno;
	free(bytes);
	return error;
}

int picture_write(const struct picture *picture, const char *path)
{
	struct output output;
	int error;

	if (!strcmp(path, "-")) {
		error = write_to(picture, path, stdout);
		return !error && fflush(stdout) ? -errno : error;
	}
	error = output_open(&output, path);
	if (error)
		return error;
	error = write_to(picture, path, output.file);
	if (!error)
		return output_commit(&output);
	output_discard(&output);
	return error;
}

int picture_read(struct picture *picture, const char *path)
{
	png_image image = { .version = PNG_IMAGE_VERSION };
	int error;

	errno = 0;
	if (!png_image_begin_read_from_file(&image, path))
		return errno ? -errno : -EINVAL;
	image.format = PNG_FORMAT_RGBA;
	error = picture_new((int)image.width, (int)image.height, picture);
	if (error) {
		png_image_free(&image);
		return error;
	}
	if (png_image_finish_read(&image, NULL, picture->pixel, 0, NULL))
		return 0;
	picture_free(picture);
	return -EINVAL;
}
