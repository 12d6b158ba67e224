// SPDX-License-Identifier: MIT
/* The configuration file: what counts for which program, and what is said of its faults. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "window/settings.h"

/* Reads @text for a program gears; what is said of it is returned, to be freed. */
static char *read_text(struct gloss_settings *settings, const char *text)
{
	FILE *file = fmemopen((void *)(uintptr_t)text, strlen(text), "r");
	char *said = NULL;
	size_t size;
	FILE *errors = open_memstream(&said, &size);

	assert_non_null(file);
	assert_non_null(errors);
	memset(settings, 0, sizeof(*settings));
	gloss_settings_read(settings, file, "gloss.conf", "gears", errors);
	fclose(file);
	fclose(errors);
	return said;
}

static void settings_are(const char *text, const char *device, const char *shading)
{
	struct gloss_settings settings;
	char *said = read_text(&settings, text);
	const char *const wanted[] = { device, shading };

	assert_string_equal(said, "");
	for (int i = 0; i < 2; i++) {
		if (wanted[i])
			assert_string_equal(settings.value[i], wanted[i]);
		else
			assert_null(settings.value[i]);
	}
	for (int i = 0; i < GLOSS_SETTINGS; i++)
		free(settings.value[i]);
	free(said);
}

static void nothing_is_set_by_an_empty_file(void **state)
{
	(void)state;
	settings_are("\n# shading = gouraud\n \t\n", NULL, NULL);
}

static void values_are_for_all_programs_or_for_one(void **state)
{
	(void)state;
	settings_are("device=usb:", "usb:", NULL);
	settings_are(" device = model:threads=1  # here\r\n[other]\nshading = gouraud\n",
		     "model:threads=1", NULL);
	settings_are("[ gears ]\nshading = gouraud\n[other]\ndevice = drm:\n", NULL, "gouraud");
}

static void the_program_s_section_counts_more_and_the_later_line(void **state)
{
	(void)state;
	settings_are("shading = quadratic\n[gears]\nshading = gouraud\n", NULL, "gouraud");
	settings_are("[gears]\nshading = gouraud\n[gears]\nshading = adaptive\n[other]\n"
		     "shading = quadratic\n",
		     NULL, "adaptive");
}

static void faults_are_told_by_line_and_left_out(void **state)
{
	struct gloss_settings settings;
	char *said = read_text(&settings, "shadin = gouraud\n[gears\nshading = gouraud\n[other]\n"
					  "nothing\n[gears]\ndevice =\nshading = adaptive");

	(void)state;
	assert_string_equal(said,
			    "gloss: gloss.conf:1: no such setting; there are device, shading "
			    "and gl_version\n"
			    "gloss: gloss.conf:2: there is no ] at its end\n"
			    "gloss: gloss.conf:5: this is neither [program] nor name = value\n"
			    "gloss: gloss.conf:7: there is no value\n");
	assert_null(settings.value[GLOSS_SETTING_DEVICE]);
	assert_string_equal(settings.value[GLOSS_SETTING_SHADING], "adaptive");
	free(settings.value[GLOSS_SETTING_SHADING]);
	free(said);
}

/* A value of the environment is taken without a file, and before one. */
static void the_environment_counts_most(void **state)
{
	(void)state;
	setenv("GLOSS_CONFIG", "/nonexistent/gloss.conf", 1);
	setenv("GLOSS_SHADING", "gouraud", 1);
	unsetenv("GLOSS_GL_VERSION");
	assert_string_equal(gloss_setting(GLOSS_SETTING_SHADING), "gouraud");
	assert_null(gloss_setting(GLOSS_SETTING_GL_VERSION));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nothing_is_set_by_an_empty_file),
		cmocka_unit_test(values_are_for_all_programs_or_for_one),
		cmocka_unit_test(the_program_s_section_counts_more_and_the_later_line),
		cmocka_unit_test(faults_are_told_by_line_and_left_out),
		cmocka_unit_test(the_environment_counts_most),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
