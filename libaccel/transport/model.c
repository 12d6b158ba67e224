// SPDX-License-Identifier: MIT
/* "model:": the C model of the core, on threads of this process. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include "transport/engine.h"
#include "model/model.h"
#include "transport/option.h"
#include "transport/thread.h"
#include "transport/tile_threads.h"

struct transport_model {
	struct accel_engine engine; /* first, see engine.h */
	struct model model;
	unsigned int threads; /* that draw tiles */
	struct accel_tile_threads tile_threads;
};

static int transport_model_run(void *data, const struct accel_job *job, struct gloss_status *status)
{
	struct transport_model *transport = data;

	if (transport->threads == 1)
		return model_run(&transport->model, job, status);
	return model_run_parallel(&transport->model, job, &accel_tile_drawer,
				  &transport->tile_threads, status);
}

static int transport_model_open(const char *where, void **state,
				struct accel_transport_error *error)
{
	uint64_t tile = 64, memory = ENGINE_MEMORY_DEFAULT, threads = accel_thread_processors();
	const struct accel_option options[] = {
		{ "tile", 32, 64, 0, &tile },
		{ "memory", ACCEL_RANGE_ALIGN, ENGINE_MEMORY_MAX, ACCEL_RANGE_ALIGN, &memory },
		{ "threads", 1, ACCEL_THREADS_MAX, 1, &threads },
		{ NULL, 0, 0, 0, NULL },
	};
	struct transport_model *transport;
	int err;

	err = accel_option_parse(where, options, error);
	if (err)
		return err;
	transport = malloc(sizeof(*transport));
	if (!transport)
		return -ENOMEM;
	err = accel_engine_init(&transport->engine, memory, transport_model_run, transport);
	if (err)
		goto err_free;
	err = model_init(&transport->model, (int)tile, transport->engine.memory, memory);
	if (err)
		goto err_engine_fini;
	accel_tile_threads_init(&transport->tile_threads, (unsigned int)threads, (int)tile,
				transport->engine.memory, memory);
	transport->threads = (unsigned int)threads;
	*state = transport;
	return 0;

err_engine_fini:
	accel_engine_fini(&transport->engine);
err_free:
	free(transport);
	return err;
}

static int transport_model_list(accel_device_list_fn found, void *data)
{
	found(data, "model:", "C model, in this process");
	return 0;
}

static void transport_model_close(void *state)
{
	struct transport_model *transport = state;

	accel_engine_fini(&transport->engine);
	accel_tile_threads_fini(&transport->tile_threads);
	free(transport);
}

static void transport_model_info(void *state, struct accel_transport_info *info)
{
	const struct transport_model *transport = state;

	*info = (struct accel_transport_info){
		.version = GLOSS_VERSION,
		.tile_size = (uint32_t)transport->model.tile_size,
		.pixels_per_clock = 1,
		.memory_size = transport->engine.memory_size,
		.threads = transport->threads,
	};
	snprintf(info->name, sizeof(info->name), "C model, %u-pixel tiles", info->tile_size);
}

const struct accel_transport_ops accel_transport_model = {
	.scheme = "model",
	.memory_keeps = true,
	.open = transport_model_open,
	.list = transport_model_list,
	.close = transport_model_close,
	.info = transport_model_info,
	.memory_new = accel_engine_memory_new,
	.memory_free = accel_engine_memory_free,
	.wait_for_room = accel_engine_wait_for_room,
	.submit = accel_engine_submit,
	.wait = accel_engine_wait,
};
