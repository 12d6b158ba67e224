/* SPDX-License-Identifier: MIT */
/* Each fault does what the header says to a board that works, and no more. */
#include "vboard/board/board.h"
#include "still_clock.h"
#include "vboard_test.h"

static struct test_host host;
static struct vboard_faults faults;
static uint8_t board_memory[TEST_BOARD_BYTES];
static uint16_t tail;

static void put(uint32_t offset, uint32_t value)
{
	vboard_faults_write(&faults, offset, value);
}

static uint32_t get(uint32_t offset)
{
	return vboard_faults_read(&faults, offset);
}

static void arm(uint32_t offset, uint32_t value)
{
	vboard_faults_window_write(&faults, offset, value);
}

static uint32_t armed(uint32_t offset)
{
	return vboard_faults_window_read(&faults, offset);
}

static void work(void)
{
	int calls = 0;

	while (vboard_faults_work(&faults))
		assert_in_range(++calls, 0, 100000);
}

/* What a driver does with a board after power on or a reset. */
static void drive(void)
{
	test_host_drive(put, GLOSS_REG_INTERRUPT_MASK_DONE);
	tail = 0;
}

static int setup_armed(const struct vboard_faults_armed *with)
{
	const struct vboard_faults_door door = {
		.host = {
			.data = &host,
			.read = test_host_read,
			.write = test_host_write,
			.level = test_host_level,
			.event = test_host_event,
		},
		.messages = test_host_messages,
		.power_on = test_host_power_on,
	};

	host = (struct test_host){ .messages = true };
	if (!vboard_faults_init(&faults, &gloss_board_model_t64, &door, board_memory,
				sizeof(board_memory), with))
		return -1;
	drive();
	return 0;
}

static int setup(void **state)
{
	const struct vboard_faults_armed nothing = { 0 };

	(void)state;
	return setup_armed(&nothing);
}

static int teardown(void **state)
{
	(void)state;
	vboard_faults_fini(&faults);
	return 0;
}

/* Gives the board @jobs empty jobs more, without letting it work. */
static void submit(unsigned int jobs)
{
	while (jobs--) {
		test_host_job(&host, tail % (1u << TEST_RING_LOG2), 100u + tail);
		tail++;
	}
	put(GLOSS_REG_TAIL, tail);
}

static void run(unsigned int jobs)
{
	submit(jobs);
	work();
}

static uint16_t head(void)
{
	return (uint16_t)get(GLOSS_REG_HEAD);
}

static void reset_by_driver(void)
{
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	work();
	assert_int_equal(get(GLOSS_REG_CONTROL), 0);
	drive();
}

static void a_board_without_faults_is_the_board(void **state)
{
	(void)state;
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
	assert_int_equal(armed(VBOARD_FAULT_IDENTITY), 0x544c4146);
	run(3);
	assert_int_equal(head(), 3);
	assert_int_equal(test_host_completed(&host, 2), 102);
	assert_int_equal(host.events, 3);
	assert_int_equal(armed(VBOARD_FAULT_JOBS), 3);
	assert_int_equal(vboard_faults_due(&faults), UINT64_MAX);
}

static uint32_t jobs_after_write(uint64_t address)
{
	const uint8_t record[4 * GLOSS_COMPLETION_WORDS] = { 0 };

	assert_int_equal(faults.host.write(faults.host.data, TEST_HOST_BASE + address, record,
					   sizeof(record)),
			 GLOSS_DMA_DONE);
	return armed(VBOARD_FAULT_JOBS);
}

