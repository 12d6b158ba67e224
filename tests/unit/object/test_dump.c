/* SPDX-License-Identifier: MIT */
/* Jobs as files: what is in them, and that nothing but a message comes of files that can not be. */
#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "accel_test.h"

#define WORDS 100000u /* more than one read takes */

struct fixture {
	char folder[64];
	struct messages messages;
	struct accel_device *device;
	struct accel_buffer *read, *written;
	struct accel_stream *stream;
};

static void open_all(struct fixture *fixture)
{
	fixture->device = device_open("model:memory=4194304", &fixture->messages);
	assert_int_equal(accel_buffer_new(fixture->device, WORDS * 4, &fixture->read), 0);
	assert_int_equal(accel_buffer_new(fixture->device, 4096, &fixture->written), 0);
	assert_int_equal(accel_stream_new(fixture->device, &fixture->stream), 0);
}

static int setup(void **state)
{
	static struct fixture fixture;

	strcpy(fixture.folder, "/tmp/test_dump-XXXXXX");
	assert_non_null(mkdtemp(fixture.folder));
	setenv("ACCEL_DUMP", fixture.folder, 1);
	open_all(&fixture);
	*state = &fixture;
	return 0;
}

static int setup_off(void **state)
{
	int err = setup(state);
	struct fixture *fixture = *state;

	accel_buffer_free(fixture->read);
	accel_buffer_free(fixture->written);
	accel_stream_free(fixture->stream);
	accel_device_free(fixture->device);
	unsetenv("ACCEL_DUMP");
	open_all(fixture);
	return err;
}

/* Calls @each, if there is one, with each file's path; returns how many there are. */
static int files(const char *folder, int (*each)(const char *path))
{
	DIR *directory = opendir(folder);
	struct dirent *entry;
	char path[512];
	int count = 0;

	assert_non_null(directory);
	while ((entry = readdir(directory))) {
		if (entry->d_name[0] == '.')
			continue;
		snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
		if (each)
			each(path);
		count++;
	}
	closedir(directory);
	return count;
}

static int teardown(void **state)
{
	struct fixture *fixture = *state;

	accel_stream_free(fixture->stream);
	accel_buffer_free(fixture->read);
	accel_buffer_free(fixture->written);
	accel_device_free(fixture->device);
	unsetenv("ACCEL_DUMP");
	files(fixture->folder, unlink);
	rmdir(fixture->folder);
	return 0;
}

/* Copies a word of the one buffer to the response, and writes one to the other. */
static void submit(struct fixture *fixture, uint32_t value, uint32_t *response)
{
	uint32_t words[16];
	size_t count;
	int read = accel_stream_slot(fixture->stream, fixture->read, ACCEL_SLOT_READ);
	int write = accel_stream_slot(fixture->stream, fixture->written, ACCEL_SLOT_WRITE);

	assert_int_equal(read, 0);
	assert_int_equal(write, 1);
	count = packet_read(words, 0, 4 * (WORDS - 1), 1);
	count += packet_write(words + count, 1, 8, value);
	assert_int_equal(accel_stream_emit(fixture->stream, words, count), 0);
	assert_int_equal(accel_stream_finish(fixture->stream, response, 1), 0);
}

/* The last job's file with this ending; NULL if there is none. The caller's to close. */
static FILE *open_file(const struct fixture *fixture, unsigned int number, const char *ending)
{
	char path[256];

	snprintf(path, sizeof(path), "%s/job-%d-%06u.%s", fixture->folder, (int)getpid(), number,
		 ending);
	return fopen(path, "rb");
}

/* Numbers go on from test to test. */
static unsigned int first_number(const struct fixture *fixture)
{
	unsigned int number = 1;
	FILE *file;

	while (number < 1000) {
		file = open_file(fixture, number, "txt");
		if (file) {
			fclose(file);
			return number;
		}
		number++;
	}
	fail_msg("no job is in %s", fixture->folder);
	return 0;
}

static size_t read_file(const struct fixture *fixture, const char *ending, void *bytes, size_t room)
{
	FILE *file = open_file(fixture, first_number(fixture), ending);
	size_t size;

	assert_non_null(file);
	size = fread(bytes, 1, room, file);
	fclose(file);
	return size;
}

static void nothing_is_written_where_nobody_asks(void **state)
{
	struct fixture *fixture = *state;
	uint32_t response;

	submit(fixture, 1, &response);
	assert_int_equal(files(fixture->folder, NULL), 0);
	assert_int_equal(fixture->messages.count, 0);
}

static void a_job_is_its_board_its_stream_and_the_slots_it_reads(void **state)
{
	static uint32_t before[WORDS], found[WORDS + 1];
	struct fixture *fixture = *state;
	uint32_t response, expected[16];
	char text[512] = "";
	size_t count;

	for (uint32_t i = 0; i < WORDS; i++)
		before[i] = i * 2654435761u;
	assert_int_equal(accel_buffer_write(fixture->read, 0, before, sizeof(before)), 0);
	submit(fixture, 77, &response);
	assert_int_equal(response, before[WORDS - 1]);

	read_file(fixture, "txt", text, sizeof(text) - 1);
	assert_string_equal(text, "gloss job 1\nboard: C model, 64-pixel tiles\ntile: 64\n"
				  "stream: 7 words\nresponse: 1 words\n"
				  "slot 0: 400000 bytes, read\nslot 1: 4096 bytes, write\n");
	count = packet_read(expected, 0, 4 * (WORDS - 1), 1);
	packet_write(expected + count, 1, 8, 77);
	assert_int_equal(read_file(fixture, "stream", found, sizeof(found)), 7 * 4);
	assert_memory_equal(found, expected, 7 * 4);
	assert_int_equal(read_file(fixture, "slot0", found, sizeof(found)), sizeof(before));
	assert_memory_equal(found, before, sizeof(before));
	assert_null(open_file(fixture, first_number(fixture), "slot1"));
	assert_int_equal(files(fixture->folder, NULL), 3);
	assert_int_equal(fixture->messages.count, 0);
}

