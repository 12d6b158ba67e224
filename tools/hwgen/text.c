// SPDX-License-Identifier: MIT
/* Doc text into comments and Markdown. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "hwgen/hwgen.h"

char *hw_upper(char *out, const char *name)
{
	size_t i;

	for (i = 0; i < HW_NAME_MAX - 1 && name[i]; i++)
		out[i] = (char)toupper((unsigned char)name[i]);
	out[i] = '\0';
	return out;
}

char *hw_camel(char *out, const char *name)
{
	bool begin = true;
	size_t size = 0;

	for (; *name && size < HW_NAME_MAX - 1; name++) {
		if (*name == '_') {
			begin = true;
			continue;
		}
		out[size++] = (char)(begin ? toupper((unsigned char)*name) : *name);
		begin = false;
	}
	out[size] = '\0';
	return out;
}

void hw_number(FILE *out, const struct hw_constant *constant, const char *hex_prefix)
{
	if (constant->hex)
		fprintf(out, "%s%x", hex_prefix, constant->value);
	else
		fprintf(out, "%u", constant->value);
}

/* Markdown takes these for its own; a '<' only where a tag could begin. */
static bool escaped(const char *text, enum hw_markup markup)
{
	if (markup == HW_PLAIN)
		return false;
	return strchr("*|`\\", *text) || (*text == '<' && text[1] && !strchr(" =", text[1]));
}

static size_t word_length(const char *text)
{
	return strcspn(text, " \t\r\n");
}

static unsigned int written_length(const char *word, size_t length, enum hw_markup markup)
{
	unsigned int written = (unsigned int)length;

	for (size_t i = 0; i < length; i++)
		written += escaped(word + i, markup);
	return written;
}

static void write_word(FILE *out, const char *word, size_t length, enum hw_markup markup)
{
	for (size_t i = 0; i < length; i++)
		fprintf(out, escaped(word + i, markup) ? "\\%c" : "%c", word[i]);
}

/* A line that begins with one of these would be a list, a heading or a quotation. */
static bool needs_company(const char *word, size_t length)
{
	return (length == 1 && strchr("+-*>#=", *word)) ||
	       (isdigit((unsigned char)*word) && word[length - 1] == '.');
}

/* Skips blanks; says whether an empty line was among them. */
static const char *skip_blanks(const char *text, bool *paragraph)
{
	unsigned int newlines = 0;

	for (; *text && strchr(" \t\r\n", *text); text++)
		newlines += *text == '\n';
	*paragraph = newlines > 1;
	return text;
}

void hw_wrap(FILE *out, const char *text, const char *first, const char *prefix,
	     unsigned int columns, enum hw_markup markup)
{
	unsigned int column = 0;
	bool paragraph;

	for (text = skip_blanks(text, &paragraph); *text; text = skip_blanks(text, &paragraph)) {
		size_t length = word_length(text);
		unsigned int written = written_length(text, length, markup);

		if (column && paragraph) {
			int bare = (int)strlen(prefix);

			while (bare && prefix[bare - 1] == ' ')
				bare--;
			fprintf(out, "\n%.*s\n", bare, prefix);
			column = 0;
		} else if (column && column + 1 + written > columns &&
			   !needs_company(text, length)) {
			fputc('\n', out);
			column = 0;
		}
		column += (unsigned int)fprintf(out, "%s", column ? " " : first) + written;
		first = prefix;
		write_word(out, text, length, markup);
		text += length;
	}
	fputc('\n', out);
}

void hw_line(FILE *out, const char *text, enum hw_markup markup, bool sentence)
{
	bool paragraph;
	const char *space = "";

	for (text = skip_blanks(text, &paragraph); *text; text = skip_blanks(text, &paragraph)) {
		size_t length = word_length(text);

		fputs(space, out);
		write_word(out, text, length, markup);
		if (sentence && text[length - 1] == '.')
			return;
		text += length;
		space = " ";
	}
}

#define COMMENT_COLUMNS 100u

void hw_comment(FILE *out, const char *indent, const char *text)
{
	unsigned int tab = indent[0] ? 8 : 0;
	char prefix[16], *line = NULL;
	size_t size = 0;
	FILE *memory = open_memstream(&line, &size);

	if (!memory)
		hw_fail("hwgen", 0, "out of memory");
	hw_line(memory, text, HW_PLAIN, false);
	if (fclose(memory))
		hw_fail("hwgen", 0, "out of memory");
	if (tab + size + 6 <= COMMENT_COLUMNS && !strstr(text, "\n\n")) {
		fprintf(out, "%s/* %s */\n", indent, line);
	} else {
		snprintf(prefix, sizeof(prefix), "%s * ", indent);
		fprintf(out, "%s/*\n", indent);
		hw_wrap(out, text, prefix, prefix, COMMENT_COLUMNS - (tab ? tab - 1 : 0), HW_PLAIN);
		fprintf(out, "%s */\n", indent);
	}
	free(line);
}
