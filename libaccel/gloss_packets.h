/* SPDX-License-Identifier: MIT */
/* Generated from rtl/gloss.xml by tools/hwgen; do not edit. */
#ifndef GLOSS_PACKETS_H
#define GLOSS_PACKETS_H

#include <stdbool.h>
#include <stdint.h>

/* Response words of COUNTERS. */
#define GLOSS_COUNTER_WORDS 4u
/* Fraction bits of colour coefficients (s10.22). */
#define GLOSS_COLOUR_FRACTION 22u
/* Fraction bits of depth coefficients in the core (s28.12). */
#define GLOSS_DEPTH_FRACTION 12u
/* A compact depth coefficient (s26.6) is shifted left by this. */
#define GLOSS_DEPTH_COMPACT_SHIFT 6u
/* A small record's depth (s28.4) is shifted left by this. */
#define GLOSS_SMALL_DEPTH_SHIFT 8u
/* And its differences by this for each step of scale. */
#define GLOSS_SMALL_DEPTH_SCALE_SHIFT 4u
/* A small record's colours (s10.8) and first differences are shifted left by this. */
#define GLOSS_SMALL_SLOPE_SHIFT 14u
/* First differences by this more for each step of slope_scale. */
#define GLOSS_SMALL_SLOPE_SCALE_SHIFT 2u
/* A small record's second differences are shifted left by this. */
#define GLOSS_SMALL_BEND_SHIFT 10u
/* And by this more for each step of their scale. */
#define GLOSS_SMALL_BEND_SCALE_SHIFT 3u
/* Rows of a small record that pixels_small has. */
#define GLOSS_SMALL_HEAD_ROWS 2u
/* Rows of a small record in each word behind its colour. */
#define GLOSS_SMALL_WORD_ROWS 4u
/* The anchor of a triangle's coefficients is at a multiple of this in x. */
#define GLOSS_ANCHOR_ALIGN 8u
/* Version of this interface; a board reports it. */
#define GLOSS_VERSION 1u
/* "GLOS" in memory; what IDENTITY reads. */
#define GLOSS_IDENTITY 0x534f4c47u
/* Entries of the slot table. */
#define GLOSS_SLOTS 16u
/* Pages of board memory, and of host memory that lists name. */
#define GLOSS_PAGE_BYTES 4096u
/* Logarithm to base 2 of the most entries of a job ring. */
#define GLOSS_RING_MAX_LOG2 8u
#define GLOSS_USB_VENDOR 0x1209u
#define GLOSS_USB_PRODUCT 0x1u
/* Of interface 0, whose class is ff. */
#define GLOSS_USB_SUBCLASS 0x47u
#define GLOSS_USB_PROTOCOL 1u
/* Bulk: the OUT channel. */
#define GLOSS_USB_ENDPOINT_OUT 0x1u
/* Bulk: the IN channel. */
#define GLOSS_USB_ENDPOINT_IN 0x81u
/* Interrupt: a usb_event in 8 bytes. */
#define GLOSS_USB_ENDPOINT_EVENT 0x82u
/* Request: wValue is the offset, 4 bytes in. */
#define GLOSS_USB_READ_REGISTER 1u
/* Request: wValue is the offset, 4 bytes out. */
#define GLOSS_USB_WRITE_REGISTER 2u
/* Words of a response chunk, the last of a job apart. */
#define GLOSS_USB_CHUNK_WORDS 256u
/* "SYNC" in memory. */
#define GLOSS_USB_SYNC_MAGIC 0x434e5953u
/* "JOB" in memory. */
#define GLOSS_USB_JOB_MAGIC 0x424f4au
/* "RS" in memory. */
#define GLOSS_USB_RESPONSE_MAGIC 0x5352u
/* "CD" in memory. */
#define GLOSS_USB_COMPLETION_MAGIC 0x4443u
/* "EV" in memory. */
#define GLOSS_USB_EVENT_MAGIC 0x5645u

/* Why a job stopped. */
enum gloss_fault {
	/* The job was executed to its end. */
	GLOSS_FAULT_NONE = 0,
	/* Unknown opcode. */
	GLOSS_FAULT_OPCODE = 1,
	/* Payload length wrong for the opcode, or past the end of the stream. */
	GLOSS_FAULT_LENGTH = 2,
	/* A field out of range, a reserved bit set, or an offset not aligned. */
	GLOSS_FAULT_VALUE = 3,
	/*
	 * A packet not allowed here, a surface used before it was set, or the stream ends inside a
	 * tile.
	 */
	GLOSS_FAULT_ORDER = 4,
	/* An access without the right, or outside the slot. */
	GLOSS_FAULT_SLOT = 5,
	/* The response buffer is too small. */
	GLOSS_FAULT_RESPONSE = 6,
	/* Board memory answered with an error. */
	GLOSS_FAULT_MEMORY = 7,
	/*
	 * The host refused a DMA access: the port's, never a stream's fault. The board has stopped.
	 */
	GLOSS_FAULT_DMA = 8,
};

/* Depth function: the fragment's depth compared with the stored one. */
enum gloss_compare {
	GLOSS_COMPARE_NEVER = 0,
	GLOSS_COMPARE_LESS = 1,
	GLOSS_COMPARE_EQUAL = 2,
	GLOSS_COMPARE_LEQUAL = 3,
	GLOSS_COMPARE_GREATER = 4,
	GLOSS_COMPARE_NOTEQUAL = 5,
	GLOSS_COMPARE_GEQUAL = 6,
	GLOSS_COMPARE_ALWAYS = 7,
};

/* Form of a triangle's edges and depth plane. */
enum gloss_geometry {
	/* Any triangle. */
	GLOSS_GEOMETRY_WIDE = 0,
	/* At most 63 pixels wide and high. */
	GLOSS_GEOMETRY_COMPACT = 1,
	/* Covers the whole tile: no edges are sent; row 0 to T-1, x 0 to T-1. */
	GLOSS_GEOMETRY_COVERING = 2,
};

/* Order of the colour surfaces of a triangle. */
enum gloss_shading {
	GLOSS_SHADING_FLAT = 0,
	GLOSS_SHADING_LINEAR = 1,
	GLOSS_SHADING_SECOND_ORDER = 2,
};

/* Words of rows behind the colour of a small record. */
enum gloss_row_words {
	/* At most 2 rows. */
	GLOSS_ROW_WORDS_NONE = 0,
	/* At most 6 rows. */
	GLOSS_ROW_WORDS_ONE = 1,
	/* At most 10 rows. */
	GLOSS_ROW_WORDS_TWO = 2,
	/* At most 14 rows. */
	GLOSS_ROW_WORDS_THREE = 3,
	/* At most 16 rows. */
	GLOSS_ROW_WORDS_FOUR = 4,
};

/* What becomes of a tile's colour or depth at its end. */
enum gloss_tile_output {
	GLOSS_TILE_OUTPUT_DROP = 0,
	/* Stored to the surface at the offset. */
	GLOSS_TILE_OUTPUT_STORE = 1,
	/* Returned in the response stream, T*T words, row by row. */
	GLOSS_TILE_OUTPUT_ANSWER = 2,
};

/* Rights of a slot. */
enum gloss_rights {
	GLOSS_RIGHTS_NONE = 0,
	GLOSS_RIGHTS_READ = 1,
	GLOSS_RIGHTS_WRITE = 2,
	GLOSS_RIGHTS_READ_WRITE = 3,
};

enum gloss_opcode {
	GLOSS_OP_NOP = 0x00,
	GLOSS_OP_WRITE_MEMORY = 0x01,
	GLOSS_OP_READ_MEMORY = 0x02,
	GLOSS_OP_COUNTERS = 0x03,
	GLOSS_OP_COLOUR_SURFACE = 0x08,
	GLOSS_OP_DEPTH_SURFACE = 0x09,
	GLOSS_OP_TILE_BEGIN = 0x10,
	GLOSS_OP_TILE_END = 0x11,
	GLOSS_OP_DEPTH_STATE = 0x20,
	GLOSS_OP_COLOUR_MASK = 0x21,
	GLOSS_OP_SCISSOR = 0x22,
	GLOSS_OP_TRIANGLE = 0x30,
	GLOSS_OP_TRIANGLE_SMALL = 0x32,
};

/* A header: opcode in bits 31:24, payload length in words in bits 10:0,
 * bits 23:11 the packet's own. */
#define GLOSS_LENGTH_MAX 2047u

static inline unsigned int gloss_header_opcode(uint32_t header)
{
	return header >> 24;
}

