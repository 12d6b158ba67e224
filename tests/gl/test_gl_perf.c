// SPDX-License-Identifier: MIT
/* GLOSS_DEBUG=perf names each thing that something is drawn without, once, and nothing else. */
#include "gl_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What the library has printed since the last call of told(). */
static FILE *printed;
static int saved;

static const char *told(void)
{
	static char text[4096];
	size_t length;

	rewind(printed);
	length = fread(text, 1, sizeof(text) - 1, printed);
	text[length] = 0;
	rewind(printed);
	assert_int_equal(ftruncate(fileno(printed), 0), 0);
	return text;
}

static int setup(void **state)
{
	setenv("GLOSS_DEBUG", "perf", 1);
	printed = tmpfile();
	assert_non_null(printed);
	saved = dup(2);
	assert_int_equal(dup2(fileno(printed), 2), 2);
	gl_scene_setup(state);
	told(); /* which device there is */
	return 0;
}

static int teardown(void **state)
{
	dup2(saved, 2);
	close(saved);
	fclose(printed);
	unsetenv("GLOSS_DEBUG");
	return gl_scene_teardown(state);
}

/* Drawn twice, so that it could be told twice. */
static void assert_told(const char *what)
{
	char line[128];

	snprintf(line, sizeof(line), "gloss: perf: drawn without %s\n", what);
	for (int i = 0; i < 2; i++) {
		square(0, 0);
		glFinish();
		glDepthMask(i != 0); /* a change of state, which draws on */
	}
	assert_string_equal(told(), line);
}

static void each_capability_is_named_once(void **state)
{
	static const struct {
		GLenum name;
		const char *what;
	} capability[] = {
		{ GL_TEXTURE_2D, "textures" },
		{ GL_BLEND, "blending" },
		{ GL_ALPHA_TEST, "the alpha test" },
		{ GL_STENCIL_TEST, "the stencil test" },
		{ GL_FOG, "fog" },
		{ GL_COLOR_LOGIC_OP, "the logic operation" },
		{ GL_POLYGON_STIPPLE, "polygon stipple" },
		{ GL_COLOR_SUM, "the secondary colour" },
		{ GL_POINT_SMOOTH, "smooth points" },
		{ GL_LINE_SMOOTH, "smooth lines" },
		{ GL_POLYGON_SMOOTH, "smooth polygons" },
	};

	(void)state;
	for (size_t i = 0; i < sizeof(capability) / sizeof(capability[0]); i++) {
		glEnable(capability[i].name);
		assert_told(capability[i].what);
		glDisable(capability[i].name);
	}
}

static void what_is_no_capability_is_named_too(void **state)
{
	(void)state;
	glEnable(GL_LIGHTING);
	glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
	assert_told("separate specular light");
	glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SINGLE_COLOR);
	glDrawBuffer(GL_FRONT);
	assert_told("a front buffer of its own");
}

/* All that is drawn as OpenGL says. */
static void what_is_drawn_is_not_named(void **state)
{
	static const GLenum drawn[] = { GL_LIGHTING,     GL_LIGHT0,      GL_DEPTH_TEST,
					GL_CULL_FACE,    GL_NORMALIZE,   GL_SCISSOR_TEST,
					GL_LINE_STIPPLE, GL_CLIP_PLANE0, GL_COLOR_MATERIAL,
					GL_DITHER,       GL_AUTO_NORMAL, GL_POLYGON_OFFSET_FILL };

	(void)state;
	for (size_t i = 0; i < sizeof(drawn) / sizeof(drawn[0]); i++)
		glEnable(drawn[i]);
	glPolygonMode(GL_FRONT, GL_LINE);
	glLineWidth(3);
	square(0, 0);
	glFinish();
	assert_string_equal(told(), "");
}

#define PERF_TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		PERF_TEST(each_capability_is_named_once),
		PERF_TEST(what_is_no_capability_is_named_too),
		PERF_TEST(what_is_drawn_is_not_named),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
