// SPDX-License-Identifier: MIT
/* Serves virtual boards to QEMU: a process that is the device of each usb-redir. */
#include <stdio.h>
#include <sys/mman.h>
#include <unistd.h>

#include "vboard/load.h"
#include "vboard/options.h"
#include "vboard/serve.h"
#include "vboard/usb/vboard.h"

static const struct vboard_load_bus bus = {
	.plugin = "accel-usb",
	.symbol = GLOSS_USB_BOARD_SYMBOL,
	.abi = GLOSS_USB_BOARD_ABI,
	.model_t32 = &gloss_usb_board_model_t32,
	.model_t64 = &gloss_usb_board_model_t64,
};

struct socket {
	struct vboard_usb usb;
	struct vboard_loaded loaded;
	void *memory;
	uint64_t memory_size;
};

/* ---- a board ---- */

static int socket_make(struct socket *socket, const struct vboard_options_board *options)
{
	struct vboard_usb *usb = &socket->usb;

	socket->memory_size = options->memory;
	socket->memory = vboard_serve_memory(options->memory);
	if (!socket->memory)
		return -1;
	vboard_usb_faults_init(&usb->faults, &options->usb.armed);
	usb->bridge.ops = socket->loaded.ops;
	usb->bridge.board = usb->bridge.ops->create(socket->memory, socket->memory_size);
	if (!usb->bridge.board)
		goto err_unmap;
	if (!vboard_door_usb_init(usb))
		goto err_destroy;
	return 0;

err_destroy:
	usb->bridge.ops->destroy(usb->bridge.board);
err_unmap:
	munmap(socket->memory, socket->memory_size);
	return -1;
}

static int socket_open(struct socket *socket, const struct vboard_options_board *options)
{
	struct accel_transport_error error = { "" };

	socket->usb = (struct vboard_usb){
		.name = options->text,
		.serial = options->usb.serial,
		.super = options->usb.super,
		.loop = {
			.ops = &vboard_door_usb_loop,
			.data = &socket->usb,
			.socket = options->socket,
		},
	};
	if (!vboard_serve_socket(options->text, options->socket))
		return -1;
	if (vboard_load(&socket->loaded, &bus, options->engine, options->tile, options->lanes,
			&error)) {
		vboard_error(options->text, error.text);
		return -1;
	}
	if (!socket_make(socket, options))
		return 0;
	vboard_unload(&socket->loaded);
	vboard_error(options->text, "out of memory");
	return -1;
}

static void socket_close(struct socket *socket)
{
	struct vboard_usb *usb = &socket->usb;

	vboard_door_usb_fini(usb);
	usb->bridge.ops->destroy(usb->bridge.board);
	munmap(socket->memory, socket->memory_size);
	vboard_unload(&socket->loaded);
	close(usb->loop.socket);
}

static void socket_report(const struct socket *socket)
{
	const struct vboard_usb *usb = &socket->usb;

	printf("%s: %u jobs, %llu register requests, %llu bytes out, %llu in, %llu events\n",
	       usb->name, usb->faults.jobs, (unsigned long long)usb->requests,
	       (unsigned long long)usb->out_bytes, (unsigned long long)usb->in_bytes,
	       (unsigned long long)usb->events);
}

/* ---- all of them ---- */

static enum vboard_exit run_boards(struct socket *socket, unsigned int boards)
{
	struct vboard_loop *loops[VBOARD_BOARDS];
	const char *names[VBOARD_BOARDS] = { NULL };

	for (unsigned int i = 0; i < boards; i++) {
		loops[i] = &socket[i].usb.loop;
		names[i] = socket[i].usb.name;
	}
	return vboard_serve_run(loops, names, boards);
}

static enum vboard_exit run(const struct vboard_options *options)
{
	static struct socket socket[VBOARD_BOARDS];
	enum vboard_exit ret = VBOARD_FAILED;
	unsigned int opened;

	for (opened = 0; opened < options->boards; opened++)
		if (socket_open(&socket[opened], &options->board[opened]))
			break;
	if (opened == options->boards)
		ret = run_boards(socket, opened);
	for (unsigned int i = 0; i < opened; i++) {
		if (options->verbose && opened == options->boards)
			socket_report(&socket[i]);
		socket_close(&socket[i]);
	}
	return ret;
}

int main(int argc, char **argv)
{
	struct vboard_options options;
	enum vboard_exit ret;

	ret = vboard_options_parse(&options, &vboard_program_usb, argc, argv);
	if (ret != VBOARD_OK || options.done)
		return ret;
	if (!vboard_serve_init())
		return VBOARD_FAILED;
	return run(&options);
}
