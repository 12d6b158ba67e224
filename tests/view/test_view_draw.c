// SPDX-License-Identifier: MIT
/* Pictures that are larger than a target: here that is 64 pixels. */
#include <getopt.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "accel.h"
static const int real_size_max = ACCEL_TARGET_SIZE_MAX;
#undef ACCEL_TARGET_SIZE_MAX
#define ACCEL_TARGET_SIZE_MAX 64
#include "view/draw.c"

static void open_view(struct view *view, struct view_options *options, char *size)
{
	char *argv[] = {
		"gloss-view", "--stats", "--device", "model:", "--size", size, "torus:9", NULL,
	};

	optind = 1;
	assert_int_equal(view_options_parse(options, 7, argv), VIEW_OK);
	assert_int_equal(view_open(view, options), VIEW_OK);
}

static void a_picture_in_parts_is_the_picture(void **state)
{
	static char *sizes[] = { "64x64", "150x90", "65x1", "10x130" };

	(void)state;
	assert_true(real_size_max % ACCEL_TARGET_SIZE_MAX == 0);
	for (int i = 0; i < 4; i++) {
		struct picture whole, parts;
		struct accel_target *target;
		struct view_options options;
		struct view view;

		open_view(&view, &options, sizes[i]);
		assert_int_equal(picture_new(options.width, options.height, &parts), 0);
		assert_int_equal(picture_new(options.width, options.height, &whole), 0);
		assert_int_equal(view_draw(&view, options.shading, &parts), VIEW_OK);
		assert_true(view.visible > 0);
		assert_int_equal(accel_target_new(view.device, options.width, options.height,
						  &target),
				 0);
		view.scene.left = view.scene.top = 0;
		assert_int_equal(scene_draw(&view.scene, options.shading, view.draw, target, NULL),
				 0);
		assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, whole.pixel,
						   options.width * 4),
				 0);
		assert_memory_equal(whole.pixel, parts.pixel,
				    sizeof(uint32_t) * options.width * options.height);
		accel_target_free(target);
		picture_free(&whole);
		picture_free(&parts);
		view_close(&view);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_picture_in_parts_is_the_picture),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
