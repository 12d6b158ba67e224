/* SPDX-License-Identifier: MIT */
/* Pictures of a few triangles. */
#include "usb_trial_priv.h"

#define SIDE_MAX 160 /* pixels */
#define TRIANGLES 5

static int picture_mesh(const struct item *item, struct accel_draw *draw,
			struct accel_target *target, struct accel_state *state)
{
	static const struct accel_clear black = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR |
								    ACCEL_CLEAR_DEPTH,
							    .depth = 1);
	float position[3 * TRIANGLES][3], colour[3 * TRIANGLES][4];
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3 * TRIANGLES,
						  .position = { .data = position },
						  .colour = { .data = colour });
	uint64_t seed = item->seed;
	int err;

	for (int n = 0; n < 3 * TRIANGLES; n++) {
		for (int i = 0; i < 3; i++)
			position[n][i] = (float)test_below(&seed, 2001) / 1000 - 1;
		for (int i = 0; i < 4; i++)
			colour[n][i] = (float)test_below(&seed, 256) / 255;
	}
	err = accel_draw_begin(draw, target, &black);
	return err ? err : accel_draw_mesh(draw, state, &mesh);
}

int trial_picture_submit(const struct item *item, struct picture_side *side,
			 struct accel_device *device)
{
	struct accel_state *state;
	struct accel_draw *draw = NULL;
	int err = accel_state_new(&state);

	if (err)
		return err;
	err = accel_target_new(device, item->width, item->height, &side->target);
	if (!err)
		err = accel_draw_new(device, &draw);
	if (!err)
		err = picture_mesh(item, draw, side->target, state);
	if (!err)
		err = accel_draw_submit(draw, &side->fence);
	accel_draw_free(draw);
	accel_state_free(state);
	return err;
}

int trial_picture_finish(const struct item *item, struct picture_side *side)
{
	bool submitted = side->fence;

	side->result = -ENODEV;
	if (submitted) {
		side->result = accel_fence_wait(side->fence, -1, NULL, 0);
		if (!side->result)
			side->result = accel_target_read(side->target, ACCEL_PLANE_COLOUR, NULL,
							 side->pixel, (size_t)item->width * 4);
		accel_fence_free(side->fence);
	}
	accel_target_free(side->target);
	return submitted ? side->result : 0;
}

void trial_picture_prepare(struct item *item)
{
	uint64_t seed = item->seed;

	item->width = 1 + (int)test_below(&seed, SIDE_MAX);
	item->height = 1 + (int)test_below(&seed, SIDE_MAX);
	for (int n = 0; n < 2; n++)
		item->drawn[n].pixel = trial_memory((size_t)item->width * (size_t)item->height, 4);
}

void trial_picture_compare(const struct item *item)
{
	if (!item->drawn[0].result)
		trial_compare_words(item, "a picture", item->drawn[0].pixel, item->drawn[1].pixel,
				    (size_t)item->width * (size_t)item->height);
}
