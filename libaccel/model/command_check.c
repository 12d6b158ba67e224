// SPDX-License-Identifier: MIT
/*
 * Is a packet right? The order of checks is that of gloss.xml, because the first
 * failure is the one reported: the header, then the payload word by word.
 */
#include "model.h"

enum place { ANYWHERE, BETWEEN_TILES, INSIDE_TILE };

/* Checks the payload. @packet starts at the header; *@word is the faulty word, counted from it. */
typedef enum gloss_fault (*check_fn)(const struct model *model, const uint32_t *packet,
				     uint32_t *word);

struct rule {
	uint32_t words_min, words_max; /* of triangles: one length, by their flags */
	enum place place;
	check_fn payload; /* NULL: nothing can be wrong with it */
};

static bool room(const struct model *model, uint32_t used, uint32_t words)
{
	return words <= model->job->response_words - used;
}

/* Bytes of a row of a tile: what offsets and pitches are multiples of. */
static uint32_t row_bytes(const struct model *model)
{
	return 4 * (uint32_t)model->tile_size;
}

static uint32_t tile_words(const struct model *model)
{
	return (uint32_t)(model->tile_size * model->tile_size);
}

static enum gloss_fault check_write_memory(const struct model *model, const uint32_t *packet,
					   uint32_t *word)
{
	struct gloss_write_memory p;
	uint32_t bytes = 4 * (gloss_header_length(packet[0]) - GLOSS_WRITE_MEMORY_WORDS);

	*word = 1;
	if (gloss_write_memory_invalid(packet + 1) >= 0)
		return GLOSS_FAULT_VALUE;
	*word = 2;
	gloss_write_memory_unpack(packet, &p);
	if (p.offset % 4)
		return GLOSS_FAULT_VALUE;
	if (!model_memory_allows(model, p.slot, GLOSS_RIGHTS_WRITE, p.offset, bytes))
		return GLOSS_FAULT_SLOT;
	return GLOSS_FAULT_NONE;
}

static enum gloss_fault check_read_memory(const struct model *model, const uint32_t *packet,
					  uint32_t *word)
{
	struct gloss_read_memory p;

	*word = 1;
	if (gloss_read_memory_invalid(packet + 1) >= 0)
		return GLOSS_FAULT_VALUE;
	*word = 2;
	gloss_read_memory_unpack(packet, &p);
	if (p.offset % 4)
		return GLOSS_FAULT_VALUE;
	if (!model_memory_allows(model, p.slot, GLOSS_RIGHTS_READ, p.offset, 4 * p.count))
		return GLOSS_FAULT_SLOT;
	if (!room(model, model->response_used, p.count))
		return GLOSS_FAULT_RESPONSE;
	return GLOSS_FAULT_NONE;
}

static enum gloss_fault check_counters(const struct model *model, const uint32_t *packet,
				       uint32_t *word)
{
	(void)packet;
	*word = 0;
	return room(model, model->response_used, GLOSS_COUNTER_WORDS) ? GLOSS_FAULT_NONE :
									GLOSS_FAULT_RESPONSE;
}

static enum gloss_fault check_colour_surface(const struct model *model, const uint32_t *packet,
					     uint32_t *word)
{
	struct gloss_colour_surface p;

	*word = 1;
	gloss_colour_surface_unpack(packet, &p);
	return gloss_colour_surface_invalid(packet + 1) >= 0 || p.pitch % row_bytes(model) ?
		       GLOSS_FAULT_VALUE :
		       GLOSS_FAULT_NONE;
}

static enum gloss_fault check_depth_surface(const struct model *model, const uint32_t *packet,
					    uint32_t *word)
{
	struct gloss_depth_surface p;

	*word = 1;
	gloss_depth_surface_unpack(packet, &p);
	return gloss_depth_surface_invalid(packet + 1) >= 0 || p.pitch % row_bytes(model) ?
		       GLOSS_FAULT_VALUE :
		       GLOSS_FAULT_NONE;
}

/* A tile at @offset of a surface. */
static enum gloss_fault check_tile(const struct model *model, const struct model_target *target,
				   enum gloss_rights right, uint32_t offset)
{
	uint32_t rows = (uint32_t)model->tile_size - 1;

	if (offset % row_bytes(model))
		return GLOSS_FAULT_VALUE;
	if (!target->pitch)
		return GLOSS_FAULT_ORDER;
	if (!model_memory_allows(model, target->slot, right, offset,
				 rows * target->pitch + row_bytes(model)))
		return GLOSS_FAULT_SLOT;
	return GLOSS_FAULT_NONE;
}

