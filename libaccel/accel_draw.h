/* SPDX-License-Identifier: MIT */
/*
 * The draw level of libaccel: a draw collects a frame of meshes on a target, each as a
 * state says. Programs include accel.h, which has this and what is true of all calls:
 * errors, threads, waiting, structs, ownership and units.
 */
#ifndef ACCEL_DRAW_H
#define ACCEL_DRAW_H

#include "accel.h"

#ifdef __cplusplus
extern "C" {
#endif

#define ACCEL_LIGHTS 8
#define ACCEL_USER_CLIP_PLANES 6
#define ACCEL_TARGET_SIZE_MAX 2048

struct accel_target;
struct accel_state;
struct accel_draw;

/* ---- target: colour and depth to draw on ---- */

/*
 * @width and @height are in pixels, 1 to ACCEL_TARGET_SIZE_MAX. Colour and depth are
 * zero. A target takes 8 bytes of board memory a pixel, with both sides rounded up to
 * multiples of 64. -EINVAL: another size. -ENOMEM: also when board memory has no room.
 */
int accel_target_new(struct accel_device *device, int width, int height,
		     struct accel_target **target);
/* Does not wait, as accel_buffer_free. */
void accel_target_free(struct accel_target *target);

/* What a target has for each pixel, 4 bytes of each. */
enum accel_plane {
	ACCEL_PLANE_COLOUR, /* red, green, blue, alpha: a byte each, in this order */
	ACCEL_PLANE_DEPTH   /* a uint32_t: depth in bits 23:0, 0xffffff is 1 */
};

/* Pixels from the top left corner of a target. */
struct accel_rectangle {
	int x, y, width, height;
};

/*
 * Reads the pixels of @plane that are in @part, or all if that is NULL, after all jobs that
 * were submitted before. Rows come from the top into @pixels. @pitch is the bytes from a row
 * to the next, a multiple of 4 and at least 4 for each pixel of a row; bytes between rows are
 * left alone. Only the pixels in @part are fetched from the board, and none if it has none.
 * Bits 31:24 of a depth are zero, unless a stream of your own wrote stencil there. After an
 * error other than -EINVAL some rows may have been read.
 * -EINVAL: there is no such @plane; @part is not within the target; @pitch is none. -EIO,
 * -ENODEV.
 */
int accel_target_read(struct accel_target *target, enum accel_plane plane,
		      const struct accel_rectangle *part, void *pixels, size_t pitch);
/*
 * Writes the pixels of @plane that are in @part, or all if that is NULL, after all jobs that were
 * submitted before, and past everything that a state says. Rows lie in @pixels as accel_target_read
 * puts them there, and are copied. Bits 31:24 of a depth are ignored, and zero on the target. A
 * frame that is being collected is not on the target: submit what is to be written over first. On
 * return all is written. After an error other than -EINVAL some rows may have been.
 * -EINVAL: as accel_target_read. -EIO, -ENODEV.
 */
int accel_target_write(struct accel_target *target, enum accel_plane plane,
		       const struct accel_rectangle *part, const void *pixels, size_t pitch);

/* ---- state: everything a draw depends on but the mesh ---- */

enum accel_shading {
	ACCEL_SHADING_GOURAUD,   /* lit at vertices, linear in space between, as in OpenGL */
	ACCEL_SHADING_ADAPTIVE,  /* the default: as much as each triangle needs */
	ACCEL_SHADING_QUADRATIC, /* one second-order surface on each triangle */
	ACCEL_SHADING_FLAT       /* one colour a triangle */
};

enum accel_compare {
	ACCEL_COMPARE_NEVER,
	ACCEL_COMPARE_LESS,
	ACCEL_COMPARE_EQUAL,
	ACCEL_COMPARE_LEQUAL,
	ACCEL_COMPARE_GREATER,
	ACCEL_COMPARE_NOTEQUAL,
	ACCEL_COMPARE_GEQUAL,
	ACCEL_COMPARE_ALWAYS
};

enum accel_cull {
	ACCEL_CULL_NONE,
	ACCEL_CULL_BACK,
	ACCEL_CULL_FRONT,
	ACCEL_CULL_BOTH /* points and lines are still drawn */
};

/* What is drawn of a polygon. */
enum accel_polygon_mode {
	ACCEL_POLYGON_FILL,  /* all of it */
	ACCEL_POLYGON_LINES, /* a line along each edge of its outline, */
	ACCEL_POLYGON_POINTS /* a point where each of these begins */
};

/* What becomes of the length of normals. */
enum accel_normals {
	ACCEL_NORMALS_UNIT,    /* they are made unit length in eye space, OpenGL's NORMALIZE */
	ACCEL_NORMALS_RESCALE, /* divided by what the modelview matrix scales by, RESCALE_NORMAL */
	ACCEL_NORMALS_AS_GIVEN /* as they are after the inverse of the modelview matrix */
};

/* What of a material vertices' colours replace. */
enum accel_tracks {
	ACCEL_TRACKS_NONE,
	ACCEL_TRACKS_EMISSION,
	ACCEL_TRACKS_AMBIENT,
	ACCEL_TRACKS_DIFFUSE,
	ACCEL_TRACKS_SPECULAR,
	ACCEL_TRACKS_AMBIENT_DIFFUSE
};

/*
 * Reflectances, RGBA, and the specular exponent. The alpha of a lit pixel is diffuse[3]. With all
 * members zero a surface is black and its alpha 0.
 */
struct accel_material {
	size_t size; /* of this struct, bytes: set by ACCEL_MATERIAL() */
	float emission[4], ambient[4], diffuse[4], specular[4];
	float shininess;   /* the specular exponent, 0 to 1000 */
	uint32_t reserved; /* 0 */
};
#define ACCEL_MATERIAL(...) ACCEL_SIZED(accel_material, __VA_ARGS__)

/*
 * A light, in eye space. A plain light needs no more than @enabled, @position and its colours.
 * With position[3] = 0 it is directional and position is the direction towards it; else it is
 * a point, at position / position[3]. A point is as bright at any distance; if one of
 * @attenuation is not 0, then 1/(c + l*d + q*d^2) of its light arrives at the distance d.
 * A light with a spot_cutoff is a spot: it shines so many degrees around spot_direction and no
 * farther. A directional one is in the same place of its cone everywhere.
 */
struct accel_light {
	size_t size; /* of this struct, bytes: set by ACCEL_LIGHT() */
	bool enabled;
	float position[4];
	float ambient[4], diffuse[4], specular[4];
	float attenuation[3];    /* c, l, q, none below 0; all 0: as 1, 0, 0 */
	float spot_direction[3]; /* all 0: as 0, 0, -1 */
	float spot_exponent;     /* how fast it gets less bright, 0 to 128 */
	float spot_cutoff;       /* degrees, above 0 to 90; 0, or 180 as in OpenGL: no spot */
	uint32_t reserved;       /* 0 */
};
#define ACCEL_LIGHT(...) ACCEL_SIZED(accel_light, __VA_ARGS__)

/* Pixels of the widest line and point. */
#define ACCEL_WIDTH_MAX 64

/*
 * Lines, drawn as so many whole pixels beside each other. With a @repeat they have a stipple: every
 * @repeat pixels along a line, from the beginning of its primitive on, the next bit of @stipple,
 * from bit 0 on, says whether it is drawn there.
 */
struct accel_line_style {
	size_t size;      /* of this struct, bytes: set by ACCEL_LINE_STYLE() */
	float width;      /* pixels, up to ACCEL_WIDTH_MAX; 0: 1 */
	uint16_t stipple; /* ignored without @repeat */
	uint16_t repeat;  /* 0: the line has no gaps */
};
#define ACCEL_LINE_STYLE(...) ACCEL_SIZED(accel_line_style, __VA_ARGS__)

/* Points, drawn as squares of whole pixels: of width / sqrt(c + l*d + q*d^2) at the distance d. */
struct accel_point_style {
	size_t size;          /* of this struct, bytes: set by ACCEL_POINT_STYLE() */
	float width;          /* pixels, up to ACCEL_WIDTH_MAX; 0: 1 */
	float least, most;    /* of what is drawn; 0: no limit, ACCEL_WIDTH_MAX */
	float attenuation[3]; /* c, l, q, none below 0; all 0: as 1, 0, 0 */
};
#define ACCEL_POINT_STYLE(...) ACCEL_SIZED(accel_point_style, __VA_ARGS__)

/*
 * A new state has the defaults that the functions below name, and OpenGL's defaults for
 * the rest. Matrices are the identity. The material of both sides has ambient 0.2 and
 * diffuse 0.8 and nothing else. The ambient light is 0.2. All lights are off; the first
 * is white and the others black, and they shine along -z. A state belongs to no device
 * and may be used with any.
 */
int accel_state_new(struct accel_state **state);
void accel_state_free(struct accel_state *state);

/*
 * The functions below copy what they are given. They take effect with the next
 * accel_draw_mesh. An argument of an enum has to be one of its values.
 */

/* Model to eye space, and eye to clip space. If a number in either is not finite,
 * accel_draw_mesh refuses every mesh that has a vertex. */
void accel_state_set_modelview(struct accel_state *state, const float matrix[16]);
void accel_state_set_projection(struct accel_state *state, const float matrix[16]);
/* The window rectangle in pixels: its top left corner and size. A width < 0, the default, means
 * the whole target. It may lie anywhere. If its width is 0 or its height <= 0, nothing is drawn. */
void accel_state_set_viewport(struct accel_state *state, int x, int y, int width, int height);
/* The depth of the near and of the far plane, 0 and 1 by default. Clamped to 0..1, NaN to 0. */
void accel_state_set_depth_range(struct accel_state *state, float near, float far);
/* Nothing is drawn outside this rectangle: pixels, from the top left corner. A width < 0, the
 * default, switches it off. It may lie anywhere. If its width is 0 or its height <= 0, nothing is
 * drawn. */
void accel_state_set_scissor(struct accel_state *state, int x, int y, int width, int height);
/*
 * A pixel is drawn if its depth compares as @func with the depth in the target. With @write
 * its depth then replaces that. The default is ALWAYS without write, which is no depth test.
 */
void accel_state_set_depth(struct accel_state *state, enum accel_compare func, bool write);
/* Which channels are written; all by default. */
void accel_state_set_colour_mask(struct accel_state *state, bool red, bool green, bool blue,
				 bool alpha);
/*
 * Nothing is drawn where @plane, in eye space, times the place is below 0; NULL, the default: the
 * plane is off. -EINVAL: @index is not in 0..ACCEL_USER_CLIP_PLANES-1; a number is not finite.
 */
int accel_state_set_clip_plane(struct accel_state *state, int index, const float plane[4]);
/* Which faces are not drawn, none by default. */
void accel_state_set_cull(struct accel_state *state, enum accel_cull cull);
/* Which way front faces turn in NDC, y up: false, the default: counter-clockwise. */
void accel_state_set_front_face(struct accel_state *state, bool clockwise);
/*
 * How polygons are drawn of which the front or the back is seen; filled by default. Lines and
 * points have the styles of such, and the light of the polygon's side. A polygon is what the
 * topology's name says, not the triangles that it is filled with. Its outline is the edges whose
 * first vertex has an edge flag (accel_arrays.edge), and those that clipping makes, which is not
 * where it leaves the viewport.
 */
void accel_state_set_polygon_mode(struct accel_state *state, enum accel_polygon_mode front,
				  enum accel_polygon_mode back);
/*
 * To the depth of polygons is added: @factor times what it changes by from one pixel to the next,
 * across or down, whichever is more; and @units times 1/(2^24 - 1), the least that two depths
 * differ by. @modes: where, of 1u << ACCEL_POLYGON_FILL and so on; 0, the default: nowhere.
 * -EINVAL: a number is not finite; @modes has other bits.
 */
int accel_state_set_polygon_offset(struct accel_state *state, float factor, float units,
				   unsigned int modes);
/*
 * Where NDC y = -1 is. False, the default: at the bottom of the viewport, so that y is up on the
 * target. True: at its top, which is nearest to row 0, as in textures of OpenGL. Viewport and
 * scissor are as ever, and so is which faces are front faces.
 */
void accel_state_set_origin(struct accel_state *state, bool bottom);
/*
 * ACCEL_NORMALS_UNIT by default. With another, diffuse light is the length of a normal times as
 * bright, and between vertices, where light is worked out there, direction and length are linear.
 */
void accel_state_set_normals(struct accel_state *state, enum accel_normals normals);
/* Off by default: the colours of vertices are drawn as they are, or white without any. */
void accel_state_set_lighting(struct accel_state *state, bool enabled);
/*
 * What colours of vertices do while lighting is on: those members of the front and of the back
 * material are taken from them, as OpenGL's COLOR_MATERIAL does. Where that is the diffuse
 * reflectance, so is alpha. ACCEL_TRACKS_NONE, the default: nothing. Without colours all is the
 * material's.
 */
void accel_state_set_colour_material(struct accel_state *state, enum accel_tracks front,
				     enum accel_tracks back);
/* How back faces are lit. True: with the normal reversed and the back material. False, the
 * default: as front faces. */
void accel_state_set_two_sided(struct accel_state *state, bool enabled);
/* From where highlights are seen. True, the default: from the eye. False: from (0,0,1), for all
 * points of the mesh. */
void accel_state_set_local_viewer(struct accel_state *state, bool enabled);
/* The light that comes from everywhere. -EINVAL: a value is not finite. */
int accel_state_set_ambient(struct accel_state *state, const float rgba[4]);
/* @back may be NULL and is then the same as @front. -EINVAL: a shininess is outside 0..1000, a
 * value is not finite, or a size is not set or @reserved is. -E2BIG: a struct has members that
 * are not known. */
int accel_state_set_material(struct accel_state *state, const struct accel_material *front,
			     const struct accel_material *back);
/* -EINVAL: @index is not in 0..ACCEL_LIGHTS-1; a value is not finite; an attenuation of a point
 * is negative; a spot's exponent or cutoff is out of range; the size is not set or @reserved is.
 * -E2BIG: @light has members that are not known. */
int accel_state_set_light(struct accel_state *state, int index, const struct accel_light *light);
/* -EINVAL: a width is negative or no number; the size is not set. -E2BIG: @style has members that
 * are not known. */
int accel_state_set_line_style(struct accel_state *state, const struct accel_line_style *style);
/* -EINVAL: a width or an attenuation is negative or no number; the size is not set. -E2BIG: @style
 * has members that are not known. */
int accel_state_set_point_style(struct accel_state *state, const struct accel_point_style *style);
/* How light and colours vary over a triangle; ACCEL_SHADING_ADAPTIVE by default. */
void accel_state_set_shading(struct accel_state *state, enum accel_shading shading);

/* ---- mesh: lent for the duration of a call ---- */

/*
 * What vertices make, in OpenGL's order. Points and lines have the light of their vertices, of
 * front sides and linear between. Of vertices that make no whole primitive nothing is drawn. A
 * polygon has to be convex. With ACCEL_SHADING_FLAT a primitive has the colour of its last vertex,
 * and a polygon that of its first.
 */
enum accel_topology {
	ACCEL_TOPOLOGY_POINTS,
	ACCEL_TOPOLOGY_LINES,
	ACCEL_TOPOLOGY_LINE_LOOP,
	ACCEL_TOPOLOGY_LINE_STRIP,
	ACCEL_TOPOLOGY_TRIANGLES,
	ACCEL_TOPOLOGY_TRIANGLE_STRIP,
	ACCEL_TOPOLOGY_TRIANGLE_FAN,
	ACCEL_TOPOLOGY_QUADS,
	ACCEL_TOPOLOGY_QUAD_STRIP,
	ACCEL_TOPOLOGY_POLYGON
};

/* Of a number in an array. */
enum accel_type {
	ACCEL_TYPE_FLOAT,
	ACCEL_TYPE_DOUBLE,
	ACCEL_TYPE_FIXED, /* s15.16 */
	ACCEL_TYPE_BYTE,
	ACCEL_TYPE_UBYTE,
	ACCEL_TYPE_SHORT,
	ACCEL_TYPE_USHORT,
	ACCEL_TYPE_INT,
	ACCEL_TYPE_UINT
};

/*
 * An element for each vertex, at any address. With no more than @data it is an array of floats
 * without gaps, as many for each vertex as the attribute has:
 *
 *	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .vertices = 3,
 *					    .position = { .data = corner });
 */
struct accel_array {
	const void *data; /* NULL: there is none */
	uint32_t stride;  /* bytes from an element to the next; 0: no gaps */
	enum accel_type type;
	uint8_t components;  /* numbers of an element; 0: the most that its comment names */
	bool normalised;     /* the range of an integer type stands for 0 to 1, signed -1 to 1 */
	bool constant;       /* the first element is all vertices', @stride is ignored */
	uint8_t reserved[5]; /* 0 */
};

struct accel_mesh {
	size_t size; /* of this struct, bytes: set by ACCEL_MESH() */
	enum accel_topology topology;
	uint32_t vertices;           /* that the arrays have */
	struct accel_array position; /* x, y, z, for which 0 components stand; or as accel_arrays */
	struct accel_array normal, colour; /* as accel_arrays */
	const uint32_t *index;             /* of vertices; NULL: all of them in order */
	uint32_t indices;                  /* ignored without @index */
	uint32_t reserved;                 /* 0 */
};
#define ACCEL_MESH(...) ACCEL_SIZED(accel_mesh, __VA_ARGS__)

/* ---- arrays and elements: the same in OpenGL's terms, lent for the duration of a call ---- */

struct accel_arrays {
	size_t size;                 /* of this struct, bytes: set by ACCEL_ARRAYS() */
	uint32_t vertices;           /* that may be read */
	uint32_t reserved;           /* 0 */
	struct accel_array position; /* x, y, z, w; without w it is 1, without z that is 0 */
	struct accel_array normal;   /* x, y, z, of any length; none: flat, from the triangle */
	struct accel_array colour;   /* RGBA; or RGB, and alpha is 1 */
	/* Not 0: the edge that begins there, of a triangle, quad or polygon of its own, is one of its
	 * outline. None: all are. */
	struct accel_array edge;
};
#define ACCEL_ARRAYS(...) ACCEL_SIZED(accel_arrays, __VA_ARGS__)

/* Elements @first to @first + @count - 1, and what they make. */
struct accel_primitive {
	enum accel_topology topology;
	uint32_t first, count;
};

/* Primitives of one set of arrays, drawn in order: thousands cost no more than one call. */
struct accel_elements {
	size_t size; /* of this struct, bytes: set by ACCEL_ELEMENTS() */
	const struct accel_primitive *primitive;
	const void *
		index; /* the vertex of each element, at any address; NULL: element i is vertex i */
	uint32_t primitives;
	enum accel_type index_type; /* of @index: UBYTE, USHORT or UINT */
};
#define ACCEL_ELEMENTS(...) ACCEL_SIZED(accel_elements, __VA_ARGS__)

/* ---- draw: a frame being collected ---- */

/* Bits of accel_clear.mask. */
#define ACCEL_CLEAR_COLOUR 1u
#define ACCEL_CLEAR_DEPTH 2u

/* What a target, all of it, is cleared to. */
struct accel_clear {
	size_t size;       /* of this struct, bytes: set by ACCEL_CLEAR() */
	unsigned int mask; /* what is cleared, of ACCEL_CLEAR_* */
	float rgba[4];     /* limited to 0..1 */
	float depth;       /* 0 to 1 */
};
#define ACCEL_CLEAR(...) ACCEL_SIZED(accel_clear, __VA_ARGS__)

/*
 * What became of the triangles of a frame, of which points and lines are some. A new frame begins
 * at zero.
 */
struct accel_draw_stats {
	uint64_t triangles_in;               /* before clipping, culling and splitting */
	uint64_t culled;                     /* out of view, turned away, or between the pixels */
	uint64_t clipped;                    /* cut, with a part left that is drawn */
	uint64_t flat, linear, second_order; /* drawn, after splitting */
	uint64_t split;                      /* triangles that were split */
	uint64_t records; /* TRIANGLE packets: a triangle, or a rectangle, in a tile */
	uint64_t stream_words;
	uint64_t tiles; /* that the frame took: not those in which it changes nothing */
};

/*
 * A draw collects one frame at a time, and keeps the memory that this took for the next: its
 * stream; 12 bytes for each vertex of the largest mesh, and 4 more for each thread that sets up
 * meshes; 4 bytes for each element of the largest call that has few elements of many vertices; and
 * for the triangles that such a thread works on together 1 KB each, up to 9 MB. While large
 * triangles are split in many parts it takes 20 MB more.
 */
int accel_draw_new(struct accel_device *device, struct accel_draw **draw);
/* Forgets a frame that was not submitted. */
void accel_draw_free(struct accel_draw *draw);

/*
 * Begins a frame on @target, which may be freed before the frame is submitted. The target is
 * cleared as @clear says, also if nothing is drawn then; NULL: what it has is kept, and drawn on.
 * A frame that was begun before and not submitted is forgotten.
 * -EINVAL: @target is another device's; @clear has a mask without a bit, or with others, a colour
 * that is not finite, a depth outside 0..1 (of what the mask names), or no size. -E2BIG: @clear has
 * members that are not known. After -ENOMEM no frame is begun, after other errors nothing changed.
 */
int accel_draw_begin(struct accel_draw *draw, struct accel_target *target,
		     const struct accel_clear *clear);

/*
 * Clears the whole target in the middle of a frame, before what is drawn from here on. If the mask
 * has all bits, what the frame had drawn before is forgotten.
 * -EINVAL: no frame was begun; @clear as for accel_draw_begin. -E2BIG: @clear has members that are
 * not known. After -ENOMEM the frame is forgotten, and to be begun again.
 */
int accel_draw_clear(struct accel_draw *draw, const struct accel_clear *clear);

/*
 * The same, where the scissor of @state is, and of the colour those channels that its colour mask
 * has; of the depth test nothing is looked at. If that is the whole target and all channels, it is
 * accel_draw_clear, and else what each tile that it reaches is drawn with.
 * -EINVAL, -E2BIG, -ENOMEM: as accel_draw_clear.
 */
int accel_draw_clear_masked(struct accel_draw *draw, const struct accel_state *state,
			    const struct accel_clear *clear);

/* Pixels of one colour and depth, from the top left corner of a target. They may lie anywhere. */
struct accel_fill {
	struct accel_rectangle pixels; /* none if its width or height is not above 0 */
	float rgba[4];                 /* limited to 0..1 */
	float depth;                   /* 0 to 1 */
};

/*
 * Draws @fills rectangles, one after the other, past transform, viewport and light: of @state only
 * the scissor, the depth test and the colour mask are looked at. Each is exact, and has a record in
 * every tile that it reaches.
 * -EINVAL: no frame was begun; a colour that is not finite; a depth outside 0..1. Nothing is drawn
 * then. After -ENOMEM the frame is forgotten, and to be begun again.
 */
int accel_draw_rectangles(struct accel_draw *draw, const struct accel_state *state,
			  const struct accel_fill *fill, uint32_t fills);

/*
 * Nobody will read what the frame leaves in @planes, of ACCEL_CLEAR_*: the board need not store it,
 * which is up to half of its work on large pictures. After the frame each pixel of these planes may
 * have what it had before the frame or anything that the frame gave it. Call it at any place of a
 * frame, for that frame alone; most call it for ACCEL_CLEAR_DEPTH, if the next begins by clearing.
 * -EINVAL: no frame was begun; @planes has no bit, or others.
 */
int accel_draw_discard(struct accel_draw *draw, unsigned int planes);

/*
 * Draws @mesh on the frame's target as @state says. Threads of the library, which end with @draw,
 * help with meshes of more than some thousand triangles; they use nothing after the call.
 * -EINVAL: no frame was begun; an index out of range; a coordinate that is not finite; no
 * position array; an array or a topology that is none; a size that is not set, or
 * a @reserved that is. -E2BIG: @mesh has members that are not known. Nothing of the mesh is drawn
 * then. After -ENOMEM the frame is forgotten, and to be begun again.
 *
 * Pixels are covered by OpenGL's rule, with vertices rounded to 1/16 pixel. Shading changes
 * neither which pixels are covered nor their depth, so passes with different shading meet.
 * Edges are exact as long as the clip coordinates of a triangle are at most 2^90 times its w.
 * Light is worked out in single precision: that of a lamp near a triangle that reaches far
 * beyond what is seen is not exact.
 *
 * With ACCEL_SHADING_GOURAUD, and without lighting with ACCEL_SHADING_ADAPTIVE, the colours of
 * vertices are linear in space between them, also on clipped triangles. They are within 2/255,
 * and alpha within 4/255, if w differs along each edge by a factor of at most 10 and the triangle
 * is at least a pixel across. A triangle along whose edges w differs by less than 1 % is one
 * record in each tile; others take second-order surfaces or are split.
 */
int accel_draw_mesh(struct accel_draw *draw, const struct accel_state *state,
		    const struct accel_mesh *mesh);

/*
 * Draws @elements of @arrays as accel_draw_mesh draws a mesh, on the frame's target as @state says.
 * Of the arrays it reads those vertices, and those attributes, that are drawn. What a program of
 * OpenGL may get wrong is no error: a primitive with a vertex that is not finite, or is none of
 * @arrays, is left out, that is a point, a segment, a triangle, a quad or a whole polygon.
 * -EINVAL: no frame was begun; no position array; an array, an index type or a topology that is
 * none; a size that is not set, or a @reserved that is. -E2BIG: @arrays or
 * @elements has members that are not known. Nothing is drawn then. After -ENOMEM the frame is
 * forgotten, and to be begun again.
 */
int accel_draw_arrays(struct accel_draw *draw, const struct accel_state *state,
		      const struct accel_arrays *arrays, const struct accel_elements *elements);

/* What is captured. */
enum accel_captured {
	ACCEL_CAPTURED_POINT,
	ACCEL_CAPTURED_LINE_FIRST, /* with which a stipple would begin anew */
	ACCEL_CAPTURED_LINE,
	ACCEL_CAPTURED_POLYGON
};

struct accel_captured_vertex {
	float window[4]; /* pixels from the top left corner of the target, depth, w of clip space */
	float colour[4]; /* RGBA, 0 to 1 */
};

/* Receives a point, a line of 2 vertices or a polygon of 3 or more, lent for the call, which must
 * not use the draw. */
typedef void (*accel_capture_fn)(void *data, enum accel_captured what,
				 const struct accel_captured_vertex *vertex, uint32_t vertices);

/*
 * From here on accel_draw_arrays and accel_draw_mesh draw nothing and give @call what they would
 * draw: primitives as the topology names them, each clipped to the view volume and the state's
 * planes, culled, lit, and in the mode of polygons. What is a part of a pixel is not rounded, nor
 * is depth offset. Of what the target and 2000 pixels around it do not reach nothing is captured.
 * NULL ends it, and so does accel_draw_begin.
 * -EINVAL: no frame was begun.
 */
int accel_draw_capture(struct accel_draw *draw, accel_capture_fn call, void *data);

/*
 * Fills @stats, of which the caller has @size bytes: sizeof(*stats). The counts so far; stream
 * words, tiles and records are known after the submit.
 */
void accel_draw_stats(const struct accel_draw *draw, struct accel_draw_stats *stats, size_t size);

/*
 * Sends the frame to the board, and does not wait until it is drawn; the next one is to be begun.
 * On success *@fence is the caller's to wait for and free. @fence may be NULL: then nobody waits
 * for the frame, and accel_device_finish tells if it failed. Of a very large frame, which is
 * several jobs, the fence is that of all.
 * -EINVAL: no frame was begun. -EIO: the board refused the stream, or there was memory for some
 * of the jobs only. -ENODEV, -ENOMEM. After an error the frame is still there, to be submitted
 * again, unless some of its jobs were sent.
 */
int accel_draw_submit(struct accel_draw *draw, struct accel_fence **fence);

/*
 * Submits the frame as accel_draw_submit does, and waits until it is drawn.
 * -EINVAL: no frame was begun. -EIO, -ETIME, -ENODEV, -ENOMEM: as accel_draw_submit, which may
 * leave the frame there, or as accel_fence_wait.
 */
int accel_draw_finish(struct accel_draw *draw);

#ifdef __cplusplus
}
#endif

#endif
