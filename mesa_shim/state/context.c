// SPDX-License-Identifier: MIT
#include "state/context.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"
#include "window/settings.h"
#include "window/surface.h"

_Thread_local struct gloss_context *gloss_this;

static const struct {
	const char *name;
	enum accel_shading shading;
} context_shading[] = {
	{ "adaptive", ACCEL_SHADING_ADAPTIVE },
	{ "gouraud", ACCEL_SHADING_GOURAUD },
	{ "quadratic", ACCEL_SHADING_QUADRATIC },
};

/* The number of a shading; one that is none is the first, and told of. */
static size_t context_shading_named(const char *name)
{
	char line[128];

	for (size_t i = 0; i < sizeof(context_shading) / sizeof(*context_shading); i++)
		if (!name || !strcmp(name, context_shading[i].name))
			return i;
	if (secure_getenv("GLOSS_DEBUG")) {
		snprintf(line, sizeof(line),
			 "gloss: no shading is '%.40s'; there are adaptive, gouraud and quadratic",
			 name);
		accel_message_print(NULL, line);
	}
	return 0;
}

/* What the settings say, and GLOSS_DEBUG=perf. */
static void context_configure(struct gloss_context *context)
{
	const char *version = gloss_setting(GLOSS_SETTING_GL_VERSION);
	const char *debug = getenv("GLOSS_DEBUG");
	size_t shading = context_shading_named(gloss_setting(GLOSS_SETTING_SHADING));
	struct accel_device_info info;

	context->shading = context_shading[shading].shading;
	context->tell = debug && strstr(debug, "perf");
	accel_device_info(context->device, &info, sizeof(info));
	snprintf(context->renderer, sizeof(context->renderer), "Gloss %s (%s%s)", info.name,
		 context_shading[shading].name, version ? ", gl_version set" : "");
	snprintf(context->version, sizeof(context->version), "%.8s Gloss",
		 version ? version : "1.1");
}

static bool context_init(struct gloss_context *context, struct gloss_context *share)
{
	context->shared = share ? gloss_shared_ref(share->shared) : gloss_shared_new();
	context->saved = malloc(GLOSS_STACK_DEPTH * sizeof(*context->saved));
	context->saved_client = malloc(GLOSS_STACK_DEPTH * sizeof(*context->saved_client));
	if (!context->shared || !context->saved || !context->saved_client)
		return false;
	if (!gloss_textures_init(context))
		return false;
	if (accel_state_new(&context->state) || accel_state_new(&context->plain) ||
	    accel_draw_new(context->device, &context->draw))
		return false;
	gloss_attributes_init(&context->attributes);
	gloss_client_init(&context->client);
	gloss_matrices_init(&context->matrices);
	gloss_pixel_maps_init(&context->maps);
	gloss_maps_init(&context->evaluators);
	context->render_mode = GL_RENDER;
	context->feedback.type = GL_2D;
	context->immediate.current = &context->attributes.current;
	context->immediate.set = ~0u;
	context->vertices = &context->immediate;
	context->dirty = GLOSS_DIRTY_ALL;
	context_configure(context);
	return true;
}

struct gloss_context *gloss_context_new(struct accel_device *device, struct gloss_context *share)
{
	struct gloss_context *context = calloc(1, sizeof(*context));

	if (!context)
		return NULL;
	context->device = device;
	if (context_init(context, share))
		return context;
	gloss_context_free(context);
	return NULL;
}

void gloss_context_free(struct gloss_context *context)
{
	if (!context)
		return;
	if (gloss_this == context)
		gloss_this = NULL;
	if (context->shared) {
		gloss_list_abandon(context);
		gloss_textures_fini(context);
		gloss_shared_unref(context->shared);
	}
	free(context->queries.place);
	gloss_vertices_free(&context->immediate);
	gloss_vertices_free(&context->compiling.vertices);
	gloss_read_free(context);
	accel_draw_free(context->draw);
	accel_state_free(context->plain);
	accel_state_free(context->state);
	free(context->saved_client);
	free(context->saved);
	free(context);
}

static void context_take_visual(struct gloss_context *context)
{
	const struct gloss_config *config = gloss_surface_config(context->draw_surface);

	context->visual = (struct gloss_visual){
		.red = config->red,
		.green = config->green,
		.blue = config->blue,
		.alpha = config->alpha,
		.depth = config->depth,
		.stencil = config->stencil,
		.double_buffered = config->double_buffered,
	};
}

/* The first surface gives the size of viewport and scissor, and the buffers. */
static void context_bind_first(struct gloss_context *context)
{
	GLenum buffer = context->visual.double_buffered ? GL_BACK : GL_FRONT;
	GLint width = gloss_surface_width(context->draw_surface);
	GLint height = gloss_surface_height(context->draw_surface);
	const GLint box[4] = { 0, 0, width, height };

	memcpy(context->attributes.viewport.box, box, sizeof(box));
	memcpy(context->attributes.scissor.box, box, sizeof(box));
	context->attributes.colour_buffer.draw_buffer = buffer;
	context->attributes.transfer.read_buffer = buffer;
	context->bound_before = true;
}

int gloss_context_bind(struct gloss_context *context, struct gloss_surface *draw,
		       struct gloss_surface *read)
{
	int err = gloss_this ? gloss_context_flush(gloss_this) : 0;

	gloss_this = context;
	if (!context)
		return err;
	context->draw_surface = draw;
	context->read_surface = read;
	context->dirty = GLOSS_DIRTY_ALL;
	gloss_read_forget(context);
	if (draw)
		context_take_visual(context);
	if (draw && !context->bound_before)
		context_bind_first(context);
	return err;
}

int gloss_context_flush(struct gloss_context *context)
{
	int err = 0;

	gloss_list_settle(context);
	if (!context->immediate.inside)
		gloss_batch_draw(context);
	if (context->target)
		err = accel_draw_submit(context->draw, NULL);
	context->target = NULL;
	if (context->draw_surface)
		gloss_surface_flushed(context->draw_surface);
	return err;
}

int gloss_context_finish(struct gloss_context *context)
{
	int err = gloss_context_flush(context);

	return err ? err : accel_device_finish(context->device);
}
