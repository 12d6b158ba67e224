/* SPDX-License-Identifier: MIT */
/*
 * gloss-info: what boards there are, and what one says of itself; in lines for people and in
 * JSON. A board's texts come from outside: none reaches a terminal or a shell as more than text.
 */
#ifndef TOOLS_INFO_H
#define TOOLS_INFO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "accel.h"

/* A board of a list. */
struct info_entry {
	char *name; /* as --device takes it */
	char *line; /* for people */
};

struct info_list {
	struct info_entry *entry;
	size_t count;
	bool no_memory; /* an entry is missing */
};

/* What a board says once it is open. */
struct info_board {
	const char *device; /* the name it was opened by */
	struct accel_device_info info;
	bool counts; /* there are clocks */
	struct accel_device_clocks clocks;
};

/* list.c. An accel_device_list_fn, @data a struct info_list that is zero at first. */
void info_list_add(void *data, const char *name, const char *line);
void info_list_free(struct info_list *list);

/* print.c */
void info_print_list(FILE *file, const struct info_list *list);
void info_print_board(FILE *file, const struct info_board *board);

/* json.c */
void info_json_list(FILE *file, const struct info_list *list);
void info_json_board(FILE *file, const struct info_board *board);

#endif
