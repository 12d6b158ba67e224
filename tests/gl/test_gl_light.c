// SPDX-License-Identifier: MIT
/* Light as programs see it: materials, sides, normals. */
#include "gl_scene.h"

static const GLfloat red[4] = { 1, 0, 0, 1 }, green[4] = { 0, 1, 0, 1 };
static const GLfloat black[4] = { 0, 0, 0, 1 }, white[4] = { 1, 1, 1, 1 };

/* A light from the eye, of which surfaces have what is diffuse alone. */
static void light_begin(const GLfloat diffuse[4])
{
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, black);
	glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, diffuse);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
}

static void materials_change_between_begin_and_end(void **state)
{
	(void)state;
	glEnable(GL_LIGHTING);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, red);
	glBegin(GL_QUADS);
	square_corners(0, 0);
	glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, green);
	square_corners(16, 0);
	glEnd();
	assert_int_equal(gl_pixel(4, 4), RED);
	assert_int_equal(gl_pixel(20, 4), GREEN);
}

static void a_light_shines(void **state)
{
	static const GLfloat toward[4] = { 0, 0, 1, 0 }, away[4] = { 0, 0, -1, 0 };

	(void)state;
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, white);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, toward);
	square(0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, away);
	square(16, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), BLACK);
}

/* Counter-clockwise and clockwise; the normal of what faces away is turned round. */
static void two_sides_have_materials_of_their_own(void **state)
{
	(void)state;
	light_begin(white);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, green);
	glMaterialfv(GL_BACK, GL_DIFFUSE, red);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	square(0, 0);
	glFrontFace(GL_CW);
	glNormal3f(0, 0, -1);
	square(16, 0);
	glNormal3f(0, 0, 1);
	square(32, 0);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 0);
	square(48, 0);
	assert_int_equal(gl_pixel(4, 4), GREEN);
	assert_int_equal(gl_pixel(20, 4), RED);
	assert_int_equal(gl_pixel(36, 4), BLACK);
	assert_int_equal(gl_pixel(52, 4), GREEN);
}

static void the_material_is_the_colour(void **state)
{
	(void)state;
	light_begin(white);
	glColor3f(0, 0, 1);
	glColorMaterial(GL_FRONT, GL_DIFFUSE);
	glEnable(GL_COLOR_MATERIAL);
	square(0, 0);
	glBegin(GL_QUADS);
	glColor3f(0, 1, 0);
	square_corners(16, 0);
	glColor3f(1, 0, 0);
	square_corners(32, 0);
	glEnd();
	glDisable(GL_COLOR_MATERIAL);
	glColor3f(0, 1, 0);
	square(48, 0);
	assert_int_equal(gl_pixel(4, 4), BLUE);
	assert_int_equal(gl_pixel(20, 4), GREEN);
	assert_int_equal(gl_pixel(36, 4), RED);
	assert_int_equal(gl_pixel(52, 4), RED);
}

/* Neither that of lights nor that of what is ambient counts. */
static void alpha_is_that_of_what_is_diffuse(void **state)
{
	static const GLfloat half[4] = { 0, 1, 0, 0.5f };

	(void)state;
	light_begin(half);
	square(0, 0);
	assert_int_equal(gl_pixel(4, 4), 0x8000ff00);
}

static void normals_are_made_as_long_as_the_state_says(void **state)
{
	(void)state;
	light_begin(white);
	glNormal3f(0, 0, 1);
	glScalef(2, 2, 2);
	square(0, 0);
	glEnable(GL_NORMALIZE);
	square(10, 0);
	glNormal3f(0, 0, 0.0625f);
	square(20, 0);
	glDisable(GL_NORMALIZE);
	glNormal3f(0, 0, 1);
	glEnable(GL_RESCALE_NORMAL);
	square(0, 20);
	assert_int_equal(gl_pixel(4, 4) & 255, 128);
	assert_int_equal(gl_pixel(24, 4), WHITE);
	assert_int_equal(gl_pixel(44, 4), WHITE);
	assert_int_equal(gl_pixel(4, 44), WHITE);
}

/* By the inverse of the matrix, not by the matrix. */
static void normals_stay_at_right_angles(void **state)
{
	(void)state;
	light_begin(white);
	glEnable(GL_NORMALIZE);
	glScalef(1, 1, 0.5f);
	glNormal3f(1, 0, 0.5f);
	square(0, 0);
	/* (1, 0, 0.5) becomes (1, 0, 1). */
	assert_int_equal(gl_pixel(4, 4) & 255, 180);
}

static void a_normal_of_no_length_has_no_light(void **state)
{
	(void)state;
	light_begin(white);
	glMaterialfv(GL_FRONT, GL_EMISSION, green);
	glNormal3f(0, 0, 0);
	square(0, 0);
	glEnable(GL_NORMALIZE);
	square(16, 0);
	assert_int_equal(gl_pixel(4, 4), GREEN);
	assert_int_equal(gl_pixel(20, 4), GREEN);
}

static void a_light_stays_where_it_was_put(void **state)
{
	static const GLfloat place[4] = { 32, 4, 10, 1 }, down[3] = { 0, 0, -1 };

	(void)state;
	light_begin(white);
	glTranslatef(-16, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, place);
	glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, down);
	glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 45);
	glLoadIdentity();
	square(12, 0);
	square(32, 0);
	assert_int_equal(gl_pixel(16, 4) >> 24, 255);
	assert_true((gl_pixel(16, 4) & 255) > 150);
	assert_int_equal(gl_pixel(36, 4), BLACK);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(materials_change_between_begin_and_end),
		TEST(a_light_shines),
		TEST(two_sides_have_materials_of_their_own),
		TEST(the_material_is_the_colour),
		TEST(alpha_is_that_of_what_is_diffuse),
		TEST(normals_are_made_as_long_as_the_state_says),
		TEST(normals_stay_at_right_angles),
		TEST(a_normal_of_no_length_has_no_light),
		TEST(a_light_stays_where_it_was_put),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
