// SPDX-License-Identifier: MIT
/* Lines for people, and for their shells. */
#include <inttypes.h>
#include <string.h>

#include "gloss_packets.h"
#include "info/info.h"

static bool printable(char letter)
{
	return letter >= ' ' && letter <= '~';
}

static void put_text(FILE *file, const char *text)
{
	for (; *text; text++)
		fputc(printable(*text) ? *text : '?', file);
}

/* ---- names: one word of a shell, whatever is in them ---- */

static bool plain(char letter)
{
	return letter && strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
				"0123456789:/.,=_+-@",
				letter);
}

static size_t plain_length(const char *name)
{
	size_t length = 0;

	while (plain(name[length]))
		length++;
	return length;
}

/* As bash, ksh and zsh write any bytes. Returns how many letters that took. */
static size_t put_quoted(FILE *file, const char *name)
{
	size_t length = 3;

	fputs("$'", file);
	for (; *name; name++) {
		if (*name == '\'' || *name == '\\') {
			fputc('\\', file);
			length++;
		}
		if (printable(*name)) {
			fputc(*name, file);
			length++;
		} else {
			fprintf(file, "\\%03o", (unsigned char)*name);
			length += 4;
		}
	}
	fputc('\'', file);
	return length;
}

static size_t put_name(FILE *file, const char *name)
{
	size_t length = plain_length(name);

	if (!*name || name[length])
		return put_quoted(file, name);
	fputs(name, file);
	return length;
}

/* ---- what is asked for ---- */

void info_print_list(FILE *file, const struct info_list *list)
{
	size_t width = 0, length;

	for (size_t i = 0; i < list->count; i++) {
		length = strlen(list->entry[i].name);
		width = length > width ? length : width;
	}
	for (size_t i = 0; i < list->count; i++) {
		length = put_name(file, list->entry[i].name);
		fprintf(file, "%*s  ", length < width ? (int)(width - length) : 0, "");
		put_text(file, list->entry[i].line);
		fputc('\n', file);
	}
}

static void print_memory(FILE *file, uint64_t size)
{
	if (size % (1 << 20))
		fprintf(file, "memory     %" PRIu64 " bytes\n", size);
	else
		fprintf(file, "memory     %" PRIu64 " MiB\n", size >> 20);
}

static void print_clocks(FILE *file, const struct accel_device_clocks *clocks)
{
	fprintf(file,
		"clocks     %" PRIu64 ", of which waited for stream %" PRIu64 ", raster %" PRIu64
		", tile %" PRIu64 ", memory %" PRIu64 ", response %" PRIu64 "\n",
		clocks->clocks, clocks->stall_stream, clocks->stall_raster, clocks->stall_tile,
		clocks->stall_memory, clocks->stall_response);
}

void info_print_board(FILE *file, const struct info_board *board)
{
	fputs("device     ", file);
	put_text(file, board->info.name);
	fprintf(file, "\ntiles      %" PRIu32 "x%" PRIu32 " pixels\n", board->info.tile_size,
		board->info.tile_size);
	fprintf(file, "lanes      %" PRIu32 " pixels a clock\n", board->info.pixels_per_clock);
	print_memory(file, board->info.memory_size);
	fprintf(file, "interface  version %u\n", GLOSS_VERSION);
	if (board->counts)
		print_clocks(file, &board->clocks);
}