static void only_a_completion_record_ends_a_job(void **state)
{
	(void)state;
	assert_int_equal(jobs_after_write(TEST_COMPLETION - 16), 0);
	assert_int_equal(jobs_after_write(TEST_COMPLETION + 8), 0);
	assert_int_equal(jobs_after_write(TEST_COMPLETION + (16 << TEST_RING_LOG2)), 0);
	assert_int_equal(jobs_after_write(TEST_COMPLETION + (16 << TEST_RING_LOG2) - 16), 1);
	put(GLOSS_REG_RING_LOG2, GLOSS_REG_RING_LOG2_LOG2);
	assert_int_equal(jobs_after_write(TEST_COMPLETION + (16 << GLOSS_RING_MAX_LOG2)), 1);
	assert_int_equal(jobs_after_write(TEST_COMPLETION + (16 << GLOSS_RING_MAX_LOG2) - 16), 2);
}

static void a_delayed_write_waits_for_its_time(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_DELAY_WRITES, 30000);
	submit(1);
	time_passes(29999);
	work();
	assert_int_equal(test_host_completed(&host, 0), 0);
	assert_true(vboard_faults_due(&faults) != UINT64_MAX);
	time_passes(1);
	work();
	assert_int_equal(test_host_completed(&host, 0), 100);
	assert_int_equal(vboard_faults_due(&faults), UINT64_MAX);
}

static void a_read_pushes_delayed_writes_in_their_order(void **state)
{
	uint32_t i;

	(void)state;
	arm(VBOARD_FAULT_DELAY_WRITES, 10000000);
	for (i = 0; i < 3 * VBOARD_FAULTS_WRITES / 2; i++)
		put(GLOSS_REG_RING_HIGH, i);
	put(GLOSS_REG_RING_LOW, 0x1000);
	assert_int_equal(get(GLOSS_REG_RING_HIGH), i - 1);
	assert_int_equal(get(GLOSS_REG_RING_LOW), 0x1000);
	put(GLOSS_REG_RING_LOW, 0x2000);
	arm(VBOARD_FAULT_DELAY_WRITES, 0);
	put(GLOSS_REG_RING_LOW, 0x3000);
	assert_int_equal(get(GLOSS_REG_RING_LOW), 0x3000);
}

static void interrupts_are_lost_as_many_as_asked(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_LOSE_INTERRUPTS, 2);
	run(1);
	assert_int_equal(host.events, 0);
	assert_true(get(GLOSS_REG_INTERRUPT_STATUS) & GLOSS_REG_INTERRUPT_STATUS_DONE);
	assert_int_equal(armed(VBOARD_FAULT_LOSE_INTERRUPTS), 1);
	arm(VBOARD_FAULT_DOORBELL, 1);
	assert_int_equal(host.events, 0);
	run(1);
	assert_int_equal(host.events, 1);
	arm(VBOARD_FAULT_DOORBELL, 1);
	assert_int_equal(host.events, 2);
}

static void a_lost_level_comes_back_with_the_next_event(void **state)
{
	(void)state;
	host.messages = false;
	arm(VBOARD_FAULT_LOSE_INTERRUPTS, 1);
	run(1);
	assert_false(host.level);
	assert_int_equal(armed(VBOARD_FAULT_LOSE_INTERRUPTS), 0);
	put(GLOSS_REG_INTERRUPT_STATUS, GLOSS_REG_INTERRUPT_STATUS_DONE);
	run(1);
	assert_true(host.level);
	put(GLOSS_REG_INTERRUPT_STATUS, GLOSS_REG_INTERRUPT_STATUS_DONE);
	assert_false(host.level);
	assert_int_equal(host.events, 0);
}

static void the_nth_job_hangs_while_it_runs(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_HANG, 3);
	run(4);
	assert_int_equal(head(), 2);
	assert_int_equal(get(GLOSS_REG_STATUS), GLOSS_REG_STATUS_RUNNING);
	assert_int_equal(test_host_completed(&host, 2), 0);
	assert_int_equal(host.events, 2);
	assert_int_equal(vboard_faults_due(&faults), UINT64_MAX);
	assert_false(vboard_faults_work(&faults));
}

