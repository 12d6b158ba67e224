/* SPDX-License-Identifier: MIT */
#include "draw_square.h"

#include "accel_priv.h"
#include "decode/decode.h"

uint32_t pixels[SIDE * SIDE], others[SIDE * SIDE];

const float black[4] = { 0, 0, 0, 0 };
const float square[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };

static const uint32_t square_index[6] = { 0, 1, 2, 0, 2, 3 };

int __real_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);
int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);

int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence)
{
	uint32_t *words = calloc(job->stream_words + 1, sizeof(*words));
	struct decode_packet last;

	assert_non_null(words);
	accel_transport_copy(job, words);
	assert_int_equal(decode_stream(words, job->stream_words, 0, &last), GLOSS_FAULT_NONE);
	free(words);
	return __real_accel_engine_submit(state, job, sequence);
}

int square_setup(void **state)
{
	struct accel_state *drawn;
	struct fixture *f;

	/* Identity: positions are NDC. */
	assert_int_equal(accel_state_new(&drawn), 0);
	f = fixture_new(SIDE, drawn);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	*state = f;
	return 0;
}

struct accel_mesh square_mesh(void)
{
	return (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .vertices = 4,
					     .position = { .data = square }, .indices = 6,
					     .index = square_index);
}

int mesh_draw(struct fixture *f, const struct accel_mesh *mesh)
{
	return accel_draw_mesh(f->draw, f->state, mesh);
}

void picture(struct fixture *f, const struct accel_mesh *mesh, uint32_t *colour)
{
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(mesh_draw(f, mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, colour, SIDE * 4),
			 0);
}

void assert_all(uint32_t wanted)
{
	for (int i = 0; i < SIDE * SIDE; i++)
		if (pixels[i] != wanted)
			fail_msg("pixel %d,%d is %08x, not %08x", i % SIDE, i / SIDE, pixels[i],
				 wanted);
}

struct accel_draw_stats stats_of(const struct fixture *f)
{
	struct accel_draw_stats stats;

	accel_draw_stats(f->draw, &stats, sizeof(stats));
	return stats;
}
