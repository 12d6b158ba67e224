// SPDX-License-Identifier: MIT
/* The end of the program at the first fault, and memory until its end. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "hwgen/hwgen.h"

/* Everything hw_alloc gave out, so that a leak checker finds it. */
struct block {
	struct block *next;
};

static struct block *blocks;

void hw_fail(const char *path, unsigned long line, const char *format, ...)
{
	va_list arguments;

	fprintf(stderr, line ? "%s:%lu: " : "%s: ", path, line);
	va_start(arguments, format);
	vfprintf(stderr, format, arguments);
	va_end(arguments);
	fputc('\n', stderr);
	exit(1);
}

void *hw_alloc(size_t size)
{
	struct block *block = calloc(1, sizeof(*block) + size);

	if (!block)
		hw_fail("hwgen", 0, "out of memory");
	block->next = blocks;
	blocks = block;
	return block + 1;
}

char *hw_copy(const char *text, size_t length)
{
	char *copy = hw_alloc(length + 1);

	if (length)
		memcpy(copy, text, length);
	return copy;
}

void hw_free(void)
{
	while (blocks) {
		struct block *next = blocks->next;

		free(blocks);
		blocks = next;
	}
}
