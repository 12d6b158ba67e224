// SPDX-License-Identifier: MIT
#include "api/proc.h"

#include <stdlib.h>
#include <string.h>

static int proc_compare(const void *name, const void *row)
{
	return strcmp(name, ((const struct gloss_proc_name *)row)->name);
}

gloss_proc gloss_proc_search(const struct gloss_proc_name *table, unsigned int count,
			     const char *name)
{
	const struct gloss_proc_name *row = bsearch(name, table, count, sizeof(*table),
						    proc_compare);

	return row ? row->proc : NULL;
}

gloss_proc gloss_proc_find(const char *name)
{
	return gloss_proc_search(gloss_proc_table, gloss_proc_count, name);
}
