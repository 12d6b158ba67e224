/* SPDX-License-Identifier: MIT */
/* A board in its slot, with its thread; the test is QEMU: the proxy and the qtest socket. */
#ifndef VBOARD_DOOR_TEST_H
#define VBOARD_DOOR_TEST_H

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

static inline void expect_msi(void)
{
	test_qtest_expect(&qtest, "writel 0xfee00000 0x4041");
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

static inline void ask(const struct request *request)
{
	size_t size = 16 + request->bytes;

	assert_int_equal(send(proxy, request, size, MSG_NOSIGNAL), size);
}

static inline bool answer_comes(int milliseconds)
{
	struct pollfd polls = { .fd = proxy, .events = POLLIN };

	return poll(&polls, 1, milliseconds) > 0;
}

static inline uint64_t take_answer(void)
{
	uint64_t words[3];

	assert_true(answer_comes(test_patience_ms()));
	assert_int_equal(recv(proxy, words, sizeof(words), MSG_WAITALL), sizeof(words));
	assert_int_equal(words[0], VBOARD_RET);
	assert_int_equal(words[1], 8);
	return words[2];
}

static inline struct request bar_request(enum vboard_command command, uint64_t at, uint64_t value,
					 uint32_t bytes)
{
	return (struct request){
		.command = (int32_t)command,
		.bytes = sizeof(struct vboard_message_bar),
		.bar = { .address = at, .value = value, .bytes = bytes, .memory = 1 },
	};
}

static inline uint64_t bar_read(uint64_t at, uint32_t bytes)
{
	struct request request = bar_request(VBOARD_BAR_READ, at, 0, bytes);

	ask(&request);
	return take_answer();
}

static inline void bar_write(uint64_t at, uint64_t value, uint32_t bytes)
{
	struct request request = bar_request(VBOARD_BAR_WRITE, at, value, bytes);

	ask(&request);
	take_answer();
}

static inline uint64_t config_access(enum vboard_command command, uint32_t at, uint32_t value,
				     int bytes)
{
	const struct request request = {
		.command = (int32_t)command,
		.bytes = sizeof(struct vboard_message_config),
		.config = { .address = at, .value = value, .bytes = bytes },
	};

	ask(&request);
	return take_answer();
}

static inline void config_write(uint32_t at, uint32_t value, int bytes)
{
	config_access(VBOARD_CONFIG_WRITE, at, value, bytes);
}

static inline uint64_t config_read(uint32_t at, int bytes)
{
	return config_access(VBOARD_CONFIG_READ, at, 0, bytes);
}

static inline void put(uint32_t offset, uint32_t value)
{
	bar_write(REGISTERS + offset, value, 4);
}

static inline uint32_t get(uint32_t offset)
{
	return (uint32_t)bar_read(REGISTERS + offset, 4);
}

/* The whole file is at TEST_HOST_BASE. */
static inline void share_memory(void)
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

static inline void enable(bool messages)
{
	config_write(PCI_BASE_ADDRESS_0, (uint32_t)REGISTERS, 4);
	config_write(PCI_BASE_ADDRESS_1, (uint32_t)WINDOW, 4);
	config_write(PCI_COMMAND, PCI_COMMAND_MEMORY | PCI_COMMAND_MASTER, 2);
	config_write(MSI + PCI_MSI_ADDRESS_LO, MSI_ADDRESS, 4);
	config_write(MSI + PCI_MSI_DATA_64, MSI_DATA, 2);
	config_write(MSI + PCI_MSI_FLAGS, messages ? PCI_MSI_FLAGS_ENABLE : 0, 2);
}

static inline void drive(void)
{
	test_host_drive(put, 7);
	tail = 0;
}

static inline void submit(void)
{
	test_host_job(host, tail % (1u << TEST_RING_LOG2), 100u + tail);
	put(GLOSS_REG_TAIL, ++tail);
}

/* ---- power ---- */

/* The board may be there before QEMU is. */
static inline void open_qtest(void)
{
	test_qtest_init(&qtest);
	assert_int_equal(vboard_qtest_new(qtest.address.sun_path, &vboard.qtest), 0);
	usleep(1000);
	test_qtest_accept(&qtest);
}

static inline void open_memory(void)
{
	ram = memfd_create("ram", MFD_CLOEXEC);
	assert_int_equal(ftruncate(ram, sizeof(*host)), 0);
	host = mmap(NULL, sizeof(*host), PROT_READ | PROT_WRITE, MAP_SHARED, ram, 0);
	assert_true(host != MAP_FAILED);
}

static inline int setup(void **state)
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
static inline int end(void)
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

static inline int teardown(void **state)
{
	(void)state;
	return end();
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
