// SPDX-License-Identifier: MIT
/* Evaluators: maps, grids, meshes, and the vertices that they make. */
#include "gl_scene.h"

#include <string.h>

/* A parabola over the square from 0 to 8, and a plane. */
static const GLfloat curve[3][3] = { { 0, 0, 0 }, { 4, 16, 0 }, { 8, 0, 0 } };
static const GLfloat plane[2][2][3] = { { { 0, 0, 0 }, { 0, 8, 0 } },
					{ { 8, 0, 0 }, { 8, 8, 0 } } };

static void map_plane(void)
{
	glMap2f(GL_MAP2_VERTEX_3, 0, 1, 6, 2, 0, 1, 3, 2, plane[0][0]);
	glEnable(GL_MAP2_VERTEX_3);
}

static void a_map_is_kept_as_it_was_given(void **state)
{
	static const GLdouble colours[2][5] = { { 1, 0, 0, 1, 9 }, { 0, 1, 0, 1, 9 } };
	GLfloat points[9], domain[2];
	GLdouble colour[8];
	GLint order;

	(void)state;
	glMap1f(GL_MAP1_VERTEX_3, -1, 3, 3, 3, curve[0]);
	glGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, points);
	assert_memory_equal(points, curve, sizeof(curve));
	glGetMapfv(GL_MAP1_VERTEX_3, GL_DOMAIN, domain);
	assert_float_equal(domain[0], -1, 0);
	glGetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, &order);
	assert_int_equal(order, 3);
	glMap1d(GL_MAP1_COLOR_4, 0, 1, 5, 2, colours[0]);
	glGetMapdv(GL_MAP1_COLOR_4, GL_COEFF, colour);
	assert_float_equal(colour[5], 1, 0);
	assert_float_equal(colour[7], 1, 0);
	glMap1f(GL_MAP1_VERTEX_3, 0, 0, 3, 3, curve[0]);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMap1f(GL_MAP1_VERTEX_3, 0, 1, 2, 3, curve[0]);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 9, curve[0]);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMap1f(GL_MAP2_VERTEX_3, 0, 1, 3, 3, curve[0]);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glActiveTexture(GL_TEXTURE1);
	glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 3, curve[0]);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
}

/* At a half a parabola is a half of its middle point up. */
static void a_curve_is_drawn_by_its_coordinate(void **state)
{
	(void)state;
	glMap1f(GL_MAP1_VERTEX_3, 2, 4, 3, 3, curve[0]);
	glEnable(GL_MAP1_VERTEX_3);
	glTranslatef(0.5f, 0.5f, 0);
	glBegin(GL_POINTS);
	glEvalCoord1f(2);
	glEvalCoord1d(3);
	glEnd();
	assert_int_equal(gl_pixel(0, 0), WHITE);
	assert_int_equal(gl_pixel(4, 8), WHITE);
	assert_int_equal(gl_pixel(4, 0), BLACK);
	glTranslatef(20, 0, 0);
	glMapGrid1f(4, 2, 4);
	glEvalMesh1(GL_POINT, 2, 4);
	assert_int_equal(gl_pixel(24, 8), WHITE);
	assert_int_equal(gl_pixel(28, 0), WHITE);
	assert_int_equal(gl_pixel(20, 0), BLACK);
	glEvalMesh1(GL_FILL, 0, 4);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void a_mesh_is_filled(void **state)
{
	(void)state;
	map_plane();
	glMapGrid2f(4, 0, 1, 2, 0, 1);
	glEvalMesh2(GL_FILL, 0, 4, 0, 2);
	assert_int_equal(gl_pixel(0, 0), WHITE);
	assert_int_equal(gl_pixel(7, 7), WHITE);
	assert_int_equal(gl_pixel(8, 7), BLACK);
	gl_clear(BLACK);
	glEvalMesh2(GL_FILL, 1, 2, 0, 1);
	assert_int_equal(gl_pixel(1, 1), BLACK);
	assert_int_equal(gl_pixel(3, 3), WHITE);
	assert_int_equal(gl_pixel(3, 5), BLACK);
	gl_clear(BLACK);
	glTranslatef(0.5f, 0.5f, 0);
	glEvalMesh2(GL_POINT, 1, 1, 1, 1);
	assert_int_equal(gl_pixel(2, 4), WHITE);
	glEvalMesh2(GL_LINE, 0, 4, 0, 2);
	assert_int_equal(gl_pixel(5, 4), WHITE);
	assert_int_equal(gl_pixel(5, 5), BLACK);
	glEvalMesh2(GL_POINT, -0x7fffffff, 0x7fffffff, 0, 0);
	assert_int_equal(glGetError(), GL_OUT_OF_MEMORY);
}

static void current_values_stay_as_they_are(void **state)
{
	static const GLfloat red[1][4] = { { 1, 0, 0, 1 } };
	GLfloat colour[4];

	(void)state;
	map_plane();
	glMap2f(GL_MAP2_COLOR_4, 0, 1, 4, 1, 0, 1, 4, 1, red[0]);
	glEnable(GL_MAP2_COLOR_4);
	glColor3f(0, 1, 0);
	glEvalMesh2(GL_FILL, 0, 1, 0, 1);
	assert_int_equal(gl_pixel(4, 4), RED);
	glGetFloatv(GL_CURRENT_COLOR, colour);
	assert_float_equal(colour[1], 1, 0);
	/* Without a map of vertices there are none. */
	glDisable(GL_MAP2_VERTEX_3);
	gl_clear(BLACK);
	glEvalMesh2(GL_FILL, 0, 1, 0, 1);
	assert_int_equal(gl_pixel(4, 4), BLACK);
}

/* The normal of the plane is the z axis, whatever the current one and the map of normals say. */
static void normals_are_made_of_the_surface(void **state)
{
	static const GLfloat light[4] = { 0, 0, 1, 0 }, black[4] = { 0, 0, 0, 1 };
	static const GLfloat white[4] = { 1, 1, 1, 1 };

	(void)state;
	map_plane();
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, light);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, white);
	glNormal3f(1, 0, 0);
	glEvalMesh2(GL_FILL, 0, 1, 0, 1);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	glEnable(GL_AUTO_NORMAL);
	glEvalMesh2(GL_FILL, 0, 1, 0, 1);
	assert_int_equal(gl_pixel(4, 4), WHITE);
}

