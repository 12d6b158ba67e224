// SPDX-License-Identifier: MIT
/* The USB port: from words of OUT to words of IN. */
#include "vboard/port/usb.h"

#include <string.h>

#include "transport/usb/checksum.h"

#define REG(port, name) PORT_REG(&(port)->base, name)

/* ---- channels ---- */

/* The next of the @count words that are in @fifo. */
static uint32_t fifo_pop(struct port_usb_fifo *fifo)
{
	uint32_t word = fifo->word[fifo->first];

	fifo->first = (fifo->first + 1) % PORT_USB_FIFO_WORDS;
	fifo->count--;
	return word;
}

/* How many of the @count words from entry @at on are before the FIFO's end. */
static uint32_t fifo_before_end(uint32_t at, uint32_t count)
{
	return count < PORT_USB_FIFO_WORDS - at ? count : PORT_USB_FIFO_WORDS - at;
}

static uint32_t fifo_pop_many(struct port_usb_fifo *fifo, uint32_t *words, uint32_t most)
{
	uint32_t count = most < fifo->count ? most : fifo->count;
	uint32_t before = fifo_before_end(fifo->first, count);

	memcpy(words, fifo->word + fifo->first, 4 * (size_t)before);
	memcpy(words + before, fifo->word, 4 * (size_t)(count - before));
	fifo->first = (fifo->first + count) % PORT_USB_FIFO_WORDS;
	fifo->count -= count;
	return count;
}

static uint32_t fifo_room(const struct port_usb_fifo *fifo)
{
	return PORT_USB_FIFO_WORDS - fifo->count;
}

/* There is room. */
static void fifo_push_many(struct port_usb_fifo *fifo, const uint32_t *words, uint32_t count)
{
	uint32_t at = (fifo->first + fifo->count) % PORT_USB_FIFO_WORDS;
	uint32_t before = fifo_before_end(at, count);

	memcpy(fifo->word + at, words, 4 * (size_t)before);
	memcpy(fifo->word, words + before, 4 * (size_t)(count - before));
	fifo->count += count;
}

/* A message on IN; false: it has to wait for room. */
static bool port_send(struct port_usb *port, const uint32_t *words, uint32_t count, bool flush)
{
	struct port_usb_fifo *in = &port->in;

	if (fifo_room(in) < count)
		return false;
	fifo_push_many(in, words, count);
	port->burst_end[(in->first + in->count - 1) % PORT_USB_FIFO_WORDS] = flush;
	return true;
}

uint32_t port_usb_out(struct port_usb *port, const uint32_t *words, uint32_t count)
{
	uint32_t room = fifo_room(&port->out);

	if (count > room)
		count = room;
	fifo_push_many(&port->out, words, count);
	return count;
}

uint32_t port_usb_in(struct port_usb *port, uint32_t *words, uint32_t room, bool *flush)
{
	uint32_t count = 0;

	*flush = false;
	while (count < room && port->in.count && !*flush) {
		*flush = port->burst_end[port->in.first];
		port->burst_end[port->in.first] = false;
		words[count++] = fifo_pop(&port->in);
	}
	return count;
}

/* ---- events ---- */

static void port_event(struct port_usb *port, const struct gloss_usb_event *event)
{
	if (port->events < PORT_USB_EVENTS)
		gloss_usb_event_pack(port->event[port->events++], event);
}

bool port_usb_event(struct port_usb *port, uint32_t words[GLOSS_USB_EVENT_WORDS])
{
	if (!port->events)
		return false;
	memcpy(words, port->event[0], sizeof(port->event[0]));
	port->events--;
	memmove(port->event[0], port->event[1], port->events * sizeof(port->event[0]));
	return true;
}

/* ---- before a job. These and those below return how many words moved ---- */

static uint32_t port_synchronise(struct port_usb *port)
{
	struct gloss_usb_sync sync;

	if (!port->out.count)
		return 0;
	memmove(port->head, port->head + 1, 4 * (GLOSS_USB_SYNC_WORDS - 1));
	port->head[GLOSS_USB_SYNC_WORDS - 1] = fifo_pop(&port->out);
	gloss_usb_sync_unpack(port->head, &sync);
	if (sync.mark == GLOSS_USB_SYNC_MAGIC && sync.mark_complement == ~sync.mark &&
	    sync.nonce_complement == ~sync.nonce && sync.nonce && sync.nonce == REG(port, NONCE)) {
		/* Nothing was sent since the reset, so there is room. */
		port_send(port, port->head, GLOSS_USB_SYNC_WORDS, true);
		port->state = PORT_USB_READY;
	}
	return 1;
}

