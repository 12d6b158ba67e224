// SPDX-License-Identifier: Apache-2.0
// Refuses a core or a port of parameters that nobody has built or tested, with a reason, when it is
// elaborated. No logic.
module core_parameters #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  parameter int unsigned TimeCounters = 1
) ();

  if (TileSize != 32 && TileSize != 64) begin : gen_tile_size
    $error("TileSize must be 32 or 64");
  end
  if (PixelsPerClock != 1 && PixelsPerClock != 2 &&
      PixelsPerClock != 4 && PixelsPerClock != 8) begin : gen_pixels
    $error("PixelsPerClock must be 1, 2, 4 or 8");
  end
  if (StreamBits != 32 && StreamBits != 64 && StreamBits != 128) begin : gen_stream_bits
    $error("StreamBits must be 32, 64 or 128");
  end
  if (TimeCounters > 1) begin : gen_time_counters
    $error("TimeCounters must be 0 or 1");
  end

endmodule
