// SPDX-License-Identifier: MIT
#include <inttypes.h>
#include <stdio.h>

#include "view/view.h"

void view_stats_print(const struct view *view)
{
	const struct accel_draw_stats *stats = &view->stats;
	struct accel_device_info info;

	accel_device_info(view->device, &info, sizeof(info));
	printf("device     %s\n", info.name);
	printf("picture    %dx%d, %" PRIu64 " pixels of the mesh, %s shading\n", view->scene.width,
	       view->scene.height, view->visible, view_shading_name(view->options->shading));
	printf("triangles  %" PRIu64 ": %" PRIu64 " culled, %" PRIu64 " clipped, ",
	       stats->triangles_in, stats->culled, stats->clipped);
	printf("%" PRIu64 " split\n", stats->split);
	printf("drawn      %" PRIu64 " flat, %" PRIu64 " linear, %" PRIu64 " second order\n",
	       stats->flat, stats->linear, stats->second_order);
	printf("stream     %" PRIu64 " bytes, %" PRIu64 " triangle records in %" PRIu64 " tiles\n",
	       stats->stream_words * 4, stats->records, stats->tiles);
	if (view->clocks)
		printf("clocks     %" PRIu64 ", %.3f pixels of the mesh a clock\n", view->clocks,
		       (double)view->visible / (double)view->clocks);
}
