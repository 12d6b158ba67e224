// SPDX-License-Identifier: MIT
#include <stdlib.h>
#include <string.h>

#include "info/info.h"

void info_list_add(void *data, const char *name, const char *line)
{
	struct info_list *list = data;
	struct info_entry *entry;

	entry = realloc(list->entry, (list->count + 1) * sizeof(*entry));
	if (!entry) {
		list->no_memory = true;
		return;
	}
	list->entry = entry;
	entry += list->count;
	entry->name = strdup(name);
	entry->line = strdup(line);
	list->count++;
	if (entry->name && entry->line)
		return;
	list->no_memory = true;
	list->count--;
	free(entry->name);
	free(entry->line);
}

void info_list_free(struct info_list *list)
{
	for (size_t i = 0; i < list->count; i++) {
		free(list->entry[i].name);
		free(list->entry[i].line);
	}
	free(list->entry);
}
