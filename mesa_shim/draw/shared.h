/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_SHARED_H
#define GLOSS_SHARED_H

#include <pthread.h>

#include "draw/names.h"

/* What contexts share. */
struct gloss_shared {
	pthread_mutex_t lock; /* of the next three, and of textures' references */
	unsigned int references;
	struct gloss_names lists, textures;
	pthread_mutex_t image_lock; /* of the images of textures */
	/*
	 * Of the buffers and of what is in them. Draws hold it as readers, so that no other thread ends
	 * or changes what is drawn from. It is not taken twice.
	 */
	pthread_rwlock_t buffer_lock;
	struct gloss_names buffers;
};

#endif
