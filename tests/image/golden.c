// SPDX-License-Identifier: MIT
/*
 * golden [--write] DEVICE DIRECTORY [OUTPUT]
 *
 * Draws small scenes, each showing one thing, and compares every byte with DIRECTORY/NAME.png; a
 * picture that differs is left in OUTPUT. With --write it makes the files instead.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/matrix.h"
#include "scene/mesh.h"
#include "scene/picture.h"
#include "scene/scene.h"

#define WIDTH 100
#define HEIGHT 76
#define AWAY 4

/* What a scene draws with; its function changes what it is about, and draws. */
struct stage {
	struct scene scene;
	struct accel_state *state;
	struct accel_draw *draw;
	struct accel_target *target;
};

static void die(const char *what, const char *where)
{
	fprintf(stderr, "golden: %s: %s\n", what, where);
	exit(1);
}

static void need(int ret, const char *what)
{
	if (ret)
		die(what, strerror(-ret));
}

/* The stage as each scene finds it: a warm light, shiny red plastic, a grey ground. */
static void set_stage(struct stage *stage)
{
	struct scene *scene = &stage->scene;

	scene_init(scene, WIDTH, HEIGHT);
	matrix_perspective(scene->projection, 30, (float)WIDTH / HEIGHT, AWAY - 1.5f, AWAY + 1.5f);
	matrix_translate(scene->modelview, 0, 0, -AWAY);
	matrix_rotate_x(scene->modelview, 25);
	matrix_rotate_y(scene->modelview, 35);
	scene->light[0] = scene_light_direction(-0.5f, 0.6f, 0.8f);
	scene->light[0].diffuse[2] = 0.8f;
	scene->material[0] = scene_material_grey(0.1f, 0.6f, 0.5f, 40);
	scene->material[0].diffuse[1] = scene->material[0].diffuse[2] = 0.15f;
	scene->material[1] = scene->material[0];
	for (int i = 0; i < 3; i++)
		scene->background[i] = 0.2f;
}

/* Draws @shape on top of what is there, with the state as it is. */
static void draw_shape(struct stage *stage, const char *shape)
{
	struct accel_mesh lent;
	struct mesh mesh;

	need(mesh_shape(shape, &mesh), shape);
	lent = mesh_lend(&mesh);
	need(accel_draw_mesh(stage->draw, stage->state, &lent), "accel_draw_mesh");
	mesh_free(&mesh);
}

static void draw(struct stage *stage, const char *shape, enum accel_shading shading)
{
	need(scene_apply(&stage->scene, stage->state), "scene_apply");
	accel_state_set_shading(stage->state, shading);
	draw_shape(stage, shape);
}

/* ---- the scenes ---- */

static void gouraud(struct stage *stage)
{
	draw(stage, "sphere:1", ACCEL_SHADING_GOURAUD);
}

static void flat(struct stage *stage)
{
	draw(stage, "sphere:1", ACCEL_SHADING_FLAT);
}

static void quadratic(struct stage *stage)
{
	draw(stage, "sphere:1", ACCEL_SHADING_QUADRATIC);
}

static void adaptive(struct stage *stage)
{
	draw(stage, "sphere:1", ACCEL_SHADING_ADAPTIVE);
}

static void parallel(struct stage *stage)
{
	stage->scene.local_viewer = false;
	matrix_orthographic(stage->scene.projection, 1.1f, (float)WIDTH / HEIGHT, AWAY - 1.5f,
			    AWAY + 1.5f);
	draw(stage, "torus:12", ACCEL_SHADING_ADAPTIVE);
}

static void two_lamps(struct stage *stage)
{
	struct accel_light *light = stage->scene.light;

	light[0] = scene_light_point(-1.5f, 1, 1 - AWAY);
	light[0].diffuse[0] = light[0].specular[0] = 0.2f;
	light[0].attenuation[2] = 0.1f;
	light[3] = scene_light_point(1.2f, -0.2f, 1.2f - AWAY);
	light[3].diffuse[1] = light[3].diffuse[2] = 0.3f;
	light[3].attenuation[1] = 0.3f;
	stage->scene.material[0] = scene_material_grey(0.05f, 0.7f, 0.6f, 25);
	draw(stage, "torus:16", ACCEL_SHADING_ADAPTIVE);
}

