// SPDX-License-Identifier: MIT
/*
 * nmse [--markdown] [--figure FILE] DEVICE MESH...
 *
 * How far Gouraud, quadratic and adaptive shading are from per-pixel Phong: the normalised mean
 * square error over the mesh's pixels, and the worst channel of a pixel in steps of 8 bits. Fails
 * if adaptive shading exceeds LIMIT anywhere, or covers other pixels than the reference.
 *
 * Each mesh is drawn with three exponents and two strengths of the highlight, in two settings:
 * without perspective by five lights, one at a time (the last one grazing), taken together; and in
 * perspective by a lamp close to it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/matrix.h"
#include "scene/mesh.h"
#include "scene/quality.h"

#define LIMIT 2.5e-4
#define SIZE 512 /* pixels of the picture; the mesh is 480 high or wide */
#define FILL (480.0f / SIZE)
#define METHODS 3
#define SETTINGS 2

static const enum accel_shading methods[METHODS] = {
	ACCEL_SHADING_GOURAUD,
	ACCEL_SHADING_QUADRATIC,
	ACCEL_SHADING_ADAPTIVE,
};

static const float sun[5][3] = {
	{ 0.3f, 0.4f, 0.866f }, { -0.6f, 0.5f, 0.62f }, { 0.7f, -0.3f, 0.3f },
	{ 0.05f, -0.1f, 1 },    { -0.2f, -0.8f, 0.2f },
};

struct bench {
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct scene scene;
	struct phong_frame reference;
	uint32_t *colour, *depth;
	float modelview[16]; /* mesh to a sphere of radius 1, turned */
};

struct result {
	struct quality quality[METHODS];
	uint64_t drawn[METHODS]; /* triangles */
};

static void die(const char *what)
{
	fprintf(stderr, "nmse: %s\n", what);
	exit(1);
}

static void bench_open(struct bench *bench, const char *device)
{
	scene_init(&bench->scene, SIZE, SIZE);
	bench->colour = malloc(sizeof(*bench->colour) * SIZE * SIZE);
	bench->depth = malloc(sizeof(*bench->depth) * SIZE * SIZE);
	if (!bench->colour || !bench->depth ||
	    phong_frame_new(&bench->scene, true, &bench->reference))
		die("out of memory");
	if (accel_device_new(device, NULL, NULL, &bench->device) ||
	    accel_target_new(bench->device, SIZE, SIZE, &bench->target) ||
	    accel_draw_new(bench->device, &bench->draw))
		die("can not open the device");
}

static void bench_close(struct bench *bench)
{
	accel_draw_free(bench->draw);
	accel_target_free(bench->target);
	accel_device_free(bench->device);
	phong_frame_free(&bench->reference);
	free(bench->colour);
	free(bench->depth);
}

static void add_method(struct bench *bench, int method, struct result *result)
{
	struct accel_draw_stats stats;
	size_t pitch = SIZE * sizeof(uint32_t);

	if (scene_draw(&bench->scene, methods[method], bench->draw, bench->target, &stats) ||
	    accel_target_read(bench->target, ACCEL_PLANE_COLOUR, NULL, bench->colour, pitch) ||
	    accel_target_read(bench->target, ACCEL_PLANE_DEPTH, NULL, bench->depth, pitch))
		die("drawing failed");
	quality_add(&result->quality[method], &bench->reference, bench->colour, bench->depth);
	result->drawn[method] += stats.flat + stats.linear + stats.second_order;
}

static void add_picture(struct bench *bench, struct result *result)
{
	if (phong_draw(&bench->scene, &bench->reference))
		die("the reference failed");
	for (int i = 0; i < METHODS; i++)
		add_method(bench, i, result);
}

/* Five directional lights, one at a time, seen from far away. */
static void add_suns(struct bench *bench, struct result *result)
{
	struct scene *scene = &bench->scene;

	scene->local_viewer = false;
	matrix_orthographic(scene->projection, 1 / FILL, 1, 0.9f, 3.1f);
	matrix_identity(scene->modelview);
	matrix_translate(scene->modelview, 0, 0, -2);
	matrix_multiply(scene->modelview, scene->modelview, bench->modelview);
	for (int i = 0; i < 5; i++) {
		scene->light[0] = scene_light_direction(sun[i][0], sun[i][1], sun[i][2]);
		add_picture(bench, result);
	}
}

/* A lamp a radius away from the mesh, seen in perspective; the eye's direction counts too. */
static void add_lamp(struct bench *bench, struct result *result)
{
	struct scene *scene = &bench->scene;

	scene->local_viewer = true;
	matrix_perspective(scene->projection, 30, 1, 2.9f, 5.2f);
	matrix_identity(scene->modelview);
	matrix_translate(scene->modelview, 0, 0, -4.05f);
	matrix_multiply(scene->modelview, scene->modelview, bench->modelview);
	scene->light[0] = scene_light_point(1, 1.2f, 1.2f - 4.05f);
	scene->light[0].attenuation[0] = 0.75f;
	scene->light[0].attenuation[2] = 0.25f;
	add_picture(bench, result);
}

