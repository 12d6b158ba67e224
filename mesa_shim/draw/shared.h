/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_SHARED_H
#define GLOSS_SHARED_H

#include <pthread.h>

#include "draw/names.h"

/* What contexts share. */
struct gloss_shared {
	pthread_mutex_t lock; /* of all that follows */
	unsigned int references;
	struct gloss_names lists, buffers;
};

#endif
