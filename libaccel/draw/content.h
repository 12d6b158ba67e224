/* SPDX-License-Identifier: MIT */
/*
 * What the tiles of a target are known to hold, so that one which holds the value it is to be
 * cleared to need not be sent. docs/design.md says what is known when.
 */
#ifndef ACCEL_CONTENT_H
#define ACCEL_CONTENT_H

#include "draw/bin.h"

/* The content of @target, whose other members are set. NULL in *@content: its board's memory may
 * change by more than jobs, so nothing is ever known. -ENOMEM. */
int accel_content_new(const struct accel_target *target, struct accel_content **content);
struct accel_content *accel_content_ref(struct accel_content *content);
void accel_content_unref(struct accel_content *content);

/*
 * Around the jobs of a frame on @target, so that they and what is known of tiles change together.
 * NULL: nothing is known, and end is not called. Waits for another thread that is between the two.
 */
struct accel_content *accel_content_begin(const struct accel_target *target);
/* Which planes of @clear, of ACCEL_CLEAR_*, tile number @tile holds already. */
unsigned int accel_content_holds(const struct accel_content *content, int tile,
				 const struct accel_tile_clear *clear);
/* The frame in @bin was sent as so many jobs of @fence; NULL: it was not, or not all of it. */
void accel_content_end(struct accel_content *content, const struct accel_bin *bin,
		       struct accel_fence *fence, unsigned int jobs);

#endif
