// SPDX-License-Identifier: MIT
#include "grammar_coverage.h"

#include <inttypes.h>
#include <stdio.h>

#include "decode/decode.h"

static const char *const kind_names[GRAMMAR_KINDS] = { "sound", "wild", "damaged", "opcode",
						       "reserved" };

static bool is_choice(const struct table_field *field)
{
	return field->word == 0 && (field->type == TABLE_ENUM || field->type == TABLE_BOOL);
}

static uint32_t field_bits(uint32_t word, unsigned int high, unsigned int low)
{
	return word >> low & ~0u >> (31 - (high - low));
}

static void add_packet(struct grammar_coverage *coverage, uint32_t index,
		       const struct table_packet *packet, uint32_t header)
{
	coverage->packets[index]++;
	for (uint32_t n = 0; n < packet->record.count && n < COVERAGE_FIELDS; n++) {
		const struct table_field *field = &packet->record.fields[n];

		if (is_choice(field))
			coverage->values[index][n] |= 1u << field_bits(header, field->high,
								       field->low);
	}
	for (uint32_t n = 0; n < packet->count; n++) {
		const struct table_part *part = &packet->parts[n];

		if (part->always || field_bits(header, part->high, part->low) == part->value)
			coverage->parts[index] |= 1u << n;
	}
}

void grammar_coverage_add(struct grammar_coverage *coverage, const struct grammar *g,
			  const struct gloss_status *status)
{
	uint32_t end = status->cause ? status->offset : g->job.stream_words, count;
	const struct table_packet *packets = grammar_packets(&count);

	coverage->jobs[g->kind]++;
	coverage->faults[status->cause]++;
	coverage->opcodes += g->kind == GRAMMAR_OPCODE;
	coverage->reserved += g->kind == GRAMMAR_RESERVED;
	/* In the others the stream is no longer what was noted. */
	if (g->kind != GRAMMAR_SOUND && g->kind != GRAMMAR_WILD)
		return;
	for (uint32_t n = 0; n < g->records; n++) {
		const struct grammar_record *record = &g->record[n];
		uint32_t header = g->words[record->at];

		if (record->packet && record->at + 1 + (header & GLOSS_LENGTH_MAX) <= end)
			add_packet(coverage, (uint32_t)(record->packet - packets), record->packet,
				   header);
	}
}

/* ---- what was not reached ---- */

static bool missing(const char *packet, const char *what, const char *which)
{
	printf("test_grammar: never reached: %s%s%s%s%s\n", packet, *packet ? " with " : "", what,
	       *which ? " " : "", which);
	return false;
}

static bool check_field(const struct table_packet *packet, const struct table_field *field,
			uint32_t values)
{
	bool all = true;

	if (field->type == TABLE_BOOL) {
		for (uint32_t value = 0; value < 2; value++)
			if (!(values >> value & 1))
				all = missing(packet->record.name, field->name,
					      value ? "yes" : "no");
		return all;
	}
	for (uint32_t n = 0; n < field->enumeration->count; n++)
		if (!(values >> field->enumeration->values[n].value & 1))
			all = missing(packet->record.name, field->name,
				      field->enumeration->values[n].name);
	return all;
}

static bool check_packet(const struct grammar_coverage *coverage, uint32_t index,
			 const struct table_packet *packet)
{
	bool all = true;

	if (!coverage->packets[index])
		return missing("", packet->record.name, "");
	for (uint32_t n = 0; n < packet->record.count && n < COVERAGE_FIELDS; n++)
		if (is_choice(&packet->record.fields[n]))
			all &= check_field(packet, &packet->record.fields[n],
					   coverage->values[index][n]);
	for (uint32_t n = 0; n < packet->count; n++)
		if (!(coverage->parts[index] >> n & 1))
			all = missing(packet->record.name, packet->parts[n].group->name, "");
	return all;
}

/* MEMORY and DMA are faults of the board and the port, not of a stream. */
static bool check_faults(const struct grammar_coverage *coverage)
{
	bool all = true;

	for (uint32_t n = 0; n < GLOSS_FAULT_MEMORY; n++)
		if (!coverage->faults[n])
			all = missing("", "fault", decode_fault_name((enum gloss_fault)n));
	return all;
}

void grammar_coverage_print(const struct grammar_coverage *coverage)
{
	uint32_t count;
	const struct table_packet *packets = grammar_packets(&count);

	printf("  jobs:");
	for (uint32_t n = 0; n < GRAMMAR_KINDS; n++)
		printf(" %s %" PRIu64, kind_names[n], coverage->jobs[n]);
	printf("\n  faults:");
	for (uint32_t n = 0; n < GLOSS_FAULT_MEMORY; n++)
		printf(" %s %" PRIu64, decode_fault_name((enum gloss_fault)n), coverage->faults[n]);
	printf("\n  packets executed:");
	for (uint32_t n = 0; n < count; n++)
		printf(" %s %" PRIu64, packets[n].record.name, coverage->packets[n]);
	printf("\n  opcodes written: %" PRIu64 " of 256, reserved bits set: %" PRIu64 " of %u\n",
	       coverage->opcodes < 256 ? coverage->opcodes : 256,
	       coverage->reserved < grammar_reserved_bits() ? coverage->reserved :
							      grammar_reserved_bits(),
	       grammar_reserved_bits());
}

bool grammar_coverage_check(const struct grammar_coverage *coverage)
{
	uint32_t count;
	const struct table_packet *packets = grammar_packets(&count);
	bool all = check_faults(coverage);

	for (uint32_t n = 0; n < count; n++)
		all &= check_packet(coverage, n, &packets[n]);
	if (coverage->opcodes < 256)
		all = missing("", "some opcode", "");
	if (coverage->reserved < grammar_reserved_bits())
		all = missing("", "some reserved bit", "");
	return all;
}