static inline unsigned int gloss_header_length(uint32_t header)
{
	return header & 0x7ffu;
}

/* ---- edges_wide ---- */

#define GLOSS_EDGES_WIDE_WORDS 9

/*
 * Left, right and middle edge. An edge gives per row the first pixel whose centre is not left of
 * it: x, and the remainder r of the exact division, 0 <= r < dy. To the next row: r += m, x +=
 * step; if r >= dy then r -= dy, x += 1. A row's pixels are left.x <= x < right.x. Before row
 * switch_row (counted from the triangle's first row, 0 is never) the middle edge, as sent, takes
 * the place of the left (side 0) or right (side 1) one. r, m and dy count parts of a pixel, of
 * which dy make one pixel; any unit will do in which all three are whole numbers. Registers wrap: x
 * and step at 13 bits; r, m and dy at 16. A sum wraps before it is compared, so an edge is exact if
 * dy is at most 2^15.
 */
struct gloss_edges_wide {
	int32_t left_x;
	int32_t left_step;
	uint32_t left_r;
	uint32_t left_m;
	uint32_t left_dy;
	/* first_row + last_row at most T-1. */
	uint32_t first_row;
	/* Rows less one. */
	uint32_t last_row;
	int32_t right_x;
	int32_t right_step;
	uint32_t right_r;
	uint32_t right_m;
	uint32_t right_dy;
	uint32_t switch_row;
	uint32_t side;
	int32_t middle_x;
	int32_t middle_step;
	uint32_t middle_r;
	uint32_t middle_m;
	uint32_t middle_dy;
};

static inline void gloss_edges_wide_pack(uint32_t *words, const struct gloss_edges_wide *p)
{
	words[0] = ((uint32_t)p->left_x & 0x1fffu) |
		   ((uint32_t)p->left_step & 0x1fffu) << 16;
	words[1] = (p->left_r & 0xffffu) |
		   (p->left_m & 0xffffu) << 16;
	words[2] = (p->left_dy & 0xffffu) |
		   (p->first_row & 0x3fu) << 16 |
		   (p->last_row & 0x3fu) << 24;
	words[3] = ((uint32_t)p->right_x & 0x1fffu) |
		   ((uint32_t)p->right_step & 0x1fffu) << 16;
	words[4] = (p->right_r & 0xffffu) |
		   (p->right_m & 0xffffu) << 16;
	words[5] = (p->right_dy & 0xffffu) |
		   (p->switch_row & 0x3fu) << 16 |
		   (p->side & 0x1u) << 24;
	words[6] = ((uint32_t)p->middle_x & 0x1fffu) |
		   ((uint32_t)p->middle_step & 0x1fffu) << 16;
	words[7] = (p->middle_r & 0xffffu) |
		   (p->middle_m & 0xffffu) << 16;
	words[8] = p->middle_dy & 0xffffu;
}

static inline void gloss_edges_wide_unpack(const uint32_t *words, struct gloss_edges_wide *p)
{
	p->left_x = (int32_t)(words[0] << 19) >> 19;
	p->left_step = (int32_t)(words[0] << 3) >> 19;
	p->left_r = words[1] & 0xffffu;
	p->left_m = words[1] >> 16;
	p->left_dy = words[2] & 0xffffu;
	p->first_row = words[2] >> 16 & 0x3fu;
	p->last_row = words[2] >> 24 & 0x3fu;
	p->right_x = (int32_t)(words[3] << 19) >> 19;
	p->right_step = (int32_t)(words[3] << 3) >> 19;
	p->right_r = words[4] & 0xffffu;
	p->right_m = words[4] >> 16;
	p->right_dy = words[5] & 0xffffu;
	p->switch_row = words[5] >> 16 & 0x3fu;
	p->side = words[5] >> 24 & 0x1u;
	p->middle_x = (int32_t)(words[6] << 19) >> 19;
	p->middle_step = (int32_t)(words[6] << 3) >> 19;
	p->middle_r = words[7] & 0xffffu;
	p->middle_m = words[7] >> 16;
	p->middle_dy = words[8] & 0xffffu;
}

/* @words: the 9 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_edges_wide_invalid(const uint32_t *words)
{
	if (words[0] & 0xe000e000u)
		return 0;
	if (words[2] & 0xc0c00000u)
		return 2;
	if (words[3] & 0xe000e000u)
		return 3;
	if (words[5] & 0xfec00000u)
		return 5;
	if (words[6] & 0xe000e000u)
		return 6;
	if (words[8] & 0xffff0000u)
		return 8;
	return -1;
}

/* ---- edges_compact ---- */

#define GLOSS_EDGES_COMPACT_WORDS 6

/*
 * As edges_wide with narrow fields: x and step are sign-extended to 13 bits, the others extended
 * with zeros.
 */
struct gloss_edges_compact {
	uint32_t left_r;
	uint32_t left_m;
	uint32_t left_dy;
	int32_t left_x;
	int32_t left_step;
	/* first_row + last_row at most T-1. */
	uint32_t first_row;
	/* Rows less one. */
	uint32_t last_row;
	uint32_t right_r;
	uint32_t right_m;
	uint32_t right_dy;
	int32_t right_x;
	int32_t right_step;
	uint32_t switch_row;
	uint32_t side;
	uint32_t middle_r;
	uint32_t middle_m;
	uint32_t middle_dy;
	int32_t middle_x;
	int32_t middle_step;
};

static inline void gloss_edges_compact_pack(uint32_t *words, const struct gloss_edges_compact *p)
{
	words[0] = (p->left_r & 0x3ffu) |
		   (p->left_m & 0x3ffu) << 10 |
		   (p->left_dy & 0x3ffu) << 20;
	words[1] = ((uint32_t)p->left_x & 0xffu) |
		   ((uint32_t)p->left_step & 0xffu) << 8 |
		   (p->first_row & 0x3fu) << 16 |
		   (p->last_row & 0x3fu) << 24;
	words[2] = (p->right_r & 0x3ffu) |
		   (p->right_m & 0x3ffu) << 10 |
		   (p->right_dy & 0x3ffu) << 20;
	words[3] = ((uint32_t)p->right_x & 0xffu) |
		   ((uint32_t)p->right_step & 0xffu) << 8 |
		   (p->switch_row & 0x3fu) << 16 |
		   (p->side & 0x1u) << 24;
	words[4] = (p->middle_r & 0x3ffu) |
		   (p->middle_m & 0x3ffu) << 10 |
		   (p->middle_dy & 0x3ffu) << 20;
	words[5] = ((uint32_t)p->middle_x & 0xffu) |
		   ((uint32_t)p->middle_step & 0xffu) << 8;
}

static inline void gloss_edges_compact_unpack(const uint32_t *words, struct gloss_edges_compact *p)
{
	p->left_r = words[0] & 0x3ffu;
	p->left_m = words[0] >> 10 & 0x3ffu;
	p->left_dy = words[0] >> 20 & 0x3ffu;
	p->left_x = (int32_t)(words[1] << 24) >> 24;
	p->left_step = (int32_t)(words[1] << 16) >> 24;
	p->first_row = words[1] >> 16 & 0x3fu;
	p->last_row = words[1] >> 24 & 0x3fu;
	p->right_r = words[2] & 0x3ffu;
	p->right_m = words[2] >> 10 & 0x3ffu;
	p->right_dy = words[2] >> 20 & 0x3ffu;
	p->right_x = (int32_t)(words[3] << 24) >> 24;
	p->right_step = (int32_t)(words[3] << 16) >> 24;
	p->switch_row = words[3] >> 16 & 0x3fu;
	p->side = words[3] >> 24 & 0x1u;
	p->middle_r = words[4] & 0x3ffu;
	p->middle_m = words[4] >> 10 & 0x3ffu;
	p->middle_dy = words[4] >> 20 & 0x3ffu;
	p->middle_x = (int32_t)(words[5] << 24) >> 24;
	p->middle_step = (int32_t)(words[5] << 16) >> 24;
}

/* @words: the 6 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_edges_compact_invalid(const uint32_t *words)
{
	if (words[0] & 0xc0000000u)
		return 0;
	if (words[1] & 0xc0c00000u)
		return 1;
	if (words[2] & 0xc0000000u)
		return 2;
	if (words[3] & 0xfec00000u)
		return 3;
	if (words[4] & 0xc0000000u)
		return 4;
	if (words[5] & 0xffff0000u)
		return 5;
	return -1;
}

/* ---- depth_wide ---- */

#define GLOSS_DEPTH_WIDE_WORDS 4

