// SPDX-License-Identifier: MIT
/* Textures' names, and the state that says how they are sampled, combined and placed. */
#include "gl_scene.h"

static GLint parameter(GLenum target, GLenum pname)
{
	GLint value = -1;

	glGetTexParameteriv(target, pname, &value);
	return value;
}

static GLint environment(GLenum pname)
{
	GLint value = -1;

	glGetTexEnviv(GL_TEXTURE_ENV, pname, &value);
	return value;
}

static GLint get(GLenum pname)
{
	GLint value = -1;

	glGetIntegerv(pname, &value);
	return value;
}

static void a_name_is_a_texture_once_it_is_bound(void **state)
{
	GLuint name[2];
	GLboolean resident[2];

	(void)state;
	glGenTextures(2, name);
	assert_true(name[0] && name[1] == name[0] + 1);
	assert_false(glIsTexture(name[0]));
	glBindTexture(GL_TEXTURE_2D, name[0]);
	assert_true(glIsTexture(name[0]));
	assert_int_equal(get(GL_TEXTURE_BINDING_2D), (GLint)name[0]);
	assert_false(glAreTexturesResident(2, name, resident));
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	assert_true(glAreTexturesResident(1, name, resident));
	glBindTexture(GL_TEXTURE_1D, name[0]);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glBindTexture(GL_TEXTURE_1D, 777); /* that nobody generated */
	assert_true(glIsTexture(777));
	glDeleteTextures(2, name);
	assert_false(glIsTexture(name[0]));
	assert_int_equal(get(GL_TEXTURE_BINDING_2D), 0);
	assert_int_equal(get(GL_TEXTURE_BINDING_1D), 777);
	glBindTexture(GL_PROXY_TEXTURE_2D, 1);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glGenTextures(-1, name);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
}

static void each_texture_has_its_parameters(void **state)
{
	static const GLfloat border[4] = { 0.5f, 2, 0, 1 };
	static const GLfloat priority = 0.5f;
	const GLuint name = 5;
	GLfloat value[4];

	(void)state;
	glBindTexture(GL_TEXTURE_2D, name);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER), GL_NEAREST_MIPMAP_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 3);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MIN_LOD, -2.5f);
	glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
	glPrioritizeTextures(1, &name, &priority);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER), GL_LINEAR);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T), GL_CLAMP_TO_EDGE);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL), 3);
	glGetTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_MIN_LOD, value);
	assert_float_equal(value[0], -2.5f, 0);
	glGetTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_PRIORITY, value);
	assert_float_equal(value[0], 0.5f, 0);
	glGetTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, value);
	assert_float_equal(value[0], 0.5f, 0);
	assert_float_equal(value[1], 1, 0);
	glBindTexture(GL_TEXTURE_2D, 0);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER), GL_NEAREST_MIPMAP_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER), GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, -1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glTexParameteri(GL_TEXTURE_CUBE_MAP_POSITIVE_X, GL_TEXTURE_WRAP_S, GL_REPEAT);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void units_have_environments_of_their_own(void **state)
{
	static const GLfloat colour[4] = { 0, 0.5f, 1, 2 };
	GLfloat value[4];

	(void)state;
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_DOT3_RGBA);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE2_ALPHA, GL_TEXTURE3);
	glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND1_RGB, GL_ONE_MINUS_SRC_ALPHA);
	glTexEnvf(GL_TEXTURE_ENV, GL_ALPHA_SCALE, 4);
	glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, colour);
	glActiveTexture(GL_TEXTURE1);
	assert_int_equal(environment(GL_TEXTURE_ENV_MODE), GL_MODULATE);
	assert_int_equal(environment(GL_SOURCE2_ALPHA), GL_CONSTANT);
	glEnable(GL_TEXTURE_1D);
	glActiveTexture(GL_TEXTURE0);
	assert_false(glIsEnabled(GL_TEXTURE_1D));
	assert_int_equal(environment(GL_COMBINE_RGB), GL_DOT3_RGBA);
	assert_int_equal(environment(GL_SOURCE2_ALPHA), GL_TEXTURE3);
	assert_int_equal(environment(GL_OPERAND1_RGB), GL_ONE_MINUS_SRC_ALPHA);
	assert_int_equal(environment(GL_OPERAND1_ALPHA), GL_SRC_ALPHA);
	assert_int_equal(environment(GL_ALPHA_SCALE), 4);
	glGetTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, value);
	assert_float_equal(value[1], 0.5f, 0);
	assert_float_equal(value[3], 1, 0);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_ALPHA);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	assert_int_equal(environment(GL_TEXTURE_ENV_MODE), GL_COMBINE);
	glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 3);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, GL_DOT3_RGB);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, 1.5f);
	glGetTexEnvfv(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, value);
	assert_float_equal(value[0], 1.5f, 0);
}

