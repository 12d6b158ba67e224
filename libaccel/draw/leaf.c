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
		batch->alpha[j][i] = patch->vertex[j]->sample.colour[3];
	}
	batch->curved[i] = leaf->edged && accel_patch_curved(patch);
}

/* Are the surfaces of a leaf those that the batch has? */
static bool leaf_is_fitted(const struct accel_pass *pass, const struct accel_leaf *leaf,
			   const struct accel_fit_batch *batch, int i)
{
	if (leaf->few->count || !batch->even[i])
		return batch->even[i];
	return leaf->edged && (batch->flat[i] || batch->fits[i]) &&
	       pass->state->shading != ACCEL_SHADING_GOURAUD;
}

/* The surfaces of any leaf. */
static void leaf_surface(const struct accel_pass *pass, const struct accel_leaf *leaf,
			 const struct accel_fit_batch *batch, int i,
			 struct accel_triangle *triangle)
{
	const enum accel_shading shading = pass->state->shading;
	struct accel_basis basis;

	triangle->x = triangle->y = 0;
	if (leaf->few->count) {
		accel_surface_few(triangle, batch, i);
	} else if (shading == ACCEL_SHADING_FLAT) {
		accel_surface_flat(triangle, leaf->flat->sample.colour);
	} else if (!leaf->edged || (shading == ACCEL_SHADING_GOURAUD && !batch->curved[i])) {
		accel_surface_basis_of(batch, i, &basis);
		accel_surface_gouraud(triangle, &basis, leaf->patch.vertex);
	} else {
		accel_surface_fitted(triangle, batch, i, &leaf->patch);
	}
}

/* What the batch has not yet of a leaf. */
static void leaf_complete(const struct accel_pass *pass, const struct accel_leaf *leaf,
			  struct accel_leaf_batch *batch, int i)
{
	struct accel_triangle triangle;
	struct accel_small found;

	if (!leaf->small)
		accel_small_init(&found, leaf->setup);
	accel_small_put(batch, i, leaf->small ? leaf->small : &found, leaf->setup, leaf->plane);
	if (leaf_is_fitted(pass, leaf, &batch->fit, i))
		return;
	leaf_surface(pass, leaf, &batch->fit, i, &triangle);
	accel_small_surface(batch, i, &triangle);
}

/* A leaf whose record is not known: its tile cuts it, or it is not small. */
static int leaf_bin_any(struct accel_pass *pass, const struct accel_leaf *leaf,
			const struct accel_leaf_batch *batch, int i)
{
	struct accel_triangle triangle;

	triangle.setup = *leaf->setup;
	triangle.plane = leaf->plane;
	leaf_surface(pass, leaf, &batch->fit, i, &triangle);
	accel_small_take(batch, i, &triangle);
	return accel_bin_triangle(pass->bin, &triangle);
}

static int leaf_bin(struct accel_pass *pass, const struct accel_leaf *leaf,
		    const struct accel_leaf_batch *batch, int i)
{
	const struct accel_bounds box = { batch->x0[i], batch->y0[i], batch->x1[i], batch->y1[i] };
	struct accel_bin_room room;
	int err;

	leaf_count(pass->stats, (enum gloss_shading)batch->fit.form[i]);
	if (!batch->fits[i] || !accel_bin_is_whole(pass->bin, &box))
		return leaf_bin_any(pass, leaf, batch, i);
	err = accel_bin_begin_whole(pass->bin, &box, &room);
	if (!err)
		accel_bin_end_record(&room, accel_small_words(batch, i, leaf->setup, room.words));
	return err;
}

/* Those that are fitted come first in the batch, those of few pixels from its end on. */
int accel_leaf_flush(struct accel_pass *pass, struct accel_leaves *leaves)
{
	const int count = leaves->count;
	int place[ACCEL_BATCH], fitted = 0, others = count, err = 0;
	struct accel_leaf_batch batch;
	struct accel_few_batch few;

	for (int i = 0; i < count; i++) {
		const struct accel_leaf *leaf = &leaves->leaf[i];

		place[i] = leaf->few->count ? --others : fitted++;
		if (leaf->few->count)
			accel_few_put(leaf->few, place[i], &few, &batch.fit);
		else
			leaf_gather(&batch.fit, place[i], leaf);
	}
	accel_kernel()->fit(&batch.fit, fitted);
	accel_kernel()->few(&few, &batch.fit, others, count);
	for (int i = 0; i < count; i++)
		leaf_complete(pass, &leaves->leaf[i], &batch, place[i]);
	accel_kernel()->small(&batch, count, pass->bin->tile_size);
	for (int i = 0; i < count && !err; i++)
		err = leaf_bin(pass, &leaves->leaf[i], &batch, place[i]);
	leaves->count = 0;
	return err;
}
