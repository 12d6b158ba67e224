// SPDX-License-Identifier: MIT
/* What a list is made of, and how it is played. */
#include "draw/list.h"

#include <stdlib.h>
#include <string.h>

#include "draw/batch.h"
#include "draw/list_priv.h"
#include "state/command.h"

/* The bits of enum gloss_set, and where in a vertex their values are. */
static const struct {
	unsigned int set;
	size_t offset, size;
} list_attribute[] = {
	{ GLOSS_SET_COLOUR, offsetof(struct gloss_vertex, colour), 4 * sizeof(GLfloat) },
	{ GLOSS_SET_NORMAL, offsetof(struct gloss_vertex, normal), 3 * sizeof(GLfloat) },
	{ GLOSS_SET_EDGE, offsetof(struct gloss_vertex, edge), sizeof(GLfloat) },
};

#define LIST_ATTRIBUTES (sizeof(list_attribute) / sizeof(list_attribute[0]))

void gloss_list_set(struct gloss_vertices *vertices, unsigned int set)
{
	vertices->set |= set;
	for (size_t i = 0; i < LIST_ATTRIBUTES; i++)
		if (set == list_attribute[i].set)
			vertices->unset[i] = vertices->vertices;
}

bool gloss_list_is_loose(const struct gloss_context *context)
{
	const struct gloss_vertices *vertices = context->vertices;

	return vertices != &context->immediate && !vertices->primitives && !vertices->ended;
}

void gloss_list_end(struct gloss_context *context)
{
	if (!gloss_list_is_loose(context))
		return;
	context->vertices->ended = true;
	context->vertices->loose = context->vertices->vertices;
}

/* A node at the end of the open list, with room for @size bytes; NULL: out of memory. */
static struct gloss_node *list_append(struct gloss_context *context, gloss_play_fn play,
				      size_t size)
{
	struct gloss_list *list = context->compiling.list;
	struct gloss_node *node = malloc(sizeof(*node) + size);

	if (!node) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return NULL;
	}
	*node = (struct gloss_node){ .play = play };
	*list->end = node;
	list->end = &node->next;
	return node;
}

/* The vertices and primitives of a node, in memory of their own. */
static bool list_copy(struct gloss_vertices *to, const struct gloss_vertices *from)
{
	*to = *from;
	to->vertex_room = to->primitive_room = 0;
	to->vertex = NULL;
	to->primitive = NULL;
	to->vertex = malloc((from->vertices + 1) * sizeof(*to->vertex));
	to->primitive = malloc((from->primitives + 1) * sizeof(*to->primitive));
	if (!to->vertex || !to->primitive) {
		gloss_vertices_free(to);
		return false;
	}
	if (from->vertices)
		memcpy(to->vertex, from->vertex, from->vertices * sizeof(*to->vertex));
	if (from->primitives)
		memcpy(to->primitive, from->primitive, from->primitives * sizeof(*to->primitive));
	return true;
}

/* Of the next node nothing is known yet. */
static void list_restart(struct gloss_vertices *vertices)
{
	gloss_vertices_clear(vertices);
	vertices->inside = false;
	vertices->ended = false;
	vertices->loose = 0;
	vertices->set = 0;
}

/* Where vertices of the node stand that take the values of when it is played. */
static void list_close_attributes(struct gloss_vertices *vertices)
{
	for (size_t i = 0; i < LIST_ATTRIBUTES; i++)
		if (!(vertices->set & list_attribute[i].set))
			vertices->unset[i] = vertices->vertices;
	if (!vertices->primitives && !vertices->ended)
		vertices->loose = vertices->vertices;
}

static void play_vertices(struct gloss_context *context, const void *call);

/* What was collected becomes a node. */
static void list_close(struct gloss_context *context)
{
	struct gloss_vertices *vertices = &context->compiling.vertices;
	struct gloss_vertices_node *part;
	struct gloss_node *node;

	if (!vertices->vertices && !vertices->primitives && !vertices->set && !vertices->ended)
		return;
	list_close_attributes(vertices);
	node = list_append(context, play_vertices, sizeof(*part));
	if (node) {
		part = (struct gloss_vertices_node *)node->call;
		part->current = context->compiling.current;
		if (list_copy(&part->vertices, vertices)) {
			node->vertices = &part->vertices;
			node->inside = true;
		} else {
			gloss_error(context, GL_OUT_OF_MEMORY);
			memset(&part->vertices, 0, sizeof(part->vertices));
		}
		if (context->compiling.mode == GL_COMPILE_AND_EXECUTE)
			play_vertices(context, part);
	}
	list_restart(vertices);
}

void gloss_list_settle(struct gloss_context *context)
{
	if (context->compiling.list)
		list_close(context);
}

