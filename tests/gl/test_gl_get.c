// SPDX-License-Identifier: MIT
/* Each value of the tables of state in the specification is answered, in its own number of numbers. */
#include "gl_scene.h"

#include <string.h>

struct value {
	GLenum name;
	int count;
};

static const struct value current[] = {
	{ GL_CURRENT_COLOR, 4 },
	{ GL_CURRENT_INDEX, 1 },
	{ GL_CURRENT_NORMAL, 3 },
	{ GL_CURRENT_TEXTURE_COORDS, 4 },
	{ GL_CURRENT_SECONDARY_COLOR, 4 },
	{ GL_CURRENT_FOG_COORDINATE, 1 },
	{ GL_CURRENT_RASTER_POSITION, 4 },
	{ GL_CURRENT_RASTER_DISTANCE, 1 },
	{ GL_CURRENT_RASTER_COLOR, 4 },
	{ GL_CURRENT_RASTER_INDEX, 1 },
	{ GL_CURRENT_RASTER_TEXTURE_COORDS, 4 },
	{ GL_CURRENT_RASTER_POSITION_VALID, 1 },
	{ GL_EDGE_FLAG, 1 },
};

static const struct value arrays[] = {
	{ GL_CLIENT_ACTIVE_TEXTURE, 1 },
	{ GL_VERTEX_ARRAY, 1 },
	{ GL_VERTEX_ARRAY_SIZE, 1 },
	{ GL_VERTEX_ARRAY_TYPE, 1 },
	{ GL_VERTEX_ARRAY_STRIDE, 1 },
	{ GL_NORMAL_ARRAY, 1 },
	{ GL_NORMAL_ARRAY_TYPE, 1 },
	{ GL_NORMAL_ARRAY_STRIDE, 1 },
	{ GL_COLOR_ARRAY, 1 },
	{ GL_COLOR_ARRAY_SIZE, 1 },
	{ GL_COLOR_ARRAY_TYPE, 1 },
	{ GL_COLOR_ARRAY_STRIDE, 1 },
	{ GL_INDEX_ARRAY, 1 },
	{ GL_INDEX_ARRAY_TYPE, 1 },
	{ GL_INDEX_ARRAY_STRIDE, 1 },
	{ GL_TEXTURE_COORD_ARRAY, 1 },
	{ GL_TEXTURE_COORD_ARRAY_SIZE, 1 },
	{ GL_TEXTURE_COORD_ARRAY_TYPE, 1 },
	{ GL_TEXTURE_COORD_ARRAY_STRIDE, 1 },
	{ GL_EDGE_FLAG_ARRAY, 1 },
	{ GL_EDGE_FLAG_ARRAY_STRIDE, 1 },
	{ GL_SECONDARY_COLOR_ARRAY, 1 },
	{ GL_FOG_COORDINATE_ARRAY, 1 },
	{ GL_ARRAY_BUFFER_BINDING, 1 },
	{ GL_ELEMENT_ARRAY_BUFFER_BINDING, 1 },
	{ GL_VERTEX_ARRAY_BUFFER_BINDING, 1 },
	{ GL_COLOR_ARRAY_BUFFER_BINDING, 1 },
};

static const struct value transform[] = {
	{ GL_MODELVIEW_MATRIX, 16 },
	{ GL_PROJECTION_MATRIX, 16 },
	{ GL_TEXTURE_MATRIX, 16 },
	{ GL_TRANSPOSE_MODELVIEW_MATRIX, 16 },
	{ GL_VIEWPORT, 4 },
	{ GL_DEPTH_RANGE, 2 },
	{ GL_MODELVIEW_STACK_DEPTH, 1 },
	{ GL_PROJECTION_STACK_DEPTH, 1 },
	{ GL_TEXTURE_STACK_DEPTH, 1 },
	{ GL_MATRIX_MODE, 1 },
	{ GL_NORMALIZE, 1 },
	{ GL_RESCALE_NORMAL, 1 },
	{ GL_CLIP_PLANE0, 1 },
	{ GL_CLIP_PLANE5, 1 },
};

