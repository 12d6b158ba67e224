// SPDX-License-Identifier: MIT
/* Serves virtual boards to QEMU: a process that is the device of each x-pci-proxy-dev. */
#define _GNU_SOURCE
#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "load.h"
#include "options.h"
#include "vboard.h"

struct slot {
	struct vboard vboard;
	struct vboard_loaded loaded;
};

/* ---- a board ---- */

static int check_socket(const char *name, int fd)
{
	int domain = 0;
	socklen_t length = sizeof(domain);

	if (getsockopt(fd, SOL_SOCKET, SO_DOMAIN, &domain, &length) || domain != AF_UNIX) {
		fprintf(stderr, "vboard-pci: %s: fd %d is not an open Unix socket\n", name, fd);
		return -1;
	}
	return 0;
}

static int slot_open(struct slot *slot, const struct vboard_options_board *options)
{
	struct vboard *vboard = &slot->vboard;
	struct accel_transport_error error = { "" };
	struct vboard_faults_door door = vboard_door_pci_host(vboard);

	*vboard = (struct vboard){
		.name = options->text,
		.socket = options->socket,
		.slot = options->slot,
		.board_memory_size = options->memory,
	};
	if (check_socket(vboard->name, vboard->socket))
		return -1;
	if (vboard_load(&slot->loaded, options->engine, options->tile, options->lanes,
			       &error)) {
		vboard_error(vboard->name, error.text);
		return -1;
	}
	vboard->board_memory = mmap(NULL, vboard->board_memory_size, PROT_READ | PROT_WRITE,
				    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
	if (vboard->board_memory == MAP_FAILED)
		goto err_unload;
	vboard_config_reset(&vboard->config);
	if (!vboard_faults_init(&vboard->faults, slot->loaded.ops, &door, vboard->board_memory,
				vboard->board_memory_size, &options->armed))
		goto err_unmap;
	return 0;

err_unmap:
	munmap(vboard->board_memory, vboard->board_memory_size);
err_unload:
	vboard_unload(&slot->loaded);
	vboard_error(vboard->name, "out of memory");
	return -1;
}

static void slot_close(struct slot *slot)
{
	struct vboard *vboard = &slot->vboard;

	vboard_memory_clear(&vboard->memory);
	vboard_faults_fini(&vboard->faults);
	munmap(vboard->board_memory, vboard->board_memory_size);
	vboard_unload(&slot->loaded);
	close(vboard->socket);
}

static void slot_report(const struct slot *slot)
{
	const struct vboard *vboard = &slot->vboard;

	printf("%s: %u jobs, %llu register reads, %llu writes, %llu bytes of DMA, %llu interrupts\n",
	       vboard->name, vboard->faults.jobs, (unsigned long long)vboard->reads,
	       (unsigned long long)vboard->writes, (unsigned long long)vboard->dma_bytes,
	       (unsigned long long)vboard->interrupts);
}

/* ---- all of them ---- */

/* Until all boards have ended, or a signal comes. */
static void wait_for_end(int ended, int signals, unsigned int boards)
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
			boards -= (unsigned int)more;
	}
}

static enum vboard_exit run_boards(struct slot *slot, unsigned int boards, int ended, int signals)
{
	enum vboard_exit ret = VBOARD_OK;
	unsigned int started, i;
	int err = 0;

	for (started = 0; started < boards && !err; started += !err) {
		slot[started].vboard.ended = ended;
		err = vboard_loop_start(&slot[started].vboard);
	}
	if (!err)
		wait_for_end(ended, signals, boards);
	for (i = 0; i < started; i++) {
		vboard_loop_stop(&slot[i].vboard);
		if (slot[i].vboard.error)
			vboard_error(slot[i].vboard.name, strerror(-slot[i].vboard.error));
		if (slot[i].vboard.error)
			ret = VBOARD_FAILED;
	}
	if (err)
		vboard_error("thread", strerror(-err));
	return err ? VBOARD_FAILED : ret;
}

static enum vboard_exit run_interrupts(const struct vboard_options *options, struct slot *slot,
				       int ended, int signals)
{
	struct vboard_qtest *qtest = NULL;
	enum vboard_exit ret;
	unsigned int i;
	int err;

	err = options->qtest ? vboard_qtest_new(options->qtest, &qtest) : 0;
	if (err) {
		vboard_error(options->qtest, strerror(-err));
		return VBOARD_FAILED;
	}
	for (i = 0; i < options->boards; i++)
		slot[i].vboard.qtest = qtest;
	ret = run_boards(slot, options->boards, ended, signals);
	vboard_qtest_free(qtest);
	return ret;
}

static enum vboard_exit run(const struct vboard_options *options, int ended, int signals)
{
	static struct slot slot[VBOARD_BOARDS];
	enum vboard_exit ret = VBOARD_OK;
	unsigned int opened, i;

	for (opened = 0; opened < options->boards; opened++)
		if (slot_open(&slot[opened], &options->board[opened]))
			break;
	if (opened == options->boards)
		ret = run_interrupts(options, slot, ended, signals);
	else
		ret = VBOARD_FAILED;
	for (i = 0; i < opened; i++) {
		if (options->verbose && opened == options->boards)
			slot_report(&slot[i]);
		slot_close(&slot[i]);
	}
	return ret;
}

int main(int argc, char **argv)
{
	struct vboard_options options;
	enum vboard_exit ret;
	sigset_t end;
	int ended, signals;

	ret = vboard_options_parse(&options, argc, argv);
	if (ret != VBOARD_OK || options.done)
		return ret;
	sigemptyset(&end);
	sigaddset(&end, SIGINT);
	sigaddset(&end, SIGTERM);
	pthread_sigmask(SIG_BLOCK, &end, NULL);
	signals = signalfd(-1, &end, SFD_CLOEXEC);
	ended = eventfd(0, EFD_CLOEXEC);
	if (signals < 0 || ended < 0) {
		vboard_error("signals", strerror(errno));
		return VBOARD_FAILED;
	}
	return run(&options, ended, signals);
}
