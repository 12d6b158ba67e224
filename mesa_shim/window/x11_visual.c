// SPDX-License-Identifier: MIT
#include "window/x11_visual.h"

#include <stdlib.h>

#include "window/format.h"

/* The visual of a window. 0: a pixmap has none. */
static xcb_visualid_t visual_of(xcb_connection_t *connection, xcb_window_t window)
{
	xcb_generic_error_t *error = NULL;
	xcb_get_window_attributes_reply_t *reply = xcb_get_window_attributes_reply(
		connection, xcb_get_window_attributes(connection, window), &error);
	xcb_visualid_t visual = reply ? reply->visual : 0;

	free(reply);
	free(error);
	return visual;
}

static bool visual_coloured(const xcb_visualtype_t *visual)
{
	return visual->_class == XCB_VISUAL_CLASS_TRUE_COLOR ||
	       visual->_class == XCB_VISUAL_CLASS_DIRECT_COLOR;
}

/* The visual @id of that depth, on any screen; or the first with colours, if @id is 0. */
static const xcb_visualtype_t *visual_find(const xcb_setup_t *setup, uint8_t depth,
					   xcb_visualid_t id)
{
	xcb_screen_iterator_t screen = xcb_setup_roots_iterator(setup);

	for (; screen.rem; xcb_screen_next(&screen)) {
		xcb_depth_iterator_t depths = xcb_screen_allowed_depths_iterator(screen.data);

		for (; depths.rem; xcb_depth_next(&depths)) {
			xcb_visualtype_iterator_t visual = xcb_depth_visuals_iterator(depths.data);

			for (; depths.data->depth == depth && visual.rem;
			     xcb_visualtype_next(&visual)) {
				if (visual_coloured(visual.data) &&
				    (!id || visual.data->visual_id == id))
					return visual.data;
			}
		}
	}
	return NULL;
}

/* How images of that depth lie in memory. */
static bool visual_image(const xcb_setup_t *setup, uint8_t depth, struct gloss_format *format,
			 unsigned int *pad)
{
	xcb_format_iterator_t image = xcb_setup_pixmap_formats_iterator(setup);

	while (image.rem && image.data->depth != depth)
		xcb_format_next(&image);
	if (!image.rem || image.data->bits_per_pixel % 8 || image.data->scanline_pad % 8)
		return false;
	format->bytes = image.data->bits_per_pixel / 8u;
	format->big_endian = setup->image_byte_order == XCB_IMAGE_ORDER_MSB_FIRST;
	*pad = image.data->scanline_pad / 8u;
	return *pad;
}

bool gloss_x11_visual_format(xcb_connection_t *connection, xcb_drawable_t drawable, uint8_t depth,
			     xcb_visualid_t visual, struct gloss_format *format, unsigned int *pad)
{
	const xcb_setup_t *setup = xcb_get_setup(connection);
	const xcb_visualtype_t *found;

	if (!visual)
		visual = visual_of(connection, drawable);
	found = visual_find(setup, depth, visual);
	if (!found || !visual_image(setup, depth, format, pad))
		return false;
	format->red = found->red_mask;
	format->green = found->green_mask;
	format->blue = found->blue_mask;
	format->alpha = (depth >= 32 ? 0xffffffffu : (1u << depth) - 1) &
			~(format->red | format->green | format->blue);
	return gloss_format_valid(format);
}
