/* SPDX-License-Identifier: MIT */
/*
 * The state that glPushAttrib can save, in OpenGL's terms: a struct for each of its groups.
 * table.c says which member is asked for by which name, and which bits save it.
 */
#ifndef GLOSS_ATTRIBUTES_H
#define GLOSS_ATTRIBUTES_H

#include <GL/gl.h>
#include <GL/glext.h>

#define GLOSS_LIGHTS 8
#define GLOSS_CLIP_PLANES 6
#define GLOSS_UNITS 4
#define GLOSS_WIDTH_MAX 64 /* of lines and points */

/* What a vertex of a primitive has: all that the core draws of it. */
struct gloss_vertex {
	GLfloat position[4], colour[4], normal[3], edge;
};

/* What the next vertex has. Its position is that of the last, which nobody reads. */
struct gloss_current {
	struct gloss_vertex vertex;
	GLfloat secondary[4], fog, index;
	GLfloat texcoord[GLOSS_UNITS][4];
};

struct gloss_raster_position {
	GLfloat position[4], distance;
	GLfloat colour[4], secondary[4], index;
	GLfloat texcoord[GLOSS_UNITS][4];
	GLboolean valid;
};

struct gloss_point {
	GLfloat size, least, most, fade, attenuation[3];
	GLboolean smooth, sprite;
};

struct gloss_line {
	GLfloat width;
	GLint pattern, repeat;
	GLboolean smooth, stipple;
};

struct gloss_polygon {
	GLenum cull_face, front_face, mode[2];
	GLfloat factor, units;
	GLboolean cull, smooth, stipple, offset_point, offset_line, offset_fill;
};

struct gloss_transfer {
	GLfloat zoom[2], scale[4], bias[4], depth_scale, depth_bias;
	GLint index_shift, index_offset;
	GLenum read_buffer;
	GLboolean map_colour, map_stencil;
};

struct gloss_light {
	GLfloat ambient[4], diffuse[4], specular[4];
	GLfloat position[4], direction[3]; /* in eye space */
	GLfloat exponent, cutoff, attenuation[3];
	GLboolean enabled;
};

struct gloss_material {
	GLfloat ambient[4], diffuse[4], specular[4], emission[4];
	GLfloat shininess, indexes[3];
};

struct gloss_lighting {
	GLboolean enabled, local_viewer, two_side, track;
	GLenum shade_model, colour_control, track_face, track_mode;
	GLfloat ambient[4];
	struct gloss_light light[GLOSS_LIGHTS];
	struct gloss_material material[2]; /* front, back */
};

struct gloss_fog {
	GLenum mode, source;
	GLfloat density, start, end, index, colour[4];
	GLboolean enabled, sum; /* sum: the secondary colour's */
};

struct gloss_depth {
	GLenum func;
	GLfloat clear;
	GLboolean test, mask;
};

struct gloss_stencil {
	GLenum func, fail, depth_fail, pass;
	GLint reference, mask, write_mask, clear;
	GLboolean test;
};

struct gloss_colour_buffer {
	GLenum alpha_func, logic_op, draw_buffer;
	GLenum source, target, source_alpha, target_alpha, equation, equation_alpha;
	GLfloat alpha_reference, clear[4], constant[4], clear_index;
	GLint index_mask;
	GLboolean mask[4], alpha_test, blend, dither, logic, index_logic;
};

struct gloss_viewport {
	GLint box[4];
	GLfloat range[2];
};

struct gloss_transform {
	GLenum matrix_mode;
	GLboolean normalize, rescale, clip[GLOSS_CLIP_PLANES];
	GLfloat plane[GLOSS_CLIP_PLANES][4]; /* in eye space */
};

struct gloss_scissor {
	GLint box[4];
	GLboolean test;
};

struct gloss_hints {
	GLenum perspective, point, line, polygon, fog, mipmap, compression;
};

enum gloss_texture_kind {
	GLOSS_TEXTURE_1D,
	GLOSS_TEXTURE_2D,
	GLOSS_TEXTURE_3D,
	GLOSS_TEXTURE_CUBE,
	GLOSS_TEXTURE_RECTANGLE,
	GLOSS_TEXTURE_KINDS
};

/* How a texture is sampled, of the texture itself. */
struct gloss_sampler {
	GLenum min, mag, wrap[3], depth_mode, compare_mode, compare_func;
	GLfloat border[4], priority, min_lod, max_lod;
	GLint base, most; /* levels */
	GLboolean generate;
};

/* What the texture environment does with texels. The arrays are of RGB and of alpha. */
struct gloss_environment {
	GLenum mode, combine[2], source[2][3], operand[2][3];
	GLfloat scale[2], colour[4], lod_bias;
	GLboolean coord_replace;
};

/* Of S, T, R, Q. */
struct gloss_texgen {
	GLenum mode;
	GLfloat object[4], eye[4]; /* eye: in eye space */
};

struct gloss_unit {
	GLint bound[GLOSS_TEXTURE_KINDS]; /* names */
	GLboolean enabled[GLOSS_TEXTURE_KINDS], generate[4];
	struct gloss_environment environment;
	struct gloss_texgen texgen[4];
};

struct gloss_texturing {
	GLint active;
	struct gloss_unit unit[GLOSS_UNITS];
};

/* Maps by their kinds, and the grids of meshes. */
struct gloss_evaluating {
	GLboolean map1[9], map2[9], auto_normal;
	GLint segments1, segments2[2];
	GLfloat grid1[2], grid2[4];
};

struct gloss_multisample {
	GLfloat coverage;
	GLboolean enabled, alpha_to_coverage, alpha_to_one, sample_coverage, invert;
};

struct gloss_attributes {
	struct gloss_current current;
	struct gloss_raster_position raster;
	struct gloss_point point;
	struct gloss_line line;
	struct gloss_polygon polygon;
	GLubyte polygon_stipple[128];
	struct gloss_transfer transfer;
	struct gloss_lighting lighting;
	struct gloss_fog fog;
	struct gloss_depth depth;
	GLfloat accum_clear[4];
	struct gloss_stencil stencil;
	struct gloss_colour_buffer colour_buffer;
	struct gloss_viewport viewport;
	struct gloss_transform transform;
	struct gloss_scissor scissor;
	struct gloss_hints hints;
	struct gloss_texturing texturing;
	struct gloss_evaluating evaluating;
	struct gloss_multisample multisample;
	GLint list_base;
};

/* OpenGL's initial values; those that depend on a window come with the first. */
void gloss_attributes_init(struct gloss_attributes *attributes);

#endif
