// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contest.h"

#define DEVICE "model:threads=1"

static const struct way ways[CONTEST_WAYS] = {
	[CONTEST_GLOSS] = { "gloss", &painter_library, .device = DEVICE,
			    .shading = ACCEL_SHADING_ADAPTIVE, .nmse = 2.5e-4 },
	[CONTEST_THREADS] = { "threads2", &painter_library, .device = "model:threads=2",
			      .shading = ACCEL_SHADING_ADAPTIVE, .nmse = 2.5e-4 },
	[CONTEST_GOURAUD] = { "gouraud", &painter_library, .device = DEVICE,
			      .shading = ACCEL_SHADING_GOURAUD, .nmse = 5e-3 },
	[CONTEST_CPHONG] = { "cphong", &painter_phong, .nmse = 1e-5 },
	[CONTEST_LLVMPIPE_GOURAUD] = { "llvmpipe_gouraud", &painter_gl, .driver = "llvmpipe",
				       .as_gouraud = true, .nmse = 1e-4 },
	[CONTEST_LLVMPIPE_PHONG] = { "llvmpipe_phong", &painter_gl, .driver = "llvmpipe",
				     .per_pixel = true, .nmse = 1e-4 },
	[CONTEST_SOFTPIPE_GOURAUD] = { "softpipe_gouraud", &painter_gl, .driver = "softpipe",
				       .as_gouraud = true, .nmse = 1e-4 },
	[CONTEST_SOFTPIPE_PHONG] = { "softpipe_phong", &painter_gl, .driver = "softpipe",
				     .per_pixel = true, .nmse = 1e-4 },
};

const char *contest_name(enum contest_way way)
{
	return ways[way].name;
}

bool contest_has(const struct contest *contest, enum contest_way way)
{
	return contest->painter[way].way != NULL;
}

/* What a driver lacks is no failure. */
static int start(struct contest *contest, const struct scene *scene, enum contest_way way)
{
	char message[PAINTER_MESSAGE];
	int ret = painter_start(&contest->painter[way], &ways[way], scene, message);

	if (!ret) {
		if (message[0])
			printf("# %s: %s\n", contest_name(way), message);
		return 0;
	}
	if (ret == -ENODEV && ways[way].driver) {
		fprintf(stderr, "skip: %s: %s\n", contest_name(way), message);
		return 0;
	}
	fprintf(stderr, "%s: %s\n", contest_name(way), message);
	return ret;
}

int contest_begin(struct contest *contest, const struct scene *scene, unsigned int which)
{
	int ret = 0;

	memset(contest, 0, sizeof(*contest));
	for (enum contest_way way = 0; way < CONTEST_WAYS && !ret; way++)
		if (which >> way & 1)
			ret = start(contest, scene, way);
	if (ret)
		contest_end(contest);
	return ret;
}

void contest_end(struct contest *contest)
{
	for (enum contest_way way = 0; way < CONTEST_WAYS; way++)
		painter_stop(&contest->painter[way]);
}

/* ---- processor time ---- */

static int add_sample(struct contest *contest, const struct scene *scenes, int count,
		      enum contest_way way)
{
	struct painter_cost cost;
	double sum = 0;
	int ret = 0;

	for (int i = 0; i < count && !ret; i++) {
		ret = painter_draw(&contest->painter[way], &scenes[i], &cost);
		sum += cost.processor;
		if (!contest->rounds[way] || cost.wall < contest->wall[way][i])
			contest->wall[way][i] = cost.wall;
	}
	if (ret) {
		fprintf(stderr, "%s: can not draw: %s\n", contest_name(way), strerror(-ret));
		return ret;
	}
	contest->sample[way][contest->rounds[way]++] = sum;
	return 0;
}

int contest_round(struct contest *contest, const struct scene *scenes, int count,
		  unsigned int which)
{
	int ret = 0;

	for (enum contest_way way = 0; way < CONTEST_WAYS && !ret; way++)
		if (which >> way & 1 && contest_has(contest, way))
			ret = add_sample(contest, scenes, count, way);
	return ret;
}

static int order(const void *a, const void *b)
{
	const double *x = a, *y = b;

	return (*x > *y) - (*x < *y);
}

static struct contest_spread spread(double sample[CONTEST_ROUNDS], int rounds)
{
	qsort(sample, rounds, sizeof(*sample), order);
	return (struct contest_spread){
		.median = (sample[(rounds - 1) / 2] + sample[rounds / 2]) / 2,
		.least = sample[0],
		.most = sample[rounds - 1],
		.rounds = rounds,
	};
}

struct contest_spread contest_cost(const struct contest *contest, enum contest_way way)
{
	double sample[CONTEST_ROUNDS];

	memcpy(sample, contest->sample[way], sizeof(sample));
	return spread(sample, contest->rounds[way]);
}

struct contest_spread contest_speed(const struct contest *contest, enum contest_way way)
{
	double sample[CONTEST_ROUNDS] = { 0 };

	for (int i = 0; i < contest->rounds[way]; i++)
		sample[i] = contest->sample[way][i] / contest->sample[CONTEST_GLOSS][i];
	return spread(sample, contest->rounds[way]);
}

double contest_threads(const struct contest *contest)
{
	double one = 0, two = 0;

	for (int i = 0; i < CONTEST_SCENES; i++) {
		one += contest->wall[CONTEST_GLOSS][i];
		two += contest->wall[CONTEST_THREADS][i];
	}
	return one / two;
}
