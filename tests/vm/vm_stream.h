/* SPDX-License-Identifier: MIT */
#ifndef VM_STREAM_H
#define VM_STREAM_H

#include <stdint.h>

/*
 * Random jobs, valid and damaged, through the library, several threads at once, on the device
 * called @board and on "model:": status, answers and what is left in every slot are the same, byte
 * for byte, or the program fails. @jobs of all threads together.
 */
void vm_stream_test(const char *board, int jobs, uint64_t seed);

#endif
