// SPDX-License-Identifier: MIT
/*
 * bench_shade MESH...
 *
 * How fast the C model shades by second-order surfaces, and per-pixel Phong in C (tools/phong.h),
 * both built with the same flags. Each draws the same frame, that is the same pixels, and all of
 * its work is counted: clearing, transformation, lighting, set-up, and for the model also binning,
 * packing the stream, checking it and storing tiles. Counted is processor time of the whole
 * process, so threads would gain nothing; the best of many frames. The first mesh's figures are
 * printed as "name value" for make bench.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "matrix.h"
#include "mesh.h"
#include "phong.h"

#define WIDTH 640
#define HEIGHT 480
#define SECONDS 1.5			/* for each way of each frame */
#define FRAMES_MIN 5

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

static double processor_time(void)
{
	struct timespec time;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
	return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static void draw_phong(struct bench *bench)
{
	if (phong_draw(&bench->scene, &bench->frame))
		die("phong_draw failed");
}

static void draw_quadratic(struct bench *bench)
{
	if (scene_draw(&bench->scene, ACCEL_SHADING_QUADRATIC, bench->draw, bench->target, NULL))
		die("scene_draw failed");
}

static void draw_adaptive(struct bench *bench)
{
	if (scene_draw(&bench->scene, ACCEL_SHADING_ADAPTIVE, bench->draw, bench->target, NULL))
		die("scene_draw failed");
}

/* Seconds a frame. */
static double best(struct bench *bench, void (*draw)(struct bench *bench))
{
	double begin = processor_time(), least = 1e9;

	for (int i = 0; i < FRAMES_MIN || processor_time() - begin < SECONDS; i++) {
		double start = processor_time(), time;

		draw(bench);
		time = processor_time() - start;
		least = time < least ? time : least;
	}
	return least;
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

static unsigned int covered(const struct bench *bench)
{
	unsigned int pixels = 0;

	for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
		pixels += phong_covered(&bench->frame, i);
	return pixels;
}

static void measure(struct bench *bench, const char *mesh, bool lamp, bool figures)
{
	double phong = best(bench, draw_phong);
	double quadratic = best(bench, draw_quadratic);
	double adaptive = best(bench, draw_adaptive);
	double pixels = covered(bench);
	const char *slash = strrchr(mesh, '/');
	const char *setting = lamp ? ".lamp" : "";

	printf("# %-10s %-17s %6.0f pixels; Mpixel/s: Phong %5.1f, second order %6.1f (x%.1f), "
	       "adaptive %6.1f (x%.1f)\n", slash ? slash + 1 : mesh,
	       lamp ? "lamp, perspective" : "one direction", pixels, pixels / phong * 1e-6,
	       pixels / quadratic * 1e-6, phong / quadratic, pixels / adaptive * 1e-6,
	       phong / adaptive);
	if (figures)
		printf("shade.speed.vs_phong%s %.2f\nshade.mpix_s.phong%s %.1f\n"
		       "shade.mpix_s.model%s %.1f\n", setting, phong / quadratic, setting,
		       pixels / phong * 1e-6, setting, pixels / quadratic * 1e-6);
	fflush(stdout);
}

int main(int argc, char **argv)
{
	char message[MESH_MESSAGE];
	struct bench bench;
	struct mesh mesh;

	scene_init(&bench.scene, WIDTH, HEIGHT);
	if (phong_frame_new(&bench.scene, false, &bench.frame))
		die("out of memory");
	if (accel_device_new("model:", NULL, NULL, &bench.device) ||
	    accel_target_new(bench.device, WIDTH, HEIGHT, &bench.target) ||
	    accel_draw_new(bench.device, &bench.draw))
		die("can not open the model");
	for (int i = 1; i < argc; i++) {
		if (mesh_load(argv[i], false, &mesh, message))
			die(message);
		for (int lamp = 0; lamp < 2; lamp++) {
			place(&bench, &mesh, lamp);
			measure(&bench, argv[i], lamp, i == 1);
		}
		mesh_free(&mesh);
	}
	accel_draw_free(bench.draw);
	accel_target_free(bench.target);
	accel_device_free(bench.device);
	phong_frame_free(&bench.frame);
	return 0;
}
