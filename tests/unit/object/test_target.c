/* SPDX-License-Identifier: MIT */
#include "accel_priv.h"
#include "accel_test.h"

struct fixture {
	struct messages messages;
	struct accel_device *device;
};

static uint64_t words_fetched; /* of the board, by all jobs */

int __real_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);
int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);

int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence)
{
	words_fetched += job->response_words;
	return __real_accel_engine_submit(state, job, sequence);
}

static int setup(void **state)
{
	static struct fixture fixture;

	fixture.device = device_open("model:", &fixture.messages);
	*state = &fixture;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *fixture = *state;

	accel_device_free(fixture->device);
	return 0;
}

static struct accel_target *target_of(struct fixture *fixture, int width, int height)
{
	struct accel_target *target = NULL;

	assert_int_equal(accel_target_new(fixture->device, width, height, &target), 0);
	return target;
}

static void a_side_out_of_range_is_refused(void **state)
{
	static const int sides[] = { 0, -1, ACCEL_TARGET_SIZE_MAX + 1, INT32_MAX, INT32_MIN };
	struct fixture *fixture = *state;
	struct accel_target *target;
	size_t i;

	for (i = 0; i < sizeof(sides) / sizeof(sides[0]); i++) {
		assert_int_equal(accel_target_new(fixture->device, sides[i], 10, &target), -EINVAL);
		assert_int_equal(accel_target_new(fixture->device, 10, sides[i], &target), -EINVAL);
	}
	assert_message(&fixture->messages, "a side has 1 to 2048");
}

static void surfaces_are_padded_to_whole_tiles(void **state)
{
	static const int sides[][2] = { { 1, 64 },
					{ 63, 64 },
					{ 64, 64 },
					{ 65, 128 },
					{ ACCEL_TARGET_SIZE_MAX, ACCEL_TARGET_SIZE_MAX } };
	struct accel_target *target;
	size_t i;

	for (i = 0; i < sizeof(sides) / sizeof(sides[0]); i++) {
		target = target_of(*state, sides[i][0], sides[i][0]);
		assert_int_equal(target->pitch, sides[i][1] * 4);
		assert_int_equal(target->rows, sides[i][1]);
		assert_int_equal(target->colour->size, sides[i][1] * sides[i][1] * 4);
		assert_int_equal(target->depth->size, target->colour->size);
		accel_target_free(target);
	}
}

static uint32_t pixel_at(uint32_t x, uint32_t y, uint32_t of)
{
	return (x * 2654435761u) ^ (y * 40503u) ^ of;
}

static void fill(struct accel_target *target, struct accel_buffer *buffer, uint32_t of)
{
	uint32_t x, y, row[ACCEL_TARGET_SIZE_MAX];

	for (y = 0; y < target->rows; y++) {
		for (x = 0; x < target->pitch / 4; x++)
			row[x] = pixel_at(x, y, of);
		assert_int_equal(accel_buffer_write(buffer, (uint64_t)y * target->pitch, row,
						    target->pitch),
				 0);
	}
}

/* Reads with @gap bytes between rows, which must stay as they are. */
static void check_read(struct accel_target *target, size_t gap, uint32_t of, enum accel_plane plane)
{
	uint32_t x, y, width = (uint32_t)target->width, height = (uint32_t)target->height;
	size_t pitch = width * 4 + gap, i;
	uint8_t *pixels = malloc(pitch * height);

	memset(pixels, 0xee, pitch * height);
	assert_int_equal(accel_target_read(target, plane, NULL, pixels, pitch), 0);
	for (y = 0; y < height; y++) {
		for (x = 0; x < width; x++) {
			uint32_t got;

			memcpy(&got, pixels + y * pitch + x * 4, 4);
			assert_int_equal(got, pixel_at(x, y, of));
		}
		for (i = width * 4; i < pitch; i++)
			assert_int_equal(pixels[y * pitch + i], 0xee);
	}
	free(pixels);
}

static void every_pixel_is_read_at_its_place(void **state)
{
	static const struct {
		int width, height;
		size_t gap;
	} size[] = { { 1, 1, 0 },
		     { 1, 1, 4 },
		     { 65, 3, 8 },
		     { 640, 480, 0 },
		     { 300, 130, 20 },
		     { ACCEL_TARGET_SIZE_MAX, 33, 4 },
		     { 3, ACCEL_TARGET_SIZE_MAX, 0 } };
	struct accel_target *target;
	size_t i;

	for (i = 0; i < sizeof(size) / sizeof(size[0]); i++) {
		target = target_of(*state, size[i].width, size[i].height);
		fill(target, target->colour, 1);
		fill(target, target->depth, 2);
		check_read(target, size[i].gap, 1, ACCEL_PLANE_COLOUR);
		check_read(target, size[i].gap, 2, ACCEL_PLANE_DEPTH);
		accel_target_free(target);
	}
}

