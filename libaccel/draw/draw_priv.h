/* SPDX-License-Identifier: MIT */
/*
 * The stages a triangle passes in the library, from a mesh to the frame's command stream:
 *
 *   draw.c       the calls of accel_draw.h
 *   clear.c      those for what is drawn in whole pixels
 *   slices.c     a mesh on several threads (slices.h)
 *   arrays.c     what a call is given, and which vertices it needs
 *   primitives.c the triangles of primitives
 *   mesh.c       vertices to the screen, culling
 *   points.c, lines.c, strokes.c  points and lines as triangles
 *   polygons.c   polygons that are drawn as points or lines, or captured
 *   capture.c    what is given to the program instead of being drawn
 *   offset.c     what is added to the depth of polygons
 *   fetch.c      elements of arrays
 *   geometry.c   vertices to the window, each once
 *   kernel.c     loops over many of them (kernel.h, *_loop.h), as the processor has instructions
 *   clip.c       triangles that leave the view volume or the guard band
 *   lighting.c   colour at a point of a surface
 *   patch.c      places in the middle of edges and triangles
 *   shading.c    what an edge needs: a straight line, a second-order curve, a split
 *   spot.c       what of it a spot's cone allows
 *   interpolate.c  the same for colours that only vertices have
 *   split.c      what a triangle needs; splitting it at edge midpoints
 *   group.c      triangles that are worked together, and what they share (group.h)
 *   face.c       the stages from a group's vertices to triangles that are not split
 *   leaf.c       these, to the bin
 *   few.c        triangles of one or two pixels, which are lit there
 *   surface.c    colours and depth to fixed point (triangle.h)
 *   setup.c      edges in remainder form: which pixels of which rows
 *   small.c      the same of small triangles, to short numbers (small.h), and packed
 *   record.c     one TRIANGLE packet
 *   record_small.c  one TRIANGLE_SMALL packet
 *   bin.c        records by tile (bin.h)
 *   fill.c       tiles of one colour
 *   content.c    what the target's tiles are known to hold (content.h)
 *   frame.c      the frame's command stream
 *   number.h     smaller, larger, between
 *
 * Neighbours must agree on what they share. What belongs to an edge is therefore worked out from
 * its two vertices alone, with formulas that are symmetric in them bit for bit: sums and products
 * of two commute in floating point, and the build allows no fused operations.
 */
#ifndef ACCEL_DRAW_PRIV_H
#define ACCEL_DRAW_PRIV_H

#include "accel_priv.h"
#include "draw/number.h"
#include "draw/wide.h"

/* The depth of the far plane in the buffer: 24 bits. */
#define ACCEL_DEPTH_MAX 16777215.0

/*
 * Window coordinates have 10 fraction bits. Vertices of a mesh are snapped to 1/16 pixel, which
 * leaves the midpoints of ACCEL_SPLIT_LEVELS splits a place of their own: a split vertex is on its
 * edge exactly, so an edge that one neighbour splits and the other does not is still one line.
 */
#define ACCEL_WINDOW_BITS 10
#define ACCEL_WINDOW_ONE (1 << ACCEL_WINDOW_BITS)
#define ACCEL_WINDOW_HALF (ACCEL_WINDOW_ONE / 2)
#define ACCEL_SNAP_BITS 4
#define ACCEL_SPLIT_LEVELS (ACCEL_WINDOW_BITS - ACCEL_SNAP_BITS)

/* Registers r and m of an edge have 16 bits, and their sum must not wrap. */
#define ACCEL_EDGE_HEIGHT_MAX 32768

/* Samples end here, so that no second-order surface through them leaves s10.22. */
#define ACCEL_COLOUR_MAX 1.99f

struct accel_point {
	int32_t x, y; /* window, y down, ACCEL_WINDOW_BITS fraction bits */
};

struct accel_bounds {
	int x0, y0, x1, y1; /* pixels; x1 and y1 are outside */
};