static const struct value lighting[] = {
	{ GL_FOG_COLOR, 4 },
	{ GL_FOG_INDEX, 1 },
	{ GL_FOG_DENSITY, 1 },
	{ GL_FOG_START, 1 },
	{ GL_FOG_END, 1 },
	{ GL_FOG_MODE, 1 },
	{ GL_FOG_COORDINATE_SOURCE, 1 },
	{ GL_FOG, 1 },
	{ GL_SHADE_MODEL, 1 },
	{ GL_LIGHTING, 1 },
	{ GL_COLOR_MATERIAL, 1 },
	{ GL_COLOR_MATERIAL_PARAMETER, 1 },
	{ GL_COLOR_MATERIAL_FACE, 1 },
	{ GL_LIGHT_MODEL_AMBIENT, 4 },
	{ GL_LIGHT_MODEL_LOCAL_VIEWER, 1 },
	{ GL_LIGHT_MODEL_TWO_SIDE, 1 },
	{ GL_LIGHT_MODEL_COLOR_CONTROL, 1 },
	{ GL_LIGHT0, 1 },
	{ GL_COLOR_SUM, 1 },
};

static const struct value raster[] = {
	{ GL_POINT_SIZE, 1 },
	{ GL_POINT_SMOOTH, 1 },
	{ GL_POINT_SIZE_MIN, 1 },
	{ GL_POINT_SIZE_MAX, 1 },
	{ GL_POINT_FADE_THRESHOLD_SIZE, 1 },
	{ GL_POINT_DISTANCE_ATTENUATION, 3 },
	{ GL_LINE_WIDTH, 1 },
	{ GL_LINE_SMOOTH, 1 },
	{ GL_LINE_STIPPLE_PATTERN, 1 },
	{ GL_LINE_STIPPLE_REPEAT, 1 },
	{ GL_LINE_STIPPLE, 1 },
	{ GL_CULL_FACE, 1 },
	{ GL_CULL_FACE_MODE, 1 },
	{ GL_FRONT_FACE, 1 },
	{ GL_POLYGON_SMOOTH, 1 },
	{ GL_POLYGON_MODE, 2 },
	{ GL_POLYGON_OFFSET_FACTOR, 1 },
	{ GL_POLYGON_OFFSET_UNITS, 1 },
	{ GL_POLYGON_OFFSET_POINT, 1 },
	{ GL_POLYGON_OFFSET_LINE, 1 },
	{ GL_POLYGON_OFFSET_FILL, 1 },
	{ GL_POLYGON_STIPPLE, 1 },
	{ GL_ACTIVE_TEXTURE, 1 },
	{ GL_TEXTURE_1D, 1 },
	{ GL_TEXTURE_GEN_S, 1 },
	{ GL_SAMPLE_BUFFERS, 1 },
	{ GL_SAMPLES, 1 },
};

static const struct value fragments[] = {
	{ GL_SCISSOR_TEST, 1 },
	{ GL_SCISSOR_BOX, 4 },
	{ GL_ALPHA_TEST, 1 },
	{ GL_ALPHA_TEST_FUNC, 1 },
	{ GL_ALPHA_TEST_REF, 1 },
	{ GL_STENCIL_TEST, 1 },
	{ GL_STENCIL_FUNC, 1 },
	{ GL_STENCIL_VALUE_MASK, 1 },
	{ GL_STENCIL_REF, 1 },
	{ GL_STENCIL_FAIL, 1 },
	{ GL_STENCIL_PASS_DEPTH_FAIL, 1 },
	{ GL_STENCIL_PASS_DEPTH_PASS, 1 },
	{ GL_DEPTH_TEST, 1 },
	{ GL_DEPTH_FUNC, 1 },
	{ GL_BLEND, 1 },
	{ GL_BLEND_SRC, 1 },
	{ GL_BLEND_DST, 1 },
	{ GL_DITHER, 1 },
	{ GL_INDEX_LOGIC_OP, 1 },
	{ GL_COLOR_LOGIC_OP, 1 },
	{ GL_LOGIC_OP_MODE, 1 },
	{ GL_DRAW_BUFFER, 1 },
	{ GL_INDEX_WRITEMASK, 1 },
	{ GL_COLOR_WRITEMASK, 4 },
	{ GL_DEPTH_WRITEMASK, 1 },
	{ GL_STENCIL_WRITEMASK, 1 },
	{ GL_COLOR_CLEAR_VALUE, 4 },
	{ GL_INDEX_CLEAR_VALUE, 1 },
	{ GL_DEPTH_CLEAR_VALUE, 1 },
	{ GL_STENCIL_CLEAR_VALUE, 1 },
	{ GL_ACCUM_CLEAR_VALUE, 4 },
};

