/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_LIGHT_H
#define GLOSS_LIGHT_H

struct gloss_context;

/*
 * While GL_COLOR_MATERIAL is on, glColor sets the material too. It is brought up to date when
 * somebody looks: before a material is read, saved, or no longer follows the colour.
 */
void gloss_light_track(struct gloss_context *context);

#endif
