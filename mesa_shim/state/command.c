// SPDX-License-Identifier: MIT
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"

static struct gloss_context *command_begin(void)
{
	struct gloss_context *context = gloss_current();

	if (!context)
		return NULL;
	gloss_list_settle(context);
	if (!context->immediate.inside)
		return context;
	gloss_error(context, GL_INVALID_OPERATION);
	return NULL;
}

struct gloss_context *gloss_outside(void)
{
	return command_begin();
}

struct gloss_context *gloss_outside_ordered(void)
{
	struct gloss_context *context = command_begin();

	if (context)
		gloss_batch_draw(context);
	return context;
}

void gloss_change(struct gloss_context *context, unsigned int dirty)
{
	gloss_batch_draw(context);
	context->dirty |= dirty;
}

void gloss_assign(struct gloss_context *context, unsigned int dirty, void *member,
		  const void *value, size_t size)
{
	if (!memcmp(member, value, size))
		return;
	gloss_change(context, dirty);
	memcpy(member, value, size);
}
