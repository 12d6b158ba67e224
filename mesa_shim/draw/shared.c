// SPDX-License-Identifier: MIT
#include "draw/shared.h"

#include <stdlib.h>

#include "draw/buffer.h"
#include "draw/list_priv.h"
#include "texture/texture.h"

struct gloss_shared *gloss_shared_new(void)
{
	struct gloss_shared *shared = calloc(1, sizeof(*shared));

	if (!shared)
		return NULL;
	if (pthread_mutex_init(&shared->lock, NULL))
		goto free_shared;
	if (pthread_rwlock_init(&shared->buffer_lock, NULL))
		goto destroy_lock;
	if (pthread_mutex_init(&shared->image_lock, NULL))
		goto destroy_buffer_lock;
	shared->references = 1;
	return shared;

destroy_buffer_lock:
	pthread_rwlock_destroy(&shared->buffer_lock);
destroy_lock:
	pthread_mutex_destroy(&shared->lock);
free_shared:
	free(shared);
	return NULL;
}

struct gloss_shared *gloss_shared_ref(struct gloss_shared *shared)
{
	pthread_mutex_lock(&shared->lock);
	shared->references++;
	pthread_mutex_unlock(&shared->lock);
	return shared;
}

void gloss_shared_unref(struct gloss_shared *shared)
{
	unsigned int left;

	pthread_mutex_lock(&shared->lock);
	left = --shared->references;
	pthread_mutex_unlock(&shared->lock);
	if (left)
		return;
	for (uint32_t i = 0; i < shared->lists.places; i++)
		gloss_list_unref(shared->lists.place[i].object);
	for (uint32_t i = 0; i < shared->buffers.places; i++)
		gloss_buffer_free(shared->buffers.place[i].object);
	for (uint32_t i = 0; i < shared->textures.places; i++)
		gloss_texture_free(shared->textures.place[i].object);
	free(shared->textures.place);
	free(shared->buffers.place);
	free(shared->lists.place);
	pthread_mutex_destroy(&shared->image_lock);
	pthread_rwlock_destroy(&shared->buffer_lock);
	pthread_mutex_destroy(&shared->lock);
	free(shared);
}
