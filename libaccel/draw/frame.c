// SPDX-License-Identifier: MIT
/* The frame's command stream: tile after tile, in as few jobs as there may be. */
#include <errno.h>

#include "draw/content.h"

/* Words of a job before its first tile, and of a tile beside its records: begin, state, end. */
#define JOB_WORDS 4
#define TILE_WORDS 10

struct writer {
	const struct accel_bin *bin;
	struct accel_stream *stream;
	const struct accel_target *target;
	const struct accel_content *content; /* what is known of the target; may be NULL */
	struct accel_tile_state now;         /* as the core has it at this place of the stream */
	size_t words;                        /* of this job */
	uint64_t words_before, tiles;        /* of the jobs before; of all */
	struct accel_fence *fence;           /* of all its jobs */
	unsigned int jobs;                   /* on the board */
};

static int frame_put(struct writer *writer, const uint32_t *words, uint32_t count)
{
	writer->words += count;
	return accel_stream_emit(writer->stream, words, count);
}

/* The bins stay as they are until the frame was sent, so their words go from there to the board. */
static int frame_lend(struct writer *writer, const uint32_t *words, uint32_t count)
{
	writer->words += count;
	return accel_stream_lend(writer->stream, words, count);
}

/* Every job starts from the same state, without surfaces. */
static int frame_job_begin(struct writer *writer)
{
	const struct accel_target *target = writer->target;
	unsigned int rights = ACCEL_SLOT_READ | ACCEL_SLOT_WRITE;
	int colour = accel_stream_slot(writer->stream, target->colour, rights);
	int depth = accel_stream_slot(writer->stream, target->depth, rights);
	uint32_t words[JOB_WORDS];

	if (colour < 0)
		return colour;
	if (depth < 0)
		return depth;
	gloss_colour_surface_pack(words, &(struct gloss_colour_surface){
						 .slot = (uint32_t)colour,
						 .pitch = target->pitch,
					 });
	gloss_depth_surface_pack(words + 2, &(struct gloss_depth_surface){
						    .slot = (uint32_t)depth,
						    .pitch = target->pitch,
					    });
	gloss_depth_state_pack(&writer->now.depth_state, &(struct gloss_depth_state){
								 .func = GLOSS_COMPARE_ALWAYS,
							 });
	gloss_colour_mask_pack(&writer->now.colour_mask,
			       &(struct gloss_colour_mask){ true, true, true, true });
	writer->now.scissor = accel_bin_scissor(0, 0, writer->bin->tile_size,
						writer->bin->tile_size);
	writer->words = 0;
	return frame_put(writer, words, JOB_WORDS);
}

/* What a surface's tile begins and ends with. */
struct part {
	bool load;
	uint32_t begin; /* clear value, or offset to load from */
	enum gloss_tile_output output;
	uint32_t end; /* offset to store to */
};

/* @mask: the plane, and @drop: those that need not be stored, of ACCEL_CLEAR_*. */
static struct part frame_part_of(const struct accel_tile_clear *clear, unsigned int mask,
				 uint32_t value, bool uses, bool writes, unsigned int drop,
				 uint32_t offset)
{
	struct part part = { .output = GLOSS_TILE_OUTPUT_DROP };

	if (clear->mask & mask) {
		part.begin = value;
	} else if (uses) {
		part.load = true;
		part.begin = offset;
	}
	if ((clear->mask & mask || writes) && !(drop & mask)) {
		part.output = GLOSS_TILE_OUTPUT_STORE;
		part.end = offset;
	}
	return part;
}

static int frame_tile_records(struct writer *writer, const struct accel_tile *tile)
{
	const struct accel_chunk *chunk;
	uint32_t words[ACCEL_STATE_WORDS];
	uint32_t count = accel_bin_packets(words, &writer->now, &tile->first);
	int err = frame_put(writer, words, count);

	for (chunk = tile->chunk; chunk && !err; chunk = chunk->next)
		err = frame_lend(writer, chunk->words, chunk->used);
	writer->now = tile->now;
	return err;
}

