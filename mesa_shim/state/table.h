/* SPDX-License-Identifier: MIT */
/*
 * One row for each value of a context: what it is called, how it is kept, and which bits of
 * glPushAttrib save it. glGet, glIsEnabled, glEnable, glDisable and glPopAttrib all go by it.
 */
#ifndef GLOSS_TABLE_H
#define GLOSS_TABLE_H

#include <stdbool.h>
#include <stdint.h>

#include <GL/gl.h>

enum gloss_kind {
	GLOSS_CAPABILITY,        /* a GLboolean that glEnable sets */
	GLOSS_CLIENT_CAPABILITY, /* one that glEnableClientState sets */
	GLOSS_BOOLEAN,
	GLOSS_INTEGER, /* and enums */
	GLOSS_FLOAT,
	GLOSS_UNIT_FLOAT, /* as an integer, -1 to 1 are the whole range: colours, depths, normals */
	GLOSS_CONSTANT,   /* @offset is the value */
	GLOSS_BYTES       /* only saved, has no name */
};

/* A row with a unit is that of the active one; @offset is that of unit 0. */
enum gloss_row_unit { GLOSS_UNIT_NONE, GLOSS_UNIT_ACTIVE, GLOSS_UNIT_CLIENT };

struct gloss_row {
	GLenum name;
	uint8_t kind, unit;
	uint16_t count;
	uint32_t offset;  /* in struct gloss_context */
	uint32_t stride;  /* from a unit to the next */
	GLbitfield saved; /* bits of glPushAttrib */
};

extern const struct gloss_row gloss_table[];
extern const unsigned int gloss_table_rows;

/* NULL: nothing has this name. */
const struct gloss_row *gloss_table_find(GLenum name);
/* Where @row is in @context; NULL: it is a constant. */
struct gloss_context;
void *gloss_row_at(struct gloss_context *context, const struct gloss_row *row);

#endif
