/* SPDX-License-Identifier: MIT */
/* A board in its slot, with its thread; the test is QEMU: the proxy and the qtest socket. */
#define _GNU_SOURCE
#include <linux/pci_regs.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include "vboard/pci/message.h"
#include "vboard/pci/vboard.h"
#include "vboard_qtest.h"
#include "vboard_test.h"

#define REGISTERS 0xfeb00000ull
#define WINDOW 0xfeb10000ull
#define MSI 0x40
#define MSI_ADDRESS 0xfee00000
#define MSI_DATA 0x4041
#define SLOT 6
#define PIN 22

static struct vboard vboard;
static uint8_t board_memory[TEST_BOARD_BYTES];
static int proxy; /* our end of the board's socket */
static struct test_qtest qtest;
static int ram;                /* the file that is the host's memory */
static struct test_host *host; /* which starts with the memory */
static uint16_t tail;

/* ---- QEMU: its qtest socket ---- */

static void expect_msi(void)
{
	test_qtest_expect(&qtest, "writel 0xfee00000 0x4041");
	test_qtest_answer(&qtest, "OK\n");
}

static void expect_pin(int level, bool answer)
{
	test_qtest_expect_pin(&qtest, PIN, level);
	if (answer)
		test_qtest_answer(&qtest, "OK\n");
}

/* ---- QEMU: the proxy ---- */

struct request {
	int32_t command;
	uint32_t zero;
	uint64_t bytes;
	union {
		struct vboard_message_config config;
		struct vboard_message_bar bar;
		struct vboard_message_sysmem sysmem;
	};
};

static void ask(const struct request *request)
{
	size_t size = 16 + request->bytes;

	assert_int_equal(send(proxy, request, size, MSG_NOSIGNAL), size);
}

static bool answer_comes(int milliseconds)
{
	struct pollfd polls = { .fd = proxy, .events = POLLIN };

	return poll(&polls, 1, milliseconds) > 0;
}

static uint64_t take_answer(void)
{
	uint64_t words[3];

	assert_true(answer_comes(test_patience_ms()));
	assert_int_equal(recv(proxy, words, sizeof(words), MSG_WAITALL), sizeof(words));
	assert_int_equal(words[0], VBOARD_RET);
	assert_int_equal(words[1], 8);
	return words[2];
}

static struct request bar_request(enum vboard_command command, uint64_t at, uint64_t value,
				  uint32_t bytes)
{
	return (struct request){
		.command = (int32_t)command,
		.bytes = sizeof(struct vboard_message_bar),
		.bar = { .address = at, .value = value, .bytes = bytes, .memory = 1 },
	};
}

static uint64_t bar_read(uint64_t at, uint32_t bytes)
{
	struct request request = bar_request(VBOARD_BAR_READ, at, 0, bytes);

	ask(&request);
	return take_answer();
}

static void bar_write(uint64_t at, uint64_t value, uint32_t bytes)
{
	struct request request = bar_request(VBOARD_BAR_WRITE, at, value, bytes);

	ask(&request);
	take_answer();
}

static uint64_t config_access(enum vboard_command command, uint32_t at, uint32_t value, int bytes)
{
	const struct request request = {
		.command = (int32_t)command,
		.bytes = sizeof(struct vboard_message_config),
		.config = { .address = at, .value = value, .bytes = bytes },
	};

	ask(&request);
	return take_answer();
}

static void config_write(uint32_t at, uint32_t value, int bytes)
{
	config_access(VBOARD_CONFIG_WRITE, at, value, bytes);
}

static uint64_t config_read(uint32_t at, int bytes)
{
	return config_access(VBOARD_CONFIG_READ, at, 0, bytes);
}

static void put(uint32_t offset, uint32_t value)
{
	bar_write(REGISTERS + offset, value, 4);
}

static uint32_t get(uint32_t offset)
{
	return (uint32_t)bar_read(REGISTERS + offset, 4);
}

/* The whole file is at TEST_HOST_BASE. */
static void share_memory(void)
{
	union {
		struct cmsghdr header;
		char bytes[CMSG_SPACE(sizeof(int))];
	} control = { .header = { CMSG_LEN(sizeof(int)), SOL_SOCKET, SCM_RIGHTS } };
	struct request request = {
		.command = VBOARD_SYNC_SYSMEM,
		.bytes = sizeof(struct vboard_message_sysmem),
		.sysmem = { .address = { TEST_HOST_BASE }, .bytes = { TEST_HOST_BYTES } },
	};
	struct iovec part = { .iov_base = &request, .iov_len = 16 + request.bytes };
	struct msghdr message = {
		.msg_iov = &part,
		.msg_iovlen = 1,
		.msg_control = &control,
		.msg_controllen = sizeof(control),
	};

	memcpy(CMSG_DATA(&control.header), &ram, sizeof(int));
	assert_int_equal(sendmsg(proxy, &message, MSG_NOSIGNAL), (ssize_t)part.iov_len);
}

