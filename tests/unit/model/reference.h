/* SPDX-License-Identifier: MIT */
/*
 * Triangles drawn as slowly as gloss.xml describes them, to compare the model
 * with: a pixel at a time, surfaces by additions alone, nothing shared with the
 * model but its structs.
 */
#ifndef TESTS_REFERENCE_H
#define TESTS_REFERENCE_H

#include "model/model.h"

/* Draws @triangle into @tile under @state and adds to @counters. */
void reference_draw(const struct model_triangle *triangle, int tile_size,
		    const struct model_state *state, struct model_tile *tile,
		    struct model_counters *counters);

#endif
