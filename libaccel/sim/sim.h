/* SPDX-License-Identifier: MIT */
/*
 * What a simulator plugin offers: the Verilated core with a memory behind it.
 * A plugin is a shared object accel-sim-t<tile>-k<lanes>.so with one exported
 * symbol, gloss_sim. transport/plugin.c and the stream tests load it with dlopen,
 * so that nothing else links C++.
 *
 * A simulator is used by one thread at a time; different ones at once.
 */
#ifndef ACCEL_SIM_H
#define ACCEL_SIM_H

#include <stdint.h>

#include "job.h"

#define GLOSS_SIM_ABI 1
#define GLOSS_SIM_SYMBOL "gloss_sim"

/* Clocks without a transfer: many times what the longest run of pixels takes. */
#define GLOSS_SIM_QUIET (1u << 17)

struct gloss_sim;

/* Where the clocks of a job went, as time_counters_t in rtl/gloss_pkg.sv. */
struct gloss_sim_clocks {
	uint64_t clocks, stall_stream, stall_raster, stall_tile, stall_memory, stall_response;
};

struct gloss_sim_ops {
	uint32_t abi;     /* GLOSS_SIM_ABI */
	uint32_t version; /* GLOSS_VERSION the core was built from */
	uint32_t tile_size, pixels_per_clock, stream_bits;

	/*
	 * A core behind @memory of @size bytes (a multiple of 4096), which stays
	 * the caller's and must outlive the simulator. NULL: out of memory.
	 */
	struct gloss_sim *(*create)(void *memory, uint64_t size);
	void (*destroy)(struct gloss_sim *sim);

	/*
	 * From the next job on: @seed 0, ports always ready and a memory of fixed
	 * latency; else random stalls on every port and random latency, @seed
	 * deciding them. A new simulator behaves as after seed 0.
	 */
	void (*stalls)(struct gloss_sim *sim, uint64_t seed);

	/*
	 * Runs a job to its end. @clocks may be NULL.
	 * -ETIME: it did not end in @limit clocks, or nothing moved at any port for
	 * GLOSS_SIM_QUIET of them; -EPROTO: the core broke the rules of a port, see
	 * violation. After either the core was reset, and takes the next job.
	 */
	int (*run)(struct gloss_sim *sim, const struct accel_job *job, uint64_t limit,
		   struct gloss_status *status, struct gloss_sim_clocks *clocks);

	/* The rule that the last run's -EPROTO was about. */
	const char *(*violation)(const struct gloss_sim *sim);
};

#endif
