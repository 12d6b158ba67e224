// SPDX-License-Identifier: MIT
/*
 * Random jobs through the library and libusb end as on "model:", on the board with the C model,
 * and fewer on the Verilated one.
 */
#include "vm_stream.h"
#include "vm_test.h"

#define JOBS 400
#define JOBS_RTL 24

int main(void)
{
	uint64_t seed = vm_seed();

	vm_stream_test(vm_env("GLOSS_USB_MODEL"), JOBS, seed);
	vm_stream_test(vm_env("GLOSS_USB_RTL"), JOBS_RTL, seed + 1);
	return VM_PASS;
}
