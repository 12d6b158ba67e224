// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "subject.h"

#define TURN 8 /* steps of a turn, in all of which the mesh fits the picture */

const struct subject subject_bunny = { "bunny", "bunny.obj", true, { 0, 0 } };
const struct subject subject_horse = { "horse", "horse.3ds", true, { 90, 0 } };
const struct subject subject_sphere3 = { "sphere3", "sphere:3", false, { 0, 0 } };
const struct subject subject_sphere5 = { "sphere5", "sphere:5", false, { 0, 0 } };

int subject_load(const struct subject *subject, const char *models, int width, int height,
		 struct view_options *options, struct view *view)
{
	char path[4096], *words[] = { "bench", "--stats", path };
	int ret;

	snprintf(path, sizeof(path), "%s%s%s", subject->file ? models : "",
		 subject->file ? "/" : "", subject->mesh);
	optind = 1; /* from the beginning, each time */
	ret = view_options_parse(options, 3, words);
	if (ret != VIEW_OK)
		return ret;
	options->width = width;
	options->height = height;
	options->turntable = TURN;
	options->recoloured = true; /* the horse has colours of its own */
	memcpy(options->upright, subject->upright, sizeof(options->upright));
	ret = view_load(view, options);
	options->mesh = subject->name; /* path ends here */
	return ret;
}

void subject_scenes(struct view *view, struct scene *scenes, int count)
{
	for (int i = 0; i < count; i++) {
		view_camera_set(view, 360.0f * (float)i / (float)count);
		scenes[i] = view->scene;
	}
}
