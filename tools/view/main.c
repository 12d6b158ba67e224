// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "view/view.h"
#include "scene/output.h"

/* Draws one picture, and writes it if it is wanted. */
static int draw_one(struct view *view)
{
	struct picture picture;
	int ret;

	if (picture_new(view->scene.width, view->scene.height, &picture)) {
		view_error("out of memory", "picture", "give a smaller --size");
		return VIEW_FAILED;
	}
	ret = view_draw(view, view->options->shading, &picture);
	if (ret == VIEW_OK && !view->visible)
		view_error("nothing of the mesh is visible", view->options->mesh,
			   "try --two-sided, --zoom 1, or another --camera RIGHT,UP");
	if (ret == VIEW_OK && view->options->out)
		ret = view_write(&picture, view->options->out);
	picture_free(&picture);
	return ret;
}

static int run(struct view *view)
{
	const struct view_options *options = view->options;
	int ret = VIEW_OK;

	if (options->turntable)
		ret = view_turntable(view);
	else if (options->out || options->stats)
		ret = draw_one(view);
	if (ret == VIEW_OK && options->stats)
		view_stats_print(view);
	if (ret == VIEW_OK && options->compare)
		ret = view_compare(view, options->compare);
	if (ret == VIEW_OK && options->window)
		ret = view_window(view);
	return ret;
}

int main(int argc, char **argv)
{
	struct view_options options;
	struct view view;
	int ret;

	ret = view_options_parse(&options, argc, argv);
	if (ret != VIEW_OK || options.done)
		return ret;
	output_catch_signals();
	ret = view_open(&view, &options);
	if (ret == VIEW_OK)
		ret = run(&view);
	view_close(&view);
	/* What was printed may not have arrived either. */
	if (fflush(stdout) && ret == VIEW_OK) {
		view_error("can not write", "standard output", "is its disk full?");
		ret = VIEW_FAILED;
	}
	return ret;
}
