// SPDX-License-Identifier: MIT
/* Writes the manual, in Markdown. */
#include <ctype.h>
#include <string.h>

#include "hwgen/hwgen.h"

#define COLUMNS 110

/* A text's paragraphs; one that begins with a word and a full stop has it in bold. */
static void write_text(FILE *out, const char *text)
{
	while (text) {
		const char *end = strstr(text, "\n\n");
		const char *paragraph = hw_copy(text, end ? (size_t)(end - text) : strlen(text));
		char lead[HW_NAME_MAX] = "";
		size_t word;

		paragraph += strspn(paragraph, " \t\r\n");
		word = strcspn(paragraph, " \n");
		if (word && word < HW_NAME_MAX / 2 && paragraph[word] &&
		    paragraph[word - 1] == '.') {
			snprintf(lead, sizeof(lead), "**%.*s** ", (int)word, paragraph);
			paragraph += word;
		}
		if (*paragraph) {
			hw_wrap(out, paragraph, lead, "", COLUMNS, HW_MARKDOWN);
			fputc('\n', out);
		}
		text = end ? end + 2 : NULL;
	}
}

static void write_cell(FILE *out, const char *text)
{
	fputs(" | ", out);
	if (text)
		hw_line(out, text, HW_MARKDOWN, false);
}

static void write_link(FILE *out, const char *name)
{
	char upper[HW_NAME_MAX];

	fprintf(out, "[%s](#%s)", hw_upper(upper, name), name);
}

static void write_type(FILE *out, const struct hw_field *f)
{
	static const char *const types[] = { "unsigned", "signed", "yes 1, no 0" };

	fputs(" | ", out);
	if (f->type == HW_ENUM)
		fprintf(out, "[%s](#%s)", f->enumeration->name, f->enumeration->name);
	else if (f->above)
		fprintf(out, "upper bits of %s", f->above->name);
	else if (f->format && !hw_same(f->format, "hex"))
		fputs(f->format, out);
	else
		fputs(types[f->type], out);
	if (f->has_min && f->has_max)
		fprintf(out, ", %lld to %lld", (long long)f->min, (long long)f->max);
	else if (f->has_min)
		fprintf(out, ", at least %lld", (long long)f->min);
	else if (f->has_max)
		fprintf(out, ", at most %lld", (long long)f->max);
}

static void write_fields(FILE *out, const struct hw_record *r)
{
	unsigned int words = hw_first_word(r) + r->words;

	if (!r->fields)
		return;
	fputs("| word | bits | field | value | |\n|---:|---:|---|---|---|\n", out);
	for (unsigned int word = 0; word < words; word++) {
		for (unsigned int bit = 0; bit < 32; bit++) {
			const struct hw_field *f = hw_field_at(r, word, bit);

			if (!f || f->low != bit)
				continue;
			fprintf(out, "| %u | ", word);
			if (f->high == f->low)
				fprintf(out, "%u", f->low);
			else
				fprintf(out, "%u:%u", f->high, f->low);
			fprintf(out, " | %s", f->name);
			write_type(out, f);
			write_cell(out, f->doc);
			fputs(" |\n", out);
		}
	}
	fputc('\n', out);
}

/* Length of a packet's payload, as "2", "2 or more", "5 to 34". */
static void write_length(FILE *out, const struct hw_record *r)
{
	unsigned int least = HW_LENGTH_MAX, most = 0;

	if (!r->parts) {
		fprintf(out, r->variable ? "%u or more" : "%u", r->least);
		return;
	}
	/* Every value of the condition fields: a header has 13 bits of its own. */
	for (uint32_t header = 0; header < 1u << (HW_HEADER_HIGH + 1);
	     header += 1u << HW_HEADER_LOW) {
		unsigned int words = 0;
		bool valid = true;

		for (const struct hw_field *f = r->fields; f; f = f->next) {
			uint32_t last;

			if (f->type == HW_ENUM && hw_enum_dense(f->enumeration, &last) &&
			    (header >> f->low & hw_mask(hw_width(f))) > last)
				valid = false;
		}
		for (const struct hw_part *p = r->parts; p; p = p->next) {
			const struct hw_field *f = p->condition;

			if (!f || (header >> f->low & hw_mask(hw_width(f))) == p->value)
				words += p->group->words;
		}
		if (valid && words < least)
			least = words;
		if (valid && words > most)
			most = words;
	}
	fprintf(out, "%u to %u", least, most);
}

static void write_index(FILE *out, const struct hw_interface *hw)
{
	fputs("## Packets by opcode\n\n"
	      "| opcode | packet | payload words | |\n|---|---|---|---|\n",
	      out);
	for (unsigned int opcode = 0; opcode < 256; opcode++) {
		for (const struct hw_record *r = hw->records; r; r = r->next) {
			if (r->kind != HW_PACKET || r->opcode != opcode)
				continue;
			fprintf(out, "| 0x%02x | ", opcode);
			write_link(out, r->name);
			fputs(" | ", out);
			write_length(out, r);
			fputs(" | ", out);
			if (r->doc)
				hw_line(out, r->doc, HW_MARKDOWN, true);
			fputs(" |\n", out);
		}
	}
	fputc('\n', out);
}

