/* SPDX-License-Identifier: MIT */
/* Jobs as files, where the environment asks for them; dump.c says which. */
#ifndef ACCEL_DUMP_H
#define ACCEL_DUMP_H

#include "accel.h"
#include "transport/transport.h"

struct accel_dump;

/* *@dump is NULL if nothing asks for files. -ENOMEM. */
int accel_dump_new(struct accel_dump **dump);
void accel_dump_free(struct accel_dump *dump);

/*
 * Writes the files of @job, which is about to be sent, and of whose slots @buffer is the list, if
 * @device has a dump. Called without the device's lock; waits for the jobs before it.
 */
void accel_dump_job(struct accel_device *device, const struct accel_transport_job *job,
		    struct accel_buffer *const *buffer);

#endif
