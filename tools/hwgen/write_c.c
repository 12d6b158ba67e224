// SPDX-License-Identifier: MIT
/* Writes the C header: a struct, pack, unpack and range check for each record. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "hwgen/hwgen.h"

#define COLUMNS 100

struct writer {
	FILE *out;
	const struct hw_interface *hw;
	const char *name; /* of the interface: prefix of everything */
	char upper_name[HW_NAME_MAX];
	char upper[HW_NAME_MAX]; /* of the record being written */
};

static void write_constants(const struct writer *w)
{
	char upper[HW_NAME_MAX];

	for (const struct hw_constant *c = w->hw->constants; c; c = c->next) {
		if (c->doc)
			hw_comment(w->out, "", c->doc);
		fprintf(w->out, "#define %s_%s ", w->upper_name, hw_upper(upper, c->name));
		hw_number(w->out, c, "0x");
		fputs("u\n", w->out);
	}
	fputc('\n', w->out);
}

/* Is a number one of an enum's values? For those with gaps. */
static void write_known(const struct writer *w, const struct hw_enum *e)
{
	char upper[HW_NAME_MAX], value_upper[HW_NAME_MAX];

	fprintf(w->out, "static inline bool %s_%s_known(uint32_t value)\n{\n\tswitch (value) {\n",
		w->name, e->name);
	hw_upper(upper, e->name);
	for (const struct hw_value *v = e->values; v; v = v->next)
		fprintf(w->out, "\tcase %s_%s_%s:\n", w->upper_name, upper,
			hw_upper(value_upper, v->name));
	fputs("\t\treturn true;\n\tdefault:\n\t\treturn false;\n\t}\n}\n\n", w->out);
}

static void write_enums(const struct writer *w)
{
	char upper[HW_NAME_MAX], value_upper[HW_NAME_MAX];
	uint32_t last;

	for (const struct hw_enum *e = w->hw->enums; e; e = e->next) {
		if (e->doc)
			hw_comment(w->out, "", e->doc);
		fprintf(w->out, "enum %s_%s {\n", w->name, e->name);
		hw_upper(upper, e->name);
		for (const struct hw_value *v = e->values; v; v = v->next) {
			if (v->doc)
				hw_comment(w->out, "\t", v->doc);
			fprintf(w->out, "\t%s_%s_%s = %u,\n", w->upper_name, upper,
				hw_upper(value_upper, v->name), v->value);
		}
		fputs("};\n\n", w->out);
		if (!hw_enum_dense(e, &last))
			write_known(w, e);
	}
}

static void write_opcodes(const struct writer *w)
{
	char upper[HW_NAME_MAX];

	fprintf(w->out, "enum %s_opcode {\n", w->name);
	for (const struct hw_record *r = w->hw->records; r; r = r->next) {
		if (r->kind == HW_PACKET)
			fprintf(w->out, "\t%s_OP_%s = 0x%02x,\n", w->upper_name,
				hw_upper(upper, r->name), r->opcode);
	}
	fputs("};\n\n", w->out);
	fprintf(w->out,
		"/* A header: opcode in bits 31:24, payload length in words in bits 10:0,\n"
		" * bits 23:11 the packet's own. */\n"
		"#define %s_LENGTH_MAX %uu\n\n",
		w->upper_name, HW_LENGTH_MAX);
	fprintf(w->out,
		"static inline unsigned int %s_header_opcode(uint32_t header)\n{\n"
		"\treturn header >> 24;\n}\n\n"
		"static inline unsigned int %s_header_length(uint32_t header)\n{\n"
		"\treturn header & 0x%xu;\n}\n\n",
		w->name, w->name, HW_LENGTH_MAX);
}

static void write_struct(const struct writer *w, const struct hw_record *r)
{
	if (r->doc)
		hw_comment(w->out, "", r->doc);
	fprintf(w->out, "struct %s_%s {\n", w->name, r->name);
	for (const struct hw_field *f = r->fields; f; f = f->next) {
		static const char *const types[] = { "uint32_t", "int32_t", "bool" };

		if (f->doc)
			hw_comment(w->out, "\t", f->doc);
		if (f->type == HW_ENUM)
			fprintf(w->out, "\tenum %s_%s %s;\n", w->name, f->enumeration->name,
				f->name);
		else
			fprintf(w->out, "\t%s %s;\n", types[f->type], f->name);
	}
	fputs("};\n\n", w->out);
}

