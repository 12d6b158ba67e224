// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <errno.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "vboard/pci/message.h"

struct header {
	int32_t command;
	uint32_t zero;
	uint64_t bytes; /* of the body */
};

_Static_assert(sizeof(struct header) == 16, "as QEMU has it");
_Static_assert(sizeof(struct vboard_message_sysmem) == 192, "as QEMU has it");
_Static_assert(sizeof(struct vboard_message_config) == 12, "as QEMU has it");
_Static_assert(sizeof(struct vboard_message_bar) == 24, "as QEMU has it");

/* What may come, and with what. */
static const struct {
	bool known;
	uint32_t bytes;
	unsigned int fds_min, fds_max;
} commands[] = {
	[VBOARD_SYNC_SYSMEM] = { true, sizeof(struct vboard_message_sysmem), 0,
				 VBOARD_MESSAGE_FDS },
	[VBOARD_CONFIG_WRITE] = { true, sizeof(struct vboard_message_config), 0, 0 },
	[VBOARD_CONFIG_READ] = { true, sizeof(struct vboard_message_config), 0, 0 },
	[VBOARD_BAR_WRITE] = { true, sizeof(struct vboard_message_bar), 0, 0 },
	[VBOARD_BAR_READ] = { true, sizeof(struct vboard_message_bar), 0, 0 },
	[VBOARD_SET_IRQFD] = { true, 0, 2, 2 },
	[VBOARD_DEVICE_RESET] = { true, 0, 0, 0 },
};

static void message_take_fds(struct msghdr *from, struct vboard_message *message)
{
	struct cmsghdr *control;

	for (control = CMSG_FIRSTHDR(from); control; control = CMSG_NXTHDR(from, control)) {
		if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != SCM_RIGHTS)
			continue;
		message->fds = (unsigned int)((control->cmsg_len - CMSG_LEN(0)) / sizeof(int));
		memcpy(message->fd, CMSG_DATA(control), message->fds * sizeof(int));
	}
}

static int message_receive_header(int socket, struct vboard_message *message, struct header *header)
{
	union {
		struct cmsghdr align;
		char bytes[CMSG_SPACE(VBOARD_MESSAGE_FDS * sizeof(int))];
	} control;
	struct iovec part = { .iov_base = header, .iov_len = sizeof(*header) };
	struct msghdr to = {
		.msg_iov = &part,
		.msg_iovlen = 1,
		.msg_control = &control,
		.msg_controllen = sizeof(control),
	};
	ssize_t length = recvmsg(socket, &to, MSG_WAITALL | MSG_CMSG_CLOEXEC);

	if (length < 0)
		return errno == ECONNRESET ? 0 : -errno;
	message_take_fds(&to, message);
	if (!length && !message->fds)
		return 0;
	return length == sizeof(*header) && !(to.msg_flags & MSG_CTRUNC) ? 1 : -EPROTO;
}

static int message_receive_body(int socket, struct vboard_message *message,
				const struct header *header)
{
	unsigned int command = (unsigned int)header->command;

	if (command >= sizeof(commands) / sizeof(commands[0]) || !commands[command].known ||
	    header->bytes != commands[command].bytes || message->fds < commands[command].fds_min ||
	    message->fds > commands[command].fds_max)
		return -EPROTO;
	message->command = command;
	if (header->bytes &&
	    recv(socket, &message->sysmem, header->bytes, MSG_WAITALL) != (ssize_t)header->bytes)
		return -EPROTO;
	return 1;
}

int vboard_message_receive(int socket, struct vboard_message *message)
{
	struct header header = { 0 };
	int ret;

	message->fds = 0;
	ret = message_receive_header(socket, message, &header);
	if (ret > 0)
		ret = message_receive_body(socket, message, &header);
	if (ret <= 0)
		vboard_message_release(message);
	return ret;
}

void vboard_message_release(struct vboard_message *message)
{
	while (message->fds)
		close(message->fd[--message->fds]);
}

int vboard_message_reply(int socket, uint64_t value)
{
	const struct {
		struct header header;
		uint64_t value;
	} reply = { { VBOARD_RET, 0, sizeof(value) }, value };
	ssize_t length = send(socket, &reply, sizeof(reply), MSG_NOSIGNAL);

	if (length < 0)
		return -errno;
	return length == sizeof(reply) ? 0 : -EPROTO;
}
