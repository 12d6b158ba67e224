// SPDX-License-Identifier: MIT
/* Walks and checks a stream. What the table knows is checked from it; alignment, tile size and
 * order are by hand here, as in the core. */
#include <inttypes.h>
#include <stdarg.h>

#include "decode/decode.h"
#include "decode/gloss_table.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

__attribute__((format(printf, 4, 5))) static void fail(struct decode_packet *packet,
						       enum gloss_fault fault, unsigned int word,
						       const char *format, ...)
{
	va_list arguments;

	packet->fault = fault;
	packet->fault_offset = packet->offset + word;
	va_start(arguments, format);
	vsnprintf(packet->reason, sizeof(packet->reason), format, arguments);
	va_end(arguments);
}

static const struct table_packet *find_packet(unsigned int opcode)
{
	for (size_t i = 0; i < COUNT(table_packets); i++) {
		if (table_packets[i].opcode == opcode)
			return &table_packets[i];
	}
	return NULL;
}

const char *decode_fault_name(enum gloss_fault fault)
{
	for (unsigned int i = 0; i < table_enum_fault.count; i++) {
		if (table_enum_fault.values[i].value == fault)
			return table_enum_fault.values[i].name;
	}
	return "unknown";
}

static uint32_t field_mask(unsigned int high, unsigned int low)
{
	return (uint32_t)((UINT64_C(1) << (high - low + 1)) - 1);
}

int64_t decode_field(const struct table_field *field, uint32_t word)
{
	uint32_t mask = field_mask(field->high, field->low);
	int64_t value = word >> field->low & mask;

	if (field->type == TABLE_INT && value > mask / 2)
		value -= (int64_t)mask + 1;
	return value;
}

static bool has_part(const struct table_part *part, uint32_t header)
{
	return part->always ||
	       (header >> part->low & field_mask(part->high, part->low)) == part->value;
}

unsigned int decode_runs(const struct table_packet *type, uint32_t header,
			 struct decode_run runs[DECODE_RUNS_MAX])
{
	unsigned int count = 0, word = 1 + type->record.words;

	runs[count++] = (struct decode_run){ &type->record, 0, word };
	for (unsigned int i = 0; i < type->count && count < DECODE_RUNS_MAX; i++) {
		if (!has_part(&type->parts[i], header))
			continue;
		runs[count++] = (struct decode_run){ type->parts[i].group, word,
						     type->parts[i].group->words };
		word += type->parts[i].group->words;
	}
	return count;
}

/* ---- the header ---- */

/* Bits of a word that are not reserved; of a header, the opcode and length too. */
static uint32_t known_bits(const struct decode_run *run, unsigned int word)
{
	uint32_t mask = run->word == 0 && word == 0 ? 0xff000000u | GLOSS_LENGTH_MAX : 0;

	for (unsigned int i = 0; i < run->record->count; i++) {
		const struct table_field *field = &run->record->fields[i];

		if (field->word == word)
			mask |= field_mask(field->high, field->low) << field->low;
	}
	return mask;
}

static bool is_value(const struct table_enum *enumeration, int64_t number)
{
	for (unsigned int i = 0; i < enumeration->count; i++) {
		if (enumeration->values[i].value == number)
			return true;
	}
	return false;
}

/* Reserved bits and ranges of word @word of a run. */
static void check_fields(struct decode_packet *packet, const struct decode_run *run,
			 unsigned int word)
{
	uint32_t bits = packet->words[run->word + word];
	uint32_t reserved = bits & ~known_bits(run, word);

	if (reserved) {
		fail(packet, GLOSS_FAULT_VALUE, run->word + word,
		     "reserved bits of %s are set: 0x%08" PRIx32, run->record->name, reserved);
		return;
	}
	for (unsigned int i = 0; i < run->record->count && !packet->fault; i++) {
		const struct table_field *field = &run->record->fields[i];
		int64_t value = decode_field(field, bits);

		if (field->word != word)
			continue;
		if (value < field->min || value > field->max)
			fail(packet, GLOSS_FAULT_VALUE, run->word + word,
			     "%s is %" PRId64 ", not %" PRId64 " to %" PRId64, field->name, value,
			     field->min, field->max);
		else if (field->type == TABLE_ENUM && !is_value(field->enumeration, value))
			fail(packet, GLOSS_FAULT_VALUE, run->word + word,
			     "%s is %" PRId64 ", which is no %s", field->name, value,
			     field->enumeration->name);
	}
}

