/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_LIST_PRIV_H
#define GLOSS_LIST_PRIV_H

#include "draw/list.h"
#include "draw/vertices.h"

/* A command, or what lies between two: vertices and current values. */
struct gloss_node {
	struct gloss_node *next;
	gloss_play_fn play;
	bool inside;                     /* it may be between glBegin and glEnd */
	struct gloss_vertices *vertices; /* to be freed with it; in @call */
	_Alignas(max_align_t) char call[];
};

struct gloss_vertices_node {
	struct gloss_vertices vertices;
	struct gloss_current current;
};

/* Counted: a list may be deleted while it is played. The lock of the names guards the count. */
struct gloss_list {
	struct gloss_node *first, **end;
	unsigned int references;
};

struct gloss_list *gloss_list_new(void);
void gloss_list_unref(struct gloss_list *list);
void gloss_list_play(struct gloss_context *context, const struct gloss_list *list);

#endif