static struct gloss_context *list_record(gloss_play_fn play, const void *call, size_t size,
					 bool inside)
{
	struct gloss_context *context = gloss_current();
	struct gloss_node *node;

	if (!context)
		return NULL;
	if (context->compiling.list) {
		list_close(context);
		node = list_append(context, play, size);
		if (node && size)
			memcpy(node->call, call, size);
		if (node)
			node->inside = inside;
		if (context->compiling.mode == GL_COMPILE)
			return NULL;
	}
	if (!context->immediate.inside || inside)
		return context;
	gloss_error(context, GL_INVALID_OPERATION);
	return NULL;
}

struct gloss_context *gloss_listed(gloss_play_fn play, const void *call, size_t size)
{
	return list_record(play, call, size, false);
}

struct gloss_context *gloss_listed_inside(gloss_play_fn play, const void *call, size_t size)
{
	return list_record(play, call, size, true);
}

/* Vertices of the node from @first to @end, with the current values where the list has none. */
static void list_append_vertices(struct gloss_context *context, const struct gloss_vertices *part,
				 uint32_t first, uint32_t end)
{
	struct gloss_vertices *vertices = &context->immediate;
	const char *current = (const char *)&context->attributes.current.vertex;
	struct gloss_vertex *to;

	if (first == end)
		return;
	to = vertices->vertex + vertices->vertices;
	memcpy(to, part->vertex + first, (end - first) * sizeof(*to));
	for (size_t i = 0; i < LIST_ATTRIBUTES; i++)
		for (uint32_t j = first; j < end && j < part->unset[i]; j++)
			memcpy((char *)&to[j - first] + list_attribute[i].offset,
			       current + list_attribute[i].offset, list_attribute[i].size);
	vertices->vertices += end - first;
}

static void list_play_primitives(struct gloss_context *context, const struct gloss_vertices *part)
{
	struct gloss_vertices *vertices = &context->immediate;

	for (uint32_t i = 0; i < part->primitives; i++) {
		const struct accel_primitive *primitive = &part->primitive[i];
		bool last = i + 1 == part->primitives;
		uint32_t end = last ? part->vertices : part->primitive[i + 1].first;

		gloss_vertices_begin(vertices, (GLenum)primitive->topology);
		if (!vertices->inside)
			return;
		list_append_vertices(context, part, primitive->first, end);
		if (!last || !part->inside)
			gloss_vertices_end(vertices);
	}
}

/* What the current values are after the node. */
static void list_play_current(struct gloss_context *context, unsigned int set,
			      const struct gloss_current *from)
{
	struct gloss_current *to = &context->attributes.current;

	for (size_t i = 0; i < LIST_ATTRIBUTES; i++)
		if (set & list_attribute[i].set)
			memcpy((char *)&to->vertex + list_attribute[i].offset,
			       (const char *)&from->vertex + list_attribute[i].offset,
			       list_attribute[i].size);
	if (set & GLOSS_SET_SECONDARY)
		memcpy(to->secondary, from->secondary, sizeof(to->secondary));
	if (set & GLOSS_SET_FOG)
		to->fog = from->fog;
	if (set & GLOSS_SET_INDEX)
		to->index = from->index;
	for (int i = 0; i < GLOSS_UNITS; i++)
		if (set & GLOSS_SET_TEXCOORD << i)
			memcpy(to->texcoord[i], from->texcoord[i], sizeof(to->texcoord[i]));
}

static void play_vertices(struct gloss_context *context, const void *call)
{
	const struct gloss_vertices_node *node = call;
	const struct gloss_vertices *part = &node->vertices;
	struct gloss_vertices *vertices = &context->immediate;

	if (!vertices->inside && vertices->vertices >= GLOSS_BATCH_MAX)
		gloss_batch_draw(context);
	if (!gloss_vertices_reserve(vertices, part->vertices))
		return;
	if (vertices->inside)
		list_append_vertices(context, part, 0, part->loose);
	if (part->ended && vertices->inside)
		gloss_vertices_end(vertices);
	else if (part->ended)
		gloss_error(context, GL_INVALID_OPERATION);
	if (part->primitives && vertices->inside)
		gloss_error(context, GL_INVALID_OPERATION);
	else
		list_play_primitives(context, part);
	list_play_current(context, part->set, &node->current);
}

void gloss_list_play(struct gloss_context *context, const struct gloss_list *list)
{
	for (const struct gloss_node *node = list->first; node; node = node->next)
		if (node->inside || !context->immediate.inside)
			node->play(context, node->call);
		else
			gloss_error(context, GL_INVALID_OPERATION);
}

struct gloss_list *gloss_list_new(void)
{
	struct gloss_list *list = calloc(1, sizeof(*list));

	if (!list)
		return NULL;
	list->references = 1;
	list->end = &list->first;
	return list;
}

void gloss_list_unref(struct gloss_list *list)
{
	if (!list || --list->references)
		return;
	for (struct gloss_node *node = list->first, *next; node; node = next) {
		next = node->next;
		if (node->vertices)
			gloss_vertices_free(node->vertices);
		free(node);
	}
	free(list);
}
