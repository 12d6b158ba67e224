// SPDX-License-Identifier: MIT
/* Writes the part of the SystemVerilog package that the interface decides. */
#include "hwgen/hwgen.h"

static void write_constants(FILE *out, const struct hw_interface *hw)
{
	char camel[HW_NAME_MAX];

	for (const struct hw_constant *c = hw->constants; c; c = c->next) {
		if (c->doc)
			hw_wrap(out, c->doc, "  // ", "  // ", 100, HW_PLAIN);
		fprintf(out, "  localparam int unsigned %s = ", hw_camel(camel, c->name));
		hw_number(out, c, "32'h");
		fputs(";\n", out);
	}
	fputc('\n', out);
}

static void write_enums(FILE *out, const struct hw_interface *hw)
{
	char upper[HW_NAME_MAX], value_upper[HW_NAME_MAX];

	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		if (e->doc)
			hw_wrap(out, e->doc, "  // ", "  // ", 100, HW_PLAIN);
		hw_upper(upper, e->name);
		for (const struct hw_value *v = e->values; v; v = v->next)
			fprintf(out, "  localparam logic [%u:0] %s_%s = %u'd%u;\n", e->bits - 1,
				upper, hw_upper(value_upper, v->name), e->bits, v->value);
		fputc('\n', out);
	}
}

static void write_opcodes(FILE *out, const struct hw_interface *hw)
{
	char upper[HW_NAME_MAX];

	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind == HW_PACKET)
			fprintf(out, "  localparam logic [7:0] OP_%s = 8'h%02x;\n",
				hw_upper(upper, r->name), r->opcode);
	}
	fputs("\n  // Payload words of packets whose length is fixed, and of groups.\n", out);
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if ((r->kind == HW_GROUP || r->kind == HW_PACKET) && !r->variable)
			fprintf(out, "  localparam logic [10:0] %s_WORDS = 11'd%u;\n",
				hw_upper(upper, r->name), r->words);
	}
	fputc('\n', out);
}

static void write_offsets(FILE *out, const struct hw_interface *hw)
{
	char upper[HW_NAME_MAX];

	if (!hw->has_port)
		return;
	fputs("  // Byte offsets of registers.\n", out);
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind == HW_REGISTER)
			fprintf(out, "  localparam logic [15:0] REG_%s = 16'h%04x;\n",
				hw_upper(upper, r->name), r->offset);
	}
	fputc('\n', out);
}

static void write_member(FILE *out, bool is_signed, unsigned int width, const char *name)
{
	fprintf(out, "    logic %s", is_signed ? "signed " : "");
	if (width > 1)
		fprintf(out, "[%u:0] ", width - 1);
	/* No name ends in an underscore, so this one is free. */
	fprintf(out, "%s%s", name, hw_keyword_sv(name) ? "_" : "");
}

/* Members from the top bit down; *@reserved counts the unnamed ones of the struct. */
static void write_word(FILE *out, const struct hw_record *r, unsigned int word,
		       unsigned int *reserved)
{
	bool header = r->kind == HW_PACKET && word == 0;
	bool top = true;
	int bit = 31;

	while (bit >= 0) {
		const struct hw_field *f = hw_field_at(r, word, (unsigned int)bit);
		char name[HW_NAME_MAX];
		int low = bit;

		if (header && bit == 31) {
			low = 24;
			write_member(out, false, 8, "opcode");
		} else if (header && bit == (int)HW_HEADER_LOW - 1) {
			low = 0;
			write_member(out, false, HW_HEADER_LOW, "length");
		} else if (f) {
			low = (int)f->low;
			write_member(out, f->type == HW_INT, hw_width(f), f->name);
		} else {
			while (low > (header ? (int)HW_HEADER_LOW : 0) &&
			       !hw_field_at(r, word, (unsigned int)low - 1))
				low--;
			snprintf(name, sizeof(name), "reserved_%u", (*reserved)++);
			write_member(out, false, (unsigned int)(bit - low + 1), name);
		}
		fprintf(out, top && r->words > 1 && !header ? ";  // word %u\n" : ";\n", word);
		top = false;
		bit = low - 1;
	}
}

/* A number, or of several words a list, highest first, six to a line. */
static void write_reserved(FILE *out, const struct hw_record *r, unsigned int first,
			   unsigned int words)
{
	if (words == 1) {
		fprintf(out, "32'h%08x", hw_reserved(r, first));
		return;
	}
	fputc('{', out);
	for (unsigned int n = 0; n < words; n++) {
		fputs(n % 6 == 0 ? "\n    " : " ", out);
		fprintf(out, "32'h%08x%s", hw_reserved(r, first + words - 1 - n),
			n + 1 < words ? "," : "");
	}
	fputs("\n  }", out);
}

static void write_struct(FILE *out, const struct hw_record *r, unsigned int first,
			 unsigned int words, const char *suffix, const char *upper_suffix)
{
	bool is_register = r->kind == HW_REGISTER;
	unsigned int reserved = 0;
	char upper[HW_NAME_MAX];

	fputs("  typedef struct packed {\n", out);
	for (unsigned int word = first + words; word-- > first;)
		write_word(out, r, word, &reserved);
	fprintf(out, "  } %s%s%s_t;\n", is_register ? "reg_" : "", r->name, suffix);
	hw_upper(upper, r->name);
	fprintf(out, "  localparam int unsigned %s%s%s_BITS = %u;\n", is_register ? "REG_" : "",
		upper, upper_suffix, 32 * words);
	fprintf(out, "  localparam logic [%s%s%s_BITS-1:0] %s%s%s_RESERVED = ",
		is_register ? "REG_" : "", upper, upper_suffix, is_register ? "REG_" : "", upper,
		upper_suffix);
	write_reserved(out, r, first, words);
	fputs(";\n\n", out);
}

static void write_records(FILE *out, const struct hw_interface *hw, enum hw_kind kind)
{
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind != kind)
			continue;
		if (kind == HW_PACKET)
			write_struct(out, r, 0, 1, "_header", "_HEADER");
		if (r->words && (r->fields || kind != HW_REGISTER))
			write_struct(out, r, hw_first_word(r), r->words, "", "");
	}
}

void hw_write_sv(FILE *out, const struct hw_interface *hw)
{
	fprintf(out,
		"// SPDX-License-Identifier: Apache-2.0\n"
		"// Generated from rtl/%s.xml by tools/hwgen; do not edit. Included in %s_pkg.\n\n",
		hw->name, hw->name);
	write_constants(out, hw);
	write_enums(out, hw);
	write_opcodes(out, hw);
	write_offsets(out, hw);
	fputs("  // Packed structs: the lowest word of a group or payload is bits 31:0.\n"
	      "  // A _RESERVED mask has the bits that must be zero.\n\n",
	      out);
	write_records(out, hw, HW_GROUP);
	write_records(out, hw, HW_PACKET);
	write_records(out, hw, HW_STRUCT);
	write_records(out, hw, HW_REGISTER);
}
