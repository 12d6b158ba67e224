/* SPDX-License-Identifier: MIT */
/*
 * The XML on its way into the structs of hwgen.h. read.c goes through the file and sees that each
 * element is where it belongs and has the attributes it takes; elements.c knows what each means.
 */
#ifndef HWGEN_READER_H
#define HWGEN_READER_H

#include <expat.h>

#include "hwgen/hwgen.h"

#define DEPTH_MAX 8
#define ATTRIBUTES_MAX 8

struct reader {
	XML_Parser parser;
	struct hw_interface *hw;
	struct hw_enum *enumeration; /* the last one begun */
	struct hw_record *record;
	struct hw_bus *bus;
	const char *attribute[ATTRIBUTES_MAX]; /* of the element being begun, by its table */

	unsigned int depth;
	struct {
		const struct element *element;
		const char **doc; /* where a <doc> in it goes */
	} open[DEPTH_MAX];

	char *text; /* of the open <doc> */
	size_t text_size;
	bool in_doc;
	unsigned long doc_line;
};

struct element {
	const char *name;
	const char *parents;                    /* names with a space before and behind each */
	const char *attributes[ATTRIBUTES_MAX]; /* with '?' before it: may be left out */
	const char **(*begin)(struct reader *reader, const struct element *element);
};

/* All there are; they end with one without a name. */
extern const struct element hw_elements[];

unsigned long hw_line_of(const struct reader *reader);

#define FAIL(reader, ...) hw_fail((reader)->hw->path, hw_line_of(reader), __VA_ARGS__)

#endif
