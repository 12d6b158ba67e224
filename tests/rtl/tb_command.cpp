// SPDX-License-Identifier: MIT
/*
 * command against the model's checks: random streams, right and damaged, with random stalls on
 * every port. What must come out of each port is worked out from the stream and
 * model_command_check alone; a fault must be the same at the same word, and nothing of the faulty
 * packet may come out. TILE, LANES and STREAM are the module's parameters.
 */
#include "command_bench.h"
#include "command_stream.h"

static void streams_match_model(CommandBench &bench, int count)
{
	unsigned int faults[8] = {};

	for (int n = 0; n < count; n++) {
		CommandStream stream(bench.random, TILE);
		Expected expected;
		Walker walker(stream.job, expected);
		gloss_status status = bench.run(stream.job, expected);

		TB_CHECK(status.cause == expected.status.cause &&
			 status.offset == expected.status.offset &&
			 status.response_words == expected.status.response_words,
			 "stream %d of %u words: fault %u at %u, %u answered, not %u at %u, %u", n,
			 stream.job.stream_words, status.cause, status.offset, status.response_words,
			 expected.status.cause, expected.status.offset,
			 expected.status.response_words);
		faults[status.cause]++;
	}
	printf("tb_command: ended %u, faults", faults[0]);
	for (int n = 1; n < 7; n++)
		printf(" %u", faults[n]);
	printf("\n");
	for (int n = 0; n < 7; n++)
		TB_CHECK(faults[n], "no stream had fault %d", n);
}

/* An error of board memory may be seen late, but the job ends, with a tile open or not. */
static void memory_error_ends_job(CommandBench &bench)
{
	unsigned int seen = 0;

	bench.spoil = true;
	for (int n = 0; n < 500; n++) {
		CommandStream stream(bench.random, TILE);
		Expected expected;
		Walker walker(stream.job, expected);
		gloss_status status = bench.run(stream.job, expected);

		seen += status.cause == GLOSS_FAULT_MEMORY;
		TB_CHECK(status.cause == GLOSS_FAULT_MEMORY || status.cause == expected.status.cause,
			 "fault %u instead of MEMORY or %u", status.cause, expected.status.cause);
		TB_CHECK(status.offset <= stream.job.stream_words, "offset %u of %u", status.offset,
			 stream.job.stream_words);
	}
	bench.spoil = false;
	TB_CHECK(seen > 100, "MEMORY was seen %u times", seen);
}

/* Clocks of a record of zeros, which is right, one behind the other. */
static double record_clocks(CommandBench &bench, uint32_t header)
{
	const unsigned int count = 200, length = 1 + gloss_header_length(header);
	std::vector<uint32_t> words = { GLOSS_OP_TILE_BEGIN << 24 | 2, 0, 0 };
	accel_job job = {};
	Expected expected;

	for (unsigned int n = 0; n < count; n++) {
		words.resize(words.size() + length);
		words[words.size() - length] = header;
	}
	words.insert(words.end(), { GLOSS_OP_TILE_END << 24 | 2u, 0, 0 });
	job.stream = words.data();
	job.stream_words = words.size();
	Walker walker(job, expected);
	bench.stalls = false;
	bench.run(job, expected);
	bench.stalls = true;
	return (double)(bench.record_clocks[1] - bench.record_clocks[0]) / (count - 1);
}

/* A row of words a clock, parts padded to rows; the last one waits for TILE_END. */
static void record_rate(CommandBench &bench, const char *name, uint32_t header,
			std::vector<unsigned int> parts)
{
	double rate = record_clocks(bench, header), best = 0.1;

	for (unsigned int part : parts)
		best += (part + ROW - 1) / ROW;
	printf("tb_command: %.2f clocks a %s second-order record\n", rate, name);
	TB_CHECK(rate <= best, "%.2f clocks instead of %.1f", rate, best);
}

static void records_take_a_clock_a_row(CommandBench &bench)
{
	gloss_triangle compact = { GLOSS_GEOMETRY_COMPACT, GLOSS_SHADING_SECOND_ORDER, false, 0 };
	gloss_triangle_small small = { GLOSS_SHADING_SECOND_ORDER, GLOSS_ROW_WORDS_ONE, 0 };
	uint32_t header;

	gloss_triangle_pack(&header, &compact);
	record_rate(bench, "compact", header, { 1, 6, 3, 18 });
	gloss_triangle_small_pack(&header, &small);
	record_rate(bench, "small", header, { 4, 7, 1 });
}

int main(int argc, char **argv)
{
	CommandBench bench(tb_seed());

	streams_match_model(bench, argc > 1 ? atoi(argv[1]) : 4000);
	memory_error_ends_job(bench);
	records_take_a_clock_a_row(bench);
	printf("tb_command: T=%d K=%d S=%d passed, %" PRIu64 " clocks\n", TILE, LANES, STREAM,
	       bench.clocks);
	return 0;
}