struct accel_group;        /* group.h */
struct accel_vertex_batch; /* kernel.h */
struct accel_setup_batch;
struct accel_fit_batch;
struct accel_leaf_batch;
struct accel_triangle;

/* ---- vertices ---- */

/* Bits of accel_vertex.outside: on the wrong side of a plane. */
enum accel_outside {
	/* To be clipped off; bit i is plane i of accel_geometry_distance. */
	ACCEL_OUTSIDE_EYE = 1 << 0, /* w is not positive */
	ACCEL_OUTSIDE_NEAR = 1 << 1,
	ACCEL_OUTSIDE_FAR = 1 << 2,
	ACCEL_OUTSIDE_GUARD_LEFT = 1 << 3, /* farther than coordinates reach */
	ACCEL_OUTSIDE_GUARD_RIGHT = 1 << 4,
	ACCEL_OUTSIDE_GUARD_TOP = 1 << 5,
	ACCEL_OUTSIDE_GUARD_BOTTOM = 1 << 6,
	/* Only to see that a triangle is not visible; the scissor does the rest. */
	ACCEL_OUTSIDE_LEFT = 1 << 7,
	ACCEL_OUTSIDE_RIGHT = 1 << 8,
	ACCEL_OUTSIDE_TOP = 1 << 9,
	ACCEL_OUTSIDE_BOTTOM = 1 << 10,
	/* Not finite, or no vertex: what it belongs to is not drawn. */
	ACCEL_OUTSIDE_INFINITE = 1 << 11,
	/* To be clipped off, too: the first of the state's own planes, the others follow. */
	ACCEL_OUTSIDE_USER_BIT = 12
};
#define ACCEL_CLIP_PLANES 7
#define ACCEL_OUTSIDE_USER (((1u << ACCEL_USER_CLIP_PLANES) - 1) << ACCEL_OUTSIDE_USER_BIT)
#define ACCEL_OUTSIDE_CLIP (((1u << ACCEL_CLIP_PLANES) - 1) | ACCEL_OUTSIDE_USER)

/* Light at a point of a surface, and what tells how it may change around it. */
struct accel_sample {
	float colour[4]; /* 0 to ACCEL_COLOUR_MAX, alpha to 1 */
	float shine;     /* largest cosine between the normal and a half vector */
	float near;      /* 1/distance^2 of the nearest of viewer and lamps */
	float near_lamp; /* the same of lamps alone */
	uint8_t facing;  /* bit i: light i is above the surface */
	uint8_t in_cone; /* bit i: the point is in the cone of light i */
};

struct accel_vertex {
	int32_t x, y;     /* window, y down, ACCEL_WINDOW_BITS fraction bits */
	float w;          /* of clip space, for perspective */
	uint32_t outside; /* of enum accel_outside; x, y, w, z need all CLIP bits 0 */
	double z;         /* of the window, 0 to 1 */
	float eye[3];
	float normal[3];      /* eye space; unit at a mesh's vertices, linear between */
	float length;         /* of the normal, as light takes it; 1 if it is made unit length */
	float paint[4];       /* the mesh's colour, where it is the material's; else 1 */
	int level;            /* splits that made it, up to ACCEL_SPLIT_LEVELS */
	unsigned int sampled; /* 0 no, 1 as front, 2 as back side */
	struct accel_sample sample;
};

/* What of an edge both its triangles use. */
struct accel_edge {
	struct accel_sample middle; /* at the screen midpoint, if sampled */
	float colour[3];            /* there, as surfaces take it */
	float spread;               /* about the square of the angle between the end normals */
	bool sampled, curved, split;
	bool examine; /* its triangles may have something inside that edges do not show */
};

/* A triangle and its edges; edge i is from vertex i to the next. */
struct accel_patch {
	const struct accel_vertex *vertex[3];
	const struct accel_edge *edge[3];
	int side;
};

/* ---- fetch.c ---- */

