// SPDX-License-Identifier: MIT
#include <stdlib.h>

#include "accel.h"
#include "window/config.h"
#include "window/glx.h"

#define DONT_CARE ((int)GLX_DONT_CARE)

/* Those of GLX 1.4, table 3.4, with what a program wants that does not name them. */
static const struct gloss_criterion criteria[] = {
	{ GLX_FBCONFIG_ID, GLOSS_MATCH_EXACT, DONT_CARE },
	{ GLX_BUFFER_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_LEVEL, GLOSS_MATCH_EXACT, 0 },
	{ GLX_DOUBLEBUFFER, GLOSS_MATCH_EXACT, DONT_CARE },
	{ GLX_STEREO, GLOSS_MATCH_EXACT, False },
	{ GLX_AUX_BUFFERS, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_RED_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_GREEN_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_BLUE_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_ALPHA_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_DEPTH_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_STENCIL_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_ACCUM_RED_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_ACCUM_GREEN_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_ACCUM_BLUE_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_ACCUM_ALPHA_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_RENDER_TYPE, GLOSS_MATCH_MASK, GLX_RGBA_BIT },
	{ GLX_DRAWABLE_TYPE, GLOSS_MATCH_MASK, GLX_WINDOW_BIT },
	{ GLX_X_RENDERABLE, GLOSS_MATCH_EXACT, DONT_CARE },
	{ GLX_X_VISUAL_TYPE, GLOSS_MATCH_EXACT, DONT_CARE },
	{ GLX_CONFIG_CAVEAT, GLOSS_MATCH_EXACT, DONT_CARE },
	{ GLX_TRANSPARENT_TYPE, GLOSS_MATCH_EXACT, GLX_NONE },
	{ GLX_SAMPLE_BUFFERS, GLOSS_MATCH_AT_LEAST, 0 },
	{ GLX_SAMPLES, GLOSS_MATCH_AT_LEAST, 0 },
};

#define CRITERIA ((int)(sizeof(criteria) / sizeof(criteria[0])))

/* Visuals of a screen that have formats; freed by XFree. The root's comes first. */
static XVisualInfo *config_visuals(Display *dpy, int screen, int *count)
{
	XVisualInfo wanted = { .screen = screen,
			       .depth = DefaultDepth(dpy, screen),
			       .class = TrueColor };
	XVisualInfo *visuals = XGetVisualInfo(dpy,
					      VisualScreenMask | VisualDepthMask | VisualClassMask,
					      &wanted, count);
	VisualID root = XVisualIDFromVisual(DefaultVisual(dpy, screen));

	for (int i = 1; visuals && i < *count; i++) {
		if (visuals[i].visualid == root) {
			XVisualInfo first = visuals[0];

			visuals[0] = visuals[i];
			visuals[i] = first;
		}
	}
	if (!visuals)
		*count = 0;
	if (*count > GLOSS_CONFIGS)
		*count = GLOSS_CONFIGS;
	return visuals;
}

const struct gloss_config *gloss_glx_config_of_visual(Display *dpy, const XVisualInfo *visual)
{
	XVisualInfo *visuals;
	int count, found = 0;

	if (visual->class != TrueColor && visual->class != DirectColor)
		return NULL;
	visuals = config_visuals(dpy, visual->screen, &count);
	for (int i = 0; i < count; i++) {
		if (visuals[i].visualid == visual->visualid)
			found = i;
	}
	if (visuals)
		XFree(visuals);
	return &gloss_configs[found];
}

/* 0: the screen has no visual with colours. */
static VisualID config_visual_id(Display *dpy, int screen, const struct gloss_config *config)
{
	int count, place = (int)(config - gloss_configs);
	XVisualInfo *visuals = config_visuals(dpy, screen, &count);
	VisualID id = 0;

	if (count)
		id = visuals[place < count ? place : 0].visualid;
	if (visuals)
		XFree(visuals);
	return id;
}

static int config_size(const struct gloss_config *config, int name)
{
	switch (name) {
	case GLX_BUFFER_SIZE:
		return config->red + config->green + config->blue + config->alpha;
	case GLX_RED_SIZE:
		return config->red;
	case GLX_GREEN_SIZE:
		return config->green;
	case GLX_BLUE_SIZE:
		return config->blue;
	case GLX_ALPHA_SIZE:
		return config->alpha;
	case GLX_DEPTH_SIZE:
		return config->depth;
	case GLX_STENCIL_SIZE:
		return config->stencil;
	case GLX_MAX_PBUFFER_WIDTH:
	case GLX_MAX_PBUFFER_HEIGHT:
		return ACCEL_TARGET_SIZE_MAX;
	case GLX_MAX_PBUFFER_PIXELS:
		return ACCEL_TARGET_SIZE_MAX * ACCEL_TARGET_SIZE_MAX;
	default:
		return 0;
	}
}

static int config_value(const struct gloss_config *config, int name)
{
	switch (name) {
	case GLX_FBCONFIG_ID:
		return config->id;
	case GLX_DOUBLEBUFFER:
		return config->double_buffered;
	case GLX_RENDER_TYPE:
		return GLX_RGBA_BIT;
	case GLX_DRAWABLE_TYPE:
		return GLX_WINDOW_BIT | GLX_PIXMAP_BIT | GLX_PBUFFER_BIT;
	case GLX_X_RENDERABLE:
		return True;
	case GLX_X_VISUAL_TYPE:
		return GLX_TRUE_COLOR;
	case GLX_CONFIG_CAVEAT:
		return gloss_config_conformant(config) ? GLX_NONE : GLX_NON_CONFORMANT_CONFIG;
	case GLX_TRANSPARENT_TYPE:
		return GLX_NONE;
	default:
		return config_size(config, name);
	}
}

