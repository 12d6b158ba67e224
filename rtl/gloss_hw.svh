// SPDX-License-Identifier: Apache-2.0
// Generated from rtl/gloss.xml by tools/hwgen; do not edit. Included in gloss_pkg.

  // Response words of COUNTERS.
  localparam int unsigned CounterWords = 4;
  // Fraction bits of colour coefficients (s10.22).
  localparam int unsigned ColourFraction = 22;
  // Fraction bits of depth coefficients in the core (s28.12).
  localparam int unsigned DepthFraction = 12;
  // A compact depth coefficient (s26.6) is shifted left by this.
  localparam int unsigned DepthCompactShift = 6;
  // A small record's depth (s28.4) is shifted left by this.
  localparam int unsigned SmallDepthShift = 8;
  // And its differences by this for each step of scale.
  localparam int unsigned SmallDepthScaleShift = 4;
  // A small record's colours (s10.8) and first differences are shifted left by this.
  localparam int unsigned SmallSlopeShift = 14;
  // First differences by this more for each step of slope_scale.
  localparam int unsigned SmallSlopeScaleShift = 2;
  // A small record's second differences are shifted left by this.
  localparam int unsigned SmallBendShift = 10;
  // And by this more for each step of their scale.
  localparam int unsigned SmallBendScaleShift = 3;
  // Rows of a small record that pixels_small has.
  localparam int unsigned SmallHeadRows = 2;
  // Rows of a small record in each word behind its colour.
  localparam int unsigned SmallWordRows = 4;
  // The anchor of a triangle's coefficients is at a multiple of this in x.
  localparam int unsigned AnchorAlign = 8;
  // Version of this interface; a board reports it.
  localparam int unsigned Version = 1;
  // "GLOS" in memory; what IDENTITY reads.
  localparam int unsigned Identity = 32'h534f4c47;
  // Entries of the slot table.
  localparam int unsigned Slots = 16;
  // Pages of board memory, and of host memory that lists name.
  localparam int unsigned PageBytes = 4096;
  // Logarithm to base 2 of the most entries of a job ring.
  localparam int unsigned RingMaxLog2 = 8;
  localparam int unsigned UsbVendor = 32'h1209;
  localparam int unsigned UsbProduct = 32'h1;
  // Of interface 0, whose class is ff.
  localparam int unsigned UsbSubclass = 32'h47;
  localparam int unsigned UsbProtocol = 1;
  // Bulk: the OUT channel.
  localparam int unsigned UsbEndpointOut = 32'h1;
  // Bulk: the IN channel.
  localparam int unsigned UsbEndpointIn = 32'h81;
  // Interrupt: a usb_event in 8 bytes.
  localparam int unsigned UsbEndpointEvent = 32'h82;
  // Request: wValue is the offset, 4 bytes in.
  localparam int unsigned UsbReadRegister = 1;
  // Request: wValue is the offset, 4 bytes out.
  localparam int unsigned UsbWriteRegister = 2;
  // Words of a response chunk, the last of a job apart.
  localparam int unsigned UsbChunkWords = 256;
  // "SYNC" in memory.
  localparam int unsigned UsbSyncMagic = 32'h434e5953;
  // "JOB" in memory.
  localparam int unsigned UsbJobMagic = 32'h424f4a;
  // "RS" in memory.
  localparam int unsigned UsbResponseMagic = 32'h5352;
  // "CD" in memory.
  localparam int unsigned UsbCompletionMagic = 32'h4443;
  // "EV" in memory.
  localparam int unsigned UsbEventMagic = 32'h5645;

  // Why a job stopped.
  localparam logic [3:0] FAULT_NONE = 4'd0;
  localparam logic [3:0] FAULT_OPCODE = 4'd1;
  localparam logic [3:0] FAULT_LENGTH = 4'd2;
  localparam logic [3:0] FAULT_VALUE = 4'd3;
  localparam logic [3:0] FAULT_ORDER = 4'd4;
  localparam logic [3:0] FAULT_SLOT = 4'd5;
  localparam logic [3:0] FAULT_RESPONSE = 4'd6;
  localparam logic [3:0] FAULT_MEMORY = 4'd7;
  localparam logic [3:0] FAULT_DMA = 4'd8;

  // Depth function: the fragment's depth compared with the stored one.
  localparam logic [2:0] COMPARE_NEVER = 3'd0;
  localparam logic [2:0] COMPARE_LESS = 3'd1;
  localparam logic [2:0] COMPARE_EQUAL = 3'd2;
  localparam logic [2:0] COMPARE_LEQUAL = 3'd3;
  localparam logic [2:0] COMPARE_GREATER = 3'd4;
  localparam logic [2:0] COMPARE_NOTEQUAL = 3'd5;
  localparam logic [2:0] COMPARE_GEQUAL = 3'd6;
  localparam logic [2:0] COMPARE_ALWAYS = 3'd7;

  // Form of a triangle's edges and depth plane.
  localparam logic [1:0] GEOMETRY_WIDE = 2'd0;
  localparam logic [1:0] GEOMETRY_COMPACT = 2'd1;
  localparam logic [1:0] GEOMETRY_COVERING = 2'd2;

  // Order of the colour surfaces of a triangle.
  localparam logic [1:0] SHADING_FLAT = 2'd0;
  localparam logic [1:0] SHADING_LINEAR = 2'd1;
  localparam logic [1:0] SHADING_SECOND_ORDER = 2'd2;

  // Words of rows behind the colour of a small record.
  localparam logic [2:0] ROW_WORDS_NONE = 3'd0;
  localparam logic [2:0] ROW_WORDS_ONE = 3'd1;
  localparam logic [2:0] ROW_WORDS_TWO = 3'd2;
  localparam logic [2:0] ROW_WORDS_THREE = 3'd3;
  localparam logic [2:0] ROW_WORDS_FOUR = 3'd4;

  // What becomes of a tile's colour or depth at its end.
  localparam logic [1:0] TILE_OUTPUT_DROP = 2'd0;
  localparam logic [1:0] TILE_OUTPUT_STORE = 2'd1;
  localparam logic [1:0] TILE_OUTPUT_ANSWER = 2'd2;

  // Rights of a slot.
  localparam logic [1:0] RIGHTS_NONE = 2'd0;
  localparam logic [1:0] RIGHTS_READ = 2'd1;
  localparam logic [1:0] RIGHTS_WRITE = 2'd2;
  localparam logic [1:0] RIGHTS_READ_WRITE = 2'd3;

  localparam logic [7:0] OP_NOP = 8'h00;
  localparam logic [7:0] OP_WRITE_MEMORY = 8'h01;
  localparam logic [7:0] OP_READ_MEMORY = 8'h02;
  localparam logic [7:0] OP_COUNTERS = 8'h03;
  localparam logic [7:0] OP_COLOUR_SURFACE = 8'h08;
  localparam logic [7:0] OP_DEPTH_SURFACE = 8'h09;
  localparam logic [7:0] OP_TILE_BEGIN = 8'h10;
  localparam logic [7:0] OP_TILE_END = 8'h11;
  localparam logic [7:0] OP_DEPTH_STATE = 8'h20;
  localparam logic [7:0] OP_COLOUR_MASK = 8'h21;
  localparam logic [7:0] OP_SCISSOR = 8'h22;
  localparam logic [7:0] OP_TRIANGLE = 8'h30;
  localparam logic [7:0] OP_TRIANGLE_SMALL = 8'h32;

  // Payload words of packets whose length is fixed, and of groups.
  localparam logic [10:0] READ_MEMORY_WORDS = 11'd2;
  localparam logic [10:0] COUNTERS_WORDS = 11'd0;
  localparam logic [10:0] COLOUR_SURFACE_WORDS = 11'd1;
  localparam logic [10:0] DEPTH_SURFACE_WORDS = 11'd1;
  localparam logic [10:0] TILE_BEGIN_WORDS = 11'd2;
  localparam logic [10:0] TILE_END_WORDS = 11'd2;
  localparam logic [10:0] DEPTH_STATE_WORDS = 11'd0;
  localparam logic [10:0] COLOUR_MASK_WORDS = 11'd0;
  localparam logic [10:0] SCISSOR_WORDS = 11'd1;
  localparam logic [10:0] EDGES_WIDE_WORDS = 11'd9;
  localparam logic [10:0] EDGES_COMPACT_WORDS = 11'd6;
  localparam logic [10:0] DEPTH_WIDE_WORDS = 11'd4;
  localparam logic [10:0] DEPTH_COMPACT_WORDS = 11'd3;
  localparam logic [10:0] ALPHA_LINEAR_WORDS = 11'd3;
  localparam logic [10:0] COLOUR_FLAT_WORDS = 11'd1;
  localparam logic [10:0] COLOUR_LINEAR_WORDS = 11'd9;
  localparam logic [10:0] COLOUR_SECOND_ORDER_WORDS = 11'd18;
  localparam logic [10:0] PIXELS_SMALL_WORDS = 11'd1;
  localparam logic [10:0] ROWS_ONE_WORDS = 11'd1;
  localparam logic [10:0] ROWS_TWO_WORDS = 11'd2;
  localparam logic [10:0] ROWS_THREE_WORDS = 11'd3;
  localparam logic [10:0] ROWS_FOUR_WORDS = 11'd4;
  localparam logic [10:0] DEPTH_SMALL_WORDS = 11'd2;
  localparam logic [10:0] COLOUR_LINEAR_SMALL_WORDS = 11'd4;
  localparam logic [10:0] COLOUR_SECOND_ORDER_SMALL_WORDS = 11'd7;

  // Byte offsets of registers.
  localparam logic [15:0] REG_IDENTITY = 16'h0000;
  localparam logic [15:0] REG_VERSION = 16'h0004;
  localparam logic [15:0] REG_CAPABILITIES = 16'h0008;
  localparam logic [15:0] REG_MEMORY_PAGES = 16'h000c;
  localparam logic [15:0] REG_CONTROL = 16'h0010;
  localparam logic [15:0] REG_STATUS = 16'h0014;
  localparam logic [15:0] REG_FAULT_CAUSE = 16'h0040;
  localparam logic [15:0] REG_FAULT_OFFSET = 16'h0044;
  localparam logic [15:0] REG_FAULT_SEQUENCE = 16'h0048;
  localparam logic [15:0] REG_PROGRESS = 16'h0054;
  localparam logic [15:0] REG_JOBS = 16'h0060;
  localparam logic [15:0] REG_CLOCKS_LOW = 16'h0064;
  localparam logic [15:0] REG_CLOCKS_HIGH = 16'h0068;
  localparam logic [15:0] REG_STALL_STREAM = 16'h006c;
  localparam logic [15:0] REG_STALL_RASTER = 16'h0070;
  localparam logic [15:0] REG_STALL_TILE = 16'h0074;
  localparam logic [15:0] REG_STALL_MEMORY = 16'h0078;
  localparam logic [15:0] REG_STALL_RESPONSE = 16'h007c;
  localparam logic [15:0] REG_INTERRUPT_STATUS = 16'h0018;
  localparam logic [15:0] REG_INTERRUPT_MASK = 16'h001c;
  localparam logic [15:0] REG_RING_LOW = 16'h0020;
  localparam logic [15:0] REG_RING_HIGH = 16'h0024;
  localparam logic [15:0] REG_RING_LOG2 = 16'h0028;
  localparam logic [15:0] REG_HEAD = 16'h002c;
  localparam logic [15:0] REG_TAIL = 16'h0030;
  localparam logic [15:0] REG_COMPLETION_LOW = 16'h0034;
  localparam logic [15:0] REG_COMPLETION_HIGH = 16'h0038;
  localparam logic [15:0] REG_DMA_ERROR_LOW = 16'h004c;
  localparam logic [15:0] REG_DMA_ERROR_HIGH = 16'h0050;
  localparam logic [15:0] REG_NONCE = 16'h0080;
  localparam logic [15:0] REG_BOOT = 16'h0084;

  // Packed structs: the lowest word of a group or payload is bits 31:0.
  // A _RESERVED mask has the bits that must be zero.

  typedef struct packed {
    logic [15:0] reserved_0;  // word 8
    logic [15:0] middle_dy;
    logic [15:0] middle_m;  // word 7
    logic [15:0] middle_r;
    logic [2:0] reserved_1;  // word 6
    logic signed [12:0] middle_step;
    logic [2:0] reserved_2;
    logic signed [12:0] middle_x;
    logic [6:0] reserved_3;  // word 5
    logic side;
    logic [1:0] reserved_4;
    logic [5:0] switch_row;
    logic [15:0] right_dy;
    logic [15:0] right_m;  // word 4
    logic [15:0] right_r;
    logic [2:0] reserved_5;  // word 3
    logic signed [12:0] right_step;
    logic [2:0] reserved_6;
    logic signed [12:0] right_x;
    logic [1:0] reserved_7;  // word 2
    logic [5:0] last_row;
    logic [1:0] reserved_8;
    logic [5:0] first_row;
    logic [15:0] left_dy;
    logic [15:0] left_m;  // word 1
    logic [15:0] left_r;
    logic [2:0] reserved_9;  // word 0
    logic signed [12:0] left_step;
    logic [2:0] reserved_10;
    logic signed [12:0] left_x;
  } edges_wide_t;
  localparam int unsigned EDGES_WIDE_BITS = 288;
  localparam logic [EDGES_WIDE_BITS-1:0] EDGES_WIDE_RESERVED = {
    32'hffff0000, 32'h00000000, 32'he000e000, 32'hfec00000, 32'h00000000, 32'he000e000,
    32'hc0c00000, 32'h00000000, 32'he000e000
  };

  typedef struct packed {
    logic [15:0] reserved_0;  // word 5
    logic signed [7:0] middle_step;
    logic signed [7:0] middle_x;
    logic [1:0] reserved_1;  // word 4
    logic [9:0] middle_dy;
    logic [9:0] middle_m;
    logic [9:0] middle_r;
    logic [6:0] reserved_2;  // word 3
    logic side;
    logic [1:0] reserved_3;
    logic [5:0] switch_row;
    logic signed [7:0] right_step;
    logic signed [7:0] right_x;
    logic [1:0] reserved_4;  // word 2
    logic [9:0] right_dy;
    logic [9:0] right_m;
    logic [9:0] right_r;
    logic [1:0] reserved_5;  // word 1
    logic [5:0] last_row;
    logic [1:0] reserved_6;
    logic [5:0] first_row;
    logic signed [7:0] left_step;
    logic signed [7:0] left_x;
    logic [1:0] reserved_7;  // word 0
    logic [9:0] left_dy;
    logic [9:0] left_m;
    logic [9:0] left_r;
  } edges_compact_t;
  localparam int unsigned EDGES_COMPACT_BITS = 192;
  localparam logic [EDGES_COMPACT_BITS-1:0] EDGES_COMPACT_RESERVED = {
    32'hffff0000, 32'hc0000000, 32'hfec00000, 32'hc0000000, 32'hc0c00000, 32'hc0000000
  };

  typedef struct packed {
    logic [7:0] reserved_0;  // word 3
    logic [7:0] dy_high;
    logic [7:0] dx_high;
    logic [7:0] z_high;
    logic [31:0] dy;  // word 2
    logic [31:0] dx;  // word 1
    logic [31:0] z;  // word 0
  } depth_wide_t;
  localparam int unsigned DEPTH_WIDE_BITS = 128;
  localparam logic [DEPTH_WIDE_BITS-1:0] DEPTH_WIDE_RESERVED = {
    32'hff000000, 32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic signed [31:0] dy;  // word 2
    logic signed [31:0] dx;  // word 1
    logic signed [31:0] z;  // word 0
  } depth_compact_t;
  localparam int unsigned DEPTH_COMPACT_BITS = 96;
  localparam logic [DEPTH_COMPACT_BITS-1:0] DEPTH_COMPACT_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] a_dy;  // word 2
    logic [31:0] a_dx;  // word 1
    logic [31:0] a;  // word 0
  } alpha_linear_t;
  localparam int unsigned ALPHA_LINEAR_BITS = 96;
  localparam logic [ALPHA_LINEAR_BITS-1:0] ALPHA_LINEAR_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [7:0] reserved_0;
    logic [7:0] blue;
    logic [7:0] green;
    logic [7:0] red;
  } colour_flat_t;
  localparam int unsigned COLOUR_FLAT_BITS = 32;
  localparam logic [COLOUR_FLAT_BITS-1:0] COLOUR_FLAT_RESERVED = 32'hff000000;

  typedef struct packed {
    logic [31:0] blue_dy;  // word 8
    logic [31:0] blue_dx;  // word 7
    logic [31:0] blue;  // word 6
    logic [31:0] green_dy;  // word 5
    logic [31:0] green_dx;  // word 4
    logic [31:0] green;  // word 3
    logic [31:0] red_dy;  // word 2
    logic [31:0] red_dx;  // word 1
    logic [31:0] red;  // word 0
  } colour_linear_t;
  localparam int unsigned COLOUR_LINEAR_BITS = 288;
  localparam logic [COLOUR_LINEAR_BITS-1:0] COLOUR_LINEAR_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000,
    32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] blue_dyy;  // word 17
    logic [31:0] blue_dxy;  // word 16
    logic [31:0] blue_dxx;  // word 15
    logic [31:0] blue_dy;  // word 14
    logic [31:0] blue_dx;  // word 13
    logic [31:0] blue;  // word 12
    logic [31:0] green_dyy;  // word 11
    logic [31:0] green_dxy;  // word 10
    logic [31:0] green_dxx;  // word 9
    logic [31:0] green_dy;  // word 8
    logic [31:0] green_dx;  // word 7
    logic [31:0] green;  // word 6
    logic [31:0] red_dyy;  // word 5
    logic [31:0] red_dxy;  // word 4
    logic [31:0] red_dxx;  // word 3
    logic [31:0] red_dy;  // word 2
    logic [31:0] red_dx;  // word 1
    logic [31:0] red;  // word 0
  } colour_second_order_t;
  localparam int unsigned COLOUR_SECOND_ORDER_BITS = 576;
  localparam logic [COLOUR_SECOND_ORDER_BITS-1:0] COLOUR_SECOND_ORDER_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000,
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000,
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [3:0] last_1;
    logic [3:0] first_1;
    logic [3:0] last_0;
    logic [3:0] first_0;
    logic [3:0] last_row;
    logic [5:0] first_row;
    logic [5:0] x;
  } pixels_small_t;
  localparam int unsigned PIXELS_SMALL_BITS = 32;
  localparam logic [PIXELS_SMALL_BITS-1:0] PIXELS_SMALL_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [31:0] rows_2;
  } rows_one_t;
  localparam int unsigned ROWS_ONE_BITS = 32;
  localparam logic [ROWS_ONE_BITS-1:0] ROWS_ONE_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [31:0] rows_6;  // word 1
    logic [31:0] rows_2;  // word 0
  } rows_two_t;
  localparam int unsigned ROWS_TWO_BITS = 64;
  localparam logic [ROWS_TWO_BITS-1:0] ROWS_TWO_RESERVED = {
    32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] rows_10;  // word 2
    logic [31:0] rows_6;  // word 1
    logic [31:0] rows_2;  // word 0
  } rows_three_t;
  localparam int unsigned ROWS_THREE_BITS = 96;
  localparam logic [ROWS_THREE_BITS-1:0] ROWS_THREE_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] rows_14;  // word 3
    logic [31:0] rows_10;  // word 2
    logic [31:0] rows_6;  // word 1
    logic [31:0] rows_2;  // word 0
  } rows_four_t;
  localparam int unsigned ROWS_FOUR_BITS = 128;
  localparam logic [ROWS_FOUR_BITS-1:0] ROWS_FOUR_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [1:0] scale;  // word 1
    logic signed [14:0] dy;
    logic signed [14:0] dx;
    logic signed [31:0] z;  // word 0
  } depth_small_t;
  localparam int unsigned DEPTH_SMALL_BITS = 64;
  localparam logic [DEPTH_SMALL_BITS-1:0] DEPTH_SMALL_RESERVED = {
    32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic signed [11:0] blue_dy;  // word 3
    logic signed [11:0] blue_dx;
    logic [7:0] blue_fraction;
    logic signed [11:0] green_dy;  // word 2
    logic signed [11:0] green_dx;
    logic [7:0] green_fraction;
    logic signed [11:0] red_dy;  // word 1
    logic signed [11:0] red_dx;
    logic [7:0] red_fraction;
    logic [1:0] slope_scale;  // word 0
    logic signed [9:0] blue;
    logic signed [9:0] green;
    logic signed [9:0] red;
  } colour_linear_small_t;
  localparam int unsigned COLOUR_LINEAR_SMALL_BITS = 128;
  localparam logic [COLOUR_LINEAR_SMALL_BITS-1:0] COLOUR_LINEAR_SMALL_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [1:0] blue_scale;  // word 6
    logic signed [9:0] blue_dyy;
    logic signed [9:0] blue_dxy;
    logic signed [9:0] blue_dxx;
    logic [1:0] green_scale;  // word 5
    logic signed [9:0] green_dyy;
    logic signed [9:0] green_dxy;
    logic signed [9:0] green_dxx;
    logic [1:0] red_scale;  // word 4
    logic signed [9:0] red_dyy;
    logic signed [9:0] red_dxy;
    logic signed [9:0] red_dxx;
    logic signed [11:0] blue_dy;  // word 3
    logic signed [11:0] blue_dx;
    logic [7:0] blue_fraction;
    logic signed [11:0] green_dy;  // word 2
    logic signed [11:0] green_dx;
    logic [7:0] green_fraction;
    logic signed [11:0] red_dy;  // word 1
    logic signed [11:0] red_dx;
    logic [7:0] red_fraction;
    logic [1:0] slope_scale;  // word 0
    logic signed [9:0] blue;
    logic signed [9:0] green;
    logic signed [9:0] red;
  } colour_second_order_small_t;
  localparam int unsigned COLOUR_SECOND_ORDER_SMALL_BITS = 224;
  localparam logic [COLOUR_SECOND_ORDER_SMALL_BITS-1:0] COLOUR_SECOND_ORDER_SMALL_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000,
    32'h00000000
  };

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } nop_header_t;
  localparam int unsigned NOP_HEADER_BITS = 32;
  localparam logic [NOP_HEADER_BITS-1:0] NOP_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } write_memory_header_t;
  localparam int unsigned WRITE_MEMORY_HEADER_BITS = 32;
  localparam logic [WRITE_MEMORY_HEADER_BITS-1:0] WRITE_MEMORY_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [31:0] offset;  // word 2
    logic [27:0] reserved_0;  // word 1
    logic [3:0] slot;
  } write_memory_t;
  localparam int unsigned WRITE_MEMORY_BITS = 64;
  localparam logic [WRITE_MEMORY_BITS-1:0] WRITE_MEMORY_RESERVED = {
    32'h00000000, 32'hfffffff0
  };

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } read_memory_header_t;
  localparam int unsigned READ_MEMORY_HEADER_BITS = 32;
  localparam logic [READ_MEMORY_HEADER_BITS-1:0] READ_MEMORY_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [31:0] offset;  // word 2
    logic [15:0] count;  // word 1
    logic [11:0] reserved_0;
    logic [3:0] slot;
  } read_memory_t;
  localparam int unsigned READ_MEMORY_BITS = 64;
  localparam logic [READ_MEMORY_BITS-1:0] READ_MEMORY_RESERVED = {
    32'h00000000, 32'h0000fff0
  };

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } counters_header_t;
  localparam int unsigned COUNTERS_HEADER_BITS = 32;
  localparam logic [COUNTERS_HEADER_BITS-1:0] COUNTERS_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } colour_surface_header_t;
  localparam int unsigned COLOUR_SURFACE_HEADER_BITS = 32;
  localparam logic [COLOUR_SURFACE_HEADER_BITS-1:0] COLOUR_SURFACE_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [15:0] pitch;
    logic [11:0] reserved_0;
    logic [3:0] slot;
  } colour_surface_t;
  localparam int unsigned COLOUR_SURFACE_BITS = 32;
  localparam logic [COLOUR_SURFACE_BITS-1:0] COLOUR_SURFACE_RESERVED = 32'h0000fff0;

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } depth_surface_header_t;
  localparam int unsigned DEPTH_SURFACE_HEADER_BITS = 32;
  localparam logic [DEPTH_SURFACE_HEADER_BITS-1:0] DEPTH_SURFACE_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic [15:0] pitch;
    logic [11:0] reserved_0;
    logic [3:0] slot;
  } depth_surface_t;
  localparam int unsigned DEPTH_SURFACE_BITS = 32;
  localparam logic [DEPTH_SURFACE_BITS-1:0] DEPTH_SURFACE_RESERVED = 32'h0000fff0;

  typedef struct packed {
    logic [7:0] opcode;
    logic [10:0] reserved_0;
    logic depth_load;
    logic colour_load;
    logic [10:0] length;
  } tile_begin_header_t;
  localparam int unsigned TILE_BEGIN_HEADER_BITS = 32;
  localparam logic [TILE_BEGIN_HEADER_BITS-1:0] TILE_BEGIN_HEADER_RESERVED = 32'h00ffe000;

  typedef struct packed {
    logic [31:0] depth;  // word 2
    logic [31:0] colour;  // word 1
  } tile_begin_t;
  localparam int unsigned TILE_BEGIN_BITS = 64;
  localparam logic [TILE_BEGIN_BITS-1:0] TILE_BEGIN_RESERVED = {
    32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [7:0] opcode;
    logic [8:0] reserved_0;
    logic [1:0] depth_output;
    logic [1:0] colour_output;
    logic [10:0] length;
  } tile_end_header_t;
  localparam int unsigned TILE_END_HEADER_BITS = 32;
  localparam logic [TILE_END_HEADER_BITS-1:0] TILE_END_HEADER_RESERVED = 32'h00ff8000;

  typedef struct packed {
    logic [31:0] depth;  // word 2
    logic [31:0] colour;  // word 1
  } tile_end_t;
  localparam int unsigned TILE_END_BITS = 64;
  localparam logic [TILE_END_BITS-1:0] TILE_END_RESERVED = {
    32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [7:0] opcode;
    logic [8:0] reserved_0;
    logic write;
    logic [2:0] func;
    logic [10:0] length;
  } depth_state_header_t;
  localparam int unsigned DEPTH_STATE_HEADER_BITS = 32;
  localparam logic [DEPTH_STATE_HEADER_BITS-1:0] DEPTH_STATE_HEADER_RESERVED = 32'h00ff8000;

  typedef struct packed {
    logic [7:0] opcode;
    logic [8:0] reserved_0;
    logic alpha;
    logic blue;
    logic green;
    logic red;
    logic [10:0] length;
  } colour_mask_header_t;
  localparam int unsigned COLOUR_MASK_HEADER_BITS = 32;
  localparam logic [COLOUR_MASK_HEADER_BITS-1:0] COLOUR_MASK_HEADER_RESERVED = 32'h00ff8000;

  typedef struct packed {
    logic [7:0] opcode;
    logic [12:0] reserved_0;
    logic [10:0] length;
  } scissor_header_t;
  localparam int unsigned SCISSOR_HEADER_BITS = 32;
  localparam logic [SCISSOR_HEADER_BITS-1:0] SCISSOR_HEADER_RESERVED = 32'h00fff800;

  typedef struct packed {
    logic reserved_0;
    logic [6:0] y1;
    logic reserved_1;
    logic [6:0] x1;
    logic reserved_2;
    logic [6:0] y0;
    logic reserved_3;
    logic [6:0] x0;
  } scissor_t;
  localparam int unsigned SCISSOR_BITS = 32;
  localparam logic [SCISSOR_BITS-1:0] SCISSOR_RESERVED = 32'h80808080;

  typedef struct packed {
    logic [7:0] opcode;
    logic [7:0] alpha;
    logic alpha_linear;
    logic [1:0] shading;
    logic [1:0] geometry;
    logic [10:0] length;
  } triangle_header_t;
  localparam int unsigned TRIANGLE_HEADER_BITS = 32;
  localparam logic [TRIANGLE_HEADER_BITS-1:0] TRIANGLE_HEADER_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [7:0] opcode;
    logic [7:0] alpha;
    logic [2:0] row_words;
    logic [1:0] shading;
    logic [10:0] length;
  } triangle_small_header_t;
  localparam int unsigned TRIANGLE_SMALL_HEADER_BITS = 32;
  localparam logic [TRIANGLE_SMALL_HEADER_BITS-1:0] TRIANGLE_SMALL_HEADER_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [31:0] response_words;  // word 2
    logic [31:0] offset;  // word 1
    logic [27:0] reserved_0;  // word 0
    logic [3:0] cause;
  } status_t;
  localparam int unsigned STATUS_BITS = 96;
  localparam logic [STATUS_BITS-1:0] STATUS_RESERVED = {
    32'h00000000, 32'h00000000, 32'hfffffff0
  };

  typedef struct packed {
    logic [31:0] reserved_0;  // word 3
    logic [29:0] reserved_1;  // word 2
    logic [1:0] rights;
    logic [31:0] size;  // word 1
    logic [31:0] base;  // word 0
  } slot_entry_t;
  localparam int unsigned SLOT_ENTRY_BITS = 128;
  localparam logic [SLOT_ENTRY_BITS-1:0] SLOT_ENTRY_RESERVED = {
    32'hffffffff, 32'hfffffffc, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] reserved_0;  // word 15
    logic [31:0] reserved_1;  // word 14
    logic [31:0] reserved_2;  // word 13
    logic [31:0] reserved_3;  // word 12
    logic [31:0] reserved_4;  // word 11
    logic [31:0] reserved_5;  // word 10
    logic [31:0] slot_table_high;  // word 9
    logic [31:0] slot_table_low;  // word 8
    logic [31:0] response_list_high;  // word 7
    logic [31:0] response_list_low;  // word 6
    logic [31:0] reserved_6;  // word 5
    logic [31:0] response_words;  // word 4
    logic [31:0] stream_list_high;  // word 3
    logic [31:0] stream_list_low;  // word 2
    logic [31:0] stream_words;  // word 1
    logic [31:0] sequence_;  // word 0
  } job_descriptor_t;
  localparam int unsigned JOB_DESCRIPTOR_BITS = 512;
  localparam logic [JOB_DESCRIPTOR_BITS-1:0] JOB_DESCRIPTOR_RESERVED = {
    32'hffffffff, 32'hffffffff, 32'hffffffff, 32'hffffffff, 32'hffffffff, 32'hffffffff,
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'hffffffff, 32'h00000000,
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] response_words;  // word 3
    logic [31:0] offset;  // word 2
    logic [27:0] reserved_0;  // word 1
    logic [3:0] cause;
    logic [31:0] sequence_;  // word 0
  } completion_t;
  localparam int unsigned COMPLETION_BITS = 128;
  localparam logic [COMPLETION_BITS-1:0] COMPLETION_RESERVED = {
    32'h00000000, 32'h00000000, 32'hfffffff0, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] mark_complement;  // word 3
    logic [31:0] nonce_complement;  // word 2
    logic [31:0] nonce;  // word 1
    logic [31:0] mark;  // word 0
  } usb_sync_t;
  localparam int unsigned USB_SYNC_BITS = 128;
  localparam logic [USB_SYNC_BITS-1:0] USB_SYNC_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000
  };

  typedef struct packed {
    logic [31:0] response_words;  // word 3
    logic [31:0] stream_words;  // word 2
    logic [31:0] sequence_;  // word 1
    logic [23:0] mark;  // word 0
    logic [2:0] reserved_0;
    logic [4:0] slots;
  } usb_job_t;
  localparam int unsigned USB_JOB_BITS = 128;
  localparam logic [USB_JOB_BITS-1:0] USB_JOB_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h000000e0
  };

  typedef struct packed {
    logic [31:0] checksum;
  } usb_job_end_t;
  localparam int unsigned USB_JOB_END_BITS = 32;
  localparam logic [USB_JOB_END_BITS-1:0] USB_JOB_END_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [15:0] mark;
    logic [15:0] count;
  } usb_response_t;
  localparam int unsigned USB_RESPONSE_BITS = 32;
  localparam logic [USB_RESPONSE_BITS-1:0] USB_RESPONSE_RESERVED = 32'h00000000;

  typedef struct packed {
    logic [31:0] checksum;  // word 4
    logic [31:0] response_words;  // word 3
    logic [31:0] offset;  // word 2
    logic [31:0] sequence_;  // word 1
    logic [15:0] mark;  // word 0
    logic [11:0] reserved_0;
    logic [3:0] cause;
  } usb_completion_t;
  localparam int unsigned USB_COMPLETION_BITS = 160;
  localparam logic [USB_COMPLETION_BITS-1:0] USB_COMPLETION_RESERVED = {
    32'h00000000, 32'h00000000, 32'h00000000, 32'h00000000, 32'h0000fff0
  };

  typedef struct packed {
    logic [31:0] sequence_;  // word 1
    logic [15:0] mark;  // word 0
    logic [10:0] reserved_0;
    logic lost;
    logic [3:0] cause;
  } usb_event_t;
  localparam int unsigned USB_EVENT_BITS = 64;
  localparam logic [USB_EVENT_BITS-1:0] USB_EVENT_RESERVED = {
    32'h00000000, 32'h0000ffe0
  };

  typedef struct packed {
    logic [7:0] reserved_0;
    logic [7:0] ring_max_log2;
    logic [7:0] pixels_per_clock;
    logic [7:0] tile_size;
  } reg_capabilities_t;
  localparam int unsigned REG_CAPABILITIES_BITS = 32;
  localparam logic [REG_CAPABILITIES_BITS-1:0] REG_CAPABILITIES_RESERVED = 32'hff000000;

  typedef struct packed {
    logic [29:0] reserved_0;
    logic reset;
    logic enable;
  } reg_control_t;
  localparam int unsigned REG_CONTROL_BITS = 32;
  localparam logic [REG_CONTROL_BITS-1:0] REG_CONTROL_RESERVED = 32'hfffffffc;

  typedef struct packed {
    logic [27:0] reserved_0;
    logic lost;
    logic dma_error;
    logic idle;
    logic running;
  } reg_status_t;
  localparam int unsigned REG_STATUS_BITS = 32;
  localparam logic [REG_STATUS_BITS-1:0] REG_STATUS_RESERVED = 32'hfffffff0;

  typedef struct packed {
    logic [27:0] reserved_0;
    logic [3:0] cause;
  } reg_fault_cause_t;
  localparam int unsigned REG_FAULT_CAUSE_BITS = 32;
  localparam logic [REG_FAULT_CAUSE_BITS-1:0] REG_FAULT_CAUSE_RESERVED = 32'hfffffff0;

  typedef struct packed {
    logic [28:0] reserved_0;
    logic dma;
    logic fault;
    logic done;
  } reg_interrupt_status_t;
  localparam int unsigned REG_INTERRUPT_STATUS_BITS = 32;
  localparam logic [REG_INTERRUPT_STATUS_BITS-1:0] REG_INTERRUPT_STATUS_RESERVED = 32'hfffffff8;

  typedef struct packed {
    logic [28:0] reserved_0;
    logic dma;
    logic fault;
    logic done;
  } reg_interrupt_mask_t;
  localparam int unsigned REG_INTERRUPT_MASK_BITS = 32;
  localparam logic [REG_INTERRUPT_MASK_BITS-1:0] REG_INTERRUPT_MASK_RESERVED = 32'hfffffff8;

  typedef struct packed {
    logic [27:0] reserved_0;
    logic [3:0] log2;
  } reg_ring_log2_t;
  localparam int unsigned REG_RING_LOG2_BITS = 32;
  localparam logic [REG_RING_LOG2_BITS-1:0] REG_RING_LOG2_RESERVED = 32'hfffffff0;

  typedef struct packed {
    logic [15:0] reserved_0;
    logic [15:0] jobs;
  } reg_head_t;
  localparam int unsigned REG_HEAD_BITS = 32;
  localparam logic [REG_HEAD_BITS-1:0] REG_HEAD_RESERVED = 32'hffff0000;

  typedef struct packed {
    logic [15:0] reserved_0;
    logic [15:0] jobs;
  } reg_tail_t;
  localparam int unsigned REG_TAIL_BITS = 32;
  localparam logic [REG_TAIL_BITS-1:0] REG_TAIL_RESERVED = 32'hffff0000;

