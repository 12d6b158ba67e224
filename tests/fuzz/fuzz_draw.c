// SPDX-License-Identifier: MIT
/*
 * fuzz_draw FRAMES
 *
 * Frames of anything that the calls of accel_draw.h can be asked for: meshes, states, targets and
 * clears, with numbers from the ends of their types, and memory that runs out. Whatever it is, a
 * call answers as the header says, and the board takes the stream of every frame without a fault.
 *
 * Frame n is made of seed GLOSS_SEED + n alone, which is printed if it fails.
 */
#include <errno.h>
#include <sanitizer/common_interface_defs.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "accel.h"
#include "fuzz_draw_numbers.h"
#include "fuzz_draw_state.h"

#define DEVICES 2
#define TARGETS 4
#define VERTICES 24
#define INDICES 48
#define FRAME_SECONDS 60

/* ---- memory that runs out, for this thread, when @left allocations have succeeded ---- */

static _Thread_local int left = -1; /* -1: it does not */
static _Thread_local bool failed;
static uint64_t short_of_memory;

static bool runs_out(void)
{
	if (left < 0)
		return false;
	if (left-- > 0)
		return false;
	failed = true;
	short_of_memory++;
	return true;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);

void *__wrap_malloc(size_t size)
{
	return runs_out() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
	return runs_out() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size)
{
	return runs_out() ? NULL : __real_realloc(block, size);
}

/* ---- what is drawn with and on ---- */

struct board {
	struct accel_device *device;
	struct accel_target *target[TARGETS];
	struct accel_draw *draw;
};

static struct board boards[DEVICES];
static struct accel_state *state;
static uint64_t frame_seed, meshes, taken, drawn;

static void tell_seed(void)
{
	/* NOLINTNEXTLINE(bugprone-signal-handler): see too_long */
	fprintf(stderr, "\nfuzz_draw: repeat this with: GLOSS_SEED=%llu fuzz_draw 1\n",
		(unsigned long long)frame_seed);
}

/* It ends the program, whose stderr nobody uses at that time. */
static void too_long(int signal)
{
	(void)signal;
	tell_seed();
	_exit(1);
}

static void need(bool condition, const char *what, int got)
{
	if (condition)
		return;
	fprintf(stderr, "fuzz_draw: %s: %d\n", what, got);
	tell_seed();
	_exit(1);
}

static void boards_open(void)
{
	static const char *const name[DEVICES] = { "model:tile=64,memory=67108864",
						   "model:tile=32,memory=67108864" };
	static const int size[TARGETS][2] = { { 1, 1 }, { 33, 65 }, { 150, 100 }, { 257, 190 } };

	for (int i = 0; i < DEVICES; i++) {
		need(!accel_device_new(name[i], NULL, NULL, &boards[i].device), "no model", i);
		for (int j = 0; j < TARGETS; j++)
			need(!accel_target_new(boards[i].device, size[j][0], size[j][1],
					       &boards[i].target[j]),
			     "no target", j);
		need(!accel_draw_new(boards[i].device, &boards[i].draw), "no draw", i);
	}
	need(!accel_state_new(&state), "no state", 0);
}

static void boards_close(void)
{
	for (int i = 0; i < DEVICES; i++) {
		accel_draw_free(boards[i].draw);
		for (int j = 0; j < TARGETS; j++)
			accel_target_free(boards[i].target[j]);
		accel_device_free(boards[i].device);
	}
	accel_state_free(state);
}

/* ---- calls ---- */

/* What the arrays have for a vertex: room for the largest element. */
#define ELEMENT_FLOATS 8

/* Of @data that has VERTICES times ELEMENT_FLOATS; no element reaches behind them. */
static struct accel_array any_array(const void *data, int most)
{
	struct accel_array array = { .data = data };

	if (one_in(2))
		array.stride = (uint32_t)below(4 * most + 1);
	if (one_in(4))
		array.components = (uint8_t)(one_in(20) ? below(most + 2) : most - below(2));
	if (most == 4 && one_in(3)) {
		array.type = ACCEL_TYPE_UBYTE;
		array.normalised = !one_in(20);
	}
	if (one_in(5))
		array.type = (enum accel_type)(one_in(10) ? any_int() : below(ACCEL_TYPE_UINT + 1));
	array.constant = one_in(20);
	return array;
}

static enum accel_topology any_topology(void)
{
	if (one_in(50))
		return (enum accel_topology)any_int();
	return (enum accel_topology)below(ACCEL_TOPOLOGY_POLYGON + 1);
}

static float position[VERTICES][ELEMENT_FLOATS], normal[VERTICES][ELEMENT_FLOATS];
static float colour[VERTICES][ELEMENT_FLOATS];
static uint32_t indices[INDICES];

