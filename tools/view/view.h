/* SPDX-License-Identifier: MIT */
/*
 * gloss-view: draws meshes. Options say what; a view is the mesh, the device
 * and the scene they make; draw, compare, turntable and window are what can be
 * done with it.
 */
#ifndef TOOLS_GLOSS_VIEW_H
#define TOOLS_GLOSS_VIEW_H

#include "scene/mesh.h"
#include "scene/phong.h"
#include "scene/picture.h"
#include "scene/scene.h"

enum { VIEW_OK, VIEW_FAILED, VIEW_USAGE }; /* exit status */

#define VIEW_SIZE_MAX 16384 /* pixels of a picture's side */

struct view_options {
	const char *mesh, *device;
	int width, height;
	enum accel_shading shading;
	struct accel_material material;
	bool recoloured;                        /* the mesh's own colours are not wanted */
	struct accel_light light[ACCEL_LIGHTS]; /* positions from the middle of the mesh */
	int lights;
	struct mesh_options reading;
	bool two_sided;
	float upright[2]; /* degrees about x and z that turn the mesh's up to y */
	float rotate[3];  /* degrees about x, y and z */
	float camera[2];  /* degrees to the right and up */
	float zoom, fov;  /* fov 0: no perspective */
	float background[4];
	const char *out, *compare;
	int turntable; /* frames, 0: one picture */
	bool stats, window;
	bool done; /* --help or --version was answered */
};

/* What hands on the window have changed, and a file can not be asked for. */
struct view_hand {
	float move[3]; /* of the eye, radii to the right, up and back */
	float look;    /* degrees to the right */
};

struct view {
	const struct view_options *options;
	struct mesh mesh;
	float centre[3], radius; /* of the sphere that holds the mesh */
	float eye[3];            /* radii from the middle: right, up, towards the eye */
	float half_height;       /* of the picture without perspective, radii */
	struct view_hand hand;
	struct scene scene;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct picture part;           /* of a picture that is larger than a target */
	uint32_t *depth;               /* of the last frame's pixels; NULL: not wanted */
	uint64_t visible;              /* pixels of the mesh, by the depth */
	struct accel_draw_stats stats; /* of the last frame */
	uint64_t clocks;               /* of the last frame, 0: not known */
};

/* options.c: VIEW_OK or VIEW_USAGE, after a message. */
int view_options_parse(struct view_options *options, int argc, char **argv);
/* Prints "gloss-view: what: where: hint". */
void view_error(const char *what, const char *where, const char *hint);

/* material.c */
const struct accel_material *view_material_find(const char *name);
/* All names in one line. */
const char *view_material_names(void);

/* light.c: KIND:X,Y,Z[:SETTING=VALUE]... */
bool view_light_parse(const char *text, struct accel_light *light);

/* number.c: false for anything but the number, finite and in range. */
bool view_number(const char *text, float low, float high, float *value);
/* Exactly @count numbers with commas between. */
bool view_numbers(const char *text, int count, float low, float high, float *value);
/* "#rrggbb", "R,G,B" or "GREY", 0 to 1; sets alpha to 1. */
bool view_colour(const char *text, float rgba[4]);

/* camera.c: places the eye so that the mesh fits the picture; also while it turns. */
void view_camera_frame(struct view *view);
/* Sets the scene's matrices and lights; @turn degrees more about y. */
void view_camera_set(struct view *view, float turn);

/* draw.c: 0, or VIEW_FAILED after a message. */
/* The mesh and the scene that it makes, without a board. */
int view_load(struct view *view, const struct view_options *options);
int view_open(struct view *view, const struct view_options *options);
void view_close(struct view *view);
/*
 * Draws the scene with @shading into @picture, which has the scene's size, and into view->depth
 * if there is one. A picture larger than a target is drawn part by part.
 */
int view_draw(struct view *view, enum accel_shading shading, struct picture *picture);
/* Makes picture and eye fit the size of the options. */
int view_resize(struct view *view);
void view_set_sides(struct view *view, bool two_sided);
int view_write(const struct picture *picture, const char *path);
const char *view_shading_name(enum accel_shading shading);

/* stats.c */
void view_stats_print(const struct view *view);

/* compare.c, turntable.c, window.c: VIEW_OK, or VIEW_FAILED after a message. */
int view_compare(struct view *view, const char *path);
int view_turntable(struct view *view);
int view_window(struct view *view);

/* progress.c: a line on stderr, if that is a terminal. */
struct waiting {
	const char *what;
	double start; /* seconds */
	bool shown;
};

/* Shows what is waited for, and for how long, once that is a second. */
void waiting_begin(struct waiting *waiting, const char *what);
void waiting_show(void *waiting);
/* Takes the line away. */
void waiting_end(struct waiting *waiting);

struct progress {
	bool shown;
	int total;
	double start, last; /* seconds */
};

void progress_begin(struct progress *progress, int total);
void progress_show(struct progress *progress, int done);
void progress_end(struct progress *progress);

#endif
