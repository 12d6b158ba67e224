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

#include "contest.h"
#include "view/view.h"

#define ANGLES 8
#define ROUNDS 15
#define SOFTPIPE_ROUNDS 3 /* which takes a hundred times as long */

#define ALL_WAYS ((1u << CONTEST_WAYS) - 1)
/* The library's Gouraud shading is there for its pictures alone. */
#define TIMED_WAYS (ALL_WAYS & ~(1u << CONTEST_GOURAUD))
#define QUICK_WAYS (TIMED_WAYS & ((1u << CONTEST_SOFTPIPE_GOURAUD) - 1))

struct bench {
	const char *models;
	bool pictures, short_form, missed;
	int angles;
	struct view_options options;
};

static const struct subject {
	const char *name; /* in figures */
	const char *mesh; /* a file in MODELS, or a shape */
	bool file;
	float upright[2];          /* as of options */
	double aims[CONTEST_WAYS]; /* least speed; 0: none */
} subjects[] = {
	{ "bunny",
	  "bunny.obj",
	  true,
	  { 0, 0 },
	  { [CONTEST_LLVMPIPE_GOURAUD] = 1,
	    [CONTEST_LLVMPIPE_PHONG] = 1.5,
	    [CONTEST_CPHONG] = 1 } },
	{ "horse",
	  "horse.3ds",
	  true,
	  { 90, 0 },
	  { [CONTEST_LLVMPIPE_GOURAUD] = 0.7, [CONTEST_LLVMPIPE_PHONG] = 1.2 } },
	{ "sphere3",
	  "sphere:3",
	  false,
	  { 0, 0 },
	  { [CONTEST_LLVMPIPE_GOURAUD] = 1.5, [CONTEST_LLVMPIPE_PHONG] = 6 } },
};

static void need(int ret)
{
	if (ret)
		exit(2);
}

static void set_options(struct bench *bench)
{
	static char *words[] = { "bench_frame", "--stats", "--size", "1280x720", "" };

	if (bench->pictures)
		words[3] = "640x360";
	bench->angles = bench->pictures ? 2 : ANGLES;
	need(view_options_parse(&bench->options, 5, words));
	bench->options.turntable = ANGLES;
	bench->options.recoloured = true; /* the horse has colours of its own */
}

static void set_scenes(struct view *view, struct scene *scenes, int count)
{
	for (int i = 0; i < count; i++) {
		view_camera_set(view, 360.0f * (float)i / (float)count);
		scenes[i] = view->scene;
	}
}

static void measure(struct bench *bench, struct contest *contest, const struct scene *scenes)
{
	int rounds = bench->short_form ? 1 : ROUNDS;

	for (int i = 0; i < rounds; i++)
		need(contest_round(contest, scenes, ANGLES,
				   i < SOFTPIPE_ROUNDS ? TIMED_WAYS : QUICK_WAYS));
}

static void print_speed(struct bench *bench, const struct contest *contest,
			const struct subject *subject, enum contest_way way)
{
	struct contest_spread speed;
	bool missed;

	printf("frame.vs_%s.%s ", contest_name(way), subject->name);
	if (!contest_has(contest, way)) {
		printf("-   # what it needs is not here\n");
		return;
	}
	speed = contest_speed(contest, way);
	printf("%.2f   # %.2f to %.2f in %d rounds", speed.median, speed.least, speed.most,
	       speed.rounds);
	missed = speed.median < subject->aims[way];
	if (subject->aims[way] > 0)
		printf("; at least %g%s", subject->aims[way], missed ? ": MISSED" : "");
	printf("\n");
	bench->missed |= missed;
}

static void print(struct bench *bench, const struct contest *contest, const struct subject *subject)
{
	for (enum contest_way way = 0; way < CONTEST_WAYS; way++) {
		if (contest->rounds[way])
			printf("# %s: %s: %.1f frames a processor second\n", subject->name,
			       contest_name(way), ANGLES / contest_cost(contest, way).median);
	}
	for (enum contest_way way = CONTEST_CPHONG; way < CONTEST_WAYS; way++)
		print_speed(bench, contest, subject, way);
	fflush(stdout);
}

static void contend(struct bench *bench, const struct subject *subject, struct view *view)
{
	struct scene scenes[ANGLES];
	struct contest contest;

	set_scenes(view, scenes, bench->angles);
	need(contest_begin(&contest, scenes, ALL_WAYS));
	need(contest_compare(&contest, scenes, bench->angles, subject->name));
	if (!bench->pictures) {
		measure(bench, &contest, scenes);
		print(bench, &contest, subject);
	}
	contest_end(&contest);
}

static void run(struct bench *bench, const struct subject *subject)
{
	char path[4096];
	struct view view;

	snprintf(path, sizeof(path), "%s%s%s", subject->file ? bench->models : "",
		 subject->file ? "/" : "", subject->mesh);
	bench->options.mesh = path;
	memcpy(bench->options.upright, subject->upright, sizeof(subject->upright));
	need(view_load(&view, &bench->options));
	contend(bench, subject, &view);
	view_close(&view);
}

int main(int argc, char **argv)
{
	struct bench bench = { 0 };

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
	set_options(&bench);
	for (size_t i = 0; i < sizeof(subjects) / sizeof(*subjects); i++)
		run(&bench, &subjects[i]);
	return bench.missed && !bench.short_form;
}
