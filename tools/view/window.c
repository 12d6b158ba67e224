// SPDX-License-Identifier: MIT
#include <SDL.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "view/view.h"

#define DEGREES_A_PIXEL 0.4f
#define ZOOM_A_STEP 1.1f
#define RADII_A_STEP 0.05f  /* of flying */
#define DEGREES_A_STEP 3.0f /* of looking around */
#define WAIT_MS 100         /* for events, so that signals are seen too */
#define SCREENSHOTS 10000

struct window {
	SDL_Window *window;
	SDL_Renderer *renderer;
	SDL_Texture *texture;
	struct view *view;
	struct picture picture;
	struct view_options options; /* as the hands on mouse and keys have changed them */
	const struct view_options *given;
	bool stale, resized, leave;
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

/* The picture and its texture, in the size of the options. */
static int open_picture(struct window *window)
{
	int width = window->options.width, height = window->options.height;

	picture_free(&window->picture);
	if (window->texture)
		SDL_DestroyTexture(window->texture);
	window->texture = SDL_CreateTexture(window->renderer, SDL_PIXELFORMAT_RGBA32,
					    SDL_TEXTUREACCESS_STREAMING, width, height);
	if (!window->texture)
		return failed(SDL_GetError());
	if (!picture_new(width, height, &window->picture))
		return VIEW_OK;
	view_error("out of memory", "window", "give a smaller --size");
	return VIEW_FAILED;
}

static int open_window(struct window *window)
{
	if (open_display() != VIEW_OK)
		return VIEW_FAILED;
	window->window = SDL_CreateWindow("gloss-view", SDL_WINDOWPOS_UNDEFINED,
					  SDL_WINDOWPOS_UNDEFINED, window->options.width,
					  window->options.height, SDL_WINDOW_RESIZABLE);
	if (window->window)
		window->renderer = SDL_CreateRenderer(window->window, -1, 0);
	if (!window->renderer)
		return failed(SDL_GetError());
	return open_picture(window);
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

/* ---- hands ---- */

/* As at the beginning, but for the window's size. */
static void reset(struct window *window)
{
	struct view_options *options = &window->options;

	memcpy(options->camera, window->given->camera, sizeof(options->camera));
	options->zoom = window->given->zoom;
	memset(&window->view->hand, 0, sizeof(window->view->hand));
	view_camera_frame(window->view);
}

/* Forwards, where the eye looks. */
static void fly(struct window *window, float radii)
{
	struct view_hand *hand = &window->view->hand;
	float angle = hand->look * (3.14159265f / 180);

	hand->move[0] += radii * sinf(angle);
	hand->move[2] -= radii * cosf(angle);
}

static void fly_forwards(struct window *window)
{
	fly(window, RADII_A_STEP);
}

static void fly_back(struct window *window)
{
	fly(window, -RADII_A_STEP);
}

static void look_left(struct window *window)
{
	window->view->hand.look = fmodf(window->view->hand.look - DEGREES_A_STEP, 360);
}

static void look_right(struct window *window)
{
	window->view->hand.look = fmodf(window->view->hand.look + DEGREES_A_STEP, 360);
}

static void switch_sides(struct window *window)
{
	window->options.two_sided = !window->options.two_sided;
	view_set_sides(window->view, window->options.two_sided);
}

/* Writes the picture under the first name that is free. */
static void save(struct window *window)
{
	char name[32];
	int number = 0;

	do {
		snprintf(name, sizeof(name), "gloss-view-%04d.png", number);
	} while (!access(name, F_OK) && ++number < SCREENSHOTS);
	if (number == SCREENSHOTS) {
		view_error("can not write", name, "there are as many already, remove some");
		return;
	}
	if (view_write(&window->picture, name) == VIEW_OK) {
		printf("%s\n", name);
		fflush(stdout);
	}
}

static void leave(struct window *window)
{
	window->leave = true;
}

static void press(struct window *window, SDL_Keycode key)
{
	static const struct {
		SDL_Keycode key;
		enum accel_shading shading; /* if there is nothing to call */
		void (*call)(struct window *window);
	} keys[] = {
		{ SDLK_g, ACCEL_SHADING_GOURAUD, NULL },
		{ SDLK_a, ACCEL_SHADING_ADAPTIVE, NULL },
		{ SDLK_q, ACCEL_SHADING_QUADRATIC, NULL },
		{ SDLK_f, ACCEL_SHADING_FLAT, NULL },
		{ SDLK_r, 0, reset },
		{ SDLK_t, 0, switch_sides },
		{ SDLK_s, 0, save },
		{ SDLK_UP, 0, fly_forwards },
		{ SDLK_DOWN, 0, fly_back },
		{ SDLK_LEFT, 0, look_left },
		{ SDLK_RIGHT, 0, look_right },
		{ SDLK_ESCAPE, 0, leave },
	};

	for (size_t i = 0; i < sizeof(keys) / sizeof(*keys); i++) {
		if (keys[i].key != key)
			continue;
		if (keys[i].call)
			keys[i].call(window);
		else
			window->options.shading = keys[i].shading;
		window->stale = true;
	}
}

static void turn(struct window *window, int right, int down)
{
	float *camera = window->options.camera;

	camera[0] = fmodf(camera[0] - (float)right * DEGREES_A_PIXEL, 360);
	camera[1] = fminf(fmaxf(camera[1] + (float)down * DEGREES_A_PIXEL, -90), 90);
}

/* The mesh's middle goes with the mouse. */
static void pan(struct window *window, int right, int down)
{
	const struct view *view = window->view;
	float *move = window->view->hand.move;
	float half = window->options.fov ? tanf(window->options.fov * (3.14159265f / 360)) *
						   fmaxf(view->eye[2] + move[2], RADII_A_STEP) :
					   view->half_height;
	float radii = 2 * half / ((float)window->options.height * window->options.zoom);

	move[0] -= (float)right * radii;
	move[1] += (float)down * radii;
}

static void drag(struct window *window, const SDL_MouseMotionEvent *motion)
{
	if (motion->state & SDL_BUTTON_LMASK)
		turn(window, motion->xrel, motion->yrel);
	else if (motion->state & (SDL_BUTTON_RMASK | SDL_BUTTON_MMASK))
		pan(window, motion->xrel, motion->yrel);
	else
		return;
	window->stale = true;
}

static void roll(struct window *window, int steps)
{
	float zoom = window->options.zoom * powf(ZOOM_A_STEP, (float)steps);

	window->options.zoom = fminf(fmaxf(zoom, 0.01f), 100);
	window->stale = true;
}

static int within(int size)
{
	return size < 1 ? 1 : size > VIEW_SIZE_MAX ? VIEW_SIZE_MAX : size;
}

static void change(struct window *window, const SDL_WindowEvent *event)
{
	window->stale |= event->event == SDL_WINDOWEVENT_EXPOSED;
	if (event->event != SDL_WINDOWEVENT_SIZE_CHANGED)
		return;
	window->options.width = within(event->data1);
	window->options.height = within(event->data2);
	window->resized = window->stale = true;
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
		drag(window, &event->motion);
		break;
	case SDL_MOUSEWHEEL:
		roll(window, event->wheel.y);
		break;
	case SDL_WINDOWEVENT:
		change(window, &event->window);
		break;
	default:
		break;
	}
}

/* ---- pictures ---- */

static int resize(struct window *window)
{
	int ret = open_picture(window);

	window->resized = false;
	return ret == VIEW_OK ? view_resize(window->view) : ret;
}

static void set_title(struct window *window)
{
	const char *mesh = window->options.mesh, *slash = strrchr(mesh, '/');
	char title[256];

	snprintf(title, sizeof(title), "%s - gloss-view: %s%s", slash ? slash + 1 : mesh,
		 view_shading_name(window->options.shading),
		 window->options.two_sided ? ", both sides" : "");
	SDL_SetWindowTitle(window->window, title);
}

static int redraw(struct window *window)
{
	int ret = window->resized ? resize(window) : VIEW_OK;

	window->stale = false;
	if (ret != VIEW_OK)
		return ret;
	view_camera_set(window->view, 0);
	ret = view_draw(window->view, window->options.shading, &window->picture);
	if (ret != VIEW_OK)
		return ret;
	set_title(window);
	if (SDL_UpdateTexture(window->texture, NULL, window->picture.pixel,
			      window->picture.width * (int)sizeof(*window->picture.pixel)) ||
	    SDL_RenderCopy(window->renderer, window->texture, NULL, NULL))
		return failed(SDL_GetError());
	SDL_RenderPresent(window->renderer);
	return VIEW_OK;
}

static int loop(struct window *window)
{
	SDL_Event event;
	int ret = VIEW_OK;

	while (!window->leave && ret == VIEW_OK) {
		if (window->stale)
			ret = redraw(window);
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
	struct window window = {
		.options = *options,
		.given = options,
		.view = view,
		.stale = true,
	};
	int ret;

	view->options = &window.options;
	ret = open_window(&window);
	if (ret == VIEW_OK)
		ret = loop(&window);
	view->options = options;
	close_window(&window);
	return ret;
}
