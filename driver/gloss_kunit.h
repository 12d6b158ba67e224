/* SPDX-License-Identifier: GPL-2.0-only */
/*
 * KUnit tests of what needs neither board nor process. gloss_kunit_<file>.c includes
 * gloss_<file>.c, to reach its statics; of gloss_job.c there is one that only notes what it
 * is asked to do.
 */
#ifndef GLOSS_KUNIT_H
#define GLOSS_KUNIT_H

#include <kunit/test.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

#define GLOSS_KUNIT_JOBS	64

struct gloss_kunit_jobs {
	struct gloss_job job[GLOSS_KUNIT_JOBS];
	unsigned int count;		/* asked for */
	unsigned int pushed, freed;
	unsigned int fail_at;		/* this one, from 1, can not be locked; 0: none */
};

/* What gloss_job.c was asked for since the test began. */
extern struct gloss_kunit_jobs *gloss_kunit_jobs;

void gloss_kunit_jobs_init(struct kunit *test);

#endif
