// SPDX-License-Identifier: MIT
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "transport/transport.h"

void accel_transport_say(struct accel_transport_error *error, const char *format, ...)
{
	va_list arguments;

	va_start(arguments, format);
	vsnprintf(error->text, sizeof(error->text), format, arguments);
	va_end(arguments);
}

void accel_transport_copy(const struct accel_transport_job *job, void *to)
{
	const struct accel_transport_part whole = { job->stream, job->stream_words };
	const struct accel_transport_part *part = job->stream ? &whole : job->part;
	size_t left = job->stream_words;
	char *at = to;

	while (left) {
		memcpy(at, part->words, part->count * sizeof(*part->words));
		at += part->count * sizeof(*part->words);
		left -= part->count;
		part++;
	}
}
