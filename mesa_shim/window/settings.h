/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_SETTINGS_H
#define GLOSS_SETTINGS_H

#include <stdio.h>

enum gloss_setting {
	GLOSS_SETTING_DEVICE,
	GLOSS_SETTING_SHADING,
	GLOSS_SETTING_GL_VERSION,
	GLOSS_SETTINGS,
};

/*
 * What the environment says, GLOSS_DEVICE and so on, or else the configuration file, for this
 * program or for all; NULL: neither. The file is $GLOSS_CONFIG, or gloss.conf in $XDG_CONFIG_HOME
 * or ~/.config; it is read once. What is wrong in it is printed if $GLOSS_DEBUG is set. Programs
 * that run with another's rights take neither. Any thread may call this; the string stays.
 */
const char *gloss_setting(enum gloss_setting setting);

struct gloss_settings {
	char *value[GLOSS_SETTINGS]; /* NULL: not set */
	int rank[GLOSS_SETTINGS];    /* by which section it was set: none, all programs, this one */
};

/*
 * Reads a configuration file: lines "name = value", for the programs whose name "[name]" stands
 * above, before the first for all; # begins a comment. What is wrong is told to @errors, which may
 * be NULL, with @path and its line, and left out.
 */
void gloss_settings_read(struct gloss_settings *settings, FILE *file, const char *path,
			 const char *program, FILE *errors);

#endif
