// SPDX-License-Identifier: MIT
/* Triangles that are not split any more: their surfaces, found together, and into the bin in order. */
#include "draw/bin.h"
#include "draw/group.h"

static void leaf_count(struct accel_draw_stats *stats, enum gloss_shading shading)
{
	switch (shading) {
	case GLOSS_SHADING_FLAT:
		stats->flat++;
		break;
	case GLOSS_SHADING_LINEAR:
		stats->linear++;
		break;
	default:
		stats->second_order++;
	}
}

static void leaf_gather(struct accel_fit_batch *batch, int i, const struct accel_leaf *leaf)
{
	const struct accel_patch *patch = &leaf->patch;

	for (int j = 0; j < 3; j++) {
		batch->x[j][i] = patch->vertex[j]->x;
		batch->y[j][i] = patch->vertex[j]->y;
		for (int k = 0; k < 3; k++) {
			batch->colour[j][k][i] = patch->vertex[j]->sample.colour[k];
			batch->colour[3 + j][k][i] = leaf->edged ? patch->edge[j]->colour[k] : 0;
		}
	}
	batch->curved[i] = leaf->edged && accel_patch_curved(patch);
}

static void leaf_surface(const struct accel_pass *pass, const struct accel_leaf *leaf,
			 const struct accel_fit_batch *batch, int i,
			 struct accel_triangle *triangle)
{
	const enum accel_shading shading = pass->state->shading;
	struct accel_basis basis;

	if (shading == ACCEL_SHADING_FLAT) {
		accel_surface_flat(triangle, leaf->flat->sample.colour);
	} else if (!leaf->edged || (shading == ACCEL_SHADING_GOURAUD && !batch->curved[i])) {
		accel_surface_basis_of(batch, i, &basis);
		accel_surface_gouraud(triangle, &basis, leaf->patch.vertex);
	} else {
		accel_surface_fitted(triangle, batch, i, &leaf->patch);
	}
}

static int leaf_bin(struct accel_pass *pass, const struct accel_leaf *leaf,
		    const struct accel_fit_batch *batch, int i)
{
	struct accel_triangle triangle;

	triangle.setup = *leaf->setup;
	triangle.plane = leaf->plane;
	triangle.x = triangle.y = 0;
	if (leaf->small)
		triangle.small = *leaf->small;
	else
		accel_small_init(&triangle.small, leaf->setup);
	if (leaf->few->count)
		accel_few_surface(&triangle, leaf->few);
	else
		leaf_surface(pass, leaf, batch, i, &triangle);
	accel_small_round(&triangle);
	leaf_count(pass->stats, triangle.shading);
	return accel_bin_triangle(pass->bin, &triangle);
}

int accel_leaf_flush(struct accel_pass *pass, struct accel_leaves *leaves)
{
	struct accel_fit_batch batch;
	int fit[ACCEL_BATCH] = { 0 }, count = 0, err = 0;

	for (int i = 0; i < leaves->count; i++) {
		fit[i] = count;
		if (!leaves->leaf[i].few->count)
			leaf_gather(&batch, count++, &leaves->leaf[i]);
	}
	accel_kernel()->fit(&batch, count);
	for (int i = 0; i < leaves->count && !err; i++)
		err = leaf_bin(pass, &leaves->leaf[i], &batch, fit[i]);
	leaves->count = 0;
	return err;
}