static const struct value pixels[] = {
	{ GL_UNPACK_SWAP_BYTES, 1 },   { GL_UNPACK_LSB_FIRST, 1 },
	{ GL_UNPACK_ROW_LENGTH, 1 },   { GL_UNPACK_SKIP_ROWS, 1 },
	{ GL_UNPACK_SKIP_PIXELS, 1 },  { GL_UNPACK_ALIGNMENT, 1 },
	{ GL_PACK_SWAP_BYTES, 1 },     { GL_PACK_LSB_FIRST, 1 },
	{ GL_PACK_ROW_LENGTH, 1 },     { GL_PACK_SKIP_ROWS, 1 },
	{ GL_PACK_SKIP_PIXELS, 1 },    { GL_PACK_ALIGNMENT, 1 },
	{ GL_READ_BUFFER, 1 },         { GL_LIST_BASE, 1 },
	{ GL_LIST_INDEX, 1 },          { GL_LIST_MODE, 1 },
	{ GL_RENDER_MODE, 1 },         { GL_PERSPECTIVE_CORRECTION_HINT, 1 },
	{ GL_POINT_SMOOTH_HINT, 1 },   { GL_LINE_SMOOTH_HINT, 1 },
	{ GL_POLYGON_SMOOTH_HINT, 1 }, { GL_FOG_HINT, 1 },
	{ GL_ATTRIB_STACK_DEPTH, 1 },  { GL_CLIENT_ATTRIB_STACK_DEPTH, 1 },
};

static const struct value limits[] = {
	{ GL_MAX_LIGHTS, 1 },
	{ GL_MAX_CLIP_PLANES, 1 },
	{ GL_MAX_MODELVIEW_STACK_DEPTH, 1 },
	{ GL_MAX_PROJECTION_STACK_DEPTH, 1 },
	{ GL_MAX_TEXTURE_STACK_DEPTH, 1 },
	{ GL_SUBPIXEL_BITS, 1 },
	{ GL_MAX_TEXTURE_SIZE, 1 },
	{ GL_MAX_PIXEL_MAP_TABLE, 1 },
	{ GL_MAX_NAME_STACK_DEPTH, 1 },
	{ GL_MAX_LIST_NESTING, 1 },
	{ GL_MAX_EVAL_ORDER, 1 },
	{ GL_MAX_VIEWPORT_DIMS, 2 },
	{ GL_MAX_ATTRIB_STACK_DEPTH, 1 },
	{ GL_MAX_CLIENT_ATTRIB_STACK_DEPTH, 1 },
	{ GL_MAX_TEXTURE_UNITS, 1 },
	{ GL_AUX_BUFFERS, 1 },
	{ GL_RGBA_MODE, 1 },
	{ GL_INDEX_MODE, 1 },
	{ GL_DOUBLEBUFFER, 1 },
	{ GL_STEREO, 1 },
	{ GL_POINT_SIZE_RANGE, 2 },
	{ GL_POINT_SIZE_GRANULARITY, 1 },
	{ GL_ALIASED_POINT_SIZE_RANGE, 2 },
	{ GL_LINE_WIDTH_RANGE, 2 },
	{ GL_LINE_WIDTH_GRANULARITY, 1 },
	{ GL_ALIASED_LINE_WIDTH_RANGE, 2 },
	{ GL_MAX_ELEMENTS_INDICES, 1 },
	{ GL_MAX_ELEMENTS_VERTICES, 1 },
	{ GL_RED_BITS, 1 },
	{ GL_GREEN_BITS, 1 },
	{ GL_BLUE_BITS, 1 },
	{ GL_ALPHA_BITS, 1 },
	{ GL_INDEX_BITS, 1 },
	{ GL_DEPTH_BITS, 1 },
	{ GL_STENCIL_BITS, 1 },
	{ GL_ACCUM_RED_BITS, 1 },
	{ GL_ACCUM_ALPHA_BITS, 1 },
};

