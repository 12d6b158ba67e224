// SPDX-License-Identifier: MIT
/*
 * Writes the C header of the port. The kernel takes it too, so it includes nothing and has masks
 * and indices where the packers have structs. What both headers define is the same to the letter,
 * so that one file may include both.
 */
#include "hwgen/hwgen.h"

struct writer {
	FILE *out;
	const struct hw_interface *hw;
	char upper_name[HW_NAME_MAX]; /* of the interface */
};

static void write_constants(const struct writer *w, const struct hw_bus *bus)
{
	const char *before = "\n";
	char upper[HW_NAME_MAX];

	for (const struct hw_constant *c = w->hw->constants; c; c = c->next) {
		if (!c->port || c->bus != bus)
			continue;
		fputs(before, w->out);
		before = "";
		if (c->doc)
			hw_comment(w->out, "", c->doc);
		fprintf(w->out, "#define %s_%s ", w->upper_name, hw_upper(upper, c->name));
		hw_number(w->out, c, "0x");
		fputs("u\n", w->out);
	}
}

static void write_mask(const struct writer *w, const char *record, const struct hw_field *f)
{
	char upper[HW_NAME_MAX];

	fprintf(w->out, "#define %s_%s_%s 0x%08xu\n", w->upper_name, record,
		hw_upper(upper, f->name), hw_mask(hw_width(f)) << f->low);
}

static void write_register(const struct writer *w, const struct hw_record *r)
{
	char name[HW_NAME_MAX + 4] = "REG_";

	hw_upper(name + 4, r->name);
	if (r->doc)
		hw_comment(w->out, "", r->doc);
	fprintf(w->out, "#define %s_%s 0x%03x\n", w->upper_name, name, r->offset);
	for (const struct hw_field *f = r->fields; f; f = f->next)
		write_mask(w, name, f);
}

static void write_struct(const struct writer *w, const struct hw_record *r)
{
	char upper[HW_NAME_MAX], field_upper[HW_NAME_MAX];

	fputc('\n', w->out);
	if (r->doc)
		hw_comment(w->out, "", r->doc);
	hw_upper(upper, r->name);
	fprintf(w->out, "#define %s_%s_WORDS %u\n", w->upper_name, upper, r->words);
	for (const struct hw_field *f = r->fields; f; f = f->next) {
		if (f->doc)
			hw_comment(w->out, "", f->doc);
		fprintf(w->out, "#define %s_%s_%s_WORD %u\n", w->upper_name, upper,
			hw_upper(field_upper, f->name), f->word);
		if (hw_width(f) < 32)
			write_mask(w, upper, f);
	}
}

static bool has_port_record(const struct hw_interface *hw, enum hw_kind kind,
			    const struct hw_bus *bus)
{
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		if (r->port && r->kind == kind && r->bus == bus)
			return true;
	}
	return false;
}

/* What every port has (@bus is NULL), or what only one on this bus has. */
static void write_bus(const struct writer *w, const struct hw_bus *bus)
{
	if (bus)
		fprintf(w->out, "\n/* ---- bus %s ---- */\n", bus->name);
	write_constants(w, bus);
	if (has_port_record(w->hw, HW_REGISTER, bus))
		fputs("\n/* Registers: byte offsets, masks of fields. */\n\n", w->out);
	for (const struct hw_record *r = w->hw->records; r; r = r->next) {
		if (r->kind == HW_REGISTER && r->bus == bus)
			write_register(w, r);
	}
	if (has_port_record(w->hw, HW_STRUCT, bus))
		fputs("\n/* Structs: indices of words, masks of narrow fields. */\n", w->out);
	for (const struct hw_record *r = w->hw->records; r; r = r->next) {
		if (r->kind == HW_STRUCT && r->port && r->bus == bus)
			write_struct(w, r);
	}
}

static bool is_in_register(const struct hw_interface *hw, const struct hw_enum *e)
{
	for (const struct hw_record *r = hw->records; r; r = r->next) {
		for (const struct hw_field *f = r->fields; f; f = f->next) {
			if (r->kind == HW_REGISTER && f->enumeration == e)
				return true;
		}
	}
	return false;
}

/* For messages: the name of a value read from a register. */
static void write_names(const struct writer *w, const struct hw_enum *e)
{
	fprintf(w->out,
		"\nstatic inline const char *%s_%s_name(unsigned int %s)\n{\n"
		"\tswitch (%s) {\n",
		w->hw->name, e->name, e->name, e->name);
	for (const struct hw_value *v = e->values; v; v = v->next)
		fprintf(w->out, "\tcase %u:\n\t\treturn \"%s\";\n", v->value, v->name);
	fputs("\tdefault:\n\t\treturn \"unknown\";\n\t}\n}\n", w->out);
}

void hw_write_regs(FILE *out, const struct hw_interface *hw)
{
	struct writer w = { .out = out, .hw = hw };

	hw_upper(w.upper_name, hw->name);
	fprintf(out,
		"/* SPDX-License-Identifier: MIT */\n"
		"/* Generated from rtl/%s.xml by tools/hwgen; do not edit. */\n"
		"#ifndef %s_REGS_H\n#define %s_REGS_H\n",
		hw->name, w.upper_name, w.upper_name);
	write_bus(&w, NULL);
	for (const struct hw_bus *bus = hw->buses; bus; bus = bus->next)
		write_bus(&w, bus);
	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		if (is_in_register(hw, e))
			write_names(&w, e);
	}
	fputs("\n#endif\n", out);
}
