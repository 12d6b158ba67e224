// SPDX-License-Identifier: MIT
/* What vboard-usb takes. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "vboard/options.h"

#define OPTIONS_TEXT_MAX 1024 /* characters of a board's options */

static const char usage[] =
	"usage: vboard-usb [--verbose] --board ENGINE,fd=N[,OPTION=VALUE]... ...\n"
	"Serves virtual Gloss boards to QEMU, each to one usb-redir. ENGINE is model (the C model)\n"
	"or rtl (the Verilated board). OPTIONs of a board:\n"
	"  fd=N               its socket, whose other end QEMU has; must be given\n"
	"  speed=NAME         high or super; super if not given\n"
	"  serial=TEXT        its serial number; VIRTUAL0 if not given\n"
	"  memory=BYTES       board memory, a multiple of 4096; 256 MiB if not given\n"
	"  tile=N             pixels of a tile's side, 32 or 64; 64 if not given\n"
	"  lanes=N            pixels a clock of rtl, 1, 2, 4 or 8; 8 if not given\n"
	"Faults, see vboard-usb(1):\n"
	"  unplug=N           the cable is pulled at the N-th transfer\n"
	"  replug=MS          it is back so much later; never if not given\n"
	"  stall-out=N        the N-th OUT transfer is stalled\n"
	"  stall-in=N         the N-th IN transfer is stalled\n"
	"  short-in=N         the N-th IN transfer ends after half its words\n"
	"  empty-in=N         N empty IN transfers come before the first words\n"
	"  delay=US           each completion leaves so much later\n"
	"  garbage=N          the N-th IN word and the 15 after it are noise\n"
	"  hang=N             the N-th completion does not leave until the host resets the board\n"
	"  lose-out=N         the N-th OUT transfer is acknowledged and dropped\n"
	"  exit=N             the program ends at the N-th transfer\n"
	"  refuse-control=N   the N-th register request is stalled\n"
	"Further:\n"
	"  --verbose          print what each board did, at the end\n"
	"  --help, --version  print, and leave\n"
	"Ends when QEMU has closed all sockets. Exit status: 0 done, 1 something failed, 2 the\n"
	"command line was wrong.\n";

/* ---- options that are no numbers ---- */

struct text_option {
	const char *name;
	char *value; /* empty: not given yet */
	size_t size;
};

static const struct text_option *find_text(const struct text_option *list, const char *item,
					   size_t length)
{
	for (; list->name; list++)
		if (length > strlen(list->name) && item[strlen(list->name)] == '=' &&
		    !strncmp(item, list->name, strlen(list->name)))
			return list;
	return NULL;
}

/* Printable, for it is a string descriptor. */
static bool text_fits(const char *value, size_t length, size_t size)
{
	for (size_t i = 0; i < length; i++)
		if (!isgraph((unsigned char)value[i]))
			return false;
	return length && length < size;
}

static enum vboard_exit take_text(const struct text_option *option, const char *value,
				  size_t length)
{
	char why[80];

	if (*option->value) {
		snprintf(why, sizeof(why), "%s is given twice", option->name);
		return vboard_usage_error("--board", why);
	}
	if (!text_fits(value, length, option->size)) {
		snprintf(why, sizeof(why), "%s takes 1 to %zu letters, digits or signs",
			 option->name, option->size - 1);
		return vboard_usage_error("--board", why);
	}
	memcpy(option->value, value, length);
	return VBOARD_OK;
}

/* Takes the options of @list out of @text; the others go to @rest, which has room for @text. */
static enum vboard_exit take_texts(const struct text_option *list, const char *text, char *rest)
{
	const struct text_option *option;
	enum vboard_exit ret = VBOARD_OK;
	const char *item, *comma = "";
	size_t length;

	*rest = '\0';
	for (item = text; ret == VBOARD_OK; item += length + 1) {
		length = strcspn(item, ",");
		option = find_text(list, item, length);
		if (option) {
			ret = take_text(option, item + strlen(option->name) + 1,
					length - strlen(option->name) - 1);
		} else {
			rest += sprintf(rest, "%s%.*s", comma, (int)length, item);
			comma = ",";
		}
		if (!item[length])
			break;
	}
	return ret;
}

/* ---- a board ---- */

static enum vboard_exit parse_texts(struct vboard_options_board *board, const char *text,
				    char *rest)
{
	char speed[8] = "";
	const struct text_option list[] = {
		{ "speed", speed, sizeof(speed) },
		{ "serial", board->usb.serial, sizeof(board->usb.serial) },
		{ NULL, NULL, 0 },
	};
	enum vboard_exit ret;

	if (strlen(text) >= OPTIONS_TEXT_MAX)
		return vboard_usage_error("--board", "that is too long");
	ret = take_texts(list, text, rest);
	if (ret != VBOARD_OK)
		return ret;
	board->usb.super = strcmp(speed, "high") != 0;
	if (*speed && board->usb.super && strcmp(speed, "super") != 0)
		return vboard_usage_error(board->text, "speed is high or super");
	if (!*board->usb.serial)
		strcpy(board->usb.serial, "VIRTUAL0");
	return VBOARD_OK;
}

static enum vboard_exit parse_numbers(struct vboard_options_board *board, const char *text)
{
	struct vboard_usb_faults_armed *armed = &board->usb.armed;
	const struct vboard_option list[] = {
		{ "unplug", UINT32_MAX, &armed->unplug },
		{ "replug", UINT32_MAX, &armed->replug },
		{ "stall-out", UINT32_MAX, &armed->stall_out },
		{ "stall-in", UINT32_MAX, &armed->stall_in },
		{ "short-in", UINT32_MAX, &armed->short_in },
		{ "empty-in", UINT32_MAX, &armed->empty_in },
		{ "delay", UINT32_MAX, &armed->delay },
		{ "garbage", UINT32_MAX, &armed->garbage },
		{ "hang", UINT32_MAX, &armed->hang },
		{ "lose-out", UINT32_MAX, &armed->lose_out },
		{ "exit", UINT32_MAX, &armed->exit },
		{ "refuse-control", UINT32_MAX, &armed->refuse_control },
		{ NULL, 0, NULL },
	};

	return vboard_options_board(board, text, list);
}

static enum vboard_exit parse_usb(struct vboard_options_board *board, const char *text)
{
	char rest[OPTIONS_TEXT_MAX];
	enum vboard_exit ret = parse_texts(board, text, rest);

	return ret == VBOARD_OK ? parse_numbers(board, rest) : ret;
}

const struct vboard_program vboard_program_usb = {
	.usage = usage,
	.parse = parse_usb,
};
