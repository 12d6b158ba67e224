// SPDX-License-Identifier: MIT
/* A painter in OpenGL: the mesh lies in buffers of the driver, a frame is one draw call. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_context.h"
#include "gl_scene.h"
#include "painter.h"

struct gl {
	int width, height;
	GLuint program;   /* 0: fixed function */
	bool forgets;     /* can be told that nobody will read the depth */
	const void *mesh; /* the positions of what lies in the buffers */
	GLuint buffer[3]; /* positions, normals, indices */
};

static void *open_gl(const struct way *way, const struct scene *scene,
		     char message[PAINTER_MESSAGE])
{
	struct gl *gl = calloc(1, sizeof(*gl));

	if (!gl || gl_context_new(way->driver, scene->width, scene->height, message)) {
		free(gl);
		return NULL;
	}
	gl->width = scene->width;
	gl->height = scene->height;
	gl->forgets = epoxy_has_gl_extension("GL_ARB_invalidate_subdata");
	gl->program = way->per_pixel ? gl_scene_program(scene) : 0;
	glGenBuffers(3, gl->buffer);
	if (!way->per_pixel || gl->program)
		return gl;
	snprintf(message, PAINTER_MESSAGE, "%s does not take the shaders", way->driver);
	free(gl);
	return NULL;
}

static void load(GLenum kind, GLuint buffer, const void *data, size_t size)
{
	glBindBuffer(kind, buffer);
	glBufferData(kind, (GLsizeiptr)size, data, GL_STATIC_DRAW);
}

/* Packed floats, as scenes have them. */
static void load_mesh(struct gl *gl, const struct accel_mesh *mesh)
{
	size_t vectors = mesh->vertices * sizeof(float[3]);

	load(GL_ELEMENT_ARRAY_BUFFER, gl->buffer[2], mesh->index, mesh->indices * sizeof(uint32_t));
	load(GL_ARRAY_BUFFER, gl->buffer[0], mesh->position.data, vectors);
	glVertexPointer(3, GL_FLOAT, 0, NULL);
	glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
	load(GL_ARRAY_BUFFER, gl->buffer[1], mesh->normal.data, vectors);
	glNormalPointer(GL_FLOAT, 0, NULL);
	glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, NULL);
	if (gl->program) {
		glEnableVertexAttribArray(0);
		glEnableVertexAttribArray(1);
	} else {
		glEnableClientState(GL_VERTEX_ARRAY);
		glEnableClientState(GL_NORMAL_ARRAY);
	}
	gl->mesh = mesh->position.data;
}

static int draw_gl(void *painter, const struct scene *scene)
{
	const struct accel_mesh *mesh = &scene->mesh;
	static const GLenum depth = GL_DEPTH_ATTACHMENT;
	struct gl *gl = painter;

	if (gl->mesh != mesh->position.data)
		load_mesh(gl, mesh);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glClearColor(scene->background[0], scene->background[1], scene->background[2],
		     scene->background[3]);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	if (gl->program)
		gl_scene_set_program(gl->program, scene);
	else
		gl_scene_set_fixed(scene);
	glDrawElements(GL_TRIANGLES, (GLsizei)mesh->indices, GL_UNSIGNED_INT, NULL);
	if (gl->forgets && !scene->keeps_depth)
		glInvalidateFramebuffer(GL_FRAMEBUFFER, 1, &depth);
	glFinish();
	return glGetError() == GL_NO_ERROR ? 0 : -EIO;
}

/* OpenGL's first row is the lowest. */
static void read_rows(const struct gl *gl, GLenum format, GLenum type, uint32_t *pixels)
{
	for (int y = 0; y < gl->height; y++)
		glReadPixels(0, gl->height - 1 - y, gl->width, 1, format, type,
			     pixels + (size_t)y * gl->width);
}

static int read_gl(void *painter, uint32_t *colour, uint32_t *depth)
{
	const struct gl *gl = painter;
	size_t pixels = (size_t)gl->width * gl->height;

	read_rows(gl, GL_RGBA, GL_UNSIGNED_BYTE, colour);
	read_rows(gl, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, depth);
	for (size_t i = 0; i < pixels; i++)
		depth[i] >>= 8;
	return glGetError() == GL_NO_ERROR ? 0 : -EIO;
}

const struct painter_ops painter_gl = { open_gl, draw_gl, read_gl };
