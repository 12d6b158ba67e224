// SPDX-License-Identifier: MIT
/* Serves virtual boards to QEMU: a process that is the device of each usb-redir. */
#include <stdio.h>

#include "vboard/serve.h"
#include "vboard/usb/vboard.h"

struct socket {
	struct vboard_served served; /* first, see serve.h */
	struct vboard_usb usb;
};

static bool socket_init(void *board, const struct vboard_options_board *options)
{
	struct socket *socket = board;
	struct vboard_usb *usb = &socket->usb;

	*usb = (struct vboard_usb){
		.name = options->text,
		.serial = options->usb.serial,
		.super = options->usb.super,
		.loop = {
			.ops = &vboard_door_usb_loop,
			.data = usb,
			.socket = options->socket,
		},
	};
	socket->served.loop = &usb->loop;
	vboard_usb_faults_init(&usb->faults, &options->usb.armed);
	usb->bridge.ops = socket->served.loaded.ops;
	usb->bridge.board = usb->bridge.ops->create(socket->served.memory,
						    socket->served.memory_size);
	if (!usb->bridge.board)
		return false;
	if (vboard_door_usb_init(usb))
		return true;
	usb->bridge.ops->destroy(usb->bridge.board);
	return false;
}

static void socket_fini(void *board)
{
	struct vboard_usb *usb = &((struct socket *)board)->usb;

	vboard_door_usb_fini(usb);
	usb->bridge.ops->destroy(usb->bridge.board);
}

static void socket_report(const void *board)
{
	const struct vboard_usb *usb = &((const struct socket *)board)->usb;

	printf("%s: %u jobs, %llu register requests, %llu bytes out, %llu in, %llu events\n",
	       usb->name, usb->faults.jobs, (unsigned long long)usb->requests,
	       (unsigned long long)usb->out_bytes, (unsigned long long)usb->in_bytes,
	       (unsigned long long)usb->events);
}

static const struct vboard_serve_ops socket_ops = {
	.bus = {
		.plugin = {
			.name = "accel-usb",
			.symbol = GLOSS_USB_BOARD_SYMBOL,
			.abi = GLOSS_USB_BOARD_ABI,
			.what = "board",
			.who = "program",
		},
		.model_t32 = &gloss_usb_board_model_t32,
		.model_t64 = &gloss_usb_board_model_t64,
	},
	.size = sizeof(struct socket),
	.init = socket_init,
	.fini = socket_fini,
	.report = socket_report,
};

int main(int argc, char **argv)
{
	return vboard_serve(&socket_ops, &vboard_program_usb, argc, argv);
}
