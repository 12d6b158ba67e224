/* SPDX-License-Identifier: MIT */
/*
 * For test programs that run in the virtual machine (README.md). All of these end the program
 * with a message and VM_FAIL where they can not do what they say.
 *
 * Exit with VM_PASS, VM_FAIL, or VM_SKIP by vm_skip().
 */
#ifndef VM_TEST_H
#define VM_TEST_H

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum vm_exit { VM_PASS = 0, VM_FAIL = 1, VM_SKIP = 77 };

/* Shows what was printed before a crash of the guest too. */
#define VM_PRINT(...) (printf(__VA_ARGS__), fflush(stdout))

__attribute__((noreturn, format(printf, 1, 2))) static inline void vm_fail(const char *format, ...)
{
	va_list args;

	fflush(stdout);
	va_start(args, format);
	vfprintf(stderr, format, args);
	va_end(args);
	fputc('\n', stderr);
	exit(VM_FAIL);
}

/* Ends the program as one that could not test: @missing says what is not there. */
__attribute__((noreturn)) static inline void vm_skip(const char *missing)
{
	printf("skip: %s\n", missing);
	exit(VM_SKIP);
}

/*
 * A variable of the runner: GLOSS_TEST, the program's name in the list; GLOSS_NODE_RTL and
 * GLOSS_NODE_MODEL, render nodes; GLOSS_PCI_RTL and GLOSS_PCI_MODEL, the boards in sysfs;
 * GLOSS_VM_OUT, a folder to write to that stays on the host; GLOSS_SOURCE, GLOSS_BUILD and
 * GLOSS_DRIVER, the checkout, what was built, and where gloss.ko is; GLOSS_SLOW, how many times
 * slower than usual this machine may be.
 */
static inline const char *vm_env(const char *name)
{
	const char *value = getenv(name);

	if (!value || !*value)
		vm_fail("%s is not set: tests/vm/run sets it", name);
	return value;
}

/*
 * In milliseconds, for what has to happen, such as the end of a job: what takes longer hangs,
 * however busy the machine is. GLOSS_SLOW says how many times slower it is.
 */
static inline int vm_patience_ms(void)
{
	return 60000 * atoi(vm_env("GLOSS_SLOW"));
}

/* The seed to draw all random numbers from: GLOSS_SEED, or a new one. Prints it. */
static inline uint64_t vm_seed(void)
{
	const char *given = getenv("GLOSS_SEED");
	struct timespec now;
	uint64_t seed;

	clock_gettime(CLOCK_REALTIME, &now);
	seed = given && *given ? strtoull(given, NULL, 0) :
				 (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
	VM_PRINT("GLOSS_SEED=%" PRIu64 "\n", seed);
	return seed;
}

/* Writes @text to file @path, which is there already. Returns 0 or -errno. */
static inline int vm_write_file(const char *path, const char *text)
{
	int fd = open(path, O_WRONLY | O_CLOEXEC), error = 0;

	if (fd < 0)
		return -errno;
	if (write(fd, text, strlen(text)) < 0)
		error = -errno;
	close(fd);
	return error;
}

static inline void vm_kmsg(const char *what, const char *text)
{
	char line[512];
	int error;

	if (snprintf(line, sizeof(line), "gloss-test: %s%s\n", what, text) >= (int)sizeof(line))
		vm_fail("too long to announce: %s", text);
	error = vm_write_file("/dev/kmsg", line);
	if (error)
		vm_fail("/dev/kmsg: %s", strerror(-error));
}

/*
 * From here to vm_expect_end() kernel messages above notice that match @regex (extended) do not
 * fail the test. Several can be announced; the last vm_expect_end() is that of all. As root.
 *
 * A message counts by the time the kernel printed it: wait for its cause before vm_expect_end().
 */
static inline void vm_expect(const char *regex)
{
	vm_kmsg("expect ", regex);
}

static inline void vm_expect_end(void)
{
	vm_kmsg("end", "");
}

/*
 * Maps the fault window (tools/vboard/pci/faults.h) of the board whose sysfs directory variable
 * @board, GLOSS_PCI_RTL or GLOSS_PCI_MODEL, names. As root. Stays mapped until the program ends;
 * map it again after the board was removed and found again.
 */
static inline volatile uint32_t *vm_faults(const char *board)
{
	char path[256];
	void *map;
	int fd;

	snprintf(path, sizeof(path), "%s/resource1", vm_env(board));
	fd = open(path, O_RDWR | O_SYNC | O_CLOEXEC);
	if (fd < 0)
		vm_fail("%s: %s", path, strerror(errno));
	map = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
	if (map == MAP_FAILED)
		vm_fail("mmap %s: %s", path, strerror(errno));
	close(fd);
	return (volatile uint32_t *)map;
}

/* Sets a parameter of the loaded module. As root. */
static inline void vm_parameter(const char *name, const char *value)
{
	char path[128];
	int error;

	snprintf(path, sizeof(path), "/sys/module/gloss/parameters/%s", name);
	error = vm_write_file(path, value);
	if (error)
		vm_fail("%s: %s", path, strerror(-error));
}

/* A number for docs/figures.md, which has to explain @name. */
struct vm_figure {
	const char *name;
	double value;
};

/* Hands @count figures to make bench, and prints them. Once in a program. */
static inline void vm_figures(const struct vm_figure *figures, int count)
{
	char path[512];
	FILE *file;

	snprintf(path, sizeof(path), "%s/%s.json", vm_env("GLOSS_VM_OUT"), vm_env("GLOSS_TEST"));
	file = fopen(path, "w");
	if (!file)
		vm_fail("%s: %s", path, strerror(errno));
	for (int i = 0; i < count; i++) {
		fprintf(file, "%s\"%s\": %.6g", i ? ", " : "{ ", figures[i].name, figures[i].value);
		VM_PRINT("%s %.6g\n", figures[i].name, figures[i].value);
	}
	fprintf(file, " }\n");
	if (fclose(file))
		vm_fail("%s: %s", path, strerror(errno));
}

#endif
