// SPDX-License-Identifier: MIT
/* What libGLX of libglvnd asks of a vendor's library. */
#include <glvnd/libglxabi.h>
#include <string.h>

#include "api/proc.h"
#include "window/glx.h"

static const __GLXapiExports *exports;

static const char *glx_string(int name)
{
	switch (name) {
	case GLX_VENDOR:
		return "Gloss";
	case GLX_VERSION:
		return "1.4";
	case GLX_EXTENSIONS:
		return "GLX_ARB_create_context GLX_ARB_get_proc_address GLX_EXT_swap_control "
		       "GLX_EXT_visual_info GLX_EXT_visual_rating GLX_MESA_swap_control "
		       "GLX_SGI_swap_control";
	default:
		return NULL;
	}
}

static const char *glx_client_string(Display *dpy, int name)
{
	(void)dpy;
	return glx_string(name);
}

static const char *glx_server_string(Display *dpy, int screen, int name)
{
	(void)dpy;
	(void)screen;
	return glx_string(name);
}

static const char *glx_extensions_string(Display *dpy, int screen)
{
	return glx_server_string(dpy, screen, GLX_EXTENSIONS);
}

#define PROC(name, function) "glX" #name, (gloss_proc)function

/* In the order of strcmp(). */
static const struct gloss_proc_name glx_procs[] = {
	{ PROC(ChooseFBConfig, gloss_glx_choose_fb_config) },
	{ PROC(ChooseVisual, gloss_glx_choose_visual) },
	{ PROC(CopyContext, gloss_glx_copy_context) },
	{ PROC(CreateContext, gloss_glx_create_context) },
	{ PROC(CreateContextAttribsARB, gloss_glx_create_context_attribs) },
	{ PROC(CreateGLXPixmap, gloss_glx_create_glx_pixmap) },
	{ PROC(CreateNewContext, gloss_glx_create_new_context) },
	{ PROC(CreatePbuffer, gloss_glx_create_pbuffer) },
	{ PROC(CreatePixmap, gloss_glx_create_pixmap) },
	{ PROC(CreateWindow, gloss_glx_create_window) },
	{ PROC(DestroyContext, gloss_glx_destroy_context) },
	{ PROC(DestroyGLXPixmap, gloss_glx_destroy_drawable) },
	{ PROC(DestroyPbuffer, gloss_glx_destroy_drawable) },
	{ PROC(DestroyPixmap, gloss_glx_destroy_drawable) },
	{ PROC(DestroyWindow, gloss_glx_destroy_drawable) },
	{ PROC(GetClientString, glx_client_string) },
	{ PROC(GetConfig, gloss_glx_get_config) },
	{ PROC(GetFBConfigAttrib, gloss_glx_get_fb_config_attrib) },
	{ PROC(GetFBConfigs, gloss_glx_get_fb_configs) },
	{ PROC(GetSelectedEvent, gloss_glx_get_selected_event) },
	{ PROC(GetSwapIntervalMESA, gloss_glx_get_swap_interval_mesa) },
	{ PROC(GetVisualFromFBConfig, gloss_glx_get_visual_from_fb_config) },
	{ PROC(IsDirect, gloss_glx_is_direct) },
	{ PROC(MakeContextCurrent, gloss_glx_make_context_current) },
	{ PROC(MakeCurrent, gloss_glx_make_current) },
	{ PROC(QueryContext, gloss_glx_query_context) },
	{ PROC(QueryDrawable, gloss_glx_query_drawable) },
	{ PROC(QueryExtensionsString, glx_extensions_string) },
	{ PROC(QueryServerString, glx_server_string) },
	{ PROC(SelectEvent, gloss_glx_select_event) },
	{ PROC(SwapBuffers, gloss_glx_swap_buffers) },
	{ PROC(SwapIntervalEXT, gloss_glx_swap_interval_ext) },
	{ PROC(SwapIntervalMESA, gloss_glx_swap_interval_mesa) },
	{ PROC(SwapIntervalSGI, gloss_glx_swap_interval_sgi) },
	{ PROC(UseXFont, gloss_glx_use_x_font) },
	{ PROC(WaitGL, gloss_glx_wait_gl) },
	{ PROC(WaitX, gloss_glx_wait_x) },
};

