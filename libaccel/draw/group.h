/* SPDX-License-Identifier: MIT */
/*
 * Triangles of a mesh that are seen, worked together. Each stage is a loop over what the one before
 * has found, in batches that know of nothing but their own range:
 *
 *   mesh.c    puts faces in, in the order of the mesh: what is culled never gets here
 *   group.c   link: the vertices that faces need, each once, and the edges between them
 *   face.c    transforms and lights the vertices, lights the edges, and draws the faces in order
 *
 * A group has a bounded number of faces, so that its memory is bounded; of a larger mesh only what
 * two groups share is worked twice.
 */
#ifndef ACCEL_DRAW_GROUP_H
#define ACCEL_DRAW_GROUP_H

#include "draw/kernel.h"

#define ACCEL_GROUP_FACES 2048u
#define ACCEL_NONE UINT32_MAX

/* What is known of a vertex of the mesh when triangles are culled; as in accel_vertex. */
struct accel_screen {
	struct accel_point at;
	uint32_t outside;
};

#define ACCEL_FEW 2

struct accel_pixel {
	int x, y;
};

/* Of a triangle that has so few, in a lit mesh with adaptive shading: its pixels, and their light. */
struct accel_few {
	int count; /* 0: there are more */
	struct accel_pixel pixel[ACCEL_FEW];
	float colour[ACCEL_FEW][4];
};

struct accel_face {
	uint32_t vertex[3]; /* of the mesh; after accel_group_link of the group */
	uint32_t flat;      /* vertex that gives a flat triangle its colour, likewise */
	uint32_t edge[3];   /* of the group; ACCEL_NONE: not looked at */
	int side;
	bool clipped; /* its vertices are of the group from the beginning */
	struct accel_setup setup;
	struct accel_few few;
};

/* A vertex's place in the mesh, and its edges. */
struct accel_link {
	uint32_t index; /* ACCEL_NONE: clipping made it, and it is complete */
	uint32_t other; /* the same vertex with its other side; or ACCEL_NONE */
	uint32_t edge;  /* the first of those that begin here; or ACCEL_NONE */
	int side;
};

/* An edge's vertices in the group. */
struct accel_ends {
	uint32_t a, b;
	uint32_t next; /* the next edge that begins at @a; or ACCEL_NONE */
	/* If it is split: its middle, and the edge from @a to there, after which that to @b comes. */
	uint32_t middle, half; /* middle: or ACCEL_NONE */
};

/* A face that is split, or a part of it. */
struct accel_part {
	uint32_t vertex[3], edge[3]; /* of the group; edge i is from vertex i to the next */
	uint32_t child;              /* the first of its own parts, */
	int children;                /* so many; 0: it is drawn as it is, or covers no pixel */
	int splits;                  /* how many of its edges are split */
	int side;
	bool draws;
	struct accel_setup setup; /* if it draws; not of a face */
	struct accel_few few;     /* likewise */
};

struct accel_group {
	uint32_t *of; /* vertex of the group that one of the mesh is; ACCEL_NONE: none so far */
	uint32_t of_room;
	uint32_t faces, faces_room;
	struct accel_face *face;
	uint32_t vertices, vertices_room;
	struct accel_vertex *vertex;
	struct accel_link *link; /* as many */
	uint32_t edges, edges_room;
	struct accel_edge *edge;
	struct accel_ends *ends; /* as many */
	uint32_t parts, parts_room;
	struct accel_part *part;
};

/* ---- group.c ---- */

/* Room for a mesh of so many. -ENOMEM. */
int accel_group_reserve(struct accel_group *group, uint32_t vertices, uint32_t triangles);
void accel_group_free(struct accel_group *group);
/* Room for so many more, while faces are split. -ENOMEM. */
int accel_group_reserve_parts(struct accel_group *group, uint32_t vertices, uint32_t edges,
			      uint32_t parts);
/* Forgets all faces, and that vertices of the mesh were needed. */
void accel_group_reset(struct accel_group *group);
/*
 * Has it no room for another batch, and for what a clipped triangle may become? Vertices may be
 * there for which no face is, as it covers no pixel.
 */
bool accel_group_full(const struct accel_group *group);
/* A new face, of which nothing is set. */
struct accel_face *accel_group_face(struct accel_group *group);
/* New ones, of which a vertex has no content yet, and which nothing else shares; their numbers. */
uint32_t accel_group_vertex(struct accel_group *group, int side);
uint32_t accel_group_edge(struct accel_group *group, uint32_t a, uint32_t b);
/*
 * Finds the vertices of all faces; @shared: faces with the same vertex of the mesh have the same
 * one here, else each has its own.
 */
void accel_group_link(struct accel_group *group, bool shared);
/* Finds the edges of a face. */
void accel_group_link_edges(struct accel_group *group, struct accel_face *face);

/* ---- mesh.c ---- */

/* Triangles that face the eye, whose edges are found together. */
struct accel_seen {
	int count;
	uint32_t vertex[ACCEL_BATCH][3], flat[ACCEL_BATCH];
	int side[ACCEL_BATCH];
	struct accel_setup_batch batch;
};

/* One more, which has an area; there is room. @flat: the vertex that gives it its colour. */
void accel_mesh_see(struct accel_seen *seen, const struct accel_point *const point[3],
		    const uint32_t vertex[3], uint32_t flat, int side);
