// SPDX-License-Identifier: MIT
#include <stdlib.h>

#include "accel.h"
#include "window/binding.h"
#include "window/config.h"
#include "window/egl.h"
#include "window/egl_objects.h"
#include "window/x11.h"

struct egl_surface *gloss_egl_surface(struct egl_display *display, EGLSurface handle)
{
	struct egl_surface *surface;

	if (!gloss_egl_ready(display))
		return NULL;
	pthread_mutex_lock(&display->lock);
	surface = display->surfaces;
	while (surface && surface != handle)
		surface = surface->next;
	pthread_mutex_unlock(&display->lock);
	if (!surface)
		gloss_egl_result(EGL_BAD_SURFACE);
	return surface;
}

/* Takes over @x11 even if it fails. */
static EGLSurface surface_new(struct egl_display *display, const struct gloss_config *config,
			      EGLint type, struct gloss_x11 *x11, const EGLint size[2])
{
	struct egl_surface *surface = calloc(1, sizeof(*surface));

	if (surface)
		surface->surface = gloss_surface_new(config, x11, size[0], size[1]);
	if (!surface || !surface->surface) {
		gloss_x11_close(x11);
		free(surface);
		gloss_egl_result(EGL_BAD_ALLOC);
		return EGL_NO_SURFACE;
	}
	surface->type = type;
	pthread_mutex_lock(&display->lock);
	surface->next = display->surfaces;
	display->surfaces = surface;
	pthread_mutex_unlock(&display->lock);
	gloss_egl_result(EGL_SUCCESS);
	return surface;
}

static EGLSurface surface_of_drawable(struct egl_display *display, EGLConfig handle, EGLint type,
				      xcb_drawable_t drawable)
{
	const struct gloss_config *config = gloss_egl_config(display, handle);
	static const EGLint unknown[2] = { 1, 1 };
	struct gloss_x11 *x11;

	if (!config)
		return EGL_NO_SURFACE;
	x11 = display->connection ? gloss_x11_open(display->connection, drawable, 0) : NULL;
	if (x11)
		return surface_new(display, config, type, x11, unknown);
	gloss_egl_result(type == EGL_WINDOW_BIT ? EGL_BAD_NATIVE_WINDOW : EGL_BAD_NATIVE_PIXMAP);
	return EGL_NO_SURFACE;
}

EGLSurface gloss_egl_create_window(EGLDisplay dpy, EGLConfig config, EGLNativeWindowType window,
				   const EGLint *attributes)
{
	/* EGL_RENDER_BUFFER is a hint, and there is a back buffer. */
	(void)attributes;
	return surface_of_drawable(dpy, config, EGL_WINDOW_BIT, (xcb_drawable_t)window);
}

EGLSurface gloss_egl_create_pixmap(EGLDisplay dpy, EGLConfig config, EGLNativePixmapType pixmap,
				   const EGLint *attributes)
{
	(void)attributes;
	return surface_of_drawable(dpy, config, EGL_PIXMAP_BIT, (xcb_drawable_t)pixmap);
}

/* Xlib's name of a window is handed over by its address, XCB's too, of another size. */
static xcb_drawable_t surface_native(const struct egl_display *display, const void *native)
{
	if (display->platform == EGL_PLATFORM_XCB_EXT)
		return *(const xcb_drawable_t *)native;
	return (xcb_drawable_t) * (const unsigned long *)native;
}

EGLSurface gloss_egl_create_platform_window(EGLDisplay dpy, EGLConfig config, void *window,
					    const EGLAttrib *attributes)
{
	(void)attributes;
	return surface_of_drawable(dpy, config, EGL_WINDOW_BIT, surface_native(dpy, window));
}

EGLSurface gloss_egl_create_platform_pixmap(EGLDisplay dpy, EGLConfig config, void *pixmap,
					    const EGLAttrib *attributes)
{
	(void)attributes;
	return surface_of_drawable(dpy, config, EGL_PIXMAP_BIT, surface_native(dpy, pixmap));
}

struct pbuffer {
	EGLint size[2];
	EGLint largest;
};