static void planes_of_texgen_are_taken_to_eye_space(void **state)
{
	static const GLfloat plane[4] = { 1, 0, 0, 0 };
	GLfloat value[4];
	GLint mode;

	(void)state;
	glTranslatef(3, 0, 0);
	glTexGenfv(GL_Q, GL_EYE_PLANE, plane);
	glTexGenfv(GL_Q, GL_OBJECT_PLANE, plane);
	glLoadIdentity();
	glGetTexGenfv(GL_Q, GL_EYE_PLANE, value);
	assert_float_equal(value[3], -3, 1e-6f);
	glGetTexGenfv(GL_Q, GL_OBJECT_PLANE, value);
	assert_float_equal(value[3], 0, 0);
	glGetTexGenfv(GL_T, GL_EYE_PLANE, value);
	assert_float_equal(value[1], 1, 0);
	glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
	glTexGeni(GL_R, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glGetTexGeniv(GL_S, GL_TEXTURE_GEN_MODE, &mode);
	assert_int_equal(mode, GL_SPHERE_MAP);
	glGetTexGeniv(GL_R, GL_TEXTURE_GEN_MODE, &mode);
	assert_int_equal(mode, GL_EYE_LINEAR);
	glTexGeni(GL_Q, GL_TEXTURE_GEN_MODE, GL_REFLECTION_MAP);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void the_texture_bit_saves_all_of_it(void **state)
{
	(void)state;
	glBindTexture(GL_TEXTURE_2D, 8);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
	glTexGeni(GL_Q, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
	glActiveTexture(GL_TEXTURE2);
	glPushAttrib(GL_TEXTURE_BIT);
	glActiveTexture(GL_TEXTURE0);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_MIRRORED_REPEAT);
	glTexGeni(GL_Q, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_ADD);
	glEnable(GL_TEXTURE_GEN_Q);
	glBindTexture(GL_TEXTURE_2D, 9);
	glPopAttrib();
	assert_int_equal(get(GL_ACTIVE_TEXTURE), GL_TEXTURE2);
	glActiveTexture(GL_TEXTURE0);
	assert_int_equal(get(GL_TEXTURE_BINDING_2D), 8);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S), GL_CLAMP);
	assert_int_equal(environment(GL_TEXTURE_ENV_MODE), GL_MODULATE);
	assert_false(glIsEnabled(GL_TEXTURE_GEN_Q));
}

static void a_list_has_textures_in_their_order(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	glBindTexture(GL_TEXTURE_2D, 4);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
	glBindTexture(GL_TEXTURE_2D, 5);
	glEndList();
	assert_false(glIsTexture(4));
	glCallList(1);
	assert_int_equal(get(GL_TEXTURE_BINDING_2D), 5);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S), GL_REPEAT);
	glBindTexture(GL_TEXTURE_2D, 4);
	assert_int_equal(parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S), GL_CLAMP);
}

/* Contexts that share: a texture that one deletes stays with the other as long as it is bound there. */
static void a_deleted_texture_stays_where_it_is_bound(void **state)
{
	static const uint8_t texel[4] = { 1, 2, 3, 4 };
	const GLuint name = 3;
	const EGLSurface surface = eglGetCurrentSurface(EGL_DRAW);
	const EGLContext first = eglGetCurrentContext();
	EGLContext second;
	uint8_t back[4];

	(void)state;
	glBindTexture(GL_TEXTURE_2D, name);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
	second = gl_display_context(&gl, surface, first);
	assert_true(glIsTexture(name));
	glDeleteTextures(1, &name);
	assert_true(eglMakeCurrent(gl.display, surface, surface, first));
	assert_false(glIsTexture(name));
	glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, back);
	assert_memory_equal(back, texel, 4);
	glBindTexture(GL_TEXTURE_2D, name);
	assert_true(glIsTexture(name));
	assert_true(eglDestroyContext(gl.display, second));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_name_is_a_texture_once_it_is_bound),
		TEST(each_texture_has_its_parameters),
		TEST(units_have_environments_of_their_own),
		TEST(planes_of_texgen_are_taken_to_eye_space),
		TEST(the_texture_bit_saves_all_of_it),
		TEST(a_list_has_textures_in_their_order),
		TEST(a_deleted_texture_stays_where_it_is_bound),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
