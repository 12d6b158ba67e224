// SPDX-License-Identifier: MIT
/* Resolves the names of types, groups and conditions, and refuses what does not fit. */
#include <stdlib.h>
#include <string.h>

#include "hwgen/hwgen.h"

const struct hw_field *hw_field_at(const struct hw_record *record, unsigned int word,
				   unsigned int bit)
{
	for (const struct hw_field *field = record->fields; field; field = field->next) {
		if (field->word == word && field->low <= bit && bit <= field->high)
			return field;
	}
	return NULL;
}

uint32_t hw_reserved(const struct hw_record *record, unsigned int word)
{
	bool header = record->kind == HW_PACKET && word == 0;
	uint32_t mask = 0;

	for (unsigned int bit = header ? HW_HEADER_LOW : 0; bit <= (header ? HW_HEADER_HIGH : 31);
	     bit++) {
		if (!hw_field_at(record, word, bit))
			mask |= 1u << bit;
	}
	return mask;
}

const char *hw_access_name(enum hw_access access)
{
	static const char *const names[] = { "ro", "rw", "rw1c" };

	return names[access];
}

bool hw_enum_dense(const struct hw_enum *enumeration, uint32_t *last)
{
	uint32_t count = 0;

	*last = 0;
	for (const struct hw_value *value = enumeration->values; value; value = value->next) {
		count++;
		if (value->value > *last)
			*last = value->value;
	}
	return count == *last + 1; /* values differ, so n of them up to n-1 are all */
}

static const struct hw_value *find_value(const struct hw_enum *enumeration, const char *name)
{
	const struct hw_value *value = enumeration->values;

	while (value && !hw_same(value->name, name))
		value = value->next;
	return value;
}

static const char *const type_names[] = { "uint", "int", "bool" }; /* as in enum hw_type */
#define TYPE_NAMES (sizeof(type_names) / sizeof(type_names[0]))

static void check_enum(const char *path, const struct hw_enum *enumeration)
{
	for (unsigned int i = 0; i < TYPE_NAMES; i++) {
		if (hw_same(enumeration->name, type_names[i]))
			hw_fail(path, enumeration->line, "enum '%s' has the name of a type",
				enumeration->name);
	}
	if (!enumeration->values)
		hw_fail(path, enumeration->line, "enum '%s' has no values", enumeration->name);
	for (const struct hw_value *a = enumeration->values; a; a = a->next) {
		if (a->value > hw_mask(enumeration->bits))
			hw_fail(path, a->line, "value '%s' is %u, which does not fit in %u bits",
				a->name, a->value, enumeration->bits);
		for (const struct hw_value *b = enumeration->values; b != a; b = b->next) {
			if (a->value == b->value)
				hw_fail(path, a->line, "value '%s' is %u, as is '%s' in line %lu",
					a->name, a->value, b->name, b->line);
		}
	}
}

static void resolve_type(const struct hw_interface *hw, struct hw_field *field)
{
	for (unsigned int i = 0; i < TYPE_NAMES; i++) {
		if (hw_same(field->type_name, type_names[i])) {
			field->type = (enum hw_type)i;
			return;
		}
	}
	field->type = HW_ENUM;
	field->enumeration = hw->enums;
	while (field->enumeration && !hw_same(field->enumeration->name, field->type_name))
		field->enumeration = field->enumeration->next;
	if (!field->enumeration)
		hw_fail(hw->path, field->line, "field '%s' has the unknown type '%s'", field->name,
			field->type_name);
}

static void check_type(const char *path, const struct hw_field *field)
{
	unsigned int bits = field->type == HW_BOOL ? 1 :
			    field->type == HW_ENUM ? field->enumeration->bits :
						     hw_width(field);

	if (hw_width(field) != bits)
		hw_fail(path, field->line, "field '%s' is %u bits wide, its type '%s' %u",
			field->name, hw_width(field), field->type_name, bits);
	if ((field->has_min || field->has_max) &&
	    (field->type == HW_BOOL || field->type == HW_ENUM))
		hw_fail(path, field->line, "field '%s' of type '%s' takes no min or max",
			field->name, field->type_name);
}

