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

/* Structs in host memory: indices of words, masks of narrow fields. */

/* In host memory. */
#define SMALL_ENTRY_WORDS 2
#define SMALL_ENTRY_LOW_WORD 0
/* Narrow. */
#define SMALL_ENTRY_HIGH_WORD 1
#define SMALL_ENTRY_HIGH 0x000000ffu

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
