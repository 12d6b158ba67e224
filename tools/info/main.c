// SPDX-License-Identifier: MIT
/* Lists boards, and prints what one says of itself. */
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include "scene/device.h"
#include "info/info.h"

#ifndef GLOSS_RELEASE
#define GLOSS_RELEASE "0.1"
#endif

enum { EXIT_GOOD, EXIT_FAILED, EXIT_USAGE };

static const char usage[] =
	"usage: gloss-info [OPTION]...\n"
	"Prints what a Gloss board says of itself, or which boards there are.\n"
	"  -d, --device NAME  the board: drm:, drm:/dev/dri/renderD128, usb:, usb:1209:0001/SERIAL,\n"
	"                     model:, sim:, or auto (if not given), the first of them that opens\n"
	"  -l, --list         print a line for each board there is: its NAME, and what it is\n"
	"  -j, --json         print JSON\n"
	"  -h, --help         print this\n"
	"  -V, --version      print the version\n"
	"Exit status: 0 it was printed, 1 the board did not open or the output could not be written,\n"
	"2 the command line is wrong.\n";

struct options {
	const char *device; /* NULL: not given */
	bool list, json;
};

static void complain(const char *what, const char *where, const char *hint)
{
	fprintf(stderr, "gloss-info: %s: %s: %s\n", what, where, hint);
}

static void __attribute__((noreturn)) bad_usage(const char *what, const char *where)
{
	complain(what, where, "see gloss-info --help");
	exit(EXIT_USAGE);
}

/* False where a full disk kept it from being printed. */
static bool printed(void)
{
	if (!fflush(stdout) && !ferror(stdout))
		return true;
	complain("can not write", "standard output", "is its disk full?");
	return false;
}

static void __attribute__((noreturn)) answer(const char *text)
{
	fputs(text, stdout);
	exit(printed() ? EXIT_GOOD : EXIT_FAILED);
}

static void parse_option(struct options *options, int option, char **argv)
{
	switch (option) {
	case 'd':
		options->device = optarg;
		break;
	case 'l':
		options->list = true;
		break;
	case 'j':
		options->json = true;
		break;
	case 'h':
		answer(usage);
	case 'V':
		answer("gloss-info " GLOSS_RELEASE "\n");
	case ':':
		bad_usage("value missing", argv[optind - 1]);
	default:
		bad_usage("unknown option", argv[optind - 1]);
	}
}

static void parse_arguments(struct options *options, int argc, char **argv)
{
	static const struct option table[] = {
		{ "device", required_argument, NULL, 'd' }, { "list", no_argument, NULL, 'l' },
		{ "json", no_argument, NULL, 'j' },         { "help", no_argument, NULL, 'h' },
		{ "version", no_argument, NULL, 'V' },      { NULL, 0, NULL, 0 }
	};
	int option;

	opterr = 0;
	while ((option = getopt_long(argc, argv, ":d:ljhV", table, NULL)) != -1)
		parse_option(options, option, argv);
	if (optind < argc) {
		complain("one word too many", argv[optind], "a board is named by --device NAME");
		exit(EXIT_USAGE);
	}
	if (options->list && options->device)
		bad_usage("not together", "--list and --device");
}

static int print_list(bool json)
{
	struct info_list list = { NULL, 0, false };
	int status = EXIT_FAILED, err;

	err = accel_device_list(info_list_add, &list);
	if (err || list.no_memory) {
		complain("can not list boards", "all", err ? strerror(-err) : "out of memory");
	} else {
		(json ? info_json_list : info_print_list)(stdout, &list);
		status = EXIT_GOOD;
	}
	info_list_free(&list);
	return status;
}

static int print_board(const char *name, bool json)
{
	struct info_board board = { .device = name };
	struct accel_device *device;

	if (device_open("gloss-info", name, &device))
		return EXIT_FAILED;
	accel_device_info(device, &board.info, sizeof(board.info));
	board.counts = !accel_device_clocks(device, &board.clocks, sizeof(board.clocks));
	accel_device_free(device);
	(json ? info_json_board : info_print_board)(stdout, &board);
	return EXIT_GOOD;
}

int main(int argc, char **argv)
{
	struct options options = { NULL, false, false };
	int status;

	parse_arguments(&options, argc, argv);
	if (options.list)
		status = print_list(options.json);
	else
		status = print_board(options.device ? options.device : "auto", options.json);
	return printed() ? status : EXIT_FAILED;
}
