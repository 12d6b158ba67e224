// SPDX-License-Identifier: MIT
/* The loops for x86-64 with AVX-512; draw.mk has the compiler's options. */
#ifdef __x86_64__
#include "draw/kernel.h"

static bool kernel_runs(void)
{
	return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
	       __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}

#define KERNEL accel_kernel_avx512
#define KERNEL_NAME "avx512"
#include "draw/kernel_loops.h"
#else
/* No translation unit may be empty. */
typedef int accel_kernel_avx512;
#endif
