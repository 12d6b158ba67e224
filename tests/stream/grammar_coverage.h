/* SPDX-License-Identifier: MIT */
/* What of rtl/gloss.xml the jobs of a run have reached. */
#ifndef TESTS_STREAM_GRAMMAR_COVERAGE_H
#define TESTS_STREAM_GRAMMAR_COVERAGE_H

#include "grammar.h"

#define COVERAGE_PACKETS 32
#define COVERAGE_FIELDS 8

struct grammar_coverage {
	uint64_t jobs[GRAMMAR_KINDS];
	uint64_t faults[GLOSS_FAULT_DMA + 1];
	uint64_t packets[COVERAGE_PACKETS]; /* executed */
	uint32_t values[COVERAGE_PACKETS]
		       [COVERAGE_FIELDS]; /* of their enums and flags, a bit each */
	uint32_t parts[COVERAGE_PACKETS]; /* executed, a bit each */
	uint64_t opcodes, reserved;       /* turns of each that were taken */
};

void grammar_coverage_add(struct grammar_coverage *coverage, const struct grammar *g,
			  const struct gloss_status *status);
void grammar_coverage_print(const struct grammar_coverage *coverage);
/* Was everything reached? Prints what was not. */
bool grammar_coverage_check(const struct grammar_coverage *coverage);

#endif
