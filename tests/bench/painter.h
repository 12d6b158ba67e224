/* SPDX-License-Identifier: MIT */
/*
 * Painters draw one scene in different ways, to be compared: each is a process of its own, so that
 * its processor time is all that its way takes, in whatever threads, and that what chooses a driver
 * of Mesa, the environment, is its own.
 */
#ifndef TESTS_BENCH_PAINTER_H
#define TESTS_BENCH_PAINTER_H

#include "scene/scene.h"

#define PAINTER_MESSAGE 256

struct way;

/* What a painter does, in its process, which ends after the last call. */
struct painter_ops {
	/*
	 * Makes what draws pictures of @scene's size. @message: who draws, if anybody else. NULL
	 * after @message: what is missing, and where to get it.
	 */
	void *(*open)(const struct way *way, const struct scene *scene,
		      char message[PAINTER_MESSAGE]);
	/* Draws; the picture is complete when it returns. -errno */
	int (*draw)(void *painter, const struct scene *scene);
	/* Reads the last picture as accel_target_read does, without gaps. -errno */
	int (*read)(void *painter, uint32_t *colour, uint32_t *depth);
};

extern const struct painter_ops painter_library; /* on a device */
extern const struct painter_ops painter_phong;   /* per-pixel Phong in plain C, scene/phong.h */
extern const struct painter_ops painter_gl;      /* OpenGL, by a driver of Mesa's */

/* A way to draw. */
struct way {
	const char *name; /* as figures have it */
	const struct painter_ops *ops;
	const char *device;         /* the library's, */
	enum accel_shading shading; /* and how it shades there */
	const char *driver;         /* Mesa's; */
	bool per_pixel;             /* a shader of it lights each pixel */
	bool as_gouraud; /* draws what the library does with Gouraud, not per-pixel Phong */
	double nmse;     /* the most that its pictures may be away from that */
};

struct painter {
	const struct way *way;
	int process, link;
	size_t pixels;
	uint32_t *colour, *depth; /* of the last picture that was read; shared with the process */
};

struct painter_cost {
	double processor, wall; /* seconds */
};

/*
 * Starts a painter of pictures of @scene's size. It has a copy of the program's memory, so the mesh
 * of any scene that it is to draw must be there already. @message: who draws, or empty. -ENODEV
 * after @message: what it needs is missing; another -errno after @message.
 */
int painter_start(struct painter *painter, const struct way *way, const struct scene *scene,
		  char message[PAINTER_MESSAGE]);
/* Draws @scene. @cost may be NULL. -errno; -EPIPE: the process has ended. */
int painter_draw(struct painter *painter, const struct scene *scene, struct painter_cost *cost);
/* Draws @scene with its depth, and reads both. -errno */
int painter_picture(struct painter *painter, const struct scene *scene);
void painter_stop(struct painter *painter);

#endif
