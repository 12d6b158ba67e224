/* SPDX-License-Identifier: MIT */
/*
 * What a board says on IN, as bytes: how long the pieces are that it comes in, the room in each
 * job's response, which completions have the checksum that their words say (bit n: that of job n;
 * the others have the right one, which is not to be guessed), then words, little-endian.
 */
#ifndef FUZZ_USB_MESSAGE_INPUT_H
#define FUZZ_USB_MESSAGE_INPUT_H

#define FUZZ_MESSAGE_JOBS 4u /* their sequences begin with 0 */
#define FUZZ_MESSAGE_HEAD_BYTES (2 + FUZZ_MESSAGE_JOBS)
#define FUZZ_MESSAGE_ROOM 2u /* words that a byte of room is */
#define FUZZ_MESSAGE_STREAM_WORDS 100u
#define FUZZ_MESSAGE_NONCE 0x31415927u

#endif
