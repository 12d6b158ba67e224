// SPDX-License-Identifier: MIT
/* Prints a command stream in names and says where it is broken. */
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "decode/decode.h"

enum { EXIT_GOOD, EXIT_BROKEN, EXIT_USAGE };

static const char usage[] =
	"usage: gloss-decode [OPTION]... [FILE]\n"
	"Prints a command stream (32-bit little-endian words) in names and says where it is\n"
	"broken. Without FILE, or if it is -, reads standard input.\n"
	"  -c, --coredump     the file is what the kernel kept of a lost job,\n"
	"                     /sys/class/devcoredump/devcd*/data; print that and its stream\n"
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
	const char *path; /* "-": standard input */
	unsigned int tile_size;
	uint64_t offset, limit;
	bool quiet, coredump;
};

/* Words of a file, so many at a time that a packet is always whole. */
struct input {
	FILE *file;
	bool text; /* hexadecimal, as in a dump */
	uint32_t words[2 * DECODE_PACKET_MAX];
	size_t begin, end;
	unsigned int left_over; /* bytes behind the last whole word of the file */
};

static void input_take_bytes(struct input *input)
{
	unsigned char bytes[4 * DECODE_PACKET_MAX];
	size_t size = fread(bytes, 1, sizeof(bytes), input->file), i;

	for (i = 0; i + 4 <= size; i += 4)
		input->words[input->end++] = bytes[i] | (uint32_t)bytes[i + 1] << 8 |
					     (uint32_t)bytes[i + 2] << 16 |
					     (uint32_t)bytes[i + 3] << 24;
	input->left_over = (unsigned int)(size - i);
}

static void input_take_text(struct input *input)
{
	for (size_t i = 0; i < DECODE_PACKET_MAX; i++)
		if (fscanf(input->file, "%8" SCNx32, &input->words[input->end]) == 1)
			input->end++;
}

/* False: the file could not be read. */
static bool input_fill(struct input *input)
{
	if (input->end - input->begin >= DECODE_PACKET_MAX || feof(input->file))
		return true;
	memmove(input->words, input->words + input->begin,
		(input->end - input->begin) * sizeof(input->words[0]));
	input->end -= input->begin;
	input->begin = 0;
	if (input->text)
		input_take_text(input);
	else
		input_take_bytes(input);
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
	case 'c':
		options->coredump = true;
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
		fputs("try --help\n", stderr); /* getopt said what is wrong */
		exit(EXIT_USAGE);
	}
}

static void parse_arguments(struct options *options, int argc, char **argv)
{
	static const struct option table[] = { { "coredump", no_argument, NULL, 'c' },
					       { "tile", required_argument, NULL, 't' },
					       { "offset", required_argument, NULL, 'o' },
					       { "limit", required_argument, NULL, 'n' },
					       { "quiet", no_argument, NULL, 'q' },
					       { "help", no_argument, NULL, 'h' },
					       { "version", no_argument, NULL, 'V' },
					       { NULL, 0, NULL, 0 } };
	int option;

	*options = (struct options){ .path = "-", .limit = UINT64_MAX };
	while ((option = getopt_long(argc, argv, "ct:o:n:qhV", table, NULL)) != -1)
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

/* Prints a dump up to its stream, of which @words are there and @all were. False: it is none. */
static bool open_coredump(struct input *input, bool quiet, uint64_t *words, uint64_t *all)
{
	char line[256];

	input->text = true;
	if (!fgets(line, sizeof(line), input->file) || strcmp(line, "gloss coredump 1\n") != 0)
		return false;
	while (fgets(line, sizeof(line), input->file)) {
		if (!quiet)
			fputs(line, stdout);
		if (sscanf(line, "stream: %" SCNu64 " words, here %" SCNu64, all, words) == 2)
			return true;
	}
	return false;
}

/* Where the dump of a long stream stops is no fault. */
static int report_cut(struct decode_packet *packet, uint64_t words, uint64_t all)
{
	if (packet->fault && words < all && packet->offset + packet->count >= words) {
		packet->fault = GLOSS_FAULT_NONE;
	} else if (!packet->fault && packet->offset < words) {
		printf("the file ends at word %" PRIu64 " of %" PRIu64 "\n", packet->offset, words);
		return EXIT_BROKEN;
	}
	if (words < all)
		printf("the dump has only the first %" PRIu64 " of %" PRIu64 " words\n", words,
		       all);
	if (packet->fault)
		decode_print_fault(stdout, packet);
	return packet->fault ? EXIT_BROKEN : EXIT_GOOD;
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

static int decode_stdio_error(const char *what)
{
	fprintf(stderr, "gloss-decode: %s: %s\n", what, strerror(errno));
	return EXIT_USAGE;
}

int main(int argc, char **argv)
{
	static struct input input;
	uint64_t words = 0, all = 0;
	struct decode_packet packet;
	struct options options;
	int status;

	parse_arguments(&options, argc, argv);
	if (!open_input(&input, options.path))
		return decode_stdio_error(options.path);
	if (options.coredump && !open_coredump(&input, options.quiet, &words, &all)) {
		fprintf(stderr, "gloss-decode: %s: not a dump of the gloss driver's\n",
			options.path);
		return EXIT_USAGE;
	}
	if (!decode_file(&options, &input, &packet))
		return decode_stdio_error(options.path);
	if (input.file != stdin)
		fclose(input.file);
	status = options.coredump ? report_cut(&packet, words, all) :
				    report(&packet, input.left_over);
	if (fflush(stdout) || ferror(stdout))
		return decode_stdio_error("standard output");
	return status;
}