enum accel_attribute {
	ACCEL_ATTRIBUTE_POSITION,
	ACCEL_ATTRIBUTE_NORMAL,
	ACCEL_ATTRIBUTE_COLOUR,
	ACCEL_ATTRIBUTE_EDGE
};

/* How an array is read. */
struct accel_fetch {
	const uint8_t *data; /* NULL: there is none */
	size_t step;         /* bytes from an element to the next */
	enum accel_type type;
	uint8_t size, components;    /* bytes of a number, numbers of an element */
	double factor, add, divisor; /* of a number that is not of floats */
};

/* -EINVAL: an array that is none, and a message says why. */
int accel_fetch_init(struct accel_fetch *fetch, struct accel_device *device,
		     enum accel_attribute attribute, const struct accel_array *array);
/* Components that the array does not have are 0, 0, 0, 1. There must be an array. */
void accel_fetch_element(const struct accel_fetch *fetch, uint32_t number, float out[4]);

/* ---- geometry.c ---- */

/* Clip space to the window. */
struct accel_window {
	double scale[3], offset[3];  /* window = scale * ndc + offset */
	double guard[4];             /* left, right, top, bottom, pixels */
	struct accel_bounds visible; /* viewport, scissor and target */
};

struct accel_transform {
	double clip[16], eye[16], normal[9]; /* column by column */
	double normal_scale;                 /* of what is left of normals' length; 0: it is 1 */
	bool paint_limited;                  /* to 0..1: it is drawn as it is */
	double plane[ACCEL_USER_CLIP_PLANES][4]; /* the state's own, of the space of positions */
	unsigned int planes;                     /* bit i: plane i is on */
	struct accel_window window;
};

/* Whatever the numbers, the corners stay where the rectangle was, and in order. */
void accel_geometry_intersect(struct accel_bounds *rectangle, int x, int y, int width, int height);
/* Leaves of @visible what the state's scissor has. */
void accel_geometry_scissor(const struct accel_state *state, struct accel_bounds *visible);
void accel_geometry_init(struct accel_transform *transform, const struct accel_state *state,
			 int width, int height);
/* Makes the guard band what is in view, as far as that is within it: that is where things are cut. */
void accel_geometry_view(struct accel_window *window, const struct accel_state *state);
void accel_geometry_clip_space(const struct accel_transform *transform, const float position[4],
			       double clip[4]);
/* An unpainted vertex, without light. -EINVAL: something is not finite. */
int accel_geometry_vertex(const struct accel_transform *transform, const float position[3],
			  const float *normal, struct accel_vertex *vertex);
/* The same, of vertex @i in a batch that has been transformed. */
void accel_geometry_vertex_of(const struct accel_vertex_batch *batch, int i,
			      struct accel_vertex *vertex);
/* Sets x, y, w, z; @clip has positive w. What is outside the guard band is moved to its border. */
void accel_geometry_project(const struct accel_window *window, const double clip[4],
			    struct accel_vertex *vertex);
/* Distance of @clip from a plane, positive inside; linear in @clip. */
double accel_geometry_distance(const struct accel_window *window, int plane, const double clip[4]);

/* ---- clip.c ---- */

/* So many corners clipping may add to a polygon; what a triangle may have then. */
#define ACCEL_CLIP_CORNERS (ACCEL_CLIP_PLANES + ACCEL_USER_CLIP_PLANES + 1)
#define ACCEL_POLYGON_MAX (3 + ACCEL_CLIP_CORNERS)

struct accel_corner {
	double clip[4], rest[4];                 /* rest: what clip is short of */
	double distance[ACCEL_USER_CLIP_PLANES]; /* from the state's own planes, positive inside */
	struct accel_wide cut;                   /* the same, from the plane that cuts now */
	bool boundary; /* the edge to the next corner is one of the polygon, or made by clipping */
	struct accel_vertex vertex;
};

/* A polygon that is clipped where it is. */
struct accel_clipped {
	struct accel_corner *corner, *spare; /* of which there may be */
	int most;
};

