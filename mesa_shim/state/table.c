// SPDX-License-Identifier: MIT
#include <pthread.h>
#include <stddef.h>

#include "state/context.h"
#include "state/table.h"

#define OF(member) offsetof(struct gloss_context, member)
#define AT(member) OF(attributes.member)
#define SIZE(member) sizeof(((struct gloss_context *)NULL)->member)

/* clang-format off */
/* A capability, one of the client, a value of a kind, bytes to save, a constant. */
#define CAN(n, member) \
	{ GL_##n, GLOSS_CAPABILITY, 0, 1, AT(member), 0, GL_ENABLE_BIT },
#define CLIENT(n, member) \
	{ GL_##n, GLOSS_CLIENT_CAPABILITY, 0, 1, OF(client.arrays.member.enabled), 0, 0 },
#define VALUE(n, kind, count, member) \
	{ GL_##n, GLOSS_##kind, 0, count, OF(member), 0, 0 },
#define SAVE(member, bits) \
	{ 0, GLOSS_BYTES, 0, SIZE(attributes.member), AT(member), 0, bits },
#define IS(n, value) \
	{ GL_##n, GLOSS_CONSTANT, 0, 1, value, 0, 0 },
/* The same of the active texture unit, and of the client's. */
#define UNIT_CAN(n, member) \
	{ GL_##n, GLOSS_CAPABILITY, GLOSS_UNIT_ACTIVE, 1, AT(texturing.unit[0].member), \
	  SIZE(attributes.texturing.unit[0]), GL_ENABLE_BIT },
#define UNIT(n, kind, count, member, stride) \
	{ GL_##n, GLOSS_##kind, GLOSS_UNIT_ACTIVE, count, AT(member), stride, 0 },
#define TEXCOORD(n, kind, member) \
	{ GL_##n, GLOSS_##kind, GLOSS_UNIT_CLIENT, 1, OF(client.arrays.texcoord[0].member), \
	  SIZE(client.arrays.texcoord[0]), 0 },
#define LIGHT(i) CAN(LIGHT##i, lighting.light[i].enabled)
#define PLANE(i) CAN(CLIP_PLANE##i, transform.clip[i])
#define ARRAY(NAME, member) \
	CLIENT(NAME, member) \
	VALUE(NAME##_TYPE, INTEGER, 1, client.arrays.member.type) \
	VALUE(NAME##_STRIDE, INTEGER, 1, client.arrays.member.stride) \
	VALUE(NAME##_BUFFER_BINDING, INTEGER, 1, client.arrays.member.buffer)
#define SIZED_ARRAY(NAME, member) \
	ARRAY(NAME, member) \
	VALUE(NAME##_SIZE, INTEGER, 1, client.arrays.member.size)
#define STORE(NAME, member) \
	VALUE(NAME##_ROW_LENGTH, INTEGER, 1, client.member.row_length) \
	VALUE(NAME##_SKIP_ROWS, INTEGER, 1, client.member.skip_rows) \
	VALUE(NAME##_SKIP_PIXELS, INTEGER, 1, client.member.skip_pixels) \
	VALUE(NAME##_ALIGNMENT, INTEGER, 1, client.member.alignment) \
	VALUE(NAME##_IMAGE_HEIGHT, INTEGER, 1, client.member.image_height) \
	VALUE(NAME##_SKIP_IMAGES, INTEGER, 1, client.member.skip_images) \
	VALUE(NAME##_SWAP_BYTES, BOOLEAN, 1, client.member.swap_bytes) \
	VALUE(NAME##_LSB_FIRST, BOOLEAN, 1, client.member.lsb_first)
#define CHANNEL(NAME, i) \
	VALUE(NAME##_SCALE, FLOAT, 1, attributes.transfer.scale[i]) \
	VALUE(NAME##_BIAS, FLOAT, 1, attributes.transfer.bias[i])
#define MAP(NAME, i) \
	CAN(MAP1_##NAME, evaluating.map1[i]) \
	CAN(MAP2_##NAME, evaluating.map2[i])
#define MAP_SIZE(NAME, i) VALUE(PIXEL_MAP_##NAME##_SIZE, INTEGER, 1, maps.size[i])
#define TEXGEN(NAME, i) UNIT_CAN(TEXTURE_GEN_##NAME, generate[i])

const struct gloss_row gloss_table[] = {
	SAVE(current, GL_CURRENT_BIT)
	VALUE(CURRENT_COLOR, UNIT_FLOAT, 4, attributes.current.vertex.colour)
	VALUE(CURRENT_NORMAL, UNIT_FLOAT, 3, attributes.current.vertex.normal)
	VALUE(EDGE_FLAG, FLOAT, 1, attributes.current.vertex.edge)
	VALUE(CURRENT_SECONDARY_COLOR, UNIT_FLOAT, 4, attributes.current.secondary)
	VALUE(CURRENT_FOG_COORDINATE, FLOAT, 1, attributes.current.fog)
	VALUE(CURRENT_INDEX, FLOAT, 1, attributes.current.index)
	UNIT(CURRENT_TEXTURE_COORDS, FLOAT, 4, current.texcoord[0], 4 * sizeof(GLfloat))
	SAVE(raster, GL_CURRENT_BIT)
	VALUE(CURRENT_RASTER_POSITION, FLOAT, 4, attributes.raster.position)
	VALUE(CURRENT_RASTER_DISTANCE, FLOAT, 1, attributes.raster.distance)
	VALUE(CURRENT_RASTER_COLOR, UNIT_FLOAT, 4, attributes.raster.colour)
	VALUE(CURRENT_RASTER_SECONDARY_COLOR, UNIT_FLOAT, 4, attributes.raster.secondary)
	VALUE(CURRENT_RASTER_INDEX, FLOAT, 1, attributes.raster.index)
	VALUE(CURRENT_RASTER_POSITION_VALID, BOOLEAN, 1, attributes.raster.valid)
	UNIT(CURRENT_RASTER_TEXTURE_COORDS, FLOAT, 4, raster.texcoord[0], 4 * sizeof(GLfloat))

	SAVE(point, GL_POINT_BIT)
	CAN(POINT_SMOOTH, point.smooth)
	CAN(POINT_SPRITE, point.sprite)
	VALUE(POINT_SIZE, FLOAT, 1, attributes.point.size)
	VALUE(POINT_SIZE_MIN, FLOAT, 1, attributes.point.least)
	VALUE(POINT_SIZE_MAX, FLOAT, 1, attributes.point.most)
	VALUE(POINT_FADE_THRESHOLD_SIZE, FLOAT, 1, attributes.point.fade)
	VALUE(POINT_DISTANCE_ATTENUATION, FLOAT, 3, attributes.point.attenuation)

	SAVE(line, GL_LINE_BIT)
	CAN(LINE_SMOOTH, line.smooth)
	CAN(LINE_STIPPLE, line.stipple)
	VALUE(LINE_WIDTH, FLOAT, 1, attributes.line.width)
	VALUE(LINE_STIPPLE_PATTERN, INTEGER, 1, attributes.line.pattern)
	VALUE(LINE_STIPPLE_REPEAT, INTEGER, 1, attributes.line.repeat)

	SAVE(polygon, GL_POLYGON_BIT)
	CAN(CULL_FACE, polygon.cull)
	CAN(POLYGON_SMOOTH, polygon.smooth)
	CAN(POLYGON_STIPPLE, polygon.stipple)
	CAN(POLYGON_OFFSET_POINT, polygon.offset_point)
	CAN(POLYGON_OFFSET_LINE, polygon.offset_line)
	CAN(POLYGON_OFFSET_FILL, polygon.offset_fill)
	VALUE(CULL_FACE_MODE, INTEGER, 1, attributes.polygon.cull_face)
	VALUE(FRONT_FACE, INTEGER, 1, attributes.polygon.front_face)
	VALUE(POLYGON_MODE, INTEGER, 2, attributes.polygon.mode)
	VALUE(POLYGON_OFFSET_FACTOR, FLOAT, 1, attributes.polygon.factor)
	VALUE(POLYGON_OFFSET_UNITS, FLOAT, 1, attributes.polygon.units)
	SAVE(polygon_stipple, GL_POLYGON_STIPPLE_BIT)

	SAVE(transfer, GL_PIXEL_MODE_BIT)
	VALUE(ZOOM_X, FLOAT, 1, attributes.transfer.zoom[0])
	VALUE(ZOOM_Y, FLOAT, 1, attributes.transfer.zoom[1])
	VALUE(MAP_COLOR, BOOLEAN, 1, attributes.transfer.map_colour)
	VALUE(MAP_STENCIL, BOOLEAN, 1, attributes.transfer.map_stencil)
	VALUE(INDEX_SHIFT, INTEGER, 1, attributes.transfer.index_shift)
	VALUE(INDEX_OFFSET, INTEGER, 1, attributes.transfer.index_offset)
	VALUE(DEPTH_SCALE, FLOAT, 1, attributes.transfer.depth_scale)
	VALUE(DEPTH_BIAS, FLOAT, 1, attributes.transfer.depth_bias)
	VALUE(READ_BUFFER, INTEGER, 1, attributes.transfer.read_buffer)
	CHANNEL(RED, 0) CHANNEL(GREEN, 1) CHANNEL(BLUE, 2) CHANNEL(ALPHA, 3)
	MAP_SIZE(I_TO_I, 0) MAP_SIZE(S_TO_S, 1) MAP_SIZE(I_TO_R, 2) MAP_SIZE(I_TO_G, 3)
	MAP_SIZE(I_TO_B, 4) MAP_SIZE(I_TO_A, 5) MAP_SIZE(R_TO_R, 6) MAP_SIZE(G_TO_G, 7)
	MAP_SIZE(B_TO_B, 8) MAP_SIZE(A_TO_A, 9)

	SAVE(lighting, GL_LIGHTING_BIT)
	CAN(LIGHTING, lighting.enabled)
	CAN(COLOR_MATERIAL, lighting.track)
	LIGHT(0) LIGHT(1) LIGHT(2) LIGHT(3) LIGHT(4) LIGHT(5) LIGHT(6) LIGHT(7)
	VALUE(SHADE_MODEL, INTEGER, 1, attributes.lighting.shade_model)
	VALUE(LIGHT_MODEL_AMBIENT, UNIT_FLOAT, 4, attributes.lighting.ambient)
	VALUE(LIGHT_MODEL_LOCAL_VIEWER, BOOLEAN, 1, attributes.lighting.local_viewer)
	VALUE(LIGHT_MODEL_TWO_SIDE, BOOLEAN, 1, attributes.lighting.two_side)
	VALUE(LIGHT_MODEL_COLOR_CONTROL, INTEGER, 1, attributes.lighting.colour_control)
	VALUE(COLOR_MATERIAL_FACE, INTEGER, 1, attributes.lighting.track_face)
	VALUE(COLOR_MATERIAL_PARAMETER, INTEGER, 1, attributes.lighting.track_mode)

	SAVE(fog, GL_FOG_BIT)
	CAN(FOG, fog.enabled)
	CAN(COLOR_SUM, fog.sum)
	VALUE(FOG_MODE, INTEGER, 1, attributes.fog.mode)
	VALUE(FOG_COORDINATE_SOURCE, INTEGER, 1, attributes.fog.source)
	VALUE(FOG_DENSITY, FLOAT, 1, attributes.fog.density)
	VALUE(FOG_START, FLOAT, 1, attributes.fog.start)
	VALUE(FOG_END, FLOAT, 1, attributes.fog.end)
	VALUE(FOG_INDEX, FLOAT, 1, attributes.fog.index)
	VALUE(FOG_COLOR, UNIT_FLOAT, 4, attributes.fog.colour)

	SAVE(depth, GL_DEPTH_BUFFER_BIT)
	CAN(DEPTH_TEST, depth.test)
	VALUE(DEPTH_FUNC, INTEGER, 1, attributes.depth.func)
	VALUE(DEPTH_WRITEMASK, BOOLEAN, 1, attributes.depth.mask)
	VALUE(DEPTH_CLEAR_VALUE, UNIT_FLOAT, 1, attributes.depth.clear)
	SAVE(accum_clear, GL_ACCUM_BUFFER_BIT)
	VALUE(ACCUM_CLEAR_VALUE, UNIT_FLOAT, 4, attributes.accum_clear)

	SAVE(stencil, GL_STENCIL_BUFFER_BIT)
	CAN(STENCIL_TEST, stencil.test)
	VALUE(STENCIL_FUNC, INTEGER, 1, attributes.stencil.func)
	VALUE(STENCIL_FAIL, INTEGER, 1, attributes.stencil.fail)
	VALUE(STENCIL_PASS_DEPTH_FAIL, INTEGER, 1, attributes.stencil.depth_fail)
	VALUE(STENCIL_PASS_DEPTH_PASS, INTEGER, 1, attributes.stencil.pass)
	VALUE(STENCIL_REF, INTEGER, 1, attributes.stencil.reference)
	VALUE(STENCIL_VALUE_MASK, INTEGER, 1, attributes.stencil.mask)
	VALUE(STENCIL_WRITEMASK, INTEGER, 1, attributes.stencil.write_mask)
	VALUE(STENCIL_CLEAR_VALUE, INTEGER, 1, attributes.stencil.clear)

	SAVE(colour_buffer, GL_COLOR_BUFFER_BIT)
	CAN(ALPHA_TEST, colour_buffer.alpha_test)
	CAN(BLEND, colour_buffer.blend)
	CAN(DITHER, colour_buffer.dither)
	CAN(COLOR_LOGIC_OP, colour_buffer.logic)
	CAN(INDEX_LOGIC_OP, colour_buffer.index_logic)
	VALUE(ALPHA_TEST_FUNC, INTEGER, 1, attributes.colour_buffer.alpha_func)
	VALUE(ALPHA_TEST_REF, UNIT_FLOAT, 1, attributes.colour_buffer.alpha_reference)
	VALUE(BLEND_SRC, INTEGER, 1, attributes.colour_buffer.source)
	VALUE(BLEND_DST, INTEGER, 1, attributes.colour_buffer.target)
	VALUE(BLEND_SRC_RGB, INTEGER, 1, attributes.colour_buffer.source)
	VALUE(BLEND_DST_RGB, INTEGER, 1, attributes.colour_buffer.target)
	VALUE(BLEND_SRC_ALPHA, INTEGER, 1, attributes.colour_buffer.source_alpha)
	VALUE(BLEND_DST_ALPHA, INTEGER, 1, attributes.colour_buffer.target_alpha)
	VALUE(BLEND_EQUATION, INTEGER, 1, attributes.colour_buffer.equation)
	VALUE(BLEND_EQUATION_ALPHA, INTEGER, 1, attributes.colour_buffer.equation_alpha)
	VALUE(BLEND_COLOR, UNIT_FLOAT, 4, attributes.colour_buffer.constant)
	VALUE(LOGIC_OP_MODE, INTEGER, 1, attributes.colour_buffer.logic_op)
	VALUE(DRAW_BUFFER, INTEGER, 1, attributes.colour_buffer.draw_buffer)
	VALUE(COLOR_CLEAR_VALUE, UNIT_FLOAT, 4, attributes.colour_buffer.clear)
	VALUE(COLOR_WRITEMASK, BOOLEAN, 4, attributes.colour_buffer.mask)
	VALUE(INDEX_CLEAR_VALUE, FLOAT, 1, attributes.colour_buffer.clear_index)
	VALUE(INDEX_WRITEMASK, INTEGER, 1, attributes.colour_buffer.index_mask)

	SAVE(viewport, GL_VIEWPORT_BIT)
	VALUE(VIEWPORT, INTEGER, 4, attributes.viewport.box)
	VALUE(DEPTH_RANGE, UNIT_FLOAT, 2, attributes.viewport.range)

	SAVE(transform, GL_TRANSFORM_BIT)
	CAN(NORMALIZE, transform.normalize)
	CAN(RESCALE_NORMAL, transform.rescale)
	PLANE(0) PLANE(1) PLANE(2) PLANE(3) PLANE(4) PLANE(5)
	VALUE(MATRIX_MODE, INTEGER, 1, attributes.transform.matrix_mode)

	SAVE(scissor, GL_SCISSOR_BIT)
	CAN(SCISSOR_TEST, scissor.test)
	VALUE(SCISSOR_BOX, INTEGER, 4, attributes.scissor.box)

	SAVE(hints, GL_HINT_BIT)
	VALUE(PERSPECTIVE_CORRECTION_HINT, INTEGER, 1, attributes.hints.perspective)
	VALUE(POINT_SMOOTH_HINT, INTEGER, 1, attributes.hints.point)
	VALUE(LINE_SMOOTH_HINT, INTEGER, 1, attributes.hints.line)
	VALUE(POLYGON_SMOOTH_HINT, INTEGER, 1, attributes.hints.polygon)
	VALUE(FOG_HINT, INTEGER, 1, attributes.hints.fog)
	VALUE(GENERATE_MIPMAP_HINT, INTEGER, 1, attributes.hints.mipmap)
	VALUE(TEXTURE_COMPRESSION_HINT, INTEGER, 1, attributes.hints.compression)

	SAVE(texturing, GL_TEXTURE_BIT)
	UNIT_CAN(TEXTURE_1D, enabled[0])
	UNIT_CAN(TEXTURE_2D, enabled[1])
	UNIT_CAN(TEXTURE_3D, enabled[2])
	UNIT_CAN(TEXTURE_CUBE_MAP, enabled[3])
	UNIT_CAN(TEXTURE_RECTANGLE, enabled[4])
	TEXGEN(S, 0) TEXGEN(T, 1) TEXGEN(R, 2) TEXGEN(Q, 3)
	UNIT(TEXTURE_BINDING_1D, INTEGER, 1, texturing.unit[0].bound[0], sizeof(struct gloss_unit))
	UNIT(TEXTURE_BINDING_2D, INTEGER, 1, texturing.unit[0].bound[1], sizeof(struct gloss_unit))
	UNIT(TEXTURE_BINDING_3D, INTEGER, 1, texturing.unit[0].bound[2], sizeof(struct gloss_unit))
	UNIT(TEXTURE_BINDING_RECTANGLE, INTEGER, 1, texturing.unit[0].bound[4],
	     sizeof(struct gloss_unit))
	UNIT(TEXTURE_BINDING_CUBE_MAP, INTEGER, 1, texturing.unit[0].bound[3],
	     sizeof(struct gloss_unit))

	SAVE(evaluating, GL_EVAL_BIT)
	CAN(AUTO_NORMAL, evaluating.auto_normal)
	MAP(COLOR_4, 0) MAP(INDEX, 1) MAP(NORMAL, 2) MAP(TEXTURE_COORD_1, 3)
	MAP(TEXTURE_COORD_2, 4) MAP(TEXTURE_COORD_3, 5) MAP(TEXTURE_COORD_4, 6)
	MAP(VERTEX_3, 7) MAP(VERTEX_4, 8)
	VALUE(MAP1_GRID_SEGMENTS, INTEGER, 1, attributes.evaluating.segments1)
	VALUE(MAP2_GRID_SEGMENTS, INTEGER, 2, attributes.evaluating.segments2)
	VALUE(MAP1_GRID_DOMAIN, FLOAT, 2, attributes.evaluating.grid1)
	VALUE(MAP2_GRID_DOMAIN, FLOAT, 4, attributes.evaluating.grid2)

	SAVE(multisample, GL_MULTISAMPLE_BIT)
	CAN(MULTISAMPLE, multisample.enabled)
	CAN(SAMPLE_ALPHA_TO_COVERAGE, multisample.alpha_to_coverage)
	CAN(SAMPLE_ALPHA_TO_ONE, multisample.alpha_to_one)
	CAN(SAMPLE_COVERAGE, multisample.sample_coverage)
	VALUE(SAMPLE_COVERAGE_VALUE, FLOAT, 1, attributes.multisample.coverage)
	VALUE(SAMPLE_COVERAGE_INVERT, BOOLEAN, 1, attributes.multisample.invert)

	SAVE(list_base, GL_LIST_BIT)
	VALUE(LIST_BASE, INTEGER, 1, attributes.list_base)
	VALUE(LIST_INDEX, INTEGER, 1, compiling.name)
	VALUE(LIST_MODE, INTEGER, 1, compiling.mode)

	SIZED_ARRAY(VERTEX_ARRAY, position)
	ARRAY(NORMAL_ARRAY, normal)
	SIZED_ARRAY(COLOR_ARRAY, colour)
	ARRAY(INDEX_ARRAY, index)
	SIZED_ARRAY(SECONDARY_COLOR_ARRAY, secondary)
	ARRAY(FOG_COORDINATE_ARRAY, fog)
	CLIENT(EDGE_FLAG_ARRAY, edge)
	VALUE(EDGE_FLAG_ARRAY_STRIDE, INTEGER, 1, client.arrays.edge.stride)
	VALUE(EDGE_FLAG_ARRAY_BUFFER_BINDING, INTEGER, 1, client.arrays.edge.buffer)
	TEXCOORD(TEXTURE_COORD_ARRAY, CLIENT_CAPABILITY, enabled)
	TEXCOORD(TEXTURE_COORD_ARRAY_SIZE, INTEGER, size)
	TEXCOORD(TEXTURE_COORD_ARRAY_TYPE, INTEGER, type)
	TEXCOORD(TEXTURE_COORD_ARRAY_STRIDE, INTEGER, stride)
	TEXCOORD(TEXTURE_COORD_ARRAY_BUFFER_BINDING, INTEGER, buffer)
	VALUE(ARRAY_BUFFER_BINDING, INTEGER, 1, client.arrays.array_buffer)
	VALUE(ELEMENT_ARRAY_BUFFER_BINDING, INTEGER, 1, client.arrays.element_buffer)
	VALUE(ARRAY_ELEMENT_LOCK_FIRST_EXT, INTEGER, 1, client.arrays.lock_first)
	VALUE(ARRAY_ELEMENT_LOCK_COUNT_EXT, INTEGER, 1, client.arrays.lock_count)
	STORE(PACK, pack)
	STORE(UNPACK, unpack)

	VALUE(RED_BITS, INTEGER, 1, visual.red)
	VALUE(GREEN_BITS, INTEGER, 1, visual.green)
	VALUE(BLUE_BITS, INTEGER, 1, visual.blue)
	VALUE(ALPHA_BITS, INTEGER, 1, visual.alpha)
	VALUE(DEPTH_BITS, INTEGER, 1, visual.depth)
	VALUE(STENCIL_BITS, INTEGER, 1, visual.stencil)
	VALUE(DOUBLEBUFFER, BOOLEAN, 1, visual.double_buffered)
	VALUE(ATTRIB_STACK_DEPTH, INTEGER, 1, saved_count)
	VALUE(CLIENT_ATTRIB_STACK_DEPTH, INTEGER, 1, saved_client_count)

	IS(INDEX_BITS, 0) IS(AUX_BUFFERS, 0) IS(STEREO, 0) IS(RGBA_MODE, 1) IS(INDEX_MODE, 0)
	IS(ACCUM_RED_BITS, 0) IS(ACCUM_GREEN_BITS, 0) IS(ACCUM_BLUE_BITS, 0)
	IS(ACCUM_ALPHA_BITS, 0) IS(SAMPLE_BUFFERS, 0) IS(SAMPLES, 0) IS(SUBPIXEL_BITS, 4)
	VALUE(RENDER_MODE, INTEGER, 1, render_mode)
	VALUE(NAME_STACK_DEPTH, INTEGER, 1, selection.names)
	VALUE(SELECTION_BUFFER_SIZE, INTEGER, 1, selection.size)
	VALUE(FEEDBACK_BUFFER_SIZE, INTEGER, 1, feedback.size)
	VALUE(FEEDBACK_BUFFER_TYPE, INTEGER, 1, feedback.type)
	IS(MAX_LIGHTS, GLOSS_LIGHTS) IS(MAX_CLIP_PLANES, GLOSS_CLIP_PLANES)
	IS(MAX_MODELVIEW_STACK_DEPTH, GLOSS_MODELVIEW_DEPTH)
	IS(MAX_PROJECTION_STACK_DEPTH, GLOSS_PROJECTION_DEPTH)
	IS(MAX_TEXTURE_STACK_DEPTH, GLOSS_TEXTURE_DEPTH)
	IS(MAX_ATTRIB_STACK_DEPTH, GLOSS_STACK_DEPTH)
	IS(MAX_CLIENT_ATTRIB_STACK_DEPTH, GLOSS_STACK_DEPTH)
	IS(MAX_LIST_NESTING, GLOSS_LIST_NESTING) IS(MAX_TEXTURE_UNITS, GLOSS_UNITS)
	IS(MAX_NAME_STACK_DEPTH, GLOSS_NAME_STACK_DEPTH) IS(MAX_EVAL_ORDER, GLOSS_MAP_ORDER) IS(MAX_PIXEL_MAP_TABLE, GLOSS_PIXEL_MAP_MAX)
	IS(MAX_TEXTURE_SIZE, GLOSS_TEXTURE_SIZE) IS(MAX_3D_TEXTURE_SIZE, GLOSS_TEXTURE_3D_SIZE)
	IS(MAX_CUBE_MAP_TEXTURE_SIZE, GLOSS_TEXTURE_CUBE_SIZE)
	IS(MAX_RECTANGLE_TEXTURE_SIZE, GLOSS_TEXTURE_SIZE)
	IS(MAX_ELEMENTS_VERTICES, 65536) IS(MAX_ELEMENTS_INDICES, 65536)
	IS(NUM_COMPRESSED_TEXTURE_FORMATS, 0)
};
/* clang-format on */

const unsigned int gloss_table_rows = sizeof(gloss_table) / sizeof(gloss_table[0]);

/* Rows by name: open addressing, 0 is an empty place and a row's place is its number + 1. */
#define PLACES 1024u
static uint16_t table_place[PLACES];
static pthread_once_t table_once = PTHREAD_ONCE_INIT;

static unsigned int table_hash(GLenum name)
{
	return (name * 0x9e3779b1u) >> 22;
}

static void table_index(void)
{
	for (unsigned int i = 0; i < gloss_table_rows; i++) {
		unsigned int place = table_hash(gloss_table[i].name);

		if (gloss_table[i].kind == GLOSS_BYTES)
			continue;
		while (table_place[place])
			place = (place + 1) % PLACES;
		table_place[place] = (uint16_t)(i + 1);
	}
}

const struct gloss_row *gloss_table_find(GLenum name)
{
	unsigned int place = table_hash(name);

	pthread_once(&table_once, table_index);
	for (; table_place[place]; place = (place + 1) % PLACES)
		if (gloss_table[table_place[place] - 1].name == name)
			return &gloss_table[table_place[place] - 1];
	return NULL;
}

void *gloss_row_at(struct gloss_context *context, const struct gloss_row *row)
{
	uint32_t unit = 0;

	if (row->kind == GLOSS_CONSTANT)
		return NULL;
	if (row->unit == GLOSS_UNIT_ACTIVE)
		unit = (uint32_t)context->attributes.texturing.active;
	else if (row->unit == GLOSS_UNIT_CLIENT)
		unit = (uint32_t)context->client.arrays.active;
	return (char *)context + row->offset + unit * row->stride;
}