static EGLint pbuffer_attributes(const EGLint *attributes, struct pbuffer *pbuffer)
{
	for (; attributes && attributes[0] != EGL_NONE; attributes += 2) {
		switch (attributes[0]) {
		case EGL_WIDTH:
			pbuffer->size[0] = attributes[1];
			break;
		case EGL_HEIGHT:
			pbuffer->size[1] = attributes[1];
			break;
		case EGL_LARGEST_PBUFFER:
			pbuffer->largest = attributes[1];
			break;
		case EGL_TEXTURE_FORMAT:
		case EGL_TEXTURE_TARGET:
			if (attributes[1] != EGL_NO_TEXTURE)
				return EGL_BAD_MATCH;
			break;
		case EGL_MIPMAP_TEXTURE:
		case EGL_GL_COLORSPACE:
			break;
		default:
			return EGL_BAD_ATTRIBUTE;
		}
	}
	return pbuffer->size[0] < 0 || pbuffer->size[1] < 0 ? EGL_BAD_PARAMETER : EGL_SUCCESS;
}

/* A side of 0 is allowed, and there it has a pixel that nobody asks for. */
EGLSurface gloss_egl_create_pbuffer(EGLDisplay dpy, EGLConfig handle, const EGLint *attributes)
{
	const struct gloss_config *config = gloss_egl_config(dpy, handle);
	struct pbuffer pbuffer = { .size = { 0, 0 } };

	if (!config || !gloss_egl_result(pbuffer_attributes(attributes, &pbuffer)))
		return EGL_NO_SURFACE;
	for (int side = 0; side < 2; side++) {
		if (pbuffer.size[side] > ACCEL_TARGET_SIZE_MAX && !pbuffer.largest) {
			gloss_egl_result(EGL_BAD_ALLOC);
			return EGL_NO_SURFACE;
		}
		if (!pbuffer.size[side])
			pbuffer.size[side] = 1;
	}
	return surface_new(dpy, config, EGL_PBUFFER_BIT, NULL, pbuffer.size);
}

/* The buffers of other APIs that there are, OpenVG's, are none of ours. */
EGLSurface gloss_egl_create_pbuffer_from(EGLDisplay dpy, EGLenum type, EGLClientBuffer buffer,
					 EGLConfig config, const EGLint *attributes)
{
	(void)type;
	(void)buffer;
	(void)config;
	(void)attributes;
	if (gloss_egl_ready(dpy))
		gloss_egl_result(EGL_BAD_PARAMETER);
	return EGL_NO_SURFACE;
}

void gloss_egl_surface_free(struct egl_display *display, struct egl_surface *surface)
{
	struct egl_surface **link = &display->surfaces;

	while (*link != surface)
		link = &(*link)->next;
	*link = surface->next;
	gloss_surface_unref(surface->surface);
	free(surface);
}

EGLBoolean gloss_egl_destroy_surface(EGLDisplay dpy, EGLSurface handle)
{
	struct egl_display *display = dpy;
	struct egl_surface *surface = gloss_egl_surface(display, handle);

	if (!surface)
		return EGL_FALSE;
	pthread_mutex_lock(&display->lock);
	gloss_egl_surface_free(display, surface);
	pthread_mutex_unlock(&display->lock);
	return gloss_egl_result(EGL_SUCCESS);
}

/* False: not an attribute of this kind of surface, of which EGL leaves the value alone. */
static bool surface_value(const struct egl_surface *surface, EGLint name, EGLint *value)
{
	switch (name) {
	case EGL_CONFIG_ID:
		*value = gloss_surface_config(surface->surface)->id;
		return true;
	case EGL_WIDTH:
		*value = gloss_surface_width(surface->surface);
		return true;
	case EGL_HEIGHT:
		*value = gloss_surface_height(surface->surface);
		return true;
	case EGL_RENDER_BUFFER:
		*value = surface->type == EGL_PIXMAP_BIT ? EGL_SINGLE_BUFFER : EGL_BACK_BUFFER;
		return true;
	case EGL_SWAP_BEHAVIOR:
		*value = EGL_BUFFER_PRESERVED;
		return true;
	case EGL_GL_COLORSPACE:
		*value = EGL_GL_COLORSPACE_LINEAR;
		return true;
	case EGL_MULTISAMPLE_RESOLVE:
		*value = EGL_MULTISAMPLE_RESOLVE_DEFAULT;
		return true;
	case EGL_HORIZONTAL_RESOLUTION:
	case EGL_VERTICAL_RESOLUTION:
	case EGL_PIXEL_ASPECT_RATIO:
		*value = EGL_UNKNOWN;
		return true;
	case EGL_LARGEST_PBUFFER:
	case EGL_TEXTURE_FORMAT:
	case EGL_TEXTURE_TARGET:
	case EGL_MIPMAP_TEXTURE:
	case EGL_MIPMAP_LEVEL:
		if (surface->type == EGL_PBUFFER_BIT)
			*value = name == EGL_TEXTURE_FORMAT || name == EGL_TEXTURE_TARGET ?
					 EGL_NO_TEXTURE :
					 0;
		return true;
	default:
		return false;
	}
}

