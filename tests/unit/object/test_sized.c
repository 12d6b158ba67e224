/* SPDX-License-Identifier: MIT */
/* Structs of programs that are older or newer than the library. */
#include "accel_priv.h"
#include "accel_test.h"

/* A struct over three versions: the library is of the second. */
struct first {
	size_t size;
	uint32_t a;
	float b[3];
};

struct second {
	size_t size;
	uint32_t a;
	float b[3];
	uint64_t c;
	uint32_t d;
	uint32_t e;
};

struct third {
	struct second as_before;
	uint8_t f[9];
};

static const struct second all = { sizeof(all), 1, { 2, 3, 4 }, 5, 6, 7 };

static void a_struct_of_the_same_version_is_taken_as_it_is(void **state)
{
	struct second own;

	(void)state;
	assert_int_equal(accel_sized_in(&own, sizeof(own), &all), 0);
	assert_memory_equal(&own, &all, sizeof(all));
}

static void what_an_older_program_does_not_know_is_zero(void **state)
{
	const struct first old = { sizeof(old), 1, { 2, 3, 4 } };
	const struct second wanted = { sizeof(wanted), 1, { 2, 3, 4 }, 0, 0, 0 };
	struct second own;

	(void)state;
	memset(&own, 0xee, sizeof(own));
	assert_int_equal(accel_sized_in(&own, sizeof(own), &old), 0);
	assert_memory_equal(&own, &wanted, sizeof(wanted));
}

static void what_the_library_does_not_know_must_be_zero(void **state)
{
	struct third new = { .as_before = all };
	struct second own;

	(void)state;
	new.as_before.size = sizeof(new);
	assert_int_equal(accel_sized_in(&own, sizeof(own), &new), 0);
	assert_memory_equal(&own, &all, sizeof(all));
	for (size_t i = 0; i < sizeof(new.f); i++) {
		new.f[i] = 1;
		assert_int_equal(accel_sized_in(&own, sizeof(own), &new), -E2BIG);
		new.f[i] = 0;
	}
}

static void a_size_that_was_not_set_is_refused(void **state)
{
	static const size_t wrong[] = { 0, 1, sizeof(size_t) - 1, 4097, SIZE_MAX };
	struct second own, given = all;

	(void)state;
	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		given.size = wrong[i];
		assert_int_equal(accel_sized_in(&own, sizeof(own), &given), -EINVAL);
	}
}

/* Bytes behind @size stay as they are. */
static void check_out(size_t size)
{
	uint8_t given[sizeof(struct third) + 8];

	memset(given, 0xee, sizeof(given));
	accel_sized_out(given, size, &all, sizeof(all));
	for (size_t i = 0; i < sizeof(given); i++) {
		int wanted = i >= size ? 0xee : i >= sizeof(all) ? 0 : ((const uint8_t *)&all)[i];

		assert_int_equal(given[i], wanted);
	}
}

static void as_much_is_filled_as_the_program_has_room_for(void **state)
{
	(void)state;
	for (size_t size = 0; size <= sizeof(struct third); size++)
		check_out(size);
}

/* Of @given, filled into bytes of 0xee: @size of them, of which @known are of the library. */
static void check_answer(const uint8_t *given, size_t size, size_t known, size_t room)
{
	for (size_t i = known; i < room; i++)
		assert_int_equal(given[i], i < size ? 0 : 0xee);
}

static void each_answer_of_the_library_is_filled_so(void **state)
{
	static const size_t more[] = { 0, 1, 8, 16 };
	union {
		struct accel_device_info info;
		struct accel_draw_stats stats;
		struct accel_fence_status status;
		uint8_t bytes[128];
	} given;
	const size_t room = sizeof(given.bytes);
	struct accel_device *device;
	struct accel_stream *stream;
	struct messages messages;
	struct accel_fence *fence;
	struct accel_draw *draw;

	(void)state;
	device = device_open("model:", &messages);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	for (size_t i = 0; i < sizeof(more) / sizeof(more[0]); i++) {
		memset(&given, 0xee, sizeof(given));
		accel_device_info(device, &given.info, sizeof(given.info) + more[i]);
		assert_int_equal(given.info.memory_size, 256 << 20);
		check_answer(given.bytes, sizeof(given.info) + more[i], sizeof(given.info), room);
		memset(&given, 0xee, sizeof(given));
		accel_draw_stats(draw, &given.stats, sizeof(given.stats) + more[i]);
		assert_int_equal(given.stats.tiles, 0);
		check_answer(given.bytes, sizeof(given.stats) + more[i], sizeof(given.stats), room);
		memset(&given, 0xee, sizeof(given));
		assert_int_equal(accel_fence_wait(fence, -1, &given.status,
						  sizeof(given.status) + more[i]),
				 0);
		assert_int_equal(given.status.fault, 0);
		check_answer(given.bytes, sizeof(given.status) + more[i], sizeof(given.status),
			     room);
	}
	/* And no more than an older program has room for. */
	memset(&given, 0xee, sizeof(given));
	accel_device_info(device, &given.info, offsetof(struct accel_device_info, memory_size));
	assert_int_equal(given.info.tile_size, 64);
	check_answer(given.bytes, 0, offsetof(struct accel_device_info, memory_size), room);
	memset(&given, 0xee, sizeof(given));
	assert_int_equal(accel_fence_wait(fence, -1, &given.status, 4), 0);
	check_answer(given.bytes, 0, 4, room);
	accel_fence_free(fence);
	accel_stream_free(stream);
	accel_draw_free(draw);
	accel_device_free(device);
}

static void the_version_is_that_of_the_header(void **state)
{
	char text[64];

	(void)state;
	snprintf(text, sizeof(text), "%d.%d.%d", ACCEL_VERSION_MAJOR, ACCEL_VERSION_MINOR,
		 ACCEL_VERSION_PATCH);
	assert_string_equal(accel_version(), text);
}

static void a_message_is_printed_as_one_line(void **state)
{
	FILE *file = tmpfile();
	char line[64] = "";

	(void)state;
	assert_non_null(file);
	accel_message_print(file, "a line of 100% text");
	assert_int_equal(fseek(file, 0, SEEK_SET), 0);
	assert_non_null(fgets(line, sizeof(line), file));
	assert_string_equal(line, "a line of 100% text\n");
	assert_null(fgets(line, sizeof(line), file));
	fclose(file);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_struct_of_the_same_version_is_taken_as_it_is),
		cmocka_unit_test(what_an_older_program_does_not_know_is_zero),
		cmocka_unit_test(what_the_library_does_not_know_must_be_zero),
		cmocka_unit_test(a_size_that_was_not_set_is_refused),
		cmocka_unit_test(as_much_is_filled_as_the_program_has_room_for),
		cmocka_unit_test(each_answer_of_the_library_is_filled_so),
		cmocka_unit_test(the_version_is_that_of_the_header),
		cmocka_unit_test(a_message_is_printed_as_one_line),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
