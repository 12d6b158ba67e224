// SPDX-License-Identifier: MIT
/* Prints a command stream in names and says where it is broken. */
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "decode.h"

enum { EXIT_GOOD, EXIT_BROKEN, EXIT_USAGE };

static const char usage[] =
	"usage: gloss-decode [OPTION]... [FILE]\n"
	"Prints a command stream (32-bit little-endian words) in names and says where it is\n"
	"broken. Without FILE, or if it is -, reads standard input.\n"
	"  -t, --tile SIZE    check for a core with this tile size, 32 or 64; without, only what\n"
	"                     is wrong for both is found\n"
	"  -o, --offset WORD  print only packets that reach this word or come after it\n"
	"  -n, --limit COUNT  print at most this many packets\n"
	"  -q, --quiet        print only what is broken\n"
	"  -h, --help         print this\n"
	"  -V, --version      print the version of the interface\n"
	"The whole stream is checked whatever is printed. Exit status: 0 the stream is good,\n"
	"1 it is broken, 2 it could not be read.\n";

struct options {
	const char *path;		/* "-": standard input */
	unsigned int tile_size;
	uint64_t offset, limit;
	bool quiet;
};

/* Words of a file, so many at a time that a packet is always whole. */
struct input {
	FILE *file;
	uint32_t words[2 * DECODE_PACKET_MAX];
	size_t begin, end;
	unsigned int left_over;		/* bytes behind the last whole word of the file */
};

/* False: the file could not be read. */
static bool input_fill(struct input *input)
{
	unsigned char bytes[4 * DECODE_PACKET_MAX];
	size_t size, i;

	if (input->end - input->begin >= DECODE_PACKET_MAX || feof(input->file))
		return true;
	memmove(input->words, input->words + input->begin,
		(input->end - input->begin) * sizeof(input->words[0]));
	input->end -= input->begin;
	input->begin = 0;
	size = fread(bytes, 1, sizeof(bytes), input->file);
	for (i = 0; i + 4 <= size; i += 4)
		input->words[input->end++] = bytes[i] | (uint32_t)bytes[i + 1] << 8 |
					     (uint32_t)bytes[i + 2] << 16 |
					     (uint32_t)bytes[i + 3] << 24;
	input->left_over = (unsigned int)(size - i);
	return !ferror(input->file);
}

/* False: @text is not a number, or too large. */
static bool parse_number(const char *text, uint64_t *number)
{
	char *end;

	errno = 0;
	*number = strtoull(text, &end, 0);
	return *text >= '0' && *text <= '9' && !*end && !errno;
}

static void __attribute__((noreturn, format(printf, 1, 2))) bad_usage(const char *format, ...)
{
	va_list arguments;

	fputs("gloss-decode: ", stderr);
	va_start(arguments, format);
	vfprintf(stderr, format, arguments);
	va_end(arguments);
	fputs("; try --help\n", stderr);
	exit(EXIT_USAGE);
}

static void parse_option(struct options *options, int option, const char *argument)
{
	uint64_t number = 0;

	if (argument && !parse_number(argument, &number))
		bad_usage("'%s' is not a number", argument);
	switch (option) {
	case 't':
		if (number != 32 && number != 64)
			bad_usage("a tile size is 32 or 64, not '%s'", argument);
		options->tile_size = (unsigned int)number;
		break;
	case 'o':
		options->offset = number;
		break;
	case 'n':
		options->limit = number;
		break;
	case 'q':
		options->quiet = true;
		break;
	case 'h':
		fputs(usage, stdout);
		exit(EXIT_GOOD);
	case 'V':
		printf("gloss-decode, interface version %u\n", GLOSS_VERSION);
		exit(EXIT_GOOD);
	default:
		fputs("try --help\n", stderr);	/* getopt said what is wrong */
		exit(EXIT_USAGE);
	}
}

static void parse_arguments(struct options *options, int argc, char **argv)
{
	static const struct option table[] = {
		{ "tile", required_argument, NULL, 't' },
		{ "offset", required_argument, NULL, 'o' },
		{ "limit", required_argument, NULL, 'n' },
		{ "quiet", no_argument, NULL, 'q' },
		{ "help", no_argument, NULL, 'h' },
		{ "version", no_argument, NULL, 'V' },
		{ NULL, 0, NULL, 0 }
	};
	int option;

	*options = (struct options){ .path = "-", .limit = UINT64_MAX };
	while ((option = getopt_long(argc, argv, "t:o:n:qhV", table, NULL)) != -1)
		parse_option(options, option, optarg);
	if (argc - optind > 1)
		bad_usage("one file at a time, but there is '%s' behind '%s'", argv[optind + 1],
			  argv[optind]);
	if (optind < argc)
		options->path = argv[optind];
}

/* Prints what was asked for and leaves the last packet, or the end, in *@packet.
 * False, with errno: the file can not be read. */
static bool decode_file(const struct options *options, struct input *input,
			struct decode_packet *packet)
{
	struct decode decode;
	uint64_t printed = 0;

	decode_init(&decode, options->tile_size);
	for (;;) {
		if (!input_fill(input))
			return false;
		if (!decode_next(&decode, input->words + input->begin, input->end - input->begin,
				 packet))
			return true;
		if (!options->quiet && packet->offset + packet->count > options->offset &&
		    printed < options->limit) {
			decode_print(stdout, packet);
			printed++;
		}
		if (packet->fault)
			return true;
		input->begin += packet->count;
	}
}

static bool open_input(struct input *input, const char *path)
{
	input->file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
	return input->file;
}

static int report(const struct decode_packet *packet, unsigned int left_over)
{
	if (packet->fault)
		decode_print_fault(stdout, packet);
	if (left_over)
		printf("the file ends in the middle of a word: %u of its 4 bytes are there\n",
		       left_over);
	return packet->fault || left_over ? EXIT_BROKEN : EXIT_GOOD;
}

int main(int argc, char **argv)
{
	static struct input input;
	struct decode_packet packet;
	struct options options;
	int status;

	parse_arguments(&options, argc, argv);
	if (!open_input(&input, options.path) || !decode_file(&options, &input, &packet)) {
		fprintf(stderr, "gloss-decode: %s: %s\n", options.path, strerror(errno));
		return EXIT_USAGE;
	}
	if (input.file != stdin)
		fclose(input.file);
	status = report(&packet, input.left_over);
	if (fflush(stdout) || ferror(stdout)) {
		fprintf(stderr, "gloss-decode: standard output: %s\n", strerror(errno));
		return EXIT_USAGE;
	}
	return status;
}
