/* SPDX-License-Identifier: MIT */
/*
 * The pixel formats there are. Colour is always eight bits a channel and depth 24. Formats with
 * stencil are for programs that insist on one: the core does not test it yet, so they are marked as
 * not conformant.
 */
#ifndef GLOSS_CONFIG_H
#define GLOSS_CONFIG_H

#include "window/surface.h"

#define GLOSS_CONFIGS 8

extern const struct gloss_config gloss_configs[GLOSS_CONFIGS];

static inline bool gloss_config_conformant(const struct gloss_config *config)
{
	return !config->stencil;
}

/* How a format's value of an attribute has to compare with what a program wants. */
enum gloss_match { GLOSS_MATCH_IGNORED, GLOSS_MATCH_AT_LEAST, GLOSS_MATCH_EXACT, GLOSS_MATCH_MASK };

struct gloss_criterion {
	int name; /* GLX's or EGL's */
	enum gloss_match match;
	int normal; /* what a program wants that does not name it */
};

/* NULL: the name is none of @criteria. */
const struct gloss_criterion *gloss_criterion_find(const struct gloss_criterion *criteria,
						   int count, int name);
/* What of @pairs of name and value, up to the name @end, the last says of it. @pairs may be NULL. */
int gloss_criterion_wanted(const struct gloss_criterion *criterion, const int *pairs, int end);
bool gloss_criterion_met(const struct gloss_criterion *criterion, int value, int wanted);

/*
 * Puts @configs into the order in which both GLX and EGL want those found: conformant ones first, then
 * those with alpha if @alpha was asked for and without if not, then single buffers, then the least
 * stencil.
 */
void gloss_config_sort(const struct gloss_config **configs, int count, bool alpha);

#endif
