// SPDX-License-Identifier: MIT
#include <X11/Xlib-xcb.h>
#include <X11/Xlibint.h>
#include <pthread.h>
#include <stdlib.h>

#include "accel.h"
#include "window/binding.h"
#include "window/config.h"
#include "window/glx.h"
#include "window/x11.h"

#define SWAP_INTERVAL 0x20F1 /* GLX_EXT_swap_control */
#define MAX_SWAP_INTERVAL 0x20F2

struct glx_drawable {
	struct glx_drawable *next;
	Display *dpy;
	XID id;
	struct gloss_surface *surface;
	bool window;        /* a window, which any client may destroy */
	unsigned long mask; /* of events that are selected; none is ever sent */
};

/* Protects the list. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct glx_drawable *drawables;

static struct glx_drawable *drawable_find(const Display *dpy, XID id)
{
	struct glx_drawable *drawable = drawables;

	while (drawable && (drawable->dpy != dpy || drawable->id != id))
		drawable = drawable->next;
	return drawable;
}

/* Takes the next one off the list. */
static void drawable_drop(struct glx_drawable **link)
{
	struct glx_drawable *drawable = *link;

	*link = drawable->next;
	gloss_surface_unref(drawable->surface);
	free(drawable);
}

/* A display whose end Xlib will tell of. */
struct watched {
	struct watched *next;
	Display *dpy;
};

static struct watched *displays;

static void drawable_unwatch(const Display *dpy)
{
	struct watched **link = &displays;

	for (; *link; link = &(*link)->next) {
		struct watched *display = *link;

		if (display->dpy == dpy) {
			*link = display->next;
			free(display);
			return;
		}
	}
}

/* Xlib calls this while the connection is still there. */
static int drawable_display_closed(Display *dpy, XExtCodes *codes)
{
	struct glx_drawable **link = &drawables;

	(void)codes;
	pthread_mutex_lock(&lock);
	drawable_unwatch(dpy);
	while (*link) {
		if ((*link)->dpy != dpy) {
			link = &(*link)->next;
			continue;
		}
		gloss_surface_leave((*link)->surface);
		drawable_drop(link);
	}
	pthread_mutex_unlock(&lock);
	return 0;
}

/* Without memory drawables of the display stay until the end of the program. */
static void drawable_watch(Display *dpy)
{
	struct watched *display = displays;
	XExtCodes *codes;

	while (display && display->dpy != dpy)
		display = display->next;
	if (display)
		return;
	display = malloc(sizeof(*display));
	codes = display ? XAddExtension(dpy) : NULL;
	if (!codes) {
		free(display);
		return;
	}
	XESetCloseDisplay(dpy, codes->extension, drawable_display_closed);
	display->dpy = dpy;
	display->next = displays;
	displays = display;
}

/* Windows that are gone, whose ids may come again. */
static void drawable_sweep(const Display *dpy)
{
	struct glx_drawable **link = &drawables;

	while (*link) {
		if ((*link)->dpy == dpy && (*link)->window &&
		    !gloss_surface_alive((*link)->surface))
			drawable_drop(link);
		else
			link = &(*link)->next;
	}
}

/* Takes over @x11 even if it fails. */
static struct glx_drawable *drawable_new(Display *dpy, XID id, const struct gloss_config *config,
					 struct gloss_x11 *x11, const int size[2])
{
	struct glx_drawable *drawable = calloc(1, sizeof(*drawable));

	if (drawable)
		drawable->surface = gloss_surface_new(config, x11, size[0], size[1]);
	if (!drawable || !drawable->surface) {
		gloss_x11_close(x11);
		free(drawable);
		return NULL;
	}
	drawable_watch(dpy);
	drawable->dpy = dpy;
	drawable->id = id;
	drawable->next = drawables;
	drawables = drawable;
	return drawable;
}

static struct glx_drawable *drawable_of_window(Display *dpy, XID window,
					       const struct gloss_config *config)
{
	static const int unknown[2] = { 1, 1 };
	struct glx_drawable *drawable = drawable_find(dpy, window);
	struct gloss_x11 *x11;

	if (drawable && (!drawable->window || gloss_surface_alive(drawable->surface)))
		return drawable;
	drawable_sweep(dpy);
	x11 = gloss_x11_open(XGetXCBConnection(dpy), (xcb_drawable_t)window, 0);
	if (!x11)
		return NULL;
	drawable = drawable_new(dpy, window, config, x11, unknown);
	if (drawable)
		drawable->window = true;
	return drawable;
}

struct gloss_surface *gloss_glx_surface(Display *dpy, XID id, const struct gloss_config *config)
{
	struct gloss_surface *surface = NULL;
	struct glx_drawable *drawable;

	pthread_mutex_lock(&lock);
	drawable = config ? drawable_of_window(dpy, id, config) : drawable_find(dpy, id);
	if (drawable)
		surface = gloss_surface_ref(drawable->surface);
	pthread_mutex_unlock(&lock);
	return surface;
}

/* A GLXWindow has the id of its window. */
GLXWindow gloss_glx_create_window(Display *dpy, GLXFBConfig config, Window window,
				  const int *attributes)
{
	struct gloss_surface *surface = gloss_glx_surface(dpy, window, (const void *)config);

	(void)attributes;
	gloss_surface_unref(surface);
	return surface ? window : None;
}

