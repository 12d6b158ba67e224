/* SPDX-License-Identifier: MIT */
/* States of anything, for fuzz_draw. */
#ifndef FUZZ_DRAW_STATE_H
#define FUZZ_DRAW_STATE_H

#include "accel.h"

/* Sets some of what @state has, to anything that its setters take. */
void fuzz_draw_state(struct accel_state *state);

#endif
