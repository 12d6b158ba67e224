/* SPDX-License-Identifier: MIT */
/* Random parts of scenes. All numbers are whole floats. */
#ifndef SCENE_RANDOM_H
#define SCENE_RANDOM_H

#include "scene.h"

/* How many scenes a test draws: GL_SCENES, or as @usual. */
int scene_count(int usual);

double scene_between(uint64_t *seed, double low, double high);
void scene_random_colour(uint64_t *seed, double most, double out[4]);
/* Of a length between 0.1 and 1. */
void scene_random_direction(uint64_t *seed, double out[3]);
/* Everything but vertices, for those of which all coordinates are -1 to 1. */
void scene_random_state(uint64_t *seed, bool perspective, struct oracle_state *gl);

#endif