static void spot(struct stage *stage)
{
	struct accel_light *light = &stage->scene.light[0];

	*light = scene_light_point(0.3f, 0.4f, 1.2f - AWAY);
	light->spot_direction[0] = -0.2f;
	light->spot_cutoff = 25;
	light->spot_exponent = 12;
	draw(stage, "plane:12", ACCEL_SHADING_ADAPTIVE);
}

static void glow(struct stage *stage)
{
	stage->scene.material[0].emission[2] = 0.4f;
	stage->scene.material[0].ambient[1] = 0.5f;
	draw(stage, "cube", ACCEL_SHADING_ADAPTIVE);
}

static void back_side(struct stage *stage)
{
	stage->scene.two_sided = true;
	stage->scene.cull = ACCEL_CULL_NONE;
	stage->scene.material[1] = scene_material_grey(0.1f, 0.3f, 0.6f, 60);
	matrix_rotate_y(stage->scene.modelview, 120);
	draw(stage, "plane:6", ACCEL_SHADING_ADAPTIVE);
}

static void inside(struct stage *stage)
{
	stage->scene.cull = ACCEL_CULL_FRONT;
	stage->scene.light[0] = scene_light_direction(0.3f, 0.3f, -1);
	draw(stage, "sphere:2", ACCEL_SHADING_GOURAUD);
}

/* The near plane cuts the sphere open. */
static void near_plane(struct stage *stage)
{
	stage->scene.two_sided = true;
	stage->scene.cull = ACCEL_CULL_NONE;
	stage->scene.material[1] = scene_material_grey(0.1f, 0.6f, 0.5f, 20);
	matrix_perspective(stage->scene.projection, 30, (float)WIDTH / HEIGHT, AWAY - 0.6f,
			   AWAY + 1.5f);
	draw(stage, "sphere:2", ACCEL_SHADING_ADAPTIVE);
}

static void viewport_scissor(struct stage *stage)
{
	accel_state_set_viewport(stage->state, -20, 10, 90, 60);
	accel_state_set_scissor(stage->state, 11, 17, 45, 33);
	draw(stage, "cube", ACCEL_SHADING_GOURAUD);
}

static void colour_mask(struct stage *stage)
{
	accel_state_set_colour_mask(stage->state, true, false, true, true);
	stage->scene.material[0] = scene_material_grey(0.1f, 0.8f, 0.1f, 10);
	draw(stage, "sphere:2", ACCEL_SHADING_ADAPTIVE);
}

/* Three shapes through each other; the last, a sphere, is seen where others hide it. */
static void depth(struct stage *stage)
{
	draw(stage, "cube", ACCEL_SHADING_ADAPTIVE);
	stage->scene.material[0] = scene_material_grey(0.1f, 0.6f, 0.5f, 30);
	draw(stage, "torus:12", ACCEL_SHADING_ADAPTIVE);
	stage->scene.material[0].diffuse[0] = 0;
	matrix_scale(stage->scene.modelview, 0.6f);
	need(scene_apply(&stage->scene, stage->state), "scene_apply");
	accel_state_set_depth(stage->state, ACCEL_COMPARE_GREATER, false);
	accel_state_set_depth_range(stage->state, 0.05f, 0.95f);
	draw_shape(stage, "sphere:2");
}

/* Colours of vertices without lighting, as a strip beside a fan. */
static void strip_and_fan(struct stage *stage)
{
	static const float position[7][3] = {
		{ -0.9f, -0.8f, 0 }, { -0.9f, 0.8f, 0 }, { -0.5f, -0.6f, 0 }, { -0.4f, 0.7f, 0 },
		{ 0, -0.8f, 0 },     { 0.1f, 0.6f, 0 },  { 0.9f, 0.1f, 0 },
	};
	static const float colour[7][4] = {
		{ 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 },    { 1, 1, 0, 1 },
		{ 1, 0, 1, 1 }, { 0, 1, 1, 1 }, { 1, 1, 1, 0.5f },
	};
	static const uint32_t fan[] = { 4, 6, 5, 3 };
	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP,
					    .vertices = 7, .position = { .data = position },
					    .colour = { .data = colour });

	mesh.vertices = 4;
	need(accel_draw_mesh(stage->draw, stage->state, &mesh), "strip");
	mesh.topology = ACCEL_TOPOLOGY_TRIANGLE_FAN;
	mesh.vertices = 7;
	mesh.indices = 4;
	mesh.index = fan;
	need(accel_draw_mesh(stage->draw, stage->state, &mesh), "fan");
}