static void a_rectangle_is_read_alone(void **state)
{
	static const struct accel_rectangle parts[] = {
		{ 0, 0, 300, 130 }, { 0, 0, 1, 1 },      { 299, 129, 1, 1 },
		{ 63, 63, 2, 3 },   { 17, 0, 200, 130 }, { 0, 100, 300, 30 },
		{ 300, 130, 0, 0 }, { 5, 5, 0, 7 },      { 5, 5, 7, 0 },
	};
	struct accel_target *target = target_of(*state, 300, 130);
	static uint32_t pixels[301 * 131];

	fill(target, target->colour, 1);
	fill(target, target->depth, 2);
	for (size_t n = 0; n < 2 * sizeof(parts) / sizeof(parts[0]); n++) {
		const struct accel_rectangle *part = &parts[n / 2];
		enum accel_plane plane = n % 2 ? ACCEL_PLANE_DEPTH : ACCEL_PLANE_COLOUR;
		size_t row = (size_t)part->width + 1;

		memset(pixels, 0xee, sizeof(pixels));
		assert_int_equal(accel_target_read(target, plane, part, pixels, row * 4), 0);
		for (size_t i = 0; i < row * (size_t)(part->height + 1); i++) {
			uint32_t x = (uint32_t)(i % row), y = (uint32_t)(i / row);
			bool in = x < (uint32_t)part->width && y < (uint32_t)part->height;

			assert_int_equal(pixels[i],
					 in ? pixel_at(x + (uint32_t)part->x, y + (uint32_t)part->y,
						       n % 2 + 1) :
					      0xeeeeeeee);
		}
	}
	accel_target_free(target);
}

/* What is written where nothing was, and what beside it stays. */
static void a_rectangle_is_written_alone(void **state)
{
	static const struct accel_rectangle parts[] = {
		{ 0, 0, 2048, 70 }, { 0, 0, 1, 1 },     { 2047, 69, 1, 1 },
		{ 63, 63, 2, 3 },   { 7, 5, 1900, 60 }, { 2048, 70, 0, 0 },
	};
	static uint32_t pixels[2049 * 71], got[2048 * 70];
	struct accel_target *target = target_of(*state, 2048, 70);

	for (size_t n = 0; n < 2 * sizeof(parts) / sizeof(parts[0]); n++) {
		const struct accel_rectangle *part = &parts[n / 2];
		const enum accel_plane plane = n % 2 ? ACCEL_PLANE_DEPTH : ACCEL_PLANE_COLOUR;
		const uint32_t mask = n % 2 ? 0xffffff : 0xffffffff;
		const uint32_t row = (uint32_t)part->width + 1;

		fill(target, n % 2 ? target->depth : target->colour, 1);
		for (uint32_t i = 0; i < row * (uint32_t)part->height; i++)
			pixels[i] = pixel_at(i % row, i / row, 3);
		assert_int_equal(accel_target_write(target, plane, part, pixels, row * 4), 0);
		assert_int_equal(accel_target_read(target, plane, NULL, got, 2048 * 4), 0);
		for (uint32_t i = 0; i < 2048 * 70; i++) {
			const uint32_t x = i % 2048 - (uint32_t)part->x;
			const uint32_t y = i / 2048 - (uint32_t)part->y;
			const bool in = x < (uint32_t)part->width && y < (uint32_t)part->height;

			assert_int_equal(got[i], in ? pixel_at(x, y, 3) & mask :
						      pixel_at(i % 2048, i / 2048, 1));
		}
	}
	accel_target_free(target);
}

/* What a target's tiles are known to hold is not what was written over them. */
static void a_clear_after_a_write_is_not_left_out(void **state)
{
	struct fixture *fixture = *state;
	struct accel_target *target = target_of(fixture, 64, 64);
	const struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR);
	uint32_t pixel = 0x12345678;
	struct accel_draw *draw;

	assert_int_equal(accel_draw_new(fixture->device, &draw), 0);
	for (int i = 0; i < 3; i++) {
		assert_int_equal(accel_draw_begin(draw, target, &clear), 0);
		assert_int_equal(accel_draw_finish(draw), 0);
	}
	assert_int_equal(accel_target_write(target, ACCEL_PLANE_COLOUR,
					    &(struct accel_rectangle){ 9, 9, 1, 1 }, &pixel, 4),
			 0);
	assert_int_equal(accel_draw_begin(draw, target, &clear), 0);
	assert_int_equal(accel_draw_finish(draw), 0);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR,
					   &(struct accel_rectangle){ 9, 9, 1, 1 }, &pixel, 4),
			 0);
	assert_int_equal(pixel, 0);
	accel_draw_free(draw);
	accel_target_free(target);
}