static void copies_of_buffers_are_no_jobs_of_the_program(void **state)
{
	struct fixture *fixture = *state;
	uint32_t word = 3;

	assert_int_equal(accel_buffer_write(fixture->read, 0, &word, 4), 0);
	assert_int_equal(accel_buffer_read(fixture->read, 0, &word, 4), 0);
	assert_int_equal(files(fixture->folder, NULL), 0);
}

static void jobs_of_several_devices_have_names_of_their_own(void **state)
{
	struct fixture *fixture = *state, other = { .folder = "" };
	uint32_t response;

	open_all(&other);
	for (uint32_t n = 0; n < 3; n++) {
		submit(fixture, n, &response);
		submit(&other, n, &response);
	}
	assert_int_equal(files(fixture->folder, NULL), 6 * 3);
	accel_stream_free(other.stream);
	accel_buffer_free(other.read);
	accel_buffer_free(other.written);
	accel_device_free(other.device);
}

static void a_folder_that_is_not_there_is_one_message(void **state)
{
	struct fixture *fixture = *state;
	uint32_t response, word = 0;

	rmdir(fixture->folder);
	for (uint32_t n = 1; n < 4; n++)
		submit(fixture, n, &response);
	assert_int_equal(fixture->messages.count, 1);
	assert_message(&fixture->messages, "ACCEL_DUMP: ");
	assert_message(&fixture->messages, fixture->folder);
	assert_message(&fixture->messages, "No such file or directory; no more jobs");
	assert_int_equal(accel_buffer_read(fixture->written, 8, &word, 4), 0);
	assert_int_equal(word, 3);
	mkdir(fixture->folder, 0700);
}

/* As a full disk: a file may have so many bytes and no more. */
static void without_room(struct fixture *fixture, rlim_t bytes, const char *message)
{
	struct rlimit limit, small;
	uint32_t response, word = 0;

	getrlimit(RLIMIT_FSIZE, &limit);
	small = limit;
	small.rlim_cur = bytes;
	signal(SIGXFSZ, SIG_IGN);
	setrlimit(RLIMIT_FSIZE, &small);
	for (uint32_t n = 1; n < 4; n++)
		submit(fixture, n, &response);
	setrlimit(RLIMIT_FSIZE, &limit);
	assert_int_equal(fixture->messages.count, 1);
	assert_message(&fixture->messages, message);
	assert_int_equal(accel_buffer_read(fixture->written, 8, &word, 4), 0);
	assert_int_equal(word, 3);
}

static void a_disk_without_room_is_one_message(void **state)
{
	without_room(*state, 4096, ".slot0: File too large; no more jobs");
}

static void a_disk_without_room_for_text_is_one_message(void **state)
{
	without_room(*state, 10, ".txt: File too large; no more jobs");
}

static void a_child_of_fork_writes_nothing(void **state)
{
	struct fixture *fixture = *state;
	uint32_t word = 0;
	int status = 0;
	pid_t child;

	assert_int_equal(accel_stream_emit(fixture->stream, &word, 1), 0);
	child = fork();
	if (!child)
		_exit(accel_stream_finish(fixture->stream, NULL, 0) != -ENODEV);
	assert_int_equal(waitpid(child, &status, 0), child);
	assert_int_equal(status, 0);
	assert_int_equal(files(fixture->folder, NULL), 0);
}

/* What is lent stays where it is, and is written where it belongs. */
static void a_frame_is_written_as_the_board_has_it(void **state)
{
	static const float corner[3][3] = { { -1, -1, 0 }, { 3, -1, 0 }, { -1, 3, 0 } };
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3, .position = { .data = corner });
	struct fixture *fixture = *state;
	struct accel_target *target;
	struct accel_draw_stats stats;
	struct accel_state *drawn;
	struct accel_draw *draw;
	uint32_t *words;

	assert_int_equal(accel_target_new(fixture->device, 128, 128, &target), 0);
	assert_int_equal(accel_state_new(&drawn), 0);
	assert_int_equal(accel_draw_new(fixture->device, &draw), 0);
	assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
	assert_int_equal(accel_draw_mesh(draw, drawn, &mesh), 0);
	assert_int_equal(accel_draw_finish(draw), 0);
	accel_draw_stats(draw, &stats, sizeof(stats));
	words = calloc(stats.stream_words + 1, 4);
	assert_int_equal(read_file(fixture, "stream", words, 4 * (stats.stream_words + 1)),
			 4 * stats.stream_words);
	assert_int_equal(words[0] >> 24, GLOSS_OP_COLOUR_SURFACE);
	assert_int_equal(words[stats.stream_words - 3] >> 24, GLOSS_OP_TILE_END);
	free(words);
	accel_draw_free(draw);
	accel_state_free(drawn);
	accel_target_free(target);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(nothing_is_written_where_nobody_asks, setup_off,
						teardown),
#define WITH_FOLDER(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
		WITH_FOLDER(a_job_is_its_board_its_stream_and_the_slots_it_reads),
		WITH_FOLDER(copies_of_buffers_are_no_jobs_of_the_program),
		WITH_FOLDER(jobs_of_several_devices_have_names_of_their_own),
		WITH_FOLDER(a_folder_that_is_not_there_is_one_message),
		WITH_FOLDER(a_disk_without_room_is_one_message),
		WITH_FOLDER(a_disk_without_room_for_text_is_one_message),
		WITH_FOLDER(a_child_of_fork_writes_nothing),
		WITH_FOLDER(a_frame_is_written_as_the_board_has_it),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
