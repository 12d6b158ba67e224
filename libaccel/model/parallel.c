// SPDX-License-Identifier: MIT
/*
 * A job whose tiles may be drawn side by side. One pass over the stream checks every packet and
 * executes those that are no pixels; a tile that it has passed as a whole becomes a piece, which
 * somebody draws. A tile with a fault in it has done nothing that anybody can see, and so never
 * becomes one.
 *
 * Pieces that are handed out together have nothing in common but what they only read: the response
 * has a place for each, and in board memory they lie apart. That is looked at in the simplest way
 * that frames pass: tiles of one colour and one depth surface, in slots that do not meet, each at
 * a place of the grid of tiles farther on than the one before. Two places of that grid have no row
 * in common. What is not so waits for all pieces before it.
 */
#include "model.h"

enum { COLOUR, DEPTH, PLANES };

/* What an open tile has of board memory. */
struct access {
	bool used;
	bool odd; /* of two surfaces, or two places, or off the grid */
	struct model_target surface;
	uint32_t offset;
};

/* What the pieces that were handed out have. */
struct reach {
	bool used;
	struct model_target surface;
	uint32_t offset; /* the farthest */
};

struct pass {
	struct model *model;
	const struct model_drawer *drawer;
	void *data;
	struct model_piece piece; /* the open tile */
	struct access access[PLANES];
	struct reach reach[PLANES];
	bool handed_out; /* a piece, since the last wait */
};

static void wait_for_pieces(struct pass *pass)
{
	if (pass->handed_out)
		pass->drawer->wait(pass->data, &pass->model->counters);
	pass->handed_out = false;
	pass->reach[COLOUR].used = pass->reach[DEPTH].used = false;
}

static bool same_surface(const struct model_target *a, const struct model_target *b)
{
	return a->slot == b->slot && a->pitch == b->pitch;
}

/* Is it where tiles lie side by side, from the surface's beginning on? */
static bool on_grid(const struct model *model, const struct model_target *surface, uint32_t offset)
{
	return offset / surface->pitch % (uint32_t)model->tile_size == 0;
}

static void add_access(const struct model *model, struct access *access,
		       const struct model_target *surface, uint32_t offset)
{
	access->odd |= !on_grid(model, surface, offset);
	if (access->used)
		access->odd |= !same_surface(&access->surface, surface) || access->offset != offset;
	access->used = true;
	access->surface = *surface;
	access->offset = offset;
}

/* Do two slots have board memory in common? */
static bool slots_meet(const struct accel_job *job, unsigned int one, unsigned int other)
{
	const struct gloss_slot *a = &job->slot[one], *b = &job->slot[other];

	return a->base < (uint64_t)b->base + b->size && b->base < (uint64_t)a->base + a->size;
}

/* May the plane be used while what was handed out before still is drawn? */
static bool apart(const struct pass *pass, int plane)
{
	const struct access *access = &pass->access[plane];
	const struct reach *own = &pass->reach[plane], *other = &pass->reach[!plane];

	if (!access->used)
		return true;
	if (own->used &&
	    (!same_surface(&own->surface, &access->surface) || access->offset <= own->offset))
		return false;
	return !other->used ||
	       !slots_meet(pass->model->job, access->surface.slot, other->surface.slot);
}

static void hand_out(struct pass *pass)
{
	bool alone = pass->access[COLOUR].odd || pass->access[DEPTH].odd;

	if (alone || !apart(pass, COLOUR) || !apart(pass, DEPTH))
		wait_for_pieces(pass);
	pass->drawer->draw(pass->data, &pass->piece);
	pass->handed_out = true;
	for (int plane = 0; plane < PLANES; plane++)
		if (pass->access[plane].used)
			pass->reach[plane] = (struct reach){ true, pass->access[plane].surface,
							     pass->access[plane].offset };
	if (alone)
		wait_for_pieces(pass);
}

/* ---- packets ---- */

static void pass_tile_begin(struct pass *pass, const uint32_t *packet)
{
	struct model *model = pass->model;
	struct gloss_tile_begin p;

	gloss_tile_begin_unpack(packet, &p);
	pass->piece = (struct model_piece){ model->job, model->state, model->at, 0,
					    model->response_used };
	pass->access[COLOUR] = pass->access[DEPTH] = (struct access){ .used = false };
	if (p.colour_load)
		add_access(model, &pass->access[COLOUR], &model->state.colour_surface, p.colour);
	if (p.depth_load)
		add_access(model, &pass->access[DEPTH], &model->state.depth_surface, p.depth);
	model->in_tile = true;
}

static void pass_output(struct pass *pass, int plane, enum gloss_tile_output output,
			const struct model_target *surface, uint32_t offset)
{
	struct model *model = pass->model;

	if (output == GLOSS_TILE_OUTPUT_STORE)
		add_access(model, &pass->access[plane], surface, offset);
	else if (output == GLOSS_TILE_OUTPUT_ANSWER)
		model->response_used += (uint32_t)(model->tile_size * model->tile_size);
}

static void pass_tile_end(struct pass *pass, const uint32_t *packet)
{
	struct model *model = pass->model;
	struct gloss_tile_end p;

	gloss_tile_end_unpack(packet, &p);
	pass_output(pass, COLOUR, p.colour_output, &model->state.colour_surface, p.colour);
	pass_output(pass, DEPTH, p.depth_output, &model->state.depth_surface, p.depth);
	pass->piece.end = model->at + 1 + GLOSS_TILE_END_WORDS;
	model->in_tile = false;
	hand_out(pass);
}

/* Executes what is not pixels of a packet that was checked. */
static void pass_packet(struct pass *pass, const uint32_t *packet)
{
	switch (gloss_header_opcode(packet[0])) {
	case GLOSS_OP_TRIANGLE:
	case GLOSS_OP_TRIANGLE_SMALL:
		return;
	case GLOSS_OP_TILE_BEGIN:
		pass_tile_begin(pass, packet);
		return;
	case GLOSS_OP_TILE_END:
		pass_tile_end(pass, packet);
		return;
	case GLOSS_OP_NOP:
	case GLOSS_OP_COLOUR_SURFACE:
	case GLOSS_OP_DEPTH_SURFACE:
	case GLOSS_OP_DEPTH_STATE:
	case GLOSS_OP_COLOUR_MASK:
	case GLOSS_OP_SCISSOR:
		break;
	default:
		wait_for_pieces(pass);
	}
	model_execute(pass->model, packet);
}

static bool pass_next(struct pass *pass)
{
	struct model *model = pass->model;
	const uint32_t *packet;

	if (!model_check_next(model))
		return false;
	packet = model->job->stream + model->at;
	pass_packet(pass, packet);
	model->at += 1 + gloss_header_length(packet[0]);
	return true;
}

int model_run_parallel(struct model *model, const struct accel_job *job,
		       const struct model_drawer *drawer, void *data, struct gloss_status *status)
{
	struct pass pass = { .model = model, .drawer = drawer, .data = data };
	int err = model_begin_whole(model, job);

	if (err)
		return err;
	while (pass_next(&pass))
		;
	wait_for_pieces(&pass);
	model_end(model, status);
	return 0;
}

void model_draw_piece(struct model *model, const struct model_piece *piece)
{
	const uint32_t *packet = piece->job->stream + piece->at;
	const uint32_t *end = piece->job->stream + piece->end;

	model->job = piece->job;
	model->state = piece->state;
	model->response_used = piece->response_used;
	model->response_from = 0;
	for (; packet < end; packet += 1 + gloss_header_length(packet[0]))
		model_execute(model, packet);
}
