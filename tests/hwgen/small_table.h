/* SPDX-License-Identifier: MIT */
/* Generated from rtl/small.xml by tools/hwgen; do not edit. */
#ifndef SMALL_TABLE_H
#define SMALL_TABLE_H

#include "decode/table.h"

static const struct table_value table_values_colour[] = {
	{ 0, "red" },
	{ 1, "green" },
	{ 2, "blue" },
	{ 3, "white" },
};

static const struct table_enum table_enum_colour = {
	"colour", 4, table_values_colour
};

static const struct table_value table_values_form[] = {
	{ 0, "dot" },
	{ 1, "line" },
	{ 2, "box" },
};

static const struct table_enum table_enum_form = {
	"form", 3, table_values_form
};

static const struct table_value table_values_power[] = {
	{ 1, "one" },
	{ 2, "two" },
	{ 8, "eight" },
};

static const struct table_enum table_enum_power = {
	"power", 3, table_values_power
};

static const struct table_field table_fields_place[] = {
	{ .name = "x", .word = 0, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -100, .max = 2047 },
	{ .name = "y", .word = 0, .high = 11, .low = 0,
	  .type = TABLE_INT, .min = -2048, .max = 100 },
	{ .name = "whole", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_INT, .min = -2147483648, .max = 2147483647, .fixed = true, .fraction = 16 },
};

static const struct table_record table_place =
	{ "place", 3, 3, table_fields_place };

static const struct table_field table_fields_extent[] = {
	{ .name = "size", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295,
	  .rest = &table_fields_extent[1], .fixed = true, .fraction = 10 },
	{ .name = "size_high", .word = 1, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255, .is_rest = true },
	{ .name = "level", .word = 1, .high = 31, .low = 28,
	  .type = TABLE_UINT, .min = 2, .max = 9 },
	{ .name = "mode", .word = 1, .high = 15, .low = 12,
	  .type = TABLE_ENUM, .min = 0, .max = 15, .enumeration = &table_enum_power },
};

static const struct table_record table_extent =
	{ "extent", 2, 4, table_fields_extent };

static const struct table_field table_fields_data[] = {
	{ .name = "address", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_field table_fields_draw[] = {
	{ .name = "form", .word = 0, .high = 12, .low = 11,
	  .type = TABLE_ENUM, .min = 0, .max = 3, .enumeration = &table_enum_form },
	{ .name = "plain", .word = 0, .high = 13, .low = 13,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "count", .word = 0, .high = 23, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 200 },
};

static const struct table_part table_parts_draw[] = {
	{ &table_place, 0, 0, 0, true },
	{ &table_extent, 12, 11, 2, false },
	{ &table_extent, 13, 13, 0, false },
	{ &table_place, 23, 16, 7, false },
};

static const struct table_packet table_packets[] = {
	{ 0x00, 0, { "stop", 0, 0, 0 },
	  0, 0, false },
	{ 0x01, 0, { "skip", 0, 0, 0 },
	  0, 0, true },
	{ 0x02, 2, { "data", 1, 1, table_fields_data },
	  0, 0, true },
	{ 0xff, 0, { "draw", 0, 3, table_fields_draw },
	  table_parts_draw, 4, true },
};

#endif
