// SPDX-License-Identifier: MIT
/* The loops for any processor that the program runs on. */
#include "draw/kernel.h"

static bool kernel_runs(void)
{
	return true;
}

#define KERNEL accel_kernel_baseline
#define KERNEL_NAME "baseline"
#include "draw/kernel_loops.h"