static enum gloss_fault check_tile_begin(const struct model *model, const uint32_t *packet,
					 uint32_t *word)
{
	enum gloss_fault fault = GLOSS_FAULT_NONE;
	struct gloss_tile_begin p;

	gloss_tile_begin_unpack(packet, &p);
	*word = 1;
	if (p.colour_load)
		fault = check_tile(model, &model->state.colour_surface, GLOSS_RIGHTS_READ,
				   p.colour);
	if (fault)
		return fault;
	*word = 2;
	if (p.depth_load)
		fault = check_tile(model, &model->state.depth_surface, GLOSS_RIGHTS_READ, p.depth);
	return fault;
}

/* @used: response words that come before this output's answer. */
static enum gloss_fault check_output(const struct model *model, enum gloss_tile_output output,
				     const struct model_target *target, uint32_t offset,
				     uint32_t used)
{
	if (output == GLOSS_TILE_OUTPUT_STORE)
		return check_tile(model, target, GLOSS_RIGHTS_WRITE, offset);
	if (offset)
		return GLOSS_FAULT_VALUE;
	if (output == GLOSS_TILE_OUTPUT_ANSWER && !room(model, used, tile_words(model)))
		return GLOSS_FAULT_RESPONSE;
	return GLOSS_FAULT_NONE;
}

static enum gloss_fault check_tile_end(const struct model *model, const uint32_t *packet,
				       uint32_t *word)
{
	enum gloss_fault fault;
	struct gloss_tile_end p;
	uint32_t used = model->response_used;

	gloss_tile_end_unpack(packet, &p);
	*word = 1;
	fault = check_output(model, p.colour_output, &model->state.colour_surface, p.colour, used);
	if (fault)
		return fault;
	*word = 2;
	if (p.colour_output == GLOSS_TILE_OUTPUT_ANSWER)
		used += tile_words(model);
	return check_output(model, p.depth_output, &model->state.depth_surface, p.depth, used);
}

static enum gloss_fault check_scissor(const struct model *model, const uint32_t *packet,
				      uint32_t *word)
{
	struct gloss_scissor p;
	uint32_t size = (uint32_t)model->tile_size;

	*word = 1;
	gloss_scissor_unpack(packet, &p);
	return gloss_scissor_invalid(packet + 1) >= 0 || p.x0 > size || p.y0 > size ||
			       p.x1 > size || p.y1 > size ?
		       GLOSS_FAULT_VALUE :
		       GLOSS_FAULT_NONE;
}

/* The first of the edges' words that is wrong, or -1. */
static int edges_invalid(const uint32_t *words, enum gloss_geometry geometry, uint32_t tile_size)
{
	struct gloss_edges_wide wide;
	struct gloss_edges_compact compact;
	int invalid, rows_word;
	bool rows_valid;

	if (geometry == GLOSS_GEOMETRY_WIDE) {
		gloss_edges_wide_unpack(words, &wide);
		invalid = gloss_edges_wide_invalid(words);
		rows_word = 2;
		rows_valid = wide.first_row + wide.last_row < tile_size;
	} else {
		gloss_edges_compact_unpack(words, &compact);
		invalid = gloss_edges_compact_invalid(words);
		rows_word = 1;
		rows_valid = compact.first_row + compact.last_row < tile_size;
	}
	if (!rows_valid && (invalid < 0 || invalid > rows_word))
		return rows_word;
	return invalid;
}

/* Only values can be wrong: the first such word of any part is the fault. */
static enum gloss_fault check_triangle(const struct model *model, const uint32_t *packet,
				       uint32_t *word)
{
	struct gloss_triangle p;
	uint32_t at = 1;
	int invalid = -1;

	gloss_triangle_unpack(packet, &p);
	if (p.geometry != GLOSS_GEOMETRY_COVERING) {
		invalid = edges_invalid(packet + at, p.geometry, (uint32_t)model->tile_size);
		if (invalid >= 0)
			goto found;
		at += p.geometry == GLOSS_GEOMETRY_WIDE ? GLOSS_EDGES_WIDE_WORDS :
							  GLOSS_EDGES_COMPACT_WORDS;
	}
	if (p.geometry == GLOSS_GEOMETRY_COMPACT) {
		at += GLOSS_DEPTH_COMPACT_WORDS;
	} else {
		invalid = gloss_depth_wide_invalid(packet + at);
		if (invalid >= 0)
			goto found;
		at += GLOSS_DEPTH_WIDE_WORDS;
	}
	if (p.alpha_linear)
		at += GLOSS_ALPHA_LINEAR_WORDS;
	if (p.shading == GLOSS_SHADING_FLAT)
		invalid = gloss_colour_flat_invalid(packet + at);
found:
	*word = at + (uint32_t)invalid;
	return invalid < 0 ? GLOSS_FAULT_NONE : GLOSS_FAULT_VALUE;
}

/* Rows that a small record has words for. */
static uint32_t rows_sent(const struct gloss_triangle_small *p)
{
	return GLOSS_SMALL_HEAD_ROWS + GLOSS_SMALL_WORD_ROWS * (uint32_t)p->row_words;
}

