// SPDX-License-Identifier: Apache-2.0
// What happens when the host refuses an access. Refused for the current job, it stops the port at
// once; refused while the next job is read ahead, it waits until that job's turn, so that the
// current one ends well. When nothing is under way at the host any more it is reported, once; only
// reset ends it.
module port_error (
  input  logic        clk_i,
  input  logic        rst_ni,

  // refused accesses: for the next job, for the stream's list, for the current job
  input  logic        ahead_i,
  input  logic        list_i,
  input  logic        current_error_i,
  input  logic [63:0] address_i,

  // ring
  input  logic        current_i,    // there is a current job
  input  logic        listed_i,     // the list is the next job's
  input  logic        next_valid_i, // the next job's descriptor was read
  input  logic [31:0] sequence_i,   // of the current job
  input  logic [31:0] next_sequence_i,
  output logic        failed_o,     // the next job can not be started

  output logic        stop_o,
  input  logic        idle_i,       // nothing is under way at the host
  output logic        reported_o,
  output logic        event_o,
  output logic [63:0] address_o,
  output logic [31:0] sequence_o
);

  logic ahead_q, list_q, current_error_q, stop_q, reported_q;
  logic for_current;
  logic [63:0] address_q;

  assign failed_o = ahead_q || list_q;
  // A list that was the next job's when it failed may be the current one's by now.
  assign stop_o = stop_q || current_error_q || (list_q && !listed_i) || (failed_o && !current_i);
  assign reported_o = reported_q;
  assign event_o = stop_q && idle_i && !reported_q;
  assign address_o = address_q;
  assign sequence_o = current_i ? sequence_i : next_valid_i ? next_sequence_i : '0;

  assign for_current = current_error_i || (list_i && !listed_i);

  // The first, but the current job's goes before what was read ahead.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) address_q <= '0;
    else if ((for_current && !stop_o) || ((ahead_i || list_i) && !failed_o && !stop_o))
      address_q <= address_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ahead_q <= 1'b0;
      list_q <= 1'b0;
      current_error_q <= 1'b0;
      stop_q <= 1'b0;
      reported_q <= 1'b0;
    end else begin
      ahead_q <= ahead_q || ahead_i;
      list_q <= list_q || list_i;
      current_error_q <= current_error_q || current_error_i;
      stop_q <= stop_o;
      reported_q <= reported_q || event_o;
    end
  end

endmodule
