// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "view/view.h"

/* "dir/name.png" and 7 to "dir/name-0007.png". */
static char *numbered(const char *path, int number)
{
	const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
	size_t stem = dot && (!slash || dot > slash + 1) ? (size_t)(dot - path) : strlen(path);
	char *name;

	if (asprintf(&name, "%.*s-%04d%s", (int)stem, path, number, path + stem) < 0)
		return NULL;
	return name;
}

static int write_frame(struct view *view, struct picture *picture, int number)
{
	char *name;
	int ret;

	view_camera_set(view, 360.0f * (float)number / (float)view->options->turntable);
	ret = view_draw(view, view->options->shading, picture);
	if (ret != VIEW_OK)
		return ret;
	name = numbered(view->options->out, number);
	if (!name)
		return VIEW_FAILED;
	ret = view_write(picture, name);
	free(name);
	return ret;
}

int view_turntable(struct view *view)
{
	int frames = view->options->turntable;
	struct progress progress;
	struct picture picture;
	int ret = VIEW_OK;

	if (picture_new(view->scene.width, view->scene.height, &picture)) {
		view_error("out of memory", "--turntable", "give a smaller --size");
		return VIEW_FAILED;
	}
	progress_begin(&progress, frames);
	for (int i = 0; i < frames && ret == VIEW_OK; i++) {
		ret = write_frame(view, &picture, i);
		progress_show(&progress, i + 1);
	}
	progress_end(&progress);
	picture_free(&picture);
	return ret;
}
