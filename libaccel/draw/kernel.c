// SPDX-License-Identifier: MIT
/* Which of the sets of instructions that the loops are compiled for this processor has. */
#include <stdatomic.h>

#include "draw/kernel.h"

const struct accel_kernel *const accel_kernels[] = {
	&accel_kernel_baseline,
#ifdef __x86_64__
	&accel_kernel_avx2,
	&accel_kernel_avx512,
#endif
	NULL,
};

/* Threads that choose at the same time choose the same. */
static _Atomic(const struct accel_kernel *) chosen;

static const struct accel_kernel *kernel_choose(void)
{
	const struct accel_kernel *best = &accel_kernel_baseline;

	for (const struct accel_kernel *const *kernel = accel_kernels; *kernel; kernel++)
		if ((*kernel)->runs())
			best = *kernel;
	return best;
}

const struct accel_kernel *accel_kernel(void)
{
	const struct accel_kernel *kernel = atomic_load_explicit(&chosen, memory_order_acquire);

	if (!kernel) {
		kernel = kernel_choose();
		atomic_store_explicit(&chosen, kernel, memory_order_release);
	}
	return kernel;
}

void accel_kernel_set(const struct accel_kernel *kernel)
{
	atomic_store_explicit(&chosen, kernel, memory_order_release);
}
