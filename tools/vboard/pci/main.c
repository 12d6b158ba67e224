// SPDX-License-Identifier: MIT
/* Serves virtual boards to QEMU: a process that is the device of each x-pci-proxy-dev. */
#include <stdio.h>
#include <string.h>

#include "vboard/serve.h"
#include "vboard/pci/vboard.h"

struct slot {
	struct vboard_served served; /* first, see serve.h */
	struct vboard vboard;
};

/* ---- a board ---- */

static bool slot_init(void *board, const struct vboard_options_board *options)
{
	struct slot *slot = board;
	struct vboard *vboard = &slot->vboard;
	struct vboard_faults_door door = vboard_door_pci_host(vboard);

	*vboard = (struct vboard){
		.name = options->text,
		.loop = {
			.ops = &vboard_door_pci_loop,
			.data = vboard,
			.socket = options->socket,
		},
		.slot = options->pci.slot,
	};
	slot->served.loop = &vboard->loop;
	vboard_config_reset(&vboard->config);
	return vboard_faults_init(&vboard->faults, slot->served.loaded.ops, &door,
				  slot->served.memory, slot->served.memory_size,
				  &options->pci.armed);
}

static void slot_fini(void *board)
{
	struct vboard *vboard = &((struct slot *)board)->vboard;

	vboard_memory_clear(&vboard->memory);
	vboard_faults_fini(&vboard->faults);
}

static void slot_report(const void *board)
{
	const struct vboard *vboard = &((const struct slot *)board)->vboard;

	printf("%s: %u jobs, %llu register reads, %llu writes, %llu bytes of DMA, %llu interrupts\n",
	       vboard->name, vboard->faults.jobs, (unsigned long long)vboard->reads,
	       (unsigned long long)vboard->writes, (unsigned long long)vboard->dma_bytes,
	       (unsigned long long)vboard->interrupts);
}

/* ---- the way of interrupts, which all of them share ---- */

static enum vboard_exit slots_begin(void *const *boards, const struct vboard_options *options)
{
	struct vboard_qtest *qtest = NULL;
	int err;

	err = options->qtest ? vboard_qtest_new(options->qtest, &qtest) : 0;
	if (err) {
		vboard_error(options->qtest, strerror(-err));
		return VBOARD_FAILED;
	}
	for (unsigned int i = 0; i < options->boards; i++)
		((struct slot *)boards[i])->vboard.qtest = qtest;
	return VBOARD_OK;
}

static void slots_end(void *const *boards)
{
	vboard_qtest_free(((struct slot *)boards[0])->vboard.qtest);
}

static const struct vboard_serve_ops slot_ops = {
	.bus = {
		.plugin = {
			.name = "accel-board",
			.symbol = GLOSS_BOARD_SYMBOL,
			.abi = GLOSS_BOARD_ABI,
			.what = "board",
			.who = "program",
		},
		.model_t32 = &gloss_board_model_t32,
		.model_t64 = &gloss_board_model_t64,
	},
	.size = sizeof(struct slot),
	.init = slot_init,
	.fini = slot_fini,
	.report = slot_report,
	.begin = slots_begin,
	.end = slots_end,
};

int main(int argc, char **argv)
{
	return vboard_serve(&slot_ops, &vboard_program_pci, argc, argv);
}
