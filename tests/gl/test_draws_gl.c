// SPDX-License-Identifier: MIT
/*
 * Scenes with a name, drawn with Gouraud shading by the library on the model as the oracle has them:
 * same pixels, colours within a step of 255. Boxes in them are in NDC, where w is 1.
 */
#include <math.h>

#include "scene.h"

#define STEP 1.0

/* A colour that is a plane's over x and y: however a quadrilateral is made of triangles, it is the
 * same inside. */
static void paint(struct oracle_vertex *vertex)
{
	vertex->colour[0] = (double)(float)(0.5 + 0.5 * vertex->position[0]);
	vertex->colour[1] = (double)(float)(0.5 - 0.25 * vertex->position[1]);
	vertex->colour[2] = (double)(float)(0.5 + 0.25 * vertex->position[0] -
					    0.25 * vertex->position[1]);
	vertex->colour[3] = (double)(float)(0.75 + 0.125 * vertex->position[0]);
}

/* Colours that tell all vertices apart. */
static void paint_number(struct oracle_vertex *vertex, int number)
{
	vertex->colour[0] = (number & 1) != 0;
	vertex->colour[1] = (number >> 1 & 1) != 0;
	vertex->colour[2] = (number >> 2 & 1) != 0;
	vertex->colour[3] = (double)(float)(0.3 + 0.05 * number);
}

static double depth_of(double x, double y)
{
	return (double)(float)(0.3 * x - 0.2 * y);
}

/* Around in a circle, as much as a fan or polygon of @corners has. */
static void round_vertices(struct scene *scene, int corners, bool middle)
{
	if (middle)
		scene_vertex(scene, 0.0625, 0.03125, depth_of(0.0625, 0.03125));
	for (int i = 0; i < corners; i++) {
		double x = (double)(float)(0.8 * cos(0.3 + 6.2831853 * i / corners));
		double y = (double)(float)(0.7 * sin(0.3 + 6.2831853 * i / corners));

		scene_vertex(scene, x, y, depth_of(x, y));
	}
}

/* Zigzag from left to right, as strips go. */
static void strip_vertices(struct scene *scene, int vertices)
{
	for (int i = 0; i < vertices; i++) {
		double x = -0.87 + 0.21 * i + 0.013 * (i % 2);
		double y = (i % 2 ? 0.61 : -0.57) + 0.02 * i;

		scene_vertex(scene, (double)(float)x, (double)(float)y, depth_of(x, y));
	}
}

/* Two quadrilaterals of their own. */
static void quad_vertices(struct scene *scene)
{
	static const double corner[8][2] = { { -0.9, -0.6 }, { -0.1, -0.7 }, { -0.2, 0.5 },
					     { -0.8, 0.6 },  { 0.1, 0.8 },   { 0.7, 0.6 },
					     { 0.9, -0.5 },  { 0.15, -0.3 } };

	for (int i = 0; i < 8; i++)
		scene_vertex(scene, (double)(float)corner[i][0], (double)(float)corner[i][1],
			     depth_of(corner[i][0], corner[i][1]));
}

static void topology_vertices(struct scene *scene)
{
	if (scene->topology == ORACLE_QUADS)
		quad_vertices(scene);
	else if (scene->topology == ORACLE_TRIANGLE_FAN)
		round_vertices(scene, 7, true);
	else if (scene->topology == ORACLE_ONE_POLYGON)
		round_vertices(scene, 7, false);
	else
		strip_vertices(scene, scene->topology == ORACLE_TRIANGLES ? 6 : 8);
}

/* Smooth, then flat: which vertex colours each primitive, and all that are cut by the near plane. */
static void draw_topology(struct board *board, enum oracle_topology topology)
{
	struct scene scene;

	scene_init(&scene, topology);
	topology_vertices(&scene);
	for (int i = 0; i < scene.vertices; i++)
		paint(&scene.vertex[i]);
	scene_assert(board, &scene, STEP, 1000);
	scene.gl.flat = true;
	for (int i = 0; i < scene.vertices; i++)
		paint_number(&scene.vertex[i], i);
	scene_assert(board, &scene, STEP, 1000);
	/* Of x = 0.3 and more nothing is left. */
	scene.gl.projection[2] = (double)-1.5f;
	scene.gl.projection[14] = -0.5;
	scene_assert(board, &scene, STEP, 500);
}

static void triangles_are_drawn_and_flat_by_their_last_vertex(void **state)
{
	draw_topology(*state, ORACLE_TRIANGLES);
}

static void triangle_strips_are_drawn_and_flat_by_each_new_vertex(void **state)
{
	draw_topology(*state, ORACLE_TRIANGLE_STRIP);
}

static void triangle_fans_are_drawn_and_flat_by_each_new_vertex(void **state)
{
	draw_topology(*state, ORACLE_TRIANGLE_FAN);
}

static void quads_are_drawn_and_flat_by_their_fourth_vertex(void **state)
{
	draw_topology(*state, ORACLE_QUADS);
}

static void quad_strips_are_drawn_and_flat_by_the_last_of_each_pair(void **state)
{
	draw_topology(*state, ORACLE_QUAD_STRIP);
}