static void check_length(struct decode_packet *packet, const struct decode_run *last)
{
	unsigned int length = gloss_header_length(packet->words[0]);
	unsigned int words = last->word + last->words - 1;
	bool open = packet->type->variable && !packet->type->count;

	if (open && length < packet->type->least)
		fail(packet, GLOSS_FAULT_LENGTH, 0, "%s has %u payload words, at least %u are due",
		     packet->type->record.name, length, packet->type->least);
	else if (!open && length != words)
		fail(packet, GLOSS_FAULT_LENGTH, 0, "%s has %u payload words, %u are due",
		     packet->type->record.name, length, words);
}

/* Where a packet may be. */
static void check_place(const struct decode *decode, struct decode_packet *packet)
{
	switch (packet->type->opcode) {
	case GLOSS_OP_WRITE_MEMORY:
	case GLOSS_OP_READ_MEMORY:
	case GLOSS_OP_COUNTERS:
	case GLOSS_OP_TILE_BEGIN:
		if (decode->in_tile)
			fail(packet, GLOSS_FAULT_ORDER, 0, "%s inside a tile",
			     packet->type->record.name);
		break;
	case GLOSS_OP_TILE_END:
	case GLOSS_OP_TRIANGLE:
	case GLOSS_OP_TRIANGLE_SMALL:
		if (!decode->in_tile)
			fail(packet, GLOSS_FAULT_ORDER, 0, "%s without an open tile",
			     packet->type->record.name);
		break;
	default:
		break;
	}
}

/* ---- payload words, by hand ---- */

/* What a row of the smaller possible tile has, and the larger one's edge. */
static uint32_t row_bytes(const struct decode *decode)
{
	return 4 * (decode->tile_size ? decode->tile_size : 32);
}

static uint32_t tile_edge(const struct decode *decode)
{
	return decode->tile_size ? decode->tile_size : 64;
}

static void check_aligned(struct decode_packet *packet, unsigned int word, const char *name,
			  uint32_t value, uint32_t align)
{
	if (value % align)
		fail(packet, GLOSS_FAULT_VALUE, word,
		     "%s 0x%" PRIx32 " is not a multiple of %" PRIu32, name, value, align);
}

/* The offset of a tile that is loaded or stored. */
static void check_surface(const struct decode *decode, struct decode_packet *packet,
			  unsigned int word, uint32_t offset)
{
	bool set = word == 1 ? decode->colour_surface : decode->depth_surface;
	const char *name = word == 1 ? "colour" : "depth";

	check_aligned(packet, word, name, offset, row_bytes(decode));
	if (!packet->fault && !set)
		fail(packet, GLOSS_FAULT_ORDER, word, "no %s_surface was set", name);
}

static void check_colour_pitch(const struct decode *decode, struct decode_packet *packet)
{
	struct gloss_colour_surface p;

	gloss_colour_surface_unpack(packet->words, &p);
	check_aligned(packet, 1, "pitch", p.pitch, row_bytes(decode));
}

static void check_depth_pitch(const struct decode *decode, struct decode_packet *packet)
{
	struct gloss_depth_surface p;

	gloss_depth_surface_unpack(packet->words, &p);
	check_aligned(packet, 1, "pitch", p.pitch, row_bytes(decode));
}