/* The bits of a field in its word; @alone if there is nothing else in the expression. */
static void pack_field(const struct writer *w, const struct hw_field *f, bool alone)
{
	const char *cast = f->type == HW_UINT ? "" : "(uint32_t)";
	unsigned int width = hw_width(f);

	if (width == 32 || f->type == HW_BOOL)
		fprintf(w->out, "%sp->%s", cast, f->name);
	else if (alone)
		fprintf(w->out, "%sp->%s & 0x%xu", cast, f->name, hw_mask(width));
	else
		fprintf(w->out, "(%sp->%s & 0x%xu)", cast, f->name, hw_mask(width));
	if (f->low)
		fprintf(w->out, " << %u", f->low);
}

/* "words[N] = ", a packet's opcode and length if it is word 0, and the fields, joined by |. */
static void pack_word(const struct writer *w, const struct hw_record *r, unsigned int word,
		      const char *length)
{
	int column = 8 + fprintf(w->out, "\twords[%u] = ", word) - 1;
	bool begun = length;
	unsigned int count = 0;

	for (const struct hw_field *f = r->fields; f; f = f->next)
		count += f->word == word;
	if (length)
		fprintf(w->out, "(uint32_t)%s_OP_%s << 24 | %s", w->upper_name, w->upper, length);
	for (const struct hw_field *f = r->fields; f; f = f->next) {
		if (f->word != word)
			continue;
		if (begun)
			fprintf(w->out, " |\n\t\t%*s", column - 16, "");
		begun = true;
		pack_field(w, f, count == 1 && !length && !f->low);
	}
	fputs(begun ? ";\n" : "0;\n", w->out);
}

/* Of pack (p is const) or unpack; @more is an argument behind p. */
static void write_signature(const struct writer *w, const struct hw_record *r, const char *verb,
			    const char *words, const char *p, const char *more)
{
	char pointer[3 * HW_NAME_MAX] = "";
	int column = fprintf(w->out, "static inline void %s_%s_%s(", w->name, r->name, verb);
	int length;

	if (r->fields)
		snprintf(pointer, sizeof(pointer), "%s %s_%s *p", p, w->name, r->name);
	length = column + (int)(strlen(words) + strlen(pointer) + strlen(more)) + 3;
	fputs(words, w->out);
	if (r->fields && length > COLUMNS) {
		fputs(",\n", w->out);
		for (; column >= 8; column -= 8)
			fputc('\t', w->out);
		fprintf(w->out, "%*s", column, "");
	} else if (r->fields) {
		fputs(", ", w->out);
	}
	fprintf(w->out, "%s%s)\n{\n", pointer, more);
}

static void write_pack(const struct writer *w, const struct hw_record *r)
{
	bool free_length = r->variable && !r->parts;
	unsigned int first = hw_first_word(r);
	char length[3 * HW_NAME_MAX];

	if (r->kind == HW_PACKET) {
		fputs("/* Writes the header", w->out);
		if (r->words > 1)
			fprintf(w->out, " and the %u words after it", r->words);
		else if (r->words)
			fputs(" and the word after it", w->out);
		fputs(free_length ? ". @length: payload words, at most 2047. */\n" : ". */\n",
		      w->out);
	}
	write_signature(w, r, "pack", "uint32_t *words", "const struct",
			free_length ? ", uint32_t length" : "");
	if (free_length)
		snprintf(length, sizeof(length), "length");
	else if (r->parts)
		snprintf(length, sizeof(length), "%s_%s_length(p)", w->name, r->name);
	else
		snprintf(length, sizeof(length), "%s_%s_WORDS", w->upper_name, w->upper);
	if (r->kind == HW_PACKET)
		pack_word(w, r, 0, length);
	for (unsigned int word = first; word < first + r->words; word++)
		pack_word(w, r, word, NULL);
	fputs("}\n\n", w->out);
}

/* The number in a field of the word called @word, as an expression. */
static const char *extract(char out[96], const struct hw_field *f, const char *word)
{
	unsigned int width = hw_width(f);

	if (f->type == HW_INT && width == 32)
		snprintf(out, 96, "(int32_t)%s", word);
	else if (f->type == HW_INT && f->high == 31)
		snprintf(out, 96, "(int32_t)%s >> %u", word, f->low);
	else if (f->type == HW_INT)
		snprintf(out, 96, "(int32_t)(%s << %u) >> %u", word, 31 - f->high, 32 - width);
	else if (width == 32)
		snprintf(out, 96, "%s", word);
	else if (f->high == 31)
		snprintf(out, 96, "%s >> %u", word, f->low);
	else if (f->low)
		snprintf(out, 96, "%s >> %u & 0x%xu", word, f->low, hw_mask(width));
	else
		snprintf(out, 96, "%s & 0x%xu", word, hw_mask(width));
	return out;
}

