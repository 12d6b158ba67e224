/* SPDX-License-Identifier: MIT */
/* What the tests of "drm:" share: a board behind the kernel of fake_gloss.h, and jobs on it. */
#ifndef DRM_TEST_H
#define DRM_TEST_H

#include <xf86drm.h>

#include "fake_gloss.h"
#include "gloss_drm.h"
#include "transport_test.h"

/* The number of an ioctl, for fake_gloss.fail_request. */
#define GLOSS(name) (DRM_COMMAND_BASE + DRM_GLOSS_##name)

static const struct accel_transport_ops *const ops = &accel_transport_drm;

static inline void board_hold(void)
{
	fake_gloss_hold();
}

static inline void board_release(void)
{
	fake_gloss_release();
}

static inline int drm_setup(void **state)
{
	struct accel_transport_error error = { "" };

	fake_gloss_start();
	return ops->open("", state, &error);
}

/* Nothing may be left that the kernel would have to tidy up. */
static inline int drm_teardown(void **state)
{
	unsigned int mappings;

	fake_gloss_release();
	ops->close(*state);
	mappings = fake_gloss_mappings();
	fake_gloss_stop();
	assert_int_equal(fake_gloss.files, 0);
	assert_int_equal(fake_gloss.left, 0);
	assert_int_equal(mappings, 0);
	return 0;
}

#define drm_test(name) cmocka_unit_test_setup_teardown(name, drm_setup, drm_teardown)

#endif
