/* SPDX-License-Identifier: MIT */
/*
 * What OpenGL 1.5's fixed function makes of vertices, in double precision: written from the
 * specification, whose sections are named, and sharing nothing with what it judges. Window
 * coordinates are OpenGL's: y goes up. Two things are the product's own choice where OpenGL leaves
 * one: vertices are rounded to 1/16 pixel, and of pixel centres on edges the left and top ones are
 * inside.
 */
#ifndef ORACLE_H
#define ORACLE_H

#include <stdbool.h>

#define ORACLE_LIGHTS 8
#define ORACLE_PLANES 6
/* A polygon of a primitive has up to so many corners, and each plane adds one. */
#define ORACLE_POLYGON 12
#define ORACLE_CORNERS (ORACLE_POLYGON + 2 + ORACLE_PLANES)
#define ORACLE_ROUND 16 /* window coordinates are multiples of 1 / ORACLE_ROUND pixel */

enum oracle_topology {
	ORACLE_POINTS,
	ORACLE_LINES,
	ORACLE_LINE_LOOP,
	ORACLE_LINE_STRIP,
	ORACLE_TRIANGLES,
	ORACLE_TRIANGLE_STRIP,
	ORACLE_TRIANGLE_FAN,
	ORACLE_QUADS,
	ORACLE_QUAD_STRIP,
	ORACLE_ONE_POLYGON,
	ORACLE_TOPOLOGIES
};

enum oracle_normals { ORACLE_AS_GIVEN, ORACLE_RESCALED, ORACLE_NORMALISED };

enum oracle_cull { ORACLE_CULL_NONE, ORACLE_CULL_BACK, ORACLE_CULL_FRONT };

/* Bits of what COLOR_MATERIAL lets follow the current colour. */
#define ORACLE_EMISSION 1u
#define ORACLE_AMBIENT 2u
#define ORACLE_DIFFUSE 4u
#define ORACLE_SPECULAR 8u

enum oracle_side { ORACLE_FRONT, ORACLE_BACK, ORACLE_SIDES };

struct oracle_material {
	double emission[4], ambient[4], diffuse[4], specular[4], shininess;
};

/* In eye space. */
struct oracle_light {
	bool enabled;
	double position[4], ambient[4], diffuse[4], specular[4], attenuation[3];
	double spot_direction[3], spot_exponent, spot_cutoff; /* degrees; 180: no spot */
};

/* Matrices are column by column. */
struct oracle_state {
	double modelview[16], projection[16];
	double viewport[4]; /* x and y of the lower left corner, width, height */
	double near, far;   /* the depth range */
	enum oracle_normals normals;
	bool lighting, local_viewer, two_sided, separate_specular, flat, front_clockwise;
	enum oracle_cull cull;
	unsigned int follow[ORACLE_SIDES]; /* COLOR_MATERIAL: what of a side follows the colour */
	double ambient[4];
	struct oracle_material material[ORACLE_SIDES];
	struct oracle_light light[ORACLE_LIGHTS];
	bool lit_pixels; /* not OpenGL's: lit at each pixel, which better shading is to be like */
	double point_size, point_least, point_most, point_attenuation[3], line_width;
	unsigned int stipple;
	int stipple_repeat;  /* 0: lines have no stipple */
	unsigned int planes; /* bits of user clip planes that are enabled */
	double plane[ORACLE_PLANES][4];
};

/* As a program gives it. */
struct oracle_vertex {
	double position[4], normal[3], colour[4];
};

/* Transformed, the normal too, and lit. The second colour is that of separate highlights. @length is
 * that of the normal, which along a cut edge changes evenly, as the normal itself does not. */
struct oracle_corner {
	double eye[4], clip[4], normal[3], length, current[4];
	double colour[ORACLE_SIDES][2][4];
};

/* A point, line or polygon: numbers of its vertices in order, and whose colour it has if flat. */
struct oracle_primitive {
	int corners, vertex[ORACLE_POLYGON], provoking;
};

struct oracle_pixel {
	bool drawn;
	double colour[4], depth; /* 0 to 1 */
	double slope;            /* of depth, from a pixel to the next */
	double inside;           /* pixels to the nearest edge of its polygon */
	double slack[5]; /* of colour and depth, from rounding the corners of what is no triangle */
	bool either;     /* of a line that passes between two pixels: drawn or not */
};

/* In the window; x and y are in units of 1 / ORACLE_ROUND pixel. */
struct oracle_place {
	double x, y, z, w;
};

/*
 * @doubtful: something hung on less than is certain in other arithmetic: the rounding of a corner
 * half way between two sixteenths, a vertex at the rim of a spot, a polygon seen from its edge.
 */
struct oracle_picture {
	int width, height;
	struct oracle_pixel *pixel; /* rows from the bottom */
	bool doubtful;
};

/* A state as a context begins with (tables 6.6 to 6.9), with a viewport. */
void oracle_state_init(struct oracle_state *state, int width, int height);

/* oracle_light.c: the normal in eye space (2.10.3), as given if it has no inverse. */
void oracle_normal(const struct oracle_state *state, const double normal[3], double out[3]);
/* The light at @eye (2.14.1) from normal and current colour, not limited; true: it is in doubt. */
bool oracle_light(const struct oracle_state *state, enum oracle_side side, const double eye[4],
		  const double normal[3], const double current[4], double colour[2][4]);

/* oracle_assemble.c: the primitive of number @n; false: the @vertices are not enough for it. */
bool oracle_assemble(enum oracle_topology topology, int vertices, int n,
		     struct oracle_primitive *primitive);

/* oracle_clip.c: what of the polygon is between near and far plane and inside the user's planes
 * (2.11); returns how many corners that has, and sets @cut if it is not all. */
int oracle_clip(const struct oracle_state *state, struct oracle_corner polygon[ORACLE_CORNERS],
		int corners, bool *cut);
/* The same of a line's two ends; false: nothing is left. */
bool oracle_clip_line(const struct oracle_state *state, struct oracle_corner end[2]);
/* Whether a point is in the view, to whose sides it is clipped too, and inside the planes. */
bool oracle_in_view(const struct oracle_state *state, const struct oracle_corner *corner,
		    bool *doubt);

/*
 * oracle_raster.c: draws a polygon over what is in the picture (3.5.1). Colours and depth are those
 * of the plane of its largest triangle. Of one that was @cut, or has more than three corners, they
 * are of before corners are rounded, as how it is made of triangles decides which of them count.
 */
void oracle_polygon(const struct oracle_state *state, const struct oracle_corner *polygon,
		    int corners, bool cut, struct oracle_picture *picture);

/* Where a corner is in the window, rounded. */
struct oracle_place oracle_place(const struct oracle_state *state, const double clip[4],
				 bool *doubt);

/* oracle_strokes.c: draw over what is in the picture. @stippled counts the fragments of a line and those
 * after it that go on with its stipple. */
void oracle_point(const struct oracle_state *state, const struct oracle_corner *corner,
		  struct oracle_picture *picture);
void oracle_line(const struct oracle_state *state, const struct oracle_corner ends[2],
		 int *stippled, struct oracle_picture *picture);

/* oracle.c: the vertex transformed and lit (2.10 to 2.14.1), colours limited (2.14.6); true: its
 * light is in doubt. */
bool oracle_transform(const struct oracle_state *state, const struct oracle_vertex *vertex,
		      struct oracle_corner *corner);
/* All primitives of the vertices, in order, each over those before. */
void oracle_draw(const struct oracle_state *state, enum oracle_topology topology,
		 const struct oracle_vertex *vertex, int vertices, struct oracle_picture *picture);

#endif
