/* SPDX-License-Identifier: MIT */
/*
 * hwgen: from rtl/gloss.xml to everything that has to agree with it.
 *
 *   read.c           goes through the XML: nesting, attributes, text
 *   elements.c       each element to the structs below; numbers
 *   check.c          what a grammar can not say: references, overlaps, ranges
 *   names.c          every identifier that will be written: keywords, clashes
 *   words.c          the keywords
 *   write_c.c        C packers and unpackers
 *   write_regs.c     C offsets and masks of the port, for the kernel too
 *   write_sv.c       SystemVerilog constants and packed structs
 *   write_table.c    the decoder's table
 *   write_manual.c   the manual
 *   text.c           wrapping of doc text, for all of them
 *   base.c           faults and memory
 *   main.c           arguments and files
 *
 * The first thing wrong ends the program: hw_fail names file and line.
 */
#ifndef HWGEN_H
#define HWGEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Bits of a header: opcode 31:24, length 10:0, the packet's own between them. */
#define HW_HEADER_HIGH 23u
#define HW_HEADER_LOW 11u
#define HW_LENGTH_MAX 2047u

enum hw_type { HW_UINT, HW_INT, HW_BOOL, HW_ENUM };
enum hw_kind { HW_GROUP, HW_PACKET, HW_STRUCT, HW_REGISTER };
enum hw_access { HW_RO, HW_RW, HW_RW1C };

/* Lists are in the order of the XML; doc is NULL where there is none. */

/* A bus that the port can be on: what is inside <bus> only ports on that one have. */
struct hw_bus {
	struct hw_bus *next;
	const char *name, *doc;
	unsigned long line;
};

struct hw_constant {
	struct hw_constant *next;
	const char *name, *doc;
	unsigned long line;
	uint32_t value;
	bool hex; /* as it is written in the XML */
	bool port;
	const struct hw_bus *bus; /* inside <port>: of this bus only, or NULL */
};

struct hw_value {
	struct hw_value *next;
	const char *name, *doc;
	unsigned long line;
	uint32_t value;
};

struct hw_enum {
	struct hw_enum *next;
	const char *name, *doc;
	unsigned long line;
	unsigned int bits;
	struct hw_value *values;
};

struct hw_field {
	struct hw_field *next;
	const char *name, *doc;
	unsigned long line;
	unsigned int word, high, low;
	const char *type_name;
	enum hw_type type;                 /* by hw_check, as the pointers */
	const struct hw_enum *enumeration; /* of type HW_ENUM */
	bool has_min, has_max;
	int64_t min, max;
	const char *format; /* for people: "hex", "s10.22", or NULL */
	const char *above_name;
	const struct hw_field *above; /* these bits continue that field's upwards */
};

/* A group that is part of a packet's payload, if a header field has a value. */
struct hw_part {
	struct hw_part *next;
	unsigned long line;
	const char *group_name, *if_name, *is_name;
	const struct hw_record *group;
	const struct hw_field *condition; /* NULL: always */
	uint32_t value;
};

/* A packet's word 0 is its header, its payload the words from 1 on. A register is one word. */
struct hw_record {
	struct hw_record *next;
	enum hw_kind kind;
	const char *name, *doc;
	unsigned long line;
	bool has_words, variable;
	bool port;                /* inside <port> */
	const struct hw_bus *bus; /* there, of this bus only, or NULL */
	unsigned int words;       /* without a packet's header */
	unsigned int opcode;
	unsigned int offset; /* of a register, in bytes */
	enum hw_access access;
	unsigned int least; /* fewest payload words, without parts */
	struct hw_field *fields;
	struct hw_part *parts;
};

struct hw_interface {
	const char *path;
	const char *name, *doc;
	unsigned long line;
	uint32_t version;
	bool has_port;
	const char *port_doc;
	struct hw_bus *buses;
	struct hw_constant *constants;
	struct hw_enum *enums;
	struct hw_record *records;
};

/* Prints "path:line: message" (line 0: without) and exits with 1. */
void hw_fail(const char *path, unsigned long line, const char *format, ...)
	__attribute__((noreturn, format(printf, 3, 4)));

/* Zeroed memory that lives until hw_free(). */
void *hw_alloc(size_t size);
char *hw_copy(const char *text, size_t length);
void hw_free(void);

void hw_read(const char *path, struct hw_interface *hw);
void hw_check(struct hw_interface *hw);
void hw_check_names(const struct hw_interface *hw);

void hw_write_c(FILE *out, const struct hw_interface *hw);
void hw_write_regs(FILE *out, const struct hw_interface *hw);
void hw_write_sv(FILE *out, const struct hw_interface *hw);
void hw_write_table(FILE *out, const struct hw_interface *hw);
void hw_write_manual(FILE *out, const struct hw_interface *hw);

/* The language (of C and C++, or SystemVerilog) whose keyword @name is, or NULL. */
const char *hw_keyword_c(const char *name);
const char *hw_keyword_sv(const char *name);

/* ---- questions every writer asks ---- */

/* The field that has bit @bit of word @word, or NULL. */
const struct hw_field *hw_field_at(const struct hw_record *record, unsigned int word,
				   unsigned int bit);
/* Bits of word @word that no field has; of a packet's word 0, those of the packet's own. */
uint32_t hw_reserved(const struct hw_record *record, unsigned int word);
/* Word of the record @words are counted from: a packet's payload begins at 1. */
static inline unsigned int hw_first_word(const struct hw_record *record)
{
	return record->kind == HW_PACKET ? 1 : 0;
}
static inline unsigned int hw_width(const struct hw_field *field)
{
	return field->high - field->low + 1;
}
static inline uint32_t hw_mask(unsigned int width)
{
	return width < 32 ? (1u << width) - 1 : 0xffffffffu;
}
/* "ro", "rw" or "rw1c". */
const char *hw_access_name(enum hw_access access);
/* Are an enum's values 0 to n-1? Then *@last is n-1, or the largest value. */
bool hw_enum_dense(const struct hw_enum *enumeration, uint32_t *last);

/* ---- text ---- */

#define HW_NAME_MAX 128u

static inline bool hw_same(const char *a, const char *b)
{
	return strcmp(a, b) == 0;
}

/* A constant's value as the XML has it, decimal or @hex_prefix and hexadecimal digits. */
void hw_number(FILE *out, const struct hw_constant *constant, const char *hex_prefix);

/* upper: COLOUR_MASK; camel: ColourMask. @out has HW_NAME_MAX bytes. */
char *hw_upper(char *out, const char *name);
char *hw_camel(char *out, const char *name);

/* What doc text has to survive. */
enum hw_markup { HW_PLAIN, HW_MARKDOWN };

/*
 * Writes doc text in lines of up to @columns, with @first before the first
 * line and @prefix before the others; an empty line of the text ends a
 * paragraph and becomes a bare prefix.
 */
void hw_wrap(FILE *out, const char *text, const char *first, const char *prefix,
	     unsigned int columns, enum hw_markup markup);
/* The text as a C comment behind @indent, which is empty or a tab. */
void hw_comment(FILE *out, const char *indent, const char *text);
/* The text in one line, for tables; with @sentence only its first sentence. */
void hw_line(FILE *out, const char *text, enum hw_markup markup, bool sentence);

#endif
