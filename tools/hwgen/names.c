// SPDX-License-Identifier: MIT
/*
 * Claims every identifier the writers write, in the scope they write it in. A
 * claim fails for a keyword of the language and for a name that is taken, so
 * two names that only clash once they are spelled for C or SystemVerilog are
 * found here, with their lines, and not by a compiler.
 */
#include <stdarg.h>
#include <string.h>

#include "hwgen/hwgen.h"

struct name {
	struct name *next;
	unsigned long line; /* 0: hwgen's own */
	char text[];
};

struct scope {
	const char *path;
	const char *(*keyword)(const char *name);
	struct name *names;
};

__attribute__((format(printf, 3, 4))) static void claim(struct scope *scope, unsigned long line,
							const char *format, ...)
{
	struct name *name = hw_alloc(sizeof(*name) + 2 * HW_NAME_MAX);
	va_list arguments;

	name->line = line;
	va_start(arguments, format);
	vsnprintf(name->text, (size_t)2 * HW_NAME_MAX, format, arguments);
	va_end(arguments);
	if (scope->keyword(name->text))
		hw_fail(scope->path, line, "'%s' is a keyword of %s", name->text,
			scope->keyword(name->text));
	for (const struct name *other = scope->names; other; other = other->next) {
		if (!hw_same(other->text, name->text))
			continue;
		if (!other->line)
			hw_fail(scope->path, line, "'%s' is a name hwgen writes itself",
				name->text);
		hw_fail(scope->path, line, "'%s' is already in line %lu", name->text, other->line);
	}
	name->next = scope->names;
	scope->names = name;
}

/* a-z, then a-z, 0-9 and single underscores, not at the end: what is an identifier, and none of
 * the reserved ones, in all three languages, in either case. */
static void check_spelling(const char *path, unsigned long line, const char *name)
{
	bool good = name[0] >= 'a' && name[0] <= 'z';

	for (const char *c = name; *c && good; c++)
		good = (*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') ||
		       (*c == '_' && c[1] && c[1] != '_');
	if (!good || strlen(name) > HW_NAME_MAX / 4)
		hw_fail(path, line,
			"'%s' is not a name: a-z, then a-z, 0-9 and single '_' between, up to %u",
			name, HW_NAME_MAX / 4);
}

static void spell_all(const struct hw_interface *hw)
{
	check_spelling(hw->path, hw->line, hw->name);
	for (const struct hw_bus *bus = hw->buses; bus; bus = bus->next)
		check_spelling(hw->path, bus->line, bus->name);
	for (const struct hw_constant *c = hw->constants; c; c = c->next)
		check_spelling(hw->path, c->line, c->name);
	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		check_spelling(hw->path, e->line, e->name);
		for (const struct hw_value *value = e->values; value; value = value->next)
			check_spelling(hw->path, value->line, value->name);
	}
	for (const struct hw_record *record = hw->records; record; record = record->next) {
		check_spelling(hw->path, record->line, record->name);
		for (const struct hw_field *field = record->fields; field; field = field->next)
			check_spelling(hw->path, field->line, field->name);
	}
}

static void claim_fields(const struct hw_interface *hw, const struct hw_record *record)
{
	struct scope c = { hw->path, hw_keyword_c, NULL };
	struct scope sv = { hw->path, hw_keyword_sv, NULL };

	if (record->kind == HW_PACKET) {
		claim(&sv, 0, "opcode");
		claim(&sv, 0, "length");
	}
	for (const struct hw_field *field = record->fields; field; field = field->next) {
		claim(&c, field->line, "%s", field->name);
		claim(&sv, field->line, "%s%s", field->name, hw_keyword_sv(field->name) ? "_" : "");
		if (!strncmp(field->name, "reserved_", 9))
			hw_fail(hw->path, field->line, "'%s': hwgen names reserved bits so",
				field->name);
	}
}