static void check_tile_begin(const struct decode *decode, struct decode_packet *packet,
			     unsigned int word)
{
	struct gloss_tile_begin p;

	gloss_tile_begin_unpack(packet->words, &p);
	if (word == 1 ? p.colour_load : p.depth_load)
		check_surface(decode, packet, word, packet->words[word]);
}

static void check_tile_end(const struct decode *decode, struct decode_packet *packet,
			   unsigned int word)
{
	struct gloss_tile_end p;

	gloss_tile_end_unpack(packet->words, &p);
	if ((word == 1 ? p.colour_output : p.depth_output) == GLOSS_TILE_OUTPUT_STORE)
		check_surface(decode, packet, word, packet->words[word]);
	else if (packet->words[word])
		fail(packet, GLOSS_FAULT_VALUE, word,
		     "%s is 0x%" PRIx32 ", not zero as without store",
		     word == 1 ? "colour" : "depth", packet->words[word]);
}

static void check_scissor(const struct decode *decode, struct decode_packet *packet)
{
	struct gloss_scissor p;

	gloss_scissor_unpack(packet->words, &p);
	if (p.x0 > tile_edge(decode) || p.y0 > tile_edge(decode) || p.x1 > tile_edge(decode) ||
	    p.y1 > tile_edge(decode))
		fail(packet, GLOSS_FAULT_VALUE, 1, "a scissor edge is past the tile of %" PRIu32,
		     tile_edge(decode));
}

static void check_rows_in_tile(const struct decode *decode, struct decode_packet *packet,
			       unsigned int word, uint32_t first, uint32_t last)
{
	if (first + last >= tile_edge(decode))
		fail(packet, GLOSS_FAULT_VALUE, word,
		     "first_row %" PRIu32 " + last_row %" PRIu32 " is past the tile of %" PRIu32,
		     first, last, tile_edge(decode));
}

static void check_rows(const struct decode *decode, struct decode_packet *packet, unsigned int word)
{
	struct gloss_edges_compact compact;
	struct gloss_edges_wide wide;
	struct gloss_triangle p;
	uint32_t first, last;

	gloss_triangle_unpack(packet->words, &p);
	if (p.geometry == GLOSS_GEOMETRY_WIDE && word == 3) {
		gloss_edges_wide_unpack(packet->words + 1, &wide);
		first = wide.first_row;
		last = wide.last_row;
	} else if (p.geometry == GLOSS_GEOMETRY_COMPACT && word == 2) {
		gloss_edges_compact_unpack(packet->words + 1, &compact);
		first = compact.first_row;
		last = compact.last_row;
	} else {
		return;
	}
	check_rows_in_tile(decode, packet, word, first, last);
}

static void check_rows_small(const struct decode *decode, struct decode_packet *packet)
{
	struct gloss_pixels_small pixels;
	struct gloss_triangle_small p;
	uint32_t sent;

	gloss_triangle_small_unpack(packet->words, &p);
	gloss_pixels_small_unpack(packet->words + 1, &pixels);
	sent = GLOSS_SMALL_HEAD_ROWS + GLOSS_SMALL_WORD_ROWS * (uint32_t)p.row_words;
	check_rows_in_tile(decode, packet, 1, pixels.first_row, pixels.last_row);
	if (!packet->fault && pixels.last_row >= sent)
		fail(packet, GLOSS_FAULT_VALUE, 1,
		     "last_row %" PRIu32 " is past the %" PRIu32 " rows that are sent",
		     pixels.last_row, sent);
}

static void check_by_hand(const struct decode *decode, struct decode_packet *packet,
			  unsigned int word)
{
	switch (packet->type->opcode) {
	case GLOSS_OP_WRITE_MEMORY:
	case GLOSS_OP_READ_MEMORY:
		if (word == 2)
			check_aligned(packet, word, "offset", packet->words[word], 4);
		break;
	case GLOSS_OP_COLOUR_SURFACE:
		check_colour_pitch(decode, packet);
		break;
	case GLOSS_OP_DEPTH_SURFACE:
		check_depth_pitch(decode, packet);
		break;
	case GLOSS_OP_TILE_BEGIN:
		check_tile_begin(decode, packet, word);
		break;
	case GLOSS_OP_TILE_END:
		check_tile_end(decode, packet, word);
		break;
	case GLOSS_OP_SCISSOR:
		check_scissor(decode, packet);
		break;
	case GLOSS_OP_TRIANGLE:
		check_rows(decode, packet, word);
		break;
	case GLOSS_OP_TRIANGLE_SMALL:
		if (word == 1)
			check_rows_small(decode, packet);
		break;
	default:
		break;
	}
}

