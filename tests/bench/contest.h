/* SPDX-License-Identifier: MIT */
/*
 * One scene drawn in all ways, which take turns; whether they draw the same picture, and how much
 * faster than another the library draws it.
 */
#ifndef TESTS_BENCH_CONTEST_H
#define TESTS_BENCH_CONTEST_H

#include "painter.h"

enum contest_way {
	CONTEST_GLOSS,   /* adaptive shading on the model, with one thread */
	CONTEST_THREADS, /* the same with two threads */
	CONTEST_GOURAUD, /* Gouraud shading there: what OpenGL's Gouraud is compared with */
	CONTEST_CPHONG,
	CONTEST_LLVMPIPE_GOURAUD,
	CONTEST_LLVMPIPE_PHONG,
	CONTEST_SOFTPIPE_GOURAUD,
	CONTEST_SOFTPIPE_PHONG,
	CONTEST_WAYS
};

#define CONTEST_ROUNDS 32
#define CONTEST_SCENES 8

struct contest {
	struct painter painter[CONTEST_WAYS]; /* without a way: not there */
	int rounds[CONTEST_WAYS];
	double sample[CONTEST_WAYS][CONTEST_ROUNDS]; /* processor seconds of a round */
	double wall[CONTEST_WAYS][CONTEST_SCENES];   /* least seconds that a scene took */
};

/* Of some rounds. */
struct contest_spread {
	double median, least, most;
	int rounds;
};

/* The way's name in figures. */
const char *contest_name(enum contest_way way);

/*
 * Starts the painters of the ways that are in @which, a bit each, for scenes of @scene's size and
 * mesh. A way whose driver is missing is left out; stderr says so. -errno after a message.
 */
int contest_begin(struct contest *contest, const struct scene *scene, unsigned int which);
void contest_end(struct contest *contest);
bool contest_has(const struct contest *contest, enum contest_way way);

/*
 * Whether all ways draw the same pictures of @count scenes: those that light each pixel, and the
 * library's, as per-pixel Phong in plain C does; OpenGL's Gouraud as the library's. Prints how far
 * they are, and the bounds. -EIO: one is too far, and stderr says which; another -errno.
 */
int contest_compare(struct contest *contest, const struct scene *scenes, int count,
		    const char *name);

/* A round, of at most CONTEST_SCENES: each way of @which draws all @scenes, one way after the other. -errno after a message. */
int contest_round(struct contest *contest, const struct scene *scenes, int count,
		  unsigned int which);

/* Processor seconds of @way's rounds. */
struct contest_spread contest_cost(const struct contest *contest, enum contest_way way);
/* The library's speed over that of @way: of the quotients of each round. */
struct contest_spread contest_speed(const struct contest *contest, enum contest_way way);
/* Wall time of the library with one thread over that with two: of the least times of each scene. */
double contest_threads(const struct contest *contest);

#endif
