// SPDX-License-Identifier: MIT
/*
 * bench_setup MODELS
 *
 * What the library does with triangles before a board sees them: how many it sets up a second, and
 * how many words they are in the stream. Counted is the processor time of the calling thread, which
 * transforms, lights, sets up, bins and packs; the board is the C model in another thread. The
 * scenes are gloss-view's of the bunny and the horse, in the folder MODELS, and of spheres. Lines
 * "name value" are for make bench.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "gloss_packets.h"
#include "scene/scene.h"
#include "subject.h"

#define WIDTH 640
#define HEIGHT 480
#define ANGLES 4
#define SECONDS 1.5
#define TURNS_MIN 5
#define BYTES_MOST 48 /* of a triangle in the stream */

struct rates {
	double mtri_s, bytes;
};

struct bench {
	const char *models;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
};

static void need(int ret, const char *what)
{
	if (ret) {
		fprintf(stderr, "bench_setup: %s: %s\n", what, strerror(-ret));
		exit(1);
	}
}

static double thread_time(void)
{
	struct timespec time;

	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
	return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

/* Draws a frame; returns the calling thread's seconds for it. */
static double draw(struct bench *bench, const struct accel_state *state,
		   const struct accel_mesh *mesh, struct accel_draw_stats *stats)
{
	double start = thread_time(), time;
	static const struct accel_clear black = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR |
								    ACCEL_CLEAR_DEPTH,
							    .rgba = { 0, 0, 0, 1 }, .depth = 1);
	struct accel_fence *fence;

	need(accel_draw_begin(bench->draw, bench->target, &black), "accel_draw_begin");
	need(accel_draw_discard(bench->draw, ACCEL_CLEAR_DEPTH), "accel_draw_discard");
	need(accel_draw_mesh(bench->draw, state, mesh), "accel_draw_mesh");
	need(accel_draw_submit(bench->draw, &fence), "accel_draw_submit");
	time = thread_time() - start;
	accel_draw_stats(bench->draw, stats, sizeof(*stats));
	accel_fence_free(fence);
	return time;
}

/* Draws all scenes; returns the seconds for them. */
static double turn(struct bench *bench, const struct scene *scenes, enum accel_shading shading,
		   struct accel_draw_stats *sum)
{
	struct accel_draw_stats stats;
	struct accel_state *state;
	double time = 0;

	memset(sum, 0, sizeof(*sum));
	need(accel_state_new(&state), "accel_state_new");
	accel_state_set_shading(state, shading);
	for (int i = 0; i < ANGLES; i++) {
		need(scene_apply(&scenes[i], state), "scene_apply");
		time += draw(bench, state, &scenes[i].mesh, &stats);
		sum->flat += stats.flat;
		sum->linear += stats.linear;
		sum->second_order += stats.second_order;
		sum->stream_words += stats.stream_words;
	}
	accel_state_free(state);
	return time;
}

/* Million triangles a second, and bytes of the stream for each, of what is drawn. */
static struct rates measure(struct bench *bench, const struct subject *subject,
			    enum accel_shading shading)
{
	double begin = thread_time(), least = 1e9, drawn;
	struct scene scenes[ANGLES];
	struct view_options options;
	struct accel_draw_stats sum;
	struct rates rates;
	struct view view;

	if (subject_load(subject, bench->models, WIDTH, HEIGHT, &options, &view))
		exit(1);
	subject_scenes(&view, scenes, ANGLES);
	for (int i = 0; i < TURNS_MIN || thread_time() - begin < SECONDS; i++) {
		double time = turn(bench, scenes, shading, &sum);

		least = time < least ? time : least;
	}
	drawn = (double)(sum.flat + sum.linear + sum.second_order);
	rates.mtri_s = drawn / least * 1e-6;
	rates.bytes = 4.0 * (double)sum.stream_words / drawn;
	printf("# %s, %s: %.3f Mtriangle/s, %.1f bytes a triangle; of %u triangles %.0f are drawn, "
	       "%lu of them second order\n",
	       subject->name, view_shading_name(shading), rates.mtri_s, rates.bytes,
	       view.mesh.triangles, drawn / ANGLES, (unsigned long)sum.second_order / ANGLES);
	view_close(&view);
	return rates;
}