static void port_lose(struct port_usb *port)
{
	port->state = PORT_USB_LOST;
	port_event(port, &(struct gloss_usb_event){ .mark = GLOSS_USB_EVENT_MAGIC, .lost = true });
}

static uint32_t port_begin_head(struct port_usb *port)
{
	const uint32_t reserved = ~(GLOSS_USB_JOB_SLOTS | GLOSS_USB_JOB_MARK);
	struct gloss_usb_job job;

	if (!port->out.count)
		return 0;
	port->head[0] = fifo_pop(&port->out);
	port->head_count = 1;
	gloss_usb_job_unpack(port->head, &job);
	if (job.mark == GLOSS_USB_JOB_MAGIC && !(port->head[0] & reserved) &&
	    job.slots <= GLOSS_SLOTS)
		port->state = PORT_USB_HEAD;
	else
		port_lose(port);
	return 1;
}

static void port_begin(struct port_usb *port)
{
	struct gloss_usb_job head;
	struct accel_job job;

	gloss_usb_job_unpack(port->head, &head);
	job = (struct accel_job){
		.stream_words = head.stream_words,
		.response_words = head.response_words,
	};
	for (uint32_t n = 0; n < head.slots; n++)
		port_base_slot(&job, n,
			       port->head + GLOSS_USB_JOB_WORDS +
				       (size_t)n * GLOSS_SLOT_ENTRY_WORDS);
	port->base.sequence = head.sequence;
	port->stream_left = head.stream_words;
	port->answer_count = 0;
	port->chunk_count = 0;
	port->in_checksum = 0;
	port->refused = !port_base_begin(&port->base, &job);
	port->state = PORT_USB_RUNNING;
}

static uint32_t port_head(struct port_usb *port)
{
	uint32_t slots = port->head[0] & GLOSS_USB_JOB_SLOTS;
	uint32_t words = GLOSS_USB_JOB_WORDS + slots * GLOSS_SLOT_ENTRY_WORDS;
	uint32_t moved;

	moved = fifo_pop_many(&port->out, port->head + port->head_count, words - port->head_count);
	port->head_count += moved;
	if (port->head_count == words) {
		port->out_checksum = accel_usb_checksum(0,
							port->head +
								GLOSS_USB_JOB_STREAM_WORDS_WORD,
							words - GLOSS_USB_JOB_STREAM_WORDS_WORD);
		port_begin(port);
	}
	return moved;
}

/* ---- the job ---- */

/* False: it has to wait for room. */
static bool port_send_chunk(struct port_usb *port)
{
	gloss_usb_response_pack(port->chunk, &(struct gloss_usb_response){
						     .count = port->chunk_count,
						     .mark = GLOSS_USB_RESPONSE_MAGIC,
					     });
	if (!port_send(port, port->chunk, GLOSS_USB_RESPONSE_WORDS + port->chunk_count, false))
		return false;
	port->in_checksum = accel_usb_checksum(port->in_checksum,
					       port->chunk + GLOSS_USB_RESPONSE_WORDS,
					       port->chunk_count);
	port->chunk_count = 0;
	return true;
}

/* Answered words into the chunk; a full one leaves. */
static uint32_t port_answer(struct port_usb *port)
{
	uint32_t count = GLOSS_USB_CHUNK_WORDS - port->chunk_count;

	if (!count)
		return port_send_chunk(port);
	if (count > port->answer_count)
		count = port->answer_count;
	memcpy(port->chunk + GLOSS_USB_RESPONSE_WORDS + port->chunk_count,
	       port->base.answer + port->answer_first, 4 * (size_t)count);
	port->chunk_count += count;
	port->answer_first += count;
	port->answer_count -= count;
	return count;
}

/* Words of the stream into the window, up to any packet's end. */
static uint32_t port_fill(struct port_usb *port)
{
	struct port_base *base = &port->base;
	uint32_t most = 2 * PORT_WINDOW_WORDS - base->window_count, moved, *words;

	if (most > port->stream_left)
		most = port->stream_left;
	if (most > port->out.count)
		most = port->out.count;
	words = port_base_room(base, most);
	moved = fifo_pop_many(&port->out, words, most);
	port->out_checksum = accel_usb_checksum(port->out_checksum, words, moved);
	if (!port->refused)
		base->window_count += moved;
	port->stream_left -= moved;
	REG(port, PROGRESS) += moved;
	return moved;
}

/* Is there a packet, or the end of the stream, for the engine? */
static bool port_has_packet(const struct port_usb *port)
{
	const struct port_base *base = &port->base;

	if (!base->window_count || !port->stream_left)
		return base->window_count;
	return base->window_count > gloss_header_length(base->window[base->window_first]);
}