static bool config_matches(const struct gloss_config *config, const int *pairs,
			   const struct gloss_criterion *criterion)
{
	const int wanted = gloss_criterion_wanted(criterion, pairs, None);

	return wanted == DONT_CARE ||
	       gloss_criterion_met(criterion, config_value(config, criterion->name), wanted);
}

/* Of the first @most formats, those that match. */
static int config_list(const int *wanted, int most, const struct gloss_config **list)
{
	static const struct gloss_criterion alpha = { GLX_ALPHA_SIZE, GLOSS_MATCH_AT_LEAST, 0 };
	int count = 0;

	for (int i = 0; i < most; i++) {
		bool matches = true;

		for (int a = 0; matches && a < CRITERIA; a++)
			matches = config_matches(&gloss_configs[i], wanted, &criteria[a]);
		if (matches)
			list[count++] = &gloss_configs[i];
	}
	gloss_config_sort(list, count, gloss_criterion_wanted(&alpha, wanted, None) > 0);
	return count;
}

GLXFBConfig *gloss_glx_choose_fb_config(Display *dpy, int screen, const int *wanted, int *count)
{
	const struct gloss_config *list[GLOSS_CONFIGS];
	int visuals, found = config_list(wanted, GLOSS_CONFIGS, list);
	XVisualInfo *any = config_visuals(dpy, screen, &visuals);
	GLXFBConfig *configs;

	*count = 0;
	if (!any)
		return NULL;
	XFree(any);
	/* For the program to XFree, which is free. */
	configs = found ? (GLXFBConfig *)calloc((size_t)found, sizeof(GLXFBConfig)) : NULL;
	if (!configs)
		return NULL;
	for (int i = 0; i < found; i++)
		configs[i] = (GLXFBConfig)list[i];
	*count = found;
	return configs;
}

GLXFBConfig *gloss_glx_get_fb_configs(Display *dpy, int screen, int *count)
{
	return gloss_glx_choose_fb_config(dpy, screen, NULL, count);
}

static const struct gloss_config *config_of(GLXFBConfig handle)
{
	for (int i = 0; i < GLOSS_CONFIGS; i++) {
		if ((const void *)handle == &gloss_configs[i])
			return &gloss_configs[i];
	}
	return NULL;
}

int gloss_glx_get_fb_config_attrib(Display *dpy, GLXFBConfig handle, int name, int *value)
{
	const struct gloss_config *config = config_of(handle);

	if (!config)
		return GLX_BAD_VALUE;
	if (name == GLX_VISUAL_ID)
		*value = (int)config_visual_id(dpy, DefaultScreen(dpy), config);
	else
		*value = config_value(config, name);
	return Success;
}

static XVisualInfo *config_visual_info(Display *dpy, int screen, const struct gloss_config *config)
{
	XVisualInfo wanted = { .screen = screen,
			       .visualid = config_visual_id(dpy, screen, config) };
	int count;

	return XGetVisualInfo(dpy, VisualScreenMask | VisualIDMask, &wanted, &count);
}

XVisualInfo *gloss_glx_get_visual_from_fb_config(Display *dpy, GLXFBConfig handle)
{
	const struct gloss_config *config = config_of(handle);

	return config ? config_visual_info(dpy, DefaultScreen(dpy), config) : NULL;
}

/* glXChooseVisual's list has some attributes without a value, which are false unless they are there. */
static bool visual_pairs(const int *wanted, int *pairs, int most)
{
	bool rgba = false, twice = false, stereo = false;
	int count = 0;

	for (; *wanted != None; wanted++) {
		if (*wanted == GLX_USE_GL)
			continue;
		if (*wanted == GLX_RGBA || *wanted == GLX_DOUBLEBUFFER || *wanted == GLX_STEREO) {
			rgba |= *wanted == GLX_RGBA;
			twice |= *wanted == GLX_DOUBLEBUFFER;
			stereo |= *wanted == GLX_STEREO;
			continue;
		}
		if (count + 4 > most)
			return false;
		pairs[count++] = *wanted++;
		pairs[count++] = *wanted;
	}
	pairs[count++] = GLX_DOUBLEBUFFER;
	pairs[count++] = twice;
	pairs[count] = None;
	return rgba && !stereo;
}

XVisualInfo *gloss_glx_choose_visual(Display *dpy, int screen, int *wanted)
{
	const struct gloss_config *list[GLOSS_CONFIGS];
	XVisualInfo *visuals;
	int pairs[128], count;

	if (!visual_pairs(wanted, pairs, 125))
		return NULL;
	visuals = config_visuals(dpy, screen, &count);
	if (visuals)
		XFree(visuals);
	if (!config_list(pairs, count, list))
		return NULL;
	return config_visual_info(dpy, screen, list[0]);
}

int gloss_glx_get_config(Display *dpy, XVisualInfo *visual, int name, int *value)
{
	const struct gloss_config *config = gloss_glx_config_of_visual(dpy, visual);

	if (name == GLX_USE_GL)
		*value = config != NULL;
	else if (!config)
		return GLX_BAD_VISUAL;
	else if (name == GLX_RGBA)
		*value = True;
	else
		*value = config_value(config, name);
	return Success;
}
