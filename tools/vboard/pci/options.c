// SPDX-License-Identifier: MIT
/* What vboard-pci takes. */
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
	struct vboard_faults_armed *armed = &board->pci.armed;
	const struct vboard_option list[] = {
		{ "slot", VBOARD_SLOT_MAX, &board->pci.slot },
		{ "delay-writes", UINT32_MAX, &armed->delay_writes },
		{ "lose-interrupts", UINT32_MAX, &armed->lose_interrupts },
		{ "hang", UINT32_MAX, &armed->hang },
		{ "refuse-dma", UINT32_MAX, &armed->refuse_dma },
		{ "die", UINT32_MAX, &armed->die },
		{ "slow", UINT32_MAX, &armed->slow },
		{ NULL, 0, NULL },
	};

	board->pci.slot = VBOARD_NO_SLOT;
	return vboard_options_board(board, text, list);
}

const struct vboard_program vboard_program_pci = {
	.usage = usage,
	.qtest = true,
	.parse = parse_pci,
};
