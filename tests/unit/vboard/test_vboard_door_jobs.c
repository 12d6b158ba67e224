/* SPDX-License-Identifier: MIT */
/* What a board does on the bus of itself: DMA, messages and its pin, of jobs and the doorbell. */
#define _GNU_SOURCE
#include "vboard_door_test.h"

static void expect_pin(int level, bool answer)
{
	test_qtest_expect_pin(&qtest, PIN, level);
	if (answer)
		test_qtest_answer(&qtest, "OK\n");
}

static void a_job_goes_by_dma_and_ends_in_a_message(void **state)
{
	int i;

	(void)state;
	enable(true);
	drive();
	for (i = 0; i < 20; i++) {
		submit();
		expect_msi();
		assert_int_equal(test_host_completed(host, (tail - 1u) % (1u << TEST_RING_LOG2)),
				 99 + tail);
	}
	assert_false(test_qtest_has_more(&qtest, 20));
}

static void the_pin_is_down_before_the_write_that_lowers_it_is_answered(void **state)
{
	struct request clear = bar_request(VBOARD_BAR_WRITE, REGISTERS + GLOSS_REG_INTERRUPT_STATUS,
					   GLOSS_REG_INTERRUPT_STATUS_DONE, 4);

	(void)state;
	enable(false);
	drive();
	submit();
	expect_pin(1, true);
	assert_true(config_read(PCI_STATUS, 2) & PCI_STATUS_INTERRUPT);
	ask(&clear);
	expect_pin(0, false);
	assert_false(answer_comes(50));
	test_qtest_answer(&qtest, "OK\n");
	take_answer();
	assert_false(config_read(PCI_STATUS, 2) & PCI_STATUS_INTERRUPT);
}

static void the_pin_follows_the_command_register(void **state)
{
	(void)state;
	enable(false);
	drive();
	submit();
	expect_pin(1, true);
	struct request disable = {
		.command = VBOARD_CONFIG_WRITE,
		.bytes = sizeof(struct vboard_message_config),
		.config = { PCI_COMMAND,
			    PCI_COMMAND_MEMORY | PCI_COMMAND_MASTER | PCI_COMMAND_INTX_DISABLE, 2 },
	};
	ask(&disable);
	expect_pin(0, true);
	take_answer();
	config_write(PCI_COMMAND, PCI_COMMAND_MEMORY | PCI_COMMAND_MASTER, 2);
	expect_pin(1, true);
}

static void a_reset_is_answered_though_qemu_takes_no_commands(void **state)
{
	const struct request reset = { .command = VBOARD_DEVICE_RESET };

	(void)state;
	enable(false);
	drive();
	submit();
	expect_pin(1, false);
	ask(&reset);
	take_answer();
	test_qtest_answer(&qtest, "OK\n");
	expect_pin(0, true);
	assert_int_equal(config_read(PCI_COMMAND, 2), 0);
	assert_int_equal(config_read(PCI_BASE_ADDRESS_0, 4), 0);
	enable(false);
	assert_int_equal(get(GLOSS_REG_RING_LOG2), 0);
}

static void without_bus_mastering_nothing_goes_out(void **state)
{
	(void)state;
	enable(true);
	drive();
	config_write(PCI_COMMAND, PCI_COMMAND_MEMORY, 2);
	submit();
	while (!(get(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_DMA_ERROR))
		;
	bar_write(WINDOW + VBOARD_FAULT_DOORBELL, 1, 4);
	assert_int_equal(bar_read(WINDOW + VBOARD_FAULT_BUS_MASTER_ERRORS, 4), 1);
	assert_int_equal(test_host_completed(host, 0), 0);
	assert_false(test_qtest_has_more(&qtest, 20));
}

static void the_doorbell_is_a_message_and_nothing_else(void **state)
{
	(void)state;
	enable(true);
	bar_write(WINDOW + VBOARD_FAULT_DOORBELL, 1, 4);
	expect_msi();
	assert_int_equal(get(GLOSS_REG_INTERRUPT_STATUS), 0);
	config_write(MSI + PCI_MSI_FLAGS, 0, 2);
	bar_write(WINDOW + VBOARD_FAULT_DOORBELL, 1, 4);
	assert_false(test_qtest_has_more(&qtest, 20));
}

static void memory_that_is_not_there_is_refused_alone(void **state)
{
	(void)state;
	enable(true);
	drive();
	assert_int_equal(ftruncate(ram, TEST_HOST_BYTES - 1), 0);
	share_memory();
	submit();
	expect_msi();
	assert_true(get(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_DMA_ERROR);
	assert_int_equal(ftruncate(ram, sizeof(*host)), 0);
	share_memory();
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	while (get(GLOSS_REG_CONTROL))
		;
	drive();
	submit();
	expect_msi();
	assert_false(get(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_DMA_ERROR);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_job_goes_by_dma_and_ends_in_a_message),
		TEST(the_pin_is_down_before_the_write_that_lowers_it_is_answered),
		TEST(the_pin_follows_the_command_register),
		TEST(a_reset_is_answered_though_qemu_takes_no_commands),
		TEST(without_bus_mastering_nothing_goes_out),
		TEST(the_doorbell_is_a_message_and_nothing_else),
		TEST(memory_that_is_not_there_is_refused_alone),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
