/* SPDX-License-Identifier: MIT */
/* What the unit tests of the library share: cmocka, devices that collect messages, a seed. */
#ifndef ACCEL_TEST_H
#define ACCEL_TEST_H

#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "accel.h"
#include "gloss_packets.h"

/* The last line that a device had to say, and how many there were. */
struct messages {
	char last[512];
	int count;
};

static inline void messages_take(void *data, const char *line)
{
	struct messages *messages = data;

	snprintf(messages->last, sizeof(messages->last), "%s", line);
	messages->count++;
}

#define assert_message(messages, part)                                                  \
	do {                                                                            \
		if (!strstr((messages)->last, part))                                    \
			fail_msg("\"%s\" does not say \"%s\"", (messages)->last, part); \
	} while (0)

static inline struct accel_device *device_open(const char *name, struct messages *messages)
{
	struct accel_device *device = NULL;

	*messages = (struct messages){ "", 0 };
	if (accel_device_new(name, messages_take, messages, &device))
		fail_msg("%s does not open: %s", name, messages->last);
	return device;
}

/*
 * For what has to happen: what takes longer hangs. So long that only a machine that is more than
 * a hundred times slower than usual comes near; GLOSS_SLOW then says how many times more.
 */
static inline int test_patience_ms(void)
{
	const char *slow = getenv("GLOSS_SLOW");
	int times = slow ? atoi(slow) : 1;

	return 60000 * (times > 0 && times < 1000 ? times : 1);
}

/* The same for all that a test does, in seconds: for alarm(). */
static inline unsigned int test_patience_s(void)
{
	return 5u * (unsigned int)test_patience_ms() / 1000;
}

/* Begins a frame whose target is cleared, colour and depth. */
static inline int draw_begin(struct accel_draw *draw, struct accel_target *target,
			     const float rgba[4], float depth)
{
	struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH,
					       .depth = depth);

	memcpy(clear.rgba, rgba, sizeof(clear.rgba));
	return accel_draw_begin(draw, target, &clear);
}

/* GLOSS_SEED, or the time; printed, so that a failure can be repeated. */
static inline uint64_t test_seed(void)
{
	const char *given = getenv("GLOSS_SEED");
	uint64_t seed = given ? strtoull(given, NULL, 0) : (uint64_t)time(NULL);

	print_message("GLOSS_SEED=%llu\n", (unsigned long long)seed);
	return seed;
}

/* splitmix64: each call the next number of the seed. */
static inline uint64_t test_random(uint64_t *seed)
{
	uint64_t z = *seed += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return z ^ z >> 31;
}

static inline uint32_t test_below(uint64_t *seed, uint32_t limit)
{
	return (uint32_t)(test_random(seed) % limit);
}

/* The packets that the tests send, each in @words from the header on; the count of words. */
static inline size_t packet_write(uint32_t *words, unsigned int slot, uint32_t offset,
				  uint32_t value)
{
	const struct gloss_write_memory packet = { .slot = slot, .offset = offset };

	gloss_write_memory_pack(words, &packet, 3);
	words[3] = value;
	return 4;
}

static inline size_t packet_read(uint32_t *words, unsigned int slot, uint32_t offset,
				 uint32_t count)
{
	const struct gloss_read_memory packet = { .slot = slot, .offset = offset, .count = count };

	gloss_read_memory_pack(words, &packet);
	return 3;
}

#endif
