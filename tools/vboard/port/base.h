/* SPDX-License-Identifier: MIT */
/*
 * What the models of all ports have: the registers that rtl/gloss.xml has outside of any
 * bus, and a job in an engine that they do not know. What a job makes a port hold does
 * not grow with the job: stream and response pass through windows.
 */
#ifndef VBOARD_PORT_BASE_H
#define VBOARD_PORT_BASE_H

#include <stdbool.h>
#include <stdint.h>

#include "gloss_regs.h"
#include "job.h"

/* The longest packet. */
#define PORT_WINDOW_WORDS (1 + GLOSS_LENGTH_MAX)
/* The most an engine answers in one step. */
#define PORT_ANSWER_WORDS 65536u
/* Stream and response words after which work() returns. */
#define PORT_WORK_WORDS 4096u

struct port_step {
	/* Of the stream, from the first not taken: the next packet, as long as its header says,
	 * or all that is left. */
	const uint32_t *words;
	uint32_t count;    /* at least 1; may be more */
	uint32_t *answer;  /* room for PORT_ANSWER_WORDS, which are the engine's */
	uint32_t taken;    /* out: at least 1 */
	uint32_t answered; /* out: not more than the job has room for */
};

struct port_engine {
	void *data;
	/* A job starts; its stream and response are NULL. False: its slots leave board memory. */
	bool (*begin)(void *data, const struct accel_job *job);
	/* Works for some microseconds; called until all words are taken. */
	void (*step)(void *data, struct port_step *step);
	/* All words are taken: how did the job end? */
	void (*end)(void *data, struct gloss_status *status);
	/* A job that was begun may also never be stepped again. */
};

/* Of a board, as it was built. */
struct port_build {
	uint32_t tile_size, pixels_per_clock, memory_pages;
};

#define PORT_REGISTERS 34 /* words that there are registers in */

struct port_base {
	struct port_engine engine;
	struct port_build build;
	uint32_t reg[PORT_REGISTERS];

	/* The job under way. */
	uint32_t sequence;
	struct gloss_status status;

	/* Stream words that the engine has not taken: count of them, from first on. */
	uint32_t window[4 * PORT_WINDOW_WORDS];
	uint32_t window_first, window_count;
	uint32_t answer[PORT_ANSWER_WORDS];
};

#define PORT_REG(base, name) ((base)->reg[GLOSS_REG_##name / 4])

/* Power on: all but the registers. */
void port_base_init(struct port_base *base, const struct port_engine *engine,
		    const struct port_build *build);
/* Registers after a reset. */
void port_base_reset(struct port_base *base, uint32_t ring_max_log2);

/* What a register reads; STATUS is the port's. */
uint32_t port_base_read(const struct port_base *base, uint32_t offset, uint32_t status);

/* Slot @n of a job from its words. */
void port_base_slot(struct accel_job *job, uint32_t n, const uint32_t *words);
/* False: the engine does not take the job, and status says why. */
bool port_base_begin(struct port_base *base, const struct accel_job *job);
/* Where @words more of the stream go; the window then has at most 4 * PORT_WINDOW_WORDS. */
uint32_t *port_base_room(struct port_base *base, uint32_t words);
/* The next step of a job whose next packet, or all that is left of it, is in the window. */
void port_base_step(struct port_base *base, struct port_step *step);
/* The job has ended as status says. */
void port_base_count(struct port_base *base);

#endif
