// SPDX-License-Identifier: MIT
/* The window, with SDL's driver that has no display, and hands that are events. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "view/window.c"

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

/* A window that is not open. */
static struct window hands(void)
{
	memset(&view.hand, 0, sizeof(view.hand));
	return (struct window){ .options = options, .given = &options, .view = &view };
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
	struct window window = hands();
	SDL_Event event = { .type = SDL_QUIT };

	(void)state;
	handle(&window, &event);
	assert_true(window.leave);
}

static void dragging_turns_the_mesh(void **state)
{
	struct window window = hands();
	SDL_Event event = { .type = SDL_MOUSEMOTION };

	(void)state;
	event.motion.xrel = 50;
	event.motion.yrel = 25;
	handle(&window, &event);
	assert_false(window.stale);
	event.motion.state = SDL_BUTTON_LMASK;
	handle(&window, &event);
	assert_true(window.stale);
	assert_true(window.options.camera[0] == options.camera[0] - 20);
	assert_true(window.options.camera[1] == options.camera[1] + 10);
	/* Not beyond the pole. */
	event.motion.yrel = 10000;
	handle(&window, &event);
	assert_true(window.options.camera[1] == 90);
}

static void the_wheel_zooms_within_bounds(void **state)
{
	struct window window = hands();
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
	struct window window = hands();

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

static void the_right_button_moves_the_mesh_with_the_mouse(void **state)
{
	struct window window = hands();
	SDL_Event event = { .type = SDL_MOUSEMOTION };

	(void)state;
	event.motion.xrel = 10;
	event.motion.yrel = -20;
	event.motion.state = SDL_BUTTON_RMASK;
	handle(&window, &event);
	assert_true(window.stale);
	assert_true(view.hand.move[0] < 0 && view.hand.move[1] < 0);
	assert_true(fabsf(view.hand.move[1] - 2 * view.hand.move[0]) < 1e-6f);
}

static void arrows_fly_where_the_eye_looks(void **state)
{
	struct window window = hands();

	(void)state;
	press(&window, SDLK_UP);
	assert_true(window.stale && view.hand.move[2] < 0 && view.hand.move[0] == 0);
	press(&window, SDLK_DOWN);
	assert_true(view.hand.move[2] == 0);
	for (int i = 0; i < 30; i++)
		press(&window, SDLK_RIGHT);
	assert_true(view.hand.look == 90);
	press(&window, SDLK_UP);
	assert_true(view.hand.move[0] > 0 && fabsf(view.hand.move[2]) < 1e-6f);
	press(&window, SDLK_LEFT);
	assert_true(view.hand.look == 87);
}

static void r_is_as_at_the_beginning(void **state)
{
	struct window window = hands();

	(void)state;
	press(&window, SDLK_UP);
	press(&window, SDLK_RIGHT);
	turn(&window, 5, 6);
	roll(&window, 3);
	press(&window, SDLK_r);
	assert_memory_equal(&window.options, &options, sizeof(options));
	assert_memory_equal(&view.hand, &(struct view_hand){ 0 }, sizeof(view.hand));
}

static void t_shows_both_sides(void **state)
{
	struct window window = hands();

	(void)state;
	press(&window, SDLK_t);
	assert_true(view.scene.two_sided && view.scene.cull == ACCEL_CULL_NONE);
	press(&window, SDLK_t);
	assert_true(!view.scene.two_sided && view.scene.cull == ACCEL_CULL_BACK);
}

/* Draws as the window would, and what --out would write. */
static void assert_shown(struct window *window)
{
	struct picture straight;
	size_t pixels = (size_t)window->options.width * window->options.height;

	assert_int_equal(redraw(window), VIEW_OK);
	assert_int_equal(picture_new(window->options.width, window->options.height, &straight), 0);
	assert_int_equal(view_draw(&view, options.shading, &straight), VIEW_OK);
	assert_int_equal(window->picture.width, straight.width);
	assert_memory_equal(straight.pixel, window->picture.pixel, sizeof(uint32_t) * pixels);
	picture_free(&straight);
}

static void a_turned_and_resized_picture_is_drawn(void **state)
{
	struct window window = hands();
	SDL_Event event = { .type = SDL_WINDOWEVENT };
	uint32_t before[70 * 50];

	(void)state;
	view.options = &window.options;
	assert_int_equal(open_window(&window), VIEW_OK);
	assert_shown(&window);
	assert_string_equal(SDL_GetWindowTitle(window.window), "sphere:1 - gloss-view: adaptive");
	memcpy(before, window.picture.pixel, sizeof(before));
	turn(&window, 30, 0);
	assert_shown(&window);
	assert_memory_not_equal(before, window.picture.pixel, sizeof(before));
	event.window.event = SDL_WINDOWEVENT_SIZE_CHANGED;
	event.window.data1 = 90;
	event.window.data2 = 40;
	handle(&window, &event);
	assert_true(window.resized);
	assert_shown(&window);
	assert_int_equal(window.picture.width, 90);
	view.options = &options;
	close_window(&window);
	assert_int_equal(view_resize(&view), VIEW_OK);
}

static void s_saves_what_is_shown_under_a_free_name(void **state)
{
	char directory[] = "/tmp/test-window-XXXXXX";
	struct window window = hands();
	struct picture saved;

	(void)state;
	assert_non_null(mkdtemp(directory));
	assert_int_equal(chdir(directory), 0);
	assert_int_equal(open_window(&window), VIEW_OK);
	assert_shown(&window);
	press(&window, SDLK_s);
	press(&window, SDLK_s);
	assert_int_equal(picture_read(&saved, "gloss-view-0001.png"), 0);
	for (int i = 0; i < 70 * 50; i++)
		assert_int_equal(saved.pixel[i], window.picture.pixel[i] | 0xff000000);
	picture_free(&saved);
	close_window(&window);
	unlink("gloss-view-0000.png");
	unlink("gloss-view-0001.png");
	assert_int_equal(chdir("/"), 0);
	assert_int_equal(rmdir(directory), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(escape_closes_the_window),
		cmocka_unit_test(closing_it_closes_it),
		cmocka_unit_test(dragging_turns_the_mesh),
		cmocka_unit_test(the_wheel_zooms_within_bounds),
		cmocka_unit_test(keys_choose_the_shading),
		cmocka_unit_test(the_right_button_moves_the_mesh_with_the_mouse),
		cmocka_unit_test(arrows_fly_where_the_eye_looks),
		cmocka_unit_test(r_is_as_at_the_beginning),
		cmocka_unit_test(t_shows_both_sides),
		cmocka_unit_test(a_turned_and_resized_picture_is_drawn),
		cmocka_unit_test(s_saves_what_is_shown_under_a_free_name),
	};

	return cmocka_run_group_tests(tests, open_all, close_all);
}
