// SPDX-License-Identifier: MIT
/*
 * Jobs as files, for a person who asks why a picture is wrong. With ACCEL_DUMP=FOLDER in the
 * environment each job of the program is written there before it is sent:
 *
 *   job-PID-N.txt      the board and its tile size, the lengths of stream and response, the slots
 *   job-PID-N.stream   the words of the stream, which gloss-decode reads
 *   job-PID-N.slotK    what slot K holds when the job begins, if the job may read it
 *
 * N counts the jobs of the process from 1. The words of the stream and what the slots hold are
 * all that a job's result depends on, so a job can be run again from its files. What slots hold
 * is asked of the board by jobs of the library's own, which wait for the jobs before.
 *
 * A file that can not be written ends the dump of that device with one message, and nothing else.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "accel_priv.h"
#include "dump.h"
#include "transport/thread.h"

/* One job reads as many. */
#define DUMP_CHUNK_WORDS 65535u

struct accel_dump {
	atomic_bool failed; /* and a message has said so */
	char folder[];
};

/* A job being written. */
struct dump_job {
	struct accel_device *device;
	const struct accel_transport_job *job;
	struct accel_buffer *const *buffer; /* of each slot */
	unsigned int number;
	char path[PATH_MAX]; /* of the file that is written */
};

static atomic_uint dump_jobs;

int accel_dump_new(struct accel_dump **out)
{
	const char *folder = secure_getenv("ACCEL_DUMP");
	struct accel_dump *dump;

	*out = NULL;
	if (!folder || !*folder)
		return 0;
	dump = malloc(sizeof(*dump) + strlen(folder) + 1);
	if (!dump)
		return -ENOMEM;
	atomic_init(&dump->failed, false);
	strcpy(dump->folder, folder);
	*out = dump;
	return 0;
}

void accel_dump_free(struct accel_dump *dump)
{
	free(dump);
}

static int dump_open(struct dump_job *dump, const char *ending, FILE **file)
{
	int length = snprintf(dump->path, sizeof(dump->path), "%s/job-%d-%06u.%s",
			      dump->device->dump->folder, (int)getpid(), dump->number, ending);

	if (length < 0 || (size_t)length >= sizeof(dump->path))
		return -ENAMETOOLONG;
	*file = fopen(dump->path, "wbe");
	return *file ? 0 : -errno;
}

/* A full disk may show only now. */
static int dump_close(FILE *file, int err)
{
	if (fclose(file) && !err)
		err = -errno;
	return err;
}

static int dump_words(FILE *file, const uint32_t *words, size_t count)
{
	return fwrite(words, sizeof(*words), count, file) == count ? 0 : -errno;
}

static int dump_text(struct dump_job *dump)
{
	const struct accel_transport_info *info = &dump->device->info;
	const struct accel_transport_job *job = dump->job;
	bool written;
	FILE *file;
	int err = dump_open(dump, "txt", &file);

	if (err)
		return err;
	written = fprintf(file, "gloss job 1\nboard: %s\ntile: %u\n", info->name, info->tile_size) >
			  0 &&
		  fprintf(file, "stream: %u words\nresponse: %u words\n", job->stream_words,
			  job->response_words) > 0;
	for (unsigned int i = 0; i < job->slots && written; i++)
		written = fprintf(file, "slot %u: %llu bytes,%s%s\n", i,
				  (unsigned long long)dump->buffer[i]->size,
				  job->slot[i].rights & GLOSS_RIGHTS_READ ? " read" : "",
				  job->slot[i].rights & GLOSS_RIGHTS_WRITE ? " write" : "") > 0;
	return dump_close(file, written ? 0 : -errno);
}

static int dump_stream(struct dump_job *dump)
{
	const struct accel_transport_part whole = { dump->job->stream, dump->job->stream_words };
	const struct accel_transport_part *part = whole.words ? &whole : dump->job->part;
	size_t left = dump->job->stream_words;
	FILE *file;
	int err = dump_open(dump, "stream", &file);

	if (err)
		return err;
	for (; left && !err; left -= part->count, part++)
		err = dump_words(file, part->words, part->count);
	return dump_close(file, err);
}

static int dump_contents(FILE *file, struct accel_buffer *buffer, uint32_t *words)
{
	uint64_t at, now;
	int err = 0;

	for (at = 0; at < buffer->size && !err; at += now) {
		now = buffer->size - at;
		if (now > DUMP_CHUNK_WORDS * sizeof(*words))
			now = DUMP_CHUNK_WORDS * sizeof(*words);
		err = accel_buffer_read(buffer, at, words, now);
		if (!err)
			err = dump_words(file, words, now / sizeof(*words));
	}
	return err;
}

static int dump_slot(struct dump_job *dump, unsigned int slot, uint32_t *words)
{
	char ending[16];
	FILE *file;
	int err;

	if (!(dump->job->slot[slot].rights & GLOSS_RIGHTS_READ))
		return 0;
	snprintf(ending, sizeof(ending), "slot%u", slot);
	err = dump_open(dump, ending, &file);
	if (err)
		return err;
	return dump_close(file, dump_contents(file, dump->buffer[slot], words));
}

static int dump_slots(struct dump_job *dump)
{
	uint32_t *words = malloc(DUMP_CHUNK_WORDS * sizeof(*words));
	int err = words ? 0 : -ENOMEM;

	for (unsigned int i = 0; i < dump->job->slots && !err; i++)
		err = dump_slot(dump, i, words);
	free(words);
	return err;
}

static void dump_files(struct dump_job *dump)
{
	int err = dump_text(dump);

	if (!err)
		err = dump_stream(dump);
	if (!err)
		err = dump_slots(dump);
	if (!err || atomic_exchange(&dump->device->dump->failed, true))
		return;
	accel_device_message(dump->device,
			     "ACCEL_DUMP: %s: %s; no more jobs of this device are "
			     "written: name a folder that can be written to and has room",
			     dump->path, strerror(-err));
}

void accel_dump_job(struct accel_device *device, const struct accel_transport_job *job,
		    struct accel_buffer *const *buffer)
{
	int held;

	if (!device->dump || atomic_load(&device->dump->failed) ||
	    accel_device_is_inherited(device))
		return;
	held = accel_thread_hold_cancel();
	dump_files(&(struct dump_job){
		.device = device,
		.job = job,
		.buffer = buffer,
		.number = atomic_fetch_add(&dump_jobs, 1) + 1,
	});
	accel_thread_allow_cancel(held);
}
