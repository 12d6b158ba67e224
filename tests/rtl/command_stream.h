/* SPDX-License-Identifier: MIT */
/*
 * Random streams for the bench of command: every packet, with random words wherever command does
 * not look; right most of the time, at the edge of right or damaged now and then.
 */
#ifndef TESTS_COMMAND_STREAM_H
#define TESTS_COMMAND_STREAM_H

#include <algorithm>
#include <vector>

extern "C" {
#include "model/model.h"
}
#include "tb.h"

class CommandStream
{
      public:
	CommandStream(Random &random, unsigned int tile_size) : random(random), tile(tile_size)
	{
		for (gloss_slot &slot : job.slot)
			slot = random_slot();
		job.response_words = random.chance(80) ? 1u << random.between(13, 20) :
							 random.below(3 * tile * tile);
		for (int packets = random.between(0, 30); packets > 0; packets--)
			packet();
		if (in_tile && random.chance(97))
			tile_end();
		if (random.chance(50))
			damage();
		job.stream = words.data();
		job.stream_words = (uint32_t)words.size();
	}

	accel_job job = {};

      private:
	struct surface {
		unsigned int slot;
		uint32_t pitch;
	};

	gloss_slot random_slot()
	{
		static const uint32_t size[] = { 0, 4096, 65536, 1u << 20, 0x7ffff000, 0xfffff000 };
		gloss_slot slot;

		slot.size = size[random.below(6)] + (random.chance(20) ? random.below(4096) : 0);
		slot.base = slot.size > 0x80000000 ? 0 : random.below(0x80000) << 12;
		slot.rights = (gloss_rights)(random.chance(80) ? GLOSS_RIGHTS_READ_WRITE :
								 random.below(4));
		return slot;
	}

	/* Mostly inside the slot, often just inside, sometimes just outside or far from it. */
	uint32_t offset(unsigned int slot, uint64_t extent, uint32_t align)
	{
		uint64_t size = job.slot[slot].size;
		uint64_t last = size < extent ? 0 : (size - extent) / align * align;

		switch (random.below(16)) {
		case 0:
			return (uint32_t)last + align;
		case 1:
			return random.bits() / align * align;
		case 2:
			return 0 - align;
		case 3:
			return random.bits();
		case 4:
		case 5:
		case 6:
			return (uint32_t)last;
		default:
			return (uint32_t)(random.bits64() % (last / align + 1)) * align;
		}
	}

	unsigned int slot(uint64_t extent)
	{
		unsigned int n = random.below(16);

		for (int tries = 0; tries < 64 && random.chance(99); tries++) {
			if (job.slot[n].rights == GLOSS_RIGHTS_READ_WRITE &&
			    job.slot[n].size >= extent)
				break;
			n = random.below(16);
		}
		return n;
	}

	void header(unsigned int opcode, uint32_t flags, uint32_t length)
	{
		words.push_back(opcode << 24 | flags | length);
	}

	void fill(uint32_t count)
	{
		while (count--)
			words.push_back(random.bits());
	}

	void nop()
	{
		uint32_t length = random.chance(90) ? random.below(20) : random.below(2048);

		header(GLOSS_OP_NOP, 0, length);
		fill(length);
	}

	void write_memory()
	{
		uint32_t count = random.chance(90) ? random.between(1, 20) :
						     random.between(1, 2045);
		unsigned int n = slot(4 * count);

		header(GLOSS_OP_WRITE_MEMORY, 0, count + 2);
		words.push_back(n);
		words.push_back(offset(n, 4 * count, 4));
		fill(count);
	}

	void read_memory()
	{
		uint32_t count = random.chance(90) ? random.between(1, 50) : random.below(65536);
		unsigned int n = slot(4 * count);

		header(GLOSS_OP_READ_MEMORY, 0, 2);
		words.push_back(n | count << 16);
		words.push_back(offset(n, 4 * count, 4));
	}

	void set_surface(unsigned int opcode, surface &s)
	{
		s.pitch = random.between(1, 65535 / (4 * tile)) * 4 * tile;
		if (random.chance(2))
			s.pitch = random.below(65536);
		s.slot = slot((uint64_t)s.pitch * tile);
		header(opcode, 0, 1);
		words.push_back(s.slot | s.pitch << 16);
	}

	uint32_t tile_offset(const surface &s)
	{
		return offset(s.slot, (uint64_t)(tile - 1) * s.pitch + 4 * tile, 4 * tile);
	}

	void tile_begin()
	{
		bool colour_load = (colour.pitch || random.chance(3)) && random.chance(50);
		bool depth_load = (depth.pitch || random.chance(3)) && random.chance(50);

		header(GLOSS_OP_TILE_BEGIN, colour_load << 11 | depth_load << 12, 2);
		words.push_back(colour_load ? tile_offset(colour) : random.bits());
		words.push_back(depth_load ? tile_offset(depth) : random.bits());
		in_tile = true;
	}

	gloss_tile_output output(const surface &s)
	{
		return s.pitch || random.chance(3) ? (gloss_tile_output)random.below(3) :
		       random.chance(50)           ? GLOSS_TILE_OUTPUT_DROP :
						     GLOSS_TILE_OUTPUT_ANSWER;
	}

