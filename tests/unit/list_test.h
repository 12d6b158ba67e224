/* SPDX-License-Identifier: MIT */
/* The list of devices, or of those of a kind, as a text that a test compares. */
#ifndef LIST_TEST_H
#define LIST_TEST_H

#include "accel_test.h"

struct listed {
	const char *kind; /* what the names begin with, "usb:" */
	char text[1024];  /* NAME|LINE of each */
	int count;
};

/* For accel_device_list. */
static inline void list_take(void *data, const char *name, const char *line)
{
	struct listed *listed = data;
	size_t length = strlen(listed->text);

	assert_true(*name && *line);
	if (strncmp(name, listed->kind, strlen(listed->kind)) != 0)
		return;
	snprintf(listed->text + length, sizeof(listed->text) - length, "%s|%s\n", name, line);
	listed->count++;
}

#endif
