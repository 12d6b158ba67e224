/* SPDX-License-Identifier: MIT */
/*
 * Runs the library's life once for each call that can run out of memory, and lets
 * that one fail: the function must say so, and nothing may be left behind. The
 * linker puts the functions below in place of the C library's (-Wl,--wrap).
 */
#ifndef OUT_OF_MEMORY_H
#define OUT_OF_MEMORY_H

#include <pthread.h>
#include <sys/mman.h>

#include "accel_test.h"

/* ---- an allocator that fails when asked to ---- */

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static long calls, failing;            /* the call that fails, from 1; 0: none */
static long blocks, mappings, threads; /* that are there now */

static bool fails(long *count)
{
	bool now;

	pthread_mutex_lock(&lock);
	now = ++calls == failing;
	*count += now ? 0 : 1;
	pthread_mutex_unlock(&lock);
	return now;
}

static void gone(long *count)
{
	pthread_mutex_lock(&lock);
	--*count;
	pthread_mutex_unlock(&lock);
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
void *__real_mmap(void *at, size_t size, int protection, int flags, int file, off_t offset);
int __real_munmap(void *at, size_t size);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument);
int __real_pthread_join(pthread_t thread, void **result);

void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);
void *__wrap_mmap(void *at, size_t size, int protection, int flags, int file, off_t offset);
int __wrap_munmap(void *at, size_t size);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument);
int __wrap_pthread_join(pthread_t thread, void **result);

void *__wrap_malloc(size_t size)
{
	return fails(&blocks) ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
	return fails(&blocks) ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size)
{
	void *now = fails(&blocks) ? NULL : __real_realloc(block, size);

	if (now && block)
		gone(&blocks);
	return now;
}

void __wrap_free(void *block)
{
	if (block)
		gone(&blocks);
	__real_free(block);
}

void *__wrap_mmap(void *at, size_t size, int protection, int flags, int file, off_t offset)
{
	return fails(&mappings) ? MAP_FAILED :
				  __real_mmap(at, size, protection, flags, file, offset);
}

int __wrap_munmap(void *at, size_t size)
{
	gone(&mappings);
	return __real_munmap(at, size);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument)
{
	if (fails(&threads))
		return EAGAIN;
	return __real_pthread_create(thread, attributes, start, argument);
}

int __wrap_pthread_join(pthread_t thread, void **result)
{
	gone(&threads);
	return __real_pthread_join(thread, result);
}

/* ---- lives of the library: 0, or the first error ---- */

static uint32_t words[5000];

static int live_with_stream(struct accel_buffer *buffer, struct accel_stream *stream)
{
	uint32_t packet[4], response[1];
	struct accel_fence *fence;
	int err;

	err = accel_stream_emit(stream, packet, packet_write(packet, 0, 0, 5));
	if (err)
		return err;
	err = accel_stream_slot(stream, buffer, ACCEL_SLOT_READ | ACCEL_SLOT_WRITE);
	if (err < 0)
		return err;
	err = accel_stream_submit(stream, NULL, 0, &fence);
	if (err)
		return err;
	err = accel_stream_emit(stream, words, 5000);
	if (!err)
		err = accel_stream_finish(stream, NULL, 0);
	accel_fence_free(fence);
	if (err)
		return err;
	err = accel_stream_emit(stream, packet, packet_read(packet, 0, 0, 1));
	if (err)
		return err;
	accel_stream_slot(stream, buffer, ACCEL_SLOT_READ);
	err = accel_stream_finish(stream, response, 1);
	if (!err)
		assert_int_equal(response[0], 5);
	/* And a job that nobody waits for. */
	return err ? err : accel_stream_submit(stream, NULL, 0, NULL);
}

static int live_with_buffer(struct accel_device *device, struct accel_buffer *buffer)
{
	struct accel_stream *stream;
	int err;

	err = accel_buffer_write(buffer, 0, words, sizeof(words));
	if (!err)
		err = accel_buffer_read(buffer, 0, words, sizeof(words));
	if (!err)
		err = accel_stream_new(device, &stream);
	if (err)
		return err;
	err = live_with_stream(buffer, stream);
	accel_stream_free(stream);
	return err;
}

static int live_with_target(struct accel_device *device)
{
	struct accel_target *target;
	uint32_t pixels[40];
	int err;

	err = accel_target_new(device, 8, 5, &target);
	if (err)
		return err;
	err = accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, 32);
	if (!err)
		err = accel_target_read(target, ACCEL_PLANE_DEPTH, NULL, pixels, 32);
	accel_target_free(target);
	return err;
}

static int live_with_draw(struct accel_device *device)
{
	static const struct accel_clear red = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR,
							  .rgba = { 1, 0, 0, 1 });
	struct accel_target *target;
	struct accel_draw *draw;
	int err;

	err = accel_target_new(device, 8, 5, &target);
	if (err)
		return err;
	err = accel_draw_new(device, &draw);
	if (err)
		goto err_free_target;
	err = accel_draw_begin(draw, target, &red);
	if (!err)
		err = accel_draw_submit(draw, NULL);
	accel_draw_free(draw);
err_free_target:
	accel_target_free(target);
	return err ? err : accel_device_finish(device);
}

static int live_with_device(struct accel_device *device)
{
	struct accel_buffer *buffer;
	int err;

	err = accel_buffer_new(device, sizeof(words), &buffer);
	if (err)
		return err;
	err = live_with_buffer(device, buffer);
	accel_buffer_free(buffer);
	if (!err)
		err = live_with_target(device);
	return err ? err : live_with_draw(device);
}

static int live(const char *name)
{
	struct accel_device *device;
	struct accel_state *state;
	int err;

	err = accel_state_new(&state);
	if (err)
		return err;
	accel_state_free(state);
	err = accel_device_new(name, NULL, NULL, &device);
	if (err)
		return err;
	err = live_with_device(device);
	accel_device_free(device);
	return err;
}

/* ---- each of them with each failure ---- */

/* @helps_itself: the library may find the memory at its second try. */
static inline void fail_each_call(const char *name, bool helps_itself)
{
	long all;

	calls = failing = blocks = mappings = threads = 0;
	assert_int_equal(live(name), 0);
	all = calls;
	assert_true(all > 20);
	for (failing = 1; failing <= all; failing++) {
		int err;

		calls = 0;
		err = live(name);
		if (err != -ENOMEM && (err || !helps_itself))
			fail_msg("call %ld of %ld failed, and the answer was %d", failing, all,
				 err);
		if (blocks || mappings || threads)
			fail_msg("call %ld of %ld failed and left %ld blocks, %ld mappings, "
				 "%ld threads",
				 failing, all, blocks, mappings, threads);
	}
	failing = 0;
	assert_int_equal(live(name), 0);
}

#endif
