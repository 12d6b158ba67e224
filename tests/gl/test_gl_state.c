// SPDX-License-Identifier: MIT
/* OpenGL's state: errors, what glGet answers, the stacks of attributes and matrices. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>

#include "gl_display.h"

static struct gl_display gl;

static int setup(void **state)
{
	(void)state;
	gl_display_open(&gl);
	gl_display_context(&gl, gl_display_pbuffer(&gl, 32, 16), EGL_NO_CONTEXT);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_true(eglTerminate(gl.display));
	assert_true(eglReleaseThread());
	return 0;
}

static void the_first_error_is_kept(void **state)
{
	(void)state;
	glEnable(GL_VENDOR);
	glClear(0xffffffff);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void an_invalid_enum_keeps_the_old_state(void **state)
{
	GLint func;

	(void)state;
	glDepthFunc(GL_GREATER);
	glDepthFunc(GL_ALPHA);
	glGetIntegerv(GL_DEPTH_FUNC, &func);
	assert_int_equal(func, GL_GREATER);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void state_does_not_change_between_begin_and_end(void **state)
{
	(void)state;
	glBegin(GL_TRIANGLES);
	glEnable(GL_FOG);
	glBegin(GL_LINES);
	glMatrixMode(GL_PROJECTION);
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glEnd();
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	assert_false(glIsEnabled(GL_FOG));
	glEnd();
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glBegin(GL_POLYGON + 1);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void values_are_converted(void **state)
{
	GLint colour[4], range[2];
	GLboolean mask[4];
	GLdouble depth;

	(void)state;
	glClearColor(1, 0, 0.5f, 2);
	glGetIntegerv(GL_COLOR_CLEAR_VALUE, colour);
	assert_int_equal(colour[0], 2147483647);
	assert_int_equal(colour[3], 2147483647);
	assert_true(colour[1] == 0 || colour[1] == -1);
	glColorMask(1, 0, 7, 0);
	glGetBooleanv(GL_COLOR_WRITEMASK, mask);
	assert_int_equal(mask[0], 1);
	assert_int_equal(mask[1], 0);
	assert_int_equal(mask[2], 1);
	glClearDepth(0.25);
	glGetDoublev(GL_DEPTH_CLEAR_VALUE, &depth);
	assert_true(depth == 0.25);
	glGetIntegerv(GL_MAX_VIEWPORT_DIMS, range);
	assert_int_equal(range[1], 2048);
}

static void the_first_surface_gives_the_viewport(void **state)
{
	GLint box[4];

	(void)state;
	glGetIntegerv(GL_VIEWPORT, box);
	assert_int_equal(box[2], 32);
	glGetIntegerv(GL_SCISSOR_BOX, box);
	assert_int_equal(box[3], 16);
}

static void the_extensions_fit_into_small_buffers(void **state)
{
	(void)state;
	assert_true(strlen((const char *)glGetString(GL_EXTENSIONS)) < 2048);
	assert_null(glGetString(GL_TEXTURE_2D));
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

/* What of each group can be asked for, with its bit; capabilities come with GL_ENABLE_BIT, too. */
static const struct {
	GLbitfield bit;
	GLenum name;
} asked[] = {
	{ GL_CURRENT_BIT, GL_CURRENT_COLOR },
	{ GL_CURRENT_BIT, GL_CURRENT_NORMAL },
	{ GL_CURRENT_BIT, GL_CURRENT_TEXTURE_COORDS },
	{ GL_CURRENT_BIT, GL_EDGE_FLAG },
	{ GL_CURRENT_BIT, GL_CURRENT_RASTER_POSITION },
	{ GL_POINT_BIT, GL_POINT_SIZE },
	{ GL_POINT_BIT | GL_ENABLE_BIT, GL_POINT_SMOOTH },
	{ GL_LINE_BIT, GL_LINE_WIDTH },
	{ GL_LINE_BIT, GL_LINE_STIPPLE_PATTERN },
	{ GL_LINE_BIT, GL_LINE_STIPPLE_REPEAT },
	{ GL_LINE_BIT | GL_ENABLE_BIT, GL_LINE_STIPPLE },
	{ GL_POLYGON_BIT, GL_CULL_FACE_MODE },
	{ GL_POLYGON_BIT, GL_FRONT_FACE },
	{ GL_POLYGON_BIT, GL_POLYGON_MODE },
	{ GL_POLYGON_BIT, GL_POLYGON_OFFSET_FACTOR },
	{ GL_POLYGON_BIT | GL_ENABLE_BIT, GL_CULL_FACE },
	{ GL_POLYGON_BIT | GL_ENABLE_BIT, GL_POLYGON_OFFSET_FILL },
	{ GL_LIGHTING_BIT, GL_SHADE_MODEL },
	{ GL_LIGHTING_BIT, GL_LIGHT_MODEL_AMBIENT },
	{ GL_LIGHTING_BIT, GL_LIGHT_MODEL_TWO_SIDE },
	{ GL_LIGHTING_BIT, GL_COLOR_MATERIAL_PARAMETER },
	{ GL_LIGHTING_BIT | GL_ENABLE_BIT, GL_LIGHTING },
	{ GL_LIGHTING_BIT | GL_ENABLE_BIT, GL_LIGHT7 },
	{ GL_FOG_BIT, GL_FOG_MODE },
	{ GL_FOG_BIT, GL_FOG_DENSITY },
	{ GL_FOG_BIT, GL_FOG_COLOR },
	{ GL_FOG_BIT | GL_ENABLE_BIT, GL_FOG },
	{ GL_DEPTH_BUFFER_BIT, GL_DEPTH_FUNC },
	{ GL_DEPTH_BUFFER_BIT, GL_DEPTH_WRITEMASK },
	{ GL_DEPTH_BUFFER_BIT, GL_DEPTH_CLEAR_VALUE },
	{ GL_DEPTH_BUFFER_BIT | GL_ENABLE_BIT, GL_DEPTH_TEST },
	{ GL_ACCUM_BUFFER_BIT, GL_ACCUM_CLEAR_VALUE },
	{ GL_STENCIL_BUFFER_BIT, GL_STENCIL_FUNC },
	{ GL_STENCIL_BUFFER_BIT, GL_STENCIL_REF },
	{ GL_STENCIL_BUFFER_BIT, GL_STENCIL_FAIL },
	{ GL_STENCIL_BUFFER_BIT | GL_ENABLE_BIT, GL_STENCIL_TEST },
	{ GL_COLOR_BUFFER_BIT, GL_ALPHA_TEST_REF },
	{ GL_COLOR_BUFFER_BIT, GL_BLEND_SRC },
	{ GL_COLOR_BUFFER_BIT, GL_BLEND_DST },
	{ GL_COLOR_BUFFER_BIT, GL_LOGIC_OP_MODE },
	{ GL_COLOR_BUFFER_BIT, GL_DRAW_BUFFER },
	{ GL_COLOR_BUFFER_BIT, GL_COLOR_WRITEMASK },
	{ GL_COLOR_BUFFER_BIT, GL_COLOR_CLEAR_VALUE },
	{ GL_COLOR_BUFFER_BIT | GL_ENABLE_BIT, GL_BLEND },
	{ GL_COLOR_BUFFER_BIT | GL_ENABLE_BIT, GL_DITHER },
	{ GL_VIEWPORT_BIT, GL_VIEWPORT },
	{ GL_VIEWPORT_BIT, GL_DEPTH_RANGE },
	{ GL_TRANSFORM_BIT, GL_MATRIX_MODE },
	{ GL_TRANSFORM_BIT | GL_ENABLE_BIT, GL_NORMALIZE },
	{ GL_TRANSFORM_BIT | GL_ENABLE_BIT, GL_CLIP_PLANE5 },
	{ GL_SCISSOR_BIT, GL_SCISSOR_BOX },
	{ GL_SCISSOR_BIT | GL_ENABLE_BIT, GL_SCISSOR_TEST },
	{ GL_HINT_BIT, GL_PERSPECTIVE_CORRECTION_HINT },
	{ GL_HINT_BIT, GL_FOG_HINT },
	{ GL_LIST_BIT, GL_LIST_BASE },
	{ GL_TEXTURE_BIT | GL_ENABLE_BIT, GL_TEXTURE_2D },
	{ GL_TEXTURE_BIT | GL_ENABLE_BIT, GL_TEXTURE_GEN_Q },
};

