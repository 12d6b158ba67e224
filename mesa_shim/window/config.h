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

/*
 * Puts @configs into the order in which both GLX and EGL want those found: conformant ones first, then
 * those with alpha if @alpha was asked for and without if not, then single buffers, then the least
 * stencil.
 */
void gloss_config_sort(const struct gloss_config **configs, int count, bool alpha);

#endif
