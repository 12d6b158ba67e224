// SPDX-License-Identifier: MIT
#include "state/context.h"
#include "window/binding.h"
#include "window/config.h"
#include "window/glx.h"

static GLXContext context_new(Display *dpy, const struct gloss_config *config, int screen,
			      GLXContext share)
{
	struct gloss_binding *binding;

	if (!config ||
	    gloss_binding_new(config, dpy, screen, (struct gloss_binding *)share, &binding))
		return NULL;
	return (GLXContext)binding;
}

GLXContext gloss_glx_create_context(Display *dpy, XVisualInfo *visual, GLXContext share,
				    Bool direct)
{
	(void)direct;
	return context_new(dpy, gloss_glx_config_of_visual(dpy, visual), visual->screen, share);
}

GLXContext gloss_glx_create_new_context(Display *dpy, GLXFBConfig config, int type,
					GLXContext share, Bool direct)
{
	(void)direct;
	if (type != GLX_RGBA_TYPE)
		return NULL;
	return context_new(dpy, (const void *)config, DefaultScreen(dpy), share);
}

/* Versions above 1.x and profiles are for programs with shaders. */
GLXContext gloss_glx_create_context_attribs(Display *dpy, GLXFBConfig config, GLXContext share,
					    Bool direct, const int *attributes)
{
	int major = 1, type = GLX_RGBA_TYPE;

	for (; attributes && attributes[0] != None; attributes += 2) {
		if (attributes[0] == GLX_CONTEXT_MAJOR_VERSION_ARB)
			major = attributes[1];
		else if (attributes[0] == GLX_RENDER_TYPE)
			type = attributes[1];
	}
	return major == 1 ? gloss_glx_create_new_context(dpy, config, type, share, direct) : NULL;
}

void gloss_glx_destroy_context(Display *dpy, GLXContext context)
{
	(void)dpy;
	if (context)
		gloss_binding_destroy((struct gloss_binding *)context);
}

/* Not done: no program is known that calls it. */
void gloss_glx_copy_context(Display *dpy, GLXContext from, GLXContext to, unsigned long mask)
{
	(void)dpy;
	(void)from;
	(void)to;
	(void)mask;
}

Bool gloss_glx_make_context_current(Display *dpy, GLXDrawable draw, GLXDrawable read,
				    GLXContext context)
{
	struct gloss_binding *binding = (struct gloss_binding *)context;
	struct gloss_surface *surfaces[2];
	Bool made = False;

	if (!binding)
		return !gloss_binding_make_current(NULL, NULL, NULL);
	if (!draw || !read)
		return False;
	surfaces[0] = gloss_glx_surface(dpy, draw, binding->config);
	surfaces[1] = gloss_glx_surface(dpy, read, binding->config);
	if (surfaces[0] && surfaces[1])
		made = !gloss_binding_make_current(binding, surfaces[0], surfaces[1]);
	gloss_surface_unref(surfaces[0]);
	gloss_surface_unref(surfaces[1]);
	return made;
}

Bool gloss_glx_make_current(Display *dpy, GLXDrawable drawable, GLXContext context)
{
	return gloss_glx_make_context_current(dpy, drawable, drawable, context);
}

int gloss_glx_query_context(Display *dpy, GLXContext context, int name, int *value)
{
	const struct gloss_binding *binding = (const struct gloss_binding *)context;

	(void)dpy;
	switch (name) {
	case GLX_FBCONFIG_ID:
		*value = binding->config->id;
		return Success;
	case GLX_RENDER_TYPE:
		*value = GLX_RGBA_TYPE;
		return Success;
	case GLX_SCREEN:
		*value = binding->screen;
		return Success;
	default:
		return GLX_BAD_ATTRIBUTE;
	}
}

Bool gloss_glx_is_direct(Display *dpy, GLXContext context)
{
	(void)dpy;
	return context != NULL;
}

void gloss_glx_wait_gl(void)
{
	struct gloss_binding *binding = gloss_binding_current();

	if (binding)
		gloss_context_finish(binding->context);
}

/* What X draws is in its own memory; there is nothing to wait for before drawing on ours. */
void gloss_glx_wait_x(void)
{
}

/* Not done: lists stay empty, and a program's text is not there. */
void gloss_glx_use_x_font(Font font, int first, int count, int list)
{
	(void)font;
	(void)first;
	(void)count;
	(void)list;
}
