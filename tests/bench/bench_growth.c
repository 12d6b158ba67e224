// SPDX-License-Identifier: MIT
/*
 * bench_growth [--short]
 *
 * Where the library's time goes with the size of triangles and of pictures, against llvmpipe:
 *
 *   rate    grids that cover a picture of 512x512, of triangles of 1 to 512 pixels
 *   growth  a torus of a thousand to a million triangles at 1280x720; a sphere of 1,280 triangles
 *           in pictures of 320x240 to 2048x2048
 *
 * Adaptive shading on the model, one thread. Pictures are compared first, then the ways take turns,
 * and the median of the rounds' quotients counts. --short is one round. Lines "name value" are for
 * make bench.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contest.h"
#include "scene/matrix.h"
#include "subject.h"

#define GRID 512    /* pixels of the picture that a grid covers */
#define SECONDS 1.5 /* of processor time, for the library in one contest */
#define ROUNDS_MIN 3
#define LARGE 300000 /* indices, of a frame that is long enough by itself */

/* The last are there for their pictures alone. */
#define TIMED_WAYS \
	(1u << CONTEST_GLOSS | 1u << CONTEST_LLVMPIPE_GOURAUD | 1u << CONTEST_LLVMPIPE_PHONG)
#define ALL_WAYS (TIMED_WAYS | 1u << CONTEST_GOURAUD)

static bool short_form;

static void need(int ret)
{
	if (ret)
		exit(2);
}

/* Rounds of @count frames of one scene, which are more the shorter they are. */
static void measure(struct contest *contest, const struct scene *scene, int count)
{
	struct scene scenes[CONTEST_SCENES];
	double spent = 0;

	for (int i = 0; i < count; i++)
		scenes[i] = *scene;
	for (int i = 0; i < CONTEST_ROUNDS && (i < ROUNDS_MIN || spent < SECONDS); i++) {
		need(contest_round(contest, scenes, count, TIMED_WAYS));
		spent += contest->sample[CONTEST_GLOSS][i];
		if (short_form)
			break;
	}
}

static void print_speed(const struct contest *contest, enum contest_way way, const char *group,
			const char *name)
{
	struct contest_spread speed;

	if (!contest_has(contest, way)) {
		printf("%s.vs_%s.%s -   # what it needs is not here\n", group, contest_name(way),
		       name);
		return;
	}
	speed = contest_speed(contest, way);
	printf("%s.vs_%s.%s %.2f   # %.2f to %.2f in %d rounds\n", group, contest_name(way), name,
	       speed.median, speed.least, speed.most, speed.rounds);
}

/* @millions: of triangles or pixels, which the unit says. */
static void contend(const struct scene *scene, const char *group, const char *name,
		    const char *unit, double millions)
{
	int count = scene->mesh.indices > LARGE ? 1 : CONTEST_SCENES;
	struct contest contest;

	need(contest_begin(&contest, scene, ALL_WAYS));
	need(contest_compare(&contest, scene, 1, name));
	measure(&contest, scene, count);
	printf("%s.%s.%s %.3f\n", group, unit, name,
	       count * millions / contest_cost(&contest, CONTEST_GLOSS).median);
	print_speed(&contest, CONTEST_LLVMPIPE_GOURAUD, group, name);
	print_speed(&contest, CONTEST_LLVMPIPE_PHONG, group, name);
	fflush(stdout);
	contest_end(&contest);
}

/* ---- by the size of triangles ---- */

/* A vertex of a surface that bends away to all sides; its place in a picture of size 2. */
static void set_vertex(struct mesh *mesh, uint32_t index, float x, float y)
{
	const float position[3] = { x, y, 0 }, normal[3] = { x, y, 1 };

	memcpy(mesh->position[index], position, sizeof(position));
	memcpy(mesh->normal[index], normal, sizeof(normal));
}

/* Cells of @width times @height pixels, of two triangles each. */
static int make_grid(int width, int height, struct mesh *mesh)
{
	uint32_t columns = GRID / width, rows = GRID / height, next = 0;

	if (mesh_new((columns + 1) * (rows + 1), columns * rows * 2, mesh))
		return -1;
	for (uint32_t i = 0; i < mesh->vertices; i++)
		set_vertex(mesh, i, 2 * (float)(i % (columns + 1)) / (float)columns - 1,
			   2 * (float)(i / (columns + 1)) / (float)rows - 1);
	for (uint32_t i = 0; i < columns * rows; i++) {
		uint32_t a = i / columns * (columns + 1) + i % columns, b = a + columns + 1;
		const uint32_t triangles[2][3] = { { a, a + 1, b }, { b, a + 1, b + 1 } };

		memcpy(mesh->triangle[next], triangles, sizeof(triangles));
		next += 2;
	}
	return 0;
}

/* The subject's lights and material on a grid that fits the picture. */
static void bench_rate(int width, int height)
{
	struct view_options options;
	struct mesh mesh;
	struct view view;
	struct scene scene;
	char name[32];

	need(subject_load(&subject_sphere3, NULL, GRID, GRID, &options, &view));
	need(make_grid(width, height, &mesh));
	scene = view.scene;
	scene.mesh = mesh_lend(&mesh);
	matrix_identity(scene.modelview);
	matrix_translate(scene.modelview, 0, 0, -4);
	matrix_orthographic(scene.projection, 1, 1, 3, 5);
	snprintf(name, sizeof(name), "tri_%dpx", width * height / 2);
	contend(&scene, "rate", name, "mtri_s", mesh.triangles * 1e-6);
	mesh_free(&mesh);
	view_close(&view);
}

/* ---- by the number of triangles and of pixels ---- */

static void bench_growth(const struct subject *subject, int width, int height, const char *unit)
{
	struct view_options options;
	struct scene scene;
	struct view view;
	bool pixels = !strcmp(unit, "mpix_s");

	need(subject_load(subject, NULL, width, height, &options, &view));
	subject_scenes(&view, &scene, 1);
	contend(&scene, "growth", subject->name, unit,
		(pixels ? width * height : (double)view.mesh.triangles) * 1e-6);
	view_close(&view);
}

static void bench_growths(void)
{
	static const struct subject toruses[] = {
		{ "tri_1k", "torus:16", false, { 0, 0 } },
		{ "tri_16k", "torus:64", false, { 0, 0 } },
		{ "tri_262k", "torus:256", false, { 0, 0 } },
		{ "tri_1m", "torus:512", false, { 0, 0 } },
	};
	static const int sizes[][2] = {
		{ 320, 240 }, { 640, 480 }, { 1280, 720 }, { 1920, 1080 }, { 2048, 2048 },
	};

	for (size_t i = 0; i < sizeof(toruses) / sizeof(*toruses); i++)
		bench_growth(&toruses[i], 1280, 720, "mtri_s");
	for (size_t i = 0; i < sizeof(sizes) / sizeof(*sizes); i++) {
		struct subject sphere = subject_sphere3;
		char name[32];

		snprintf(name, sizeof(name), "%dx%d", sizes[i][0], sizes[i][1]);
		sphere.name = name;
		bench_growth(&sphere, sizes[i][0], sizes[i][1], "mpix_s");
	}
}

int main(int argc, char **argv)
{
	static const int cells[][2] = { { 2, 1 }, { 2, 2 },   { 4, 4 },
					{ 8, 8 }, { 16, 16 }, { 32, 32 } };

	short_form = argc > 1 && !strcmp(argv[1], "--short");
	for (size_t i = 0; i < sizeof(cells) / sizeof(*cells); i++)
		bench_rate(cells[i][0], cells[i][1]);
	bench_growths();
	return 0;
}
