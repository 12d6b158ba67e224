/* SPDX-License-Identifier: MIT */
/*
 * Vertices between glBegin and glEnd, collected as long as nothing changes that they depend on, so
 * that thousands of primitives are one draw. Immediate mode has one, and the list being compiled.
 */
#ifndef GLOSS_VERTICES_H
#define GLOSS_VERTICES_H

#include <stdbool.h>
#include <stdint.h>

#include "accel.h"
#include "state/attributes.h"

/* Which of the current values have been set. */
enum gloss_set {
	GLOSS_SET_COLOUR = 1 << 0,
	GLOSS_SET_NORMAL = 1 << 1,
	GLOSS_SET_EDGE = 1 << 2,
	GLOSS_SET_SECONDARY = 1 << 3,
	GLOSS_SET_FOG = 1 << 4,
	GLOSS_SET_INDEX = 1 << 5,
	GLOSS_SET_TEXCOORD = 1 << 6, /* and the next bits of the other units */
};

struct gloss_vertices {
	struct gloss_vertex *vertex;
	uint32_t vertices, vertex_room;
	struct accel_primitive *primitive;
	uint32_t primitives, primitive_room;
	bool inside; /* between glBegin and glEnd */
	bool failed; /* there was no memory for some of it */
	/* The next vertex; @set says what of it was given. */
	struct gloss_current *current;
	unsigned int set;
	/* Of a list: how many vertices at the beginning came before the value was set in it, so
	 * that they take the current one at play: of colour, normal and edge flag. */
	uint32_t unset[3];
	/* Of a list: vertices that come before its first glBegin, of a primitive that another has
	 * begun, and whether that ends after them. */
	uint32_t loose;
	bool ended;
};

/* The modes of glBegin are topologies of libaccel. */
void gloss_vertices_begin(struct gloss_vertices *vertices, GLenum mode);
/* Forgets the vertices that make no whole primitive, and joins it to the one before if they are
 * of a kind that allows it. */
void gloss_vertices_end(struct gloss_vertices *vertices);
/* Room for @count more vertices, or one more primitive; false: out of memory. */
bool gloss_vertices_reserve(struct gloss_vertices *vertices, uint32_t count);
bool gloss_vertices_reserve_primitive(struct gloss_vertices *vertices);
/* Forgets vertices and primitives, and keeps their memory and the current values. */
void gloss_vertices_clear(struct gloss_vertices *vertices);
void gloss_vertices_free(struct gloss_vertices *vertices);

#endif
