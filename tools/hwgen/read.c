// SPDX-License-Identifier: MIT
/* Goes through the XML: each element is where it may be and has the attributes of its table in
 * elements.c, text is in a <doc>. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "hwgen/reader.h"

unsigned long hw_line_of(const struct reader *reader)
{
	/* Expat 2.9 deprecates what 2.5 alone has. */
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
	return XML_GetCurrentLineNumber64(reader->parser);
#else
	return XML_GetCurrentLineNumber(reader->parser);
#endif
}

static const struct element *find_element(const struct reader *reader, const char *name)
{
	const char *parent = reader->depth ? reader->open[reader->depth - 1].element->name : "";
	char key[32];

	for (const struct element *element = hw_elements; element->name; element++) {
		if (!hw_same(element->name, name))
			continue;
		snprintf(key, sizeof(key), " %s ", parent);
		if (reader->depth ? !strstr(element->parents, key) : *element->parents)
			break;
		return element;
	}
	if (!reader->depth)
		FAIL(reader, "the outermost element is <%s>, not <interface>", name);
	FAIL(reader, "<%s> does not belong in <%s>", name, parent);
}

/* Sorts the attributes into reader->attribute by the element's table. */
static void take_attributes(struct reader *reader, const struct element *element,
			    const char **attributes)
{
	memset((void *)reader->attribute, 0, sizeof(reader->attribute));
	for (; *attributes; attributes += 2) {
		unsigned int i = 0;

		while (i < ATTRIBUTES_MAX && element->attributes[i] &&
		       !hw_same(element->attributes[i] + (element->attributes[i][0] == '?'),
				attributes[0]))
			i++;
		if (i == ATTRIBUTES_MAX || !element->attributes[i])
			FAIL(reader, "<%s> has no attribute '%s'", element->name, attributes[0]);
		reader->attribute[i] = attributes[1];
	}
	for (unsigned int i = 0; i < ATTRIBUTES_MAX && element->attributes[i]; i++) {
		if (!reader->attribute[i] && element->attributes[i][0] != '?')
			FAIL(reader, "<%s> lacks the attribute '%s'", element->name,
			     element->attributes[i]);
	}
}

static void XMLCALL on_start(void *data, const char *name, const char **attributes)
{
	struct reader *reader = data;
	const struct element *element = find_element(reader, name);
	const char **doc;

	take_attributes(reader, element, attributes);
	doc = element->begin(reader, element);
	/* No path through the table is as long as DEPTH_MAX. */
	reader->open[reader->depth].element = element;
	reader->open[reader->depth].doc = doc;
	reader->depth++;
}

static void XMLCALL on_end(void *data, const char *name)
{
	struct reader *reader = data;

	(void)name;
	reader->depth--;
	if (!reader->in_doc)
		return;
	reader->in_doc = false;
	*reader->open[reader->depth - 1].doc = hw_copy(reader->text, reader->text_size);
	if (strstr(*reader->open[reader->depth - 1].doc, "/*") ||
	    strstr(*reader->open[reader->depth - 1].doc, "*/"))
		hw_fail(reader->hw->path, reader->doc_line,
			"a <doc> may not have the marks of a C comment in it");
}

static void XMLCALL on_text(void *data, const char *text, int length)
{
	struct reader *reader = data;

	if (reader->in_doc) {
		char *grown = realloc(reader->text, reader->text_size + (size_t)length);

		if (!grown)
			hw_fail(reader->hw->path, 0, "out of memory");
		reader->text = grown;
		memcpy(reader->text + reader->text_size, text, (size_t)length);
		reader->text_size += (size_t)length;
		return;
	}
	for (int i = 0; i < length; i++) {
		if (!strchr(" \t\r\n", text[i]))
			FAIL(reader, "text outside <doc>");
	}
}

static void parse(struct reader *reader, FILE *file)
{
	char buffer[8192];
	size_t size;
	bool end;

	do {
		size = fread(buffer, 1, sizeof(buffer), file);
		if (ferror(file))
			hw_fail(reader->hw->path, 0, "%s", strerror(errno));
		end = feof(file);
		if (!XML_Parse(reader->parser, buffer, (int)size, end))
			FAIL(reader, "%s", XML_ErrorString(XML_GetErrorCode(reader->parser)));
	} while (!end);
}

void hw_read(const char *path, struct hw_interface *hw)
{
	struct reader reader = { .hw = hw };
	FILE *file = fopen(path, "rb");

	hw->path = path;
	if (!file)
		hw_fail(path, 0, "%s", strerror(errno));
	reader.parser = XML_ParserCreate(NULL);
	if (!reader.parser)
		hw_fail(path, 0, "out of memory");
	XML_SetUserData(reader.parser, &reader);
	XML_SetElementHandler(reader.parser, on_start, on_end);
	XML_SetCharacterDataHandler(reader.parser, on_text);
	parse(&reader, file);
	XML_ParserFree(reader.parser);
	free(reader.text);
	fclose(file);
}
