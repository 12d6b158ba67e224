/* SPDX-License-Identifier: MIT */
/* What benchmarks draw: the scenes that gloss-view --turntable makes of some meshes, in ivory. */
#ifndef TESTS_BENCH_SUBJECT_H
#define TESTS_BENCH_SUBJECT_H

#include "view/view.h"

struct subject {
	const char *name; /* in figures */
	const char *mesh; /* a file in the folder of meshes, or a shape */
	bool file;        /* which of them */
	float upright[2]; /* as in options */
};

extern const struct subject subject_bunny, subject_horse, subject_sphere3, subject_sphere5;

/* Loads @subject, a file of it from the folder @models, for pictures of this size. @options has to
 * last as long as @view. 0, or VIEW_FAILED after a message. */
int subject_load(const struct subject *subject, const char *models, int width, int height,
		 struct view_options *options, struct view *view);
/* The scenes of one turn in @count steps; they lend the mesh of @view. */
void subject_scenes(struct view *view, struct scene *scenes, int count);

#endif
