// SPDX-License-Identifier: MIT
#include <SDL.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gloss-view.h"

#define DEGREES_A_PIXEL 0.4f
#define ZOOM_A_STEP 1.1f
#define WAIT_MS 100			/* for events, so that signals are seen too */

struct window {
	SDL_Window *window;
	SDL_Renderer *renderer;
	SDL_Texture *texture;
	struct picture picture;
	struct view_options options;	/* as the hands on mouse and keys have changed them */
	bool stale, leave;
};

static int failed(const char *why)
{
	char hint[256];

	snprintf(hint, sizeof(hint), "%s; --out writes a file instead", why);
	view_error("can not open", "window", hint);
	return VIEW_FAILED;
}

/*
 * Without a display SDL opens a window that nobody sees, and libraries of its own complain on
 * stderr; both are all right only for who asked for them.
 */
static int open_display(void)
{
	bool chosen = getenv("SDL_VIDEODRIVER") != NULL;

	if (!chosen && !getenv("DISPLAY") && !getenv("WAYLAND_DISPLAY"))
		return failed("there is no display");
	SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
	if (SDL_Init(SDL_INIT_VIDEO))
		return failed(SDL_GetError());
	if (!chosen && !strcmp(SDL_GetCurrentVideoDriver(), "offscreen"))
		return failed("the display can not be reached");
	return VIEW_OK;
}

static int open_window(struct window *window, const struct view *view)
{
	int width = view->scene.width, height = view->scene.height;

	if (open_display() != VIEW_OK)
		return VIEW_FAILED;
	window->window = SDL_CreateWindow("gloss-view", SDL_WINDOWPOS_UNDEFINED,
					  SDL_WINDOWPOS_UNDEFINED, width, height, 0);
	if (window->window)
		window->renderer = SDL_CreateRenderer(window->window, -1, 0);
	if (window->renderer)
		window->texture = SDL_CreateTexture(window->renderer, SDL_PIXELFORMAT_RGBA32,
						    SDL_TEXTUREACCESS_STREAMING, width, height);
	if (!window->texture)
		return failed(SDL_GetError());
	if (!picture_new(width, height, &window->picture))
		return VIEW_OK;
	view_error("out of memory", "window", "give a smaller --size");
	return VIEW_FAILED;
}

static void close_window(struct window *window)
{
	picture_free(&window->picture);
	if (window->texture)
		SDL_DestroyTexture(window->texture);
	if (window->renderer)
		SDL_DestroyRenderer(window->renderer);
	if (window->window)
		SDL_DestroyWindow(window->window);
	SDL_Quit();
}

static void press(struct window *window, SDL_Keycode key)
{
	static const struct {
		SDL_Keycode key;
		enum accel_shading shading;
	} keys[] = {
		{ SDLK_g, ACCEL_SHADING_GOURAUD },
		{ SDLK_a, ACCEL_SHADING_ADAPTIVE },
		{ SDLK_q, ACCEL_SHADING_QUADRATIC },
		{ SDLK_f, ACCEL_SHADING_FLAT },
	};

	if (key == SDLK_ESCAPE)
		window->leave = true;
	for (size_t i = 0; i < sizeof(keys) / sizeof(*keys); i++) {
		if (keys[i].key == key) {
			window->options.shading = keys[i].shading;
			window->stale = true;
		}
	}
}

static void drag(struct window *window, int right, int down)
{
	float *camera = window->options.camera;

	camera[0] = fmodf(camera[0] - (float)right * DEGREES_A_PIXEL, 360);
	camera[1] = fminf(fmaxf(camera[1] + (float)down * DEGREES_A_PIXEL, -90), 90);
	window->stale = true;
}

static void roll(struct window *window, int steps)
{
	float zoom = window->options.zoom * powf(ZOOM_A_STEP, (float)steps);

	window->options.zoom = fminf(fmaxf(zoom, 0.01f), 100);
	window->stale = true;
}

static void handle(struct window *window, const SDL_Event *event)
{
	switch (event->type) {
	case SDL_QUIT:
		window->leave = true;
		break;
	case SDL_KEYDOWN:
		press(window, event->key.keysym.sym);
		break;
	case SDL_MOUSEMOTION:
		if (event->motion.state & SDL_BUTTON_LMASK)
			drag(window, event->motion.xrel, event->motion.yrel);
		break;
	case SDL_MOUSEWHEEL:
		roll(window, event->wheel.y);
		break;
	case SDL_WINDOWEVENT:
		window->stale |= event->window.event == SDL_WINDOWEVENT_EXPOSED;
		break;
	default:
		break;
	}
}

static int redraw(struct window *window, struct view *view)
{
	enum accel_shading shading = window->options.shading;
	char title[64];
	int ret;

	window->stale = false;
	view_camera_set(view, 0);
	ret = view_draw(view, shading, &window->picture);
	if (ret != VIEW_OK)
		return ret;
	snprintf(title, sizeof(title), "gloss-view: %s", view_shading_name(shading));
	SDL_SetWindowTitle(window->window, title);
	if (SDL_UpdateTexture(window->texture, NULL, window->picture.pixel,
			      window->picture.width * (int)sizeof(*window->picture.pixel)) ||
	    SDL_RenderCopy(window->renderer, window->texture, NULL, NULL))
		return failed(SDL_GetError());
	SDL_RenderPresent(window->renderer);
	return VIEW_OK;
}

/* Handles all events that are there before the next picture: none wait for a slow board. */
static int loop(struct window *window, struct view *view)
{
	SDL_Event event;
	int ret = VIEW_OK;

	while (!window->leave && ret == VIEW_OK) {
		if (window->stale)
			ret = redraw(window, view);
		if (!SDL_WaitEventTimeout(&event, WAIT_MS))
			continue;
		do {
			handle(window, &event);
		} while (SDL_PollEvent(&event));
	}
	return ret;
}

int view_window(struct view *view)
{
	const struct view_options *options = view->options;
	struct window window = { .options = *options, .stale = true };
	int ret;

	ret = open_window(&window, view);
	if (ret == VIEW_OK) {
		view->options = &window.options;
		ret = loop(&window, view);
		view->options = options;
	}
	close_window(&window);
	return ret;
}