static XID drawable_create(Display *dpy, const struct gloss_config *config, struct gloss_x11 *x11,
			   const int size[2])
{
	XID id = xcb_generate_id(XGetXCBConnection(dpy));
	bool made;

	pthread_mutex_lock(&lock);
	made = drawable_new(dpy, id, config, x11, size);
	pthread_mutex_unlock(&lock);
	return made ? id : None;
}

GLXPixmap gloss_glx_create_pixmap(Display *dpy, GLXFBConfig config, Pixmap pixmap,
				  const int *attributes)
{
	struct gloss_x11 *x11 = gloss_x11_open(XGetXCBConnection(dpy), (xcb_drawable_t)pixmap, 0);
	static const int unknown[2] = { 1, 1 };

	(void)attributes;
	return x11 ? drawable_create(dpy, (const void *)config, x11, unknown) : None;
}

GLXPixmap gloss_glx_create_glx_pixmap(Display *dpy, XVisualInfo *visual, Pixmap pixmap)
{
	const struct gloss_config *config = gloss_glx_config_of_visual(dpy, visual);

	return config ? gloss_glx_create_pixmap(dpy, (GLXFBConfig)config, pixmap, NULL) : None;
}

GLXPbuffer gloss_glx_create_pbuffer(Display *dpy, GLXFBConfig config, const int *attributes)
{
	int size[2] = { 0, 0 };
	bool largest = false;

	for (; attributes && attributes[0] != None; attributes += 2) {
		if (attributes[0] == GLX_PBUFFER_WIDTH)
			size[0] = attributes[1];
		else if (attributes[0] == GLX_PBUFFER_HEIGHT)
			size[1] = attributes[1];
		else if (attributes[0] == GLX_LARGEST_PBUFFER)
			largest = attributes[1];
	}
	for (int side = 0; side < 2; side++) {
		if (size[side] < 0 || (size[side] > ACCEL_TARGET_SIZE_MAX && !largest))
			return None;
		if (!size[side])
			size[side] = 1;
	}
	return drawable_create(dpy, (const void *)config, NULL, size);
}

void gloss_glx_destroy_drawable(Display *dpy, GLXDrawable id)
{
	struct glx_drawable **link = &drawables;

	pthread_mutex_lock(&lock);
	while (*link && ((*link)->dpy != dpy || (*link)->id != id))
		link = &(*link)->next;
	if (*link)
		drawable_drop(link);
	pthread_mutex_unlock(&lock);
}

void gloss_glx_query_drawable(Display *dpy, GLXDrawable id, int name, unsigned int *value)
{
	struct gloss_surface *surface = gloss_glx_surface(dpy, id, NULL);

	*value = 0;
	if (!surface)
		return;
	switch (name) {
	case GLX_WIDTH:
		*value = (unsigned int)gloss_surface_width(surface);
		break;
	case GLX_HEIGHT:
		*value = (unsigned int)gloss_surface_height(surface);
		break;
	case GLX_PRESERVED_CONTENTS:
		*value = True;
		break;
	case GLX_FBCONFIG_ID:
		*value = (unsigned int)gloss_surface_config(surface)->id;
		break;
	case SWAP_INTERVAL:
		*value = (unsigned int)gloss_surface_interval(surface);
		break;
	case MAX_SWAP_INTERVAL:
		*value = GLOSS_INTERVAL_MAX;
		break;
	default:
		break;
	}
	gloss_surface_unref(surface);
}

void gloss_glx_swap_buffers(Display *dpy, GLXDrawable id)
{
	struct gloss_surface *surface = gloss_glx_surface(dpy, id, NULL);

	if (surface)
		gloss_binding_swap(surface);
	gloss_surface_unref(surface);
}

void gloss_glx_swap_interval_ext(Display *dpy, GLXDrawable id, int interval)
{
	struct gloss_surface *surface = gloss_glx_surface(dpy, id, NULL);

	if (surface && interval >= 0)
		gloss_surface_set_interval(surface, interval);
	gloss_surface_unref(surface);
}

int gloss_glx_swap_interval_mesa(unsigned int interval)
{
	struct gloss_surface *surface = gloss_binding_draw();

	if (!surface)
		return GLX_BAD_CONTEXT;
	if (interval > GLOSS_INTERVAL_MAX)
		return GLX_BAD_VALUE;
	gloss_surface_set_interval(surface, (int)interval);
	return Success;
}

int gloss_glx_get_swap_interval_mesa(void)
{
	struct gloss_surface *surface = gloss_binding_draw();

	return surface ? gloss_surface_interval(surface) : 0;
}

int gloss_glx_swap_interval_sgi(int interval)
{
	return interval > 0 ? gloss_glx_swap_interval_mesa((unsigned int)interval) : GLX_BAD_VALUE;
}

void gloss_glx_select_event(Display *dpy, GLXDrawable id, unsigned long mask)
{
	struct glx_drawable *drawable;

	pthread_mutex_lock(&lock);
	drawable = drawable_find(dpy, id);
	if (drawable)
		drawable->mask = mask;
	pthread_mutex_unlock(&lock);
}

/* A pbuffer is never lost, so no event of those that can be selected ever comes. */
void gloss_glx_get_selected_event(Display *dpy, GLXDrawable id, unsigned long *mask)
{
	const struct glx_drawable *drawable;

	pthread_mutex_lock(&lock);
	drawable = drawable_find(dpy, id);
	*mask = drawable ? drawable->mask : 0;
	pthread_mutex_unlock(&lock);
}