static void write_unpack(const struct writer *w, const struct hw_record *r)
{
	char word[32], value[96];

	if (r->kind == HW_PACKET)
		fputs("/* @words starts at the header. */\n", w->out);
	write_signature(w, r, "unpack", "const uint32_t *words", "struct", "");
	for (const struct hw_field *f = r->fields; f; f = f->next) {
		snprintf(word, sizeof(word), "words[%u]", f->word);
		extract(value, f, word);
		if (f->type == HW_ENUM)
			fprintf(w->out, "\tp->%s = (enum %s_%s)(%s);\n", f->name, w->name,
				f->enumeration->name, value);
		else
			fprintf(w->out, "\tp->%s = %s;\n", f->name, value);
	}
	fputs("}\n\n", w->out);
}

/* What can be wrong with a word, each a condition in C. */
struct terms {
	unsigned int count;
	char text[2 * 32 + 1][192];
};

__attribute__((format(printf, 2, 3))) static void add_term(struct terms *terms, const char *format,
							   ...)
{
	va_list arguments;

	va_start(arguments, format);
	vsnprintf(terms->text[terms->count++], sizeof(terms->text[0]), format, arguments);
	va_end(arguments);
}

static void collect_terms(const struct writer *w, struct terms *terms, const struct hw_record *r,
			  unsigned int number, const char *word)
{
	char value[96];
	uint32_t last;

	terms->count = 0;
	if (hw_reserved(r, number))
		add_term(terms, "(%s & 0x%08xu)", word, hw_reserved(r, number));
	for (const struct hw_field *f = r->fields; f; f = f->next) {
		bool brackets;

		if (f->word != number)
			continue;
		brackets = strchr(extract(value, f, word), ' ');
		if (f->type == HW_ENUM && !hw_enum_dense(f->enumeration, &last))
			add_term(terms, "!%s_%s_known(%s)", w->name, f->enumeration->name, value);
		else if (f->type == HW_ENUM && last < hw_mask(hw_width(f)))
			add_term(terms, "(%s) > %u", value, last);
		if (f->has_min)
			add_term(terms, brackets ? "(%s) < %lld" : "%s < %lld", value,
				 (long long)f->min);
		if (f->has_max)
			add_term(terms, brackets ? "(%s) > %lld" : "%s > %lld", value,
				 (long long)f->max);
	}
}

/* The terms joined by ||, in lines that begin at column @begin. */
static void write_terms(const struct writer *w, const struct terms *terms, int begin)
{
	int column = begin;
	size_t length = strlen(terms->text[0]);

	if (terms->count == 1 && terms->text[0][0] == '(' && terms->text[0][length - 1] == ')') {
		fprintf(w->out, "%.*s", (int)length - 2, terms->text[0] + 1);
		return;
	}
	for (unsigned int i = 0; i < terms->count; i++) {
		if (i && column + 4 + (int)strlen(terms->text[i]) > COLUMNS - 3) {
			fprintf(w->out, " ||\n%.*s%*s", begin / 8, "\t\t\t\t", begin % 8, "");
			column = begin;
		} else if (i) {
			column += fprintf(w->out, " || ");
		}
		column += fprintf(w->out, "%s", terms->text[i]);
	}
}

static void write_invalid(const struct writer *w, const struct hw_record *r)
{
	unsigned int first = hw_first_word(r);
	bool any = false;

	fprintf(w->out,
		"/* @words: the %u %s. Index of the first with a reserved bit set or a\n"
		" * field out of range, or -1. */\n",
		r->words, r->kind == HW_PACKET ? "behind the header" : "of the group");
	fprintf(w->out, "static inline int %s_%s_invalid(const uint32_t *words)\n{\n", w->name,
		r->name);
	for (unsigned int i = 0; i < r->words; i++) {
		struct terms terms;
		char word[32];

		snprintf(word, sizeof(word), "words[%u]", i);
		collect_terms(w, &terms, r, first + i, word);
		if (!terms.count)
			continue;
		any = true;
		fputs("\tif (", w->out);
		write_terms(w, &terms, 12);
		fprintf(w->out, ")\n\t\treturn %u;\n", i);
	}
	fprintf(w->out, "%s\treturn -1;\n}\n\n", any ? "" : "\t(void)words;\n");
}

