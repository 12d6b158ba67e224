// SPDX-License-Identifier: MIT
/* The loops for x86-64 with AVX2; draw.mk has the compiler's options. */
#ifdef __x86_64__
#include "draw/kernel.h"

static bool kernel_runs(void)
{
	return __builtin_cpu_supports("avx2");
}

#define KERNEL accel_kernel_avx2
#define KERNEL_NAME "avx2"
#include "draw/kernel_loops.h"
#else
/* No translation unit may be empty. */
typedef int accel_kernel_avx2;
#endif
