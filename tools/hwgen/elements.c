// SPDX-License-Identifier: MIT
/* What each element of the XML means: where it may be, its attributes, and what it becomes. What is
 * refused here is what can be seen at one element, such as numbers that are not numbers. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "hwgen/reader.h"

#define APPEND(list, item)                        \
	do {                                      \
		__typeof__(list) *end_ = &(list); \
		while (*end_)                     \
			end_ = &(*end_)->next;    \
		*end_ = (item);                   \
	} while (0)

static int64_t read_number(const struct reader *reader, const char *what, const char *text,
			   int64_t min, int64_t max)
{
	const char *digits = text + (*text == '-');
	bool hex = digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
	const char *set = hex ? "0123456789abcdefABCDEF" : "0123456789";
	long long value;

	digits += hex ? 2 : 0;
	if (!*digits || digits[strspn(digits, set)])
		FAIL(reader, "%s '%s' is not a number", what, text);
	errno = 0;
	value = strtoll(text, NULL, hex ? 16 : 10);
	if (errno || value < min || value > max)
		FAIL(reader, "%s %s is not between %lld and %lld", what, text, (long long)min,
		     (long long)max);
	return value;
}

/* "high:low" */
static void read_bits(const struct reader *reader, const char *text, struct hw_field *field)
{
	const char *colon = strchr(text, ':');
	char high[8] = "";

	if (!colon || (size_t)(colon - text) >= sizeof(high))
		FAIL(reader, "bits '%s' are not of the form high:low", text);
	memcpy(high, text, (size_t)(colon - text));
	field->high = (unsigned int)read_number(reader, "high bit", high, 0, 31);
	field->low = (unsigned int)read_number(reader, "low bit", colon + 1, 0, 31);
	if (field->high < field->low)
		FAIL(reader, "bits '%s': high is below low", text);
}

static const char **begin_interface(struct reader *reader, const struct element *element)
{
	struct hw_interface *hw = reader->hw;

	(void)element;
	hw->line = hw_line_of(reader);
	hw->name = hw_copy(reader->attribute[0], strlen(reader->attribute[0]));
	hw->version = (uint32_t)read_number(reader, "version", reader->attribute[1], 0, UINT32_MAX);
	return &hw->doc;
}

static const char *copy(const char *text)
{
	return text ? hw_copy(text, strlen(text)) : NULL;
}

static const char **begin_port(struct reader *reader, const struct element *element)
{
	struct hw_interface *hw = reader->hw;

	(void)element;
	if (hw->has_port)
		FAIL(reader, "a second <port>");
	hw->has_port = true;
	return &hw->port_doc;
}

static const char **begin_bus(struct reader *reader, const struct element *element)
{
	struct hw_bus *bus = hw_alloc(sizeof(*bus));

	(void)element;
	bus->line = hw_line_of(reader);
	bus->name = copy(reader->attribute[0]);
	APPEND(reader->hw->buses, bus);
	reader->bus = bus;
	return &bus->doc;
}

/* Is the element being begun directly in an element @name? */
static bool is_in(const struct reader *reader, const char *name)
{
	return hw_same(reader->open[reader->depth - 1].element->name, name);
}

static const struct hw_bus *bus_of(const struct reader *reader)
{
	return is_in(reader, "bus") ? reader->bus : NULL;
}

static const char **begin_constant(struct reader *reader, const struct element *element)
{
	struct hw_constant *constant = hw_alloc(sizeof(*constant));

	(void)element;
	constant->line = hw_line_of(reader);
	constant->name = copy(reader->attribute[0]);
	constant->value = (uint32_t)read_number(reader, "value", reader->attribute[1], 0,
						UINT32_MAX);
	constant->hex = reader->attribute[1][1] == 'x' || reader->attribute[1][1] == 'X';
	constant->bus = bus_of(reader);
	constant->port = constant->bus || is_in(reader, "port");
	APPEND(reader->hw->constants, constant);
	return &constant->doc;
}

static const char **begin_enum(struct reader *reader, const struct element *element)
{
	struct hw_enum *enumeration = hw_alloc(sizeof(*enumeration));

	(void)element;
	enumeration->line = hw_line_of(reader);
	enumeration->name = copy(reader->attribute[0]);
	enumeration->bits = (unsigned int)read_number(reader, "bits", reader->attribute[1], 1, 31);
	APPEND(reader->hw->enums, enumeration);
	reader->enumeration = enumeration;
	return &enumeration->doc;
}

static const char **begin_value(struct reader *reader, const struct element *element)
{
	struct hw_value *value = hw_alloc(sizeof(*value));

	(void)element;
	value->line = hw_line_of(reader);
	value->name = copy(reader->attribute[0]);
	value->value = (uint32_t)read_number(reader, "value", reader->attribute[1], 0, UINT32_MAX);
	APPEND(reader->enumeration->values, value);
	return &value->doc;
}

static struct hw_record *add_record(struct reader *reader, enum hw_kind kind, const char *words)
{
	struct hw_record *record = hw_alloc(sizeof(*record));

	record->kind = kind;
	record->line = hw_line_of(reader);
	record->name = copy(reader->attribute[0]);
	record->bus = bus_of(reader);
	record->port = record->bus || is_in(reader, "port");
	record->has_words = words;
	if (words)
		record->words = (unsigned int)read_number(reader, "words", words,
							  kind == HW_PACKET ? 0 : 1, HW_LENGTH_MAX);
	APPEND(reader->hw->records, record);
	reader->record = record;
	return record;
}

