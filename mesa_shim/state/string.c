// SPDX-License-Identifier: MIT
#include "state/command.h"

/* Only what is drawn or kept as these say. */
static const char extensions[] = "GL_ARB_multisample "
				 "GL_ARB_transpose_matrix "
				 "GL_ARB_vertex_buffer_object "
				 "GL_ARB_window_pos "
				 "GL_EXT_abgr "
				 "GL_EXT_bgra "
				 "GL_EXT_compiled_vertex_array "
				 "GL_EXT_draw_range_elements "
				 "GL_EXT_multi_draw_arrays "
				 "GL_EXT_packed_pixels "
				 "GL_EXT_rescale_normal "
				 "GL_EXT_vertex_array";

const GLubyte *gl_GetString(GLenum name)
{
	struct gloss_context *context = gloss_outside();
	const char *string = NULL;

	if (!context)
		return NULL;
	switch (name) {
	case GL_VENDOR:
		string = "Gloss";
		break;
	case GL_RENDERER:
		string = context->renderer;
		break;
	case GL_VERSION:
		string = context->version;
		break;
	case GL_EXTENSIONS:
		string = extensions;
		break;
	default:
		gloss_error(context, GL_INVALID_ENUM);
		break;
	}
	return (const GLubyte *)string;
}
