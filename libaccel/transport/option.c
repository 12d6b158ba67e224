// SPDX-License-Identifier: MIT
#include <ctype.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "transport/option.h"

/* Names are short; what a person typed wrong may not be. */
#define SHOWN 60

static bool option_allows(const struct accel_option *option, uint64_t value)
{
	if (value < option->min || value > option->max)
		return false;
	if (!option->multiple_of)
		return (value & (value - 1)) == 0;
	return value % option->multiple_of == 0;
}

/* Only digits are a number: strtoull alone takes signs and spaces. */
static bool option_number(const char *text, size_t length, uint64_t *value)
{
	char *end;

	if (!length || !isdigit((unsigned char)*text))
		return false;
	errno = 0;
	*value = strtoull(text, &end, 10);
	return !errno && end == text + length;
}

static void option_refuse(const struct accel_option *option, struct accel_transport_error *error)
{
	if (option->multiple_of == 1)
		accel_transport_say(error, "%s takes a number from %llu to %llu", option->name,
				    (unsigned long long)option->min,
				    (unsigned long long)option->max);
	else if (option->multiple_of)
		accel_transport_say(error, "%s takes a multiple of %llu from %llu to %llu",
				    option->name, (unsigned long long)option->multiple_of,
				    (unsigned long long)option->min,
				    (unsigned long long)option->max);
	else
		accel_transport_say(error, "%s takes a power of two from %llu to %llu",
				    option->name, (unsigned long long)option->min,
				    (unsigned long long)option->max);
}

static const struct accel_option *option_find(const struct accel_option *options, const char *text,
					      size_t length)
{
	for (; options->name; options++)
		if (strlen(options->name) == length && !memcmp(options->name, text, length))
			return options;
	return NULL;
}

/* One "name=value" of @length bytes; @given has a bit for each option. */
static int option_take(const char *text, size_t length, const struct accel_option *options,
		       unsigned int *given, struct accel_transport_error *error)
{
	const char *equals = memchr(text, '=', length);
	const struct accel_option *option = NULL;
	uint64_t value;

	if (equals)
		option = option_find(options, text, (size_t)(equals - text));
	if (!option) {
		accel_transport_say(error, "no option \"%.*s\"",
				    (int)(length < SHOWN ? length : SHOWN), text);
		return -EINVAL;
	}
	if (*given & 1u << (option - options)) {
		accel_transport_say(error, "%s is given twice", option->name);
		return -EINVAL;
	}
	*given |= 1u << (option - options);
	if (!option_number(equals + 1, (size_t)(text + length - equals - 1), &value) ||
	    !option_allows(option, value)) {
		option_refuse(option, error);
		return -EINVAL;
	}
	*option->value = value;
	return 0;
}

int accel_option_parse(const char *text, const struct accel_option *options,
		       struct accel_transport_error *error)
{
	unsigned int given = 0;
	int err;

	if (!*text)
		return 0;
	for (;;) {
		size_t length = strcspn(text, ",");

		err = option_take(text, length, options, &given, error);
		if (err || !text[length])
			return err;
		text += length + 1;
	}
}