static void polygons_are_drawn_and_flat_by_their_first_vertex(void **state)
{
	draw_topology(*state, ORACLE_ONE_POLYGON);
}

/* One triangle whose vertices are lit so differently that two are brighter than 1. */
static void lit_triangle(struct scene *scene)
{
	static const double normal[3][3] = { { 0, 0, 1 }, { 0, 0.6, 0.8 }, { 0.8, 0, 0.6 } };

	scene_init(scene, ORACLE_TRIANGLES);
	scene_vertex(scene, -0.9, -0.8, -0.75);
	scene_vertex(scene, 0.875, -0.5, 0.5);
	scene_vertex(scene, 0.25, 0.875, 0.25);
	for (int i = 0; i < 3; i++) {
		struct oracle_vertex *vertex = &scene->vertex[i];

		for (int j = 0; j < 4; j++)
			vertex->position[j] = (double)(float)vertex->position[j];
		for (int j = 0; j < 3; j++)
			vertex->normal[j] = (double)(float)normal[i][j];
	}
	scene->gl.lighting = true;
	scene->gl.light[0].enabled = true;
	scene->gl.light[0].diffuse[0] = 4;
	scene->gl.light[0].diffuse[1] = 0.75;
	scene->gl.light[0].position[0] = -0.5;
}

/* 2.14.6: limited at the vertices, and not where they are interpolated. */
static void colours_are_limited_before_they_are_interpolated(void **state)
{
	struct scene scene;

	lit_triangle(&scene);
	scene_assert(*state, &scene, STEP, 1000);
}

/* 2.14.8: a new corner has the mean of the ends of its edge, and is not lit itself. */
static void colours_of_cut_corners_are_those_of_their_edges(void **state)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.material[0].specular[2] = 1;
	scene.gl.material[0].shininess = 40;
	scene.gl.local_viewer = true;
	/* Eye z from 0.375 on is in front of the near plane. */
	scene.gl.projection[10] = 2;
	scene.gl.projection[14] = -0.25;
	scene_assert(*state, &scene, STEP, 500);
}

/* The vertex behind the near plane is brighter than 1: the corners between take its limited colour. */
static void colours_are_limited_before_they_are_cut(void **state)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.light[0].diffuse[0] = 10;
	scene.gl.projection[10] = 1;
	scene.gl.projection[14] = -0.5;
	scene_assert(*state, &scene, STEP, 500);
}

/* Of a strip those triangles that have the vertex, and none of the others. */
static void what_is_not_finite_drops_its_primitive_alone(void **state)
{
	static const double values[] = { (double)NAN, (double)INFINITY, -(double)INFINITY };
	struct scene scene;

	for (int topology = ORACLE_TRIANGLES; topology <= ORACLE_ONE_POLYGON; topology++)
		for (int i = 0; i < 12; i++) {
			scene_init(&scene, (enum oracle_topology)topology);
			topology_vertices(&scene);
			scene.gl.flat = true;
			for (int j = 0; j < scene.vertices; j++)
				paint_number(&scene.vertex[j], j);
			scene.vertex[5].position[i % 4] = values[i / 4];
			scene_assert(*state, &scene, STEP,
				     topology == ORACLE_ONE_POLYGON ? 0 : 100);
		}
}

/* 2.14.1: the back of a polygon has its material and the normal reversed. */
static void backs_are_lit_with_their_material_from_behind(void **state)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.two_sided = true;
	scene.gl.material[1].diffuse[0] = 0.125;
	scene.gl.material[1].diffuse[3] = 0.5;
	scene.gl.material[1].ambient[2] = 1;
	for (int i = 0; i < 2; i++) {
		scene_assert(*state, &scene, STEP, 1000);
		/* Seen from the other side. */
		scene.gl.projection[0] = -1;
	}
	/* The light too. */
	scene.gl.light[0].position[2] = -1;
	scene_assert(*state, &scene, STEP, 1000);
}

/* 2.10.3: by the inverse transpose, which for a squeezed z is not the matrix itself. */
static void normals_of_a_squeezed_model_are_lit_as_they_stand(void **state)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.modelview[10] = 0.25;
	scene.gl.modelview[4] = 0.125;
	scene_assert(*state, &scene, STEP, 1000);
	/* Turned inside out. */
	scene.gl.modelview[0] = -1;
	scene_assert(*state, &scene, STEP, 1000);
}

/* A model half as large, and normals neither of unit length nor of one length. */
static void draw_normals(struct board *board, enum oracle_normals normals)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.light[0].diffuse[0] = 0.75;
	scene.gl.material[0].specular[2] = 0.5;
	scene.gl.material[0].shininess = 3;
	scene.gl.normals = normals;
	scene.gl.modelview[0] = scene.gl.modelview[5] = scene.gl.modelview[10] = 0.5;
	scene.gl.projection[0] = scene.gl.projection[5] = 2;
	for (int i = 0; i < 3; i++)
		scene.vertex[0].normal[i] *= 0.5;
	for (int i = 0; i < 3; i++)
		scene.vertex[2].normal[i] *= 1.25;
	scene_assert(board, &scene, STEP, 1000);
	/* A z that is squeezed too is not rescaled: the last row of the inverse counts. */
	scene.gl.modelview[10] = 0.75;
	scene.gl.modelview[2] = 0.125;
	scene_assert(board, &scene, STEP, 1000);
}

