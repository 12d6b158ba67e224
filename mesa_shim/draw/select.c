// SPDX-License-Identifier: MIT
/* Selection: which names were on the stack when something was in view, and how near it was. */
#include <math.h>

#include "draw/batch.h"
#include "state/command.h"

static void select_put(struct gloss_selection *selection, GLuint value)
{
	if (selection->used == selection->size)
		selection->overflow = true;
	else
		selection->buffer[selection->used++] = value;
}

static GLuint select_depth(float depth)
{
	return (GLuint)((double)fminf(fmaxf(depth, 0), 1) * 4294967295.0);
}

/* Before the names change: the hits that there were with them. */
static void select_close(struct gloss_selection *selection)
{
	if (!selection->hit)
		return;
	select_put(selection, (GLuint)selection->names);
	select_put(selection, select_depth(selection->nearest));
	select_put(selection, select_depth(selection->farthest));
	for (GLint i = 0; i < selection->names; i++)
		select_put(selection, selection->name[i]);
	selection->hits++;
	selection->hit = false;
}

void gloss_select_hit(struct gloss_context *context, float depth)
{
	struct gloss_selection *selection = &context->selection;

	if (!selection->hit) {
		selection->nearest = depth;
		selection->farthest = depth;
	}
	selection->hit = true;
	selection->nearest = fminf(selection->nearest, depth);
	selection->farthest = fmaxf(selection->farthest, depth);
}

void gloss_select_begin(struct gloss_context *context)
{
	struct gloss_selection *selection = &context->selection;

	selection->used = selection->names = selection->hits = 0;
	selection->hit = selection->overflow = false;
}

GLint gloss_select_end(struct gloss_context *context)
{
	struct gloss_selection *selection = &context->selection;

	select_close(selection);
	selection->names = 0;
	return selection->overflow ? -1 : selection->hits;
}

void gl_SelectBuffer(GLsizei size, GLuint *buffer)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (size < 0) {
		gloss_error(context, GL_INVALID_VALUE);
	} else if (context->render_mode == GL_SELECT) {
		gloss_error(context, GL_INVALID_OPERATION);
	} else {
		context->selection.buffer = buffer;
		context->selection.size = size;
	}
}

/* The stack, which is about to change; NULL: there is none outside of selection. */
static struct gloss_selection *select_names(struct gloss_context *context)
{
	if (context->render_mode != GL_SELECT)
		return NULL;
	gloss_batch_draw(context);
	select_close(&context->selection);
	return &context->selection;
}

GLOSS_LISTED0(InitNames)
{
	struct gloss_selection *selection = select_names(context);

	if (selection)
		selection->names = 0;
}

GLOSS_LISTED1(LoadName, GLuint, name)
{
	struct gloss_selection *selection = select_names(context);

	if (!selection)
		return;
	if (selection->names)
		selection->name[selection->names - 1] = name;
	else
		gloss_error(context, GL_INVALID_OPERATION);
}

GLOSS_LISTED1(PushName, GLuint, name)
{
	struct gloss_selection *selection = select_names(context);

	if (!selection)
		return;
	if (selection->names < GLOSS_NAME_STACK_DEPTH)
		selection->name[selection->names++] = name;
	else
		gloss_error(context, GL_STACK_OVERFLOW);
}

GLOSS_LISTED0(PopName)
{
	struct gloss_selection *selection = select_names(context);

	if (!selection)
		return;
	if (selection->names)
		selection->names--;
	else
		gloss_error(context, GL_STACK_UNDERFLOW);
}
