// SPDX-License-Identifier: MIT
#include "accel.h"
#include "window/config.h"
#include "window/egl.h"

/* Those of EGL 1.5, table 3.4, with what a program wants that does not name them. */
static const struct gloss_criterion criteria[] = {
	{ EGL_BUFFER_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_RED_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_GREEN_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_BLUE_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_LUMINANCE_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_ALPHA_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_ALPHA_MASK_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_BIND_TO_TEXTURE_RGB, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_BIND_TO_TEXTURE_RGBA, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_COLOR_BUFFER_TYPE, GLOSS_MATCH_EXACT, EGL_RGB_BUFFER },
	{ EGL_CONFIG_CAVEAT, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_CONFIG_ID, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_CONFORMANT, GLOSS_MATCH_MASK, 0 },
	{ EGL_DEPTH_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_LEVEL, GLOSS_MATCH_EXACT, 0 },
	{ EGL_MATCH_NATIVE_PIXMAP, GLOSS_MATCH_IGNORED, EGL_NONE },
	{ EGL_MAX_PBUFFER_WIDTH, GLOSS_MATCH_IGNORED, EGL_DONT_CARE },
	{ EGL_MAX_PBUFFER_HEIGHT, GLOSS_MATCH_IGNORED, EGL_DONT_CARE },
	{ EGL_MAX_PBUFFER_PIXELS, GLOSS_MATCH_IGNORED, EGL_DONT_CARE },
	{ EGL_MAX_SWAP_INTERVAL, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_MIN_SWAP_INTERVAL, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_NATIVE_RENDERABLE, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_NATIVE_VISUAL_ID, GLOSS_MATCH_IGNORED, EGL_DONT_CARE },
	{ EGL_NATIVE_VISUAL_TYPE, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_RENDERABLE_TYPE, GLOSS_MATCH_MASK, EGL_OPENGL_ES_BIT },
	{ EGL_SAMPLE_BUFFERS, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_SAMPLES, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_STENCIL_SIZE, GLOSS_MATCH_AT_LEAST, 0 },
	{ EGL_SURFACE_TYPE, GLOSS_MATCH_MASK, EGL_WINDOW_BIT },
	{ EGL_TRANSPARENT_TYPE, GLOSS_MATCH_EXACT, EGL_NONE },
	{ EGL_TRANSPARENT_RED_VALUE, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_TRANSPARENT_GREEN_VALUE, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
	{ EGL_TRANSPARENT_BLUE_VALUE, GLOSS_MATCH_EXACT, EGL_DONT_CARE },
};

#define CRITERIA ((int)(sizeof(criteria) / sizeof(criteria[0])))

/* Windows take any visual with red, green and blue; the root's is as good as another. */
static EGLint config_visual(const struct egl_display *display)
{
	xcb_screen_iterator_t screen;

	if (!display->connection)
		return 0;
	screen = xcb_setup_roots_iterator(xcb_get_setup(display->connection));
	return screen.rem ? (EGLint)screen.data->root_visual : 0;
}

static EGLint config_size(const struct gloss_config *config, EGLint name)
{
	switch (name) {
	case EGL_BUFFER_SIZE:
		return config->red + config->green + config->blue + config->alpha;
	case EGL_RED_SIZE:
		return config->red;
	case EGL_GREEN_SIZE:
		return config->green;
	case EGL_BLUE_SIZE:
		return config->blue;
	case EGL_ALPHA_SIZE:
		return config->alpha;
	case EGL_DEPTH_SIZE:
		return config->depth;
	case EGL_STENCIL_SIZE:
		return config->stencil;
	case EGL_MAX_PBUFFER_WIDTH:
	case EGL_MAX_PBUFFER_HEIGHT:
		return ACCEL_TARGET_SIZE_MAX;
	case EGL_MAX_PBUFFER_PIXELS:
		return ACCEL_TARGET_SIZE_MAX * ACCEL_TARGET_SIZE_MAX;
	default:
		return 0;
	}
}

static EGLint config_value(const struct egl_display *display, const struct gloss_config *config,
			   EGLint name)
{
	switch (name) {
	case EGL_CONFIG_ID:
		return config->id;
	case EGL_COLOR_BUFFER_TYPE:
		return EGL_RGB_BUFFER;
	case EGL_CONFIG_CAVEAT:
		return gloss_config_conformant(config) ? EGL_NONE : EGL_NON_CONFORMANT_CONFIG;
	case EGL_CONFORMANT:
		return gloss_config_conformant(config) ? EGL_OPENGL_BIT : 0;
	case EGL_MAX_SWAP_INTERVAL:
		return display->connection ? 1 : 0;
	case EGL_NATIVE_RENDERABLE:
		return display->connection ? EGL_TRUE : EGL_FALSE;
	case EGL_NATIVE_VISUAL_ID:
		return config_visual(display);
	case EGL_NATIVE_VISUAL_TYPE:
		return display->connection ? XCB_VISUAL_CLASS_TRUE_COLOR : EGL_NONE;
	case EGL_RENDERABLE_TYPE:
		return EGL_OPENGL_BIT;
	case EGL_SURFACE_TYPE:
		return EGL_PBUFFER_BIT |
		       (display->connection ? EGL_WINDOW_BIT | EGL_PIXMAP_BIT : 0);
	case EGL_TRANSPARENT_TYPE:
		return EGL_NONE;
	default:
		return config_size(config, name);
	}
}

/*
 * Programs that ask for OpenGL ES, which is the default too, and bind OpenGL then, as the screen
 * savers of xscreensaver do, get what they want.
 */
static bool config_matches(const struct egl_display *display, const struct gloss_config *config,
			   const EGLint *pairs, const struct gloss_criterion *criterion)
{
	EGLint wanted = gloss_criterion_wanted(criterion, pairs, EGL_NONE);

	if (wanted == EGL_DONT_CARE)
		return true;
	if (criterion->name == EGL_RENDERABLE_TYPE)
		wanted &= ~EGL_OPENGL_ES_BIT;
	return gloss_criterion_met(criterion, config_value(display, config, criterion->name),
				   wanted);
}

/* EGL's windows have a back buffer, so single-buffered formats are GLX's alone. */
static int config_list(const struct egl_display *display, const EGLint *wanted,
		       const struct gloss_config **list)
{
	static const struct gloss_criterion alpha = { EGL_ALPHA_SIZE, GLOSS_MATCH_AT_LEAST, 0 };
	int count = 0;

	for (int i = 0; i < GLOSS_CONFIGS; i++) {
		bool matches = gloss_configs[i].double_buffered;

		for (int a = 0; matches && a < CRITERIA; a++)
			matches = config_matches(display, &gloss_configs[i], wanted, &criteria[a]);
		if (matches)
			list[count++] = &gloss_configs[i];
	}
	gloss_config_sort(list, count, gloss_criterion_wanted(&alpha, wanted, EGL_NONE) > 0);
	return count;
}

static EGLBoolean config_give(const struct gloss_config *const *list, int found, EGLConfig *configs,
			      EGLint size, EGLint *count)
{
	if (configs && found > size)
		found = size > 0 ? size : 0;
	for (int i = 0; configs && i < found; i++)
		configs[i] = (EGLConfig)list[i];
	*count = found;
	return gloss_egl_result(EGL_SUCCESS);
}

EGLBoolean gloss_egl_choose_config(EGLDisplay dpy, const EGLint *wanted, EGLConfig *configs,
				   EGLint size, EGLint *count)
{
	const struct gloss_config *list[GLOSS_CONFIGS];
	int found;

	if (!gloss_egl_ready(dpy))
		return EGL_FALSE;
	if (!count)
		return gloss_egl_result(EGL_BAD_PARAMETER);
	for (const EGLint *pair = wanted; pair && pair[0] != EGL_NONE; pair += 2) {
		if (!gloss_criterion_find(criteria, CRITERIA, pair[0]))
			return gloss_egl_result(EGL_BAD_ATTRIBUTE);
	}
	found = config_list(dpy, wanted, list);
	return config_give(list, found, configs, size, count);
}

EGLBoolean gloss_egl_get_configs(EGLDisplay dpy, EGLConfig *configs, EGLint size, EGLint *count)
{
	static const EGLint all[] = { EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE };
	const struct gloss_config *list[GLOSS_CONFIGS];
	int found;

	if (!gloss_egl_ready(dpy))
		return EGL_FALSE;
	if (!count)
		return gloss_egl_result(EGL_BAD_PARAMETER);
	found = config_list(dpy, all, list);
	return config_give(list, found, configs, size, count);
}

const struct gloss_config *gloss_egl_config(struct egl_display *display, EGLConfig config)
{
	if (!gloss_egl_ready(display))
		return NULL;
	for (int i = 0; i < GLOSS_CONFIGS; i++) {
		if (config == &gloss_configs[i] && gloss_configs[i].double_buffered)
			return &gloss_configs[i];
	}
	gloss_egl_result(EGL_BAD_CONFIG);
	return NULL;
}

EGLBoolean gloss_egl_get_config_attrib(EGLDisplay dpy, EGLConfig handle, EGLint name, EGLint *value)
{
	const struct gloss_config *config = gloss_egl_config(dpy, handle);

	if (!config)
		return EGL_FALSE;
	if (!value)
		return gloss_egl_result(EGL_BAD_PARAMETER);
	if (!gloss_criterion_find(criteria, CRITERIA, name) || name == EGL_MATCH_NATIVE_PIXMAP)
		return gloss_egl_result(EGL_BAD_ATTRIBUTE);
	*value = config_value(dpy, config, name);
	return gloss_egl_result(EGL_SUCCESS);
}
