/* SPDX-License-Identifier: MIT */
/* What a board in its slot answers to QEMU, whatever it is asked. */
#define _GNU_SOURCE
#include "vboard_door_test.h"

static void registers_answer_where_the_bar_is(void **state)
{
	(void)state;
	assert_int_equal(bar_read(REGISTERS, 4), UINT64_MAX);
	enable(true);
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
	assert_int_equal(bar_read(WINDOW + VBOARD_FAULT_IDENTITY, 4), VBOARD_FAULT_IDENTITY_VALUE);
	assert_int_equal(bar_read(WINDOW + VBOARD_FAULTS_BYTES, 4), UINT64_MAX);
	config_write(PCI_BASE_ADDRESS_0, 0xfea00000, 4);
	assert_int_equal(bar_read(REGISTERS, 4), UINT64_MAX);
	assert_int_equal(bar_read(0xfea00000, 4), GLOSS_IDENTITY);
}

static void accesses_of_other_widths_are_made_of_words(void **state)
{
	static const uint32_t odd[] = { 0, 3, 5, 16, UINT32_MAX };
	size_t i;

	(void)state;
	enable(true);
	bar_write(REGISTERS + GLOSS_REG_RING_LOW, 0x1122334455667788, 8);
	assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_LOW, 8), 0x1122334455667788);
	assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_HIGH, 4), 0x11223344);
	assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_HIGH + 2, 2), 0x1122);
	assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_HIGH + 1, 1), 0x33);
	bar_write(REGISTERS + GLOSS_REG_RING_HIGH, 0, 2);
	bar_write(REGISTERS + GLOSS_REG_RING_HIGH, 0, 1);
	bar_write(REGISTERS + GLOSS_REG_RING_LOW + 2, 0, 4);
	for (i = 0; i < sizeof(odd) / sizeof(odd[0]); i++) {
		bar_write(REGISTERS + GLOSS_REG_RING_LOW, 0, odd[i]);
		assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_LOW, odd[i]), UINT64_MAX);
	}
	assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_LOW, 8), 0x1122334455667788);
	assert_int_equal(bar_read(REGISTERS + GLOSS_REG_RING_LOW + 2, 4), UINT64_MAX);
	assert_int_equal(bar_read(REGISTERS + 33, 3), UINT64_MAX);
	assert_int_equal(bar_read(REGISTERS + 36, 6), UINT64_MAX);
}

/* All requests are there at once, and the host takes answers as fast as they come. */
static void a_host_that_keeps_asking_does_not_stop_the_board(void **state)
{
	enum { ASKED = 3000 };
	struct request request = bar_request(VBOARD_BAR_READ, REGISTERS + GLOSS_REG_HEAD, 0, 4);
	const size_t size = 16 + request.bytes;
	uint8_t *all = malloc(ASKED * size);
	uint64_t head = 0;
	int i;

	(void)state;
	enable(true);
	drive();
	test_host_job(host, 0, 100);
	for (i = 0; i < ASKED; i++)
		memcpy(all + i * size, &request, size);
	request = bar_request(VBOARD_BAR_WRITE, REGISTERS + GLOSS_REG_TAIL, 1, 4);
	memcpy(all, &request, size);
	assert_int_equal(send(proxy, all, ASKED * size, MSG_NOSIGNAL), ASKED * size);
	for (i = 0; i < ASKED; i++)
		head = take_answer();
	assert_int_equal(head, 1);
	expect_msi();
	free(all);
}

static void a_dead_board_is_gone_from_the_bus(void **state)
{
	(void)state;
	enable(true);
	bar_write(WINDOW + VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW, 4);
	assert_int_equal(config_read(PCI_VENDOR_ID, 4), 0xffffffff);
	assert_int_equal(get(GLOSS_REG_IDENTITY), 0xffffffff);
	config_write(PCI_COMMAND, 0, 2);
	assert_int_equal(bar_read(WINDOW + VBOARD_FAULT_IDENTITY, 4), VBOARD_FAULT_IDENTITY_VALUE);
	bar_write(WINDOW + VBOARD_FAULT_DIE, 0, 4);
	assert_int_equal(config_read(PCI_VENDOR_ID, 4), 0x474c10ee);
	assert_int_equal(config_read(PCI_COMMAND, 2), 0);
	enable(true);
	drive();
	submit();
	expect_msi();
}

static void a_delayed_doorbell_comes_in_time_or_before_a_request(void **state)
{
	(void)state;
	enable(true);
	drive();
	bar_write(WINDOW + VBOARD_FAULT_DELAY_WRITES, 1000, 4);
	submit();
	expect_msi();
	bar_write(WINDOW + VBOARD_FAULT_DELAY_WRITES, UINT32_MAX, 4);
	submit();
	assert_false(test_qtest_has_more(&qtest, 5));
	config_read(PCI_VENDOR_ID, 4);
	expect_msi();
}

/* A request as QEMU could send it, with anything in it, but mostly where something is. */
static struct request random_request(uint64_t *seed)
{
	static const enum vboard_command commands[] = {
		VBOARD_CONFIG_WRITE,
		VBOARD_CONFIG_READ,
		VBOARD_BAR_WRITE,
		VBOARD_BAR_READ,
	};
	static const uint64_t bases[] = { REGISTERS, WINDOW, 0, UINT64_MAX - 7 };
	enum vboard_command command = commands[test_below(seed, 4)];
	uint64_t at = bases[test_below(seed, 4)] + test_below(seed, 0x90);

	if (command == VBOARD_BAR_WRITE || command == VBOARD_BAR_READ)
		return bar_request(command, at, test_random(seed) >> test_below(seed, 64),
				   test_below(seed, 4) ? 4 : (uint32_t)test_random(seed) % 20);
	return (struct request){
		.command = (int32_t)command,
		.bytes = sizeof(struct vboard_message_config),
		.config = {
			.address = test_below(seed, 300),
			.value = (uint32_t)test_random(seed),
			.bytes = (int)test_below(seed, 8) - 1,
		},
	};
}

/* Everybody answers, whatever was asked: nothing the guest does ends a board. */
static void random_requests_are_all_answered(void **state)
{
	uint64_t seed = test_seed();
	int i;

	(void)state;
	enable(true);
	drive();
	for (i = 0; i < 5000; i++) {
		struct request request = random_request(&seed);

		ask(&request);
		do
			test_qtest_answer_all(&qtest);
		while (!answer_comes(1));
		take_answer();
		if (i % 100 == 0)
			enable(false);
	}
}

static void something_that_is_no_message_ends_the_board(void **state)
{
	const struct request wrong = { .command = 99 };

	setup(state);
	ask(&wrong);
	assert_int_equal(end(), -EPROTO);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(registers_answer_where_the_bar_is),
		TEST(accesses_of_other_widths_are_made_of_words),
		TEST(a_host_that_keeps_asking_does_not_stop_the_board),
		TEST(a_dead_board_is_gone_from_the_bus),
		TEST(a_delayed_doorbell_comes_in_time_or_before_a_request),
		TEST(random_requests_are_all_answered),
		cmocka_unit_test(something_that_is_no_message_ends_the_board),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