static void a_list_evaluates_with_the_maps_of_then(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	glBegin(GL_QUADS);
	glEvalCoord2f(0, 0);
	glEvalCoord2f(1, 0);
	glEvalPoint2(1, 1);
	glEvalPoint2(0, 1);
	glEnd();
	glEndList();
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	map_plane();
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4), WHITE);
}

static void the_bit_of_evaluators_saves_them(void **state)
{
	GLint segments[2];

	(void)state;
	glMapGrid2f(3, 0, 1, 5, 0, 1);
	glPushAttrib(GL_EVAL_BIT);
	glMapGrid2f(7, 0, 1, 7, 0, 1);
	map_plane();
	glEnable(GL_AUTO_NORMAL);
	glPopAttrib();
	glGetIntegerv(GL_MAP2_GRID_SEGMENTS, segments);
	assert_int_equal(segments[0], 3);
	assert_int_equal(segments[1], 5);
	assert_false(glIsEnabled(GL_MAP2_VERTEX_3));
	assert_false(glIsEnabled(GL_AUTO_NORMAL));
}

/* ---- occlusion queries, of which there is no counter ---- */

static void queries_count_nothing_and_say_so(void **state)
{
	GLuint name[2], value = 7;
	GLint bits = -1;

	(void)state;
	glGetQueryiv(GL_SAMPLES_PASSED, GL_QUERY_COUNTER_BITS, &bits);
	assert_int_equal(bits, 0);
	glGenQueries(2, name);
	assert_false(glIsQuery(name[0]));
	glBeginQuery(GL_SAMPLES_PASSED, name[0]);
	assert_true(glIsQuery(name[0]));
	glGetQueryiv(GL_SAMPLES_PASSED, GL_CURRENT_QUERY, &bits);
	assert_int_equal(bits, (GLint)name[0]);
	glBeginQuery(GL_SAMPLES_PASSED, name[1]);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glGetQueryObjectuiv(name[0], GL_QUERY_RESULT, &value);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	square(0, 0);
	glEndQuery(GL_SAMPLES_PASSED);
	glGetQueryObjectuiv(name[0], GL_QUERY_RESULT_AVAILABLE, &value);
	assert_int_equal(value, GL_TRUE);
	glGetQueryObjectuiv(name[0], GL_QUERY_RESULT, &value);
	assert_int_equal(value, 0);
	glEndQuery(GL_SAMPLES_PASSED);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glDeleteQueries(2, name);
	assert_false(glIsQuery(name[0]));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_map_is_kept_as_it_was_given),
		TEST(a_curve_is_drawn_by_its_coordinate),
		TEST(a_mesh_is_filled),
		TEST(current_values_stay_as_they_are),
		TEST(normals_are_made_of_the_surface),
		TEST(a_list_evaluates_with_the_maps_of_then),
		TEST(the_bit_of_evaluators_saves_them),
		TEST(queries_count_nothing_and_say_so),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