#define ASKED (sizeof(asked) / sizeof(asked[0]))

static int values_differ(const GLfloat *a, const GLfloat *b)
{
	return a[0] != b[0] || a[1] != b[1] || a[2] != b[2] || a[3] != b[3];
}

static void change_fragments(void)
{
	static const GLfloat colour[4] = { 0.125f, 0.25f, 0.5f, 0.75f };

	glFogi(GL_FOG_MODE, GL_LINEAR);
	glFogf(GL_FOG_DENSITY, 3);
	glFogfv(GL_FOG_COLOR, colour);
	glDepthFunc(GL_GEQUAL);
	glDepthMask(GL_FALSE);
	glClearDepth(0.5);
	glClearAccum(0.5f, 0, 0, 0);
	glStencilFunc(GL_LESS, 3, 5);
	glStencilOp(GL_INVERT, GL_ZERO, GL_INCR);
	glAlphaFunc(GL_LESS, 0.5f);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE);
	glLogicOp(GL_XOR);
	glDrawBuffer(GL_NONE);
	glColorMask(0, 0, 0, 0);
	glClearColor(0.5f, 0.5f, 0.5f, 0.5f);
}

static void change_all(void)
{
	static const GLfloat colour[4] = { 0.125f, 0.25f, 0.5f, 0.75f };

	glColor4fv(colour);
	glNormal3f(1, 2, 3);
	glTexCoord2f(5, 6);
	glEdgeFlag(GL_FALSE);
	glRasterPos2f(0.5f, 0.5f);
	glPointSize(3);
	glLineWidth(4);
	glLineStipple(7, 0x1234);
	glCullFace(GL_FRONT);
	glFrontFace(GL_CW);
	glPolygonMode(GL_BACK, GL_LINE);
	glPolygonOffset(2, 3);
	glShadeModel(GL_FLAT);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, colour);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glColorMaterial(GL_FRONT, GL_SPECULAR);
	change_fragments();
	glViewport(1, 2, 3, 4);
	glDepthRange(0.25, 0.75);
	glMatrixMode(GL_PROJECTION);
	glScissor(4, 3, 2, 1);
	glHint(GL_PERSPECTIVE_CORRECTION_HINT, GL_NICEST);
	glHint(GL_FOG_HINT, GL_FASTEST);
	glListBase(77);
	for (size_t i = 0; i < ASKED; i++)
		if (asked[i].bit & GL_ENABLE_BIT && asked[i].name == GL_DITHER)
			glDisable(asked[i].name);
		else if (asked[i].bit & GL_ENABLE_BIT)
			glEnable(asked[i].name);
}