static void normals_have_the_length_that_the_inverse_gives_them(void **state)
{
	draw_normals(*state, ORACLE_AS_GIVEN);
}

static void normals_are_rescaled_by_what_the_model_is(void **state)
{
	draw_normals(*state, ORACLE_RESCALED);
}

static void normals_are_made_unit_length(void **state)
{
	draw_normals(*state, ORACLE_NORMALISED);
}

/* Which side is lit and which is culled, for triangles of either turn. */
static void front_faces_turn_as_they_are_said_to(void **state)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.two_sided = true;
	scene.gl.material[1].ambient[1] = 1;
	scene.gl.material[1].diffuse[0] = 0;
	for (int i = 0; i < 12; i++) {
		bool seen;

		scene.gl.front_clockwise = i & 1;
		scene.gl.projection[0] = i & 2 ? -1 : 1;
		scene.gl.cull = (enum oracle_cull)(i / 4);
		seen = !scene.gl.cull ||
		       ((i & 1) == (i >> 1 & 1)) == (scene.gl.cull == ORACLE_CULL_BACK);
		scene_assert(*state, &scene, STEP, seen ? 1000 : 0);
	}
}

/* Of both sides and of either; and not limited before light is worked out: 2 times 0.25 is 0.5. */
static void draw_following(struct board *board, unsigned int mode)
{
	struct scene scene;

	lit_triangle(&scene);
	scene.gl.light[0].diffuse[0] = 0.25;
	scene.gl.light[0].specular[0] = 0.25;
	scene.gl.light[0].ambient[1] = 0.125;
	scene.gl.two_sided = true;
	scene.gl.material[0].shininess = scene.gl.material[1].shininess = 2;
	for (int i = 0; i < 3; i++) {
		paint_number(&scene.vertex[i], i + 1);
		scene.vertex[i].colour[0] = i;
	}
	for (int i = 0; i < 8; i++) {
		scene.gl.follow[0] = i & 1 ? mode : 0;
		scene.gl.follow[1] = i & 2 ? mode : 0;
		scene.gl.light[0].position[2] = i & 4 ? -1 : 1;
		scene.gl.projection[0] = i & 4 ? -1 : 1;
		scene_assert(board, &scene, STEP, 1000);
	}
}

static void colours_may_be_what_shines(void **state)
{
	draw_following(*state, ORACLE_EMISSION);
}

static void colours_may_be_the_ambient_reflectance(void **state)
{
	draw_following(*state, ORACLE_AMBIENT);
}

static void colours_may_be_the_diffuse_reflectance_and_alpha(void **state)
{
	draw_following(*state, ORACLE_DIFFUSE);
}

static void colours_may_be_the_specular_reflectance(void **state)
{
	draw_following(*state, ORACLE_SPECULAR);
}

static void colours_may_be_ambient_and_diffuse(void **state)
{
	draw_following(*state, ORACLE_AMBIENT | ORACLE_DIFFUSE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(triangles_are_drawn_and_flat_by_their_last_vertex),
		cmocka_unit_test(triangle_strips_are_drawn_and_flat_by_each_new_vertex),
		cmocka_unit_test(triangle_fans_are_drawn_and_flat_by_each_new_vertex),
		cmocka_unit_test(quads_are_drawn_and_flat_by_their_fourth_vertex),
		cmocka_unit_test(quad_strips_are_drawn_and_flat_by_the_last_of_each_pair),
		cmocka_unit_test(polygons_are_drawn_and_flat_by_their_first_vertex),
		cmocka_unit_test(colours_are_limited_before_they_are_interpolated),
		cmocka_unit_test(colours_of_cut_corners_are_those_of_their_edges),
		cmocka_unit_test(colours_are_limited_before_they_are_cut),
		cmocka_unit_test(what_is_not_finite_drops_its_primitive_alone),
		cmocka_unit_test(backs_are_lit_with_their_material_from_behind),
		cmocka_unit_test(normals_of_a_squeezed_model_are_lit_as_they_stand),
		cmocka_unit_test(normals_have_the_length_that_the_inverse_gives_them),
		cmocka_unit_test(normals_are_rescaled_by_what_the_model_is),
		cmocka_unit_test(normals_are_made_unit_length),
		cmocka_unit_test(front_faces_turn_as_they_are_said_to),
		cmocka_unit_test(colours_may_be_what_shines),
		cmocka_unit_test(colours_may_be_the_ambient_reflectance),
		cmocka_unit_test(colours_may_be_the_diffuse_reflectance_and_alpha),
		cmocka_unit_test(colours_may_be_the_specular_reflectance),
		cmocka_unit_test(colours_may_be_ambient_and_diffuse),
	};

	return cmocka_run_group_tests(tests, scene_setup, scene_teardown);
}
