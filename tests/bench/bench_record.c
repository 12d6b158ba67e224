// SPDX-License-Identifier: MIT
/*
 * bench_record MODELS
 *
 * Clocks that the core takes for a record of the bunny, as the library sends it: 4 angles of
 * gloss-view's scene on the Verilated core of 8 lanes, less the clocks in which triangles wait for
 * a tile's memory. Depth is not stored, as where nobody reads it. Prints a "name value" line; fails
 * if the figure misses its aim.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "subject.h"

#define DEVICE "sim:tile=64,lanes=8"
#define WIDTH 640
#define HEIGHT 480
#define ANGLES 4
#define CLOCKS_MOST 5.5

struct bench {
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct accel_state *state;
};

static void need(int ret, const char *what)
{
	if (ret) {
		fprintf(stderr, "bench_record: %s: %s\n", what, strerror(-ret));
		exit(1);
	}
}

static void open_device(struct bench *bench)
{
	need(accel_device_new(DEVICE, accel_message_print, stderr, &bench->device), DEVICE);
	need(accel_target_new(bench->device, WIDTH, HEIGHT, &bench->target), "accel_target_new");
	need(accel_draw_new(bench->device, &bench->draw), "accel_draw_new");
	need(accel_state_new(&bench->state), "accel_state_new");
	accel_state_set_shading(bench->state, ACCEL_SHADING_ADAPTIVE);
}

static void close_device(struct bench *bench)
{
	accel_state_free(bench->state);
	accel_draw_free(bench->draw);
	accel_target_free(bench->target);
	accel_device_free(bench->device);
}

/* Draws a frame; returns its records. */
static uint64_t draw(struct bench *bench, const struct scene *scene)
{
	static const struct accel_clear black = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR |
								    ACCEL_CLEAR_DEPTH,
							    .rgba = { 0, 0, 0, 1 }, .depth = 1);
	struct accel_draw_stats stats;

	need(scene_apply(scene, bench->state), "scene_apply");
	need(accel_draw_begin(bench->draw, bench->target, &black), "accel_draw_begin");
	need(accel_draw_discard(bench->draw, ACCEL_CLEAR_DEPTH), "accel_draw_discard");
	need(accel_draw_mesh(bench->draw, bench->state, &scene->mesh), "accel_draw_mesh");
	need(accel_draw_finish(bench->draw), "accel_draw_finish");
	accel_draw_stats(bench->draw, &stats, sizeof(stats));
	return stats.records;
}

int main(int argc, char **argv)
{
	struct accel_device_clocks clocks;
	struct scene scenes[ANGLES];
	struct view_options options;
	struct bench bench;
	struct view view;
	uint64_t records = 0;
	double figure;

	if (argc != 2) {
		fprintf(stderr, "usage: bench_record MODELS\n");
		return 2;
	}
	if (subject_load(&subject_bunny, argv[1], WIDTH, HEIGHT, &options, &view))
		return 1;
	open_device(&bench);
	subject_scenes(&view, scenes, ANGLES);
	for (int i = 0; i < ANGLES; i++)
		records += draw(&bench, &scenes[i]);
	need(accel_device_clocks(bench.device, &clocks, sizeof(clocks)), "accel_device_clocks");
	figure = (double)(clocks.clocks - clocks.stall_tile) / (double)records;
	printf("core.clk.record.bunny %.2f   # at most %.1f%s\n", figure, CLOCKS_MOST,
	       figure > CLOCKS_MOST ? ": MISSED" : "");
	view_close(&view);
	close_device(&bench);
	return figure > CLOCKS_MOST;
}
