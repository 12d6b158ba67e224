// SPDX-License-Identifier: MIT
#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "load.h"
#include "engine.h"
#include "option.h"
#include "options.h"
#include "vboard.h"

#ifndef GLOSS_RELEASE
#define GLOSS_RELEASE "0.1"
#endif

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

void vboard_error(const char *what, const char *why)
{
	fprintf(stderr, "vboard-pci: %s: %s\n", what, why);
}

static enum vboard_exit bad_usage(const char *what, const char *why)
{
	fprintf(stderr, "vboard-pci: %s: %s; see vboard-pci --help\n", what, why);
	return VBOARD_USAGE;
}

/* ---- a board ---- */

static enum vboard_exit parse_board_options(struct vboard_options_board *board, const char *text)
{
	uint64_t fd = UINT64_MAX, slot = VBOARD_NO_SLOT, tile = 64, lanes = 8;
	uint64_t delay_writes = 0, lose_interrupts = 0, hang = 0, refuse_dma = 0, die = 0, slow = 0;
	const struct accel_option list[] = {
		{ "fd", 0, INT32_MAX, 1, &fd },
		{ "slot", 0, VBOARD_SLOT_MAX, 1, &slot },
		{ "memory", GLOSS_PAGE_BYTES, ENGINE_MEMORY_MAX, GLOSS_PAGE_BYTES, &board->memory },
		{ "tile", 32, 64, 0, &tile },
		{ "lanes", 1, 8, 0, &lanes },
		{ "delay-writes", 0, UINT32_MAX, 1, &delay_writes },
		{ "lose-interrupts", 0, UINT32_MAX, 1, &lose_interrupts },
		{ "hang", 0, UINT32_MAX, 1, &hang },
		{ "refuse-dma", 0, UINT32_MAX, 1, &refuse_dma },
		{ "die", 0, UINT32_MAX, 1, &die },
		{ "slow", 0, UINT32_MAX, 1, &slow },
		{ NULL, 0, 0, 0, NULL },
	};
	struct accel_transport_error error = { "" };

	board->memory = ENGINE_MEMORY_DEFAULT;
	if (accel_option_parse(text, list, &error))
		return bad_usage(board->text, error.text);
	if (fd == UINT64_MAX)
		return bad_usage(board->text, "fd is missing, the board's socket");
	board->socket = (int)fd;
	board->slot = (uint32_t)slot;
	board->tile = (uint32_t)tile;
	board->lanes = (uint32_t)lanes;
	board->armed = (struct vboard_faults_armed){
		.delay_writes = (uint32_t)delay_writes,
		.lose_interrupts = (uint32_t)lose_interrupts,
		.hang = (uint32_t)hang,
		.refuse_dma = (uint32_t)refuse_dma,
		.die = (uint32_t)die,
		.slow = (uint32_t)slow,
	};
	return VBOARD_OK;
}

static enum vboard_exit parse_board(struct vboard_options *options, const char *text)
{
	struct vboard_options_board *board = &options->board[options->boards];
	size_t length = strcspn(text, ",");

	if (options->boards == VBOARD_BOARDS)
		return bad_usage(text, "one board too many");
	if (!length || length >= sizeof(board->engine))
		return bad_usage(text, "the engine is model or rtl");
	options->boards++;
	board->text = text;
	memcpy(board->engine, text, length);
	return parse_board_options(board, text[length] ? text + length + 1 : "");
}

/* ---- the line ---- */

static enum vboard_exit parse_option(struct vboard_options *options, int option,
				     const char *argument)
{
	switch (option) {
	case 'b':
		return parse_board(options, argument);
	case 'q':
		options->qtest = argument;
		return VBOARD_OK;
	case 'v':
		options->verbose = true;
		return VBOARD_OK;
	case 'h':
		fputs(usage, stdout);
		options->done = true;
		return VBOARD_OK;
	case 'V':
		puts("vboard-pci " GLOSS_RELEASE);
		options->done = true;
		return VBOARD_OK;
	default:
		fputs("see vboard-pci --help\n", stderr);	/* getopt said what is wrong */
		return VBOARD_USAGE;
	}
}

enum vboard_exit vboard_options_parse(struct vboard_options *options, int argc, char **argv)
{
	static const struct option table[] = {
		{ "board", required_argument, NULL, 'b' },
		{ "qtest", required_argument, NULL, 'q' },
		{ "verbose", no_argument, NULL, 'v' },
		{ "help", no_argument, NULL, 'h' },
		{ "version", no_argument, NULL, 'V' },
		{ NULL, 0, NULL, 0 }
	};
	enum vboard_exit ret = VBOARD_OK;
	int option;

	*options = (struct vboard_options){ 0 };
	while (ret == VBOARD_OK && !options->done &&
	       (option = getopt_long(argc, argv, "", table, NULL)) != -1)
		ret = parse_option(options, option, optarg);
	if (ret != VBOARD_OK || options->done)
		return ret;
	if (optind < argc)
		return bad_usage(argv[optind], "all is said with options");
	if (!options->boards)
		return bad_usage("no board", "give --board ENGINE,fd=N");
	return VBOARD_OK;
}
