/* SPDX-License-Identifier: MIT */
/* A picture that a test draws on the model. */
#ifndef DRAW_FIXTURE_H
#define DRAW_FIXTURE_H

#include "accel_test.h"

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct accel_state *state;
};

/* One for all tests of a program; of @side times @side pixels. @state is freed with it. */
static inline struct fixture *fixture_new(uint32_t side, struct accel_state *state)
{
	static struct fixture f;

	f.device = device_open("model:", &f.messages);
	assert_int_equal(accel_target_new(f.device, side, side, &f.target), 0);
	assert_int_equal(accel_draw_new(f.device, &f.draw), 0);
	f.state = state;
	return &f;
}

static inline int fixture_free(void **state)
{
	struct fixture *f = *state;

	accel_state_free(f->state);
	accel_draw_free(f->draw);
	accel_target_free(f->target);
	accel_device_free(f->device);
	return 0;
}

#endif
