/* SPDX-License-Identifier: MIT */
/*
 * What must come out of each port of command for a stream, worked out from the stream and
 * model_command_check alone.
 */
#ifndef TESTS_COMMAND_EXPECTED_H
#define TESTS_COMMAND_EXPECTED_H

#include <deque>
#include <vector>

extern "C" {
#include "model/model.h"
}

/* Kinds of render ops and states, as in gloss_pkg.sv. */
enum { HEADER, PAYLOAD, GO, STATE, END, BEGIN };
enum { STATE_DEPTH, STATE_MASK, STATE_SCISSOR, STATE_RESET };

/* What comes out of one port, in order; each entry a few words. */
typedef std::deque<std::vector<uint64_t>> Port;

struct Expected {
	Port render, begin, end, copy, copy_data, response;
	bool dropped = false; /* a fault ends a tile */
	gloss_status status;
};

/* Work of other stages, as they would report it. */
enum { COVERED = 0x12345678, PASSED = 0x9abcdef0 };

class Walker
{
      public:
	Walker(const accel_job &job, Expected &out) : job(job), out(out)
	{
		model.tile_size = TILE;
		model.job = &job;
		walk();
	}

      private:
	void walk()
	{
		uint32_t at = 0, word = 0;
		gloss_fault fault = GLOSS_FAULT_NONE;

		out.render.push_back({ STATE, STATE_RESET });
		for (; at < job.stream_words; at += 1 + gloss_header_length(job.stream[at])) {
			fault = model_command_check(&model, at, &word);
			if (fault)
				break;
			execute(job.stream + at);
		}
		if (!fault && model.in_tile) {
			fault = GLOSS_FAULT_ORDER;
			word = 0;
		}
		if (fault && model.in_tile) {
			out.dropped = true;
			out.render.push_back({ END });
			out.end.push_back({ GLOSS_TILE_OUTPUT_DROP, GLOSS_TILE_OUTPUT_DROP });
		}
		out.status = { fault, fault ? at + word : job.stream_words, model.response_used };
	}

	uint32_t address(const model_target &target, uint32_t offset)
	{
		return job.slot[target.slot].base + offset;
	}

	void copy(const uint32_t *packet)
	{
		bool write = gloss_header_opcode(*packet) == GLOSS_OP_WRITE_MEMORY;
		uint32_t count = write ? gloss_header_length(*packet) - 2 : packet[1] >> 16;

		out.copy.push_back({ write, job.slot[packet[1] & 15].base + packet[2], count });
		if (write)
			for (uint32_t n = 0; n < count; n++)
				out.copy_data.push_back({ packet[3 + n] });
		else
			model.response_used += count;
	}

	void begin(const uint32_t *packet)
	{
		gloss_tile_begin p;

		gloss_tile_begin_unpack(packet, &p);
		out.render.push_back({ BEGIN });
		out.begin.push_back(
			{ p.colour_load, p.depth_load,
			  p.colour_load ? address(model.state.colour_surface, p.colour) : p.colour,
			  p.depth_load ? address(model.state.depth_surface, p.depth) : p.depth,
			  p.colour_load ? model.state.colour_surface.pitch : 0,
			  p.depth_load ? model.state.depth_surface.pitch : 0 });
		model.in_tile = true;
	}

	void end(const uint32_t *packet)
	{
		gloss_tile_end p;

		gloss_tile_end_unpack(packet, &p);
		bool colour = p.colour_output == GLOSS_TILE_OUTPUT_STORE;
		bool depth = p.depth_output == GLOSS_TILE_OUTPUT_STORE;
		out.render.push_back({ END });
		out.end.push_back({ (uint64_t)p.colour_output, (uint64_t)p.depth_output,
				    colour ? address(model.state.colour_surface, p.colour) : 0,
				    depth ? address(model.state.depth_surface, p.depth) : 0,
				    colour ? model.state.colour_surface.pitch : 0,
				    depth ? model.state.depth_surface.pitch : 0 });
		model.response_used += TILE * TILE *
				       ((p.colour_output == GLOSS_TILE_OUTPUT_ANSWER) +
					(p.depth_output == GLOSS_TILE_OUTPUT_ANSWER));
		model.in_tile = false;
		model.counters.tiles++;
	}

	void execute(const uint32_t *packet)
	{
		switch (gloss_header_opcode(*packet)) {
		case GLOSS_OP_WRITE_MEMORY:
		case GLOSS_OP_READ_MEMORY:
			return copy(packet);
		case GLOSS_OP_COUNTERS:
			for (uint32_t word : { model.counters.triangles, (uint32_t)COVERED,
					       (uint32_t)PASSED, model.counters.tiles })
				out.response.push_back({ word });
			model.response_used += GLOSS_COUNTER_WORDS;
			return;
		case GLOSS_OP_COLOUR_SURFACE:
			model.state.colour_surface = { packet[1] & 15, packet[1] >> 16 };
			return;
		case GLOSS_OP_DEPTH_SURFACE:
			model.state.depth_surface = { packet[1] & 15, packet[1] >> 16 };
			return;
		case GLOSS_OP_TILE_BEGIN:
			return begin(packet);
		case GLOSS_OP_TILE_END:
			return end(packet);
		case GLOSS_OP_DEPTH_STATE:
			return out.render.push_back({ STATE, STATE_DEPTH, packet[0] });
		case GLOSS_OP_COLOUR_MASK:
			return out.render.push_back({ STATE, STATE_MASK, packet[0] });
		case GLOSS_OP_SCISSOR:
			return out.render.push_back({ STATE, STATE_SCISSOR, packet[1] });
		case GLOSS_OP_TRIANGLE:
		case GLOSS_OP_TRIANGLE_SMALL:
			out.render.push_back({ GO });
			for (uint32_t n = 0; n <= gloss_header_length(*packet); n++)
				out.render.back().push_back(packet[n]);
			model.counters.triangles++;
			return;
		}
	}

	const accel_job &job;
	Expected &out;
	struct model model = {};
};

#endif
