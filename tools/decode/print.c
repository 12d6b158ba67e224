// SPDX-License-Identifier: MIT
/* Prints packets in names. */
#include <ctype.h>
#include <inttypes.h>

#include "decode/decode.h"

#define DATA_WORDS 8 /* a line of words without names */

static void print_upper(FILE *out, const char *name)
{
	for (; *name; name++)
		fputc(toupper((unsigned char)*name), out);
}

static void print_start(FILE *out, uint64_t offset, uint32_t word)
{
	fprintf(out, "%7" PRIu64 "  %08" PRIx32, offset, word);
}

/* A two's complement number of @bits with @fraction of them behind the point, rounded to as
 * many digits as tell all its values apart to the eye. */
static void print_fixed(FILE *out, uint64_t bits, unsigned int width, unsigned int fraction)
{
	int64_t value = (int64_t)(bits << (64 - width)) >> (64 - width);
	double scaled = (double)value / (double)(UINT64_C(1) << fraction);

	fprintf(out, "%.*f", (int)(fraction * 3 + 9) / 10, scaled);
}

/* @words: those of the record, @count of them there. Without its rest a field is only bits. */
static void print_number(FILE *out, const struct table_field *field, const uint32_t *words,
			 size_t count)
{
	const struct table_field *rest = field->rest;
	uint64_t bits = words[field->word];
	unsigned int width = field->high - field->low + 1;

	if (rest && rest->word < count) {
		bits |= (uint64_t)decode_field(rest, words[rest->word]) << 32;
		width += rest->high - rest->low + 1;
	}
	if (field->fixed && (!rest || width > 32))
		print_fixed(out, bits, width, field->fraction);
	else if (field->hex || field->fixed || field->is_rest)
		fprintf(out, "0x%0*" PRIx64, (int)(width + 3) / 4,
			(uint64_t)decode_field(field, words[field->word]));
	else
		fprintf(out, "%" PRId64, decode_field(field, words[field->word]));
}

static void print_enum(FILE *out, const struct table_enum *enumeration, int64_t number)
{
	for (unsigned int i = 0; i < enumeration->count; i++) {
		if (enumeration->values[i].value == number) {
			fputs(enumeration->values[i].name, out);
			return;
		}
	}
	fprintf(out, "%" PRId64 "?", number);
}

static void print_field(FILE *out, const struct table_field *field, const uint32_t *words,
			size_t count)
{
	fprintf(out, " %s=", field->name);
	if (field->type == TABLE_BOOL)
		fputs(decode_field(field, words[field->word]) ? "yes" : "no", out);
	else if (field->type == TABLE_ENUM)
		print_enum(out, field->enumeration, decode_field(field, words[field->word]));
	else
		print_number(out, field, words, count);
}

static void print_run(FILE *out, const struct decode_packet *packet, const struct decode_run *run)
{
	const uint32_t *words = packet->words + run->word;
	size_t count = packet->count - run->word;

	for (unsigned int word = 0; word < run->words && word < count; word++) {
		print_start(out, packet->offset + run->word + word, words[word]);
		fputs("  ", out);
		if (run->word == 0 && word == 0)
			print_upper(out, run->record->name);
		else if (word == 0)
			fprintf(out, "  %s:", run->record->name);
		else
			fputs(run->word ? "   " : " ", out);
		for (unsigned int i = 0; i < run->record->count; i++) {
			const struct table_field *field = &run->record->fields[i];

			if (field->word == word)
				print_field(out, field, words, count);
		}
		fputc('\n', out);
	}
}

static void print_data(FILE *out, const struct decode_packet *packet, size_t word)
{
	for (; word < packet->count; word += DATA_WORDS) {
		fprintf(out, "%7" PRIu64 " ", packet->offset + word);
		for (size_t i = word; i < packet->count && i < word + DATA_WORDS; i++)
			fprintf(out, " %08" PRIx32, packet->words[i]);
		fputc('\n', out);
	}
}

void decode_print(FILE *out, const struct decode_packet *packet)
{
	struct decode_run runs[DECODE_RUNS_MAX];
	unsigned int count;

	if (!packet->count)
		return;
	if (!packet->type) {
		print_start(out, packet->offset, packet->words[0]);
		fputs("  ?\n", out);
		return;
	}
	count = decode_runs(packet->type, packet->words[0], runs);
	for (unsigned int i = 0; i < count && runs[i].word < packet->count; i++)
		print_run(out, packet, &runs[i]);
	print_data(out, packet, (size_t)runs[count - 1].word + runs[count - 1].words);
}

void decode_print_fault(FILE *out, const struct decode_packet *packet)
{
	fputs("fault ", out);
	print_upper(out, decode_fault_name(packet->fault));
	fprintf(out, " at word %" PRIu64 ": %s\n", packet->fault_offset, packet->reason);
}
