// SPDX-License-Identifier: MIT
/*
 * Random ioctls from several threads of several processes for a few seconds. What is sent
 * is nearly right more often than not, so that it gets past the first check, and handles
 * are closed under the other threads' hands. Nothing may come of it: no kernel message (the
 * runner looks), and the board works afterwards.
 */
#include <errno.h>
#include <pthread.h>
#include <stddef.h>
#include <sys/wait.h>
#include <xf86drm.h>

#include "gloss_node.h"
#include "vm_test.h"

enum {
	PROCESSES = 2,
	THREADS = 2, /* of each process, on the same file */
	SECONDS = 10,
	HANDLES = 24, /* of objects, and of syncobjs, that are named */
	ARRAY = 8,
};

/* ---- numbers ---- */

struct fuzz {
	uint64_t state;
	int fd, other; /* a file of the process's, and one nobody closes */
	uint64_t sent, taken;
};

/* splitmix64 */
static uint64_t draw(struct fuzz *fuzz)
{
	uint64_t z = fuzz->state += 0x9e3779b97f4a7c15u;

	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

static uint32_t below(struct fuzz *fuzz, uint32_t n)
{
	return (uint32_t)((draw(fuzz) >> 32) * n >> 32);
}

/* Numbers at which something changes. */
static uint64_t odd_number(struct fuzz *fuzz)
{
	static const uint64_t numbers[] = {
		0,          1,        2,          3,          4,
		15,         16,       17,         64,         65,
		4092,       4095,     4096,       4097,       8192,
		1u << 30,   1u << 31, UINT32_MAX, 1ull << 32, (1ull << 32) + 4096,
		1ull << 63, -4096ull, -4ull,      -1ull,
	};

	return below(fuzz, 4) ? numbers[below(fuzz, sizeof(numbers) / sizeof(numbers[0]))] :
				draw(fuzz);
}

static uint32_t handle(struct fuzz *fuzz)
{
	return below(fuzz, 20) ? 1 + below(fuzz, HANDLES) : (uint32_t)odd_number(fuzz);
}

/* Now and then changes a word or a byte of what is to be sent. */
static void damage(struct fuzz *fuzz, void *data, size_t size)
{
	uint64_t number = odd_number(fuzz);
	size_t bytes = below(fuzz, 2) ? 4 : 8;

	if (below(fuzz, 4))
		return;
	if (below(fuzz, 3))
		memcpy((char *)data + 4 * below(fuzz, (uint32_t)((size - bytes) / 4 + 1)), &number,
		       bytes);
	else
		((char *)data)[below(fuzz, (uint32_t)size)] ^= (char)(1 << below(fuzz, 8));
}

static int send(struct fuzz *fuzz, unsigned long request, void *data, size_t size)
{
	int err;

	damage(fuzz, data, size);
	err = node_ioctl(fuzz->fd, request, below(fuzz, 100) ? data : (void *)odd_number(fuzz));
	fuzz->sent++;
	fuzz->taken += !err;
	return err;
}

/* ---- what is sent ---- */

static void fuzz_param(struct fuzz *fuzz)
{
	struct drm_gloss_get_param get = { .param = below(fuzz, 8) };

	send(fuzz, DRM_IOCTL_GLOSS_GET_PARAM, &get, sizeof(get));
}

/* Small ones: what a job names is pinned, and the machine is small. */
static void fuzz_create(struct fuzz *fuzz)
{
	struct drm_gloss_gem_create create = {
		.size = 1 + below(fuzz, 16 * NODE_PAGE),
		.kind = below(fuzz, 2),
	};

	if (!below(fuzz, 20))
		create.size = odd_number(fuzz) | 1ull << 40;
	if (send(fuzz, DRM_IOCTL_GLOSS_GEM_CREATE, &create, sizeof(create)) == 0 &&
	    create.handle > HANDLES)
		node_destroy(fuzz->fd, create.handle);
}

static void fuzz_close(struct fuzz *fuzz)
{
	node_destroy(fuzz->fd, handle(fuzz));
}

/* Maps an object and leaves what may be a stream in it. */
static void fuzz_map(struct fuzz *fuzz)
{
	struct drm_gloss_gem_mmap_offset map = { .handle = handle(fuzz) };
	uint32_t *words;

	if (send(fuzz, DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET, &map, sizeof(map)))
		return;
	words = mmap(NULL, NODE_PAGE, PROT_READ | PROT_WRITE, MAP_SHARED,
		     below(fuzz, 10) ? fuzz->fd : fuzz->other, (off_t)map.offset);
	if (words == MAP_FAILED)
		return;
	node_write(words, below(fuzz, 4), 4 * below(fuzz, 1200), (uint32_t[]){ 1, 2 }, 2);
	node_read(words + 5, below(fuzz, 4), 4 * below(fuzz, 1200), 1 + below(fuzz, 100));
	words[8 + below(fuzz, 100)] = (uint32_t)draw(fuzz);
	munmap(words, NODE_PAGE);
}

static void fuzz_syncs(struct fuzz *fuzz, struct drm_gloss_sync *syncs)
{
	for (int i = 0; i < ARRAY; i++) {
		syncs[i] = (struct drm_gloss_sync){ .handle = handle(fuzz) };
		if (below(fuzz, 2)) {
			syncs[i].flags = DRM_GLOSS_SYNC_TIMELINE;
			syncs[i].point = 1 + below(fuzz, 100);
		}
	}
	damage(fuzz, syncs, ARRAY * sizeof(*syncs));
}

static void fuzz_slots(struct fuzz *fuzz, struct drm_gloss_slot *slots)
{
	for (int i = 0; i < ARRAY; i++) {
		if (!below(fuzz, 4))
			continue;
		slots[i] = (struct drm_gloss_slot){
			.handle = handle(fuzz),
			.rights = 1 + below(fuzz, 3),
			.offset = (uint64_t)NODE_PAGE * below(fuzz, 2),
			.size = 4 * (1 + below(fuzz, 2 * NODE_PAGE / 4)),
		};
	}
	damage(fuzz, slots, ARRAY * sizeof(*slots));
}

static void fuzz_submit(struct fuzz *fuzz)
{
	struct drm_gloss_slot slots[ARRAY] = { { 0 } };
	struct drm_gloss_sync in[ARRAY], out[ARRAY];
	struct drm_gloss_submit submit = {
		.priority = below(fuzz, 2),
		.slots = (uintptr_t)slots,
		.in_syncs = (uintptr_t)in,
		.out_syncs = (uintptr_t)out,
		.slot_count = below(fuzz, ARRAY),
		.in_sync_count = below(fuzz, 4) ? 0 : below(fuzz, 3),
		.out_sync_count = below(fuzz, 4),
	};

	if (below(fuzz, 5)) {
		submit.stream = handle(fuzz);
		submit.stream_words = 1 + below(fuzz, below(fuzz, 2) ? 20 : 2048);
	}
	if (below(fuzz, 2)) {
		submit.response = handle(fuzz);
		submit.response_words = 1 + below(fuzz, 2048);
	}
	if (below(fuzz, 2)) {
		submit.status = handle(fuzz);
		submit.status_offset = 16 * below(fuzz, 300);
	}
	if (submit.slot_count)
		submit.slot_stride = sizeof(slots[0]);
	if (submit.in_sync_count || submit.out_sync_count)
		submit.sync_stride = sizeof(in[0]);
	fuzz_slots(fuzz, slots);
	fuzz_syncs(fuzz, in);
	fuzz_syncs(fuzz, out);
	send(fuzz, DRM_IOCTL_GLOSS_SUBMIT, &submit, sizeof(submit));
}

static void fuzz_sync(struct fuzz *fuzz)
{
	uint32_t sync = handle(fuzz);
	uint64_t point = 1 + below(fuzz, 100);

	switch (below(fuzz, 6)) {
	case 0:
		drmSyncobjDestroy(fuzz->fd, sync);
		break;
	case 1:
		drmSyncobjReset(fuzz->fd, &sync, 1);
		break;
	case 2:
		drmSyncobjSignal(fuzz->fd, &sync, 1);
		break;
	case 3:
		node_wait(fuzz->fd, sync, below(fuzz, 2) ? point : 0, (int)below(fuzz, 3));
		break;
	default:
		if (!node_sync_new(fuzz->fd, &sync) && sync > HANDLES)
			drmSyncobjDestroy(fuzz->fd, sync);
		break;
	}
}

/* From one file to the other and maybe back. */
static void fuzz_share(struct fuzz *fuzz)
{
	uint32_t there, back;
	int file;

	if (drmPrimeHandleToFD(fuzz->fd, handle(fuzz), DRM_CLOEXEC | DRM_RDWR, &file))
		return;
	if (!drmPrimeFDToHandle(fuzz->other, file, &there))
		node_destroy(fuzz->other, there);
	drmPrimeFDToHandle(fuzz->fd, file, &back);
	close(file);
}

/* A file that is closed while its job may still be under way. */
static void fuzz_file(struct fuzz *fuzz)
{
	struct fuzz brief = *fuzz;

	brief.fd = node_open(vm_env("GLOSS_NODE_MODEL"));
	if (brief.fd < 0)
		vm_fail("open: %s", strerror(-brief.fd));
	for (int i = 0; i < 3; i++) {
		fuzz_create(&brief);
		fuzz_sync(&brief);
		fuzz_submit(&brief);
	}
	close(brief.fd);
	fuzz->state = brief.state;
}

/* ---- all at once ---- */

static void *fuzz_main(void *data)
{
	static void (*const what[])(struct fuzz *) = {
		fuzz_submit, fuzz_submit, fuzz_submit, fuzz_submit, fuzz_create, fuzz_create,
		fuzz_map,    fuzz_close,  fuzz_sync,   fuzz_sync,   fuzz_share,  fuzz_param,
	};
	struct fuzz *fuzz = data;
	struct timespec now, end;

	clock_gettime(CLOCK_MONOTONIC, &end);
	end.tv_sec += SECONDS;
	do {
		for (int i = 0; i < 100; i++)
			what[below(fuzz, sizeof(what) / sizeof(what[0]))](fuzz);
		fuzz_file(fuzz);
		clock_gettime(CLOCK_MONOTONIC, &now);
	} while (now.tv_sec < end.tv_sec);
	return NULL;
}

static void process_main(uint64_t seed)
{
	struct fuzz fuzz[THREADS];
	pthread_t thread[THREADS];
	int fd = node_open(vm_env("GLOSS_NODE_MODEL")),
	    other = node_open(vm_env("GLOSS_NODE_MODEL"));

	if (fd < 0 || other < 0)
		vm_fail("open: %s", strerror(errno));
	for (uint64_t t = 0; t < THREADS; t++) {
		fuzz[t] = (struct fuzz){ .state = seed + (t << 32), .fd = fd, .other = other };
		if (pthread_create(&thread[t], NULL, fuzz_main, &fuzz[t]))
			vm_fail("no thread");
	}
	for (int t = 0; t < THREADS; t++) {
		pthread_join(thread[t], NULL);
		VM_PRINT("%" PRIu64 " ioctls of gloss, %" PRIu64 " of them right\n", fuzz[t].sent,
			 fuzz[t].taken);
		if (fuzz[t].taken < fuzz[t].sent / 20 || fuzz[t].taken > fuzz[t].sent * 19 / 20)
			vm_fail("that is no mix");
	}
}

int main(void)
{
	const uint64_t seed = vm_seed();
	struct client client;
	int failed = 0, err;

	for (uint64_t p = 0; p < PROCESSES; p++) {
		pid_t process = fork();

		if (process < 0)
			vm_fail("fork: %s", strerror(errno));
		if (!process) {
			process_main(seed + (p << 40));
			return VM_PASS;
		}
	}
	for (int p = 0; p < PROCESSES; p++) {
		int status = 1;

		wait(&status);
		failed += status != 0;
	}
	if (failed)
		vm_fail("%d of %d processes failed", failed, PROCESSES);
	err = client_open(&client, vm_env("GLOSS_NODE_MODEL"), NODE_PAGE);
	if (err)
		vm_fail("open: %s", strerror(-err));
	if (!client_works(&client))
		vm_fail("the board does not work any more");
	return VM_PASS;
}