/* Depth plane, s28.12, 40 bits each: bits 31:0 here, bits 39:32 in the last word. */
struct gloss_depth_wide {
	uint32_t z;
	uint32_t dx;
	uint32_t dy;
	uint32_t z_high;
	uint32_t dx_high;
	uint32_t dy_high;
};

static inline void gloss_depth_wide_pack(uint32_t *words, const struct gloss_depth_wide *p)
{
	words[0] = p->z;
	words[1] = p->dx;
	words[2] = p->dy;
	words[3] = (p->z_high & 0xffu) |
		   (p->dx_high & 0xffu) << 8 |
		   (p->dy_high & 0xffu) << 16;
}

static inline void gloss_depth_wide_unpack(const uint32_t *words, struct gloss_depth_wide *p)
{
	p->z = words[0];
	p->dx = words[1];
	p->dy = words[2];
	p->z_high = words[3] & 0xffu;
	p->dx_high = words[3] >> 8 & 0xffu;
	p->dy_high = words[3] >> 16 & 0xffu;
}

/* @words: the 4 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_depth_wide_invalid(const uint32_t *words)
{
	if (words[3] & 0xff000000u)
		return 3;
	return -1;
}

/* ---- depth_compact ---- */

#define GLOSS_DEPTH_COMPACT_WORDS 3

/* Depth plane, s26.6, sign-extended and shifted left by depth_compact_shift. */
struct gloss_depth_compact {
	int32_t z;
	int32_t dx;
	int32_t dy;
};

static inline void gloss_depth_compact_pack(uint32_t *words, const struct gloss_depth_compact *p)
{
	words[0] = (uint32_t)p->z;
	words[1] = (uint32_t)p->dx;
	words[2] = (uint32_t)p->dy;
}

static inline void gloss_depth_compact_unpack(const uint32_t *words, struct gloss_depth_compact *p)
{
	p->z = (int32_t)words[0];
	p->dx = (int32_t)words[1];
	p->dy = (int32_t)words[2];
}

/* @words: the 3 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_depth_compact_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- alpha_linear ---- */

#define GLOSS_ALPHA_LINEAR_WORDS 3

/* Alpha plane, s10.22. */
struct gloss_alpha_linear {
	uint32_t a;
	uint32_t a_dx;
	uint32_t a_dy;
};

static inline void gloss_alpha_linear_pack(uint32_t *words, const struct gloss_alpha_linear *p)
{
	words[0] = p->a;
	words[1] = p->a_dx;
	words[2] = p->a_dy;
}

static inline void gloss_alpha_linear_unpack(const uint32_t *words, struct gloss_alpha_linear *p)
{
	p->a = words[0];
	p->a_dx = words[1];
	p->a_dy = words[2];
}

/* @words: the 3 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_alpha_linear_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- colour_flat ---- */

#define GLOSS_COLOUR_FLAT_WORDS 1

/* One colour, 8 bits a channel. */
struct gloss_colour_flat {
	uint32_t red;
	uint32_t green;
	uint32_t blue;
};

static inline void gloss_colour_flat_pack(uint32_t *words, const struct gloss_colour_flat *p)
{
	words[0] = (p->red & 0xffu) |
		   (p->green & 0xffu) << 8 |
		   (p->blue & 0xffu) << 16;
}

static inline void gloss_colour_flat_unpack(const uint32_t *words, struct gloss_colour_flat *p)
{
	p->red = words[0] & 0xffu;
	p->green = words[0] >> 8 & 0xffu;
	p->blue = words[0] >> 16 & 0xffu;
}

/* @words: the 1 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_colour_flat_invalid(const uint32_t *words)
{
	if (words[0] & 0xff000000u)
		return 0;
	return -1;
}

/* ---- colour_linear ---- */

#define GLOSS_COLOUR_LINEAR_WORDS 9

/* A plane a channel, s10.22: value at the anchor and its first differences in x and y. */
struct gloss_colour_linear {
	uint32_t red;
	uint32_t red_dx;
	uint32_t red_dy;
	uint32_t green;
	uint32_t green_dx;
	uint32_t green_dy;
	uint32_t blue;
	uint32_t blue_dx;
	uint32_t blue_dy;
};

static inline void gloss_colour_linear_pack(uint32_t *words, const struct gloss_colour_linear *p)
{
	words[0] = p->red;
	words[1] = p->red_dx;
	words[2] = p->red_dy;
	words[3] = p->green;
	words[4] = p->green_dx;
	words[5] = p->green_dy;
	words[6] = p->blue;
	words[7] = p->blue_dx;
	words[8] = p->blue_dy;
}

static inline void gloss_colour_linear_unpack(const uint32_t *words, struct gloss_colour_linear *p)
{
	p->red = words[0];
	p->red_dx = words[1];
	p->red_dy = words[2];
	p->green = words[3];
	p->green_dx = words[4];
	p->green_dy = words[5];
	p->blue = words[6];
	p->blue_dx = words[7];
	p->blue_dy = words[8];
}

/* @words: the 9 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_colour_linear_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- colour_second_order ---- */

#define GLOSS_COLOUR_SECOND_ORDER_WORDS 18

/*
 * A second-order surface a channel, s10.22: value at the anchor, first differences in x and y
 * there, and the constant second differences in xx, xy, yy.
 */
struct gloss_colour_second_order {
	uint32_t red;
	uint32_t red_dx;
	uint32_t red_dy;
	uint32_t red_dxx;
	uint32_t red_dxy;
	uint32_t red_dyy;
	uint32_t green;
	uint32_t green_dx;
	uint32_t green_dy;
	uint32_t green_dxx;
	uint32_t green_dxy;
	uint32_t green_dyy;
	uint32_t blue;
	uint32_t blue_dx;
	uint32_t blue_dy;
	uint32_t blue_dxx;
	uint32_t blue_dxy;
	uint32_t blue_dyy;
};

static inline void gloss_colour_second_order_pack(uint32_t *words,
						  const struct gloss_colour_second_order *p)
{
	words[0] = p->red;
	words[1] = p->red_dx;
	words[2] = p->red_dy;
	words[3] = p->red_dxx;
	words[4] = p->red_dxy;
	words[5] = p->red_dyy;
	words[6] = p->green;
	words[7] = p->green_dx;
	words[8] = p->green_dy;
	words[9] = p->green_dxx;
	words[10] = p->green_dxy;
	words[11] = p->green_dyy;
	words[12] = p->blue;
	words[13] = p->blue_dx;
	words[14] = p->blue_dy;
	words[15] = p->blue_dxx;
	words[16] = p->blue_dxy;
	words[17] = p->blue_dyy;
}

static inline void gloss_colour_second_order_unpack(const uint32_t *words,
						    struct gloss_colour_second_order *p)
{
	p->red = words[0];
	p->red_dx = words[1];
	p->red_dy = words[2];
	p->red_dxx = words[3];
	p->red_dxy = words[4];
	p->red_dyy = words[5];
	p->green = words[6];
	p->green_dx = words[7];
	p->green_dy = words[8];
	p->green_dxx = words[9];
	p->green_dxy = words[10];
	p->green_dyy = words[11];
	p->blue = words[12];
	p->blue_dx = words[13];
	p->blue_dy = words[14];
	p->blue_dxx = words[15];
	p->blue_dxy = words[16];
	p->blue_dyy = words[17];
}

/* @words: the 18 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_colour_second_order_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- pixels_small ---- */

#define GLOSS_PIXELS_SMALL_WORDS 1

/*
 * The pixels of a triangle in a box of at most 16x16, as they are: of each row the first and the
 * last one, counted from x. Without one, last is below first. What sticks out of the tile is not
 * drawn.
 */
struct gloss_pixels_small {
	uint32_t x;
	/* first_row + last_row at most T-1. */
	uint32_t first_row;
	/* Rows less one, no more than there are words for. */
	uint32_t last_row;
	/* Of row 0. */
	uint32_t first_0;
	uint32_t last_0;
	/* Of row 1; not looked at if there is none, as in the words below. */
	uint32_t first_1;
	uint32_t last_1;
};

static inline void gloss_pixels_small_pack(uint32_t *words, const struct gloss_pixels_small *p)
{
	words[0] = (p->x & 0x3fu) |
		   (p->first_row & 0x3fu) << 6 |
		   (p->last_row & 0xfu) << 12 |
		   (p->first_0 & 0xfu) << 16 |
		   (p->last_0 & 0xfu) << 20 |
		   (p->first_1 & 0xfu) << 24 |
		   (p->last_1 & 0xfu) << 28;
}

