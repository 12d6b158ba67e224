/* SPDX-License-Identifier: MIT */
/* What of the host's memory DMA reaches, and what not. */
#define _GNU_SOURCE
#include <sys/mman.h>
#include <unistd.h>

#include "accel_test.h"
#include "vboard/pci/memory.h"

#define PAGE 4096u
#define FILE_PAGES 8u

static struct vboard_memory memory;
static int file;
static uint8_t *contents; /* of the file */

static int setup(void **state)
{
	(void)state;
	memory.regions = 0;
	file = memfd_create("host", MFD_CLOEXEC);
	if (file < 0 || ftruncate(file, FILE_PAGES * PAGE))
		return -1;
	contents = mmap(NULL, FILE_PAGES * PAGE, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
	return contents == MAP_FAILED ? -1 : 0;
}

static int teardown(void **state)
{
	(void)state;
	vboard_memory_clear(&memory);
	munmap(contents, FILE_PAGES * PAGE);
	return close(file);
}

static int add(uint64_t address, uint64_t pages, uint64_t from_page)
{
	return vboard_memory_add(&memory, address, pages * PAGE, file, from_page * PAGE);
}

static void bytes_are_those_of_the_file(void **state)
{
	uint8_t bytes[4] = { 0 };

	(void)state;
	assert_int_equal(add(0x100000000, 2, 3), 0);
	/* NOLINTNEXTLINE(bugprone-not-null-terminated-result): bytes, no text */
	memcpy(contents + 3 * PAGE + 5, "abcd", 4);
	assert_true(vboard_memory_read(&memory, 0x100000005, bytes, 4));
	assert_memory_equal(bytes, "abcd", 4);
	assert_true(vboard_memory_write(&memory, 0x100001ffc, "wxyz", 4));
	assert_memory_equal(contents + 5 * PAGE - 4, "wxyz", 4);
}

static void a_range_may_go_on_in_another_region(void **state)
{
	uint8_t bytes[2 * PAGE], expected[2 * PAGE];
	size_t i;

	(void)state;
	/* In the order of neither the bus nor the file. */
	assert_int_equal(add(0x12000, 1, 0), 0);
	assert_int_equal(add(0x10000, 1, 6), 0);
	assert_int_equal(add(0x11000, 1, 2), 0);
	for (i = 0; i < sizeof(expected); i++)
		expected[i] = (uint8_t)(i * 7);
	assert_true(vboard_memory_write(&memory, 0x10800, expected, sizeof(expected)));
	assert_memory_equal(contents + 6 * PAGE + 0x800, expected, 0x800);
	assert_memory_equal(contents + 2 * PAGE, expected + 0x800, PAGE);
	assert_memory_equal(contents, expected + 0x800 + PAGE, 0x800);
	assert_true(vboard_memory_read(&memory, 0x10800, bytes, sizeof(bytes)));
	assert_memory_equal(bytes, expected, sizeof(bytes));
}

static void a_range_that_is_not_all_memory_moves_nothing(void **state)
{
	static const struct {
		uint64_t address;
		uint32_t bytes;
	} wrong[] = {
		{ 0xffff, 1 },           { 0xffff, 2 },         { 0x11000, 1 },
		{ 0x10fff, 2 },          { 0x10000, PAGE + 1 }, { 0, 4 },
		{ UINT64_MAX, 1 },       { UINT64_MAX - 3, 4 }, { UINT64_MAX - 3, 64 },
		{ 0x10000, UINT32_MAX }, { 0x100010000, 4 },
	};
	uint8_t bytes[2 * PAGE], before[2 * PAGE];
	size_t i;

	(void)state;
	assert_int_equal(add(0x10000, 1, 1), 0);
	memset(contents, 0x55, FILE_PAGES * PAGE);
	memset(bytes, 0xaa, sizeof(bytes));
	memcpy(before, bytes, sizeof(bytes));
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_false(vboard_memory_read(&memory, wrong[i].address, bytes, wrong[i].bytes));
		assert_memory_equal(bytes, before, sizeof(bytes));
		assert_false(vboard_memory_write(&memory, wrong[i].address, bytes, wrong[i].bytes));
		assert_int_equal(contents[2 * PAGE - 1], 0x55);
		assert_int_equal(contents[PAGE], 0x55);
	}
}

static void a_region_can_reach_the_end_of_the_bus(void **state)
{
	uint8_t bytes[2];

	(void)state;
	assert_int_equal(add(UINT64_MAX - PAGE, 1, 0), 0);
	assert_true(vboard_memory_read(&memory, UINT64_MAX - 2, bytes, 2));
	assert_false(vboard_memory_read(&memory, UINT64_MAX - 1, bytes, 2));
}

static void a_region_that_is_not_there_is_refused(void **state)
{
	(void)state;
	assert_int_equal(vboard_memory_add(&memory, 0, 0, file, 0), -EINVAL);
	assert_int_equal(vboard_memory_add(&memory, UINT64_MAX - PAGE + 1, PAGE, file, 0), -EINVAL);
	assert_int_equal(add(0, FILE_PAGES + 1, 0), -EINVAL);
	assert_int_equal(add(0, 1, FILE_PAGES), -EINVAL);
	assert_int_equal(add(0, 2, FILE_PAGES - 1), -EINVAL);
	assert_int_equal(vboard_memory_add(&memory, 0, UINT64_MAX, file, 0), -EINVAL);
	assert_int_equal(vboard_memory_add(&memory, 0, PAGE, file, UINT64_MAX - PAGE + 1), -EINVAL);
	assert_int_equal(vboard_memory_add(&memory, 0, PAGE, file, 1), -EINVAL);
	assert_int_equal(vboard_memory_add(&memory, 0, PAGE, -1, 0), -EBADF);
	assert_int_equal(memory.regions, 0);
}

static void a_ninth_region_is_refused(void **state)
{
	uint64_t i;

	(void)state;
	for (i = 0; i < VBOARD_REGIONS; i++)
		assert_int_equal(add(i * PAGE, 1, i), 0);
	assert_int_equal(add(i * PAGE, 1, 0), -EINVAL);
}

static void nothing_is_left_after_clear(void **state)
{
	uint8_t byte;

	(void)state;
	assert_int_equal(add(0, FILE_PAGES, 0), 0);
	vboard_memory_clear(&memory);
	assert_false(vboard_memory_read(&memory, 0, &byte, 1));
}

#define memory_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		memory_test(bytes_are_those_of_the_file),
		memory_test(a_range_may_go_on_in_another_region),
		memory_test(a_range_that_is_not_all_memory_moves_nothing),
		memory_test(a_region_can_reach_the_end_of_the_bus),
		memory_test(a_region_that_is_not_there_is_refused),
		memory_test(a_ninth_region_is_refused),
		memory_test(nothing_is_left_after_clear),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