EGLBoolean gloss_egl_query_surface(EGLDisplay dpy, EGLSurface handle, EGLint name, EGLint *value)
{
	struct egl_surface *surface = gloss_egl_surface(dpy, handle);

	if (!surface)
		return EGL_FALSE;
	if (!value)
		return gloss_egl_result(EGL_BAD_PARAMETER);
	return gloss_egl_result(surface_value(surface, name, value) ? EGL_SUCCESS :
								      EGL_BAD_ATTRIBUTE);
}

EGLBoolean gloss_egl_surface_attrib(EGLDisplay dpy, EGLSurface handle, EGLint name, EGLint value)
{
	if (!gloss_egl_surface(dpy, handle))
		return EGL_FALSE;
	switch (name) {
	case EGL_MIPMAP_LEVEL:
	case EGL_SWAP_BEHAVIOR:
		return gloss_egl_result(EGL_SUCCESS);
	case EGL_MULTISAMPLE_RESOLVE:
		return gloss_egl_result(value == EGL_MULTISAMPLE_RESOLVE_DEFAULT ? EGL_SUCCESS :
										   EGL_BAD_MATCH);
	default:
		return gloss_egl_result(EGL_BAD_ATTRIBUTE);
	}
}

EGLBoolean gloss_egl_swap_buffers(EGLDisplay dpy, EGLSurface handle)
{
	struct egl_surface *surface = gloss_egl_surface(dpy, handle);

	if (!surface)
		return EGL_FALSE;
	if (surface->type != EGL_WINDOW_BIT)
		return gloss_egl_result(EGL_SUCCESS);
	if (!gloss_surface_alive(surface->surface))
		return gloss_egl_result(EGL_BAD_NATIVE_WINDOW);
	gloss_binding_swap(surface->surface);
	return gloss_egl_result(EGL_SUCCESS);
}

EGLBoolean gloss_egl_swap_interval(EGLDisplay dpy, EGLint interval)
{
	struct gloss_surface *surface = gloss_binding_draw();

	if (!gloss_egl_ready(dpy))
		return EGL_FALSE;
	if (!gloss_binding_current())
		return gloss_egl_result(EGL_BAD_CONTEXT);
	if (!surface)
		return gloss_egl_result(EGL_BAD_SURFACE);
	gloss_surface_set_interval(surface, interval > 0 ? 1 : 0);
	return gloss_egl_result(EGL_SUCCESS);
}

EGLBoolean gloss_egl_copy_buffers(EGLDisplay dpy, EGLSurface handle, EGLNativePixmapType pixmap)
{
	struct egl_display *display = dpy;
	struct egl_surface *surface = gloss_egl_surface(display, handle);
	struct gloss_x11 *x11 = NULL;

	if (!surface)
		return EGL_FALSE;
	if (display->connection)
		x11 = gloss_x11_open(display->connection, (xcb_drawable_t)pixmap, 0);
	if (!x11)
		return gloss_egl_result(EGL_BAD_NATIVE_PIXMAP);
	gloss_binding_copy(surface->surface, x11);
	gloss_x11_close(x11);
	return gloss_egl_result(EGL_SUCCESS);
}

/* No surface is made with a texture's format. */
EGLBoolean gloss_egl_tex_image(EGLDisplay dpy, EGLSurface surface, EGLint buffer)
{
	(void)buffer;
	if (!gloss_egl_surface(dpy, surface))
		return EGL_FALSE;
	return gloss_egl_result(EGL_BAD_MATCH);
}
