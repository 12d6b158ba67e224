// SPDX-License-Identifier: MIT
/* The stacks of attributes, of the server and of the client. */
#include <string.h>

#include "state/command.h"
#include "state/light.h"
#include "state/table.h"

GLOSS_LISTED1(PushAttrib, GLbitfield, mask)
{
	struct gloss_saved *saved;

	if (context->saved_count == GLOSS_STACK_DEPTH) {
		gloss_error(context, GL_STACK_OVERFLOW);
		return;
	}
	gloss_light_track(context);
	saved = &context->saved[context->saved_count++];
	saved->mask = mask;
	saved->attributes = context->attributes;
	for (int unit = 0; unit < GLOSS_UNITS; unit++)
		for (int kind = 0; kind < GLOSS_TEXTURE_KINDS; kind++)
			saved->sampler[unit][kind] = context->textures.bound[unit][kind]->sampler;
}

/* The textures that were bound are bound again, and are sampled as they were. */
static void push_restore_textures(struct gloss_context *context, const struct gloss_saved *saved)
{
	gloss_textures_rebind(context);
	for (int unit = 0; unit < GLOSS_UNITS; unit++)
		for (int kind = 0; kind < GLOSS_TEXTURE_KINDS; kind++)
			context->textures.bound[unit][kind]->sampler = saved->sampler[unit][kind];
}

/* Vertices that were collected have the current values of their time. */
static unsigned int push_dirty(const struct gloss_row *row)
{
	return row->saved & GL_CURRENT_BIT ? 0 : GLOSS_DIRTY_ALL;
}

/* All units of a row that has some, whichever is active. */
static void push_restore(struct gloss_context *context, const struct gloss_attributes *saved,
			 const struct gloss_row *row)
{
	uint32_t base = (uint32_t)offsetof(struct gloss_context, attributes);
	uint32_t units = row->unit == GLOSS_UNIT_NONE ? 1 : GLOSS_UNITS;

	for (uint32_t i = 0; i < units; i++) {
		uint32_t at = row->offset - base + i * row->stride;
		char *member = (char *)&context->attributes + at;

		if (push_dirty(row))
			gloss_assign(context, push_dirty(row), member, (const char *)saved + at,
				     row->count);
		else
			memcpy(member, (const char *)saved + at, row->count);
	}
}

GLOSS_LISTED0(PopAttrib)
{
	const struct gloss_saved *saved;

	if (!context->saved_count) {
		gloss_error(context, GL_STACK_UNDERFLOW);
		return;
	}
	gloss_light_track(context);
	saved = &context->saved[--context->saved_count];
	for (unsigned int i = 0; i < gloss_table_rows; i++)
		if (gloss_table[i].saved & saved->mask)
			push_restore(context, &saved->attributes, &gloss_table[i]);
	if (saved->mask & GL_TEXTURE_BIT)
		push_restore_textures(context, saved);
}

void gl_PushClientAttrib(GLbitfield mask)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (context->saved_client_count == GLOSS_STACK_DEPTH) {
		gloss_error(context, GL_STACK_OVERFLOW);
		return;
	}
	context->saved_client[context->saved_client_count++] = (struct gloss_saved_client){
		mask, context->client
	};
}

void gl_PopClientAttrib(void)
{
	struct gloss_context *context = gloss_outside();
	const struct gloss_saved_client *saved;

	if (!context)
		return;
	if (!context->saved_client_count) {
		gloss_error(context, GL_STACK_UNDERFLOW);
		return;
	}
	saved = &context->saved_client[--context->saved_client_count];
	if (saved->mask & GL_CLIENT_PIXEL_STORE_BIT) {
		context->client.pack = saved->client.pack;
		context->client.unpack = saved->client.unpack;
	}
	if (saved->mask & GL_CLIENT_VERTEX_ARRAY_BIT)
		context->client.arrays = saved->client.arrays;
}
