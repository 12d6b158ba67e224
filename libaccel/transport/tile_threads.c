// SPDX-License-Identifier: MIT
#include "transport/tile_threads.h"

void accel_tile_threads_init(struct accel_tile_threads *threads, unsigned int count, int tile_size,
			     void *memory, size_t memory_size)
{
	*threads = (struct accel_tile_threads){
		.tile_size = tile_size,
		.memory = memory,
		.memory_size = memory_size,
		.wanted = count - 1,
	};
	pthread_mutex_init(&threads->lock, NULL);
	pthread_cond_init(&threads->posted, NULL);
	pthread_cond_init(&threads->idle, NULL);
	model_init(&threads->own, tile_size, memory, memory_size);
}

void accel_tile_threads_fini(struct accel_tile_threads *threads)
{
	pthread_mutex_lock(&threads->lock);
	threads->stop = true;
	pthread_cond_broadcast(&threads->posted);
	pthread_mutex_unlock(&threads->lock);
	while (threads->threads)
		pthread_join(threads->thread[--threads->threads], NULL);
	pthread_cond_destroy(&threads->idle);
	pthread_cond_destroy(&threads->posted);
	pthread_mutex_destroy(&threads->lock);
}

static void add_counters(struct model_counters *to, const struct model_counters *from)
{
	to->triangles += from->triangles;
	to->covered += from->covered;
	to->passed += from->passed;
	to->tiles += from->tiles;
}

/* Draws the oldest piece, of which there is one. Called with the lock, without which it draws. */
static void draw_first(struct accel_tile_threads *threads, struct model *model)
{
	const struct model_piece piece = threads->piece[threads->first];

	threads->first = (threads->first + 1) % ACCEL_TILE_PIECES;
	threads->count--;
	threads->drawing++;
	pthread_mutex_unlock(&threads->lock);
	model->counters = (struct model_counters){ 0 };
	model_draw_piece(model, &piece);
	pthread_mutex_lock(&threads->lock);
	add_counters(&threads->counters, &model->counters);
	threads->drawing--;
}

static void *tile_thread(void *argument)
{
	struct accel_tile_threads *threads = argument;
	struct model model;

	model_init(&model, threads->tile_size, threads->memory, threads->memory_size);
	pthread_mutex_lock(&threads->lock);
	while (!threads->stop) {
		if (!threads->count) {
			pthread_cond_wait(&threads->posted, &threads->lock);
			continue;
		}
		draw_first(threads, &model);
		if (!threads->count && !threads->drawing)
			pthread_cond_signal(&threads->idle);
	}
	pthread_mutex_unlock(&threads->lock);
	return NULL;
}

/* One thread more, if there is work for it. Fewer than wanted do the same work. */
static void start_thread(struct accel_tile_threads *threads)
{
	if (threads->count < 2 || threads->threads == threads->wanted || threads->refused)
		return;
	if (accel_thread_new(&threads->thread[threads->threads], tile_thread, threads))
		threads->refused = true;
	else
		threads->threads++;
}

static void draw_piece(void *data, const struct model_piece *piece)
{
	struct accel_tile_threads *threads = data;

	pthread_mutex_lock(&threads->lock);
	if (threads->count == ACCEL_TILE_PIECES)
		draw_first(threads, &threads->own);
	threads->piece[(threads->first + threads->count++) % ACCEL_TILE_PIECES] = *piece;
	start_thread(threads);
	/* The last is left to the thread that runs the job, if it has nothing else to do then. */
	if (threads->count > 1)
		pthread_cond_signal(&threads->posted);
	pthread_mutex_unlock(&threads->lock);
}

static void wait_for_pieces(void *data, struct model_counters *counters)
{
	struct accel_tile_threads *threads = data;

	pthread_mutex_lock(&threads->lock);
	while (threads->count)
		draw_first(threads, &threads->own);
	while (threads->drawing)
		pthread_cond_wait(&threads->idle, &threads->lock);
	add_counters(counters, &threads->counters);
	threads->counters = (struct model_counters){ 0 };
	threads->refused = false;
	pthread_mutex_unlock(&threads->lock);
}

const struct model_drawer accel_tile_drawer = { draw_piece, wait_for_pieces };
