/* SPDX-License-Identifier: MIT */
/* What the tests of bins and frames share: a bin of 200 by 100 pixels in tiles of 64, and a board
 * that shows what it is sent. */
#ifndef BIN_TEST_H
#define BIN_TEST_H

#include "accel_priv.h"
#include "draw_test.h"

#define WIDTH 200
#define HEIGHT 100

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_stream *stream;
	struct accel_state *state;
	struct accel_bin bin;
	struct accel_draw_stats stats;
	struct accel_bounds all;
};

static inline int bin_setup(void **state)
{
	static struct fixture f;

	memset(&f, 0, sizeof(f));
	f.device = device_open("model:tile=64", &f.messages);
	assert_int_equal(accel_target_new(f.device, WIDTH, HEIGHT, &f.target), 0);
	assert_int_equal(accel_stream_new(f.device, &f.stream), 0);
	assert_int_equal(accel_state_new(&f.state), 0);
	accel_bin_init(&f.bin, 64);
	assert_int_equal(accel_bin_begin(&f.bin, WIDTH, HEIGHT), 0);
	f.all = (struct accel_bounds){ 0, 0, WIDTH, HEIGHT };
	accel_bin_state(&f.bin, f.state, &f.all);
	*state = &f;
	return 0;
}

static inline int bin_teardown(void **state)
{
	struct fixture *f = *state;

	accel_bin_free(&f->bin);
	accel_state_free(f->state);
	accel_stream_free(f->stream);
	accel_target_free(f->target);
	accel_device_free(f->device);
	return 0;
}

#define bin_test(name) cmocka_unit_test_setup_teardown(name, bin_setup, bin_teardown)

/* A flat square's lower left half, @side pixels at (x, y). */
static inline void draw_in(struct accel_bin *bin, int x, int y, int side)
{
	const struct accel_vertex a = vertex_at(16 * x, 16 * y);
	const struct accel_vertex b = vertex_at(16 * (x + side), 16 * (y + side));
	const struct accel_vertex c = vertex_at(16 * x, 16 * (y + side));
	const struct accel_vertex *const vertex[3] = { &a, &b, &c };
	struct accel_triangle triangle;
	struct accel_depth_plane plane;

	assert_true(triangle_ready(&triangle, &plane, vertex));
	assert_int_equal(accel_bin_triangle(bin, &triangle), 0);
}

static inline void draw_at(struct fixture *f, int x, int y, int side)
{
	draw_in(&f->bin, x, y, side);
}

/* ---- a board that shows what it is sent ---- */

static const struct accel_transport_ops *board;
static struct accel_transport_ops spy;
static uint32_t sent_words[65536];
static uint32_t sent_count, sent_jobs;
static uint32_t refused_job; /* the one that there is no memory for, 0: none */
static unsigned int waits;
static const uint32_t *sent_part[16]; /* the first ones of the last job */

static inline int spy_submit(void *state, const struct accel_transport_job *job, uint64_t *sequence)
{
	assert_true(sent_count + job->stream_words <= sizeof(sent_words) / sizeof(*sent_words));
	accel_transport_copy(job, sent_words + sent_count);
	for (size_t i = 0, words = 0; job->part && i < 16 && words < job->stream_words; i++) {
		sent_part[i] = job->part[i].words;
		words += job->part[i].count;
	}
	if (sent_jobs + 1 == refused_job)
		return -ENOMEM;
	sent_count += job->stream_words;
	sent_jobs++;
	return board->submit(state, job, sequence);
}

static inline int spy_wait(void *state, uint64_t sequence, int64_t timeout_ns,
			   struct gloss_status *status)
{
	waits++;
	return board->wait(state, sequence, timeout_ns, status);
}

static inline void spy_begin(struct fixture *f)
{
	board = f->device->ops;
	spy = *board;
	spy.submit = spy_submit;
	spy.wait = spy_wait;
	f->device->ops = &spy;
	sent_count = sent_jobs = refused_job = waits = 0;
}

static inline void submit(struct fixture *f, size_t job_words)
{
	struct accel_fence *fence;
	bool sent;

	spy_begin(f);
	assert_int_equal(accel_frame_submit(&f->bin, f->stream, f->target, job_words, &f->stats,
					    &fence, &sent),
			 0);
	assert_int_equal(waits, 0);
	f->device->ops = board;
	assert_true(sent);
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
	assert_int_equal(f->stats.stream_words, sent_count);
}

/* The packet of @opcode that comes after @skip others of it; NULL if there is none. */
static inline const uint32_t *packet(unsigned int opcode, int skip)
{
	for (uint32_t i = 0; i < sent_count; i += packet_words(sent_words[i]))
		if (gloss_header_opcode(sent_words[i]) == opcode && skip-- == 0)
			return &sent_words[i];
	return NULL;
}

static inline int packets(unsigned int opcode)
{
	int count = 0;

	while (packet(opcode, count))
		count++;
	return count;
}

static inline void clear(struct fixture *f, unsigned int mask, uint32_t colour, uint32_t depth)
{
	const struct accel_tile_clear values = { mask, colour, depth };

	assert_int_equal(accel_bin_clear(&f->bin, &values), 0);
}

static inline void set_state(struct fixture *f, enum accel_compare func, bool write, bool colours)
{
	accel_state_set_depth(f->state, func, write);
	accel_state_set_colour_mask(f->state, colours, colours, colours, colours);
	accel_bin_state(&f->bin, f->state, &f->all);
}

#endif
