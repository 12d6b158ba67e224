/* SPDX-License-Identifier: MIT */
/* A scene as OpenGL has it, in either of two ways; in the context that is current. */
#ifndef TESTS_BENCH_GL_SCENE_H
#define TESTS_BENCH_GL_SCENE_H

#include <epoxy/gl.h>

#include "scene/scene.h"

/* Fixed function: lit at vertices, colours linear between. */
void gl_scene_set_fixed(const struct scene *scene);

/*
 * Per pixel: a program for the viewer and the number of lights of @scene, which are directional;
 * for front faces. 0: the driver does not take it.
 */
GLuint gl_scene_program(const struct scene *scene);
void gl_scene_set_program(GLuint program, const struct scene *scene);

#endif
