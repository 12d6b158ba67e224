/* SPDX-License-Identifier: MIT */
/* Generated from rtl/gloss.xml by tools/hwgen; do not edit. */
#ifndef GLOSS_TABLE_H
#define GLOSS_TABLE_H

#include "decode/table.h"

static const struct table_value table_values_fault[] = {
	{ 0, "none" },
	{ 1, "opcode" },
	{ 2, "length" },
	{ 3, "value" },
	{ 4, "order" },
	{ 5, "slot" },
	{ 6, "response" },
	{ 7, "memory" },
	{ 8, "dma" },
};

static const struct table_enum table_enum_fault = {
	"fault", 9, table_values_fault
};

static const struct table_value table_values_compare[] = {
	{ 0, "never" },
	{ 1, "less" },
	{ 2, "equal" },
	{ 3, "lequal" },
	{ 4, "greater" },
	{ 5, "notequal" },
	{ 6, "gequal" },
	{ 7, "always" },
};

static const struct table_enum table_enum_compare = {
	"compare", 8, table_values_compare
};

static const struct table_value table_values_geometry[] = {
	{ 0, "wide" },
	{ 1, "compact" },
	{ 2, "covering" },
};

static const struct table_enum table_enum_geometry = {
	"geometry", 3, table_values_geometry
};

static const struct table_value table_values_shading[] = {
	{ 0, "flat" },
	{ 1, "linear" },
	{ 2, "second_order" },
};

static const struct table_enum table_enum_shading = {
	"shading", 3, table_values_shading
};

static const struct table_value table_values_row_words[] = {
	{ 0, "none" },
	{ 1, "one" },
	{ 2, "two" },
	{ 3, "three" },
	{ 4, "four" },
};

static const struct table_enum table_enum_row_words = {
	"row_words", 5, table_values_row_words
};

static const struct table_value table_values_tile_output[] = {
	{ 0, "drop" },
	{ 1, "store" },
	{ 2, "answer" },
};

static const struct table_enum table_enum_tile_output = {
	"tile_output", 3, table_values_tile_output
};