/* ---- packets ---- */

/* Checks up to the order of packets; the payload is all there if that finds no fault. */
static void check_header(const struct decode *decode, struct decode_packet *packet, size_t count)
{
	struct decode_run runs[DECODE_RUNS_MAX];
	unsigned int length = gloss_header_length(packet->words[0]);

	packet->type = find_packet(gloss_header_opcode(packet->words[0]));
	packet->count = 1;
	if (!packet->type) {
		fail(packet, GLOSS_FAULT_OPCODE, 0, "no packet has the opcode 0x%02x",
		     gloss_header_opcode(packet->words[0]));
		return;
	}
	check_fields(packet, &(struct decode_run){ &packet->type->record, 0, 1 }, 0);
	if (packet->fault)
		return;
	check_length(packet, &runs[decode_runs(packet->type, packet->words[0], runs) - 1]);
	if (packet->fault)
		return;
	packet->count = length < count ? length + 1 : count;
	if (length >= count)
		fail(packet, GLOSS_FAULT_LENGTH, 0,
		     "%s has %u payload words, and the stream ends after %zu",
		     packet->type->record.name, length, count - 1);
	else
		check_place(decode, packet);
}

static void check_payload(const struct decode *decode, struct decode_packet *packet)
{
	struct decode_run runs[DECODE_RUNS_MAX];
	unsigned int count = decode_runs(packet->type, packet->words[0], runs);

	for (unsigned int i = 0; i < count; i++) {
		for (unsigned int word = i ? 0 : 1; word < runs[i].words; word++) {
			check_fields(packet, &runs[i], word);
			if (!packet->fault)
				check_by_hand(decode, packet, runs[i].word + word);
			if (!packet->fault)
				continue;
			packet->count = (size_t)runs[i].word + word + 1;
			return;
		}
	}
}

static void take_effect(struct decode *decode, const struct decode_packet *packet)
{
	switch (packet->type->opcode) {
	case GLOSS_OP_COLOUR_SURFACE:
		decode->colour_surface = true;
		break;
	case GLOSS_OP_DEPTH_SURFACE:
		decode->depth_surface = true;
		break;
	case GLOSS_OP_TILE_BEGIN:
		decode->in_tile = true;
		break;
	case GLOSS_OP_TILE_END:
		decode->in_tile = false;
		break;
	default:
		break;
	}
	decode->offset += packet->count;
}

void decode_init(struct decode *decode, unsigned int tile_size)
{
	*decode = (struct decode){ .tile_size = tile_size };
}

bool decode_next(struct decode *decode, const uint32_t *words, size_t count,
		 struct decode_packet *packet)
{
	*packet = (struct decode_packet){ .offset = decode->offset, .words = words };
	if (!count) {
		if (decode->in_tile)
			fail(packet, GLOSS_FAULT_ORDER, 0, "the stream ends inside a tile");
		return false;
	}
	check_header(decode, packet, count);
	if (!packet->fault)
		check_payload(decode, packet);
	if (!packet->fault)
		take_effect(decode, packet);
	return true;
}

enum gloss_fault decode_stream(const uint32_t *words, size_t count, unsigned int tile_size,
			       struct decode_packet *last)
{
	struct decode decode;

	decode_init(&decode, tile_size);
	while (decode_next(&decode, words, count, last) && !last->fault) {
		words += last->count;
		count -= last->count;
	}
	return last->fault;
}
