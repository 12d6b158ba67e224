// SPDX-License-Identifier: MIT
/*
 * gl_shot WIDTH HEIGHT OUT.ppm: waits until a picture has come to the upper left corner of the screen, which
 * is black before, and stays as it is; writes it. gl_shot --black WIDTH HEIGHT: waits until it is gone.
 */
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define TRIES 300

static XImage *shot(Display *dpy, unsigned int width, unsigned int height)
{
	XImage *image = XGetImage(dpy, DefaultRootWindow(dpy), 0, 0, width, height, AllPlanes,
				  ZPixmap);

	if (!image || image->bits_per_pixel != 32) {
		fprintf(stderr, "gl_shot: no picture of 32 bits a pixel\n");
		exit(1);
	}
	return image;
}

static size_t image_bytes(const XImage *image)
{
	return (size_t)image->bytes_per_line * (size_t)image->height;
}

static bool black(const XImage *image)
{
	for (size_t i = 0; i < image_bytes(image); i++) {
		if (image->data[i])
			return false;
	}
	return true;
}

/* The corner when it stands still, and is black or not as @wanted says. */
static XImage *wait_for_picture(Display *dpy, unsigned int width, unsigned int height, bool wanted)
{
	XImage *last = shot(dpy, width, height);

	for (int i = 0; i < TRIES; i++) {
		XImage *next;
		bool still;

		usleep(100000);
		next = shot(dpy, width, height);
		still = !memcmp(last->data, next->data, image_bytes(next));
		XDestroyImage(last);
		last = next;
		if (still && black(last) == wanted)
			return last;
	}
	fprintf(stderr, "gl_shot: what was waited for did not come, or does not stand still\n");
	exit(1);
}

static void write_ppm(XImage *image, const char *name)
{
	FILE *file = fopen(name, "wb");

	if (!file) {
		perror(name);
		exit(1);
	}
	fprintf(file, "P6 %d %d 255\n", image->width, image->height);
	for (int y = 0; y < image->height; y++) {
		for (int x = 0; x < image->width; x++) {
			unsigned long pixel = XGetPixel(image, x, y);

			putc((int)(pixel >> 16 & 255), file);
			putc((int)(pixel >> 8 & 255), file);
			putc((int)(pixel & 255), file);
		}
	}
	fclose(file);
}

int main(int argc, char **argv)
{
	bool gone = argc > 1 && !strcmp(argv[1], "--black");
	char **size = argv + (gone ? 2 : 1);
	Display *dpy = XOpenDisplay(NULL);
	XImage *image;

	if (argc != 4 || !dpy) {
		fprintf(stderr,
			"usage: gl_shot WIDTH HEIGHT OUT.ppm, or --black WIDTH HEIGHT; and a DISPLAY\n");
		return 2;
	}
	image = wait_for_picture(dpy, (unsigned int)atoi(size[0]), (unsigned int)atoi(size[1]),
				 gone);
	if (!gone)
		write_ppm(image, argv[3]);
	XDestroyImage(image);
	XCloseDisplay(dpy);
	return 0;
}
