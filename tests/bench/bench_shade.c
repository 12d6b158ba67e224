// SPDX-License-Identifier: MIT
/*
 * bench_shade MESH...
 *
 * How fast the C model shades by second-order surfaces, and per-pixel Phong in C (tools/scene/phong.h),
 * both built with the same flags, on the same pixels. Two comparisons:
 *
 *   pixels  what the model does with the packed stream: checking it, edges, shading, depth test,
 *           clearing and storing all tiles; against Phong's triangles: edges, depth test, lighting.
 *           Phong's vertices are not counted, nor its clearing.
 *   frame   all there is: also vertices, and for the model lighting, set-up, binning, packing.
 *
 * Counted is processor time, so threads gain nothing; the model's is that of its own thread. The
 * ways to draw take turns, and the best time of each counts. Lines "name value" are for make bench.
 */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "scene/matrix.h"
#include "scene/mesh.h"
#include "scene/phong.h"

#define WIDTH 640
#define HEIGHT 480
#define SECONDS 4 /* for each scene */
#define ROUNDS_MIN 5

enum way {
	PHONG,
	PHONG_VERTICES, /* the same without triangles: clearing and vertices */
	QUADRATIC,
	ADAPTIVE,
	WAYS
};

/* Seconds a frame. */
struct cost {
	double frame; /* of the process */
	double board; /* of those, not of the calling thread: the model's */
};

struct bench {
	struct scene scene;
	struct phong_frame frame;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
};

static void die(const char *what)
{
	fprintf(stderr, "bench_shade: %s\n", what);
	exit(1);
}