/* ---- the host's firmware, kernel and driver ---- */

static void enable(bool messages)
{
	config_write(PCI_BASE_ADDRESS_0, (uint32_t)REGISTERS, 4);
	config_write(PCI_BASE_ADDRESS_1, (uint32_t)WINDOW, 4);
	config_write(PCI_COMMAND, PCI_COMMAND_MEMORY | PCI_COMMAND_MASTER, 2);
	config_write(MSI + PCI_MSI_ADDRESS_LO, MSI_ADDRESS, 4);
	config_write(MSI + PCI_MSI_DATA_64, MSI_DATA, 2);
	config_write(MSI + PCI_MSI_FLAGS, messages ? PCI_MSI_FLAGS_ENABLE : 0, 2);
}

static void drive(void)
{
	const uint64_t ring = TEST_HOST_BASE + TEST_RING;
	const uint64_t completion = TEST_HOST_BASE + TEST_COMPLETION;

	put(GLOSS_REG_RING_LOW, (uint32_t)ring);
	put(GLOSS_REG_RING_HIGH, (uint32_t)(ring >> 32));
	put(GLOSS_REG_RING_LOG2, TEST_RING_LOG2);
	put(GLOSS_REG_COMPLETION_LOW, (uint32_t)completion);
	put(GLOSS_REG_COMPLETION_HIGH, (uint32_t)(completion >> 32));
	put(GLOSS_REG_INTERRUPT_MASK, 7);
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
	tail = 0;
}

static void submit(void)
{
	test_host_job(host, tail % (1u << TEST_RING_LOG2), 100u + tail);
	put(GLOSS_REG_TAIL, ++tail);
}

/* ---- power ---- */

/* The board may be there before QEMU is. */
static void open_qtest(void)
{
	test_qtest_init(&qtest);
	assert_int_equal(vboard_qtest_new(qtest.address.sun_path, &vboard.qtest), 0);
	usleep(1000);
	test_qtest_accept(&qtest);
}

static void open_memory(void)
{
	ram = memfd_create("ram", MFD_CLOEXEC);
	assert_int_equal(ftruncate(ram, sizeof(*host)), 0);
	host = mmap(NULL, sizeof(*host), PROT_READ | PROT_WRITE, MAP_SHARED, ram, 0);
	assert_true(host != MAP_FAILED);
}

static int setup(void **state)
{
	struct vboard_faults_door door = vboard_door_pci_host(&vboard);
	const struct vboard_faults_armed nothing = { 0 };
	int pair[2];

	(void)state;
	assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair), 0);
	proxy = pair[1];
	vboard = (struct vboard){
		.name = "board",
		.loop = {
			.ops = &vboard_door_pci_loop,
			.data = &vboard,
			.socket = pair[0],
			.ended = eventfd(0, EFD_CLOEXEC),
		},
		.slot = SLOT,
	};
	open_qtest();
	open_memory();
	vboard_config_reset(&vboard.config);
	assert_true(vboard_faults_init(&vboard.faults, &gloss_board_model_t64, &door, board_memory,
				       sizeof(board_memory), &nothing));
	assert_int_equal(vboard_loop_start(&vboard.loop), 0);
	share_memory();
	return 0;
}

/* What the thread ended with. */
static int end(void)
{
	eventfd_t ended;

	close(proxy);
	assert_int_equal(eventfd_read(vboard.loop.ended, &ended), 0);
	vboard_loop_stop(&vboard.loop);
	vboard_qtest_free(vboard.qtest);
	vboard_faults_fini(&vboard.faults);
	vboard_memory_clear(&vboard.memory);
	close(vboard.loop.socket);
	close(vboard.loop.ended);
	test_qtest_fini(&qtest);
	close(ram);
	munmap(host, sizeof(*host));
	return vboard.loop.error;
}

static int teardown(void **state)
{
	(void)state;
	return end();
}

/* ---- tests ---- */

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

#define door_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		door_test(registers_answer_where_the_bar_is),
		door_test(accesses_of_other_widths_are_made_of_words),
		door_test(a_job_goes_by_dma_and_ends_in_a_message),
		door_test(a_host_that_keeps_asking_does_not_stop_the_board),
		door_test(the_pin_is_down_before_the_write_that_lowers_it_is_answered),
		door_test(the_pin_follows_the_command_register),
		door_test(a_reset_is_answered_though_qemu_takes_no_commands),
		door_test(without_bus_mastering_nothing_goes_out),
		door_test(the_doorbell_is_a_message_and_nothing_else),
		door_test(a_dead_board_is_gone_from_the_bus),
		door_test(a_delayed_doorbell_comes_in_time_or_before_a_request),
		door_test(memory_that_is_not_there_is_refused_alone),
		door_test(random_requests_are_all_answered),
		cmocka_unit_test(something_that_is_no_message_ends_the_board),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
