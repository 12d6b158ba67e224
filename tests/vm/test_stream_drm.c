// SPDX-License-Identifier: MIT
/*
 * Random jobs through the library and the driver end as on "model:", on the board with the C
 * model, and fewer on the Verilated one.
 */
#include "vm_stream.h"
#include "vm_test.h"

#define JOBS 400
#define JOBS_RTL 24

static void test_board(const char *variable, int jobs, uint64_t seed)
{
	char name[256];

	snprintf(name, sizeof(name), "drm:%s", vm_env(variable));
	vm_stream_test(name, jobs, seed);
}

int main(void)
{
	uint64_t seed = vm_seed();

	test_board("GLOSS_NODE_MODEL", JOBS, seed);
	test_board("GLOSS_NODE_RTL", JOBS_RTL, seed + 1);
	return VM_PASS;
}
