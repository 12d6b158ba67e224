// SPDX-License-Identifier: MIT
#include "window/settings.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#define BLANKS " \t\r\n"

enum { RANK_NONE, RANK_ALL, RANK_PROGRAM };

static const struct {
	const char *name, *environment;
} settings_names[GLOSS_SETTINGS] = {
	[GLOSS_SETTING_DEVICE] = { "device", "GLOSS_DEVICE" },
	[GLOSS_SETTING_SHADING] = { "shading", "GLOSS_SHADING" },
	[GLOSS_SETTING_GL_VERSION] = { "gl_version", "GLOSS_GL_VERSION" },
};

static char *trimmed(char *text)
{
	size_t length;

	text += strspn(text, BLANKS);
	length = strlen(text);
	while (length && strchr(BLANKS, text[length - 1]))
		length--;
	text[length] = '\0';
	return text;
}

/* A later line of the same section counts, and one for the program before one for all. */
static void settings_set(struct gloss_settings *settings, int setting, const char *text, int rank)
{
	char *value;

	if (rank < settings->rank[setting])
		return;
	value = strdup(text);
	if (!value)
		return;
	free(settings->value[setting]);
	settings->value[setting] = value;
	settings->rank[setting] = rank;
}

/* "name = value", for programs of @rank; returns what is wrong with it, or NULL. */
static const char *settings_line(struct gloss_settings *settings, char *line, int rank)
{
	char *value = strchr(line, '=');
	const char *name;

	if (!value)
		return "this is neither [program] nor name = value";
	*value++ = '\0';
	name = trimmed(line);
	value = trimmed(value);
	if (!*value)
		return "there is no value";
	for (int i = 0; i < GLOSS_SETTINGS; i++) {
		if (strcmp(name, settings_names[i].name) != 0)
			continue;
		settings_set(settings, i, value, rank);
		return NULL;
	}
	return "no such setting; there are device, shading and gl_version";
}

/* "[program]": whether what follows is for @program. */
static const char *settings_section(char *line, const char *program, int *rank)
{
	char *end = strchr(line, ']');

	*rank = RANK_NONE;
	if (!end || end[1])
		return "there is no ] at its end";
	*end = '\0';
	if (!strcmp(trimmed(line + 1), program))
		*rank = RANK_PROGRAM;
	return NULL;
}

void gloss_settings_read(struct gloss_settings *settings, FILE *file, const char *path,
			 const char *program, FILE *errors)
{
	struct gloss_settings others = { 0 }; /* what is for other programs is only looked at */
	int rank = RANK_ALL;
	char *buffer = NULL;
	size_t size = 0;

	for (int number = 1; getline(&buffer, &size, file) >= 0; number++) {
		const char *wrong = NULL;
		char *line;

		buffer[strcspn(buffer, "#")] = '\0';
		line = trimmed(buffer);
		if (*line == '[')
			wrong = settings_section(line, program, &rank);
		else if (*line)
			wrong = settings_line(rank ? settings : &others, line, rank);
		if (wrong && errors)
			fprintf(errors, "gloss: %s:%d: %s\n", path, number, wrong);
	}
	for (int i = 0; i < GLOSS_SETTINGS; i++)
		free(others.value[i]);
	free(buffer);
}

static struct gloss_settings settings_of_file;

/* The file's name, to be freed; NULL: there is none. */
static char *settings_path(void)
{
	const char *config = secure_getenv("GLOSS_CONFIG"), *folder;
	char *path = NULL;

	if (config)
		return strdup(config);
	folder = secure_getenv("XDG_CONFIG_HOME");
	if (folder && *folder)
		return asprintf(&path, "%s/gloss.conf", folder) < 0 ? NULL : path;
	folder = secure_getenv("HOME");
	return folder && asprintf(&path, "%s/.config/gloss.conf", folder) >= 0 ? path : NULL;
}

static void settings_open(void)
{
	FILE *errors = secure_getenv("GLOSS_DEBUG") ? stderr : NULL;
	char *path = settings_path();
	FILE *file = path ? fopen(path, "re") : NULL;

	if (file) {
		gloss_settings_read(&settings_of_file, file, path, program_invocation_short_name,
				    errors);
		fclose(file);
	} else if (errors && secure_getenv("GLOSS_CONFIG")) {
		fprintf(errors, "gloss: %s: %s; see GLOSS_CONFIG\n", path ? path : "",
			strerror(errno));
	}
	free(path);
}

const char *gloss_setting(enum gloss_setting setting)
{
	static pthread_once_t once = PTHREAD_ONCE_INIT;
	const char *value = secure_getenv(settings_names[setting].environment);

	if (value)
		return value;
	pthread_once(&once, settings_open);
	return settings_of_file.value[setting];
}
