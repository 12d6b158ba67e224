// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <string.h>

#include "view/view.h"
#include "scene/quality.h"

#define WHITE 0xffffffffu

struct sheet {
	struct picture picture; /* all panels, side by side */
	struct phong_frame reference;
};

static int out_of_memory(void)
{
	view_error("out of memory", "--compare", "give a smaller --size");
	return VIEW_FAILED;
}

/* Puts a picture in its place on the sheet, with its name. */
static void place(struct sheet *sheet, int number, const struct picture *panel, const char *label)
{
	int scale = panel->width >= 320 ? 2 : 1;
	int x = number * panel->width;

	picture_copy(&sheet->picture, x, 0, panel);
	picture_text(&sheet->picture, x + 4 * scale, 4 * scale, label, scale, WHITE);
}

static int add_drawn(struct view *view, struct sheet *sheet, int number, enum accel_shading shading,
		     struct picture *panel)
{
	const char *name = view_shading_name(shading);
	struct quality quality = { 0 };
	int ret;

	ret = view_draw(view, shading, panel);
	if (ret != VIEW_OK)
		return ret;
	quality_add(&quality, &sheet->reference, panel->pixel, view->depth);
	printf("%-10s NMSE %.2e, worst pixel off by %.0f of 255 at %d,%d\n", name,
	       quality_nmse(&quality), quality.worst, quality.worst_x, quality.worst_y);
	place(sheet, number, panel, name);
	return VIEW_OK;
}

static int fill(struct view *view, struct sheet *sheet, struct picture *panel)
{
	int ret;

	if (phong_draw(&view->scene, &sheet->reference))
		return out_of_memory();
	ret = add_drawn(view, sheet, 0, ACCEL_SHADING_GOURAUD, panel);
	if (ret == VIEW_OK)
		ret = add_drawn(view, sheet, 1, view->options->shading, panel);
	if (ret != VIEW_OK)
		return ret;
	memcpy(panel->pixel, sheet->reference.pixel,
	       (size_t)panel->width * panel->height * sizeof(*panel->pixel));
	place(sheet, 2, panel, "Phong per pixel");
	return VIEW_OK;
}

int view_compare(struct view *view, const char *path)
{
	int width = view->scene.width, height = view->scene.height;
	struct sheet sheet = { 0 };
	struct picture panel = { 0 };
	int ret;

	if (picture_new(width, height, &panel) || picture_new(width * 3, height, &sheet.picture) ||
	    phong_frame_new(&view->scene, true, &sheet.reference))
		ret = out_of_memory();
	else
		ret = fill(view, &sheet, &panel);
	if (ret == VIEW_OK)
		ret = view_write(&sheet.picture, path);
	phong_frame_free(&sheet.reference);
	picture_free(&sheet.picture);
	picture_free(&panel);
	return ret;
}
