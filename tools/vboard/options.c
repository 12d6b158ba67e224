// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "transport/engine.h"
#include "transport/option.h"
#include "vboard/options.h"

#ifndef GLOSS_RELEASE
#define GLOSS_RELEASE "0.1"
#endif

void vboard_error(const char *what, const char *why)
{
	fprintf(stderr, "%s: %s: %s\n", program_invocation_short_name, what, why);
}

enum vboard_exit vboard_usage_error(const char *what, const char *why)
{
	fprintf(stderr, "%s: %s: %s; see %s --help\n", program_invocation_short_name, what, why,
		program_invocation_short_name);
	return VBOARD_USAGE;
}

/* ---- a board ---- */

#define OPTIONS_COMMON 4 /* that every board has */

enum vboard_exit vboard_options_board(struct vboard_options_board *board, const char *text,
				      const struct vboard_option *own)
{
	uint64_t fd = UINT64_MAX, tile = 64, lanes = 8, number[VBOARD_OPTIONS];
	struct accel_option list[OPTIONS_COMMON + VBOARD_OPTIONS + 1] = {
		{ "fd", 0, INT32_MAX, 1, &fd },
		{ "memory", GLOSS_PAGE_BYTES, ENGINE_MEMORY_MAX, GLOSS_PAGE_BYTES, &board->memory },
		{ "tile", 32, 64, 0, &tile },
		{ "lanes", 1, 8, 0, &lanes },
	};
	struct accel_transport_error error = { "" };
	size_t owned;

	for (owned = 0; owned < VBOARD_OPTIONS && own[owned].name; owned++) {
		number[owned] = *own[owned].value;
		list[OPTIONS_COMMON + owned] = (struct accel_option){
			own[owned].name, 0, own[owned].max, 1, &number[owned],
		};
	}
	board->memory = ENGINE_MEMORY_DEFAULT;
	if (accel_option_parse(text, list, &error))
		return vboard_usage_error(board->text, error.text);
	if (fd == UINT64_MAX)
		return vboard_usage_error(board->text, "fd is missing, the board's socket");
	board->socket = (int)fd;
	board->tile = (uint32_t)tile;
	board->lanes = (uint32_t)lanes;
	for (size_t i = 0; i < owned; i++)
		*own[i].value = (uint32_t)number[i];
	return VBOARD_OK;
}

static enum vboard_exit parse_board(struct vboard_options *options, const char *text)
{
	struct vboard_options_board *board = &options->board[options->boards];
	size_t length = strcspn(text, ",");

	if (options->boards == VBOARD_BOARDS)
		return vboard_usage_error(text, "one board too many");
	if (!length || length >= sizeof(board->engine))
		return vboard_usage_error(text, "the engine is model or rtl");
	options->boards++;
	board->text = text;
	memcpy(board->engine, text, length);
	return options->program->parse(board, text[length] ? text + length + 1 : "");
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
		fputs(options->program->usage, stdout);
		options->done = true;
		return VBOARD_OK;
	case 'V':
		printf("%s " GLOSS_RELEASE "\n", program_invocation_short_name);
		options->done = true;
		return VBOARD_OK;
	default:
		/* getopt said what is wrong. */
		fprintf(stderr, "see %s --help\n", program_invocation_short_name);
		return VBOARD_USAGE;
	}
}

enum vboard_exit vboard_options_parse(struct vboard_options *options,
				      const struct vboard_program *program, int argc, char **argv)
{
	static const struct option table[] = { { "qtest", required_argument, NULL, 'q' },
					       { "board", required_argument, NULL, 'b' },
					       { "verbose", no_argument, NULL, 'v' },
					       { "help", no_argument, NULL, 'h' },
					       { "version", no_argument, NULL, 'V' },
					       { NULL, 0, NULL, 0 } };
	enum vboard_exit ret = VBOARD_OK;
	int option;

	*options = (struct vboard_options){ .program = program };
	while (ret == VBOARD_OK && !options->done &&
	       (option = getopt_long(argc, argv, "", table + !program->qtest, NULL)) != -1)
		ret = parse_option(options, option, optarg);
	if (ret != VBOARD_OK || options->done)
		return ret;
	if (optind < argc)
		return vboard_usage_error(argv[optind], "all is said with options");
	if (!options->boards)
		return vboard_usage_error("no board", "give --board ENGINE,fd=N");
	return VBOARD_OK;
}