static void a_reset_of_the_driver_ends_a_hang(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_HANG, 1);
	run(2);
	assert_int_equal(head(), 0);
	reset_by_driver();
	run(4);
	assert_int_equal(head(), 4);
	arm(VBOARD_FAULT_HANG, 2);
	reset_by_driver();
	run(4);
	assert_int_equal(head(), 4);
	assert_int_equal(armed(VBOARD_FAULT_JOBS), 8);
}

static void a_hang_that_is_taken_back_goes_on(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_HANG, 1);
	run(2);
	arm(VBOARD_FAULT_HANG, 0);
	work();
	assert_int_equal(head(), 2);
	assert_int_equal(host.events, 2);
}

static void the_nth_access_is_refused(void **state)
{
	uint64_t address;

	(void)state;
	run(1);
	arm(VBOARD_FAULT_REFUSE_DMA, 1);
	run(1);
	assert_int_equal(head(), 1);
	assert_true(get(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_DMA_ERROR);
	address = get(GLOSS_REG_DMA_ERROR_LOW) | (uint64_t)get(GLOSS_REG_DMA_ERROR_HIGH) << 32;
	assert_int_equal(address, TEST_HOST_BASE + TEST_RING + 4 * GLOSS_JOB_DESCRIPTOR_WORDS);
	assert_int_equal(armed(VBOARD_FAULT_REFUSE_DMA), 0);
	reset_by_driver();
	host.accesses = 0;
	run(1);
	arm(VBOARD_FAULT_REFUSE_DMA, host.accesses + 1);
	run(1);
	assert_int_equal(head(), 2);
	run(1);
	assert_int_equal(head(), 2);
}

static void assert_dead(void)
{
	assert_int_equal(get(GLOSS_REG_IDENTITY), 0xffffffff);
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
	assert_int_equal(get(GLOSS_REG_CONTROL), 0xffffffff);
	assert_false(vboard_faults_work(&faults));
	assert_int_equal(vboard_faults_due(&faults), UINT64_MAX);
	assert_int_equal(armed(VBOARD_FAULT_IDENTITY), VBOARD_FAULT_IDENTITY_VALUE);
}

static void the_board_dies_when_the_nth_job_begins(void **state)
{
	(void)state;
	host.messages = false;
	put(GLOSS_REG_INTERRUPT_MASK, 0xffffffff);
	arm(VBOARD_FAULT_DIE, 2);
	run(1);
	assert_int_equal(head(), 1);
	assert_true(host.level);
	host.accesses = 0;
	run(1);
	assert_int_equal(host.accesses, 0);
	assert_false(host.level);
	assert_int_equal(test_host_completed(&host, 1), 0);
	assert_dead();
	host.messages = true;
	arm(VBOARD_FAULT_DOORBELL, 1);
	assert_int_equal(host.events, 0);
}

static void the_board_dies_now_and_comes_back_as_new(void **state)
{
	(void)state;
	run(1);
	arm(VBOARD_FAULT_DELAY_WRITES, 1000);
	put(GLOSS_REG_CONTROL, 0);
	arm(VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW);
	assert_dead();
	assert_int_equal(host.power_ons, 0);
	arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(host.power_ons, 1);
	arm(VBOARD_FAULT_DELAY_WRITES, 0);
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
	assert_int_equal(get(GLOSS_REG_CONTROL), 0);
	assert_int_equal(get(GLOSS_REG_RING_LOG2), 0);
	assert_int_equal(armed(VBOARD_FAULT_JOBS), 0);
	drive();
	run(2);
	assert_int_equal(head(), 2);
}

static void a_slow_job_takes_its_time_and_the_board_answers(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_SLOW, 30000);
	run(1);
	assert_int_equal(get(GLOSS_REG_STATUS), GLOSS_REG_STATUS_RUNNING);
	assert_int_equal(host.events, 0);
	assert_true(vboard_faults_due(&faults) != UINT64_MAX);
	time_passes(29999);
	work();
	assert_int_equal(head(), 0);
	time_passes(1);
	work();
	assert_int_equal(head(), 1);
	assert_int_equal(host.events, 1);
	run(1);
	assert_int_equal(head(), 1);
	reset_by_driver();
	assert_int_equal(vboard_faults_due(&faults), UINT64_MAX);
	arm(VBOARD_FAULT_SLOW, 0);
	run(1);
	assert_int_equal(head(), 1);
}