static inline void gloss_pixels_small_unpack(const uint32_t *words, struct gloss_pixels_small *p)
{
	p->x = words[0] & 0x3fu;
	p->first_row = words[0] >> 6 & 0x3fu;
	p->last_row = words[0] >> 12 & 0xfu;
	p->first_0 = words[0] >> 16 & 0xfu;
	p->last_0 = words[0] >> 20 & 0xfu;
	p->first_1 = words[0] >> 24 & 0xfu;
	p->last_1 = words[0] >> 28;
}

/* @words: the 1 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_pixels_small_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- rows_one ---- */

#define GLOSS_ROWS_ONE_WORDS 1

/* Rows 2 to 5, a byte each from the low one on: first in its bits 3:0, last in 7:4. */
struct gloss_rows_one {
	uint32_t rows_2;
};

static inline void gloss_rows_one_pack(uint32_t *words, const struct gloss_rows_one *p)
{
	words[0] = p->rows_2;
}

static inline void gloss_rows_one_unpack(const uint32_t *words, struct gloss_rows_one *p)
{
	p->rows_2 = words[0];
}

/* @words: the 1 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_rows_one_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- rows_two ---- */

#define GLOSS_ROWS_TWO_WORDS 2

/* Rows 2 to 9, as rows_one. */
struct gloss_rows_two {
	uint32_t rows_2;
	uint32_t rows_6;
};

static inline void gloss_rows_two_pack(uint32_t *words, const struct gloss_rows_two *p)
{
	words[0] = p->rows_2;
	words[1] = p->rows_6;
}

static inline void gloss_rows_two_unpack(const uint32_t *words, struct gloss_rows_two *p)
{
	p->rows_2 = words[0];
	p->rows_6 = words[1];
}

/* @words: the 2 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_rows_two_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- rows_three ---- */

#define GLOSS_ROWS_THREE_WORDS 3

/* Rows 2 to 13, as rows_one. */
struct gloss_rows_three {
	uint32_t rows_2;
	uint32_t rows_6;
	uint32_t rows_10;
};

static inline void gloss_rows_three_pack(uint32_t *words, const struct gloss_rows_three *p)
{
	words[0] = p->rows_2;
	words[1] = p->rows_6;
	words[2] = p->rows_10;
}

static inline void gloss_rows_three_unpack(const uint32_t *words, struct gloss_rows_three *p)
{
	p->rows_2 = words[0];
	p->rows_6 = words[1];
	p->rows_10 = words[2];
}

/* @words: the 3 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_rows_three_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- rows_four ---- */

#define GLOSS_ROWS_FOUR_WORDS 4

/* Rows 2 to 15, as rows_one; bits 31:16 of the last word are not looked at. */
struct gloss_rows_four {
	uint32_t rows_2;
	uint32_t rows_6;
	uint32_t rows_10;
	uint32_t rows_14;
};

static inline void gloss_rows_four_pack(uint32_t *words, const struct gloss_rows_four *p)
{
	words[0] = p->rows_2;
	words[1] = p->rows_6;
	words[2] = p->rows_10;
	words[3] = p->rows_14;
}

static inline void gloss_rows_four_unpack(const uint32_t *words, struct gloss_rows_four *p)
{
	p->rows_2 = words[0];
	p->rows_6 = words[1];
	p->rows_10 = words[2];
	p->rows_14 = words[3];
}

/* @words: the 4 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_rows_four_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- depth_small ---- */

#define GLOSS_DEPTH_SMALL_WORDS 2

/*
 * Depth plane: z is s28.4, shifted left by small_depth_shift. dx and dy are sign-extended and
 * shifted left by small_depth_shift + scale * small_depth_scale_shift.
 */
struct gloss_depth_small {
	int32_t z;
	int32_t dx;
	int32_t dy;
	uint32_t scale;
};

static inline void gloss_depth_small_pack(uint32_t *words, const struct gloss_depth_small *p)
{
	words[0] = (uint32_t)p->z;
	words[1] = ((uint32_t)p->dx & 0x7fffu) |
		   ((uint32_t)p->dy & 0x7fffu) << 15 |
		   (p->scale & 0x3u) << 30;
}

static inline void gloss_depth_small_unpack(const uint32_t *words, struct gloss_depth_small *p)
{
	p->z = (int32_t)words[0];
	p->dx = (int32_t)(words[1] << 17) >> 17;
	p->dy = (int32_t)(words[1] << 2) >> 17;
	p->scale = words[1] >> 30;
}

/* @words: the 2 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_depth_small_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- colour_linear_small ---- */

#define GLOSS_COLOUR_LINEAR_SMALL_WORDS 4

/*
 * A plane a channel. The value at the anchor is its whole part and 8 bits of fraction, shifted left
 * by small_slope_shift. Differences are sign-extended and shifted left by small_slope_shift +
 * slope_scale * small_slope_scale_shift.
 */
struct gloss_colour_linear_small {
	int32_t red;
	int32_t green;
	int32_t blue;
	uint32_t slope_scale;
	uint32_t red_fraction;
	int32_t red_dx;
	int32_t red_dy;
	uint32_t green_fraction;
	int32_t green_dx;
	int32_t green_dy;
	uint32_t blue_fraction;
	int32_t blue_dx;
	int32_t blue_dy;
};

static inline void gloss_colour_linear_small_pack(uint32_t *words,
						  const struct gloss_colour_linear_small *p)
{
	words[0] = ((uint32_t)p->red & 0x3ffu) |
		   ((uint32_t)p->green & 0x3ffu) << 10 |
		   ((uint32_t)p->blue & 0x3ffu) << 20 |
		   (p->slope_scale & 0x3u) << 30;
	words[1] = (p->red_fraction & 0xffu) |
		   ((uint32_t)p->red_dx & 0xfffu) << 8 |
		   ((uint32_t)p->red_dy & 0xfffu) << 20;
	words[2] = (p->green_fraction & 0xffu) |
		   ((uint32_t)p->green_dx & 0xfffu) << 8 |
		   ((uint32_t)p->green_dy & 0xfffu) << 20;
	words[3] = (p->blue_fraction & 0xffu) |
		   ((uint32_t)p->blue_dx & 0xfffu) << 8 |
		   ((uint32_t)p->blue_dy & 0xfffu) << 20;
}

static inline void gloss_colour_linear_small_unpack(const uint32_t *words,
						    struct gloss_colour_linear_small *p)
{
	p->red = (int32_t)(words[0] << 22) >> 22;
	p->green = (int32_t)(words[0] << 12) >> 22;
	p->blue = (int32_t)(words[0] << 2) >> 22;
	p->slope_scale = words[0] >> 30;
	p->red_fraction = words[1] & 0xffu;
	p->red_dx = (int32_t)(words[1] << 12) >> 20;
	p->red_dy = (int32_t)words[1] >> 20;
	p->green_fraction = words[2] & 0xffu;
	p->green_dx = (int32_t)(words[2] << 12) >> 20;
	p->green_dy = (int32_t)words[2] >> 20;
	p->blue_fraction = words[3] & 0xffu;
	p->blue_dx = (int32_t)(words[3] << 12) >> 20;
	p->blue_dy = (int32_t)words[3] >> 20;
}

/* @words: the 4 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_colour_linear_small_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- colour_second_order_small ---- */

#define GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS 7

/*
 * As colour_linear_small, and second differences: sign-extended and shifted left by
 * small_bend_shift + the channel's scale * small_bend_scale_shift.
 */
struct gloss_colour_second_order_small {
	int32_t red;
	int32_t green;
	int32_t blue;
	uint32_t slope_scale;
	uint32_t red_fraction;
	int32_t red_dx;
	int32_t red_dy;
	uint32_t green_fraction;
	int32_t green_dx;
	int32_t green_dy;
	uint32_t blue_fraction;
	int32_t blue_dx;
	int32_t blue_dy;
	int32_t red_dxx;
	int32_t red_dxy;
	int32_t red_dyy;
	uint32_t red_scale;
	int32_t green_dxx;
	int32_t green_dxy;
	int32_t green_dyy;
	uint32_t green_scale;
	int32_t blue_dxx;
	int32_t blue_dxy;
	int32_t blue_dyy;
	uint32_t blue_scale;
};

