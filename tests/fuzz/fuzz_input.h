/* SPDX-License-Identifier: MIT */
/*
 * A job as bytes, for the fuzzer: a head that any bytes are right for, then the
 * words of the stream, little-endian.
 *
 *   0        bit 0: the tile has 64 pixels, else 32
 *   1 to 3   room in the response, words, FUZZ_ROOM_MASK
 *   4 on     for each slot: page of its base; bits 9:2 and 17:10 of its size;
 *            bits 1:0 of its size in bits 3:2 of a byte, its rights in bits 1:0
 */
#ifndef TESTS_FUZZ_INPUT_H
#define TESTS_FUZZ_INPUT_H

#include "job.h"
#include "stream_random.h"

#define FUZZ_SLOT_BYTES 4
#define FUZZ_HEAD_BYTES (4 + FUZZ_SLOT_BYTES * GLOSS_SLOTS)
#define FUZZ_ROOM_MASK 0x1ffffu
#define FUZZ_PAGE 4096u
#define FUZZ_MEMORY STREAM_RANDOM_MEMORY

#endif
