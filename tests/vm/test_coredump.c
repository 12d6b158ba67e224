// SPDX-License-Identifier: MIT
/*
 * A job that hangs the board leaves a dump, which gloss-decode reads. As root.
 */
#include <dirent.h>
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "gloss_node.h"
#include "vm_test.h"

#define DUMPS "/sys/class/devcoredump"
#define LONG_WORDS (300 * 1024u)

static struct client client;
static volatile uint32_t *window;

/* The dump there is; false: none. */
static bool find_dump(char path[512])
{
	DIR *folder = opendir(DUMPS);
	struct dirent *entry;
	bool found = false;

	if (!folder)
		return false;
	while (!found && (entry = readdir(folder))) {
		if (!strncmp(entry->d_name, "devcd", 5)) {
			snprintf(path, 512, DUMPS "/%s/data", entry->d_name);
			found = true;
		}
	}
	closedir(folder);
	return found;
}

/* Only one is kept at a time; writing to it gives it up. */
static void drop_dumps(void)
{
	char path[512];

	for (int tries = 0; find_dump(path); tries++) {
		assert_in_range(tries, 0, vm_patience_ms() / 10);
		vm_write_file(path, "0");
		usleep(10 * 1000);
	}
}

static void wait_for_dump(char path[512])
{
	for (int ms = 0; !find_dump(path); ms += 10) {
		assert_in_range(ms, 0, vm_patience_ms());
		usleep(10 * 1000);
	}
}

static void hang(const struct client_job *job)
{
	vm_expect("hung the board|is lost");
	window[VBOARD_FAULT_HANG / 4] = 1;
	assert_int_equal(client_submit(&client, job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), -EIO);
	window[VBOARD_FAULT_HANG / 4] = 0;
	vm_expect_end();
}

/* What gloss-decode says of the dump. */
static const char *decode(const char *path, const char *options, int *status)
{
	static char text[1 << 16];
	char command[1024];
	size_t length;
	FILE *pipe;

	snprintf(command, sizeof(command), "%s/gloss-decode --coredump %s %s",
		 vm_env("GLOSS_BUILD"), options, path);
	pipe = popen(command, "r");
	assert_non_null(pipe);
	length = fread(text, 1, sizeof(text) - 1, pipe);
	text[length] = '\0';
	while (fgetc(pipe) != EOF)
		;
	*status = pclose(pipe);
	return text;
}

static void assert_says(const char *text, const char *part)
{
	if (!strstr(text, part))
		fail_msg("no \"%s\" in: %s", part, text);
}

static void a_hung_job_leaves_a_dump_in_names(void **state)
{
	const uint32_t value = 0xc0ffee;
	struct client_job job;
	char path[512], line[64];
	const char *text;
	uint32_t words;
	int status;

	(void)state;
	words = node_write(client.stream, 0, 64, &value, 1);
	words += node_read(client.stream + words, 0, 64, 1);
	client_prepare(&client, &job, words, 1);
	hang(&job);
	wait_for_dump(path);
	text = decode(path, "", &status);
	assert_int_equal(status, 0);
	snprintf(line, sizeof(line), "process: %d\n", getpid());
	assert_says(text, line);
	assert_says(text, "error: -5\n");
	assert_says(text, "register IDENTITY: 0x534f4c47\n");
	snprintf(line, sizeof(line), "stream: %u words, here %u\n", words, words);
	assert_says(text, line);
	assert_says(text, "slot 0: base ");
	assert_says(text, "WRITE_MEMORY");
	assert_says(text, "00c0ffee");
	assert_says(text, "READ_MEMORY");
}

static void of_a_long_stream_the_dump_has_the_beginning(void **state)
{
	struct node_buffer buffer;
	struct client_job job;
	char path[512];
	int status;

	(void)state;
	assert_int_equal(node_buffer_new(client.fd, 4 * LONG_WORDS, &buffer), 0);
	client_prepare(&client, &job, 1, 0);
	job.submit.stream = buffer.handle;
	job.submit.stream_words = LONG_WORDS;
	hang(&job);
	wait_for_dump(path);
	assert_string_equal(decode(path, "--quiet", &status),
			    "the dump has only the first 262144 of 307200 words\n");
	assert_int_equal(status, 0);
	node_buffer_free(client.fd, &buffer);
}

static int open_file(void **state)
{
	(void)state;
	if (access("/sys/class/devcoredump", F_OK))
		vm_skip("no " DUMPS ": the kernel keeps no dumps");
	window = vm_faults("GLOSS_PCI_MODEL");
	drop_dumps();
	if (client_open(&client, vm_env("GLOSS_NODE_MODEL"), NODE_PAGE))
		return -1;
	/* Its memory is cleared by a job of the driver's, which is not the one to hang. */
	return client_works(&client) ? 0 : -1;
}

static int close_file(void **state)
{
	(void)state;
	client_close(&client);
	drop_dumps();
	return 0;
}

#define dump_test(name) cmocka_unit_test_setup_teardown(name, open_file, close_file)

int main(void)
{
	const struct CMUnitTest tests[] = {
		dump_test(a_hung_job_leaves_a_dump_in_names),
		dump_test(of_a_long_stream_the_dump_has_the_beginning),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