/* Sets clip, rest and distance. */
void accel_clip_corner(const struct accel_transform *transform, const float position[4],
		       struct accel_corner *corner);

/*
 * Cuts a polygon of @corners by the planes in @planes; there is room for ACCEL_CLIP_CORNERS more.
 * Returns the corners left, 0 or at least 3, projected; new ones are not sampled.
 */
int accel_clip_polygon(const struct accel_window *window, uint32_t planes,
		       const struct accel_clipped *polygon, int corners);
/* The corner from which the polygon is cut into a fan. */
int accel_clip_apex(const struct accel_corner *polygon, int corners);

/* ---- lighting.c ---- */

struct accel_lamp {
	bool point, spot, shines; /* not directional; has a cone; has a specular part */
	float position[3];        /* or the unit direction towards it */
	float half[3];            /* unit half vector, if it is the same everywhere */
	float attenuation[3];
	float cone_axis[3], cone_cosine, cone_exponent;
	float ambient[2][3], diffuse[2][3], specular[2][3]; /* times the materials */
	uint8_t bit;
};

/* One side of the material under all lights. */
struct accel_finish {
	float base[3];  /* what is the same everywhere, and takes the paint */
	float plain[3]; /* what takes none; in base if there is no paint */
	bool paints_ambient, paints_diffuse, paints_specular;
	float alpha; /* paints_diffuse: of the paint */
	float shininess;
	float faint_cosine; /* below it a highlight is not worth its power function */
	float visible_cosine, visible_sine; /* of the angle at which a highlight is lost */
	float diffuse, specular;            /* of all lights, the brightest channel */
};

struct accel_lighting {
	bool local_viewer;
	bool unit;           /* all normals have length 1 */
	float cone_exponent; /* the largest */
	int lamps;
	struct accel_lamp lamp[ACCEL_LIGHTS];
	struct accel_finish finish[2]; /* front, back */
};

/* @painted: there is paint for what the state's materials take from it. */
void accel_lighting_init(struct accel_lighting *lighting, const struct accel_state *state,
			 bool painted);
/*
 * @normal need not be unit length, and is made so; the back side has it reversed. @paint is 1 if not
 * painted.
 */
void accel_lighting_sample(const struct accel_lighting *lighting, int side, const float eye[3],
			   const float normal[3], const float paint[4],
			   struct accel_sample *sample);
/* What one lamp alone adds to the colour at a vertex. */
void accel_lighting_lamp(const struct accel_lighting *lighting, int side,
			 const struct accel_lamp *lamp, const struct accel_vertex *vertex,
			 float colour[3]);
/* accel_lighting_sample for @count vertices, at most ACCEL_BATCH. */
void accel_lighting_vertices(const struct accel_lighting *lighting, int side,
			     struct accel_vertex *const *vertex, int count);

/* ---- one call of accel_draw_mesh or accel_draw_arrays ---- */

/* What primitives are drawn as. */
enum accel_figure {
	ACCEL_FIGURE_POINTS,
	ACCEL_FIGURE_LINES,
	ACCEL_FIGURE_FILLED,
	ACCEL_FIGURE_POLYGONS /* one by one, each in the mode of its side, or captured */
};

/* Who gets what would be drawn. */
struct accel_capture {
	accel_capture_fn call; /* NULL: nobody, it is drawn */
	void *data;
};

/*
 * What is drawn has vertices with numbers of its own, 0 to @vertices - 1: those of the arrays from
 * the lowest that is needed on, or, if few of many are needed, a vertex for each element.
 */
