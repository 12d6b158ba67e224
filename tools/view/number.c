// SPDX-License-Identifier: MIT
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "view/view.h"

/* Reads a number; returns what follows it, NULL if there is none or it is out of range. */
static const char *number(const char *text, float low, float high, float *value)
{
	char *end;

	*value = strtof(text, &end);
	if (end == text || !isfinite(*value) || *value < low || *value > high)
		return NULL;
	return end;
}

bool view_numbers(const char *text, int count, float low, float high, float *value)
{
	for (int i = 0; i < count; i++) {
		text = number(text, low, high, &value[i]);
		if (!text || *text != (i + 1 < count ? ',' : '\0'))
			return false;
		text++;
	}
	return true;
}

bool view_number(const char *text, float low, float high, float *value)
{
	return view_numbers(text, 1, low, high, value);
}

static bool hex_colour(const char *text, float rgba[4])
{
	unsigned long word;
	char *end;

	if (strspn(text, "0123456789abcdefABCDEF") != 6 || text[6])
		return false;
	word = strtoul(text, &end, 16);
	for (int i = 0; i < 3; i++)
		rgba[i] = (float)(word >> (16 - 8 * i) & 0xff) / 255;
	return true;
}

bool view_colour(const char *text, float rgba[4])
{
	rgba[3] = 1;
	if (*text == '#')
		return hex_colour(text + 1, rgba);
	if (view_number(text, 0, 1, rgba)) {
		rgba[1] = rgba[2] = rgba[0];
		return true;
	}
	return view_numbers(text, 3, 0, 1, rgba);
}
