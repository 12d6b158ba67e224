// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "vboard/serve.h"

static int signals = -1, ended = -1;

/* Before any other thread: both signals end serve_run(). */
static bool serve_signals(void)
{
	sigset_t end;

	sigemptyset(&end);
	sigaddset(&end, SIGINT);
	sigaddset(&end, SIGTERM);
	pthread_sigmask(SIG_BLOCK, &end, NULL);
	signals = signalfd(-1, &end, SFD_CLOEXEC);
	ended = eventfd(0, EFD_CLOEXEC);
	if (signals >= 0 && ended >= 0)
		return true;
	vboard_error("signals", strerror(errno));
	return false;
}

/* ---- a board ---- */

/* Is it a connected Unix socket? */
static bool serve_socket(const char *name, int fd)
{
	int domain = 0;
	socklen_t length = sizeof(domain);
	char why[64];

	if (!getsockopt(fd, SOL_SOCKET, SO_DOMAIN, &domain, &length) && domain == AF_UNIX)
		return true;
	snprintf(why, sizeof(why), "fd %d is not an open Unix socket", fd);
	vboard_error(name, why);
	return false;
}

static void *serve_memory(uint64_t size)
{
	void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE,
			    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);

	return memory == MAP_FAILED ? NULL : memory;
}

/* False: out of memory. */
static bool serve_make(struct vboard_served *served, const struct vboard_serve_ops *ops,
		       const struct vboard_options_board *options)
{
	served->memory_size = options->memory;
	served->memory = serve_memory(options->memory);
	if (!served->memory)
		return false;
	if (ops->init(served, options))
		return true;
	munmap(served->memory, served->memory_size);
	return false;
}

/* NULL: it has said why. */
static void *serve_open(const struct vboard_serve_ops *ops,
			const struct vboard_options_board *options)
{
	struct vboard_served *served;
	struct accel_plugin loaded;
	struct accel_transport_error error = { "" };

	if (!serve_socket(options->text, options->socket))
		return NULL;
	if (vboard_load(&loaded, &ops->bus, options->engine, options->tile, options->lanes,
			&error)) {
		vboard_error(options->text, error.text);
		return NULL;
	}
	served = calloc(1, ops->size);
	if (served) {
		served->loaded = loaded;
		if (serve_make(served, ops, options))
			return served;
	}
	free(served);
	vboard_unload(&loaded);
	vboard_error(options->text, "out of memory");
	return NULL;
}

static void serve_close(struct vboard_served *served, const struct vboard_serve_ops *ops)
{
	int socket = served->loop->socket;

	ops->fini(served);
	munmap(served->memory, served->memory_size);
	vboard_unload(&served->loaded);
	close(socket);
	free(served);
}

/* ---- all of them ---- */

/* Until all boards have ended, or a signal comes. */
static void serve_wait(unsigned int boards)
{
	struct pollfd polls[] = {
		{ .fd = signals, .events = POLLIN },
		{ .fd = ended, .events = POLLIN },
	};
	eventfd_t more;

	while (boards) {
		if (poll(polls, 2, -1) < 0 || polls[0].revents)
			return;
		if (!eventfd_read(ended, &more))
			boards -= more < boards ? (unsigned int)more : boards;
	}
}

static struct vboard_loop *serve_loop(const void *board)
{
	return ((const struct vboard_served *)board)->loop;
}

static enum vboard_exit serve_run(void *const *boards, const struct vboard_options *options)
{
	enum vboard_exit ret = VBOARD_OK;
	unsigned int started;
	int err = 0;

	for (started = 0; started < options->boards && !err; started += !err) {
		serve_loop(boards[started])->ended = ended;
		err = vboard_loop_start(serve_loop(boards[started]));
	}
	if (!err)
		serve_wait(options->boards);
	for (unsigned int i = 0; i < started; i++) {
		struct vboard_loop *loop = serve_loop(boards[i]);

		vboard_loop_stop(loop);
		if (!loop->error || loop->error == -ECANCELED)
			continue;
		vboard_error(options->board[i].text, strerror(-loop->error));
		ret = VBOARD_FAILED;
	}
	if (err)
		vboard_error("thread", strerror(-err));
	return err ? VBOARD_FAILED : ret;
}

static enum vboard_exit serve_begin(const struct vboard_serve_ops *ops, void *const *boards,
				    const struct vboard_options *options)
{
	enum vboard_exit ret = ops->begin ? ops->begin(boards, options) : VBOARD_OK;

	if (ret != VBOARD_OK)
		return ret;
	ret = serve_run(boards, options);
	if (ops->end)
		ops->end(boards);
	return ret;
}

static enum vboard_exit serve_boards(const struct vboard_serve_ops *ops,
				     const struct vboard_options *options)
{
	void *boards[VBOARD_BOARDS] = { NULL };
	enum vboard_exit ret = VBOARD_FAILED;
	unsigned int opened;

	for (opened = 0; opened < options->boards; opened++) {
		boards[opened] = serve_open(ops, &options->board[opened]);
		if (!boards[opened])
			break;
	}
	if (opened == options->boards)
		ret = serve_begin(ops, boards, options);
	for (unsigned int i = 0; i < opened; i++) {
		if (options->verbose && opened == options->boards)
			ops->report(boards[i]);
		serve_close(boards[i], ops);
	}
	return ret;
}

enum vboard_exit vboard_serve(const struct vboard_serve_ops *ops,
			      const struct vboard_program *program, int argc, char **argv)
{
	struct vboard_options options;
	enum vboard_exit ret;

	ret = vboard_options_parse(&options, program, argc, argv);
	if (ret != VBOARD_OK || options.done)
		return ret;
	if (!serve_signals())
		return VBOARD_FAILED;
	return serve_boards(ops, &options);
}