static void *glx_proc_address(const GLubyte *bytes)
{
	const char *name = (const char *)bytes;
	gloss_proc proc = gloss_proc_search(glx_procs, sizeof(glx_procs) / sizeof(glx_procs[0]),
					    name);

	return (void *)(proc ? proc : gloss_proc_find(name));
}

/*
 * Functions of extensions: which vendor's they are is found out by the vendor that was asked for them.
 * Each calls that vendor's through an index that libGLX gave its name.
 */
enum dispatch { GET_INTERVAL_MESA, INTERVAL_EXT, INTERVAL_MESA, INTERVAL_SGI, DISPATCHES };

static int dispatch_index[DISPATCHES];

static __GLXextFuncPtr dispatch_entry(__GLXvendorInfo *vendor, enum dispatch function)
{
	return vendor ? exports->fetchDispatchEntry(vendor, dispatch_index[function]) : NULL;
}

static int dispatch_get_interval_mesa(void)
{
	int (*entry)(void) = (int (*)(void))dispatch_entry(exports->getCurrentDynDispatch(),
							   GET_INTERVAL_MESA);

	return entry ? entry() : 0;
}

static void dispatch_interval_ext(Display *dpy, GLXDrawable drawable, int interval)
{
	void (*entry)(Display *, GLXDrawable, int) = (void (*)(Display *, GLXDrawable, int))
		dispatch_entry(exports->vendorFromDrawable(dpy, drawable), INTERVAL_EXT);

	if (entry)
		entry(dpy, drawable, interval);
}

static int dispatch_interval_mesa(unsigned int interval)
{
	int (*entry)(unsigned int) = (int (*)(
		unsigned int))dispatch_entry(exports->getCurrentDynDispatch(), INTERVAL_MESA);

	return entry ? entry(interval) : GLX_BAD_CONTEXT;
}

static int dispatch_interval_sgi(int interval)
{
	int (*entry)(int) = (int (*)(int))dispatch_entry(exports->getCurrentDynDispatch(),
							 INTERVAL_SGI);

	return entry ? entry(interval) : GLX_BAD_CONTEXT;
}

/* In the order of strcmp(), which is that of enum dispatch. */
static const struct gloss_proc_name dispatches[DISPATCHES] = {
	[GET_INTERVAL_MESA] = { PROC(GetSwapIntervalMESA, dispatch_get_interval_mesa) },
	[INTERVAL_EXT] = { PROC(SwapIntervalEXT, dispatch_interval_ext) },
	[INTERVAL_MESA] = { PROC(SwapIntervalMESA, dispatch_interval_mesa) },
	[INTERVAL_SGI] = { PROC(SwapIntervalSGI, dispatch_interval_sgi) },
};

static void *glx_dispatch_address(const GLubyte *name)
{
	return (void *)gloss_proc_search(dispatches, DISPATCHES, (const char *)name);
}

static void glx_set_dispatch_index(const GLubyte *name, int index)
{
	for (int i = 0; i < DISPATCHES; i++) {
		if (!strcmp((const char *)name, dispatches[i].name))
			dispatch_index[i] = index;
	}
}

/* Any screen with a visual that has red, green and blue. */
static Bool glx_screen_supported(Display *dpy, int screen)
{
	int count;
	GLXFBConfig *configs = gloss_glx_get_fb_configs(dpy, screen, &count);

	if (configs)
		XFree((void *)configs);
	return count > 0;
}

__attribute__((visibility("default"))) __GLX_MAIN_PROTO(version, theirs, vendor, imports)
{
	(void)vendor;
	if (GLX_VENDOR_ABI_GET_MAJOR_VERSION(version) != GLX_VENDOR_ABI_MAJOR_VERSION)
		return False;
	exports = theirs;
	imports->isScreenSupported = glx_screen_supported;
	imports->getProcAddress = glx_proc_address;
	imports->getDispatchAddress = glx_dispatch_address;
	imports->setDispatchIndex = glx_set_dispatch_index;
	return True;
}