struct accel_pass {
	struct accel_device *device; /* for messages */
	const struct accel_state *state;
	const struct accel_arrays *arrays;
	const struct accel_elements *elements;
	enum accel_figure figure; /* of all its primitives */
	bool strict;              /* a vertex that is not finite is an error */
	uint32_t base, vertices;
	const uint32_t *gather; /* vertex of the arrays of each element; NULL: base on */
	uint64_t triangles;     /* of all primitives */
	struct accel_fetch position, normal, colour, edge; /* the arrays */
	bool lit, painted;
	bool interpolated; /* points between vertices are not lit */
	bool offset;       /* depth is, as the state says for polygons that are filled */
	const struct accel_state *filled; /* the state of these, among polygons one by one */
	struct accel_capture capture;
	struct accel_transform transform;
	struct accel_lighting lighting;
	struct accel_screen *screen; /* of each vertex of the mesh (group.h) */
	struct accel_group *group;   /* memory for triangles (group.h) */
	struct accel_bin *bin;
	struct accel_draw_stats *stats;
};

/* Are vertices of the mesh the same for all triangles, or does each have its own normal there? */
static inline bool accel_pass_shares(const struct accel_pass *pass)
{
	return !pass->lit || pass->normal.data;
}

/* The last side that triangles may have: 1 if backs are lit as such. */
static inline int accel_pass_sides(const struct accel_pass *pass)
{
	return pass->lit && pass->state->two_sided ? 1 : 0;
}

static inline bool accel_pass_culls(const struct accel_pass *pass, bool back)
{
	const enum accel_cull cull = pass->state->cull;

	return cull == ACCEL_CULL_BOTH || cull == (back ? ACCEL_CULL_BACK : ACCEL_CULL_FRONT);
}

/* Draws by another state of the same light and matrices, or by the first. */
static inline void accel_pass_shade(struct accel_pass *pass, const struct accel_state *state)
{
	pass->state = state;
	pass->interpolated = !state->lighting || state->shading == ACCEL_SHADING_GOURAUD;
	pass->offset = state->offset_modes >> ACCEL_POLYGON_FILL & 1;
}

/* ---- arrays.c ---- */

/* Memory for pass->gather that is kept from call to call. */
struct accel_gather {
	uint32_t *number;
	size_t room;
};

/*
 * Looks at what pass is to draw, all but the content of its arrays. -EINVAL: no position array, or
 * what is none, and a message says what.
 */
int accel_arrays_check(struct accel_pass *pass);
/* Finds which vertices pass->elements need, which are of one figure. -ENOMEM. */
int accel_arrays_begin(struct accel_pass *pass, struct accel_gather *gather);
/* Vertex number of element @i; at least arrays->vertices: none. */
uint32_t accel_arrays_element(const struct accel_elements *elements, uint64_t i);

/* ---- primitives.c ---- */

/* How many elements of it are looked at: without indices those that are vertices. */
uint32_t accel_primitives_elements(const struct accel_pass *pass,
				   const struct accel_primitive *primitive);
enum accel_figure accel_primitives_figure(enum accel_topology topology);
/* Of what is no points and lines: how many polygons there are, each of *@corners. */
uint32_t accel_primitives_polygons(const struct accel_pass *pass,
				   const struct accel_primitive *primitive, uint32_t *corners);
/* The element that corner @i of a polygon is, and the corner that gives a flat one its colour. */
uint32_t accel_primitives_corner(enum accel_topology topology, uint32_t polygon, uint32_t i);
uint32_t accel_primitives_provoking(enum accel_topology topology);
/* May edges of its polygons be no outlines, as the array of edge flags says? */
bool accel_primitives_has_edges(enum accel_topology topology);
/* How many triangles, segments or points these make. */
uint32_t accel_primitives_triangles(const struct accel_pass *pass,
				    const struct accel_primitive *primitive);

/* A place in the list of all triangles of a pass. */
struct accel_walk {
	const struct accel_pass *pass;
	const struct accel_primitive *primitive;
	uint64_t before;    /* elements of the primitives before this one */
	uint32_t triangle;  /* of the primitive: the next one, */
	uint32_t triangles; /* of so many */
	bool whole;         /* all vertices of it, if it is a polygon, can be drawn */
	/* Of separate triangles with indices of four bytes, which most meshes are: the next one's. */
	const uint8_t *number;
};

