// SPDX-License-Identifier: Apache-2.0
// Generated from rtl/small.xml by tools/hwgen; do not edit. Included in small_pkg.

  // As the interface says.
  localparam int unsigned Version = 3;
  localparam int unsigned RowBytes = 32'h100;
  // In both headers.
  localparam int unsigned Magic = 32'hcafe;
  localparam int unsigned WirePins = 4;

  // All values have names.
  localparam logic [1:0] COLOUR_RED = 2'd0;
  localparam logic [1:0] COLOUR_GREEN = 2'd1;
  localparam logic [1:0] COLOUR_BLUE = 2'd2;
  localparam logic [1:0] COLOUR_WHITE = 2'd3;

  localparam logic [1:0] FORM_DOT = 2'd0;
  localparam logic [1:0] FORM_LINE = 2'd1;
  localparam logic [1:0] FORM_BOX = 2'd2;

  // With gaps.
  localparam logic [3:0] POWER_ONE = 4'd1;
  localparam logic [3:0] POWER_TWO = 4'd2;
  localparam logic [3:0] POWER_EIGHT = 4'd8;

  localparam logic [7:0] OP_STOP = 8'h00;
  localparam logic [7:0] OP_SKIP = 8'h01;
  localparam logic [7:0] OP_DATA = 8'h02;
  localparam logic [7:0] OP_DRAW = 8'hff;

  // Payload words of packets whose length is fixed, and of groups.
  localparam logic [10:0] PLACE_WORDS = 11'd3;
  localparam logic [10:0] EXTENT_WORDS = 11'd2;
  localparam logic [10:0] STOP_WORDS = 11'd0;

  // Byte offsets of registers.
  localparam logic [15:0] REG_STATE = 16'h0004;
  localparam logic [15:0] REG_COUNT = 16'h0000;
  localparam logic [15:0] REG_TOP = 16'hfffc;
  localparam logic [15:0] REG_WIRE_SPEED = 16'h0010;

  // Packed structs: the lowest word of a group or payload is bits 31:0.
  // A _RESERVED mask has the bits that must be zero.

  typedef struct packed {
    logic signed [31:0] whole;  // word 2
    logic [31:0] reserved_0;  // word 1
    logic signed [11:0] x;  // word 0
    logic [7:0] reserved_1;
    logic signed [11:0] y;
  } place_t;
  localparam int unsigned PLACE_BITS = 96;
  localparam logic [PLACE_BITS-1:0] PLACE_RESERVED = {
    32'h00000000, 32'hffffffff, 32'h000ff000
  };

  typedef struct packed {
    logic [3:0] level;  // word 1
    logic [11:0] reserved_0;
    logic [3:0] mode;
    logic [3:0] reserved_1;
    logic [7:0] size_high;
    logic [31:0] size;  // word 0
  } extent_t;
  localparam int unsigned EXTENT_BITS = 64;
  localparam logic [EXTENT_BITS-1:0] EXTENT_RESERVED = {
    32'h0fff0f00, 32'h00000000
  };

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } stop_header_t;
  localparam int unsigned STOP_HEADER_BITS = 32;
  localparam logic [STOP_HEADER_BITS-1:0] STOP_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } skip_header_t;
  localparam int unsigned SKIP_HEADER_BITS = 32;
  localparam logic [SKIP_HEADER_BITS-1:0] SKIP_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } data_header_t;
  localparam int unsigned DATA_HEADER_BITS = 32;
  localparam logic [DATA_HEADER_BITS-1:0] DATA_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [31:0] address;
  } data_t;
  localparam int unsigned DATA_BITS = 32;
  localparam logic [DATA_BITS-1:0] DATA_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [7:0] opcode;
    logic [7:0] count;
    logic [1:0] reserved_0;
    logic plain;
    logic [1:0] form;
    logic [10:0] length;
  } draw_header_t;
  localparam int unsigned DRAW_HEADER_BITS = 32;
  localparam logic [DRAW_HEADER_BITS-1:0] DRAW_HEADER_RESERVED = 32'h0000c000;

  typedef struct packed {
    logic [21:0] reserved_0;
    logic [1:0] edge_;
    logic [5:0] reserved_1;
    logic [1:0] colour;
  } state_t;
  localparam int unsigned STATE_BITS = 32;
  localparam logic [STATE_BITS-1:0] STATE_RESERVED = 32'hfffffcfc;

  typedef struct packed {
    logic [23:0] reserved_0;  // word 1
    logic [7:0] high;
    logic [31:0] low;  // word 0
  } entry_t;
  localparam int unsigned ENTRY_BITS = 64;
  localparam logic [ENTRY_BITS-1:0] ENTRY_RESERVED = {
    32'hffffff00, 32'h00000000
  };

  typedef struct packed {
    logic [23:0] reserved_0;
    logic [7:0] size;
  } message_t;
  localparam int unsigned MESSAGE_BITS = 32;
  localparam logic [MESSAGE_BITS-1:0] MESSAGE_RESERVED = 32'hffffff00;

  typedef struct packed {
    logic [31:0] length;
  } wave_t;
  localparam int unsigned WAVE_BITS = 32;
  localparam logic [WAVE_BITS-1:0] WAVE_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [3:0] power;
    logic [25:0] reserved_0;
    logic [1:0] colour;
  } reg_state_t;
  localparam int unsigned REG_STATE_BITS = 32;
  localparam logic [REG_STATE_BITS-1:0] REG_STATE_RESERVED = 32'h0ffffffc;

  typedef struct packed {
    logic [30:0] reserved_0;
    logic fast;
  } reg_wire_speed_t;
  localparam int unsigned REG_WIRE_SPEED_BITS = 32;
  localparam logic [REG_WIRE_SPEED_BITS-1:0] REG_WIRE_SPEED_RESERVED = 32'hfffffffe;

