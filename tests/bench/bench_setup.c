// SPDX-License-Identifier: MIT
/*
 * bench_setup MESH...
 *
 * What the library does with triangles before a board sees them: how many it sets up a second, and
 * how many words they are in the stream. Counted is the processor time of the calling thread, which
 * transforms, lights, sets up, bins and packs; the board is the C model in another thread. The
 * first mesh's figure is printed as "name value" for make bench.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "gloss_packets.h"
#include "scene/matrix.h"
#include "scene/mesh.h"
#include "scene/scene.h"

#define SIZE 480
#define SECONDS 1.5
#define FRAMES_MIN 5

struct bench {
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct accel_state *state;
	struct scene scene;
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
static double draw(struct bench *bench, const struct accel_mesh *mesh,
		   struct accel_draw_stats *stats)
{
	double start = thread_time(), time;
	static const struct accel_clear black = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR |
								    ACCEL_CLEAR_DEPTH,
							    .rgba = { 0, 0, 0, 1 }, .depth = 1);
	struct accel_fence *fence;

	need(accel_draw_begin(bench->draw, bench->target, &black), "accel_draw_begin");
	need(accel_draw_discard(bench->draw, ACCEL_CLEAR_DEPTH), "accel_draw_discard");
	need(accel_draw_mesh(bench->draw, bench->state, mesh), "accel_draw_mesh");
	need(accel_draw_submit(bench->draw, &fence), "accel_draw_submit");
	time = thread_time() - start;
	accel_draw_stats(bench->draw, stats, sizeof(*stats));
	accel_fence_free(fence);
	return time;
}

static void place(struct bench *bench, const struct mesh *mesh)
{
	struct scene *scene = &bench->scene;
	float centre[3], radius;

	mesh_bounds(mesh, centre, &radius);
	matrix_perspective(scene->projection, 30, 1, 2.9f, 5.2f);
	matrix_identity(scene->modelview);
	matrix_translate(scene->modelview, 0, 0, -4.05f);
	matrix_rotate_y(scene->modelview, 28.6f);
	matrix_scale(scene->modelview, 1 / radius);
	matrix_translate(scene->modelview, -centre[0], -centre[1], -centre[2]);
	scene->light[0] = scene_light_direction(0.3f, 0.4f, 0.866f);
	need(scene_apply(scene, bench->state), "scene_apply");
	accel_state_set_shading(bench->state, ACCEL_SHADING_QUADRATIC);
}

static void measure(struct bench *bench, const char *name, bool figure)
{
	double begin = thread_time(), least = 1e9;
	struct accel_draw_stats stats;
	static const struct mesh_options smooth = { .normals = MESH_NORMALS_SMOOTH };
	char message[MESH_MESSAGE];
	struct accel_mesh lent;
	struct mesh mesh;
	uint64_t drawn;
	double rate;

	need(mesh_load(name, &smooth, &mesh, message), name);
	place(bench, &mesh);
	lent = mesh_lend(&mesh);
	for (int i = 0; i < FRAMES_MIN || thread_time() - begin < SECONDS; i++) {
		double time = draw(bench, &lent, &stats);

		least = time < least ? time : least;
	}
	drawn = stats.flat + stats.linear + stats.second_order;
	rate = (double)drawn / least * 1e-6;
	printf("# %s: %.3f Mtriangle/s, %lu of %lu triangles drawn (%lu second order)\n", name,
	       rate, (unsigned long)drawn, (unsigned long)stats.triangles_in,
	       (unsigned long)stats.second_order);
	if (figure)
		printf("setup.mtri_s %.3f\n", rate);
	mesh_free(&mesh);
}

/* The words that @count small triangles in one tile are with @shading, with all around them. */
static uint64_t words(struct bench *bench, enum accel_shading shading, uint32_t count)
{
	static const float position[6][3] = {
		{ -0.9f, 0.9f, 0 }, { -0.9f, 0.85f, 0 }, { -0.85f, 0.9f, 0 },
		{ -0.8f, 0.9f, 0 }, { -0.8f, 0.85f, 0 }, { -0.75f, 0.9f, 0 },
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

	scene_init(&bench->scene, SIZE, SIZE);
	need(scene_apply(&bench->scene, bench->state), "scene_apply");
	accel_state_set_local_viewer(bench->state, false);
	accel_state_set_shading(bench->state, shading);
	draw(bench, &mesh, &stats);
	if (stats.records != count)
		need(-ERANGE, "a record for each triangle");
	return stats.stream_words;
}

/* The record of a small triangle, header and all: as the library packs it and as gloss.xml has it. */
static void record(struct bench *bench, const char *name, enum accel_shading shading,
		   enum gloss_shading form)
{
	struct gloss_triangle header = { .geometry = GLOSS_GEOMETRY_COMPACT, .shading = form };
	uint64_t packed = words(bench, shading, 2) - words(bench, shading, 1);

	if (packed != 1 + gloss_triangle_length(&header))
		need(-ERANGE, "words of a compact record");
	printf("stream.words.%s %lu\n", name, (unsigned long)packed);
}

int main(int argc, char **argv)
{
	struct bench bench;

	scene_init(&bench.scene, SIZE, SIZE);
	need(accel_device_new("model:", NULL, NULL, &bench.device), "model:");
	need(accel_target_new(bench.device, SIZE, SIZE, &bench.target), "accel_target_new");
	need(accel_draw_new(bench.device, &bench.draw), "accel_draw_new");
	need(accel_state_new(&bench.state), "accel_state_new");
	for (int i = 1; i < argc; i++)
		measure(&bench, argv[i], i == 1);
	record(&bench, "flat", ACCEL_SHADING_FLAT, GLOSS_SHADING_FLAT);
	record(&bench, "linear", ACCEL_SHADING_GOURAUD, GLOSS_SHADING_LINEAR);
	record(&bench, "second_order", ACCEL_SHADING_QUADRATIC, GLOSS_SHADING_SECOND_ORDER);
	accel_state_free(bench.state);
	accel_draw_free(bench.draw);
	accel_target_free(bench.target);
	accel_device_free(bench.device);
	return 0;
}