static inline void gloss_colour_second_order_small_pack(uint32_t *words,
							const struct gloss_colour_second_order_small *p)
{
	words[0] = ((uint32_t)p->red & 0x3ffu) |
		   ((uint32_t)p->green & 0x3ffu) << 10 |
		   ((uint32_t)p->blue & 0x3ffu) << 20 |
		   (p->slope_scale & 0x3u) << 30;
	words[1] = (p->red_fraction & 0xffu) |
		   ((uint32_t)p->red_dx & 0xfffu) << 8 |
		   ((uint32_t)p->red_dy & 0xfffu) << 20;
	words[2] = (p->green_fraction & 0xffu) |
		   ((uint32_t)p->green_dx & 0xfffu) << 8 |
		   ((uint32_t)p->green_dy & 0xfffu) << 20;
	words[3] = (p->blue_fraction & 0xffu) |
		   ((uint32_t)p->blue_dx & 0xfffu) << 8 |
		   ((uint32_t)p->blue_dy & 0xfffu) << 20;
	words[4] = ((uint32_t)p->red_dxx & 0x3ffu) |
		   ((uint32_t)p->red_dxy & 0x3ffu) << 10 |
		   ((uint32_t)p->red_dyy & 0x3ffu) << 20 |
		   (p->red_scale & 0x3u) << 30;
	words[5] = ((uint32_t)p->green_dxx & 0x3ffu) |
		   ((uint32_t)p->green_dxy & 0x3ffu) << 10 |
		   ((uint32_t)p->green_dyy & 0x3ffu) << 20 |
		   (p->green_scale & 0x3u) << 30;
	words[6] = ((uint32_t)p->blue_dxx & 0x3ffu) |
		   ((uint32_t)p->blue_dxy & 0x3ffu) << 10 |
		   ((uint32_t)p->blue_dyy & 0x3ffu) << 20 |
		   (p->blue_scale & 0x3u) << 30;
}

static inline void gloss_colour_second_order_small_unpack(const uint32_t *words,
							  struct gloss_colour_second_order_small *p)
{
	p->red = (int32_t)(words[0] << 22) >> 22;
	p->green = (int32_t)(words[0] << 12) >> 22;
	p->blue = (int32_t)(words[0] << 2) >> 22;
	p->slope_scale = words[0] >> 30;
	p->red_fraction = words[1] & 0xffu;
	p->red_dx = (int32_t)(words[1] << 12) >> 20;
	p->red_dy = (int32_t)words[1] >> 20;
	p->green_fraction = words[2] & 0xffu;
	p->green_dx = (int32_t)(words[2] << 12) >> 20;
	p->green_dy = (int32_t)words[2] >> 20;
	p->blue_fraction = words[3] & 0xffu;
	p->blue_dx = (int32_t)(words[3] << 12) >> 20;
	p->blue_dy = (int32_t)words[3] >> 20;
	p->red_dxx = (int32_t)(words[4] << 22) >> 22;
	p->red_dxy = (int32_t)(words[4] << 12) >> 22;
	p->red_dyy = (int32_t)(words[4] << 2) >> 22;
	p->red_scale = words[4] >> 30;
	p->green_dxx = (int32_t)(words[5] << 22) >> 22;
	p->green_dxy = (int32_t)(words[5] << 12) >> 22;
	p->green_dyy = (int32_t)(words[5] << 2) >> 22;
	p->green_scale = words[5] >> 30;
	p->blue_dxx = (int32_t)(words[6] << 22) >> 22;
	p->blue_dxy = (int32_t)(words[6] << 12) >> 22;
	p->blue_dyy = (int32_t)(words[6] << 2) >> 22;
	p->blue_scale = words[6] >> 30;
}

/* @words: the 7 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_colour_second_order_small_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- nop ---- */

/* Does nothing; its payload is skipped unread. */

/* Writes the header. @length: payload words, at most 2047. */
static inline void gloss_nop_pack(uint32_t *words, uint32_t length)
{
	words[0] = (uint32_t)GLOSS_OP_NOP << 24 | length;
}

/* ---- write_memory ---- */

#define GLOSS_WRITE_MEMORY_WORDS 2

/* Writes the payload words after the first two to a slot. Only between tiles. */
struct gloss_write_memory {
	uint32_t slot;
	/* Bytes from the start of the slot, a multiple of 4. */
	uint32_t offset;
};

/* Writes the header and the 2 words after it. @length: payload words, at most 2047. */
static inline void gloss_write_memory_pack(uint32_t *words,
					   const struct gloss_write_memory *p, uint32_t length)
{
	words[0] = (uint32_t)GLOSS_OP_WRITE_MEMORY << 24 | length;
	words[1] = p->slot & 0xfu;
	words[2] = p->offset;
}

/* @words starts at the header. */
static inline void gloss_write_memory_unpack(const uint32_t *words, struct gloss_write_memory *p)
{
	p->slot = words[1] & 0xfu;
	p->offset = words[2];
}

/* @words: the 2 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_write_memory_invalid(const uint32_t *words)
{
	if (words[0] & 0xfffffff0u)
		return 0;
	return -1;
}

/* ---- read_memory ---- */

#define GLOSS_READ_MEMORY_WORDS 2

/* Reads words of a slot into the response stream. Only between tiles. */
struct gloss_read_memory {
	uint32_t slot;
	/* Words, 1 to 65535. */
	uint32_t count;
	/* Bytes from the start of the slot, a multiple of 4. */
	uint32_t offset;
};

/* Writes the header and the 2 words after it. */
static inline void gloss_read_memory_pack(uint32_t *words, const struct gloss_read_memory *p)
{
	words[0] = (uint32_t)GLOSS_OP_READ_MEMORY << 24 | GLOSS_READ_MEMORY_WORDS;
	words[1] = (p->slot & 0xfu) |
		   (p->count & 0xffffu) << 16;
	words[2] = p->offset;
}

/* @words starts at the header. */
static inline void gloss_read_memory_unpack(const uint32_t *words, struct gloss_read_memory *p)
{
	p->slot = words[1] & 0xfu;
	p->count = words[1] >> 16;
	p->offset = words[2];
}

/* @words: the 2 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_read_memory_invalid(const uint32_t *words)
{
	if ((words[0] & 0x0000fff0u) || (words[0] >> 16) < 1)
		return 0;
	return -1;
}

/* ---- counters ---- */

#define GLOSS_COUNTERS_WORDS 0

/*
 * Appends four words to the response stream, counted from the start of the job, each modulo 2^32:
 * triangles, pixels covered inside the scissor, pixels that passed the depth test, tiles ended.
 * Only between tiles.
 */

/* Writes the header. */
static inline void gloss_counters_pack(uint32_t *words)
{
	words[0] = (uint32_t)GLOSS_OP_COUNTERS << 24 | GLOSS_COUNTERS_WORDS;
}

/* ---- colour_surface ---- */

#define GLOSS_COLOUR_SURFACE_WORDS 1

/*
 * Where the colour of tiles is loaded from and stored to. A pixel is a word, red in bits 7:0, then
 * green, blue, alpha.
 */
struct gloss_colour_surface {
	uint32_t slot;
	/* Bytes from a row to the next, a multiple of 4*T. */
	uint32_t pitch;
};

/* Writes the header and the word after it. */
static inline void gloss_colour_surface_pack(uint32_t *words, const struct gloss_colour_surface *p)
{
	words[0] = (uint32_t)GLOSS_OP_COLOUR_SURFACE << 24 | GLOSS_COLOUR_SURFACE_WORDS;
	words[1] = (p->slot & 0xfu) |
		   (p->pitch & 0xffffu) << 16;
}

/* @words starts at the header. */
static inline void gloss_colour_surface_unpack(const uint32_t *words,
					       struct gloss_colour_surface *p)
{
	p->slot = words[1] & 0xfu;
	p->pitch = words[1] >> 16;
}

/* @words: the 1 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_colour_surface_invalid(const uint32_t *words)
{
	if ((words[0] & 0x0000fff0u) || (words[0] >> 16) < 1)
		return 0;
	return -1;
}

/* ---- depth_surface ---- */

#define GLOSS_DEPTH_SURFACE_WORDS 1

/*
 * Where the depth of tiles is loaded from and stored to. A pixel is a word, depth in bits 23:0,
 * stencil in bits 31:24; the core carries stencil from clear or load to store and does not test it.
 */
struct gloss_depth_surface {
	uint32_t slot;
	/* Bytes from a row to the next, a multiple of 4*T. */
	uint32_t pitch;
};

/* Writes the header and the word after it. */
static inline void gloss_depth_surface_pack(uint32_t *words, const struct gloss_depth_surface *p)
{
	words[0] = (uint32_t)GLOSS_OP_DEPTH_SURFACE << 24 | GLOSS_DEPTH_SURFACE_WORDS;
	words[1] = (p->slot & 0xfu) |
		   (p->pitch & 0xffffu) << 16;
}