/* Vertex of the pass that element @i of the walk's primitive is. False: it can not be drawn. */
bool accel_primitives_vertex(const struct accel_walk *walk, uint32_t i, uint32_t *vertex);
/* Begins with triangle @first, which there is. */
void accel_primitives_begin(struct accel_walk *walk, const struct accel_pass *pass, uint64_t first);
/*
 * The vertices of the next triangle, which there has to be; the last of them is the one that gives
 * a flat triangle its colour. False: the primitive is not drawn, as a vertex of it can not be.
 */
bool accel_primitives_next(struct accel_walk *walk, uint32_t index[3]);

/* ---- mesh.c ---- */

/*
 * Fills pass->screen[first] to [end - 1]. Returns the first vertex that is not finite, if pass is
 * strict, or @end. Ranges can be worked by different threads.
 */
uint32_t accel_mesh_transform(const struct accel_pass *pass, uint32_t first, uint32_t end);
/*
 * Draws triangles @first to @end - 1 of the pass. Threads can draw different ranges, each with a
 * pass whose group, bin and stats are its own.
 */
int accel_mesh_draw(struct accel_pass *pass, uint64_t first, uint64_t end);
/* Vertices @index of the pass, transformed. */
void accel_mesh_fetch(const struct accel_pass *pass, const uint32_t *index, int count,
		      struct accel_vertex_batch *batch);

/* ---- points.c, lines.c, polygons.c ---- */

/* Draw all of pass->elements, which are of that figure. */
int accel_points_draw(struct accel_pass *pass);
int accel_lines_draw(struct accel_pass *pass);
int accel_polygons_draw(struct accel_pass *pass);

/* ---- offset.c ---- */

/* What the state adds to the depth, 0 to 1, of a triangle on screen. */
double accel_offset(const struct accel_state *state, const struct accel_vertex *const vertex[3]);

/* ---- capture.c ---- */

/*
 * Gives the program what pass has of so many corners, by way of as many @captured. @flat has the
 * colour of a flat one.
 */
void accel_capture(const struct accel_pass *pass, enum accel_captured what,
		   const struct accel_corner *corner, uint32_t corners,
		   const struct accel_vertex *flat, struct accel_captured_vertex *captured);

/* ---- face.c ---- */

/* Gives all three the normal of their triangle, which is front from where it turns that way. */
void accel_face_flatten(struct accel_vertex *const vertex[3], bool clockwise);

/* ---- patch.c ---- */

/* The vertex in the middle of an edge on the screen, not sampled. */
void accel_patch_middle(const struct accel_vertex *a, const struct accel_vertex *b,
			struct accel_vertex *middle);
/* Has the middle of an edge a place of its own? */
bool accel_patch_divisible(const struct accel_vertex *a, const struct accel_vertex *b);
/* Is one of its edges curved? */
bool accel_patch_curved(const struct accel_patch *patch);
/* The middle of a triangle on the screen, not sampled. */
void accel_patch_centre(const struct accel_patch *patch, struct accel_vertex *vertex);
/* The colour in a triangle's middle of the second-order surface through what vertices and edges were sampled to. */
void accel_patch_surface_centre(const struct accel_patch *patch, float colour[3]);

/* ---- shading.c ---- */

/* Samples vertices, at most ACCEL_BATCH, for @side; a single one only if it is not so far. */
void accel_shading_vertices(const struct accel_pass *pass, struct accel_vertex *const *vertex,
			    int count, int side);
void accel_shading_vertex(const struct accel_pass *pass, struct accel_vertex *vertex, int side);
/* What the edge between two sampled vertices needs; a split only if it is divisible. */
void accel_shading_edge(const struct accel_pass *pass, const struct accel_vertex *a,
			const struct accel_vertex *b, int side, struct accel_edge *edge);