static uint32_t port_run(struct port_usb *port)
{
	uint32_t moved = port_answer(port) + port_fill(port);
	struct port_step step;

	if (port->answer_count || port->chunk_count == GLOSS_USB_CHUNK_WORDS)
		return moved;
	if (port_has_packet(port)) {
		port_base_step(&port->base, &step);
		port->answer_first = 0;
		port->answer_count = step.answered;
		moved += step.taken;
	} else if (!port->stream_left) {
		if (!port->refused)
			port->base.engine.end(port->base.engine.data, &port->base.status);
		port->state = PORT_USB_CHECKING;
		moved++;
	}
	return moved;
}

static uint32_t port_check(struct port_usb *port)
{
	if (!port->out.count)
		return 0;
	if (fifo_pop(&port->out) == port->out_checksum)
		port->state = PORT_USB_ENDING;
	else
		port_lose(port);
	return 1;
}

static uint32_t port_end(struct port_usb *port)
{
	const struct gloss_status *status = &port->base.status;
	uint32_t words[GLOSS_USB_COMPLETION_WORDS];

	if (port->chunk_count)
		return port_send_chunk(port);
	gloss_usb_completion_pack(words, &(struct gloss_usb_completion){
						 .cause = status->cause,
						 .mark = GLOSS_USB_COMPLETION_MAGIC,
						 .sequence = port->base.sequence,
						 .offset = status->offset,
						 .response_words = status->response_words,
					 });
	words[GLOSS_USB_COMPLETION_CHECKSUM_WORD] = accel_usb_checksum(
		port->in_checksum, words, GLOSS_USB_COMPLETION_CHECKSUM_WORD);
	if (!port_send(port, words, GLOSS_USB_COMPLETION_WORDS, true))
		return 0;
	port_base_count(&port->base);
	if (status->cause)
		port_event(port, &(struct gloss_usb_event){ .cause = status->cause,
							    .mark = GLOSS_USB_EVENT_MAGIC,
							    .sequence = port->base.sequence });
	port->state = PORT_USB_READY;
	return 1;
}

static uint32_t port_drop(struct port_usb *port)
{
	uint32_t moved = port->out.count;

	port->out.count = 0;
	return moved;
}

bool port_usb_work(struct port_usb *port)
{
	static uint32_t (*const advance[])(struct port_usb *) = {
		[PORT_USB_UNSYNCHRONISED] = port_synchronise,
		[PORT_USB_READY] = port_begin_head,
		[PORT_USB_HEAD] = port_head,
		[PORT_USB_RUNNING] = port_run,
		[PORT_USB_CHECKING] = port_check,
		[PORT_USB_ENDING] = port_end,
		[PORT_USB_LOST] = port_drop,
	};
	uint32_t words = 0;

	while (words < PORT_WORK_WORDS) {
		uint32_t moved = advance[port->state](port);

		if (!moved)
			break;
		words += moved;
	}
	return words;
}

/* ---- registers ---- */

static uint32_t port_status(const struct port_usb *port)
{
	switch (port->state) {
	case PORT_USB_HEAD:
		return 0;
	case PORT_USB_RUNNING:
	case PORT_USB_CHECKING:
	case PORT_USB_ENDING:
		return GLOSS_REG_STATUS_RUNNING;
	case PORT_USB_LOST:
		return GLOSS_REG_STATUS_IDLE | GLOSS_REG_STATUS_LOST;
	default:
		return GLOSS_REG_STATUS_IDLE;
	}
}

uint32_t port_usb_read(const struct port_usb *port, uint32_t offset)
{
	return port_base_read(&port->base, offset, port_status(port));
}

static void port_reset(struct port_usb *port)
{
	uint32_t boot = REG(port, BOOT);

	port_base_reset(&port->base, 0);
	REG(port, BOOT) = boot;
	port->state = PORT_USB_UNSYNCHRONISED;
	port->out.count = 0;
	port->in.count = 0;
	memset(port->burst_end, 0, sizeof(port->burst_end));
	memset(port->head, 0, sizeof(port->head));
	port->events = 0;
}

void port_usb_write(struct port_usb *port, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL && (value & GLOSS_REG_CONTROL_RESET))
		port_reset(port);
	if (offset == GLOSS_REG_NONCE)
		REG(port, NONCE) = value;
	if (offset == GLOSS_REG_BOOT)
		REG(port, BOOT) = value;
}

void port_usb_reset(struct port_usb *port)
{
	REG(port, BOOT) = 0;
	port_reset(port);
}

void port_usb_init(struct port_usb *port, const struct port_engine *engine,
		   const struct port_build *build)
{
	memset(port, 0, sizeof(*port));
	port_base_init(&port->base, engine, build);
	port_usb_reset(port);
}
