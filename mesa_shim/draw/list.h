/* SPDX-License-Identifier: MIT */
/* Display lists: commands and vertices, recorded and played. */
#ifndef GLOSS_LIST_H
#define GLOSS_LIST_H

#include <stdbool.h>
#include <stddef.h>

struct gloss_context;
struct gloss_vertices;
struct gloss_shared;

/* Does what a command does, with the arguments that a list kept. */
typedef void (*gloss_play_fn)(struct gloss_context *context, const void *call);

/*
 * How every command begins that a list records: it is recorded if a list is open. Returns the
 * context if it is to be executed now. @call, of @size bytes, is copied.
 */
struct gloss_context *gloss_listed(gloss_play_fn play, const void *call, size_t size);
/* The same of commands that are allowed between glBegin and glEnd. */
struct gloss_context *gloss_listed_inside(gloss_play_fn play, const void *call, size_t size);

/* Ends what the open list collects, and draws it if the list is executed as well. */
void gloss_list_settle(struct gloss_context *context);

/* Of the list being compiled: a vertex of a primitive that it has not begun may come; such a
 * primitive ends; values of @set are set for the first time. */
bool gloss_list_is_loose(const struct gloss_context *context);
void gloss_list_end(struct gloss_context *context);
void gloss_list_set(struct gloss_vertices *vertices, unsigned int set);

/* Lists and buffers that contexts share. NULL: out of memory. */
struct gloss_shared *gloss_shared_new(void);
struct gloss_shared *gloss_shared_ref(struct gloss_shared *shared);
void gloss_shared_unref(struct gloss_shared *shared);
/* Forgets the list that is being compiled. */
void gloss_list_abandon(struct gloss_context *context);

#endif