/* @words starts at the header. */
static inline void gloss_depth_surface_unpack(const uint32_t *words, struct gloss_depth_surface *p)
{
	p->slot = words[1] & 0xfu;
	p->pitch = words[1] >> 16;
}

/* @words: the 1 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_depth_surface_invalid(const uint32_t *words)
{
	if ((words[0] & 0x0000fff0u) || (words[0] >> 16) < 1)
		return 0;
	return -1;
}

/* ---- tile_begin ---- */

#define GLOSS_TILE_BEGIN_WORDS 2

/*
 * Opens a tile. Its colour and depth are each cleared to a value or loaded from their surface, so
 * nothing a former tile or job left on the chip can be seen. Not inside a tile.
 */
struct gloss_tile_begin {
	bool colour_load;
	bool depth_load;
	/*
	 * Clear value, or with colour_load the tile's byte offset in the slot, a multiple of 4*T.
	 */
	uint32_t colour;
	/* Clear value, or with depth_load the tile's byte offset in the slot, a multiple of 4*T. */
	uint32_t depth;
};

/* Writes the header and the 2 words after it. */
static inline void gloss_tile_begin_pack(uint32_t *words, const struct gloss_tile_begin *p)
{
	words[0] = (uint32_t)GLOSS_OP_TILE_BEGIN << 24 | GLOSS_TILE_BEGIN_WORDS |
		   (uint32_t)p->colour_load << 11 |
		   (uint32_t)p->depth_load << 12;
	words[1] = p->colour;
	words[2] = p->depth;
}

/* @words starts at the header. */
static inline void gloss_tile_begin_unpack(const uint32_t *words, struct gloss_tile_begin *p)
{
	p->colour_load = words[0] >> 11 & 0x1u;
	p->depth_load = words[0] >> 12 & 0x1u;
	p->colour = words[1];
	p->depth = words[2];
}

/* @words: the 2 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_tile_begin_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- tile_end ---- */

#define GLOSS_TILE_END_WORDS 2

/*
 * Closes the tile. Colour is stored or answered before depth: where the two overlap in memory,
 * depth stays. Only inside a tile.
 */
struct gloss_tile_end {
	enum gloss_tile_output colour_output;
	enum gloss_tile_output depth_output;
	/* With store the tile's byte offset in the slot, a multiple of 4*T; else zero. */
	uint32_t colour;
	/* With store the tile's byte offset in the slot, a multiple of 4*T; else zero. */
	uint32_t depth;
};

/* Writes the header and the 2 words after it. */
static inline void gloss_tile_end_pack(uint32_t *words, const struct gloss_tile_end *p)
{
	words[0] = (uint32_t)GLOSS_OP_TILE_END << 24 | GLOSS_TILE_END_WORDS |
		   ((uint32_t)p->colour_output & 0x3u) << 11 |
		   ((uint32_t)p->depth_output & 0x3u) << 13;
	words[1] = p->colour;
	words[2] = p->depth;
}

/* @words starts at the header. */
static inline void gloss_tile_end_unpack(const uint32_t *words, struct gloss_tile_end *p)
{
	p->colour_output = (enum gloss_tile_output)(words[0] >> 11 & 0x3u);
	p->depth_output = (enum gloss_tile_output)(words[0] >> 13 & 0x3u);
	p->colour = words[1];
	p->depth = words[2];
}

/* @words: the 2 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_tile_end_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- depth_state ---- */

#define GLOSS_DEPTH_STATE_WORDS 0

/* Depth test. A disabled test is ALWAYS without write. */
struct gloss_depth_state {
	enum gloss_compare func;
	bool write;
};

/* Writes the header. */
static inline void gloss_depth_state_pack(uint32_t *words, const struct gloss_depth_state *p)
{
	words[0] = (uint32_t)GLOSS_OP_DEPTH_STATE << 24 | GLOSS_DEPTH_STATE_WORDS |
		   ((uint32_t)p->func & 0x7u) << 11 |
		   (uint32_t)p->write << 14;
}

/* @words starts at the header. */
static inline void gloss_depth_state_unpack(const uint32_t *words, struct gloss_depth_state *p)
{
	p->func = (enum gloss_compare)(words[0] >> 11 & 0x7u);
	p->write = words[0] >> 14 & 0x1u;
}

/* ---- colour_mask ---- */

#define GLOSS_COLOUR_MASK_WORDS 0

/* Which channels are written. */
struct gloss_colour_mask {
	bool red;
	bool green;
	bool blue;
	bool alpha;
};

/* Writes the header. */
static inline void gloss_colour_mask_pack(uint32_t *words, const struct gloss_colour_mask *p)
{
	words[0] = (uint32_t)GLOSS_OP_COLOUR_MASK << 24 | GLOSS_COLOUR_MASK_WORDS |
		   (uint32_t)p->red << 11 |
		   (uint32_t)p->green << 12 |
		   (uint32_t)p->blue << 13 |
		   (uint32_t)p->alpha << 14;
}

/* @words starts at the header. */
static inline void gloss_colour_mask_unpack(const uint32_t *words, struct gloss_colour_mask *p)
{
	p->red = words[0] >> 11 & 0x1u;
	p->green = words[0] >> 12 & 0x1u;
	p->blue = words[0] >> 13 & 0x1u;
	p->alpha = words[0] >> 14 & 0x1u;
}

/* ---- scissor ---- */

#define GLOSS_SCISSOR_WORDS 1

/* Pixels with x0 <= x < x1 and y0 <= y < y1 of the tile are drawn. Each at most T. */
struct gloss_scissor {
	uint32_t x0;
	uint32_t y0;
	uint32_t x1;
	uint32_t y1;
};

/* Writes the header and the word after it. */
static inline void gloss_scissor_pack(uint32_t *words, const struct gloss_scissor *p)
{
	words[0] = (uint32_t)GLOSS_OP_SCISSOR << 24 | GLOSS_SCISSOR_WORDS;
	words[1] = (p->x0 & 0x7fu) |
		   (p->y0 & 0x7fu) << 8 |
		   (p->x1 & 0x7fu) << 16 |
		   (p->y1 & 0x7fu) << 24;
}

/* @words starts at the header. */
static inline void gloss_scissor_unpack(const uint32_t *words, struct gloss_scissor *p)
{
	p->x0 = words[1] & 0x7fu;
	p->y0 = words[1] >> 8 & 0x7fu;
	p->x1 = words[1] >> 16 & 0x7fu;
	p->y1 = words[1] >> 24 & 0x7fu;
}

/* @words: the 1 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int gloss_scissor_invalid(const uint32_t *words)
{
	if (words[0] & 0x80808080u)
		return 0;
	return -1;
}

/* ---- triangle ---- */

/*
 * Draws a triangle's pixels in the open tile. Only inside a tile.
 *
 * Payload: edges, depth, alpha, colour, each in the form the header names. The length is the sum of
 * the parts.
 *
 * Coefficients hold at the anchor: y is first_row, x is left.x of the first row, clamped to 0..T-1
 * and rounded down to a multiple of anchor_align (before any scissor). At u pixels right of and v
 * below the anchor a surface has the value i + u*dx + u(u-1)/2*dxx + v*dy + v(v-1)/2*dyy + u*v*dxy,
 * in wrapping 32-bit (depth: 40-bit) two's complement. A channel's 8 bits are the value shifted
 * right by colour_fraction and clamped to 0..255, depth's 24 bits the value shifted right by
 * depth_fraction and clamped to 0..2^24-1. The sender adds the half that rounds.
 *
 * A pixel inside the scissor is covered. If its depth compares as depth_state says, its depth (with
 * write) and the masked channels of its colour replace the stored ones.
 */
struct gloss_triangle {
	enum gloss_geometry geometry;
	enum gloss_shading shading;
	bool alpha_linear;
	/* Constant alpha; not looked at with alpha_linear. */
	uint32_t alpha;
};

