// SPDX-License-Identifier: MIT
/* JSON (RFC 8259), in ASCII: a byte that is none is escaped as the code point of its value. */
#include <inttypes.h>

#include "gloss_packets.h"
#include "info/info.h"

static void put_string(FILE *file, const char *text)
{
	fputc('"', file);
	for (; *text; text++) {
		if (*text == '"' || *text == '\\')
			fprintf(file, "\\%c", *text);
		else if (*text < ' ' || *text > '~')
			fprintf(file, "\\u%04x", (unsigned char)*text);
		else
			fputc(*text, file);
	}
	fputc('"', file);
}

void info_json_list(FILE *file, const struct info_list *list)
{
	fputc('[', file);
	for (size_t i = 0; i < list->count; i++) {
		fputs(i ? ",\n {\"device\": " : "\n {\"device\": ", file);
		put_string(file, list->entry[i].name);
		fputs(", \"description\": ", file);
		put_string(file, list->entry[i].line);
		fputc('}', file);
	}
	fputs(list->count ? "\n]\n" : "]\n", file);
}

static void put_clocks(FILE *file, const struct info_board *board)
{
	const struct accel_device_clocks *clocks = &board->clocks;

	if (!board->counts) {
		fputs("null", file);
		return;
	}
	fprintf(file,
		"{\"clocks\": %" PRIu64 ", \"stall_stream\": %" PRIu64
		", \"stall_raster\": %" PRIu64 ", ",
		clocks->clocks, clocks->stall_stream, clocks->stall_raster);
	fprintf(file,
		"\"stall_tile\": %" PRIu64 ", \"stall_memory\": %" PRIu64
		", \"stall_response\": %" PRIu64 "}",
		clocks->stall_tile, clocks->stall_memory, clocks->stall_response);
}

void info_json_board(FILE *file, const struct info_board *board)
{
	fputs("{\n \"device\": ", file);
	put_string(file, board->device);
	fputs(",\n \"name\": ", file);
	put_string(file, board->info.name);
	fprintf(file,
		",\n \"tile_size\": %" PRIu32 ",\n \"pixels_per_clock\": %" PRIu32
		",\n \"memory_bytes\": %" PRIu64 ",\n \"interface_version\": %u,\n \"clocks\": ",
		board->info.tile_size, board->info.pixels_per_clock, board->info.memory_size,
		GLOSS_VERSION);
	put_clocks(file, board);
	fputs("\n}\n", file);
}