static void write_parts(FILE *out, const struct hw_record *r)
{
	if (!r->parts)
		return;
	fputs("| part of the payload, in this order | words | if |\n|---|---:|---|\n", out);
	for (const struct hw_part *p = r->parts; p; p = p->next) {
		fprintf(out, "| [%s](#%s) | %u | ", p->group->name, p->group->name,
			p->group->words);
		if (p->condition)
			fprintf(out, "%s is %s", p->condition->name,
				p->condition->type != HW_BOOL ? p->is_name :
				p->value                      ? "yes" :
								"no");
		else
			fputs("always", out);
		fputs(" |\n", out);
	}
	fputc('\n', out);
}

static void write_record(FILE *out, const struct hw_record *r)
{
	char upper[HW_NAME_MAX];

	if (r->kind == HW_PACKET) {
		fprintf(out, "### %s\n\nOpcode 0x%02x, payload words: ", hw_upper(upper, r->name),
			r->opcode);
		write_length(out, r);
		fputs(".\n\n", out);
	} else {
		fprintf(out, "### %s\n\nWords: %u.\n\n", r->name, r->words);
	}
	write_text(out, r->doc);
	write_fields(out, r);
	write_parts(out, r);
}

static void write_register(FILE *out, const struct hw_record *r)
{
	char upper[HW_NAME_MAX];

	fprintf(out, "### Register %s\n\nOffset 0x%03x, %s.\n\n", hw_upper(upper, r->name),
		r->offset, hw_access_name(r->access));
	write_text(out, r->doc);
	write_fields(out, r);
}

/* Those of the stream's side. */
static void write_records(FILE *out, const struct hw_interface *hw, enum hw_kind kind)
{
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind == kind && !r->port)
			write_record(out, r);
	}
}

/* What every port has (@bus is NULL), or what only one on this bus has. */
static void write_bus(FILE *out, const struct hw_interface *hw, const struct hw_bus *bus)
{
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind == HW_REGISTER && r->bus == bus && r->fields)
			write_register(out, r);
	}
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind == HW_STRUCT && r->port && r->bus == bus)
			write_record(out, r);
	}
}

static void write_port(FILE *out, const struct hw_interface *hw)
{
	char upper[HW_NAME_MAX];

	if (!hw->has_port)
		return;
	fputs("## Port\n\n", out);
	write_text(out, hw->port_doc);
	fputs("### Registers by offset\n\n"
	      "| offset | register | access | bus | |\n|---|---|---|---|---|\n",
	      out);
	for (unsigned int offset = 0; offset <= UINT16_MAX; offset += 4) {
		for (const struct hw_record *r = hw->records; r; r = r->next) {
			if (r->kind != HW_REGISTER || r->offset != offset)
				continue;
			hw_upper(upper, r->name);
			fprintf(out, "| 0x%03x | ", offset);
			fprintf(out, r->fields ? "[%s](#register-%s)" : "%s", upper, r->name);
			fprintf(out, " | %s | %s", hw_access_name(r->access),
				r->bus ? r->bus->name : "all");
			write_cell(out, r->doc);
			fputs(" |\n", out);
		}
	}
	fputs("\nrw1c: reads the bits, writing a 1 clears a bit.\n\n", out);
	write_bus(out, hw, NULL);
	for (const struct hw_bus *bus = hw->buses; bus; bus = bus->next) {
		fprintf(out, "## Port on bus %s\n\n", bus->name);
		write_text(out, bus->doc);
		write_bus(out, hw, bus);
	}
}

static void write_enums(FILE *out, const struct hw_interface *hw)
{
	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		fprintf(out, "### %s\n\n", e->name);
		write_text(out, e->doc);
		fputs("| value | name | |\n|---:|---|---|\n", out);
		for (const struct hw_value *v = e->values; v; v = v->next) {
			char upper[HW_NAME_MAX];

			fprintf(out, "| %u | %s", v->value, hw_upper(upper, v->name));
			write_cell(out, v->doc);
			fputs(" |\n", out);
		}
		fputc('\n', out);
	}
}

static void write_constants(FILE *out, const struct hw_interface *hw)
{
	fputs("| name | value | |\n|---|---:|---|\n", out);
	for (const struct hw_constant *c = hw->constants; c; c = c->next) {
		fprintf(out, "| %s | ", c->name);
		hw_number(out, c, "0x");
		write_cell(out, c->doc);
		fputs(" |\n", out);
	}
}

void hw_write_manual(FILE *out, const struct hw_interface *hw)
{
	char title[HW_NAME_MAX];

	fprintf(out,
		"<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
		"<!-- Generated from rtl/%s.xml by tools/hwgen; do not edit. -->\n"
		"# The %s interface, version %u\n\n",
		hw->name, hw_camel(title, hw->name), hw->version);
	write_text(out, hw->doc);
	fputs("## Header\n\n"
	      "Word 0 of every packet. Bits without a field are reserved and zero, here and in\n"
	      "all words.\n\n"
	      "| bits | |\n|---:|---|\n| 31:24 | opcode |\n| 23:11 | the packet's own fields |\n"
	      "| 10:0 | length: payload words |\n\n",
	      out);
	write_index(out, hw);
	fputs("## Packets\n\nWord 0 is the header, the payload begins at word 1.\n\n", out);
	write_records(out, hw, HW_PACKET);
	fputs("## Groups\n\nParts of payloads; word 0 is the part's first.\n\n", out);
	write_records(out, hw, HW_GROUP);
	fputs("## Enums\n\n", out);
	write_enums(out, hw);
	fputs("## Structs\n\nOutside the stream; word 0 is the first.\n\n", out);
	write_records(out, hw, HW_STRUCT);
	write_port(out, hw);
	fputs("## Constants\n\n", out);
	write_constants(out, hw);
}
