// SPDX-License-Identifier: MIT
/* What vboard-pci takes. */
#include "transport/option.h"
#include "vboard/options.h"
#include "vboard/pci/vboard.h"

static const char usage[] =
	"usage: vboard-pci [--qtest PATH] [--verbose] --board ENGINE,fd=N[,OPTION=N]... ...\n"
	"Serves virtual Gloss boards to QEMU, each to one x-pci-proxy-dev. ENGINE is model (the\n"
	"C model) or rtl (the Verilated board). OPTIONs of a board:\n"
	"  fd=N               its socket, whose other end the proxy has; must be given\n"
	"  slot=N             the proxy's slot on q35's bus pcie.0, 0 to 24, for INTx\n"
	"  memory=BYTES       board memory, a multiple of 4096; 256 MiB if not given\n"
	"  tile=N             pixels of a tile's side, 32 or 64; 64 if not given\n"
	"  lanes=N            pixels a clock of rtl, 1, 2, 4 or 8; 8 if not given\n"
	"Faults, see vboard-pci(1):\n"
	"  delay-writes=US    register writes take effect so late, or before the next read\n"
	"  lose-interrupts=N  the first N interrupts are lost\n"
	"  hang=N             the N-th job does not end until the driver resets the board\n"
	"  refuse-dma=N       the N-th DMA access is refused\n"
	"  die=N              the board goes away when the N-th job begins\n"
	"  slow=US            each job takes so much longer\n"
	"Further:\n"
	"  --qtest PATH       QEMU's qtest socket, through which interrupts go\n"
	"  --verbose          print what each board did, at the end\n"
	"  --help, --version  print, and leave\n"
	"Ends when QEMU has closed all sockets. Exit status: 0 done, 1 something failed, 2 the\n"
	"command line was wrong.\n";

static enum vboard_exit parse_pci(struct vboard_options_board *board, const char *text)
{
	uint64_t slot = VBOARD_NO_SLOT, delay_writes = 0, lose_interrupts = 0, hang = 0;
	uint64_t refuse_dma = 0, die = 0, slow = 0;
	const struct accel_option list[] = {
		{ "slot", 0, VBOARD_SLOT_MAX, 1, &slot },
		{ "delay-writes", 0, UINT32_MAX, 1, &delay_writes },
		{ "lose-interrupts", 0, UINT32_MAX, 1, &lose_interrupts },
		{ "hang", 0, UINT32_MAX, 1, &hang },
		{ "refuse-dma", 0, UINT32_MAX, 1, &refuse_dma },
		{ "die", 0, UINT32_MAX, 1, &die },
		{ "slow", 0, UINT32_MAX, 1, &slow },
		{ NULL, 0, 0, 0, NULL },
	};
	enum vboard_exit ret = vboard_options_board(board, text, list);

	board->pci.slot = (uint32_t)slot;
	board->pci.armed = (struct vboard_faults_armed){
		.delay_writes = (uint32_t)delay_writes,
		.lose_interrupts = (uint32_t)lose_interrupts,
		.hang = (uint32_t)hang,
		.refuse_dma = (uint32_t)refuse_dma,
		.die = (uint32_t)die,
		.slow = (uint32_t)slow,
	};
	return ret;
}

const struct vboard_program vboard_program_pci = {
	.usage = usage,
	.qtest = true,
	.parse = parse_pci,
};