	void tile_end()
	{
		gloss_tile_output c = output(colour), d = output(depth);

		header(GLOSS_OP_TILE_END, c << 11 | d << 13, 2);
		words.push_back(c == GLOSS_TILE_OUTPUT_STORE ? tile_offset(colour) :
							       random.chance(2));
		words.push_back(d == GLOSS_TILE_OUTPUT_STORE ? tile_offset(depth) :
							       random.chance(2));
		in_tile = false;
	}

	void scissor()
	{
		header(GLOSS_OP_SCISSOR, 0, 1);
		words.push_back(0);
		for (int n = 0; n < 4; n++)
			words.back() |= random.below(tile + 1 + random.chance(2)) << 8 * n;
	}

	void triangle()
	{
		gloss_triangle p = {};
		uint32_t word, first = random.below(tile), start = (uint32_t)words.size();

		p.geometry = (gloss_geometry)random.below(3);
		p.shading = (gloss_shading)random.below(3);
		p.alpha_linear = random.chance(50);
		p.alpha = random.below(256);
		gloss_triangle_pack(&word, &p);
		words.push_back(word);
		fill(gloss_triangle_length(&p));
		clear_reserved(&words[start + 1], p, first,
			       random.below(tile - first + random.chance(2)));
	}

	void triangle_small()
	{
		gloss_triangle_small p = {};
		gloss_pixels_small pixels;
		uint32_t word, start = (uint32_t)words.size();

		p.shading = (gloss_shading)random.below(3);
		p.row_words = (gloss_row_words)random.below(5);
		p.alpha = random.below(256);
		gloss_triangle_small_pack(&word, &p);
		words.push_back(word);
		fill(gloss_triangle_small_length(&p));
		gloss_pixels_small_unpack(&words[start + 1], &pixels);
		pixels.last_row = random.below(GLOSS_SMALL_HEAD_ROWS +
					       GLOSS_SMALL_WORD_ROWS * p.row_words +
					       random.chance(2));
		if (!random.chance(2))
			pixels.first_row = random.below(tile - pixels.last_row % 16);
		gloss_pixels_small_pack(&words[start + 1], &pixels);
		if (p.shading == GLOSS_SHADING_FLAT)
			words[start + 4] &= 0x00ffffff;
	}

	/* Turns random words into a right payload. */
	void clear_reserved(uint32_t *payload, const gloss_triangle &p, uint32_t first,
			    uint32_t rows)
	{
		if (p.geometry == GLOSS_GEOMETRY_WIDE) {
			gloss_edges_wide e;

			gloss_edges_wide_unpack(payload, &e);
			e.first_row = first;
			e.last_row = rows;
			gloss_edges_wide_pack(payload, &e);
			payload += GLOSS_EDGES_WIDE_WORDS;
		} else if (p.geometry == GLOSS_GEOMETRY_COMPACT) {
			gloss_edges_compact e;

			gloss_edges_compact_unpack(payload, &e);
			e.first_row = first;
			e.last_row = rows;
			gloss_edges_compact_pack(payload, &e);
			payload += GLOSS_EDGES_COMPACT_WORDS + GLOSS_DEPTH_COMPACT_WORDS;
		}
		if (p.geometry != GLOSS_GEOMETRY_COMPACT) {
			payload[3] &= 0x00ffffff;
			payload += GLOSS_DEPTH_WIDE_WORDS;
		}
		if (p.alpha_linear)
			payload += GLOSS_ALPHA_LINEAR_WORDS;
		if (p.shading == GLOSS_SHADING_FLAT)
			payload[0] &= 0x00ffffff;
	}

	void between_tiles()
	{
		switch (random.below(8)) {
		case 0:
			return write_memory();
		case 1:
			return read_memory();
		case 2:
			return header(GLOSS_OP_COUNTERS, 0, 0);
		default:
			return tile_begin();
		}
	}

	void packet()
	{
		unsigned int kind = random.below(in_tile ? 24 : 10);

		if (random.chance(1))
			in_tile = !in_tile;
		switch (kind) {
		case 0:
			return nop();
		case 1:
			return set_surface(GLOSS_OP_COLOUR_SURFACE, colour);
		case 2:
			return set_surface(GLOSS_OP_DEPTH_SURFACE, depth);
		case 3:
			return header(GLOSS_OP_DEPTH_STATE, random.below(16) << 11, 0);
		case 4:
			return header(GLOSS_OP_COLOUR_MASK, random.below(16) << 11, 0);
		case 5:
			return scissor();
		case 6:
		case 7:
			return in_tile ? tile_end() : between_tiles();
		default:
			return !in_tile ? between_tiles() : kind & 1 ? triangle() : triangle_small();
		}
	}

	void damage()
	{
		if (words.empty())
			return;
		uint32_t &word = words[random.below(words.size())];

		switch (random.below(5)) {
		case 0:
			word = random.bits();
			break;
		case 1:
			words.resize(random.below(words.size() + 1));
			break;
		case 2:
			words.erase(words.begin() + random.below(words.size()));
			break;
		default:
			word ^= 1u << random.below(32);
			break;
		}
	}

	Random &random;
	unsigned int tile;
	std::vector<uint32_t> words;
	bool in_tile = false;
	surface colour = {}, depth = {};
};

#endif