static void place(struct bench *bench, const struct mesh *mesh)
{
	float centre[3], radius;

	mesh_bounds(mesh, centre, &radius);
	bench->scene.mesh = mesh_lend(mesh);
	bench->scene.keeps_depth = true;
	matrix_identity(bench->modelview);
	/* So that a torus shows both of its radii, and spheres no symmetry. */
	matrix_rotate_y(bench->modelview, 28.6f);
	matrix_rotate_x(bench->modelview, 51.6f);
	matrix_scale(bench->modelview, 1 / radius);
	matrix_translate(bench->modelview, -centre[0], -centre[1], -centre[2]);
}

/* ---- the table ---- */

static bool markdown;
static double worst_adaptive;
static bool failed;

static void head(void)
{
	static const char columns[] = "Gouraud quadratic adaptive  x   worst";

	if (markdown)
		puts("| mesh | n | ks | five lights: Gouraud | quadratic | adaptive | x | worst |"
		     " lamp: Gouraud | quadratic | adaptive | x | worst |\n"
		     "|---|---|---|---|---|---|---|---|---|---|---|---|---|");
	else
		printf("%-12s %4s %4s   %-44s   %s\n%-22s   %-44s   %s\n", "mesh", "n", "ks",
		       "five lights, no perspective", "a lamp, in perspective", "", columns,
		       columns);
}

static void cells(const struct result *result)
{
	const struct quality *q = result->quality;
	double factor = (double)result->drawn[2] / (double)result->drawn[0];

	printf(markdown ? " %.1e | %.1e | **%.1e** | %.2f | %.0f/%.0f/%.0f |" :
			  "   %.1e  %.1e  %.1e  x%-5.2f %3.0f/%3.0f/%3.0f ",
	       quality_nmse(&q[0]), quality_nmse(&q[1]), quality_nmse(&q[2]), factor, q[0].worst,
	       q[1].worst, q[2].worst);
}

static void judge(const char *mesh, const struct result *result)
{
	double nmse = quality_nmse(&result->quality[2]);

	if (nmse > worst_adaptive)
		worst_adaptive = nmse;
	if (nmse > LIMIT) {
		fprintf(stderr, "nmse: %s: adaptive shading is off by %.2e, more than %.2e\n", mesh,
			nmse, LIMIT);
		failed = true;
	}
	for (int i = 0; i < METHODS; i++) {
		if (result->quality[i].stray) {
			fprintf(stderr, "nmse: %s: %lu pixels are covered by one of two\n", mesh,
				(unsigned long)result->quality[i].stray);
			failed = true;
		}
	}
}

static void row(struct bench *bench, const char *mesh, float n, float specular)
{
	struct result result[SETTINGS] = { 0 };
	const char *slash = strrchr(mesh, '/');
	const char *name = slash ? slash + 1 : mesh;

	bench->scene.material[0] = scene_material_grey(0.1f, 0.9f - specular, specular, n);
	bench->scene.material[1] = bench->scene.material[0];
	add_suns(bench, &result[0]);
	add_lamp(bench, &result[1]);
	printf(markdown ? "| %s | %.0f | %.1f |" : "%-12s %4.0f %4.1f", name, (double)n,
	       (double)specular);
	for (int i = 0; i < SETTINGS; i++) {
		cells(&result[i]);
		judge(name, &result[i]);
	}
	putchar('\n');
}

static void rows(struct bench *bench, const char *name)
{
	static const float exponents[] = { 10, 30, 100 }, strengths[] = { 0.3f, 0.6f };
	static const struct mesh_options smooth = { .normals = MESH_NORMALS_SMOOTH };
	char message[MESH_MESSAGE];
	struct mesh mesh;

	if (mesh_load(name, &smooth, &mesh, message))
		die(message);
	place(bench, &mesh);
	for (int s = 0; s < 2; s++)
		for (int n = 0; n < 3; n++)
			row(bench, name, exponents[n], strengths[s]);
	mesh_free(&mesh);
}

static void write_figure(const char *path)
{
	FILE *file = fopen(path, "w");

	if (!file)
		die("can not write the figure");
	fprintf(file, "shade.nmse.worst %.3e\n", worst_adaptive);
	if (fclose(file))
		die("can not write the figure");
}

int main(int argc, char **argv)
{
	const char *figure = NULL;
	struct bench bench;
	int i = 1;

	for (; i < argc && argv[i][0] == '-'; i++) {
		if (!strcmp(argv[i], "--markdown"))
			markdown = true;
		else if (!strcmp(argv[i], "--figure") && i + 1 < argc)
			figure = argv[++i];
	}
	if (argc - i < 2)
		die("usage: nmse [--markdown] [--figure FILE] DEVICE MESH...");
	bench_open(&bench, argv[i++]);
	head();
	for (; i < argc; i++)
		rows(&bench, argv[i]);
	bench_close(&bench);
	printf("%sworst of adaptive shading: %.2e, limit %.2e\n", markdown ? "\n" : "",
	       worst_adaptive, LIMIT);
	if (figure)
		write_figure(figure);
	return failed;
}