static double seconds(clockid_t clock)
{
	struct timespec time;

	clock_gettime(clock, &time);
	return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static void draw_phong(struct bench *bench, bool triangles)
{
	struct scene scene = bench->scene;

	if (!triangles)
		scene.mesh.indices = 0;
	if (phong_draw(&scene, &bench->frame))
		die("phong_draw failed");
}

static void draw_model(struct bench *bench, enum accel_shading shading)
{
	if (scene_draw(&bench->scene, shading, bench->draw, bench->target, NULL))
		die("scene_draw failed");
}

static struct cost draw(struct bench *bench, enum way way)
{
	double process = seconds(CLOCK_PROCESS_CPUTIME_ID);
	double caller = seconds(CLOCK_THREAD_CPUTIME_ID);
	struct cost cost;

	if (way == PHONG || way == PHONG_VERTICES)
		draw_phong(bench, way == PHONG);
	else
		draw_model(bench,
			   way == QUADRATIC ? ACCEL_SHADING_QUADRATIC : ACCEL_SHADING_ADAPTIVE);
	caller = seconds(CLOCK_THREAD_CPUTIME_ID) - caller;
	cost.frame = seconds(CLOCK_PROCESS_CPUTIME_ID) - process;
	cost.board = cost.frame - caller;
	return cost;
}

static void draw_all(struct bench *bench, struct cost best[WAYS])
{
	double end = seconds(CLOCK_PROCESS_CPUTIME_ID) + SECONDS;

	for (enum way way = 0; way < WAYS; way++)
		best[way] = draw(bench, way);
	for (int i = 1; i < ROUNDS_MIN || seconds(CLOCK_PROCESS_CPUTIME_ID) < end; i++) {
		for (enum way way = 0; way < WAYS; way++) {
			struct cost cost = draw(bench, way);

			best[way].frame = fmin(best[way].frame, cost.frame);
			best[way].board = fmin(best[way].board, cost.board);
		}
	}
}

static void place(struct bench *bench, const struct mesh *mesh, bool lamp)
{
	struct scene *scene = &bench->scene;
	float centre[3], radius, aspect = (float)WIDTH / HEIGHT, away = lamp ? 4.05f : 2;

	mesh_bounds(mesh, centre, &radius);
	scene->mesh = mesh_lend(mesh);
	scene->local_viewer = lamp;
	if (lamp) {
		matrix_perspective(scene->projection, 30, aspect, away - 1.1f, away + 1.1f);
		scene->light[0] = scene_light_point(1, 1.2f, 1.2f - away);
	} else {
		matrix_orthographic(scene->projection, 1, aspect, away - 1.1f, away + 1.1f);
		scene->light[0] = scene_light_direction(0.3f, 0.4f, 0.866f);
	}
	matrix_identity(scene->modelview);
	matrix_translate(scene->modelview, 0, 0, -away);
	matrix_rotate_y(scene->modelview, 28.6f);
	matrix_rotate_x(scene->modelview, 51.6f);
	matrix_scale(scene->modelview, 1 / radius);
	matrix_translate(scene->modelview, -centre[0], -centre[1], -centre[2]);
}

/* After draw_all: the last Phong has no triangles. */
static unsigned int covered(struct bench *bench)
{
	unsigned int pixels = 0;

	draw_phong(bench, true);
	for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
		pixels += phong_covered(&bench->frame, i);
	return pixels;
}

/* "torus:24" is ".torus24" in a figure's name, "models/bunny.obj" is ".bunny". */
static void suffix_of(char suffix[32], const char *mesh)
{
	const char *slash = strrchr(mesh, '/');
	size_t length = 0;

	suffix[length++] = '.';
	for (const char *c = slash ? slash + 1 : mesh; *c && *c != '.' && length < 31; c++)
		if (isalnum((unsigned char)*c))
			suffix[length++] = (char)tolower((unsigned char)*c);
	suffix[length] = '\0';
}

static void measure(struct bench *bench, const char *scene, const char *suffix)
{
	struct cost best[WAYS];
	double pixels, phong;

	draw_all(bench, best);
	pixels = covered(bench) * 1e-6;
	phong = best[PHONG].frame - best[PHONG_VERTICES].frame;
	printf("# %s, %.0f pixels. Mpixel/s, pixels: Phong %.1f, second order %.1f, adaptive %.1f; "
	       "frame: %.1f, %.1f, %.1f\n",
	       scene, pixels * 1e6, pixels / phong, pixels / best[QUADRATIC].board,
	       pixels / best[ADAPTIVE].board, pixels / best[PHONG].frame,
	       pixels / best[QUADRATIC].frame, pixels / best[ADAPTIVE].frame);
	printf("shade.speed.vs_phong%s %.2f\nshade.speed.vs_phong.frame%s %.2f\n", suffix,
	       phong / best[QUADRATIC].board, suffix, best[PHONG].frame / best[QUADRATIC].frame);
	if (!*suffix)
		printf("shade.mpix_s.phong %.1f\nshade.mpix_s.model %.1f\n", pixels / phong,
		       pixels / best[QUADRATIC].board);
	fflush(stdout);
}

/* The first mesh's figures have no suffix; its other setting is the only one with a lamp. */
static void measure_mesh(struct bench *bench, const char *name, bool first)
{
	static const struct mesh_options smooth = { .normals = MESH_NORMALS_SMOOTH };
	char message[MESH_MESSAGE], suffix[32] = "";
	struct mesh mesh;

	if (mesh_load(name, &smooth, &mesh, message))
		die(message);
	if (!first)
		suffix_of(suffix, name);
	place(bench, &mesh, false);
	measure(bench, name, suffix);
	if (first) {
		place(bench, &mesh, true);
		measure(bench, "the same with a lamp, in perspective", ".lamp");
	}
	mesh_free(&mesh);
}

int main(int argc, char **argv)
{
	struct bench bench;

	scene_init(&bench.scene, WIDTH, HEIGHT);
	if (phong_frame_new(&bench.scene, false, &bench.frame))
		die("out of memory");
	if (accel_device_new("model:threads=1", NULL, NULL, &bench.device) ||
	    accel_target_new(bench.device, WIDTH, HEIGHT, &bench.target) ||
	    accel_draw_new(bench.device, &bench.draw))
		die("can not open the model");
	for (int i = 1; i < argc; i++)
		measure_mesh(&bench, argv[i], i == 1);
	accel_draw_free(bench.draw);
	accel_target_free(bench.target);
	accel_device_free(bench.device);
	phong_frame_free(&bench.frame);
	return 0;
}
