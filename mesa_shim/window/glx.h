/* SPDX-License-Identifier: MIT */
/*
 * GLX 1.4 behind libglvnd's libGLX, which knows whose contexts, formats and drawables are. A GLXContext is
 * the address of a gloss_binding, a GLXFBConfig that of a gloss_config. What fails returns GLX's zero and
 * raises no error of X.
 */
#ifndef GLOSS_GLX_H
#define GLOSS_GLX_H

#include <GL/glx.h>
#include <stdbool.h>

struct gloss_config;
struct gloss_surface;

/* ---- formats ---- */

/*
 * The formats have visuals of the screen, in order: the root's and those that are like it. A screen
 * that has fewer gives the others the root's, for FBConfigs only. NULL: @visual has no colours.
 */
const struct gloss_config *gloss_glx_config_of_visual(Display *dpy, const XVisualInfo *visual);

GLXFBConfig *gloss_glx_get_fb_configs(Display *dpy, int screen, int *count);
GLXFBConfig *gloss_glx_choose_fb_config(Display *dpy, int screen, const int *wanted, int *count);
int gloss_glx_get_fb_config_attrib(Display *dpy, GLXFBConfig config, int name, int *value);
XVisualInfo *gloss_glx_get_visual_from_fb_config(Display *dpy, GLXFBConfig config);
XVisualInfo *gloss_glx_choose_visual(Display *dpy, int screen, int *wanted);
int gloss_glx_get_config(Display *dpy, XVisualInfo *visual, int name, int *value);

/* ---- drawables ---- */

/*
 * A reference to the surface of @id, which is made if it is a window that has none yet. NULL: there is
 * no such drawable. @config is for such a window.
 */
struct gloss_surface *gloss_glx_surface(Display *dpy, XID id, const struct gloss_config *config);

GLXWindow gloss_glx_create_window(Display *dpy, GLXFBConfig config, Window window,
				  const int *attributes);
GLXPixmap gloss_glx_create_pixmap(Display *dpy, GLXFBConfig config, Pixmap pixmap,
				  const int *attributes);
GLXPixmap gloss_glx_create_glx_pixmap(Display *dpy, XVisualInfo *visual, Pixmap pixmap);
GLXPbuffer gloss_glx_create_pbuffer(Display *dpy, GLXFBConfig config, const int *attributes);
void gloss_glx_destroy_drawable(Display *dpy, GLXDrawable drawable);
void gloss_glx_query_drawable(Display *dpy, GLXDrawable drawable, int name, unsigned int *value);
void gloss_glx_swap_buffers(Display *dpy, GLXDrawable drawable);
void gloss_glx_swap_interval_ext(Display *dpy, GLXDrawable drawable, int interval);
int gloss_glx_swap_interval_mesa(unsigned int interval);
int gloss_glx_get_swap_interval_mesa(void);
int gloss_glx_swap_interval_sgi(int interval);
void gloss_glx_select_event(Display *dpy, GLXDrawable drawable, unsigned long mask);
void gloss_glx_get_selected_event(Display *dpy, GLXDrawable drawable, unsigned long *mask);

/* ---- contexts ---- */

GLXContext gloss_glx_create_context(Display *dpy, XVisualInfo *visual, GLXContext share,
				    Bool direct);
GLXContext gloss_glx_create_new_context(Display *dpy, GLXFBConfig config, int type,
					GLXContext share, Bool direct);
GLXContext gloss_glx_create_context_attribs(Display *dpy, GLXFBConfig config, GLXContext share,
					    Bool direct, const int *attributes);
void gloss_glx_destroy_context(Display *dpy, GLXContext context);
void gloss_glx_copy_context(Display *dpy, GLXContext from, GLXContext to, unsigned long mask);
Bool gloss_glx_make_current(Display *dpy, GLXDrawable drawable, GLXContext context);
Bool gloss_glx_make_context_current(Display *dpy, GLXDrawable draw, GLXDrawable read,
				    GLXContext context);
int gloss_glx_query_context(Display *dpy, GLXContext context, int name, int *value);
Bool gloss_glx_is_direct(Display *dpy, GLXContext context);
void gloss_glx_wait_gl(void);
void gloss_glx_wait_x(void);
void gloss_glx_use_x_font(Font font, int first, int count, int list);

#endif
