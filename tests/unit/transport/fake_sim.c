/* SPDX-License-Identifier: MIT */
/* A plugin without a core, for test_transport_sim.c: what it is comes from the build. */
#include <errno.h>
#include <stdlib.h>

#include "sim/sim.h"

#ifndef FAKE_ABI
#define FAKE_ABI GLOSS_SIM_ABI
#endif
#ifndef FAKE_VERSION
#define FAKE_VERSION GLOSS_VERSION
#endif
#ifndef FAKE_LANES
#define FAKE_LANES 1
#endif

struct gloss_sim {
	uint64_t seed;
};

static struct gloss_sim *fake_create(void *memory, uint64_t size)
{
	(void)memory;
	return size == 8192 ? NULL : calloc(1, sizeof(struct gloss_sim));
}

static void fake_destroy(struct gloss_sim *sim)
{
	free(sim);
}

static void fake_stalls(struct gloss_sim *sim, uint64_t seed)
{
	sim->seed = seed;
}

/* Fails as the stream's first word says; else answers with the limit and the seed. */
static int fake_run(struct gloss_sim *sim, const struct accel_job *job, uint64_t limit,
		    struct gloss_status *status, struct gloss_sim_clocks *clocks)
{
	if (job->stream[0])
		return -(int)job->stream[0];
	job->response[0] = (uint32_t)limit;
	job->response[1] = (uint32_t)sim->seed;
	*status = (struct gloss_status){ .offset = job->stream_words, .response_words = 2 };
	*clocks = (struct gloss_sim_clocks){ 1, 20, 300, 4000, 50000, 600000 };
	return 0;
}

static const char *fake_violation(const struct gloss_sim *sim)
{
	(void)sim;
	return "none";
}

extern const struct gloss_sim_ops FAKE_SYMBOL;
const struct gloss_sim_ops FAKE_SYMBOL = {
	.abi = FAKE_ABI,
	.version = FAKE_VERSION,
	.tile_size = 64,
	.pixels_per_clock = FAKE_LANES,
	.stream_bits = 32,
	.create = fake_create,
	.destroy = fake_destroy,
	.stalls = fake_stalls,
	.run = fake_run,
	.violation = fake_violation,
};