/* The words that @count triangles of two rows in one tile are with @shading, with all around them. */
static uint64_t words(struct bench *bench, enum accel_shading shading, uint32_t count)
{
	static const float position[6][3] = {
		{ -0.9f, 0.9f, 0 },  { -0.9f, 0.892f, 0 },  { -0.894f, 0.9f, 0 },
		{ -0.85f, 0.9f, 0 }, { -0.85f, 0.892f, 0 }, { -0.844f, 0.9f, 0 },
	};
	static const float normal[6][3] = {
		{ 0.1f, 0, 1 }, { 0, 0.2f, 1 }, { -0.2f, 0, 1 },
		{ 0, 0.1f, 1 }, { 0.2f, 0, 1 }, { 0.1f, 0.1f, 1 },
	};
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = count * 3,
						  .position = { .data = position },
						  .normal = { .data = normal });
	struct accel_draw_stats stats;
	struct accel_state *state;
	struct scene scene;

	scene_init(&scene, WIDTH, HEIGHT);
	scene.local_viewer = false;
	need(accel_state_new(&state), "accel_state_new");
	need(scene_apply(&scene, state), "scene_apply");
	accel_state_set_shading(state, shading);
	/* Twice, so that no tile needs clearing of what another frame drew. */
	draw(bench, state, &mesh, &stats);
	draw(bench, state, &mesh, &stats);
	accel_state_free(state);
	if (stats.records != count)
		need(-ERANGE, "a record for each triangle");
	return stats.stream_words;
}

/* The record of a small triangle, header and all: as the library packs it and as gloss.xml has it. */
static void record(struct bench *bench, const char *name, enum accel_shading shading,
		   enum gloss_shading form)
{
	struct gloss_triangle_small header = { .shading = form };
	uint64_t packed = words(bench, shading, 2) - words(bench, shading, 1);

	if (packed != 1 + gloss_triangle_small_length(&header))
		need(-ERANGE, "words of a small record");
	printf("stream.words.%s %lu\n", name, (unsigned long)packed);
}

/* The bunny as it is drawn, and the others for a look at what its figures depend on. */
static bool measure_all(struct bench *bench)
{
	struct rates bunny = measure(bench, &subject_bunny, ACCEL_SHADING_ADAPTIVE);
	bool missed = bunny.bytes > BYTES_MOST;

	printf("setup.mtri_s %.3f\n", bunny.mtri_s);
	printf("stream.bytes_per_triangle.bunny %.1f   # at most %d%s\n", bunny.bytes, BYTES_MOST,
	       missed ? ": MISSED" : "");
	measure(bench, &subject_bunny, ACCEL_SHADING_GOURAUD);
	measure(bench, &subject_bunny, ACCEL_SHADING_QUADRATIC);
	measure(bench, &subject_horse, ACCEL_SHADING_ADAPTIVE);
	measure(bench, &subject_sphere3, ACCEL_SHADING_ADAPTIVE);
	measure(bench, &subject_sphere5, ACCEL_SHADING_QUADRATIC);
	return missed;
}

int main(int argc, char **argv)
{
	struct bench bench = { .models = argc == 2 ? argv[1] : NULL };
	bool missed;

	if (!bench.models) {
		fprintf(stderr, "usage: bench_setup MODELS\n");
		return 2;
	}
	need(accel_device_new("model:threads=1", NULL, NULL, &bench.device), "model:");
	need(accel_target_new(bench.device, WIDTH, HEIGHT, &bench.target), "accel_target_new");
	need(accel_draw_new(bench.device, &bench.draw), "accel_draw_new");
	missed = measure_all(&bench);
	record(&bench, "flat", ACCEL_SHADING_FLAT, GLOSS_SHADING_FLAT);
	record(&bench, "linear", ACCEL_SHADING_GOURAUD, GLOSS_SHADING_LINEAR);
	record(&bench, "second_order", ACCEL_SHADING_QUADRATIC, GLOSS_SHADING_SECOND_ORDER);
	accel_draw_free(bench.draw);
	accel_target_free(bench.target);
	accel_device_free(bench.device);
	return missed;
}