/* Payload words of a packet with this header. */
static inline uint32_t gloss_triangle_length(const struct gloss_triangle *p)
{
	uint32_t length = 0;

	if (p->geometry == GLOSS_GEOMETRY_WIDE)
		length += GLOSS_EDGES_WIDE_WORDS;
	if (p->geometry == GLOSS_GEOMETRY_COMPACT)
		length += GLOSS_EDGES_COMPACT_WORDS;
	if (p->geometry == GLOSS_GEOMETRY_WIDE)
		length += GLOSS_DEPTH_WIDE_WORDS;
	if (p->geometry == GLOSS_GEOMETRY_COMPACT)
		length += GLOSS_DEPTH_COMPACT_WORDS;
	if (p->geometry == GLOSS_GEOMETRY_COVERING)
		length += GLOSS_DEPTH_WIDE_WORDS;
	if (p->alpha_linear)
		length += GLOSS_ALPHA_LINEAR_WORDS;
	if (p->shading == GLOSS_SHADING_FLAT)
		length += GLOSS_COLOUR_FLAT_WORDS;
	if (p->shading == GLOSS_SHADING_LINEAR)
		length += GLOSS_COLOUR_LINEAR_WORDS;
	if (p->shading == GLOSS_SHADING_SECOND_ORDER)
		length += GLOSS_COLOUR_SECOND_ORDER_WORDS;
	return length;
}

/* Writes the header. */
static inline void gloss_triangle_pack(uint32_t *words, const struct gloss_triangle *p)
{
	words[0] = (uint32_t)GLOSS_OP_TRIANGLE << 24 | gloss_triangle_length(p) |
		   ((uint32_t)p->geometry & 0x3u) << 11 |
		   ((uint32_t)p->shading & 0x3u) << 13 |
		   (uint32_t)p->alpha_linear << 15 |
		   (p->alpha & 0xffu) << 16;
}

/* @words starts at the header. */
static inline void gloss_triangle_unpack(const uint32_t *words, struct gloss_triangle *p)
{
	p->geometry = (enum gloss_geometry)(words[0] >> 11 & 0x3u);
	p->shading = (enum gloss_shading)(words[0] >> 13 & 0x3u);
	p->alpha_linear = words[0] >> 15 & 0x1u;
	p->alpha = words[0] >> 16 & 0xffu;
}

/* ---- triangle_small ---- */

/*
 * A TRIANGLE of at most 16x16 pixels in fewer words: its rows are sent as they are, and its
 * coefficients as short numbers with a common scale. Only inside a tile.
 *
 * Payload: pixels_small, depth, colour in the form the header names, and the rows that pixels_small
 * has not. The anchor is as TRIANGLE's, left.x being x + first_0; coefficients mean what they mean
 * there. Alpha is constant.
 */
struct gloss_triangle_small {
	enum gloss_shading shading;
	enum gloss_row_words row_words;
	uint32_t alpha;
};

/* Payload words of a packet with this header. */
static inline uint32_t gloss_triangle_small_length(const struct gloss_triangle_small *p)
{
	uint32_t length = 0;

	length += GLOSS_PIXELS_SMALL_WORDS;
	length += GLOSS_DEPTH_SMALL_WORDS;
	if (p->shading == GLOSS_SHADING_FLAT)
		length += GLOSS_COLOUR_FLAT_WORDS;
	if (p->shading == GLOSS_SHADING_LINEAR)
		length += GLOSS_COLOUR_LINEAR_SMALL_WORDS;
	if (p->shading == GLOSS_SHADING_SECOND_ORDER)
		length += GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS;
	if (p->row_words == GLOSS_ROW_WORDS_ONE)
		length += GLOSS_ROWS_ONE_WORDS;
	if (p->row_words == GLOSS_ROW_WORDS_TWO)
		length += GLOSS_ROWS_TWO_WORDS;
	if (p->row_words == GLOSS_ROW_WORDS_THREE)
		length += GLOSS_ROWS_THREE_WORDS;
	if (p->row_words == GLOSS_ROW_WORDS_FOUR)
		length += GLOSS_ROWS_FOUR_WORDS;
	return length;
}

/* Writes the header. */
static inline void gloss_triangle_small_pack(uint32_t *words, const struct gloss_triangle_small *p)
{
	words[0] = (uint32_t)GLOSS_OP_TRIANGLE_SMALL << 24 | gloss_triangle_small_length(p) |
		   ((uint32_t)p->shading & 0x3u) << 11 |
		   ((uint32_t)p->row_words & 0x7u) << 13 |
		   (p->alpha & 0xffu) << 16;
}

/* @words starts at the header. */
static inline void gloss_triangle_small_unpack(const uint32_t *words,
					       struct gloss_triangle_small *p)
{
	p->shading = (enum gloss_shading)(words[0] >> 11 & 0x3u);
	p->row_words = (enum gloss_row_words)(words[0] >> 13 & 0x7u);
	p->alpha = words[0] >> 16 & 0xffu;
}

/* ---- status ---- */

#define GLOSS_STATUS_WORDS 3

/* What the core reports at the end of a job. */
struct gloss_status {
	enum gloss_fault cause;
	/* Word offset of the fault; the stream's length without one. */
	uint32_t offset;
	/* Words of the response stream that are valid. */
	uint32_t response_words;
};

static inline void gloss_status_pack(uint32_t *words, const struct gloss_status *p)
{
	words[0] = (uint32_t)p->cause & 0xfu;
	words[1] = p->offset;
	words[2] = p->response_words;
}

static inline void gloss_status_unpack(const uint32_t *words, struct gloss_status *p)
{
	p->cause = (enum gloss_fault)(words[0] & 0xfu);
	p->offset = words[1];
	p->response_words = words[2];
}

/* ---- slot_entry ---- */

#define GLOSS_SLOT_ENTRY_WORDS 4

/*
 * A range of board memory that the job's stream may name by its number. A slot that leaves board
 * memory is the driver's mistake. A job with one harms no other job; it ends with MEMORY, or as it
 * would without that.
 */
struct gloss_slot_entry {
	/* Byte address in board memory, a multiple of 4096. */
	uint32_t base;
	/* Bytes; base + size is at most 2^32. An empty slot has 0. */
	uint32_t size;
	enum gloss_rights rights;
};

static inline void gloss_slot_entry_pack(uint32_t *words, const struct gloss_slot_entry *p)
{
	words[0] = p->base;
	words[1] = p->size;
	words[2] = (uint32_t)p->rights & 0x3u;
	words[3] = 0;
}

static inline void gloss_slot_entry_unpack(const uint32_t *words, struct gloss_slot_entry *p)
{
	p->base = words[0];
	p->size = words[1];
	p->rights = (enum gloss_rights)(words[2] & 0x3u);
}

/* ---- job_descriptor ---- */

#define GLOSS_JOB_DESCRIPTOR_WORDS 16

/* An entry of the ring. Words without a field are zero, but not looked at. */
struct gloss_job_descriptor {
	/* The driver's number of the job; comes back in its completion. */
	uint32_t sequence;
	/* Length of the stream. */
	uint32_t stream_words;
	/*
	 * Address of the list of the stream's pages, a multiple of 8; not looked at without words.
	 */
	uint32_t stream_list_low;
	uint32_t stream_list_high;
	/* Room for the response. */
	uint32_t response_words;
	/*
	 * Address of the list of the response's pages, a multiple of 8; not looked at without
	 * words.
	 */
	uint32_t response_list_low;
	uint32_t response_list_high;
	/* Address of the slot table, a multiple of 64: slots times a slot_entry. */
	uint32_t slot_table_low;
	uint32_t slot_table_high;
};

static inline void gloss_job_descriptor_pack(uint32_t *words, const struct gloss_job_descriptor *p)
{
	words[0] = p->sequence;
	words[1] = p->stream_words;
	words[2] = p->stream_list_low;
	words[3] = p->stream_list_high;
	words[4] = p->response_words;
	words[5] = 0;
	words[6] = p->response_list_low;
	words[7] = p->response_list_high;
	words[8] = p->slot_table_low;
	words[9] = p->slot_table_high;
	words[10] = 0;
	words[11] = 0;
	words[12] = 0;
	words[13] = 0;
	words[14] = 0;
	words[15] = 0;
}

static inline void gloss_job_descriptor_unpack(const uint32_t *words,
					       struct gloss_job_descriptor *p)
{
	p->sequence = words[0];
	p->stream_words = words[1];
	p->stream_list_low = words[2];
	p->stream_list_high = words[3];
	p->response_words = words[4];
	p->response_list_low = words[6];
	p->response_list_high = words[7];
	p->slot_table_low = words[8];
	p->slot_table_high = words[9];
}

/* ---- completion ---- */

#define GLOSS_COMPLETION_WORDS 4

/* How a job ended; the words of struct status behind its sequence. */
struct gloss_completion {
	/* That of its descriptor. */
	uint32_t sequence;
	enum gloss_fault cause;
	/* Word offset of the fault; the stream's length without one. */
	uint32_t offset;
	/* Words of the response that were answered. */
	uint32_t response_words;
};