static void get_all(GLfloat value[ASKED][4])
{
	memset(value, 0, ASKED * sizeof(*value));
	for (size_t i = 0; i < ASKED; i++)
		glGetFloatv(asked[i].name, value[i]);
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

/* old-GL layers forgot one or another member in each of its groups. */
static void each_bit_of_push_attrib_saves_its_group_alone(void **state)
{
	GLfloat before[ASKED][4], changed[ASKED][4], after[ASKED][4];

	(void)state;
	for (int bit = 0; bit < 20; bit++) {
		GLbitfield mask = 1u << bit;

		glPushAttrib(GL_ALL_ATTRIB_BITS);
		get_all(before);
		glPushAttrib(mask);
		change_all();
		get_all(changed);
		glPopAttrib();
		get_all(after);
		for (size_t i = 0; i < ASKED; i++) {
			const GLfloat *expected = asked[i].bit & mask ? before[i] : changed[i];

			if (!values_differ(before[i], changed[i]))
				fail_msg("0x%x did not change", asked[i].name);
			if (values_differ(after[i], expected))
				fail_msg("0x%x after bit 0x%x", asked[i].name, mask);
		}
		glPopAttrib();
		get_all(after);
		for (size_t i = 0; i < ASKED; i++)
			assert_false(values_differ(before[i], after[i]));
	}
}

static void lights_and_materials_are_popped(void **state)
{
	static const GLfloat red[4] = { 1, 0, 0, 1 };
	GLfloat value[4];

	(void)state;
	glPushAttrib(GL_LIGHTING_BIT);
	glLightfv(GL_LIGHT3, GL_DIFFUSE, red);
	glLightf(GL_LIGHT3, GL_SPOT_CUTOFF, 30);
	glMaterialfv(GL_BACK, GL_EMISSION, red);
	glMaterialf(GL_FRONT, GL_SHININESS, 12);
	glGetMaterialfv(GL_FRONT, GL_SHININESS, value);
	assert_true(value[0] == 12);
	glPopAttrib();
	glGetLightfv(GL_LIGHT3, GL_DIFFUSE, value);
	assert_true(value[0] == 0);
	glGetLightfv(GL_LIGHT3, GL_SPOT_CUTOFF, value);
	assert_true(value[0] == 180);
	glGetMaterialfv(GL_BACK, GL_EMISSION, value);
	assert_true(value[0] == 0);
	glGetMaterialfv(GL_FRONT, GL_SHININESS, value);
	assert_true(value[0] == 0);
}

static void the_stacks_have_ends(void **state)
{
	GLint depth;

	(void)state;
	glPopAttrib();
	assert_int_equal(glGetError(), GL_STACK_UNDERFLOW);
	for (int i = 0; i < 16; i++)
		glPushAttrib(0);
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glPushAttrib(0);
	assert_int_equal(glGetError(), GL_STACK_OVERFLOW);
	for (int i = 0; i < 16; i++)
		glPopAttrib();
	glPopMatrix();
	assert_int_equal(glGetError(), GL_STACK_UNDERFLOW);
	for (int i = 0; i < 31; i++)
		glPushMatrix();
	glGetIntegerv(GL_MODELVIEW_STACK_DEPTH, &depth);
	assert_int_equal(depth, 32);
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glPushMatrix();
	assert_int_equal(glGetError(), GL_STACK_OVERFLOW);
	glPopClientAttrib();
	assert_int_equal(glGetError(), GL_STACK_UNDERFLOW);
}

static void assert_matrix(GLenum name, const GLfloat expected[16])
{
	GLfloat matrix[16];

	glGetFloatv(name, matrix);
	for (int i = 0; i < 16; i++)
		if (!(fabsf(matrix[i] - expected[i]) < 1e-5f))
			fail_msg("element %d is %f, not %f", i, (double)matrix[i],
				 (double)expected[i]);
}

static void matrices_are_multiplied_from_the_right(void **state)
{
	static const GLfloat moved[16] = { 0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1 };
	static const GLfloat ortho[16] = { 0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, -2, -3, 0, 1 };

	(void)state;
	glTranslatef(5, 6, 7);
	glRotatef(90, 0, 0, 3);
	glScalef(2, 2, 2);
	assert_matrix(GL_MODELVIEW_MATRIX, moved);
	glMatrixMode(GL_PROJECTION);
	glOrtho(2, 6, 2, 4, -1, 1);
	assert_matrix(GL_PROJECTION_MATRIX, ortho);
	glFrustum(-1, 1, -1, 1, 0, 1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	assert_matrix(GL_PROJECTION_MATRIX, ortho);
}

static void lights_are_placed_by_the_matrix_of_then(void **state)
{
	static const GLfloat place[4] = { 1, 2, 3, 1 };
	GLfloat value[4];

	(void)state;
	glTranslatef(10, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, place);
	glLoadIdentity();
	glGetLightfv(GL_LIGHT0, GL_POSITION, value);
	assert_true(value[0] == 11);
	assert_true(value[2] == 3);
}

static void clip_planes_are_taken_to_eye_space(void **state)
{
	static const GLdouble plane[4] = { 0, 1, 0, -2 };
	GLdouble value[4];

	(void)state;
	glTranslatef(0, 3, 0);
	glScalef(2, 2, 2);
	glClipPlane(GL_CLIP_PLANE1, plane);
	glGetClipPlane(GL_CLIP_PLANE1, value);
	assert_true(fabs(value[1] - 0.5) < 1e-6);
	assert_true(fabs(value[3] + 3.5) < 1e-6);
}

static void a_material_follows_the_colour(void **state)
{
	GLfloat value[4];

	(void)state;
	glColorMaterial(GL_FRONT, GL_DIFFUSE);
	glEnable(GL_COLOR_MATERIAL);
	glColor3f(0.25f, 0, 0);
	glGetMaterialfv(GL_FRONT, GL_DIFFUSE, value);
	assert_true(value[0] == 0.25f);
	glGetMaterialfv(GL_BACK, GL_DIFFUSE, value);
	assert_true(value[0] == 0.8f);
	glColor3f(0.5f, 0, 0);
	glDisable(GL_COLOR_MATERIAL);
	glColor3f(1, 1, 1);
	glGetMaterialfv(GL_FRONT, GL_DIFFUSE, value);
	assert_true(value[0] == 0.5f);
}

static void pixel_store_is_client_state(void **state)
{
	GLint value;

	(void)state;
	glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glPixelStorei(GL_PACK_ROW_LENGTH, 9);
	glPixelStorei(GL_PACK_ALIGNMENT, 3);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glGetIntegerv(GL_UNPACK_ALIGNMENT, &value);
	assert_int_equal(value, 1);
	glPopClientAttrib();
	glGetIntegerv(GL_UNPACK_ALIGNMENT, &value);
	assert_int_equal(value, 4);
	glGetIntegerv(GL_PACK_ROW_LENGTH, &value);
	assert_int_equal(value, 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(the_first_error_is_kept),
		TEST(an_invalid_enum_keeps_the_old_state),
		TEST(state_does_not_change_between_begin_and_end),
		TEST(values_are_converted),
		TEST(the_first_surface_gives_the_viewport),
		TEST(the_extensions_fit_into_small_buffers),
		TEST(each_bit_of_push_attrib_saves_its_group_alone),
		TEST(lights_and_materials_are_popped),
		TEST(the_stacks_have_ends),
		TEST(matrices_are_multiplied_from_the_right),
		TEST(lights_are_placed_by_the_matrix_of_then),
		TEST(clip_planes_are_taken_to_eye_space),
		TEST(a_material_follows_the_colour),
		TEST(pixel_store_is_client_state),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