static void a_reset_of_the_host_leaves_what_is_armed(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_HANG, 1);
	arm(VBOARD_FAULT_LOSE_INTERRUPTS, 7);
	host.messages = false;
	vboard_faults_reset(&faults);
	assert_int_equal(get(GLOSS_REG_RING_LOG2), 0);
	assert_int_equal(armed(VBOARD_FAULT_LOSE_INTERRUPTS), 7);
	drive();
	run(1);
	assert_int_equal(head(), 0);
	vboard_faults_reset(&faults);
	drive();
	run(1);
	assert_int_equal(head(), 1);
}

static void faults_of_the_command_line_are_armed_from_the_start(void **state)
{
	const struct vboard_faults_armed some = {
		.delay_writes = 1,
		.lose_interrupts = 2,
		.hang = 3,
		.refuse_dma = 4,
		.die = 5,
		.slow = 6,
	};
	const struct vboard_faults_armed dead = { .die = VBOARD_FAULT_DIE_NOW };

	assert_int_equal(setup_armed(&some), 0);
	assert_int_equal(armed(VBOARD_FAULT_DELAY_WRITES), 1);
	assert_int_equal(armed(VBOARD_FAULT_LOSE_INTERRUPTS), 2);
	assert_int_equal(armed(VBOARD_FAULT_HANG), 3);
	assert_int_equal(armed(VBOARD_FAULT_REFUSE_DMA), 4);
	assert_int_equal(armed(VBOARD_FAULT_DIE), 5);
	assert_int_equal(armed(VBOARD_FAULT_SLOW), 6);
	teardown(state);
	assert_int_equal(setup_armed(&dead), 0);
	assert_dead();
	arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(get(GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
	teardown(state);
}

static void the_window_keeps_what_is_read_only(void **state)
{
	uint32_t offset;

	(void)state;
	for (offset = 0; offset < 0x1000; offset += 4)
		if (offset != VBOARD_FAULT_DOORBELL)
			arm(offset, 0);
	arm(VBOARD_FAULT_IDENTITY, 5);
	arm(VBOARD_FAULT_JOBS, 5);
	arm(VBOARD_FAULT_BUS_MASTER_ERRORS, 5);
	arm(0x28, 5);
	arm(0xffc, 5);
	assert_int_equal(armed(VBOARD_FAULT_IDENTITY), VBOARD_FAULT_IDENTITY_VALUE);
	for (offset = 4; offset < 0x1000; offset += 4)
		assert_int_equal(armed(offset), 0);
	run(1);
	assert_int_equal(head(), 1);
}

#define faults_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		faults_test(a_board_without_faults_is_the_board),
		faults_test(only_a_completion_record_ends_a_job),
		faults_test(a_delayed_write_waits_for_its_time),
		faults_test(a_read_pushes_delayed_writes_in_their_order),
		faults_test(interrupts_are_lost_as_many_as_asked),
		faults_test(a_lost_level_comes_back_with_the_next_event),
		faults_test(the_nth_job_hangs_while_it_runs),
		faults_test(a_reset_of_the_driver_ends_a_hang),
		faults_test(a_hang_that_is_taken_back_goes_on),
		faults_test(the_nth_access_is_refused),
		faults_test(the_board_dies_when_the_nth_job_begins),
		faults_test(the_board_dies_now_and_comes_back_as_new),
		faults_test(a_slow_job_takes_its_time_and_the_board_answers),
		faults_test(a_reset_of_the_host_leaves_what_is_armed),
		cmocka_unit_test(faults_of_the_command_line_are_armed_from_the_start),
		faults_test(the_window_keeps_what_is_read_only),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