static inline void gloss_completion_pack(uint32_t *words, const struct gloss_completion *p)
{
	words[0] = p->sequence;
	words[1] = (uint32_t)p->cause & 0xfu;
	words[2] = p->offset;
	words[3] = p->response_words;
}

static inline void gloss_completion_unpack(const uint32_t *words, struct gloss_completion *p)
{
	p->sequence = words[0];
	p->cause = (enum gloss_fault)(words[1] & 0xfu);
	p->offset = words[2];
	p->response_words = words[3];
}

/* ---- usb_sync ---- */

#define GLOSS_USB_SYNC_WORDS 4

/* Makes OUT a sequence of jobs; comes back on IN. */
struct gloss_usb_sync {
	/* The constant usb_sync_magic. */
	uint32_t mark;
	/* What is in NONCE. */
	uint32_t nonce;
	/* All bits of nonce inverted. */
	uint32_t nonce_complement;
	/* All bits of mark inverted. */
	uint32_t mark_complement;
};

static inline void gloss_usb_sync_pack(uint32_t *words, const struct gloss_usb_sync *p)
{
	words[0] = p->mark;
	words[1] = p->nonce;
	words[2] = p->nonce_complement;
	words[3] = p->mark_complement;
}

static inline void gloss_usb_sync_unpack(const uint32_t *words, struct gloss_usb_sync *p)
{
	p->mark = words[0];
	p->nonce = words[1];
	p->nonce_complement = words[2];
	p->mark_complement = words[3];
}

/* ---- usb_job ---- */

#define GLOSS_USB_JOB_WORDS 4

/* A job on OUT; its slots, its stream and a usb_job_end follow. */
struct gloss_usb_job {
	/* How many slot_entry follow, at most the constant slots. */
	uint32_t slots;
	/* The constant usb_job_magic. */
	uint32_t mark;
	/* The driver's number of the job; comes back in its usb_completion. */
	uint32_t sequence;
	/* Length of the stream. */
	uint32_t stream_words;
	/* Room for the response. */
	uint32_t response_words;
};

static inline void gloss_usb_job_pack(uint32_t *words, const struct gloss_usb_job *p)
{
	words[0] = (p->slots & 0x1fu) |
		   (p->mark & 0xffffffu) << 8;
	words[1] = p->sequence;
	words[2] = p->stream_words;
	words[3] = p->response_words;
}

static inline void gloss_usb_job_unpack(const uint32_t *words, struct gloss_usb_job *p)
{
	p->slots = words[0] & 0x1fu;
	p->mark = words[0] >> 8;
	p->sequence = words[1];
	p->stream_words = words[2];
	p->response_words = words[3];
}

/* ---- usb_job_end ---- */

#define GLOSS_USB_JOB_END_WORDS 1

/* A job's last word on OUT. */
struct gloss_usb_job_end {
	uint32_t checksum;
};

static inline void gloss_usb_job_end_pack(uint32_t *words, const struct gloss_usb_job_end *p)
{
	words[0] = p->checksum;
}

static inline void gloss_usb_job_end_unpack(const uint32_t *words, struct gloss_usb_job_end *p)
{
	p->checksum = words[0];
}

/* ---- usb_response ---- */

#define GLOSS_USB_RESPONSE_WORDS 1

/* A chunk of a job's response on IN; its words follow. */
struct gloss_usb_response {
	/* Words, 1 to usb_chunk_words. */
	uint32_t count;
	/* The constant usb_response_magic. */
	uint32_t mark;
};

static inline void gloss_usb_response_pack(uint32_t *words, const struct gloss_usb_response *p)
{
	words[0] = (p->count & 0xffffu) |
		   (p->mark & 0xffffu) << 16;
}

static inline void gloss_usb_response_unpack(const uint32_t *words, struct gloss_usb_response *p)
{
	p->count = words[0] & 0xffffu;
	p->mark = words[0] >> 16;
}

/* ---- usb_completion ---- */

#define GLOSS_USB_COMPLETION_WORDS 5

/* How a job ended, on IN. */
struct gloss_usb_completion {
	enum gloss_fault cause;
	/* The constant usb_completion_magic. */
	uint32_t mark;
	/* That of its usb_job. */
	uint32_t sequence;
	/* Word offset of the fault; the stream's length without one. */
	uint32_t offset;
	/* Words of the response that were answered. */
	uint32_t response_words;
	uint32_t checksum;
};

static inline void gloss_usb_completion_pack(uint32_t *words, const struct gloss_usb_completion *p)
{
	words[0] = ((uint32_t)p->cause & 0xfu) |
		   (p->mark & 0xffffu) << 16;
	words[1] = p->sequence;
	words[2] = p->offset;
	words[3] = p->response_words;
	words[4] = p->checksum;
}

static inline void gloss_usb_completion_unpack(const uint32_t *words,
					       struct gloss_usb_completion *p)
{
	p->cause = (enum gloss_fault)(words[0] & 0xfu);
	p->mark = words[0] >> 16;
	p->sequence = words[1];
	p->offset = words[2];
	p->response_words = words[3];
	p->checksum = words[4];
}

/* ---- usb_event ---- */

#define GLOSS_USB_EVENT_WORDS 2

/* What a driver may want to know before it comes to it on IN. */
struct gloss_usb_event {
	/* Of the job that has ended with a fault. */
	enum gloss_fault cause;
	/* The channel is lost; cause and sequence are 0. */
	bool lost;
	/* The constant usb_event_magic. */
	uint32_t mark;
	/* That of the job. */
	uint32_t sequence;
};

static inline void gloss_usb_event_pack(uint32_t *words, const struct gloss_usb_event *p)
{
	words[0] = ((uint32_t)p->cause & 0xfu) |
		   (uint32_t)p->lost << 4 |
		   (p->mark & 0xffffu) << 16;
	words[1] = p->sequence;
}

static inline void gloss_usb_event_unpack(const uint32_t *words, struct gloss_usb_event *p)
{
	p->cause = (enum gloss_fault)(words[0] & 0xfu);
	p->lost = words[0] >> 4 & 0x1u;
	p->mark = words[0] >> 16;
	p->sequence = words[1];
}

/* ---- any packet ---- */

static inline bool gloss_opcode_known(unsigned int opcode)
{
	switch (opcode) {
	case GLOSS_OP_NOP:
	case GLOSS_OP_WRITE_MEMORY:
	case GLOSS_OP_READ_MEMORY:
	case GLOSS_OP_COUNTERS:
	case GLOSS_OP_COLOUR_SURFACE:
	case GLOSS_OP_DEPTH_SURFACE:
	case GLOSS_OP_TILE_BEGIN:
	case GLOSS_OP_TILE_END:
	case GLOSS_OP_DEPTH_STATE:
	case GLOSS_OP_COLOUR_MASK:
	case GLOSS_OP_SCISSOR:
	case GLOSS_OP_TRIANGLE:
	case GLOSS_OP_TRIANGLE_SMALL:
		return true;
	default:
		return false;
	}
}

/* Are the header's reserved bits zero and its fields in range? The opcode is known. */
static inline bool gloss_header_valid(uint32_t header)
{
	switch (gloss_header_opcode(header)) {
	case GLOSS_OP_NOP:
		return !(header & 0x00fff800u);
	case GLOSS_OP_WRITE_MEMORY:
		return !(header & 0x00fff800u);
	case GLOSS_OP_READ_MEMORY:
		return !(header & 0x00fff800u);
	case GLOSS_OP_COUNTERS:
		return !(header & 0x00fff800u);
	case GLOSS_OP_COLOUR_SURFACE:
		return !(header & 0x00fff800u);
	case GLOSS_OP_DEPTH_SURFACE:
		return !(header & 0x00fff800u);
	case GLOSS_OP_TILE_BEGIN:
		return !(header & 0x00ffe000u);
	case GLOSS_OP_TILE_END:
		return !((header & 0x00ff8000u) || (header >> 11 & 0x3u) > 2 ||
			 (header >> 13 & 0x3u) > 2);
	case GLOSS_OP_DEPTH_STATE:
		return !(header & 0x00ff8000u);
	case GLOSS_OP_COLOUR_MASK:
		return !(header & 0x00ff8000u);
	case GLOSS_OP_SCISSOR:
		return !(header & 0x00fff800u);
	case GLOSS_OP_TRIANGLE:
		return !((header >> 11 & 0x3u) > 2 || (header >> 13 & 0x3u) > 2);
	case GLOSS_OP_TRIANGLE_SMALL:
		return !((header >> 11 & 0x3u) > 2 || (header >> 13 & 0x7u) > 4);
	default:
		return false;
	}
}

#endif
