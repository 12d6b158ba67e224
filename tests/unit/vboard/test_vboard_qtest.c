/* SPDX-License-Identifier: MIT */
/* Interrupts as commands to QEMU, which answers late, wrongly or not at all. */
#define _GNU_SOURCE
#include <pthread.h>

#include "vboard/pci/qtest.h"
#include "vboard_qtest.h"

static struct test_qtest qemu;
static struct vboard_qtest *qtest;

static int setup(void **state)
{
	(void)state;
	test_qtest_init(&qemu);
	assert_int_equal(vboard_qtest_new(qemu.address.sun_path, &qtest), 0);
	test_qtest_accept(&qemu);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	vboard_qtest_free(qtest);
	test_qtest_fini(&qemu);
	return 0;
}

static void a_message_is_a_write_and_is_not_waited_for(void **state)
{
	(void)state;
	vboard_qtest_message(qtest, 0xfee01000, 0x41);
	vboard_qtest_message(qtest, 0x123456789abcdef0, 0xffff);
	test_qtest_expect(&qemu, "writel 0xfee01000 0x41");
	test_qtest_expect(&qemu, "writel 0x123456789abcdef0 0xffff");
}

static void slots_have_the_pins_of_q35(void **state)
{
	unsigned int slot;

	(void)state;
	for (slot = 0; slot <= VBOARD_SLOT_MAX; slot++) {
		vboard_qtest_level(qtest, slot, true, false);
		vboard_qtest_level(qtest, slot, false, false);
		test_qtest_expect_pin(&qemu, 20 + slot % 4, 1);
		test_qtest_expect_pin(&qemu, 20 + slot % 4, 0);
	}
}

static void boards_on_one_pin_hold_it_together(void **state)
{
	(void)state;
	vboard_qtest_level(qtest, 5, true, false);
	test_qtest_expect_pin(&qemu, 21, 1);
	vboard_qtest_level(qtest, 9, true, false);
	vboard_qtest_level(qtest, 5, false, false);
	assert_false(test_qtest_has_more(&qemu, 20));
	vboard_qtest_level(qtest, 9, false, false);
	test_qtest_expect_pin(&qemu, 21, 0);
}

static void *lower(void *data)
{
	vboard_qtest_level(qtest, 4, false, true);
	*(bool *)data = true;
	return NULL;
}

static void a_level_is_waited_for_until_it_is_answered_itself(void **state)
{
	pthread_t thread;
	bool done = false;

	(void)state;
	vboard_qtest_level(qtest, 4, true, false);
	vboard_qtest_message(qtest, 0x1000, 1);
	pthread_create(&thread, NULL, lower, &done);
	test_qtest_expect_pin(&qemu, 20, 1);
	test_qtest_expect(&qemu, "writel 0x1000 0x1");
	test_qtest_expect_pin(&qemu, 20, 0);
	test_qtest_answer(&qemu, "OK\nOK\nO");
	usleep(20000);
	assert_false(__atomic_load_n(&done, __ATOMIC_RELAXED));
	/* Another board's interrupt is not held up meanwhile. */
	vboard_qtest_message(qtest, 0x2000, 2);
	test_qtest_expect(&qemu, "writel 0x2000 0x2");
	test_qtest_answer(&qemu, "K\n");
	pthread_join(thread, NULL);
}

/* What the library writes to standard error while @act runs. */
static void complaints(void (*act)(void), char *text, size_t size)
{
	FILE *file = tmpfile();
	int saved = dup(STDERR_FILENO);

	dup2(fileno(file), STDERR_FILENO);
	act();
	dup2(saved, STDERR_FILENO);
	close(saved);
	assert_int_equal(fseek(file, 0, SEEK_SET), 0);
	text[fread(text, 1, size - 1, file)] = '\0';
	fclose(file);
}

static void lose_qemu(void)
{
	bool done = false;
	pthread_t thread;

	vboard_qtest_level(qtest, 4, true, false);
	test_qtest_expect_pin(&qemu, 20, 1);
	pthread_create(&thread, NULL, lower, &done);
	test_qtest_expect_pin(&qemu, 20, 0);
	shutdown(qemu.socket, SHUT_RDWR);
	pthread_join(thread, NULL);
	vboard_qtest_level(qtest, 4, true, true);
	vboard_qtest_message(qtest, 0x1000, 1);
}

static void nobody_waits_for_a_qemu_that_has_ended_or_complains(void **state)
{
	char text[512];

	(void)state;
	complaints(lose_qemu, text, sizeof(text));
	assert_string_equal(text, "");
}

static void be_refused_twice(void)
{
	vboard_qtest_message(qtest, 0x1000, 1);
	vboard_qtest_message(qtest, 0x1000, 1);
	test_qtest_answer(&qemu, "FAIL Unknown device\nFAIL Unknown device\n");
	shutdown(qemu.socket, SHUT_WR);
	vboard_qtest_level(qtest, 4, true, true);
}

static void what_qemu_refuses_is_said_once(void **state)
{
	char text[512], expected[512];

	(void)state;
	complaints(be_refused_twice, text, sizeof(text));
	snprintf(expected, sizeof(expected), "vboard-pci: %s: FAIL Unknown device\n",
		 qemu.address.sun_path);
	assert_string_equal(text, expected);
}

static void send_to_nobody(void)
{
	struct vboard_qtest *alone;

	assert_int_equal(vboard_qtest_new("/nonexistent/socket", &alone), 0);
	vboard_qtest_message(alone, 0x1000, 1);
	vboard_qtest_level(alone, 4, true, true);
	vboard_qtest_free(alone);
}

static void an_interrupt_without_qemu_is_said_to_be_lost(void **state)
{
	char text[512];

	(void)state;
	complaints(send_to_nobody, text, sizeof(text));
	assert_string_equal(text, "vboard-pci: /nonexistent/socket: an interrupt is lost: "
				  "QEMU does not listen here\n");
}

#define qtest_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		qtest_test(a_message_is_a_write_and_is_not_waited_for),
		qtest_test(slots_have_the_pins_of_q35),
		qtest_test(boards_on_one_pin_hold_it_together),
		qtest_test(a_level_is_waited_for_until_it_is_answered_itself),
		qtest_test(nobody_waits_for_a_qemu_that_has_ended_or_complains),
		qtest_test(what_qemu_refuses_is_said_once),
		cmocka_unit_test(an_interrupt_without_qemu_is_said_to_be_lost),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