/* What the registers' header has beyond the packers': masks, and places in structs. */
static void claim_port_record(struct scope *macros, const struct hw_record *record)
{
	const char *prefix = record->kind == HW_REGISTER ? "REG_" : "";
	char upper[HW_NAME_MAX], field_upper[HW_NAME_MAX];

	hw_upper(upper, record->name);
	if (record->kind == HW_REGISTER)
		claim(macros, record->line, "REG_%s", upper);
	for (const struct hw_field *field = record->fields; field; field = field->next) {
		hw_upper(field_upper, field->name);
		claim(macros, field->line, "%s%s_%s", prefix, upper, field_upper);
		if (record->kind == HW_STRUCT)
			claim(macros, field->line, "%s_%s_WORD", upper, field_upper);
	}
}

static void claim_c(const struct hw_interface *hw)
{
	struct scope macros = { hw->path, hw_keyword_c, NULL }; /* and enum values */
	struct scope tags = macros, functions = macros;
	char upper[HW_NAME_MAX], value_upper[HW_NAME_MAX];

	claim(&macros, 0, "LENGTH_MAX");
	claim(&tags, 0, "opcode");
	claim(&functions, 0, "header_opcode");
	claim(&functions, 0, "header_length");
	claim(&functions, 0, "header_valid");
	claim(&functions, 0, "opcode_known");
	for (const struct hw_constant *c = hw->constants; c; c = c->next)
		claim(&macros, c->line, "%s", hw_upper(upper, c->name));
	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		claim(&tags, e->line, "%s", e->name);
		claim(&functions, e->line, "%s_name", e->name);
		hw_upper(upper, e->name);
		for (const struct hw_value *value = e->values; value; value = value->next)
			claim(&macros, value->line, "%s_%s", upper,
			      hw_upper(value_upper, value->name));
	}
	for (const struct hw_record *record = hw->records; record; record = record->next) {
		if (record->port)
			claim_port_record(&macros, record);
		if (record->kind == HW_REGISTER)
			continue;
		hw_upper(upper, record->name);
		claim(&tags, record->line, "%s", record->name);
		claim(&macros, record->line, "%s_WORDS", upper);
		if (record->kind == HW_PACKET)
			claim(&macros, record->line, "OP_%s", upper);
		claim(&functions, record->line, "%s_length", record->name);
		claim(&functions, record->line, "%s_pack", record->name);
		claim(&functions, record->line, "%s_unpack", record->name);
		claim(&functions, record->line, "%s_invalid", record->name);
	}
}

static void claim_sv(const struct hw_interface *hw)
{
	struct scope package = { hw->path, hw_keyword_sv, NULL };
	char upper[HW_NAME_MAX], value_upper[HW_NAME_MAX];

	for (const struct hw_constant *c = hw->constants; c; c = c->next)
		claim(&package, c->line, "%s", hw_camel(upper, c->name));
	for (const struct hw_enum *e = hw->enums; e; e = e->next) {
		hw_upper(upper, e->name);
		for (const struct hw_value *value = e->values; value; value = value->next)
			claim(&package, value->line, "%s_%s", upper,
			      hw_upper(value_upper, value->name));
	}
	for (const struct hw_record *record = hw->records; record; record = record->next) {
		hw_upper(upper, record->name);
		if (record->kind == HW_REGISTER) {
			claim(&package, record->line, "REG_%s", upper);
			claim(&package, record->line, "REG_%s_RESERVED", upper);
			claim(&package, record->line, "reg_%s_t", record->name);
			continue;
		}
		claim(&package, record->line, "%s_t", record->name);
		claim(&package, record->line, "%s_WORDS", upper);
		claim(&package, record->line, "%s_RESERVED", upper);
		if (record->kind != HW_PACKET)
			continue;
		claim(&package, record->line, "OP_%s", upper);
		claim(&package, record->line, "%s_header_t", record->name);
		claim(&package, record->line, "%s_HEADER_RESERVED", upper);
	}
}

void hw_check_names(const struct hw_interface *hw)
{
	spell_all(hw);
	for (const struct hw_record *record = hw->records; record; record = record->next)
		claim_fields(hw, record);
	claim_c(hw);
	claim_sv(hw);
}