/* min and max become the ends of what the bits can hold where the XML has none. */
static void check_range(const char *path, struct hw_field *field)
{
	int64_t low = field->type == HW_INT ? -((int64_t)1 << (hw_width(field) - 1)) : 0;
	int64_t high = low + hw_mask(hw_width(field));

	if (!field->has_min)
		field->min = low;
	if (!field->has_max)
		field->max = high;
	if (field->min < low || field->min > high)
		hw_fail(path, field->line, "min %lld of field '%s' does not fit in its bits",
			(long long)field->min, field->name);
	if (field->max < low || field->max > high)
		hw_fail(path, field->line, "max %lld of field '%s' does not fit in its bits",
			(long long)field->max, field->name);
	if (field->min > field->max)
		hw_fail(path, field->line, "min of field '%s' is above its max", field->name);
	field->has_min = field->min != low;
	field->has_max = field->max != high;
}

static void check_place(const char *path, const struct hw_record *record,
			const struct hw_field *field)
{
	unsigned int words = hw_first_word(record) + record->words;

	if (field->word >= words)
		hw_fail(path, field->line, "field '%s' is in word %u, the last of '%s' is %u",
			field->name, field->word, record->name, words - 1);
	if (record->kind == HW_PACKET && field->word == 0 &&
	    (field->high > HW_HEADER_HIGH || field->low < HW_HEADER_LOW))
		hw_fail(path, field->line,
			"field '%s' overlaps the opcode or length of the header; %u:%u are free",
			field->name, HW_HEADER_HIGH, HW_HEADER_LOW);
	for (const struct hw_field *other = record->fields; other != field; other = other->next) {
		if (other->word == field->word && other->low <= field->high &&
		    field->low <= other->high)
			hw_fail(path, field->line, "field '%s' overlaps field '%s' of line %lu",
				field->name, other->name, other->line);
	}
}

static const struct hw_field *find_field(const struct hw_record *record, const char *name)
{
	const struct hw_field *field = record->fields;

	while (field && !hw_same(field->name, name))
		field = field->next;
	return field;
}

static void check_above(const char *path, const struct hw_record *record, struct hw_field *field)
{
	if (!field->above_name)
		return;
	field->above = find_field(record, field->above_name);
	if (!field->above)
		hw_fail(path, field->line, "field '%s' is above '%s', which '%s' does not have",
			field->name, field->above_name, record->name);
	if (field->above == field || field->above->above_name || field->type != HW_UINT ||
	    field->above->type != HW_UINT || field->above->low != 0 || field->above->high != 31)
		hw_fail(path, field->line,
			"field '%s' must be a uint that continues one of 32 bits", field->name);
	for (const struct hw_field *other = record->fields; other != field; other = other->next) {
		if (other->above == field->above)
			hw_fail(path, field->line, "field '%s' and field '%s' both are above '%s'",
				other->name, field->name, field->above_name);
	}
}

/* Bits of a field with those that continue it. */
static unsigned int whole_width(const struct hw_record *record, const struct hw_field *field)
{
	unsigned int width = hw_width(field);

	for (const struct hw_field *other = record->fields; other; other = other->next) {
		if (other->above == field)
			width += hw_width(other);
	}
	return width;
}

static void check_format(const char *path, const struct hw_record *record,
			 const struct hw_field *field)
{
	unsigned int whole, fraction;
	char again[32];

	if (!field->format || hw_same(field->format, "hex"))
		return;
	if (sscanf(field->format, "s%2u.%2u", &whole, &fraction) != 2)
		whole = fraction = 0;
	snprintf(again, sizeof(again), "s%u.%u", whole, fraction);
	if (!hw_same(again, field->format))
		hw_fail(path, field->line,
			"format '%s' of field '%s' is neither 'hex' nor like 's10.22'",
			field->format, field->name);
	if (whole + fraction != whole_width(record, field))
		hw_fail(path, field->line, "format '%s' of field '%s' does not have its %u bits",
			field->format, field->name, whole_width(record, field));
}

static uint32_t condition_value(const struct hw_interface *hw, const struct hw_part *part)
{
	const struct hw_field *field = part->condition;
	const struct hw_value *value;
	char *end;
	unsigned long number;

	if (field->type == HW_ENUM) {
		value = find_value(field->enumeration, part->is_name);
		if (!value)
			hw_fail(hw->path, part->line, "enum '%s' has no value '%s'",
				field->enumeration->name, part->is_name);
		return value->value;
	}
	number = strtoul(part->is_name, &end, 10);
	if (end == part->is_name || *end || number > hw_mask(hw_width(field)))
		hw_fail(hw->path, part->line, "'%s' is not a value of field '%s'", part->is_name,
			field->name);
	return (uint32_t)number;
}