static void write_length(const struct writer *w, const struct hw_record *r)
{
	char enum_upper[HW_NAME_MAX], upper[HW_NAME_MAX];

	fprintf(w->out,
		"/* Payload words of a packet with this header. */\n"
		"static inline uint32_t %s_%s_length(const struct %s_%s *p)\n{\n"
		"\tuint32_t length = 0;\n\n",
		w->name, r->name, w->name, r->name);
	for (const struct hw_part *part = r->parts; part; part = part->next) {
		const struct hw_field *f = part->condition;

		if (f && f->type == HW_ENUM)
			fprintf(w->out, "\tif (p->%s == %s_%s_%s)\n\t", f->name, w->upper_name,
				hw_upper(enum_upper, f->enumeration->name),
				hw_upper(upper, part->is_name));
		else if (f && f->type == HW_BOOL)
			fprintf(w->out, "\tif (%sp->%s)\n\t", part->value ? "" : "!", f->name);
		else if (f)
			fprintf(w->out, "\tif (p->%s == %u)\n\t", f->name, part->value);
		fprintf(w->out, "\tlength += %s_%s_WORDS;\n", w->upper_name,
			hw_upper(upper, part->group->name));
	}
	fputs("\treturn length;\n}\n\n", w->out);
}

static void write_records(struct writer *w, enum hw_kind kind)
{
	for (const struct hw_record *r = w->hw->records; r; r = r->next) {
		if (r->kind != kind)
			continue;
		hw_upper(w->upper, r->name);
		fprintf(w->out, "/* ---- %s ---- */\n\n", r->name);
		if (r->has_words)
			fprintf(w->out, "#define %s_%s_WORDS %u\n\n", w->upper_name, w->upper,
				r->words);
		if (r->fields) {
			write_struct(w, r);
		} else if (r->doc) {
			hw_comment(w->out, "", r->doc);
			fputc('\n', w->out);
		}
		if (r->parts)
			write_length(w, r);
		write_pack(w, r);
		if (r->fields)
			write_unpack(w, r);
		if (r->words && kind != HW_STRUCT)
			write_invalid(w, r);
	}
}

static void write_header_checks(struct writer *w)
{
	struct terms terms;

	fprintf(w->out,
		"/* ---- any packet ---- */\n\n"
		"static inline bool %s_opcode_known(unsigned int opcode)\n{\n"
		"\tswitch (opcode) {\n",
		w->name);
	for (const struct hw_record *r = w->hw->records; r; r = r->next) {
		if (r->kind == HW_PACKET)
			fprintf(w->out, "\tcase %s_OP_%s:\n", w->upper_name,
				hw_upper(w->upper, r->name));
	}
	fputs("\t\treturn true;\n\tdefault:\n\t\treturn false;\n\t}\n}\n\n", w->out);
	fprintf(w->out,
		"/* Are the header's reserved bits zero and its fields in range? The opcode is known. */\n"
		"static inline bool %s_header_valid(uint32_t header)\n{\n"
		"\tswitch (%s_header_opcode(header)) {\n",
		w->name, w->name);
	for (const struct hw_record *r = w->hw->records; r; r = r->next) {
		if (r->kind != HW_PACKET)
			continue;
		collect_terms(w, &terms, r, 0, "header");
		fprintf(w->out, "\tcase %s_OP_%s:\n\t\treturn ", w->upper_name,
			hw_upper(w->upper, r->name));
		if (terms.count) {
			fputs("!(", w->out);
			write_terms(w, &terms, 25);
			fputs(");\n", w->out);
		} else {
			fputs("true;\n", w->out);
		}
	}
	fputs("\tdefault:\n\t\treturn false;\n\t}\n}\n\n", w->out);
}

void hw_write_c(FILE *out, const struct hw_interface *hw)
{
	struct writer w = { .out = out, .hw = hw, .name = hw->name };

	hw_upper(w.upper_name, hw->name);
	fprintf(out,
		"/* SPDX-License-Identifier: MIT */\n"
		"/* Generated from rtl/%s.xml by tools/hwgen; do not edit. */\n"
		"#ifndef %s_PACKETS_H\n#define %s_PACKETS_H\n\n"
		"#include <stdbool.h>\n#include <stdint.h>\n\n",
		hw->name, w.upper_name, w.upper_name);
	write_constants(&w);
	write_enums(&w);
	write_opcodes(&w);
	write_records(&w, HW_GROUP);
	write_records(&w, HW_PACKET);
	write_records(&w, HW_STRUCT);
	write_header_checks(&w);
	fputs("#endif\n", out);
}
