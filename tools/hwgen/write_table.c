// SPDX-License-Identifier: MIT
/* Writes the interface as data for gloss-decode; the types are in tools/decode/table.h. */
#include <string.h>

#include "hwgen/hwgen.h"

static void write_enum(FILE *out, const struct hw_enum *e)
{
	unsigned int count = 0;

	fprintf(out, "static const struct table_value table_values_%s[] = {\n", e->name);
	for (const struct hw_value *v = e->values; v; v = v->next, count++)
		fprintf(out, "\t{ %u, \"%s\" },\n", v->value, v->name);
	fprintf(out,
		"};\n\nstatic const struct table_enum table_enum_%s = {\n"
		"\t\"%s\", %u, table_values_%s\n};\n\n",
		e->name, e->name, count, e->name);
}

static bool is_used(const struct hw_interface *hw, const struct hw_enum *e)
{
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		for (const struct hw_field *f = r->fields; f && !r->port; f = f->next) {
			if (f->enumeration == e)
				return true;
		}
	}
	return false;
}

static unsigned int count_fields(const struct hw_record *r, const struct hw_field *end)
{
	unsigned int count = 0;

	for (const struct hw_field *f = r->fields; f != end; f = f->next)
		count++;
	return count;
}

static void write_format(FILE *out, const struct hw_record *r, const struct hw_field *f)
{
	for (const struct hw_field *rest = r->fields; rest; rest = rest->next) {
		if (rest->above == f)
			fprintf(out, ",\n\t  .rest = &table_fields_%s[%u]", r->name,
				count_fields(r, rest));
	}
	if (f->above)
		fputs(", .is_rest = true", out);
	if (f->format && hw_same(f->format, "hex"))
		fputs(", .hex = true", out);
	else if (f->format)
		fprintf(out, ", .fixed = true, .fraction = %s", strchr(f->format, '.') + 1);
}

static void write_fields(FILE *out, const struct hw_record *r)
{
	static const char *const types[] = { "UINT", "INT", "BOOL", "ENUM" };

	if (!r->fields)
		return;
	fprintf(out, "static const struct table_field table_fields_%s[] = {\n", r->name);
	for (const struct hw_field *f = r->fields; f; f = f->next) {
		fprintf(out, "\t{ .name = \"%s\", .word = %u, .high = %u, .low = %u,\n", f->name,
			f->word, f->high, f->low);
		fprintf(out, "\t  .type = TABLE_%s, .min = %lld, .max = %lld", types[f->type],
			(long long)f->min, (long long)f->max);
		if (f->enumeration)
			fprintf(out, ", .enumeration = &table_enum_%s", f->enumeration->name);
		write_format(out, r, f);
		fputs(" },\n", out);
	}
	fputs("};\n\n", out);
}

static void write_record(FILE *out, const struct hw_record *r)
{
	fprintf(out, "{ \"%s\", %u, %u, ", r->name, r->words, count_fields(r, NULL));
	if (r->fields)
		fprintf(out, "table_fields_%s }", r->name);
	else
		fputs("0 }", out);
}

static void write_parts(FILE *out, const struct hw_record *r)
{
	if (!r->parts)
		return;
	fprintf(out, "static const struct table_part table_parts_%s[] = {\n", r->name);
	for (const struct hw_part *p = r->parts; p; p = p->next) {
		if (p->condition)
			fprintf(out, "\t{ &table_%s, %u, %u, %u, false },\n", p->group->name,
				p->condition->high, p->condition->low, p->value);
		else
			fprintf(out, "\t{ &table_%s, 0, 0, 0, true },\n", p->group->name);
	}
	fputs("};\n\n", out);
}

static void write_packet(FILE *out, const struct hw_record *r)
{
	unsigned int count = 0;

	for (const struct hw_part *p = r->parts; p; p = p->next)
		count++;
	fprintf(out, "\t{ 0x%02x, %u, ", r->opcode, r->least);
	write_record(out, r);
	if (r->parts)
		fprintf(out, ",\n\t  table_parts_%s, %u, %s },\n", r->name, count,
			r->variable ? "true" : "false");
	else
		fprintf(out, ",\n\t  0, 0, %s },\n", r->variable ? "true" : "false");
}

void hw_write_table(FILE *out, const struct hw_interface *hw)
{
	char upper[HW_NAME_MAX];

	hw_upper(upper, hw->name);
	fprintf(out,
		"/* SPDX-License-Identifier: MIT */\n"
		"/* Generated from rtl/%s.xml by tools/hwgen; do not edit. */\n"
		"#ifndef %s_TABLE_H\n#define %s_TABLE_H\n\n#include \"decode/table.h\"\n\n",
		hw->name, upper, upper);
	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		if (is_used(hw, e))
			write_enum(out, e);
	}
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind != HW_GROUP)
			continue;
		write_fields(out, r);
		fprintf(out, "static const struct table_record table_%s =\n\t", r->name);
		write_record(out, r);
		fputs(";\n\n", out);
	}
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind != HW_PACKET)
			continue;
		write_fields(out, r);
		write_parts(out, r);
	}
	fputs("static const struct table_packet table_packets[] = {\n", out);
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->kind == HW_PACKET)
			write_packet(out, r);
	}
	fputs("};\n\n#endif\n", out);
}
