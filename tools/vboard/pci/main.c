// SPDX-License-Identifier: MIT
/* Serves virtual boards to QEMU: a process that is the device of each x-pci-proxy-dev. */
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "vboard/load.h"
#include "vboard/options.h"
#include "vboard/serve.h"
#include "vboard/pci/vboard.h"

static const struct vboard_load_bus bus = {
	.plugin = "accel-board",
	.symbol = GLOSS_BOARD_SYMBOL,
	.abi = GLOSS_BOARD_ABI,
	.model_t32 = &gloss_board_model_t32,
	.model_t64 = &gloss_board_model_t64,
};

struct slot {
	struct vboard vboard;
	struct vboard_loaded loaded;
};

/* ---- a board ---- */

static int slot_open(struct slot *slot, const struct vboard_options_board *options)
{
	struct vboard *vboard = &slot->vboard;
	struct accel_transport_error error = { "" };
	struct vboard_faults_door door = vboard_door_pci_host(vboard);

	*vboard = (struct vboard){
		.name = options->text,
		.loop = {
			.ops = &vboard_door_pci_loop,
			.data = vboard,
			.socket = options->socket,
		},
		.slot = options->pci.slot,
		.board_memory_size = options->memory,
	};
	if (!vboard_serve_socket(vboard->name, options->socket))
		return -1;
	if (vboard_load(&slot->loaded, &bus, options->engine, options->tile, options->lanes,
			&error)) {
		vboard_error(vboard->name, error.text);
		return -1;
	}
	vboard->board_memory = vboard_serve_memory(vboard->board_memory_size);
	if (!vboard->board_memory)
		goto err_unload;
	vboard_config_reset(&vboard->config);
	if (!vboard_faults_init(&vboard->faults, slot->loaded.ops, &door, vboard->board_memory,
				vboard->board_memory_size, &options->pci.armed))
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
	close(vboard->loop.socket);
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

static enum vboard_exit run_boards(struct slot *slot, unsigned int boards)
{
	struct vboard_loop *loops[VBOARD_BOARDS];
	const char *names[VBOARD_BOARDS] = { NULL };

	for (unsigned int i = 0; i < boards; i++) {
		loops[i] = &slot[i].vboard.loop;
		names[i] = slot[i].vboard.name;
	}
	return vboard_serve_run(loops, names, boards);
}

static enum vboard_exit run_interrupts(const struct vboard_options *options, struct slot *slot)
{
	struct vboard_qtest *qtest = NULL;
	enum vboard_exit ret;
	int err;

	err = options->qtest ? vboard_qtest_new(options->qtest, &qtest) : 0;
	if (err) {
		vboard_error(options->qtest, strerror(-err));
		return VBOARD_FAILED;
	}
	for (unsigned int i = 0; i < options->boards; i++)
		slot[i].vboard.qtest = qtest;
	ret = run_boards(slot, options->boards);
	vboard_qtest_free(qtest);
	return ret;
}

static enum vboard_exit run(const struct vboard_options *options)
{
	static struct slot slot[VBOARD_BOARDS];
	enum vboard_exit ret = VBOARD_OK;
	unsigned int opened;

	for (opened = 0; opened < options->boards; opened++)
		if (slot_open(&slot[opened], &options->board[opened]))
			break;
	if (opened == options->boards)
		ret = run_interrupts(options, slot);
	else
		ret = VBOARD_FAILED;
	for (unsigned int i = 0; i < opened; i++) {
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

	ret = vboard_options_parse(&options, &vboard_program_pci, argc, argv);
	if (ret != VBOARD_OK || options.done)
		return ret;
	if (!vboard_serve_init())
		return VBOARD_FAILED;
	return run(&options);
}
