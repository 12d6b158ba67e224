// SPDX-License-Identifier: MIT
/* The window, with SDL's driver that has no display, and hands that are events. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../../tools/gloss-view-window.c"

static struct view_options options;
static struct view view;

static int open_all(void **state)
{
	char *argv[] = {
		"gloss-view", "--window", "--device", "model:", "--size", "70x50", "sphere:1", NULL,
	};

	(void)state;
	setenv("SDL_VIDEODRIVER", "dummy", 1);
	return view_options_parse(&options, 7, argv) || view_open(&view, &options);
}

static int close_all(void **state)
{
	(void)state;
	view_close(&view);
	return 0;
}

static void push_key(SDL_Keycode key)
{
	SDL_Event event = { .type = SDL_KEYDOWN };

	event.key.keysym.sym = key;
	SDL_PushEvent(&event);
}

/* Runs in SDL's timer thread a little after the window was opened. */
static uint32_t press_escape(uint32_t interval, void *data)
{
	(void)interval;
	(void)data;
	push_key(SDLK_ESCAPE);
	return 0;
}

static void escape_closes_the_window(void **state)
{
	(void)state;
	assert_int_equal(SDL_InitSubSystem(SDL_INIT_TIMER), 0);
	assert_true(SDL_AddTimer(200, press_escape, NULL));
	assert_int_equal(view_window(&view), VIEW_OK);
	assert_ptr_equal(view.options, &options);
}

static void closing_it_closes_it(void **state)
{
	struct window window = { .options = options };
	SDL_Event event = { .type = SDL_QUIT };

	(void)state;
	handle(&window, &event);
	assert_true(window.leave);
}

static void dragging_turns_the_mesh(void **state)
{
	struct window window = { .options = options };
	SDL_Event event = { .type = SDL_MOUSEMOTION };

	(void)state;
	event.motion.xrel = 50;
	event.motion.yrel = 25;
	handle(&window, &event);
	assert_false(window.stale);
	event.motion.state = SDL_BUTTON_LMASK;
	handle(&window, &event);
	assert_true(window.stale);
	assert_true(window.options.camera[0] == -20 && window.options.camera[1] == 10);
	/* Not beyond the pole. */
	event.motion.yrel = 10000;
	handle(&window, &event);
	assert_true(window.options.camera[1] == 90);
}

static void the_wheel_zooms_within_bounds(void **state)
{
	struct window window = { .options = options };
	SDL_Event event = { .type = SDL_MOUSEWHEEL };

	(void)state;
	event.wheel.y = 2;
	handle(&window, &event);
	assert_true(window.options.zoom > 1.2f && window.options.zoom < 1.22f && window.stale);
	event.wheel.y = 1000;
	handle(&window, &event);
	assert_true(window.options.zoom == 100);
	event.wheel.y = -3000;
	handle(&window, &event);
	assert_true(window.options.zoom == 0.01f);
}

static void keys_choose_the_shading(void **state)
{
	static const struct {
		SDL_Keycode key;
		enum accel_shading shading;
	} keys[] = {
		{ SDLK_f, ACCEL_SHADING_FLAT },
		{ SDLK_g, ACCEL_SHADING_GOURAUD },
		{ SDLK_q, ACCEL_SHADING_QUADRATIC },
		{ SDLK_a, ACCEL_SHADING_ADAPTIVE },
	};
	struct window window = { .options = options };

	(void)state;
	for (size_t i = 0; i < sizeof(keys) / sizeof(*keys); i++) {
		window.stale = false;
		press(&window, keys[i].key);
		assert_int_equal(window.options.shading, keys[i].shading);
		assert_true(window.stale);
	}
	press(&window, SDLK_x);
	assert_false(window.leave);
}

/* What the window shows is what --out would write. */
static void a_turned_picture_is_drawn(void **state)
{
	struct window window = { .options = options };
	struct picture straight;

	(void)state;
	assert_int_equal(open_window(&window, &view), VIEW_OK);
	view.options = &window.options;
	assert_int_equal(redraw(&window, &view), VIEW_OK);
	assert_int_equal(picture_new(70, 50, &straight), 0);
	assert_int_equal(view_draw(&view, options.shading, &straight), VIEW_OK);
	assert_memory_equal(straight.pixel, window.picture.pixel, sizeof(uint32_t) * 70 * 50);
	drag(&window, 30, 0);
	assert_int_equal(redraw(&window, &view), VIEW_OK);
	assert_memory_not_equal(straight.pixel, window.picture.pixel, sizeof(uint32_t) * 70 * 50);
	view.options = &options;
	picture_free(&straight);
	close_window(&window);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(escape_closes_the_window),
		cmocka_unit_test(closing_it_closes_it),
		cmocka_unit_test(dragging_turns_the_mesh),
		cmocka_unit_test(the_wheel_zooms_within_bounds),
		cmocka_unit_test(keys_choose_the_shading),
		cmocka_unit_test(a_turned_picture_is_drawn),
	};

	return cmocka_run_group_tests(tests, open_all, close_all);
}
