/* SPDX-License-Identifier: MIT */
/*
 * Messages of QEMU's multi-process protocol, between its x-pci-proxy-dev and the
 * process that is the device: a header, a body whose layout follows from the
 * command, and file descriptors.
 */
#ifndef VBOARD_MESSAGE_H
#define VBOARD_MESSAGE_H

#include <stdbool.h>
#include <stdint.h>

#define VBOARD_MESSAGE_FDS 8

enum vboard_command {
	VBOARD_SYNC_SYSMEM,  /* sysmem; one fd for each range; no reply */
	VBOARD_RET,          /* the reply to everything else */
	VBOARD_CONFIG_WRITE, /* config */
	VBOARD_CONFIG_READ,  /* config */
	VBOARD_BAR_WRITE,    /* bar */
	VBOARD_BAR_READ,     /* bar */
	VBOARD_SET_IRQFD,    /* two fds; no reply */
	VBOARD_DEVICE_RESET,
};

struct vboard_message_sysmem {
	uint64_t address[VBOARD_MESSAGE_FDS]; /* on the bus */
	uint64_t bytes[VBOARD_MESSAGE_FDS];
	uint64_t offset[VBOARD_MESSAGE_FDS]; /* in the file */
};

struct vboard_message_config {
	uint32_t address, value;
	int32_t bytes;
};

struct vboard_message_bar {
	uint64_t address; /* on the bus, not in the BAR */
	uint64_t value;
	uint32_t bytes;
	uint8_t memory; /* not I/O ports */
	uint8_t zero[3];
};

struct vboard_message {
	enum vboard_command command;
	union {
		struct vboard_message_sysmem sysmem;
		struct vboard_message_config config;
		struct vboard_message_bar bar;
	};
	int fd[VBOARD_MESSAGE_FDS]; /* open until vboard_message_release */
	unsigned int fds;
};

/*
 * Waits for a message. 1: there is one, to be released; 0: the other end has
 * closed; -EPROTO: not a message; else what the socket said.
 */
int vboard_message_receive(int socket, struct vboard_message *message);
void vboard_message_release(struct vboard_message *message);

/* Answers with @value; 0, or -errno. */
int vboard_message_reply(int socket, uint64_t value);

#endif
