// SPDX-License-Identifier: MIT
#include "window/config.h"

#include <stddef.h>

#define CONFIG(n, a, s, twice)                                                           \
	.id = n, .red = 8, .green = 8, .blue = 8, .alpha = a, .depth = 24, .stencil = s, \
	.double_buffered = twice

/* The most wanted first: a screen with few visuals has them for the first of these. */
const struct gloss_config gloss_configs[GLOSS_CONFIGS] = {
	{ CONFIG(1, 8, 0, true) },  { CONFIG(2, 8, 0, false) }, { CONFIG(3, 8, 8, true) },
	{ CONFIG(4, 0, 0, true) },  { CONFIG(5, 8, 8, false) }, { CONFIG(6, 0, 8, true) },
	{ CONFIG(7, 0, 0, false) }, { CONFIG(8, 0, 8, false) },
};

static int config_rank(const struct gloss_config *config, bool alpha)
{
	return (gloss_config_conformant(config) ? 0 : 8) + ((config->alpha != 0) == alpha ? 0 : 4) +
	       (config->double_buffered ? 2 : 0) + (config->stencil ? 1 : 0);
}

void gloss_config_sort(const struct gloss_config **configs, int count, bool alpha)
{
	for (int done = 1; done < count; done++) {
		const struct gloss_config *next = configs[done];
		int place = done;

		for (; place && config_rank(configs[place - 1], alpha) > config_rank(next, alpha);
		     place--)
			configs[place] = configs[place - 1];
		configs[place] = next;
	}
}

const struct gloss_criterion *gloss_criterion_find(const struct gloss_criterion *criteria,
						   int count, int name)
{
	for (int i = 0; i < count; i++) {
		if (criteria[i].name == name)
			return &criteria[i];
	}
	return NULL;
}

int gloss_criterion_wanted(const struct gloss_criterion *criterion, const int *pairs, int end)
{
	int wanted = criterion->normal;

	for (; pairs && pairs[0] != end; pairs += 2) {
		if (pairs[0] == criterion->name)
			wanted = pairs[1];
	}
	return wanted;
}

bool gloss_criterion_met(const struct gloss_criterion *criterion, int value, int wanted)
{
	switch (criterion->match) {
	case GLOSS_MATCH_AT_LEAST:
		return value >= wanted;
	case GLOSS_MATCH_EXACT:
		return value == wanted;
	case GLOSS_MATCH_MASK:
		return (value & wanted) == wanted;
	case GLOSS_MATCH_IGNORED:
		break;
	}
	return true;
}
