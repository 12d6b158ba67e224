// SPDX-License-Identifier: MIT
/*
 * What points and lines have in common: they are lit at their vertices, as front sides, and become
 * triangles on the screen.
 */
#include <string.h>

#include "draw/group.h"

void accel_strokes_light(const struct accel_pass *pass, struct accel_strokes *strokes)
{
	struct accel_vertex *vertex[ACCEL_BATCH] = { NULL };
	struct accel_vertex_batch batch;

	accel_mesh_fetch(pass, strokes->index, strokes->count, &batch);
	for (int i = 0; i < strokes->count; i++) {
		vertex[i] = &strokes->vertex[i];
		accel_geometry_vertex_of(&batch, i, vertex[i]);
		/* Light needs a normal; what has no area has none of its own. */
		if (pass->lit && !pass->normal.data)
			memcpy(vertex[i]->normal, (const float[3]){ 0, 0, 1 },
			       sizeof(vertex[i]->normal));
	}
	accel_shading_vertices(pass, vertex, strokes->count, 0);
}

static uint32_t strokes_vertex(const struct accel_pass *pass, const struct accel_vertex *vertex)
{
	uint32_t number = accel_group_vertex(pass->group, 0);

	pass->group->vertex[number] = *vertex;
	pass->group->vertex[number].sampled = 1;
	return number;
}

static void strokes_see(struct accel_strokes *strokes, const struct accel_vertex *const corner[3],
			const uint32_t vertex[3], uint32_t flat)
{
	struct accel_point point[3];

	for (int i = 0; i < 3; i++)
		point[i] = (struct accel_point){ corner[i]->x, corner[i]->y };
	if (accel_setup_area(&point[0], &point[1], &point[2]))
		accel_mesh_see(&strokes->seen,
			       (const struct accel_point *[3]){ &point[0], &point[1], &point[2] },
			       vertex, flat, 0);
}

int accel_strokes_flush(struct accel_pass *pass, struct accel_strokes *strokes)
{
	const int count = strokes->seen.count;

	pass->stats->culled += (uint64_t)(count - accel_mesh_put(pass, &strokes->seen, true));
	return accel_group_full(pass->group) ? accel_face_draw_all(pass) : 0;
}

int accel_strokes_fill(struct accel_pass *pass, struct accel_strokes *strokes,
		       const struct accel_vertex *corner, int corners,
		       const struct accel_vertex *flat)
{
	/* As many as a batch of the group has vertices for. */
	const int most = ACCEL_BATCH / 8;
	uint32_t number[4] = { 0 }, of_flat = strokes_vertex(pass, flat);

	for (int i = 0; i < corners; i++)
		number[i] = strokes_vertex(pass, &corner[i]);
	for (int i = 1; i + 1 < corners; i++) {
		const uint32_t vertex[3] = { number[0], number[i], number[i + 1] };

		pass->stats->triangles_in++;
		strokes_see(strokes,
			    (const struct accel_vertex *[3]){ &corner[0], &corner[i],
							      &corner[i + 1] },
			    vertex, of_flat);
	}
	/* What has no area leaves vertices behind all the same. */
	if (strokes->seen.count < most && !accel_group_full(pass->group))
		return 0;
	return accel_strokes_flush(pass, strokes);
}
