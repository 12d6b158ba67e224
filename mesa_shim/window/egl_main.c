// SPDX-License-Identifier: MIT
/* What libEGL of libglvnd asks of a vendor's library. */
#include <glvnd/libeglabi.h>
#include <string.h>

#include "api/proc.h"
#include "window/egl.h"
#include "window/egl_objects.h"

static const __EGLapiExports *exports;

#define PROC(name, function) "egl" #name, (gloss_proc)gloss_egl_##function

/* In the order of strcmp(). */
static const struct gloss_proc_name egl_procs[] = {
	{ PROC(BindTexImage, tex_image) },
	{ PROC(ChooseConfig, choose_config) },
	{ PROC(ClientWaitSync, client_wait_sync) },
	{ PROC(CopyBuffers, copy_buffers) },
	{ PROC(CreateContext, create_context) },
	{ PROC(CreatePbufferFromClientBuffer, create_pbuffer_from) },
	{ PROC(CreatePbufferSurface, create_pbuffer) },
	{ PROC(CreatePixmapSurface, create_pixmap) },
	{ PROC(CreatePlatformPixmapSurface, create_platform_pixmap) },
	{ PROC(CreatePlatformWindowSurface, create_platform_window) },
	{ PROC(CreateSync, create_sync) },
	{ PROC(CreateWindowSurface, create_window) },
	{ PROC(DestroyContext, destroy_context) },
	{ PROC(DestroySurface, destroy_surface) },
	{ PROC(DestroySync, destroy_sync) },
	{ PROC(GetConfigAttrib, get_config_attrib) },
	{ PROC(GetConfigs, get_configs) },
	{ PROC(GetError, get_error) },
	{ PROC(GetSyncAttrib, get_sync_attrib) },
	{ PROC(Initialize, initialize) },
	{ PROC(MakeCurrent, make_current) },
	{ PROC(QueryContext, query_context) },
	{ PROC(QueryString, query_string) },
	{ PROC(QuerySurface, query_surface) },
	{ PROC(ReleaseTexImage, tex_image) },
	{ PROC(ReleaseThread, release_thread) },
	{ PROC(SurfaceAttrib, surface_attrib) },
	{ PROC(SwapBuffers, swap_buffers) },
	{ PROC(SwapInterval, swap_interval) },
	{ PROC(Terminate, terminate) },
	{ PROC(WaitClient, wait_client) },
	{ PROC(WaitGL, wait_client) },
	{ PROC(WaitNative, wait_native) },
	{ PROC(WaitSync, wait_sync) },
};

EGLenum gloss_egl_api(void)
{
	return exports->getCurrentApi();
}

static void *egl_proc_address(const char *name)
{
	gloss_proc proc = gloss_proc_search(egl_procs, sizeof(egl_procs) / sizeof(egl_procs[0]),
					    name);

	return (void *)(proc ? proc : gloss_proc_find(name));
}

/* All functions have their dispatch in libEGL: what is claimed adds none. */
static void *egl_dispatch_address(const char *name)
{
	(void)name;
	return NULL;
}

static void egl_set_dispatch_index(const char *name, int index)
{
	(void)name;
	(void)index;
}

static EGLBoolean egl_supports_api(EGLenum api)
{
	return api == EGL_OPENGL_API;
}

static const char *egl_vendor_string(int name)
{
	return name == __EGL_VENDOR_STRING_PLATFORM_EXTENSIONS ? GLOSS_EGL_PLATFORMS : NULL;
}

__attribute__((visibility("default"))) EGLBoolean __egl_Main(uint32_t version,
							     const __EGLapiExports *theirs,
							     __EGLvendorInfo *vendor,
							     __EGLapiImports *imports)
{
	(void)vendor;
	if (EGL_VENDOR_ABI_GET_MAJOR_VERSION(version) != EGL_VENDOR_ABI_MAJOR_VERSION)
		return EGL_FALSE;
	exports = theirs;
	imports->getPlatformDisplay = gloss_egl_platform_display;
	imports->getSupportsAPI = egl_supports_api;
	imports->getVendorString = egl_vendor_string;
	imports->getProcAddress = egl_proc_address;
	imports->getDispatchAddress = egl_dispatch_address;
	imports->setDispatchIndex = egl_set_dispatch_index;
	return EGL_TRUE;
}