static void only_the_rectangle_is_fetched(void **state)
{
	static const struct accel_rectangle part = { 100, 20, 150, 90 };
	struct accel_target *target = target_of(*state, 300, 130);
	static uint32_t pixels[300 * 130];

	words_fetched = 0;
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_DEPTH, &part, pixels, 600), 0);
	assert_int_equal(words_fetched, 150 * 90);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 1200), 0);
	assert_int_equal(words_fetched, 150 * 90 + 300 * 130);
	accel_target_free(target);
}

static void a_rectangle_beside_the_target_is_refused(void **state)
{
	static const struct accel_rectangle wrong[] = {
		{ -1, 0, 1, 1 },
		{ 0, -1, 1, 1 },
		{ 10, 0, 1, 1 },
		{ 0, 10, 1, 1 },
		{ 0, 0, 11, 1 },
		{ 0, 0, 1, 11 },
		{ 1, 0, 10, 1 },
		{ 0, 0, -1, 1 },
		{ 0, 0, 1, -1 },
		{ INT32_MAX, 0, INT32_MAX, 1 },
		{ 1, 1, INT32_MAX, INT32_MAX },
		{ INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN },
		{ 11, 0, 0, 0 },
	};
	struct fixture *fixture = *state;
	struct accel_target *target = target_of(fixture, 10, 10);
	uint32_t pixel;

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++)
		assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, &wrong[i], &pixel,
						   1 << 20),
				 -EINVAL);
	assert_message(&fixture->messages, "0 x 0 pixels at 11, 0 of a target of 10 x 10");
	assert_int_equal(accel_target_read(target, (enum accel_plane)2, NULL, &pixel, 40), -EINVAL);
	assert_message(&fixture->messages, "a target has no plane 2");
	accel_target_free(target);
}

static void a_new_target_is_zero(void **state)
{
	struct accel_target *target = target_of(*state, 65, 65);
	uint32_t pixels[65 * 65], i;

	fill(target, target->colour, 1);
	fill(target, target->depth, 1);
	accel_target_free(target);
	target = target_of(*state, 65, 65);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 65 * 4), 0);
	for (i = 0; i < 65 * 65; i++)
		assert_int_equal(pixels[i], 0);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_DEPTH, NULL, pixels, 65 * 4), 0);
	for (i = 0; i < 65 * 65; i++)
		assert_int_equal(pixels[i], 0);
	accel_target_free(target);
}

static void a_pitch_too_small_or_between_words_is_refused(void **state)
{
	struct fixture *fixture = *state;
	struct accel_target *target = target_of(fixture, 10, 10);
	uint32_t pixels[11 * 10];

	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 36), -EINVAL);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_DEPTH, NULL, pixels, 0), -EINVAL);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 42), -EINVAL);
	assert_message(&fixture->messages, "a pitch of 42 bytes for rows of 10 pixels");
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 44), 0);
	accel_target_free(target);
}

static void a_target_that_does_not_fit_leaves_no_memory_taken(void **state)
{
	struct accel_target *target, *half;
	struct messages messages;
	struct accel_device *device;

	(void)state;
	device = device_open("model:memory=32768", &messages);
	assert_int_equal(accel_target_new(device, 128, 64, &target), -ENOMEM);
	assert_int_equal(accel_target_new(device, 64, 64, &half), 0);
	assert_int_equal(accel_target_new(device, 1, 1, &target), -ENOMEM);
	accel_target_free(half);
	assert_int_equal(accel_target_new(device, 64, 64, &half), 0);
	accel_target_free(half);
	accel_device_free(device);
}

#define target_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		target_test(a_side_out_of_range_is_refused),
		target_test(surfaces_are_padded_to_whole_tiles),
		target_test(every_pixel_is_read_at_its_place),
		target_test(a_rectangle_is_read_alone),
		target_test(a_rectangle_is_written_alone),
		target_test(a_clear_after_a_write_is_not_left_out),
		target_test(only_the_rectangle_is_fetched),
		target_test(a_rectangle_beside_the_target_is_refused),
		target_test(a_new_target_is_zero),
		target_test(a_pitch_too_small_or_between_words_is_refused),
		cmocka_unit_test(a_target_that_does_not_fit_leaves_no_memory_taken),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