static void fill_arrays(uint32_t vertices)
{
	any_floats(&position[0][0], VERTICES * ELEMENT_FLOATS);
	any_floats(&normal[0][0], VERTICES * ELEMENT_FLOATS);
	any_floats(&colour[0][0], VERTICES * ELEMENT_FLOATS);
	for (int i = 0; i < INDICES; i++)
		indices[i] = one_in(1000) ? (uint32_t)random_word() :
					    (uint32_t)below((int)vertices + !vertices);
}

static void drawn_as(const char *call, int err)
{
	need(!err || err == -EINVAL || (err == -ENOMEM && failed), call, err);
	meshes++;
	taken += !err;
}

static void draw_mesh(const struct board *board)
{
	struct accel_mesh mesh = ACCEL_MESH(.topology = any_topology());

	mesh.vertices = (uint32_t)below(VERTICES + 1);
	fill_arrays(mesh.vertices);
	if (one_in(2)) {
		mesh.position = (struct accel_array){ .data = position };
		mesh.normal = any_array(one_in(3) ? NULL : normal, 3);
	} else {
		mesh.position = any_array(one_in(50) ? NULL : position, 3);
		mesh.normal.data = one_in(3) ? NULL : normal;
	}
	mesh.colour = any_array(one_in(3) ? NULL : colour, 4);
	mesh.indices = (uint32_t)below(INDICES + 1);
	mesh.index = one_in(2) ? indices : NULL;
	failed = false;
	drawn_as("accel_draw_mesh", accel_draw_mesh(board->draw, state, &mesh));
}

/* It is on the target, or not farther from it than it may be. */
static void captured(void *data, enum accel_captured what,
		     const struct accel_captured_vertex *vertex, uint32_t vertices)
{
	(void)data;
	need(vertices == 1 || vertices == 2 || what == ACCEL_CAPTURED_POLYGON, "captured vertices",
	     (int)vertices);
	for (uint32_t i = 0; i < vertices; i++) {
		const float *window = vertex[i].window, *rgba = vertex[i].colour;

		need(window[0] > -40000 && window[0] < 40000 && window[1] > -40000 &&
			     window[1] < 40000,
		     "a captured place", (int)i);
		need(window[2] >= 0 && window[2] <= 1 && window[3] > 0, "a captured depth", (int)i);
		for (int j = 0; j < 4; j++)
			need(rgba[j] >= 0 && rgba[j] <= 1, "a captured colour", j);
	}
}

/* Indices are of four bytes at least, so as many of any type can be read. */
static void draw_arrays(const struct board *board)
{
	struct accel_primitive primitive[4];
	struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = (uint32_t)below(VERTICES + 1));
	struct accel_elements elements = ACCEL_ELEMENTS(.primitive = primitive,
							.primitives = (uint32_t)below(5));

	fill_arrays(arrays.vertices);
	arrays.position = any_array(one_in(50) ? NULL : position, 4);
	arrays.normal = any_array(one_in(3) ? NULL : normal, 3);
	arrays.colour = any_array(one_in(3) ? NULL : colour, 4);
	arrays.edge = any_array(one_in(3) ? NULL : normal, 1);
	if (one_in(2)) {
		elements.index = indices;
		elements.index_type = one_in(3) ? ACCEL_TYPE_UBYTE :
				      one_in(2) ? ACCEL_TYPE_USHORT :
						  ACCEL_TYPE_UINT;
	}
	for (int i = 0; i < 4; i++) {
		primitive[i].topology = any_topology();
		primitive[i].first = (uint32_t)below(INDICES + 1);
		primitive[i].count = (uint32_t)below(INDICES + 1 - (int)primitive[i].first);
		if (!elements.index && one_in(10))
			primitive[i].first = (uint32_t)random_word();
	}
	failed = false;
	if (one_in(6))
		accel_draw_capture(board->draw, captured, board->draw);
	drawn_as("accel_draw_arrays", accel_draw_arrays(board->draw, state, &arrays, &elements));
	accel_draw_capture(board->draw, NULL, NULL);
}

static struct accel_clear any_clear(void)
{
	struct accel_clear clear = ACCEL_CLEAR(.mask = (unsigned int)below(one_in(20) ? 9 : 4),
					       .depth = float_to(1));

	any_floats(clear.rgba, 4);
	if (one_in(100))
		clear.size = (size_t)below((int)sizeof(clear));
	return clear;
}

static int begin(const struct board *board, struct accel_target *target)
{
	const struct accel_clear clear = any_clear();
	int err;

	failed = false;
	err = accel_draw_begin(board->draw, target, one_in(4) ? NULL : &clear);
	need(!err || err == -EINVAL || (err == -ENOMEM && failed), "accel_draw_begin", err);
	return err;
}

/* With what the target has if the clear is refused, so that there is something to draw on. */
static void begin_at_last(const struct board *board, struct accel_target *target)
{
	int err;

	if (begin(board, target) != -EINVAL)
		return;
	failed = false;
	err = accel_draw_begin(board->draw, target, NULL);
	need(!err || (err == -ENOMEM && failed), "accel_draw_begin", err);
}

