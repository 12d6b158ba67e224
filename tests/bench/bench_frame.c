// SPDX-License-Identifier: MIT
/*
 * bench_frame [--pictures] [--short] MODELS
 *
 * Frames per processor second of the library on its model, adaptive shading, against fixed-function
 * Gouraud and a per-pixel Phong shader on Mesa's llvmpipe and softpipe, and against per-pixel Phong
 * in plain C: the same meshes, materials, lights, cameras and sizes. The scenes are those of
 * gloss-view --turntable 8 --size 1280x720, of the bunny and the horse in the folder MODELS, and of
 * a sphere.
 *
 * First the pictures of all ways are compared, and a difference is a failure: nobody measures a
 * wrong picture. --pictures does no more than that, on two small ones. Then the ways take turns, eight
 * frames each, and the median of the rounds' quotients counts. --short is one round, and no aim is
 * missed. What Mesa lacks is said, and its figures are "-". Lines "name value" are for make bench.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "contest.h"
#include "subject.h"

#define ANGLES CONTEST_SCENES
#define ROUNDS 15
#define THREADS_AIM 1.6
#define SOFTPIPE_ROUNDS 3 /* which takes a hundred times as long */

#define ALL_WAYS ((1u << CONTEST_WAYS) - 1)
/* The library's Gouraud shading is there for its pictures alone. */
#define TIMED_WAYS (ALL_WAYS & ~(1u << CONTEST_GOURAUD))
#define QUICK_WAYS (TIMED_WAYS & ((1u << CONTEST_SOFTPIPE_GOURAUD) - 1))

struct bench {
	const char *models;
	bool pictures, short_form, missed;
	int width, height, angles;
};

static const struct {
	const struct subject *subject;
	double aims[CONTEST_WAYS]; /* least speed; 0: none */
} entries[] = {
	{ &subject_bunny,
	  { [CONTEST_LLVMPIPE_GOURAUD] = 1,
	    [CONTEST_LLVMPIPE_PHONG] = 1.5,
	    [CONTEST_CPHONG] = 1 } },
	{ &subject_horse, { [CONTEST_LLVMPIPE_GOURAUD] = 0.7, [CONTEST_LLVMPIPE_PHONG] = 1.2 } },
	{ &subject_sphere3, { [CONTEST_LLVMPIPE_GOURAUD] = 1.5, [CONTEST_LLVMPIPE_PHONG] = 6 } },
};

static void need(int ret)
{
	if (ret)
		exit(2);
}

static void measure(struct bench *bench, struct contest *contest, const struct scene *scenes)
{
	int rounds = bench->short_form ? 1 : ROUNDS;

	for (int i = 0; i < rounds; i++)
		need(contest_round(contest, scenes, ANGLES,
				   i < SOFTPIPE_ROUNDS ? TIMED_WAYS : QUICK_WAYS));
}

static void print_speed(struct bench *bench, const struct contest *contest, const char *name,
			enum contest_way way, double aim)
{
	struct contest_spread speed;
	bool missed;

	printf("frame.vs_%s.%s ", contest_name(way), name);
	if (!contest_has(contest, way)) {
		printf("-   # what it needs is not here\n");
		return;
	}
	speed = contest_speed(contest, way);
	printf("%.2f   # %.2f to %.2f in %d rounds", speed.median, speed.least, speed.most,
	       speed.rounds);
	missed = speed.median < aim;
	if (aim > 0)
		printf("; at least %g%s", aim, missed ? ": MISSED" : "");
	printf("\n");
	bench->missed |= missed;
}

static void print(struct bench *bench, const struct contest *contest, const char *name,
		  const double aims[CONTEST_WAYS])
{
	for (enum contest_way way = 0; way < CONTEST_WAYS; way++)
		if (contest->rounds[way])
			printf("# %s: %s: %.1f frames a processor second\n", name,
			       contest_name(way), ANGLES / contest_cost(contest, way).median);
	for (enum contest_way way = CONTEST_CPHONG; way < CONTEST_WAYS; way++)
		print_speed(bench, contest, name, way, aims[way]);
	fflush(stdout);
}

/* Of wall time: another program in between only lengthens it, so the least of the rounds counts. */
static void print_threads(struct bench *bench, const struct contest *contest,
			  const struct subject *subject)
{
	double gain = contest_threads(contest);
	bool missed = gain < THREADS_AIM;

	if (subject != &subject_bunny) {
		printf("# %s: two threads are %.2f times as fast as one\n", subject->name, gain);
	} else if (sysconf(_SC_NPROCESSORS_ONLN) < 2) {
		printf("frame.threads2_vs_1 -   # there is one processor\n");
	} else {
		printf("frame.threads2_vs_1 %.2f   # at least %g%s\n", gain, THREADS_AIM,
		       missed ? ": MISSED" : "");
		bench->missed |= missed;
	}
}

static void run(struct bench *bench, const struct subject *subject, const double aims[CONTEST_WAYS])
{
	struct scene scenes[ANGLES];
	struct view_options options;
	struct contest contest;
	struct view view;

	need(subject_load(subject, bench->models, bench->width, bench->height, &options, &view));
	subject_scenes(&view, scenes, bench->angles);
	need(contest_begin(&contest, scenes, ALL_WAYS));
	need(contest_compare(&contest, scenes, bench->angles, subject->name));
	if (!bench->pictures) {
		measure(bench, &contest, scenes);
		print(bench, &contest, subject->name, aims);
		print_threads(bench, &contest, subject);
	}
	contest_end(&contest);
	view_close(&view);
}

int main(int argc, char **argv)
{
	struct bench bench = { .width = 1280, .height = 720, .angles = ANGLES };

	for (int i = 1; i < argc; i++) {
		if (!strcmp(argv[i], "--pictures"))
			bench.pictures = true;
		else if (!strcmp(argv[i], "--short"))
			bench.short_form = true;
		else
			bench.models = argv[i];
	}
	if (!bench.models) {
		fprintf(stderr, "usage: bench_frame [--pictures] [--short] MODELS\n");
		return 2;
	}
	if (bench.pictures) {
		bench.width = 640;
		bench.height = 360;
		bench.angles = 2;
	}
	for (size_t i = 0; i < sizeof(entries) / sizeof(*entries); i++)
		run(&bench, entries[i].subject, entries[i].aims);
	return bench.missed && !bench.short_form;
}
