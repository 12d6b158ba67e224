// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "draw/content.h"
#include "transport/thread.h"

#define PLANES 2

/* The planes' bits in masks of ACCEL_CLEAR_* are those of enum accel_plane. */
_Static_assert(ACCEL_CLEAR_COLOUR == 1u << ACCEL_PLANE_COLOUR &&
		       ACCEL_CLEAR_DEPTH == 1u << ACCEL_PLANE_DEPTH,
	       "a plane's number is that of its bit");

/* Of a plane of a tile. */
struct content_fill {
	enum {
		CONTENT_UNKNOWN,
		CONTENT_SENT, /* a clear to @value, in jobs whose outcome is not known yet */
		CONTENT_HELD  /* @value in every pixel */
	} state;
	uint32_t value;
};

struct content_tile {
	struct content_fill plane[PLANES];
};

struct accel_content {
	atomic_uint references;
	pthread_mutex_t turn;          /* of a frame that is being submitted; under it: */
	struct accel_outcome *outcome; /* of the jobs that made tiles CONTENT_SENT */
	bool waiting;                  /* for @outcome */
	int held;                      /* cancellation, of who has the turn */
	uint64_t written[PLANES];      /* buffer->written after the last frame's jobs */
	int tiles;
	struct content_tile tile[];
};

int accel_content_new(const struct accel_target *target, struct accel_content **out)
{
	int size = (int)target->device->info.tile_size;
	int tiles = ((target->width + size - 1) / size) * ((target->height + size - 1) / size);
	pthread_mutexattr_t attributes;
	struct accel_content *content;

	*out = NULL;
	if (!target->device->ops->memory_keeps)
		return 0;
	content = calloc(1, sizeof(*content) + (size_t)tiles * sizeof(content->tile[0]));
	if (!content)
		return -ENOMEM;
	content->outcome = accel_outcome_new();
	if (!content->outcome) {
		free(content);
		return -ENOMEM;
	}
	content->references = 1;
	content->tiles = tiles;
	/* A message function may submit another frame on the target of the one that has the turn. */
	pthread_mutexattr_init(&attributes);
	pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK);
	pthread_mutex_init(&content->turn, &attributes);
	pthread_mutexattr_destroy(&attributes);
	*out = content;
	return 0;
}

struct accel_content *accel_content_ref(struct accel_content *content)
{
	if (content)
		atomic_fetch_add(&content->references, 1);
	return content;
}

void accel_content_unref(struct accel_content *content)
{
	if (!content || atomic_fetch_sub(&content->references, 1) != 1)
		return;
	accel_outcome_unref(content->outcome);
	pthread_mutex_destroy(&content->turn);
	free(content);
}

/* ---- before a frame ---- */

/* What was sent is held, or unknown if its jobs failed. */
static void content_settle(struct accel_content *content, bool done)
{
	for (int i = 0; i < content->tiles * PLANES; i++) {
		struct content_fill *fill = &content->tile[i / PLANES].plane[i % PLANES];

		if (fill->state == CONTENT_SENT)
			fill->state = done ? CONTENT_HELD : CONTENT_UNKNOWN;
	}
	content->waiting = false;
}

static void content_forget(struct accel_content *content, enum accel_plane plane)
{
	for (int i = 0; i < content->tiles; i++)
		content->tile[i].plane[plane].state = CONTENT_UNKNOWN;
}

/* Did a job write it that was not the frames'? */
static void content_compare(struct accel_content *content, enum accel_plane plane,
			    struct accel_buffer *buffer)
{
	uint64_t written = atomic_load(&buffer->written);

	if (written != content->written[plane])
		content_forget(content, plane);
	content->written[plane] = written;
}

struct accel_content *accel_content_begin(const struct accel_target *target)
{
	struct accel_content *content = target->content;
	enum accel_outcome_state state;
	int held;

	/* In a child of fork() the turn may be taken for ever. */
	if (!content || accel_device_is_inherited(target->device))
		return NULL;
	held = accel_thread_hold_cancel();
	if (pthread_mutex_lock(&content->turn)) {
		accel_thread_allow_cancel(held);
		return NULL;
	}
	content->held = held;
	state = accel_outcome_look(content->outcome);
	if (content->waiting && state != ACCEL_OUTCOME_PENDING)
		content_settle(content, state == ACCEL_OUTCOME_DONE);
	content_compare(content, ACCEL_PLANE_COLOUR, target->colour);
	content_compare(content, ACCEL_PLANE_DEPTH, target->depth);
	return content;
}

/* ---- its tiles ---- */

static uint32_t content_value(const struct accel_tile_clear *clear, int plane)
{
	return plane == ACCEL_PLANE_COLOUR ? clear->colour : clear->depth;
}

unsigned int accel_content_holds(const struct accel_content *content, int tile,
				 const struct accel_tile_clear *clear)
{
	unsigned int holds = 0;

	for (int plane = 0; plane < PLANES; plane++) {
		const struct content_fill *fill = &content->tile[tile].plane[plane];

		if (fill->state == CONTENT_HELD && fill->value == content_value(clear, plane))
			holds |= 1u << plane;
	}
	return holds & clear->mask;
}

/* ---- after it ---- */

/* A tile that nothing was drawn on and that was cleared: as before if it was to this value. */
static void content_clear(const struct accel_content *content, struct content_fill *fill,
			  uint32_t value)
{
	if (fill->state != CONTENT_UNKNOWN && fill->value == value)
		return;
	fill->state = content->waiting ? CONTENT_UNKNOWN : CONTENT_SENT;
	fill->value = value;
}

static void content_tile(const struct accel_content *content, struct content_tile *known,
			 const struct accel_bin *bin, const struct accel_tile *tile)
{
	for (int plane = 0; plane < PLANES; plane++) {
		if (tile->drawn)
			known->plane[plane].state = CONTENT_UNKNOWN;
		else if (bin->clear.mask & ~bin->discard & 1u << plane)
			content_clear(content, &known->plane[plane],
				      content_value(&bin->clear, plane));
	}
}

/* A frame was sent as @jobs. */
static void content_frame(struct accel_content *content, const struct accel_bin *bin,
			  struct accel_fence *fence, unsigned int jobs)
{
	for (int i = 0; i < bin->columns * bin->rows; i++)
		content_tile(content, &content->tile[i], bin, &bin->tile[i]);
	content->written[ACCEL_PLANE_COLOUR] += jobs;
	content->written[ACCEL_PLANE_DEPTH] += jobs;
	if (content->waiting)
		return;
	accel_fence_tell(fence, content->outcome);
	content->waiting = true;
}

void accel_content_end(struct accel_content *content, const struct accel_bin *bin,
		       struct accel_fence *fence, unsigned int jobs)
{
	int held = content->held;

	if (fence)
		content_frame(content, bin, fence, jobs);
	pthread_mutex_unlock(&content->turn);
	accel_thread_allow_cancel(held);
}