static const struct {
	const char *name;
	void (*draw)(struct stage *stage);
} scenes[] = {
	{ "gouraud", gouraud },
	{ "flat", flat },
	{ "quadratic", quadratic },
	{ "adaptive", adaptive },
	{ "parallel", parallel },
	{ "two-lamps", two_lamps },
	{ "spot", spot },
	{ "glow", glow },
	{ "back-side", back_side },
	{ "inside", inside },
	{ "near-plane", near_plane },
	{ "viewport-scissor", viewport_scissor },
	{ "colour-mask", colour_mask },
	{ "depth", depth },
	{ "strip-and-fan", strip_and_fan },
};

enum { SCENES = sizeof(scenes) / sizeof(*scenes) };

static void render(struct stage *stage, int number, struct picture *picture)
{
	struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH,
					       .depth = 1);

	need(accel_state_new(&stage->state), "accel_state_new");
	set_stage(stage);
	memcpy(clear.rgba, stage->scene.background, sizeof(clear.rgba));
	need(accel_draw_begin(stage->draw, stage->target, &clear), "accel_draw_begin");
	scenes[number].draw(stage);
	need(accel_draw_finish(stage->draw), "accel_draw_finish");
	need(accel_target_read(stage->target, ACCEL_PLANE_COLOUR, NULL, picture->pixel,
			       WIDTH * sizeof(uint32_t)),
	     "accel_target_read");
	accel_state_free(stage->state);
}

/* The files do not have alpha. */
static bool same(const struct picture *picture, const struct picture *golden, const char *name)
{
	if (golden->width != WIDTH || golden->height != HEIGHT) {
		printf("%s: the file is %dx%d\n", name, golden->width, golden->height);
		return false;
	}
	for (int i = 0; i < WIDTH * HEIGHT; i++) {
		uint32_t drawn = picture->pixel[i] & 0xffffff, wanted = golden->pixel[i] & 0xffffff;

		if (drawn != wanted) {
			printf("%s: at %d,%d drawn %06x, wanted %06x (blue green red)\n", name,
			       i % WIDTH, i / WIDTH, drawn, wanted);
			return false;
		}
	}
	return true;
}

static bool check(const struct picture *picture, const char *name, const char *path,
		  const char *output)
{
	struct picture golden;
	char left[512];
	bool good;

	need(picture_read(&golden, path), path);
	good = same(picture, &golden, name);
	picture_free(&golden);
	if (!good && output) {
		snprintf(left, sizeof(left), "%s/%s.png", output, name);
		need(picture_write(picture, left), left);
		printf("%s: see %s and %s\n", name, left, path);
	}
	return good;
}

int main(int argc, char **argv)
{
	bool write = argc > 1 && !strcmp(argv[1], "--write");
	char **operand = argv + 1 + write;
	struct accel_device *device;
	struct picture picture;
	struct stage stage;
	int different = 0;

	if (argc - write < 3)
		die("usage", "golden [--write] DEVICE DIRECTORY [OUTPUT]");
	need(accel_device_new(operand[0], NULL, NULL, &device), operand[0]);
	need(accel_target_new(device, WIDTH, HEIGHT, &stage.target), "accel_target_new");
	need(accel_draw_new(device, &stage.draw), "accel_draw_new");
	need(picture_new(WIDTH, HEIGHT, &picture), "picture_new");
	for (int i = 0; i < SCENES; i++) {
		char path[512];

		snprintf(path, sizeof(path), "%s/%s.png", operand[1], scenes[i].name);
		render(&stage, i, &picture);
		if (write)
			need(picture_write(&picture, path), path);
		else if (!check(&picture, scenes[i].name, path, operand[2]))
			different++;
	}
	picture_free(&picture);
	accel_draw_free(stage.draw);
	accel_target_free(stage.target);
	accel_device_free(device);
	if (!write)
		printf("%d of %d pictures are as before on %s\n", SCENES - different, SCENES,
		       operand[0]);
	return different > 0;
}
