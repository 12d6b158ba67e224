/* SPDX-License-Identifier: MIT */
/* What immediate mode and lists have collected, drawn. */
#ifndef GLOSS_BATCH_H
#define GLOSS_BATCH_H

#include <stdbool.h>

struct gloss_context;

/* So many vertices are drawn before more are collected. */
#define GLOSS_BATCH_MAX 65536u

/* Draws the collected primitives with the state as it is; not between glBegin and glEnd. */
void gloss_batch_draw(struct gloss_context *context);
/* As gloss_change(), also between glBegin and glEnd: what came before is drawn, and the primitive
 * goes on with the vertices that it needs. A line loop changes as a whole. */
void gloss_batch_break(struct gloss_context *context, unsigned int dirty);

#endif
