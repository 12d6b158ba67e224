// SPDX-License-Identifier: MIT
/* "sim:": the Verilated core, from a plugin (sim.h), on a thread of this process. */
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include "transport/engine.h"
#include "transport/option.h"
#include "transport/plugin.h"
#include "sim/sim.h"

/* How many times what a packet should take at most before the job counts as hung: a memory
 * that stalls nearly always is in it. */
#define PATIENCE 64
#define JOB_CLOCKS 4096

struct transport_sim {
	struct accel_engine engine; /* first, see engine.h */
	struct accel_plugin plugin;
	const struct gloss_sim_ops *ops; /* of it */
	struct gloss_sim *sim;
	pthread_mutex_t lock; /* protects clocks */
	struct accel_device_clocks clocks;
};

/* ---- running a job ---- */

/* What a packet at most takes at one pixel and one word a clock. */
static uint64_t sim_packet_clocks(const uint32_t *packet, uint64_t words, uint64_t tile)
{
	struct gloss_read_memory read;

	switch (gloss_header_opcode(packet[0])) {
	case GLOSS_OP_TILE_BEGIN:
	case GLOSS_OP_TILE_END:
		return 2 * tile * tile;
	case GLOSS_OP_TRIANGLE:
	case GLOSS_OP_TRIANGLE_SMALL:
		return tile * tile;
	case GLOSS_OP_READ_MEMORY:
		if (words <= GLOSS_READ_MEMORY_WORDS)
			return 0;
		gloss_read_memory_unpack(packet, &read);
		return read.count;
	default:
		return 0;
	}
}

/* A core that takes longer hangs. */
static uint64_t sim_limit(const struct accel_job *job, uint64_t tile)
{
	uint64_t at = 0, clocks = JOB_CLOCKS + (uint64_t)job->stream_words;

	while (at < job->stream_words) {
		clocks += sim_packet_clocks(job->stream + at, job->stream_words - at, tile);
		at += 1 + gloss_header_length(job->stream[at]);
	}
	return PATIENCE * clocks;
}

static void sim_add_clocks(struct transport_sim *transport, const struct gloss_sim_clocks *job)
{
	struct accel_device_clocks *sum = &transport->clocks;

	pthread_mutex_lock(&transport->lock);
	sum->clocks += job->clocks;
	sum->stall_stream += job->stall_stream;
	sum->stall_raster += job->stall_raster;
	sum->stall_tile += job->stall_tile;
	sum->stall_memory += job->stall_memory;
	sum->stall_response += job->stall_response;
	pthread_mutex_unlock(&transport->lock);
}

static int sim_run(void *data, const struct accel_job *job, struct gloss_status *status)
{
	struct transport_sim *transport = data;
	struct gloss_sim_clocks clocks;
	int err;

	err = transport->ops->run(transport->sim, job, sim_limit(job, transport->ops->tile_size),
				  status, &clocks);
	if (!err)
		sim_add_clocks(transport, &clocks);
	return err;
}

/* ---- the transport ---- */

static const struct accel_plugin_kind sim_plugin = {
	.name = "accel-sim",
	.symbol = GLOSS_SIM_SYMBOL,
	.abi = GLOSS_SIM_ABI,
	.what = "simulator",
	.who = "library",
};

struct sim_options {
	uint64_t tile, lanes, memory, stalls;
};

static int sim_parse(const char *where, struct sim_options *to, struct accel_transport_error *error)
{
	const struct accel_option options[] = {
		{ "tile", 32, 64, 0, &to->tile },
		{ "lanes", 1, 8, 0, &to->lanes },
		{ "memory", ACCEL_RANGE_ALIGN, ENGINE_MEMORY_MAX, ACCEL_RANGE_ALIGN, &to->memory },
		{ "stalls", 0, UINT64_MAX, 1, &to->stalls },
		{ NULL, 0, 0, 0, NULL },
	};

	*to = (struct sim_options){ .tile = 64, .lanes = 8, .memory = ENGINE_MEMORY_DEFAULT };
	return accel_option_parse(where, options, error);
}

static int sim_load(struct accel_plugin *plugin, const struct sim_options *options,
		    struct accel_transport_error *error)
{
	return accel_plugin_open(plugin, &sim_plugin, (uint32_t)options->tile,
				 (uint32_t)options->lanes, error);
}

static int transport_sim_open(const char *where, void **state, struct accel_transport_error *error)
{
	struct transport_sim *transport;
	struct sim_options options;
	int err;

	err = sim_parse(where, &options, error);
	if (err)
		return err;
	transport = calloc(1, sizeof(*transport));
	if (!transport)
		return -ENOMEM;
	err = sim_load(&transport->plugin, &options, error);
	if (err)
		goto err_free;
	transport->ops = transport->plugin.ops;
	err = accel_engine_init(&transport->engine, options.memory, sim_run, transport);
	if (err)
		goto err_unload;
	transport->sim = transport->ops->create(transport->engine.memory, options.memory);
	if (!transport->sim) {
		err = -ENOMEM;
		goto err_engine_fini;
	}
	transport->ops->stalls(transport->sim, options.stalls);
	pthread_mutex_init(&transport->lock, NULL);
	*state = transport;
	return 0;

err_engine_fini:
	accel_engine_fini(&transport->engine);
err_unload:
	dlclose(transport->plugin.handle);
err_free:
	free(transport);
	return err;
}

static int transport_sim_list(accel_device_list_fn found, void *data)
{
	struct accel_transport_error error = { "" };
	struct accel_plugin plugin;
	struct sim_options options;
	int err = sim_parse("", &options, &error);

	if (!err)
		err = sim_load(&plugin, &options, &error);
	if (!err)
		dlclose(plugin.handle);
	found(data, "sim:", err ? error.text : "Verilated core, in this process");
	return 0;
}

static void transport_sim_close(void *state)
{
	struct transport_sim *transport = state;

	transport->ops->destroy(transport->sim);
	accel_engine_fini(&transport->engine);
	dlclose(transport->plugin.handle);
	pthread_mutex_destroy(&transport->lock);
	free(transport);
}

static void transport_sim_info(void *state, struct accel_transport_info *info)
{
	const struct transport_sim *transport = state;

	*info = (struct accel_transport_info){
		.version = transport->ops->version,
		.tile_size = transport->ops->tile_size,
		.pixels_per_clock = transport->ops->pixels_per_clock,
		.memory_size = transport->engine.memory_size,
	};
	snprintf(info->name, sizeof(info->name), "Verilated core, %u-pixel tiles, %u lanes",
		 info->tile_size, info->pixels_per_clock);
}

static int transport_sim_clocks(void *state, struct accel_device_clocks *clocks)
{
	struct transport_sim *transport = state;

	pthread_mutex_lock(&transport->lock);
	*clocks = transport->clocks;
	pthread_mutex_unlock(&transport->lock);
	return 0;
}

const struct accel_transport_ops accel_transport_sim = {
	.scheme = "sim",
	.memory_keeps = true,
	.open = transport_sim_open,
	.list = transport_sim_list,
	.close = transport_sim_close,
	.info = transport_sim_info,
	.memory_new = accel_engine_memory_new,
	.memory_free = accel_engine_memory_free,
	.wait_for_room = accel_engine_wait_for_room,
	.submit = accel_engine_submit,
	.wait = accel_engine_wait,
	.clocks = transport_sim_clocks,
};