/*
 * Puts them into the group, unless they cover no pixel; returns how many do. @of_group: their
 * vertices are those of the group.
 */
int accel_mesh_put(struct accel_pass *pass, struct accel_seen *seen, bool of_group);
/* Sets of @corner, which is vertex @index of the pass, all but the vertex. */
void accel_mesh_corner(const struct accel_pass *pass, uint32_t index, struct accel_corner *corner);
/* Cuts the triangle of vertices @index, which are @vertex, by @planes; as accel_clip_polygon. */
int accel_mesh_clip(const struct accel_pass *pass, const struct accel_vertex vertex[3],
		    const uint32_t index[3], uint32_t planes,
		    struct accel_corner polygon[ACCEL_POLYGON_MAX]);

/* ---- strokes.c ---- */

/* Vertices of points and lines that are lit together, and what these become. */
struct accel_strokes {
	int count;
	uint32_t index[ACCEL_BATCH]; /* of the pass */
	struct accel_vertex vertex[ACCEL_BATCH];
	struct accel_seen seen;
};

/* Fetches and lights the vertices, all as front sides. */
void accel_strokes_light(const struct accel_pass *pass, struct accel_strokes *strokes);
/*
 * Draws a convex figure of 3 or 4 corners, of which only place, depth and colour are looked at.
 * @flat has the colour of a flat one.
 */
int accel_strokes_fill(struct accel_pass *pass, struct accel_strokes *strokes,
		       const struct accel_vertex *corner, int corners,
		       const struct accel_vertex *flat);
/* Draws what is left in @strokes. */
int accel_strokes_flush(struct accel_pass *pass, struct accel_strokes *strokes);

/* ---- lines.c, points.c ---- */

/* Lines that are drawn one after the other, for the stipple. */
struct accel_lines {
	struct accel_pass *pass;
	int32_t half;    /* of the width */
	double distance; /* along the line so far, pixels */
	struct accel_strokes strokes;
};

void accel_lines_begin(struct accel_lines *lines, struct accel_pass *pass);
/* A segment of which nothing is to be cut off. */
int accel_lines_put(struct accel_lines *lines, const struct accel_vertex *a,
		    const struct accel_vertex *b, const struct accel_vertex *flat);
/* The same, given to the program. */
void accel_lines_capture(struct accel_lines *lines, const struct accel_corner corner[2],
			 const struct accel_vertex *flat);
/* A point whose middle is in view. */
int accel_points_put(struct accel_pass *pass, struct accel_strokes *strokes,
		     const struct accel_vertex *vertex);

/* ---- few.c ---- */

/* Finds the pixels, whether or not they are visible; a triangle of no pixel has more. */
void accel_few_find(struct accel_few *few, const struct accel_pass *pass,
		    const struct accel_setup *setup);
/* Lights them. Of the @count patches only vertices and side are looked at. */
void accel_few_light(const struct accel_pass *pass, const struct accel_patch *patch,
		     struct accel_few *const *few, int count);
/* Makes it triangle @i of a batch (kernel.h) that finds the surfaces through this light. */
void accel_few_put(const struct accel_few *few, int i, struct accel_few_batch *batch,
		   struct accel_fit_batch *fit);

/* ---- split.c ---- */

/* May a triangle of these edges have to be split? Most need not be looked at any farther. */
static inline bool accel_split_may(const struct accel_group *group, const uint32_t edge[3])
{
	const struct accel_edge *a = &group->edge[edge[0]], *b = &group->edge[edge[1]];
	const struct accel_edge *c = &group->edge[edge[2]];

	return a->split | b->split | c->split | a->examine | b->examine | c->examine;
}
/*
 * How many edges of such triangles are to be split, 0 to 3, as their edges and the light inside of
 * them say. @count is at most ACCEL_BATCH.
 */
void accel_split_decide(const struct accel_pass *pass, const struct accel_patch *patch, int count,
			int *splits);
/* A face that is to be split, as a part; returns its number. There is room. */
uint32_t accel_split_root(struct accel_group *group, const struct accel_face *face, int splits);
/* Splits the roots, and their parts, until none is to be split any more. -ENOMEM. */
int accel_split_all(const struct accel_pass *pass);
/* Forgets all parts; @vertices and @edges were there before. */
void accel_split_forget(struct accel_group *group, uint32_t vertices, uint32_t edges);

/* ---- leaf.c ---- */

/* A face that is not split, or a part that is not. */
struct accel_leaf {
	const struct accel_setup *setup;
	const struct accel_depth_plane *plane;
	const struct accel_small *small; /* of a face; NULL: not found so far */
	const struct accel_few *few;
	const struct accel_vertex *flat; /* of a flat triangle: has its colour */
	struct accel_patch patch;
	bool edged; /* has the patch edges? */
};

struct accel_leaves {
	int count;
	struct accel_leaf leaf[ACCEL_BATCH];
};

/* Draws them, and forgets them. */
int accel_leaf_flush(struct accel_pass *pass, struct accel_leaves *leaves);

/* ---- face.c ---- */

/* Draws all faces of pass->group, and forgets them. */
int accel_face_draw_all(struct accel_pass *pass);

#endif
