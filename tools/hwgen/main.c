// SPDX-License-Identifier: MIT
/* Arguments in, files out. An output is written beside its place and moved there, and only if it
 * differs, so that nothing is rebuilt for nothing and nobody sees half of it. */
#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "hwgen/hwgen.h"
#include "scene/output.h"

static const char usage[] =
	"usage: hwgen [--c FILE] [--regs FILE] [--sv FILE] [--table FILE] [--manual FILE]\n"
	"             INTERFACE.xml\n"
	"Checks an interface and writes what is asked for:\n"
	"  --c FILE       C packers and unpackers\n"
	"  --regs FILE    C offsets and masks of the registers, for the kernel too\n"
	"  --sv FILE      SystemVerilog constants and packed structs\n"
	"  --table FILE   the table of gloss-decode\n"
	"  --manual FILE  the manual, in Markdown\n";

static bool same(const char *path, const char *data, size_t size)
{
	FILE *file = fopen(path, "rb");
	size_t i = 0;
	bool equal;
	int c;

	if (!file)
		return false;
	while ((c = getc(file)) != EOF && i < size && c == (unsigned char)data[i])
		i++;
	equal = c == EOF && i == size && !ferror(file);
	fclose(file);
	return equal;
}

static void replace(const char *path, const char *data, size_t size)
{
	struct stat status;
	struct output file;
	int error;

	if (!stat(path, &status) && !S_ISREG(status.st_mode))
		hw_fail(path, 0, "not a regular file");
	error = output_open(&file, path);
	if (!error) {
		fwrite(data, 1, size, file.file);
		error = output_commit(&file);
	}
	if (error)
		hw_fail(path, 0, "%s", strerror(-error));
}

static void write_file(const char *path, void (*write)(FILE *out, const struct hw_interface *hw),
		       const struct hw_interface *hw)
{
	char *data = NULL;
	size_t size = 0;
	FILE *out = open_memstream(&data, &size);

	if (!out)
		hw_fail(path, 0, "%s", strerror(errno));
	write(out, hw);
	if (fclose(out))
		hw_fail(path, 0, "%s", strerror(errno));
	if (!same(path, data, size))
		replace(path, data, size);
	free(data);
}

int main(int argc, char **argv)
{
	static void (*const writers[])(FILE *, const struct hw_interface *) = {
		hw_write_c, hw_write_regs, hw_write_sv, hw_write_table, hw_write_manual
	};
	static const struct option options[] = {
		{ "c", required_argument, NULL, 0 },      { "regs", required_argument, NULL, 1 },
		{ "sv", required_argument, NULL, 2 },     { "table", required_argument, NULL, 3 },
		{ "manual", required_argument, NULL, 4 }, { NULL, 0, NULL, 0 }
	};
	const char *paths[sizeof(writers) / sizeof(writers[0])] = { NULL };
	struct hw_interface hw = { NULL };
	int option;

	while ((option = getopt_long(argc, argv, "", options, NULL)) != -1) {
		if (option == '?') {
			fputs(usage, stderr);
			return 2;
		}
		paths[option] = optarg;
	}
	if (argc - optind != 1) {
		fputs(usage, stderr);
		return 2;
	}
	hw_read(argv[optind], &hw);
	hw_check(&hw);
	hw_check_names(&hw);
	for (size_t i = 0; i < sizeof(writers) / sizeof(writers[0]); i++) {
		if (paths[i])
			write_file(paths[i], writers[i], &hw);
	}
	hw_free();
	return 0;
}
