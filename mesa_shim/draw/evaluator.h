/* SPDX-License-Identifier: MIT */
/* Polynomial maps from one or two coordinates to vertices and their attributes: section 5.1. */
#ifndef GLOSS_EVALUATOR_H
#define GLOSS_EVALUATOR_H

#include <GL/gl.h>

#define GLOSS_MAP_KINDS 9 /* GL_MAP1_COLOR_4 to GL_MAP1_VERTEX_4, and those of MAP2 */
#define GLOSS_MAP_ORDER 8
#define GLOSS_MAP_POINTS (4 * GLOSS_MAP_ORDER * GLOSS_MAP_ORDER)

/* Control points row by row, those of v side by side, without gaps. A map of one coordinate has one
 * in v. */
struct gloss_map {
	GLint order[2];
	GLfloat domain[2][2];
	GLfloat point[GLOSS_MAP_POINTS];
};

struct gloss_maps {
	struct gloss_map one[GLOSS_MAP_KINDS], two[GLOSS_MAP_KINDS];
};

void gloss_maps_init(struct gloss_maps *maps);
/* Numbers of each control point of a kind. */
unsigned int gloss_map_components(unsigned int kind);
/* The value at @at, of @components numbers, and its slopes along u and v, if that is not NULL. */
void gloss_map_evaluate(const struct gloss_map *map, unsigned int components, const GLfloat at[2],
			GLfloat *value, GLfloat (*slope)[4]);

#endif
