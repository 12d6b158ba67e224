// SPDX-License-Identifier: MIT
/*
 * Every command that the library has, called with whatever its types allow: between glBegin and
 * glEnd, with enums that are none, and thousands of them in random order. What a program may not do
 * to any OpenGL is not done: pointers lead to memory, and counts do not lead out of it. GL_CALLS says
 * how many, GLOSS_SEED which.
 */
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <limits.h>
#include <math.h>

#include "accel_test.h"
#include "api/proc.h"
#include "gl_display.h"

#define CALLS 50000
#define BUFFER (1 << 20)
#define NO_ENUM 0xdead

/* Where the arguments of a call come from. */
struct api {
	gloss_proc proc;
	uint64_t seed;
	const struct api_call *call;
	bool no_enums; /* all are NO_ENUM, and the rest is harmless */
	bool plain;    /* numbers are harmless */
	bool minus;    /* but for sizes, which are -1 */
};

struct api_call {
	const char *name;
	void (*call)(struct api *api);
	int enums, sizes; /* of its arguments */
	/* Some that it may take, those of the source that it is in. */
	const unsigned int *known;
	uint32_t knows;
};

static float input[BUFFER / sizeof(float)], output[BUFFER / sizeof(float)];

static unsigned int api_enum(struct api *api)
{
	static const unsigned int from[] = { 0,      0x200,  0xb00,  0x1000, 0x1400, 0x1b00,
					     0x2000, 0x2a00, 0x3000, 0x4000, 0x8000, 0x8060,
					     0x84c0, 0x8500, 0x8800, 0x8b00 };

	if (api->no_enums)
		return NO_ENUM;
	if (api->call->known && test_below(&api->seed, 8))
		return api->call->known[test_below(&api->seed, api->call->knows)];
	if (!test_below(&api->seed, 16))
		return (unsigned int)test_random(&api->seed);
	return from[test_below(&api->seed, 16)] + test_below(&api->seed, 64);
}

static double api_float(struct api *api)
{
	static const double odd[] = { (double)NAN, (double)INFINITY, -(double)INFINITY, 1e38, 0 };

	if (api->no_enums || api->plain)
		return 1;
	if (!test_below(&api->seed, 8))
		return odd[test_below(&api->seed, 5)];
	return (double)test_below(&api->seed, 4001) / 1000 - 2;
}

static int api_integer(struct api *api)
{
	static const int odd[] = { -1, INT_MIN, 64, 16 };

	if (api->no_enums || api->plain)
		return 3; /* as a size it is good for all arrays */
	if (!test_below(&api->seed, 8))
		return odd[test_below(&api->seed, 4)];
	return (int)test_below(&api->seed, 9);
}

static int api_size(struct api *api)
{
	return api->minus ? -1 : api_integer(api);
}

static unsigned int api_bits(struct api *api)
{
	if (api->no_enums || api->plain)
		return 0;
	return test_below(&api->seed, 2) ? (unsigned int)test_random(&api->seed) : 0x4500;
}

static const void *api_input(struct api *api)
{
	(void)api;
	return input;
}

static void *api_output(struct api *api)
{
	(void)api;
	return output;
}

#include "api_calls.inc"

#define API_CALLS (sizeof(api_calls) / sizeof(api_calls[0]))

static bool begins_with(const char *name, const char *const *list)
{
	for (; *list; list++)
		if (!strncmp(name, *list, strlen(*list)))
			return true;
	return false;
}

/* The next call is of this command; false: the library has it not. libglvnd has a function for each,
 * which does nothing then, so the library's table says it. */
static bool api_choose(struct api *api, const struct api_call *call)
{
	api->call = call;
	api->proc = gloss_proc_find(call->name) ? eglGetProcAddress(call->name) : NULL;
	return api->proc;
}

static int setup(void **state)
{
	static struct gl_display gl;
	uint64_t seed = 1;

	gl_display_open(&gl);
	gl_display_context(&gl, gl_display_pbuffer(&gl, 32, 16), EGL_NO_CONTEXT);
	gl_assert_gloss();
	for (size_t i = 0; i < BUFFER / sizeof(float); i++)
		input[i] = (float)test_below(&seed, 4001) / 1000 - 2;
	*state = &gl;
	return 0;
}

