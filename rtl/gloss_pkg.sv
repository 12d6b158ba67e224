// SPDX-License-Identifier: Apache-2.0
// The one package of the design (yosys 0.23 can not resolve one package from
// another). Numbers, enums and packet structs come from gloss.xml through the
// generated include; the types that only pass between stages are here.

package gloss_pkg;

  // No top uses all of these.
  // verilator lint_off UNUSEDPARAM

`include "gloss_hw.svh"

  // ---- render queue: what command hands to raster_load ----
  // A TRIANGLE is RENDER_HEADER and its payload in rows of StreamBits; the op
  // after them has go, whatever it is. A part of the payload starts in lane 0 of a row. Of a
  // TRIANGLE_SMALL the header is the first word of PART_SMALL, and RENDER_HEADER
  // is row 0 of that.
  localparam logic [2:0] RENDER_HEADER = 3'd0;  // data[31:0]: the triangle's header word;
                                                // part: PART_SMALL, or PART_NONE
  localparam logic [2:0] RENDER_PAYLOAD = 3'd1; // part, row: which words of the record
  localparam logic [2:0] RENDER_STATE = 3'd3;   // part: STATE_*
  localparam logic [2:0] RENDER_END = 3'd4;     // end of the tile
  localparam logic [2:0] RENDER_BEGIN = 3'd5;   // a tile begins; raster_load never sees it: the
                                                // gate behind the queue holds the ops after it
                                                // until the tile's buffer is prepared

  // Parts of a triangle's payload, and of a small one's.
  localparam logic [2:0] PART_EDGES = 3'd0;
  localparam logic [2:0] PART_DEPTH = 3'd1;
  localparam logic [2:0] PART_ALPHA = 3'd2;
  localparam logic [2:0] PART_COLOUR = 3'd3;
  localparam logic [2:0] PART_SMALL = 3'd4;        // header, pixels, depth: SmallWords
  localparam logic [2:0] PART_SMALL_COLOUR = 3'd5;
  localparam logic [2:0] PART_SMALL_ROWS = 3'd6;
  localparam logic [2:0] PART_NONE = 3'd7;
  localparam int unsigned SmallWords = 4;
  localparam int unsigned PartRows = 18;           // of the longest part, with 32 bits a row

  // What a RENDER_STATE sets; data[31:0] is the word named here.
  localparam logic [2:0] STATE_DEPTH = 3'd0;    // header of DEPTH_STATE
  localparam logic [2:0] STATE_MASK = 3'd1;     // header of COLOUR_MASK
  localparam logic [2:0] STATE_SCISSOR = 3'd2;  // payload word of SCISSOR
  localparam logic [2:0] STATE_RESET = 3'd3;    // all to the state a job starts with

  typedef struct packed {
    logic       go;    // the record before is complete: draw it, then this
    logic [2:0] kind;
    logic [2:0] part;
    logic [4:0] row;
  } render_op_t;

  // ---- what travels with a pixel from raster to fragment ----
  typedef struct packed {
    logic       bank;         // which tile buffer
    logic [3:0] colour_mask;  // alpha, blue, green, red
    logic       depth_write;
    logic [2:0] depth_func;
  } pixel_state_t;

  // ---- raster ----
  typedef struct packed {
    logic signed [12:0] x;
    logic signed [12:0] step;
    logic [15:0]        r;
    logic [15:0]        m;
    logic [15:0]        dy;
  } edge_line_t;

  typedef struct packed {
    logic [6:0] y1;
    logic [6:0] x1;
    logic [6:0] y0;
    logic [6:0] x0;
  } scissor_rect_t;

  // ---- shade ----
  typedef struct packed {
    logic [31:0] i;
    logic [31:0] dx;
    logic [31:0] dy;
    logic [31:0] dxx;
    logic [31:0] dxy;
    logic [31:0] dyy;
  } surface_t;

  typedef struct packed {
    logic [39:0] z;
    logic [39:0] dx;
    logic [39:0] dy;
  } depth_plane_t;

  // Where shade's row state moves to next: what raster_row tells it.
  localparam logic [1:0] MOVE_LOAD = 2'd0;  // the anchor of the next triangle
  localparam logic [1:0] MOVE_DOWN = 2'd1;  // a row down
  localparam logic [1:0] MOVE_RIGHT = 2'd2; // a block to the right
  localparam logic [1:0] MOVE_LEFT = 2'd3;  // a block to the left

  typedef struct packed {
    logic       slopes; // move the differences
    logic       values; // move the values; to the left a clock after the differences
    logic [1:0] move;
    logic       start;  // a run of blocks begins where the row state is, before it moves
    logic       step;   // the next block of the run
  } shade_command_t;

  // ---- what command asks its slot table ----
  // Of the bytes of an access: at most 64 rows, less than 65536 apart.
  localparam int unsigned ExtentBits = $clog2(64 * 65536 + 1);

  // ---- what command hands to tile: checked, addresses absolute ----
  typedef struct packed {
    logic        colour_load;
    logic        depth_load;
    logic [31:0] colour;        // clear word, or byte address of the tile
    logic [15:0] colour_pitch;
    logic [31:0] depth;         // clear word, or byte address of the tile
    logic [15:0] depth_pitch;
  } tile_begin_op_t;

  typedef struct packed {
    logic [1:0]  colour_output; // TILE_OUTPUT_*
    logic [1:0]  depth_output;
    logic [31:0] colour;        // byte address
    logic [15:0] colour_pitch;
    logic [31:0] depth;
    logic [15:0] depth_pitch;
  } tile_end_op_t;

  // WRITE_MEMORY and READ_MEMORY.
  typedef struct packed {
    logic        write;
    logic [31:0] address;       // byte address, multiple of 4
    logic [15:0] words;         // at least 1
  } copy_op_t;

  // Work of the job, as COUNTERS answers it.
  typedef struct packed {
    logic [31:0] tiles;
    logic [31:0] passed;
    logic [31:0] covered;
    logic [31:0] triangles;
  } work_counters_t;

  // Where the clocks of a job went; for ports and benches, never in a response.
  typedef struct packed {
    logic [31:0] stall_response; // response beat waits for its taker
    logic [31:0] stall_memory;   // command or a tile waits for board memory
    logic [31:0] stall_tile;     // triangles wait for a tile buffer
    logic [31:0] stall_raster;   // a complete record waits for raster
    logic [31:0] stall_stream;   // command waits for stream words
    logic [31:0] clocks;         // from job taken to job done
  } time_counters_t;

  // verilator lint_on UNUSEDPARAM

endpackage