/* <group> and <struct> */
static const char **begin_words(struct reader *reader, const struct element *element)
{
	enum hw_kind kind = !hw_same(element->name, "group") ? HW_STRUCT : HW_GROUP;

	return &add_record(reader, kind, reader->attribute[1])->doc;
}

static const char **begin_register(struct reader *reader, const struct element *element)
{
	struct hw_record *record = add_record(reader, HW_REGISTER, "1");
	unsigned int access = HW_RO;

	(void)element;
	record->offset = (unsigned int)read_number(reader, "offset", reader->attribute[1], 0,
						   UINT16_MAX);
	if (record->offset % 4)
		FAIL(reader, "offset 0x%x is not a multiple of 4", record->offset);
	while (access <= HW_RW1C &&
	       !hw_same(reader->attribute[2], hw_access_name((enum hw_access)access)))
		access++;
	if (access > HW_RW1C)
		FAIL(reader, "access is '%s', not 'ro', 'rw' or 'rw1c'", reader->attribute[2]);
	record->access = (enum hw_access)access;
	return &record->doc;
}

static const char **begin_packet(struct reader *reader, const struct element *element)
{
	struct hw_record *record = add_record(reader, HW_PACKET, reader->attribute[2]);
	const char *variable = reader->attribute[3], *least = reader->attribute[4];

	(void)element;
	record->opcode = (unsigned int)read_number(reader, "opcode", reader->attribute[1], 0, 255);
	if (variable && !hw_same(variable, "yes") && !hw_same(variable, "no"))
		FAIL(reader, "variable is '%s', not 'yes' or 'no'", variable);
	record->variable = variable && hw_same(variable, "yes");
	record->least = record->words;
	if (least)
		record->least = (unsigned int)read_number(reader, "least", least, record->words + 1,
							  HW_LENGTH_MAX);
	if (!record->variable && !record->has_words)
		FAIL(reader, "packet '%s' has neither words nor variable=\"yes\"", record->name);
	if (!record->variable && least)
		FAIL(reader, "least is for packets with variable=\"yes\"");
	return &record->doc;
}

static const char **begin_field(struct reader *reader, const struct element *element)
{
	struct hw_field *field = hw_alloc(sizeof(*field));
	const char *const *attribute = reader->attribute;

	(void)element;
	field->line = hw_line_of(reader);
	field->name = copy(attribute[0]);
	field->word = (unsigned int)read_number(reader, "word", attribute[1], 0, HW_LENGTH_MAX);
	read_bits(reader, attribute[2], field);
	field->type_name = attribute[3] ? copy(attribute[3]) : "uint";
	field->has_min = attribute[4];
	if (attribute[4])
		field->min = read_number(reader, "min", attribute[4], INT32_MIN, UINT32_MAX);
	field->has_max = attribute[5];
	if (attribute[5])
		field->max = read_number(reader, "max", attribute[5], INT32_MIN, UINT32_MAX);
	field->format = copy(attribute[6]);
	field->above_name = copy(attribute[7]);
	APPEND(reader->record->fields, field);
	return &field->doc;
}

static const char **begin_part(struct reader *reader, const struct element *element)
{
	struct hw_part *part = hw_alloc(sizeof(*part));

	(void)element;
	part->line = hw_line_of(reader);
	part->group_name = copy(reader->attribute[0]);
	part->if_name = copy(reader->attribute[1]);
	part->is_name = copy(reader->attribute[2]);
	if (!part->if_name != !part->is_name)
		FAIL(reader, "part '%s' needs both 'if' and 'is', or neither", part->group_name);
	APPEND(reader->record->parts, part);
	return NULL;
}

static const char **begin_doc(struct reader *reader, const struct element *element)
{
	const char **doc = reader->open[reader->depth - 1].doc;

	(void)element;
	if (*doc)
		FAIL(reader, "<%s> has a second <doc>",
		     reader->open[reader->depth - 1].element->name);
	reader->in_doc = true;
	reader->doc_line = hw_line_of(reader);
	reader->text_size = 0;
	return NULL;
}

const struct element hw_elements[] = {
	{ "interface", "", { "name", "version" }, begin_interface },
	{ "port", " interface ", { NULL }, begin_port },
	{ "bus", " port ", { "name" }, begin_bus },
	{ "register", " port bus ", { "name", "offset", "access" }, begin_register },
	{ "constant", " interface port bus ", { "name", "value" }, begin_constant },
	{ "enum", " interface ", { "name", "bits" }, begin_enum },
	{ "value", " enum ", { "name", "value" }, begin_value },
	{ "group", " interface ", { "name", "words" }, begin_words },
	{ "packet",
	  " interface ",
	  { "name", "opcode", "?words", "?variable", "?least" },
	  begin_packet },
	{ "struct", " interface port bus ", { "name", "words" }, begin_words },
	{ "field",
	  " group packet struct register ",
	  { "name", "word", "bits", "?type", "?min", "?max", "?format", "?above" },
	  begin_field },
	{ "part", " packet ", { "group", "?if", "?is" }, begin_part },
	{ "doc",
	  " interface port bus constant enum value group packet struct register field ",
	  { NULL },
	  begin_doc },
	{ .name = NULL },
};
