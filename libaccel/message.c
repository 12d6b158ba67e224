// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "accel_priv.h"

/* One call, so that the lines of several threads do not mix. */
void accel_message_print(void *file, const char *line)
{
	fprintf(file ? file : stderr, "%s\n", line);
}
