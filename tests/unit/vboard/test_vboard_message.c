/* SPDX-License-Identifier: MIT */
/* The protocol's messages: QEMU's, and those that no QEMU sends. */
#define _GNU_SOURCE
#include <dirent.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "accel_test.h"
#include "vboard/pci/message.h"

static int near, far; /* ends of the socket; the far one is QEMU's */

static int setup(void **state)
{
	int pair[2];

	(void)state;
	if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair))
		return -1;
	near = pair[0];
	far = pair[1];
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	close(far);
	return close(near);
}

/* Sends @bytes bytes and copies of one file descriptor. */
static void send_bytes(const void *data, size_t bytes, unsigned int fds)
{
	union {
		struct cmsghdr header;
		char bytes[CMSG_SPACE(32 * sizeof(int))];
	} control = { 0 };
	struct iovec part = { .iov_base = (void *)data, .iov_len = bytes };
	struct msghdr message = { .msg_iov = &part, .msg_iovlen = 1 };
	unsigned int i;

	if (fds) {
		message.msg_control = &control;
		message.msg_controllen = CMSG_SPACE(fds * sizeof(int));
		control.header.cmsg_level = SOL_SOCKET;
		control.header.cmsg_type = SCM_RIGHTS;
		control.header.cmsg_len = CMSG_LEN(fds * sizeof(int));
		for (i = 0; i < fds; i++)
			memcpy(CMSG_DATA(&control.header) + i * sizeof(int), &far, sizeof(int));
	}
	assert_int_equal(sendmsg(far, &message, MSG_NOSIGNAL), (ssize_t)bytes);
}

struct raw {
	int32_t command;
	uint32_t zero;
	uint64_t bytes;
	uint8_t body[256];
};

static void send_raw(int32_t command, uint64_t bytes, unsigned int fds)
{
	struct raw raw = { .command = command, .bytes = bytes };
	size_t i;

	for (i = 0; i < sizeof(raw.body); i++)
		raw.body[i] = (uint8_t)i;
	send_bytes(&raw, 16 + (bytes < sizeof(raw.body) ? bytes : sizeof(raw.body)), fds);
}

static unsigned int open_fds(void)
{
	DIR *directory = opendir("/proc/self/fd");
	unsigned int count = 0;

	while (readdir(directory))
		count++;
	closedir(directory);
	return count;
}

static void each_command_of_qemu_is_understood(void **state)
{
	static const struct {
		enum vboard_command command;
		uint64_t bytes;
		unsigned int fds;
	} all[] = {
		{ VBOARD_SYNC_SYSMEM, 192, 0 }, { VBOARD_SYNC_SYSMEM, 192, 8 },
		{ VBOARD_CONFIG_WRITE, 12, 0 }, { VBOARD_CONFIG_READ, 12, 0 },
		{ VBOARD_BAR_WRITE, 24, 0 },    { VBOARD_BAR_READ, 24, 0 },
		{ VBOARD_SET_IRQFD, 0, 2 },     { VBOARD_DEVICE_RESET, 0, 0 },
	};
	struct vboard_message message;
	unsigned int before = open_fds();
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(all) / sizeof(all[0]); i++)
		send_raw((int32_t)all[i].command, all[i].bytes, all[i].fds);
	for (i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
		assert_int_equal(vboard_message_receive(near, &message), 1);
		assert_int_equal(message.command, all[i].command);
		assert_int_equal(message.fds, all[i].fds);
		if (all[i].bytes)
			assert_int_equal(message.config.address, 0x03020100);
		vboard_message_release(&message);
	}
	assert_int_equal(open_fds(), before);
}

static void fields_are_where_qemu_has_them(void **state)
{
	static const struct {
		int32_t command;
		uint32_t zero;
		uint64_t bytes, address, value;
		uint32_t size;
		uint8_t memory, pad[3];
	} write = { 4, 0, 24, 0x1234567890, 0xfedcba9876543210, 8, 1, { 0 } };
	struct vboard_message message;

	(void)state;
	send_bytes(&write, sizeof(write), 0);
	assert_int_equal(vboard_message_receive(near, &message), 1);
	assert_int_equal(message.command, VBOARD_BAR_WRITE);
	assert_int_equal(message.bar.address, 0x1234567890);
	assert_int_equal(message.bar.value, 0xfedcba9876543210);
	assert_int_equal(message.bar.bytes, 8);
	assert_int_equal(message.bar.memory, 1);
}