/* A tile that nothing was drawn on is only cleared. */
static int frame_tile_write(struct writer *writer, const struct accel_tile *tile, unsigned int drop,
			    uint32_t offset)
{
	const struct accel_tile_clear *clear = tile->drawn ? &tile->clear : &writer->bin->clear;
	struct part colour = frame_part_of(clear, ACCEL_CLEAR_COLOUR, clear->colour,
					   tile->uses_colour, tile->uses_colour, drop, offset);
	struct part depth = frame_part_of(clear, ACCEL_CLEAR_DEPTH, clear->depth, tile->uses_depth,
					  tile->writes_depth, drop, offset);
	uint32_t words[1 + GLOSS_TILE_BEGIN_WORDS];
	int err;

	gloss_tile_begin_pack(words, &(struct gloss_tile_begin){ colour.load, depth.load,
								 colour.begin, depth.begin });
	err = frame_put(writer, words, 1 + GLOSS_TILE_BEGIN_WORDS);
	if (!err && tile->drawn)
		err = frame_tile_records(writer, tile);
	if (err)
		return err;
	gloss_tile_end_pack(words, &(struct gloss_tile_end){ colour.output, depth.output,
							     colour.end, depth.end });
	return frame_put(writer, words, 1 + GLOSS_TILE_END_WORDS);
}

static int frame_job_end(struct writer *writer)
{
	int err = accel_stream_send(writer->stream, NULL, 0, writer->fence);

	if (err)
		return err;
	writer->jobs++;
	writer->words_before += writer->words;
	writer->words = 0;
	return 0;
}

static bool frame_job_full(const struct writer *writer, const struct accel_tile *tile,
			   size_t job_words)
{
	return writer->words > JOB_WORDS && writer->words + tile->words + TILE_WORDS > job_words;
}

/* Planes of tile number @i that need not be stored: nobody reads them, or they are there. */
static unsigned int frame_tile_drops(const struct writer *writer, int i)
{
	const struct accel_bin *bin = writer->bin;

	if (!writer->content || bin->tile[i].drawn)
		return bin->discard;
	return bin->discard | accel_content_holds(writer->content, i, &bin->clear);
}

static bool frame_tile_leaves(const struct accel_bin *bin, const struct accel_tile *tile,
			      unsigned int drop)
{
	unsigned int planes = tile->drawn ? ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH :
					    bin->clear.mask;

	return planes & ~drop;
}

static int frame_tiles_write(struct writer *writer, size_t job_words)
{
	const struct accel_bin *bin = writer->bin;
	int err = frame_job_begin(writer);

	for (int i = 0; i < bin->columns * bin->rows && !err; i++) {
		const struct accel_tile *tile = &bin->tile[i];
		uint32_t x = (uint32_t)(i % bin->columns * bin->tile_size);
		uint32_t y = (uint32_t)(i / bin->columns * bin->tile_size);
		unsigned int drop = frame_tile_drops(writer, i);

		if (!frame_tile_leaves(bin, tile, drop))
			continue;
		writer->tiles++;
		if (frame_job_full(writer, tile, job_words)) {
			err = frame_job_end(writer);
			if (!err)
				err = frame_job_begin(writer);
		}
		if (!err)
			err = frame_tile_write(writer, tile, drop,
					       y * writer->target->pitch + x * 4);
	}
	return err;
}

/* Nobody is to take a frame of which a part was drawn for one that is there as a whole. */
static int frame_fail(struct writer *writer, int err, bool *sent)
{
	accel_stream_reset(writer->stream);
	accel_fence_free(writer->fence);
	*sent = writer->jobs > 0;
	if (!writer->jobs || err != -ENOMEM)
		return err;
	accel_device_message(writer->target->device,
			     "a part of the frame was drawn, there is no memory for the rest");
	return -EIO;
}

static int frame_write(struct writer *writer, size_t job_words)
{
	struct accel_content *content = accel_content_begin(writer->target);
	int err = 0;

	writer->content = content;
	if (writer->bin->columns)
		err = frame_tiles_write(writer, job_words);
	if (!err)
		err = frame_job_end(writer);
	if (content)
		accel_content_end(content, writer->bin, err ? NULL : writer->fence, writer->jobs);
	return err;
}

int accel_frame_submit(const struct accel_bin *bin, struct accel_stream *stream,
		       const struct accel_target *target, size_t job_words,
		       struct accel_draw_stats *stats, struct accel_fence **fence, bool *sent)
{
	struct writer writer = { .bin = bin, .stream = stream, .target = target };
	int err;

	*sent = false;
	writer.fence = accel_fence_new(accel_stream_device(stream));
	if (!writer.fence)
		return -ENOMEM;
	err = frame_write(&writer, job_words);
	if (err)
		return frame_fail(&writer, err, sent);
	*fence = writer.fence;
	*sent = true;
	stats->tiles = writer.tiles;
	stats->stream_words = writer.words_before;
	stats->records = bin->records;
	return 0;
}