static int teardown(void **state)
{
	const struct gl_display *gl = *state;

	assert_true(eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_true(eglTerminate(gl->display));
	assert_true(eglReleaseThread());
	return 0;
}

/* 2.6.3: what may be called there, and the commands of clients, which may be errors or not. */
static const char *const inside[] = { "glVertex",
				      "glColor",
				      "glSecondaryColor",
				      "glIndex",
				      "glNormal",
				      "glTexCoord",
				      "glMultiTexCoord",
				      "glFogCoord",
				      "glArrayElement",
				      "glEvalCoord",
				      "glEvalPoint",
				      "glMaterial",
				      "glCallList",
				      "glEdgeFlag",
				      "glEnd",
				      "glBegin",
				      "glEnableClient",
				      "glDisableClient",
				      "glPushClient",
				      "glPopClient",
				      "glClientActive",
				      "glInterleaved",
				      "glPixelStore",
				      "glGetError",
				      "glNormalPointer",
				      NULL };

static void between_begin_and_end_others_are_invalid_operations(void **state)
{
	struct api api = { .plain = true, .seed = test_seed() };
	int called = 0;

	(void)state;
	for (size_t i = 0; i < API_CALLS; i++) {
		GLenum error;

		if (!api_choose(&api, &api_calls[i]) || begins_with(api_calls[i].name, inside) ||
		    strstr(api_calls[i].name, "Pointer"))
			continue;
		glBegin(GL_TRIANGLES);
		api_calls[i].call(&api);
		glEnd();
		error = glGetError();
		if (error != GL_INVALID_OPERATION)
			fail_msg("%s: error %#x", api_calls[i].name, error);
		assert_int_equal(glGetError(), GL_NO_ERROR);
		called++;
	}
	print_message("%d commands\n", called);
	assert_true(called > 100);
}

/* 2.7: a texture that is none is undefined. */
static const char *const undefined[] = { "glMultiTexCoord", NULL };

static void enums_that_are_none_are_invalid(void **state)
{
	struct api api = { .no_enums = true, .seed = test_seed() };
	int called = 0;

	(void)state;
	for (size_t i = 0; i < API_CALLS; i++) {
		GLenum error;

		if (!api_choose(&api, &api_calls[i]) || !api_calls[i].enums ||
		    begins_with(api_calls[i].name, undefined))
			continue;
		api_calls[i].call(&api);
		error = glGetError();
		if (error != GL_INVALID_ENUM)
			fail_msg("%s: error %#x", api_calls[i].name, error);
		called++;
	}
	print_message("%d commands\n", called);
	assert_true(called > 50);
}

/* Of commands without an enum, which would be the first error. */
static void sizes_below_zero_are_invalid(void **state)
{
	struct api api = { .plain = true, .minus = true, .seed = test_seed() };
	int called = 0;

	(void)state;
	for (size_t i = 0; i < API_CALLS; i++) {
		GLenum error;

		if (!api_choose(&api, &api_calls[i]) || !api_calls[i].sizes || api_calls[i].enums)
			continue;
		api_calls[i].call(&api);
		error = glGetError();
		if (error != GL_INVALID_VALUE)
			fail_msg("%s: error %#x", api_calls[i].name, error);
		called++;
	}
	print_message("%d commands\n", called);
	assert_true(called > 5);
}

/* Those with which a program says where its memory is or ends. */
static const char *const dangerous[] = { "glArrayElement", "glDrawArrays",
					 "glBindBuffer",   "glPixelStore",
					 "glDrawElements", "glDrawRangeElements",
					 "glMultiDraw",    NULL };

static void any_calls_in_any_order_do_no_harm(void **state)
{
	struct api api = { .seed = test_seed() };
	const char *given = getenv("GL_CALLS");
	int calls = given && atoi(given) > 0 ? atoi(given) : CALLS, called = 0, errors = 0;

	(void)state;
	for (int n = 0; n < calls; n++) {
		const struct api_call *call = &api_calls[test_below(&api.seed, API_CALLS)];
		GLenum error = glGetError();

		errors += error != GL_NO_ERROR;
		assert_true(!error || (error >= GL_INVALID_ENUM && error <= GL_OUT_OF_MEMORY));
		if (!api_choose(&api, call) || begins_with(call->name, dangerous))
			continue;
		call->call(&api);
		called++;
		if (!test_below(&api.seed, 8))
			glEnd();
		if (!test_below(&api.seed, 64))
			glEndList();
	}
	print_message("%d calls, %d of them errors\n", called, errors);
	assert_true(called > calls / 4 && errors < called * 3 / 4);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(between_begin_and_end_others_are_invalid_operations),
		cmocka_unit_test(enums_that_are_none_are_invalid),
		cmocka_unit_test(sizes_below_zero_are_invalid),
		cmocka_unit_test(any_calls_in_any_order_do_no_harm),
	};

	return cmocka_run_group_tests(tests, setup, teardown);
}