/* The same for the edges of a group from @first on. */
void accel_shading_edges(const struct accel_pass *pass, const struct accel_group *group,
			 uint32_t first);
/* Must triangles be split although none of their edges is? They have one that says examine; @count
 * is at most ACCEL_BATCH. */
void accel_shading_inside(const struct accel_pass *pass, const struct accel_patch *const *patch,
			  int count, int side, bool *inside);

/* ---- spot.c ---- */

/* Moves @colour, the light at the middle of an edge, so that no spot's curve takes light away. */
void accel_spot_bound(const struct accel_pass *pass, const struct accel_vertex *a,
		      const struct accel_vertex *middle, const struct accel_vertex *b, int side,
		      float colour[3]);

/* ---- interpolate.c ---- */

/* Are all edges straight lines, whatever the colours? */
bool accel_interpolate_straight(const struct accel_vertex *const vertex[3]);
/* As accel_shading_edge and accel_shading_inside, of one, where pass->interpolated. */
void accel_interpolate_edge(const struct accel_vertex *a, const struct accel_vertex *b,
			    struct accel_edge *edge);
bool accel_interpolate_inside(const struct accel_patch *patch);

/* ---- setup.c ---- */

/*
 * An edge from row to row. In row @row it is at x, and r / dy is what that is more than its exact
 * place; with each row on, it moves by dx / dy.
 */
struct accel_line {
	int32_t row, x;
	uint32_t r;
	int32_t dx, dy; /* without common powers of two */
	int32_t step;   /* dx / dy, and */
	uint32_t m;     /* its remainder; 0 if the edge crosses one row */
};

/* The pixels of a row: left <= x < right. */
struct accel_row {
	int32_t left, right;
};

/* Rows of a small triangle are kept: many triangles have no more. */
#define ACCEL_SETUP_ROWS 16
/* Most have no more than this; those are found in batches, and with them what they come to. */
#define ACCEL_LOOP_ROWS 8
#define ACCEL_BAND_ROWS 64

struct accel_setup {
	int first, turn, end; /* rows; @turn is where the two short edges meet */
	bool right_turns;     /* middle takes the place of the right edge at @turn */
	bool narrow;          /* fits edges_compact */
	struct accel_line left, right, middle;
	struct accel_row row[ACCEL_SETUP_ROWS]; /* from @first on, as many as there are */
	/* If there are no more than ACCEL_LOOP_ROWS: how many pixels they have, visible or not, in
	 * which box, and the first of them in its row. */
	int pixels, start;
	struct accel_bounds box;
};

/* Are the edge's numbers small enough for the core? */
bool accel_setup_edge_fits(const struct accel_vertex *a, const struct accel_vertex *b);
/* accel_surface_area, of points. */
static inline int64_t accel_setup_area(const struct accel_point *a, const struct accel_point *b,
				       const struct accel_point *c)
{
	return (int64_t)(b->x - a->x) * (c->y - a->y) - (int64_t)(c->x - a->x) * (b->y - a->y);
}

/* The edges of a triangle that has an area; false: it crosses no row. */
bool accel_setup_init(struct accel_setup *setup, const struct accel_vertex *const vertex[3]);
/*
 * The same for triangle @i of a batch whose edges have been found; false: no pixel of @visible is
 * in it. A large triangle is not looked at.
 */
bool accel_setup_draws(const struct accel_setup_batch *batch, int i,
		       const struct accel_bounds *visible, struct accel_setup *setup);
/* The left or right edge in a row. */
const struct accel_line *accel_setup_line(const struct accel_setup *setup, int row, bool right);
/* Where an edge is in a row, its own or one after that. */
int32_t accel_setup_at(const struct accel_line *line, int row, uint32_t *r);
/*
 * Rows @first to @end - 1 of the triangle, at most ACCEL_BAND_ROWS: in @room, or where they are
 * kept.
 */
const struct accel_row *accel_setup_rows(const struct accel_setup *setup, int first, int end,
					 struct accel_row *room);

#endif