static enum gloss_fault check_triangle_small(const struct model *model, const uint32_t *packet,
					     uint32_t *word)
{
	struct gloss_triangle_small p;
	struct gloss_pixels_small pixels;

	*word = 1;
	gloss_triangle_small_unpack(packet, &p);
	gloss_pixels_small_unpack(packet + 1, &pixels);
	if (pixels.first_row + pixels.last_row >= (uint32_t)model->tile_size ||
	    pixels.last_row >= rows_sent(&p))
		return GLOSS_FAULT_VALUE;
	*word += GLOSS_PIXELS_SMALL_WORDS + GLOSS_DEPTH_SMALL_WORDS;
	if (p.shading == GLOSS_SHADING_FLAT && gloss_colour_flat_invalid(packet + *word) >= 0)
		return GLOSS_FAULT_VALUE;
	return GLOSS_FAULT_NONE;
}

#define FIXED(words) (words), (words)

static const struct rule rules[] = {
	[GLOSS_OP_NOP] = { 0, GLOSS_LENGTH_MAX, ANYWHERE, NULL },
	[GLOSS_OP_WRITE_MEMORY] = { GLOSS_WRITE_MEMORY_WORDS + 1, GLOSS_LENGTH_MAX, BETWEEN_TILES,
				    check_write_memory },
	[GLOSS_OP_READ_MEMORY] = { FIXED(GLOSS_READ_MEMORY_WORDS), BETWEEN_TILES,
				   check_read_memory },
	[GLOSS_OP_COUNTERS] = { FIXED(GLOSS_COUNTERS_WORDS), BETWEEN_TILES, check_counters },
	[GLOSS_OP_COLOUR_SURFACE] = { FIXED(GLOSS_COLOUR_SURFACE_WORDS), ANYWHERE,
				      check_colour_surface },
	[GLOSS_OP_DEPTH_SURFACE] = { FIXED(GLOSS_DEPTH_SURFACE_WORDS), ANYWHERE,
				     check_depth_surface },
	[GLOSS_OP_TILE_BEGIN] = { FIXED(GLOSS_TILE_BEGIN_WORDS), BETWEEN_TILES, check_tile_begin },
	[GLOSS_OP_TILE_END] = { FIXED(GLOSS_TILE_END_WORDS), INSIDE_TILE, check_tile_end },
	[GLOSS_OP_DEPTH_STATE] = { FIXED(GLOSS_DEPTH_STATE_WORDS), ANYWHERE, NULL },
	[GLOSS_OP_COLOUR_MASK] = { FIXED(GLOSS_COLOUR_MASK_WORDS), ANYWHERE, NULL },
	[GLOSS_OP_SCISSOR] = { FIXED(GLOSS_SCISSOR_WORDS), ANYWHERE, check_scissor },
	[GLOSS_OP_TRIANGLE] = { 0, 0, INSIDE_TILE, check_triangle },
	[GLOSS_OP_TRIANGLE_SMALL] = { 0, 0, INSIDE_TILE, check_triangle_small },
};

static bool length_valid(const struct rule *rule, uint32_t header)
{
	uint32_t length = gloss_header_length(header);
	struct gloss_triangle_small small;
	struct gloss_triangle p;

	switch (gloss_header_opcode(header)) {
	case GLOSS_OP_TRIANGLE:
		gloss_triangle_unpack(&header, &p);
		return length == gloss_triangle_length(&p);
	case GLOSS_OP_TRIANGLE_SMALL:
		gloss_triangle_small_unpack(&header, &small);
		return length == gloss_triangle_small_length(&small);
	default:
		return length >= rule->words_min && length <= rule->words_max;
	}
}

static bool place_valid(enum place place, bool in_tile)
{
	return place == ANYWHERE || (place == INSIDE_TILE) == in_tile;
}

enum gloss_fault model_command_check(const struct model *model, uint32_t at, uint32_t *word)
{
	const uint32_t *packet = model->job->stream + (at - model->stream_from);
	const struct rule *rule;

	*word = 0;
	if (!gloss_opcode_known(gloss_header_opcode(packet[0])))
		return GLOSS_FAULT_OPCODE;
	if (!gloss_header_valid(packet[0]))
		return GLOSS_FAULT_VALUE;
	rule = &rules[gloss_header_opcode(packet[0])];
	if (!length_valid(rule, packet[0]) ||
	    gloss_header_length(packet[0]) >= model->job->stream_words - at)
		return GLOSS_FAULT_LENGTH;
	if (!place_valid(rule->place, model->in_tile))
		return GLOSS_FAULT_ORDER;
	return rule->payload ? rule->payload(model, packet, word) : GLOSS_FAULT_NONE;
}
