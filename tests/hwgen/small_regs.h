/* SPDX-License-Identifier: MIT */
/* Generated from rtl/small.xml by tools/hwgen; do not edit. */
#ifndef SMALL_REGS_H
#define SMALL_REGS_H

/* In both headers. */
#define SMALL_MAGIC 0xcafeu

/* Registers: byte offsets, masks of fields. */

/* Named as the struct is. */
#define SMALL_REG_STATE 0x004
#define SMALL_REG_STATE_POWER 0xf0000000u
#define SMALL_REG_STATE_COLOUR 0x00000003u
/* Has no fields. Comes second. */
#define SMALL_REG_COUNT 0x000
#define SMALL_REG_TOP 0xfffc

/* Structs: indices of words, masks of narrow fields. */

/* In host memory. */
#define SMALL_ENTRY_WORDS 2
#define SMALL_ENTRY_LOW_WORD 0
/* Narrow. */
#define SMALL_ENTRY_HIGH_WORD 1
#define SMALL_ENTRY_HIGH 0x000000ffu

/* ---- bus wire ---- */

#define SMALL_WIRE_PINS 4u

/* Registers: byte offsets, masks of fields. */

/* Only on this bus. */
#define SMALL_REG_WIRE_SPEED 0x010
#define SMALL_REG_WIRE_SPEED_FAST 0x00000001u

/* Structs: indices of words, masks of narrow fields. */

#define SMALL_MESSAGE_WORDS 1
#define SMALL_MESSAGE_SIZE_WORD 0
#define SMALL_MESSAGE_SIZE 0x000000ffu

/* ---- bus bare ---- */

/* ---- bus air ---- */

/* Structs: indices of words, masks of narrow fields. */

#define SMALL_WAVE_WORDS 1
/* As wide as a word. */
#define SMALL_WAVE_LENGTH_WORD 0

static inline const char *small_colour_name(unsigned int colour)
{
	switch (colour) {
	case 0:
		return "red";
	case 1:
		return "green";
	case 2:
		return "blue";
	case 3:
		return "white";
	default:
		return "unknown";
	}
}

static inline const char *small_power_name(unsigned int power)
{
	switch (power) {
	case 1:
		return "one";
	case 2:
		return "two";
	case 8:
		return "eight";
	default:
		return "unknown";
	}
}

#endif
