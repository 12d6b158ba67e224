// SPDX-License-Identifier: MIT
/*
 * For LD_PRELOAD: a program with a window draws the same pictures on each run, and ends after some of them.
 * FRAMES is how many. If FRAMES_PICTURES is set, it writes what glReadPixels gives after a tenth of them and
 * after the last, as $FRAMES_PICTURES-0.ppm and -1.ppm. Then its windows are asked to close, as a window manager does it; with
 * FRAMES_KEY, an X11 keycode, that key is pressed instead.
 * To the program a frame takes 1/30 s, whatever it takes, nothing waits, and it has the same process id, of which,
 * with the time, programs make their random numbers.
 */
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/select.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#define START 1000000000

static int frame;

int gettimeofday(struct timeval *now, void *zone)
{
	(void)zone;
	now->tv_sec = START + frame / 30;
	now->tv_usec = frame % 30 * 1000000 / 30;
	return 0;
}

time_t time(time_t *now)
{
	if (now)
		*now = START + frame / 30;
	return START + frame / 30;
}

pid_t getpid(void)
{
	return 1000;
}

int usleep(useconds_t microseconds)
{
	(void)microseconds;
	return 0;
}

/* Without files it is a way to sleep. */
int select(int files, fd_set *in, fd_set *out, fd_set *other, struct timeval *wait)
{
	static int (*real)(int, fd_set *, fd_set *, fd_set *, struct timeval *);

	if (!files)
		return 0;
	if (!real)
		*(void **)&real = dlsym(RTLD_NEXT, "select");
	return real(files, in, out, other, wait);
}

static void write_picture(int number)
{
	const char *pictures = getenv("FRAMES_PICTURES");
	GLint box[4];
	unsigned char *pixels;
	char name[512];
	FILE *file;

	if (!pictures)
		return;
	snprintf(name, sizeof(name), "%s-%d.ppm", pictures, number);
	glGetIntegerv(GL_VIEWPORT, box);
	file = fopen(name, "wb");
	pixels = calloc((size_t)box[2] * (size_t)box[3], 4);
	if (!file || !pixels) {
		perror(name);
		exit(1);
	}
	glReadPixels(box[0], box[1], box[2], box[3], GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	fprintf(file, "P6 %d %d 255\n", box[2], box[3]);
	for (int y = box[3] - 1; y >= 0; y--)
		for (int x = 0; x < box[2]; x++)
			fwrite(pixels + 4 * ((size_t)y * (size_t)box[2] + (size_t)x), 3, 1, file);
	fclose(file);
	free(pixels);
}

static void ask(Display *dpy, Window window, const char *key)
{
	XEvent event = { .xany = { .display = dpy, .window = window } };

	if (key) {
		event.xkey.type = KeyPress;
		event.xkey.root = DefaultRootWindow(dpy);
		event.xkey.keycode = (unsigned int)atoi(key);
		event.xkey.same_screen = True;
	} else {
		event.xclient.type = ClientMessage;
		event.xclient.message_type = XInternAtom(dpy, "WM_PROTOCOLS", False);
		event.xclient.format = 32;
		event.xclient.data.l[0] = (long)XInternAtom(dpy, "WM_DELETE_WINDOW", False);
	}
	XSendEvent(dpy, window, False, key ? KeyPressMask : 0, &event);
}

/* All windows on the screen are the program's. */
static void ask_to_end(void)
{
	Display *dpy = XOpenDisplay(NULL);
	Window root, parent, *windows;
	unsigned int count;

	if (!dpy || !XQueryTree(dpy, DefaultRootWindow(dpy), &root, &parent, &windows, &count))
		return;
	for (unsigned int i = 0; i < count; i++)
		ask(dpy, windows[i], getenv("FRAMES_KEY"));
	XFree(windows);
	XCloseDisplay(dpy);
}

static void before_swap(void)
{
	int frames = atoi(getenv("FRAMES"));

	frame++;
	if (frame == frames / 10)
		write_picture(0);
	if (frame != frames)
		return;
	write_picture(1);
	ask_to_end();
}

void glXSwapBuffers(Display *dpy, GLXDrawable drawable)
{
	static void (*real)(Display *, GLXDrawable);

	if (!real)
		*(void **)&real = dlsym(RTLD_NEXT, "glXSwapBuffers");
	before_swap();
	real(dpy, drawable);
}

EGLBoolean eglSwapBuffers(EGLDisplay display, EGLSurface surface)
{
	static EGLBoolean (*real)(EGLDisplay, EGLSurface);

	if (!real)
		*(void **)&real = dlsym(RTLD_NEXT, "eglSwapBuffers");
	before_swap();
	return real(display, surface);
}