static void check_part(const struct hw_interface *hw, const struct hw_record *packet,
		       struct hw_part *part)
{
	part->group = hw->records;
	while (part->group &&
	       (part->group->kind != HW_GROUP || !hw_same(part->group->name, part->group_name)))
		part->group = part->group->next;
	if (!part->group)
		hw_fail(hw->path, part->line, "part of the unknown group '%s'", part->group_name);
	if (!part->if_name)
		return;
	part->condition = find_field(packet, part->if_name);
	if (!part->condition || part->condition->word != 0)
		hw_fail(hw->path, part->line, "packet '%s' has no header field '%s'", packet->name,
			part->if_name);
	part->value = condition_value(hw, part);
}

static void check_packet(const struct hw_interface *hw, const struct hw_record *packet)
{
	unsigned int words = packet->words;

	for (const struct hw_record *other = hw->records; other != packet; other = other->next) {
		if (other->kind == HW_PACKET && other->opcode == packet->opcode)
			hw_fail(hw->path, packet->line, "opcode 0x%02x is that of '%s' in line %lu",
				packet->opcode, other->name, other->line);
	}
	if (packet->parts && (packet->has_words || packet->least || !packet->variable))
		hw_fail(hw->path, packet->line,
			"packet '%s' has parts: it needs variable=\"yes\", no words, no least",
			packet->name);
	for (struct hw_part *part = packet->parts; part; part = part->next) {
		check_part(hw, packet, part);
		words += part->group->words;
	}
	if (words > HW_LENGTH_MAX)
		hw_fail(hw->path, packet->line, "packet '%s' could have %u words, more than %u",
			packet->name, words, HW_LENGTH_MAX);
}

static void check_bus(const struct hw_interface *hw, const struct hw_bus *bus)
{
	for (const struct hw_bus *other = hw->buses; other != bus; other = other->next) {
		if (hw_same(other->name, bus->name))
			hw_fail(hw->path, bus->line, "bus '%s' is already in line %lu", bus->name,
				other->line);
	}
}

/* An offset is one register's, whatever bus that is for: a driver of two has one map. */
static void check_register(const struct hw_interface *hw, const struct hw_record *record)
{
	for (const struct hw_record *other = hw->records; other != record; other = other->next) {
		if (other->kind == HW_REGISTER && other->offset == record->offset)
			hw_fail(hw->path, record->line, "offset 0x%03x is that of '%s' in line %lu",
				record->offset, other->name, other->line);
	}
}

static void check_record(const struct hw_interface *hw, struct hw_record *record)
{
	if (record->kind != HW_PACKET && record->kind != HW_REGISTER && !record->fields)
		hw_fail(hw->path, record->line, "'%s' has no fields", record->name);
	for (struct hw_field *field = record->fields; field; field = field->next) {
		resolve_type(hw, field);
		check_type(hw->path, field);
		check_range(hw->path, field);
		check_place(hw->path, record, field);
	}
	for (struct hw_field *field = record->fields; field; field = field->next)
		check_above(hw->path, record, field);
	for (const struct hw_field *field = record->fields; field; field = field->next)
		check_format(hw->path, record, field);
}

void hw_check(struct hw_interface *hw)
{
	for (const struct hw_constant *c = hw->constants; c; c = c->next) {
		if (hw_same(c->name, "version") && c->value != hw->version)
			hw_fail(hw->path, c->line,
				"constant 'version' is %u, the interface's is %u", c->value,
				hw->version);
	}
	for (const struct hw_bus *bus = hw->buses; bus; bus = bus->next)
		check_bus(hw, bus);
	for (const struct hw_enum *e = hw->enums; e; e = e->next)
		check_enum(hw->path, e);
	for (struct hw_record *record = hw->records; record; record = record->next)
		check_record(hw, record);
	for (const struct hw_record *record = hw->records; record; record = record->next) {
		if (record->kind == HW_PACKET)
			check_packet(hw, record);
		if (record->kind == HW_REGISTER)
			check_register(hw, record);
	}
}
