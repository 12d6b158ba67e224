// SPDX-License-Identifier: MIT
#include "transport/workers.h"

void accel_workers_init(struct accel_workers *workers, unsigned int count)
{
	*workers = (struct accel_workers){ .count = count };
	pthread_mutex_init(&workers->lock, NULL);
	pthread_cond_init(&workers->posted, NULL);
	pthread_cond_init(&workers->idle, NULL);
}

void accel_workers_fini(struct accel_workers *workers)
{
	pthread_mutex_lock(&workers->lock);
	workers->stop = true;
	pthread_cond_broadcast(&workers->posted);
	pthread_mutex_unlock(&workers->lock);
	while (workers->threads)
		pthread_join(workers->worker[--workers->threads].thread, NULL);
	pthread_cond_destroy(&workers->idle);
	pthread_cond_destroy(&workers->posted);
	pthread_mutex_destroy(&workers->lock);
}

/* Does the next item, of which there is one. Called with the lock, without which it works. */
static void workers_do_next(struct accel_workers *workers, unsigned int worker)
{
	const uint32_t item = workers->next++;

	pthread_mutex_unlock(&workers->lock);
	workers->work(workers->data, worker, item);
	pthread_mutex_lock(&workers->lock);
}

static void *workers_thread(void *argument)
{
	const struct accel_worker *worker = argument;
	struct accel_workers *workers = worker->workers;

	pthread_mutex_lock(&workers->lock);
	while (!workers->stop) {
		if (workers->next == workers->items) {
			pthread_cond_wait(&workers->posted, &workers->lock);
			continue;
		}
		workers->working++;
		workers_do_next(workers, worker->number);
		if (!--workers->working)
			pthread_cond_signal(&workers->idle);
	}
	pthread_mutex_unlock(&workers->lock);
	return NULL;
}

/* As many as have something to do. Fewer than wanted do the same work. */
static void workers_start(struct accel_workers *workers)
{
	while (workers->threads + 1 < workers->count && workers->threads + 1 < workers->items) {
		struct accel_worker *worker = &workers->worker[workers->threads];

		worker->workers = workers;
		worker->number = workers->threads + 1;
		if (accel_thread_new(&worker->thread, workers_thread, worker))
			return;
		workers->threads++;
	}
}

void accel_workers_run(struct accel_workers *workers, accel_work work, void *data, uint32_t items)
{
	int held = accel_thread_hold_cancel();

	pthread_mutex_lock(&workers->lock);
	workers->work = work;
	workers->data = data;
	workers->next = 0;
	workers->items = items;
	workers_start(workers);
	pthread_cond_broadcast(&workers->posted);
	while (workers->next < items)
		workers_do_next(workers, 0);
	while (workers->working)
		pthread_cond_wait(&workers->idle, &workers->lock);
	pthread_mutex_unlock(&workers->lock);
	accel_thread_allow_cancel(held);
}