static void a_message_of_wrong_length_or_kind_ends_it(void **state)
{
	static const struct {
		int32_t command;
		uint64_t bytes;
		unsigned int fds;
	} wrong[] = {
		{ VBOARD_SYNC_SYSMEM, 191, 0 },
		{ VBOARD_SYNC_SYSMEM, 193, 1 },
		{ VBOARD_SYNC_SYSMEM, 192, 9 },
		{ VBOARD_SYNC_SYSMEM, 192, 32 },
		{ VBOARD_RET, 8, 0 },
		{ VBOARD_RET, 0, 0 },
		{ VBOARD_CONFIG_READ, 0, 0 },
		{ VBOARD_CONFIG_WRITE, 16, 0 },
		{ VBOARD_BAR_READ, 16, 0 },
		{ VBOARD_BAR_WRITE, UINT64_MAX, 0 },
		{ VBOARD_BAR_WRITE, 24, 1 },
		{ VBOARD_BAR_WRITE, 1ull << 32 | 24, 0 },
		{ VBOARD_SET_IRQFD, 0, 0 },
		{ VBOARD_SET_IRQFD, 0, 3 },
		{ VBOARD_DEVICE_RESET, 4, 0 },
		{ 8, 0, 0 },
		{ -1, 0, 2 },
		{ INT32_MIN, 24, 0 },
		{ INT32_MAX, 0, 0 },
	};
	struct vboard_message message;
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		unsigned int before = open_fds();

		send_raw(wrong[i].command, wrong[i].bytes, wrong[i].fds);
		assert_int_equal(vboard_message_receive(near, &message), -EPROTO);
		assert_int_equal(message.fds, 0);
		assert_int_equal(open_fds(), before);
		teardown(NULL);
		setup(NULL);
	}
}

static void a_message_cut_off_anywhere_ends_it(void **state)
{
	const struct raw raw = { .command = VBOARD_BAR_WRITE, .bytes = 24 };
	struct vboard_message message;
	size_t length;

	(void)state;
	for (length = 0; length < 16 + 24; length++) {
		unsigned int before = open_fds();

		if (length)
			send_bytes(&raw, length, 0);
		shutdown(far, SHUT_WR);
		assert_int_equal(vboard_message_receive(near, &message), length ? -EPROTO : 0);
		assert_int_equal(open_fds(), before);
		teardown(NULL);
		setup(NULL);
	}
}

static void random_bytes_are_a_message_or_the_end(void **state)
{
	uint64_t seed = test_seed();
	unsigned int before = open_fds();
	struct vboard_message message;
	int round, ret;

	(void)state;
	for (round = 0; round < 2000; round++) {
		struct raw raw = { 0 };
		size_t i;

		for (i = 0; i < sizeof(raw.body); i++)
			raw.body[i] = (uint8_t)test_random(&seed);
		raw.command = (int32_t)test_below(&seed, 10) - 1;
		raw.bytes = (const uint64_t[]){ 0, 12, 24, 192,
						test_random(&seed) }[test_below(&seed, 5)];
		send_bytes(&raw, 1 + test_below(&seed, sizeof(raw)), test_below(&seed, 11));
		shutdown(far, SHUT_WR);
		do {
			ret = vboard_message_receive(near, &message);
			if (ret > 0) {
				assert_in_range(message.command, 0, VBOARD_DEVICE_RESET);
				assert_in_range(message.fds, 0, VBOARD_MESSAGE_FDS);
				vboard_message_release(&message);
			}
		} while (ret > 0);
		assert_true(ret == 0 || ret == -EPROTO);
		teardown(NULL);
		setup(NULL);
		assert_int_equal(open_fds(), before);
	}
}

static void a_reply_is_a_ret_of_eight_bytes(void **state)
{
	static const uint32_t expected[] = { VBOARD_RET, 0, 8, 0, 0x89abcdef, 0x01234567 };
	uint32_t words[8];

	(void)state;
	assert_int_equal(vboard_message_reply(near, 0x0123456789abcdef), 0);
	assert_int_equal(recv(far, words, sizeof(words), 0), sizeof(expected));
	assert_memory_equal(words, expected, sizeof(expected));
	shutdown(far, SHUT_RD);
	assert_int_equal(vboard_message_reply(near, 0), -EPIPE);
}

#define message_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		message_test(each_command_of_qemu_is_understood),
		message_test(fields_are_where_qemu_has_them),
		message_test(a_message_of_wrong_length_or_kind_ends_it),
		message_test(a_message_cut_off_anywhere_ends_it),
		message_test(random_bytes_are_a_message_or_the_end),
		message_test(a_reply_is_a_ret_of_eight_bytes),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