#define UNTOUCHED 4711

/* As floats: as many as there are, and none more. */
static void answer_has_its_length(const struct value *value)
{
	GLfloat floats[20];
	int count = 0;

	for (int i = 0; i < 20; i++)
		floats[i] = UNTOUCHED;
	glGetFloatv(value->name, floats);
	while (count < 20 && floats[count] != UNTOUCHED)
		count++;
	if (glGetError() || count != value->count)
		fail_msg("0x%x has %d values, not %d", value->name, count, value->count);
}

/* All of the three others say the same of what is 0 or not. */
static void answers_agree(const struct value *value)
{
	GLboolean truth[16];
	GLdouble real[16];
	GLint whole[16];

	glGetBooleanv(value->name, truth);
	glGetDoublev(value->name, real);
	glGetIntegerv(value->name, whole);
	for (int i = 0; i < value->count; i++) {
		assert_int_equal(truth[i], real[i] != 0);
		if (whole[i] > 0)
			assert_true(real[i] > 0);
	}
}

static void assert_answered(const struct value *values, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		answer_has_its_length(&values[i]);
		answers_agree(&values[i]);
	}
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

#define ANSWERED(values) assert_answered(values, sizeof(values) / sizeof((values)[0]))

static void all_values_are_answered(void **state)
{
	(void)state;
	ANSWERED(current);
	ANSWERED(arrays);
	ANSWERED(transform);
	ANSWERED(lighting);
	ANSWERED(raster);
	ANSWERED(fragments);
	ANSWERED(pixels);
	ANSWERED(limits);
}

/* Of the first context of a pbuffer, as the specification's tables have them. */
static void values_are_at_first_those_of_the_tables(void **state)
{
	GLfloat colour[4], normal[3], ambient[4];
	GLint mode[2], function;

	(void)state;
	glGetFloatv(GL_CURRENT_COLOR, colour);
	assert_true(colour[0] == 1 && colour[1] == 1 && colour[2] == 1 && colour[3] == 1);
	glGetFloatv(GL_CURRENT_NORMAL, normal);
	assert_true(normal[0] == 0 && normal[1] == 0 && normal[2] == 1);
	glGetFloatv(GL_LIGHT_MODEL_AMBIENT, ambient);
	assert_true(ambient[0] == 0.2f && ambient[3] == 1);
	glGetIntegerv(GL_POLYGON_MODE, mode);
	assert_true(mode[0] == GL_FILL && mode[1] == GL_FILL);
	glGetIntegerv(GL_DEPTH_FUNC, &function);
	assert_int_equal(function, GL_LESS);
	glGetIntegerv(GL_COLOR_MATERIAL_PARAMETER, &function);
	assert_int_equal(function, GL_AMBIENT_AND_DIFFUSE);
	assert_true(glIsEnabled(GL_DITHER));
	assert_false(glIsEnabled(GL_DEPTH_TEST));
}

static void vertex_arrays_are_popped(void **state)
{
	static const GLfloat data[4];
	GLvoid *pointer;
	GLint size;

	(void)state;
	glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
	glBindBuffer(GL_ARRAY_BUFFER, 5);
	glVertexPointer(2, GL_SHORT, 12, NULL);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glColorPointer(3, GL_FLOAT, 12, data);
	glEnableClientState(GL_VERTEX_ARRAY);
	glClientActiveTexture(GL_TEXTURE1);
	glPopClientAttrib();
	assert_false(glIsEnabled(GL_VERTEX_ARRAY));
	glGetIntegerv(GL_VERTEX_ARRAY_SIZE, &size);
	assert_int_equal(size, 4);
	glGetIntegerv(GL_VERTEX_ARRAY_BUFFER_BINDING, &size);
	assert_int_equal(size, 0);
	glGetIntegerv(GL_CLIENT_ACTIVE_TEXTURE, &size);
	assert_int_equal(size, GL_TEXTURE0);
	glGetPointerv(GL_COLOR_ARRAY_POINTER, &pointer);
	assert_null(pointer);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(all_values_are_answered),
		TEST(values_are_at_first_those_of_the_tables),
		TEST(vertex_arrays_are_popped),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