static const struct table_field table_fields_edges_wide[] = {
	{ .name = "left_x", .word = 0, .high = 12, .low = 0,
	  .type = TABLE_INT, .min = -4096, .max = 4095 },
	{ .name = "left_step", .word = 0, .high = 28, .low = 16,
	  .type = TABLE_INT, .min = -4096, .max = 4095 },
	{ .name = "left_r", .word = 1, .high = 15, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "left_m", .word = 1, .high = 31, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "left_dy", .word = 2, .high = 15, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "first_row", .word = 2, .high = 21, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "last_row", .word = 2, .high = 29, .low = 24,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "right_x", .word = 3, .high = 12, .low = 0,
	  .type = TABLE_INT, .min = -4096, .max = 4095 },
	{ .name = "right_step", .word = 3, .high = 28, .low = 16,
	  .type = TABLE_INT, .min = -4096, .max = 4095 },
	{ .name = "right_r", .word = 4, .high = 15, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "right_m", .word = 4, .high = 31, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "right_dy", .word = 5, .high = 15, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "switch_row", .word = 5, .high = 21, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "side", .word = 5, .high = 24, .low = 24,
	  .type = TABLE_UINT, .min = 0, .max = 1 },
	{ .name = "middle_x", .word = 6, .high = 12, .low = 0,
	  .type = TABLE_INT, .min = -4096, .max = 4095 },
	{ .name = "middle_step", .word = 6, .high = 28, .low = 16,
	  .type = TABLE_INT, .min = -4096, .max = 4095 },
	{ .name = "middle_r", .word = 7, .high = 15, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "middle_m", .word = 7, .high = 31, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
	{ .name = "middle_dy", .word = 8, .high = 15, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 65535 },
};

static const struct table_record table_edges_wide =
	{ "edges_wide", 9, 19, table_fields_edges_wide };

static const struct table_field table_fields_edges_compact[] = {
	{ .name = "left_r", .word = 0, .high = 9, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "left_m", .word = 0, .high = 19, .low = 10,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "left_dy", .word = 0, .high = 29, .low = 20,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "left_x", .word = 1, .high = 7, .low = 0,
	  .type = TABLE_INT, .min = -128, .max = 127 },
	{ .name = "left_step", .word = 1, .high = 15, .low = 8,
	  .type = TABLE_INT, .min = -128, .max = 127 },
	{ .name = "first_row", .word = 1, .high = 21, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "last_row", .word = 1, .high = 29, .low = 24,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "right_r", .word = 2, .high = 9, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "right_m", .word = 2, .high = 19, .low = 10,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "right_dy", .word = 2, .high = 29, .low = 20,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "right_x", .word = 3, .high = 7, .low = 0,
	  .type = TABLE_INT, .min = -128, .max = 127 },
	{ .name = "right_step", .word = 3, .high = 15, .low = 8,
	  .type = TABLE_INT, .min = -128, .max = 127 },
	{ .name = "switch_row", .word = 3, .high = 21, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "side", .word = 3, .high = 24, .low = 24,
	  .type = TABLE_UINT, .min = 0, .max = 1 },
	{ .name = "middle_r", .word = 4, .high = 9, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "middle_m", .word = 4, .high = 19, .low = 10,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "middle_dy", .word = 4, .high = 29, .low = 20,
	  .type = TABLE_UINT, .min = 0, .max = 1023 },
	{ .name = "middle_x", .word = 5, .high = 7, .low = 0,
	  .type = TABLE_INT, .min = -128, .max = 127 },
	{ .name = "middle_step", .word = 5, .high = 15, .low = 8,
	  .type = TABLE_INT, .min = -128, .max = 127 },
};

static const struct table_record table_edges_compact =
	{ "edges_compact", 6, 19, table_fields_edges_compact };

static const struct table_field table_fields_depth_wide[] = {
	{ .name = "z", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295,
	  .rest = &table_fields_depth_wide[3], .fixed = true, .fraction = 12 },
	{ .name = "dx", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295,
	  .rest = &table_fields_depth_wide[4], .fixed = true, .fraction = 12 },
	{ .name = "dy", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295,
	  .rest = &table_fields_depth_wide[5], .fixed = true, .fraction = 12 },
	{ .name = "z_high", .word = 3, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255, .is_rest = true },
	{ .name = "dx_high", .word = 3, .high = 15, .low = 8,
	  .type = TABLE_UINT, .min = 0, .max = 255, .is_rest = true },
	{ .name = "dy_high", .word = 3, .high = 23, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 255, .is_rest = true },
};

static const struct table_record table_depth_wide =
	{ "depth_wide", 4, 6, table_fields_depth_wide };

static const struct table_field table_fields_depth_compact[] = {
	{ .name = "z", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_INT, .min = -2147483648, .max = 2147483647, .fixed = true, .fraction = 6 },
	{ .name = "dx", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_INT, .min = -2147483648, .max = 2147483647, .fixed = true, .fraction = 6 },
	{ .name = "dy", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_INT, .min = -2147483648, .max = 2147483647, .fixed = true, .fraction = 6 },
};

static const struct table_record table_depth_compact =
	{ "depth_compact", 3, 3, table_fields_depth_compact };

static const struct table_field table_fields_alpha_linear[] = {
	{ .name = "a", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "a_dx", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "a_dy", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
};

static const struct table_record table_alpha_linear =
	{ "alpha_linear", 3, 3, table_fields_alpha_linear };

static const struct table_field table_fields_colour_flat[] = {
	{ .name = "red", .word = 0, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "green", .word = 0, .high = 15, .low = 8,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "blue", .word = 0, .high = 23, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
};

static const struct table_record table_colour_flat =
	{ "colour_flat", 1, 3, table_fields_colour_flat };

static const struct table_field table_fields_colour_linear[] = {
	{ .name = "red", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dx", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dy", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green", .word = 3, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dx", .word = 4, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dy", .word = 5, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue", .word = 6, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dx", .word = 7, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dy", .word = 8, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
};

static const struct table_record table_colour_linear =
	{ "colour_linear", 9, 9, table_fields_colour_linear };

static const struct table_field table_fields_colour_second_order[] = {
	{ .name = "red", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dx", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dy", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dxx", .word = 3, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dxy", .word = 4, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "red_dyy", .word = 5, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green", .word = 6, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dx", .word = 7, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dy", .word = 8, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dxx", .word = 9, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dxy", .word = 10, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "green_dyy", .word = 11, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue", .word = 12, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dx", .word = 13, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dy", .word = 14, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dxx", .word = 15, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dxy", .word = 16, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
	{ .name = "blue_dyy", .word = 17, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .fixed = true, .fraction = 22 },
};

static const struct table_record table_colour_second_order =
	{ "colour_second_order", 18, 18, table_fields_colour_second_order };

static const struct table_field table_fields_pixels_small[] = {
	{ .name = "x", .word = 0, .high = 5, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "first_row", .word = 0, .high = 11, .low = 6,
	  .type = TABLE_UINT, .min = 0, .max = 63 },
	{ .name = "last_row", .word = 0, .high = 15, .low = 12,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "first_0", .word = 0, .high = 19, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "last_0", .word = 0, .high = 23, .low = 20,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "first_1", .word = 0, .high = 27, .low = 24,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "last_1", .word = 0, .high = 31, .low = 28,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
};

static const struct table_record table_pixels_small =
	{ "pixels_small", 1, 7, table_fields_pixels_small };

static const struct table_field table_fields_rows_one[] = {
	{ .name = "rows_2", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_record table_rows_one =
	{ "rows_one", 1, 1, table_fields_rows_one };

static const struct table_field table_fields_rows_two[] = {
	{ .name = "rows_2", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "rows_6", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_record table_rows_two =
	{ "rows_two", 2, 2, table_fields_rows_two };

static const struct table_field table_fields_rows_three[] = {
	{ .name = "rows_2", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "rows_6", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "rows_10", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_record table_rows_three =
	{ "rows_three", 3, 3, table_fields_rows_three };

static const struct table_field table_fields_rows_four[] = {
	{ .name = "rows_2", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "rows_6", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "rows_10", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "rows_14", .word = 3, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_record table_rows_four =
	{ "rows_four", 4, 4, table_fields_rows_four };

static const struct table_field table_fields_depth_small[] = {
	{ .name = "z", .word = 0, .high = 31, .low = 0,
	  .type = TABLE_INT, .min = -2147483648, .max = 2147483647, .fixed = true, .fraction = 4 },
	{ .name = "dx", .word = 1, .high = 14, .low = 0,
	  .type = TABLE_INT, .min = -16384, .max = 16383 },
	{ .name = "dy", .word = 1, .high = 29, .low = 15,
	  .type = TABLE_INT, .min = -16384, .max = 16383 },
	{ .name = "scale", .word = 1, .high = 31, .low = 30,
	  .type = TABLE_UINT, .min = 0, .max = 3 },
};

static const struct table_record table_depth_small =
	{ "depth_small", 2, 4, table_fields_depth_small };

static const struct table_field table_fields_colour_linear_small[] = {
	{ .name = "red", .word = 0, .high = 9, .low = 0,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "green", .word = 0, .high = 19, .low = 10,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "blue", .word = 0, .high = 29, .low = 20,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "slope_scale", .word = 0, .high = 31, .low = 30,
	  .type = TABLE_UINT, .min = 0, .max = 3 },
	{ .name = "red_fraction", .word = 1, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "red_dx", .word = 1, .high = 19, .low = 8,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "red_dy", .word = 1, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "green_fraction", .word = 2, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "green_dx", .word = 2, .high = 19, .low = 8,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "green_dy", .word = 2, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "blue_fraction", .word = 3, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "blue_dx", .word = 3, .high = 19, .low = 8,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "blue_dy", .word = 3, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
};

static const struct table_record table_colour_linear_small =
	{ "colour_linear_small", 4, 13, table_fields_colour_linear_small };

static const struct table_field table_fields_colour_second_order_small[] = {
	{ .name = "red", .word = 0, .high = 9, .low = 0,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "green", .word = 0, .high = 19, .low = 10,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "blue", .word = 0, .high = 29, .low = 20,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "slope_scale", .word = 0, .high = 31, .low = 30,
	  .type = TABLE_UINT, .min = 0, .max = 3 },
	{ .name = "red_fraction", .word = 1, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "red_dx", .word = 1, .high = 19, .low = 8,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "red_dy", .word = 1, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "green_fraction", .word = 2, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "green_dx", .word = 2, .high = 19, .low = 8,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "green_dy", .word = 2, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "blue_fraction", .word = 3, .high = 7, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
	{ .name = "blue_dx", .word = 3, .high = 19, .low = 8,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "blue_dy", .word = 3, .high = 31, .low = 20,
	  .type = TABLE_INT, .min = -2048, .max = 2047 },
	{ .name = "red_dxx", .word = 4, .high = 9, .low = 0,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "red_dxy", .word = 4, .high = 19, .low = 10,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "red_dyy", .word = 4, .high = 29, .low = 20,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "red_scale", .word = 4, .high = 31, .low = 30,
	  .type = TABLE_UINT, .min = 0, .max = 3 },
	{ .name = "green_dxx", .word = 5, .high = 9, .low = 0,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "green_dxy", .word = 5, .high = 19, .low = 10,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "green_dyy", .word = 5, .high = 29, .low = 20,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "green_scale", .word = 5, .high = 31, .low = 30,
	  .type = TABLE_UINT, .min = 0, .max = 3 },
	{ .name = "blue_dxx", .word = 6, .high = 9, .low = 0,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "blue_dxy", .word = 6, .high = 19, .low = 10,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "blue_dyy", .word = 6, .high = 29, .low = 20,
	  .type = TABLE_INT, .min = -512, .max = 511 },
	{ .name = "blue_scale", .word = 6, .high = 31, .low = 30,
	  .type = TABLE_UINT, .min = 0, .max = 3 },
};

static const struct table_record table_colour_second_order_small =
	{ "colour_second_order_small", 7, 25, table_fields_colour_second_order_small };

static const struct table_field table_fields_write_memory[] = {
	{ .name = "slot", .word = 1, .high = 3, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "offset", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_field table_fields_read_memory[] = {
	{ .name = "slot", .word = 1, .high = 3, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "count", .word = 1, .high = 31, .low = 16,
	  .type = TABLE_UINT, .min = 1, .max = 65535 },
	{ .name = "offset", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_field table_fields_colour_surface[] = {
	{ .name = "slot", .word = 1, .high = 3, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "pitch", .word = 1, .high = 31, .low = 16,
	  .type = TABLE_UINT, .min = 1, .max = 65535 },
};

static const struct table_field table_fields_depth_surface[] = {
	{ .name = "slot", .word = 1, .high = 3, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 15 },
	{ .name = "pitch", .word = 1, .high = 31, .low = 16,
	  .type = TABLE_UINT, .min = 1, .max = 65535 },
};

static const struct table_field table_fields_tile_begin[] = {
	{ .name = "colour_load", .word = 0, .high = 11, .low = 11,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "depth_load", .word = 0, .high = 12, .low = 12,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "colour", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "depth", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_field table_fields_tile_end[] = {
	{ .name = "colour_output", .word = 0, .high = 12, .low = 11,
	  .type = TABLE_ENUM, .min = 0, .max = 3, .enumeration = &table_enum_tile_output },
	{ .name = "depth_output", .word = 0, .high = 14, .low = 13,
	  .type = TABLE_ENUM, .min = 0, .max = 3, .enumeration = &table_enum_tile_output },
	{ .name = "colour", .word = 1, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
	{ .name = "depth", .word = 2, .high = 31, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 4294967295, .hex = true },
};

static const struct table_field table_fields_depth_state[] = {
	{ .name = "func", .word = 0, .high = 13, .low = 11,
	  .type = TABLE_ENUM, .min = 0, .max = 7, .enumeration = &table_enum_compare },
	{ .name = "write", .word = 0, .high = 14, .low = 14,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
};

static const struct table_field table_fields_colour_mask[] = {
	{ .name = "red", .word = 0, .high = 11, .low = 11,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "green", .word = 0, .high = 12, .low = 12,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "blue", .word = 0, .high = 13, .low = 13,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "alpha", .word = 0, .high = 14, .low = 14,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
};

static const struct table_field table_fields_scissor[] = {
	{ .name = "x0", .word = 1, .high = 6, .low = 0,
	  .type = TABLE_UINT, .min = 0, .max = 127 },
	{ .name = "y0", .word = 1, .high = 14, .low = 8,
	  .type = TABLE_UINT, .min = 0, .max = 127 },
	{ .name = "x1", .word = 1, .high = 22, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 127 },
	{ .name = "y1", .word = 1, .high = 30, .low = 24,
	  .type = TABLE_UINT, .min = 0, .max = 127 },
};

static const struct table_field table_fields_triangle[] = {
	{ .name = "geometry", .word = 0, .high = 12, .low = 11,
	  .type = TABLE_ENUM, .min = 0, .max = 3, .enumeration = &table_enum_geometry },
	{ .name = "shading", .word = 0, .high = 14, .low = 13,
	  .type = TABLE_ENUM, .min = 0, .max = 3, .enumeration = &table_enum_shading },
	{ .name = "alpha_linear", .word = 0, .high = 15, .low = 15,
	  .type = TABLE_BOOL, .min = 0, .max = 1 },
	{ .name = "alpha", .word = 0, .high = 23, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
};

static const struct table_part table_parts_triangle[] = {
	{ &table_edges_wide, 12, 11, 0, false },
	{ &table_edges_compact, 12, 11, 1, false },
	{ &table_depth_wide, 12, 11, 0, false },
	{ &table_depth_compact, 12, 11, 1, false },
	{ &table_depth_wide, 12, 11, 2, false },
	{ &table_alpha_linear, 15, 15, 1, false },
	{ &table_colour_flat, 14, 13, 0, false },
	{ &table_colour_linear, 14, 13, 1, false },
	{ &table_colour_second_order, 14, 13, 2, false },
};

static const struct table_field table_fields_triangle_small[] = {
	{ .name = "shading", .word = 0, .high = 12, .low = 11,
	  .type = TABLE_ENUM, .min = 0, .max = 3, .enumeration = &table_enum_shading },
	{ .name = "row_words", .word = 0, .high = 15, .low = 13,
	  .type = TABLE_ENUM, .min = 0, .max = 7, .enumeration = &table_enum_row_words },
	{ .name = "alpha", .word = 0, .high = 23, .low = 16,
	  .type = TABLE_UINT, .min = 0, .max = 255 },
};

static const struct table_part table_parts_triangle_small[] = {
	{ &table_pixels_small, 0, 0, 0, true },
	{ &table_depth_small, 0, 0, 0, true },
	{ &table_colour_flat, 12, 11, 0, false },
	{ &table_colour_linear_small, 12, 11, 1, false },
	{ &table_colour_second_order_small, 12, 11, 2, false },
	{ &table_rows_one, 15, 13, 1, false },
	{ &table_rows_two, 15, 13, 2, false },
	{ &table_rows_three, 15, 13, 3, false },
	{ &table_rows_four, 15, 13, 4, false },
};

static const struct table_packet table_packets[] = {
	{ 0x00, 0, { "nop", 0, 0, 0 },
	  0, 0, true },
	{ 0x01, 3, { "write_memory", 2, 2, table_fields_write_memory },
	  0, 0, true },
	{ 0x02, 2, { "read_memory", 2, 3, table_fields_read_memory },
	  0, 0, false },
	{ 0x03, 0, { "counters", 0, 0, 0 },
	  0, 0, false },
	{ 0x08, 1, { "colour_surface", 1, 2, table_fields_colour_surface },
	  0, 0, false },
	{ 0x09, 1, { "depth_surface", 1, 2, table_fields_depth_surface },
	  0, 0, false },
	{ 0x10, 2, { "tile_begin", 2, 4, table_fields_tile_begin },
	  0, 0, false },
	{ 0x11, 2, { "tile_end", 2, 4, table_fields_tile_end },
	  0, 0, false },
	{ 0x20, 0, { "depth_state", 0, 2, table_fields_depth_state },
	  0, 0, false },
	{ 0x21, 0, { "colour_mask", 0, 4, table_fields_colour_mask },
	  0, 0, false },
	{ 0x22, 1, { "scissor", 1, 4, table_fields_scissor },
	  0, 0, false },
	{ 0x30, 0, { "triangle", 0, 4, table_fields_triangle },
	  table_parts_triangle, 9, true },
	{ 0x32, 0, { "triangle_small", 0, 3, table_fields_triangle_small },
	  table_parts_triangle_small, 9, true },
};

#endif