static void clear(const struct board *board)
{
	const struct accel_clear clear = any_clear();
	int err;

	failed = false;
	err = accel_draw_clear(board->draw, &clear);
	need(!err || err == -EINVAL || (err == -ENOMEM && failed), "accel_draw_clear", err);
}

static void clear_masked(const struct board *board)
{
	const struct accel_clear clear = any_clear();
	int err;

	failed = false;
	err = accel_draw_clear_masked(board->draw, state, &clear);
	need(!err || err == -EINVAL || (err == -ENOMEM && failed), "accel_draw_clear_masked", err);
}

static void draw_rectangles(const struct board *board)
{
	struct accel_fill fill[3];
	int err;

	for (int i = 0; i < 3; i++) {
		fill[i].pixels = (struct accel_rectangle){ any_int(), any_int(), any_int(),
							   any_int() };
		fill[i].depth = float_to(1);
		any_floats(fill[i].rgba, 4);
	}
	failed = false;
	err = accel_draw_rectangles(board->draw, state, fill, (uint32_t)below(4));
	need(!err || err == -EINVAL || (err == -ENOMEM && failed), "accel_draw_rectangles", err);
}

/* A frame that was sent is one the board draws without a fault. */
static void submit(const struct board *board)
{
	struct accel_fence_status status;
	struct accel_draw_stats stats;
	struct accel_fence *fence;
	bool waits = !one_in(4);
	int err;

	failed = false;
	fence = NULL;
	err = accel_draw_submit(board->draw, waits ? &fence : NULL);
	need(!err || err == -EINVAL || (err == -ENOMEM && failed), "accel_draw_submit", err);
	if (err || !waits)
		return;
	err = accel_fence_wait(fence, -1, &status, sizeof(status));
	need(!err, "a frame ended", err);
	need(!status.fault, "a frame ended with fault", (int)status.fault);
	accel_fence_free(fence);
	accel_draw_stats(board->draw, &stats, sizeof(stats));
	need(stats.triangles_in >= stats.culled + stats.clipped, "triangles counted",
	     (int)stats.culled);
	drawn += stats.records;
}

/* A draw keeps its memory, so memory can only run out for a new one. */
static void draw_renew(struct board *board)
{
	accel_draw_free(board->draw);
	need(!accel_draw_new(board->device, &board->draw), "no draw", 0);
}

static void frame_end(struct board *board)
{
	int err;

	left = -1;
	submit(board);
	draw_renew(board);
	err = accel_device_finish(board->device);
	need(!err, "frames that nobody waited for", err);
}

static void frame(uint64_t seed)
{
	static const int wild[] = { 0, 400, 40, 4 };
	struct accel_target *target, *own = NULL;
	struct board *board;

	frame_seed = seed;
	numbers_start(seed);
	board = &boards[below(DEVICES)];
	numbers_wild(wild[below(4)]);
	target = board->target[below(TARGETS)];
	alarm(FRAME_SECONDS);
	accel_state_free(state);
	need(!accel_state_new(&state), "no state", 0);
	if (one_in(100) && !accel_target_new(board->device, 1 + below(2048), 1 + below(64), &own))
		target = own;
	left = one_in(8) ? below(40) : -1;
	begin_at_last(board, target);
	for (int calls = 1 + below(6); calls > 0; calls--) {
		fuzz_draw_state(state);
		if (one_in(4))
			clear(board);
		if (one_in(6))
			clear_masked(board);
		if (one_in(6))
			draw_rectangles(board);
		if (one_in(2))
			draw_mesh(board);
		else
			draw_arrays(board);
		if (one_in(6)) {
			submit(board);
			if (!one_in(6))
				begin_at_last(board, target);
		}
		/* Another target, or another board's, which is refused. */
		if (one_in(6))
			begin(board,
			      one_in(3) ? boards[below(DEVICES)].target[below(TARGETS)] : target);
	}
	frame_end(board);
	accel_target_free(own);
}

int main(int argc, char **argv)
{
	const char *given = getenv("GLOSS_SEED");
	uint64_t seed = given ? strtoull(given, NULL, 0) : (uint64_t)time(NULL) << 20;
	long frames = argc == 2 ? atol(argv[1]) : 0;

	if (frames <= 0) {
		fprintf(stderr, "usage: fuzz_draw FRAMES\n");
		return 2;
	}
	printf("GLOSS_SEED=%llu\n", (unsigned long long)seed);
	fflush(stdout);
	__sanitizer_set_death_callback(tell_seed);
	signal(SIGALRM, too_long);
	boards_open();
	for (long n = 0; n < frames; n++)
		frame(seed + (uint64_t)n);
	boards_close();
	printf("%ld frames: %llu of %llu meshes taken, %llu records drawn, memory ran out %llu "
	       "times\n",
	       frames, (unsigned long long)taken, (unsigned long long)meshes,
	       (unsigned long long)drawn, (unsigned long long)short_of_memory);
	return 0;
}
