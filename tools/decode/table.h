/* SPDX-License-Identifier: MIT */
/* The interface as data, for programs that print streams; gloss_table.h has the contents. */
#ifndef TABLE_H
#define TABLE_H

#include <stdbool.h>
#include <stdint.h>

enum table_type { TABLE_UINT, TABLE_INT, TABLE_BOOL, TABLE_ENUM };

struct table_value {
	uint32_t value;
	const char *name;
};

struct table_enum {
	const char *name;
	unsigned int count;
	const struct table_value *values;
};

struct table_field {
	const char *name;
	unsigned int word, high, low; /* word 0 of a packet is its header */
	enum table_type type;
	const struct table_enum *enumeration; /* of TABLE_ENUM */
	int64_t min, max;
	const struct table_field *rest; /* continues this one's bits upwards */
	unsigned int fraction;
	bool fixed;   /* a two's complement number with a fraction */
	bool hex;     /* how people read it */
	bool is_rest; /* continues another one's */
};

struct table_record {
	const char *name;
	unsigned int words; /* without a packet's header */
	unsigned int count;
	const struct table_field *fields;
};

/* A group in a packet's payload, if bits high:low of the header are the value. */
struct table_part {
	const struct table_record *group;
	unsigned int high, low;
	uint32_t value;
	bool always;
};

/* Payload: the words of the record, then the parts, then, if variable without parts, the rest. */
struct table_packet {
	unsigned int opcode;
	unsigned int least; /* fewest payload words, without parts */
	struct table_record record;
	const struct table_part *parts;
	unsigned int count;
	bool variable;
};

#endif
