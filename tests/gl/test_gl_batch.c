// SPDX-License-Identifier: MIT
/* How many draws of libaccel programs of many small primitives become; its function is counted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "api/commands.h"
#include "state/context.h"
#include "window/config.h"
#include "window/device.h"
#include "window/surface.h"

static struct gloss_context *context;
static struct gloss_surface *surface;
static int draws;

int __real_accel_draw_arrays(struct accel_draw *draw, const struct accel_state *state,
			     const struct accel_arrays *arrays,
			     const struct accel_elements *elements);
int __wrap_accel_draw_arrays(struct accel_draw *draw, const struct accel_state *state,
			     const struct accel_arrays *arrays,
			     const struct accel_elements *elements);

int __wrap_accel_draw_arrays(struct accel_draw *draw, const struct accel_state *state,
			     const struct accel_arrays *arrays,
			     const struct accel_elements *elements)
{
	draws++;
	return __real_accel_draw_arrays(draw, state, arrays, elements);
}

static int setup(void **state)
{
	(void)state;
	context = gloss_context_new(gloss_device(), NULL);
	surface = gloss_surface_new(&gloss_configs[0], NULL, 64, 64);
	assert_non_null(context);
	assert_non_null(surface);
	assert_int_equal(gloss_context_bind(context, surface, surface), 0);
	draws = 0;
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	assert_int_equal(gl_GetError(), GL_NO_ERROR);
	assert_int_equal(gloss_context_bind(NULL, NULL, NULL), 0);
	gloss_context_free(context);
	gloss_surface_unref(surface);
	return 0;
}

static void triangle(GLenum mode)
{
	gl_Begin(mode);
	gl_Vertex4f(0, 0, 0, 1);
	gl_Vertex4f(1, 0, 0, 1);
	gl_Vertex4f(1, 1, 0, 1);
	gl_End();
}

static void thousands_of_begins_are_one_draw(void **state)
{
	static const GLenum modes[] = { GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_POLYGON };

	(void)state;
	for (int i = 0; i < 3000; i++) {
		gl_Color4f((GLfloat)(i % 2), 1, 1, 1);
		gl_Normal3f(0, 0, 1);
		triangle(modes[i % 3]);
	}
	assert_int_equal(draws, 0);
	gl_Finish();
	assert_int_equal(draws, 1);
}

/* As programs set it before each object. */
static void state_that_stays_breaks_no_batch(void **state)
{
	static const GLfloat white[4] = { 1, 1, 1, 1 };

	(void)state;
	for (int i = 0; i < 100; i++) {
		gl_Enable(GL_DEPTH_TEST);
		gl_DepthFunc(GL_LESS);
		gl_ShadeModel(GL_SMOOTH);
		gl_Materialfv(GL_FRONT, GL_EMISSION, white);
		gl_Disable(GL_LIGHTING);
		triangle(GL_TRIANGLES);
	}
	gl_Finish();
	assert_int_equal(draws, 1);
}

static void state_that_changes_is_a_draw_each(void **state)
{
	(void)state;
	for (int i = 0; i < 100; i++) {
		gl_DepthMask(i % 2);
		triangle(GL_TRIANGLES);
	}
	gl_Finish();
	assert_int_equal(draws, 100);
}

static void a_list_of_primitives_is_played_into_the_batch(void **state)
{
	(void)state;
	gl_NewList(1, GL_COMPILE);
	for (int i = 0; i < 10; i++)
		triangle(GL_TRIANGLES);
	gl_EndList();
	for (int i = 0; i < 100; i++)
		gl_CallList(1);
	gl_Finish();
	assert_int_equal(draws, 1);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(thousands_of_begins_are_one_draw),
		TEST(state_that_stays_breaks_no_batch),
		TEST(state_that_changes_is_a_draw_each),
		TEST(a_list_of_primitives_is_played_into_the_batch),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
