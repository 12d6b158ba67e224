// SPDX-License-Identifier: MIT
#include "runner.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *copy(const char *text)
{
	char *copy = strdup(text);

	if (!copy)
		runner_die("no memory");
	return copy;
}

static void read_test(struct plan *plan, const char *value)
{
	struct plan_test *test = &plan->tests[plan->test_count];
	char who[8];
	int name;

	if (plan->test_count == PLAN_TESTS)
		runner_die("more than %d tests", PLAN_TESTS);
	if (sscanf(value, "%7s %d %n", who, &test->seconds, &name) != 2)
		runner_die("bad test in the plan: %s", value);
	test->root = !strcmp(who, "root");
	test->name = copy(value + name);
	plan->test_count++;
}

static void read_line(struct plan *plan, const char *key, const char *value)
{
	const struct {
		const char *key;
		char **value;
	} texts[] = {
		{ "out", &plan->out },         { "source", &plan->source },
		{ "build", &plan->build },     { "driver", &plan->driver },
		{ "modules", &plan->modules }, { "seed", &plan->seed },
		{ "slow", &plan->slow_text },  { "term", &plan->term },
		{ "rows", &plan->rows },       { "columns", &plan->columns },
		{ "points", &plan->points },
	};

	for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
		if (!strcmp(key, texts[i].key))
			*texts[i].value = copy(value);
	if (!strcmp(key, "modprobe") && plan->modprobes < PLAN_MODULES)
		plan->modprobe[plan->modprobes++] = copy(value);
	else if (!strcmp(key, "user"))
		plan->user = (unsigned int)strtoul(value, NULL, 10);
	else if (!strcmp(key, "debug"))
		plan->debug = true;
	else if (!strcmp(key, "interactive"))
		plan->interactive = true;
	else if (!strcmp(key, "test"))
		read_test(plan, value);
}

void plan_read(struct plan *plan, const char *path)
{
	FILE *file = fopen(path, "r");
	char line[4096];

	if (!file)
		runner_die("%s: %s", path, strerror(errno));
	*plan = (struct plan){ .user = 1000 };
	while (fgets(line, sizeof(line), file)) {
		char *value;

		line[strcspn(line, "\n")] = '\0';
		value = strchr(line, ' ');
		if (value)
			*value++ = '\0';
		read_line(plan, line, value ? value : "");
	}
	fclose(file);
	if (!plan->out || !plan->source || !plan->build || !plan->driver || !plan->slow_text)
		runner_die("%s: something is missing", path);
	plan->slow = atoi(plan->slow_text);
}
