// SPDX-License-Identifier: MIT
/*
 * Which fences of an object a job waits for. They are those of another driver, vgem, whose
 * fences signal when a program says so. As root: it loads that driver.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <xf86drm.h>

#include "gloss_node.h"
#include "vm_test.h"

#define CARDS 16

/* Of the kernel's vgem_drm.h, which libdrm does not bring. */
#define VGEM_FENCE_WRITE 1

struct vgem_fence_attach {
	uint32_t handle, flags, out_fence, pad;
};

struct vgem_fence_signal {
	uint32_t fence, flags;
};

#define VGEM_FENCE_ATTACH DRM_IOWR(DRM_COMMAND_BASE + 1, struct vgem_fence_attach)
#define VGEM_FENCE_SIGNAL DRM_IOW(DRM_COMMAND_BASE + 2, struct vgem_fence_signal)

static struct client client;
static int vgem = -1;
static bool vgem_loaded; /* by this test: a kernel may have it built in */

/* An object of vgem's, and what it is to gloss. */
struct foreign {
	uint32_t own, handle;
	int file;
};

static int open_vgem(void)
{
	for (int i = 0; i < CARDS; i++) {
		drmVersion *version;
		char path[64];
		bool found;
		int fd;

		snprintf(path, sizeof(path), "/dev/dri/card%d", i);
		fd = node_open(path);
		version = fd < 0 ? NULL : drmGetVersion(fd);
		found = version && !strcmp(version->name, "vgem");
		drmFreeVersion(version);
		if (found)
			return fd;
		if (fd >= 0)
			close(fd);
	}
	return -ENODEV;
}

static struct foreign foreign_new(void)
{
	struct drm_mode_create_dumb create = { .width = 1024, .height = 1, .bpp = 32 };
	struct foreign object;

	assert_int_equal(node_ioctl(vgem, DRM_IOCTL_MODE_CREATE_DUMB, &create), 0);
	object.own = create.handle;
	assert_int_equal(drmPrimeHandleToFD(vgem, object.own, DRM_CLOEXEC, &object.file), 0);
	assert_int_equal(drmPrimeFDToHandle(client.fd, object.file, &object.handle), 0);
	return object;
}

static void foreign_free(const struct foreign *object)
{
	close(object->file);
	assert_int_equal(node_destroy(client.fd, object->handle), 0);
	assert_int_equal(node_destroy(vgem, object->own), 0);
}

/* A fence of vgem's on the object, which foreign_signal() ends. */
static uint32_t foreign_fence(const struct foreign *object)
{
	struct vgem_fence_attach attach = {
		.handle = object->own,
		.flags = VGEM_FENCE_WRITE,
	};

	assert_int_equal(node_ioctl(vgem, VGEM_FENCE_ATTACH, &attach), 0);
	return attach.out_fence;
}

static void foreign_signal(uint32_t fence)
{
	struct vgem_fence_signal signal = { .fence = fence };

	assert_int_equal(node_ioctl(vgem, VGEM_FENCE_SIGNAL, &signal), 0);
}

/* A job that writes to the object. */
static void submit(const struct foreign *object, uint32_t flags)
{
	struct client_job job;

	client_prepare(&client, &job, 0, 1);
	job.submit.response = object->handle;
	job.submit.response_offset = 0;
	job.submit.flags = flags;
	assert_int_equal(client_submit(&client, &job), 0);
}

static void a_job_waits_for_the_fences_of_its_objects(void **state)
{
	struct foreign object = foreign_new();
	uint32_t fence = foreign_fence(&object);

	(void)state;
	submit(&object, 0);
	assert_int_equal(client_wait(&client, 100), -ETIME);
	foreign_signal(fence);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	foreign_free(&object);
}

static void with_explicit_sync_a_job_does_not_wait_for_them(void **state)
{
	struct foreign object = foreign_new();
	uint32_t fence = foreign_fence(&object);
	struct vgem_fence_signal signal = { .fence = fence };

	(void)state;
	submit(&object, DRM_GLOSS_SUBMIT_EXPLICIT_SYNC);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	/* vgem gives a fence up by itself after ten seconds: it may have, on a slow machine. */
	if (node_ioctl(vgem, VGEM_FENCE_SIGNAL, &signal) == -ETIMEDOUT)
		print_message("the fence was over by then: nothing is proven\n");
	foreign_free(&object);
}

/* While a job without the flag has the object, vgem does not take a fence for it. */
static void with_explicit_sync_nobody_waits_for_a_job(void **state)
{
	const uint32_t flags[] = { 0, DRM_GLOSS_SUBMIT_EXPLICIT_SYNC };
	struct foreign gate = foreign_new(), object = foreign_new();

	(void)state;
	for (size_t i = 0; i < sizeof(flags) / sizeof(flags[0]); i++) {
		struct vgem_fence_attach attach = { .handle = object.own };
		uint32_t fence = foreign_fence(&gate);

		/* In the order of its file, so the second job waits in any case. */
		submit(&gate, 0);
		submit(&object, flags[i]);
		assert_int_equal(client_wait(&client, 100), -ETIME);
		attach.flags = VGEM_FENCE_WRITE;
		assert_int_equal(node_ioctl(vgem, VGEM_FENCE_ATTACH, &attach),
				 flags[i] ? 0 : -EBUSY);
		if (flags[i])
			foreign_signal(attach.out_fence);
		foreign_signal(fence);
		assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	}
	foreign_free(&object);
	foreign_free(&gate);
}

/* New memory is cleared first, whatever the flags say. */
static void with_explicit_sync_new_board_memory_reads_zero(void **state)
{
	enum { WORDS = 1024 };
	struct client_job job;
	uint32_t board;

	(void)state;
	for (int round = 0; round < 8; round++) {
		uint32_t words, value[WORDS];

		memset(value, 0x77, sizeof(value));
		assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_BOARD, NODE_PAGE, &board), 0);
		words = node_read(client.stream, 0, 0, WORDS);
		words += node_write(client.stream + words, 0, 0, value, WORDS);
		client_prepare(&client, &job, words, WORDS);
		job.submit.flags = DRM_GLOSS_SUBMIT_EXPLICIT_SYNC;
		job.slot[0].handle = board;
		job.slot[0].size = NODE_PAGE;
		assert_int_equal(client_submit(&client, &job), 0);
		assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
		for (uint32_t i = 0; i < WORDS; i++)
			assert_int_equal(client.response[i], 0);
		assert_int_equal(node_destroy(client.fd, board), 0);
	}
}

static int open_files(void **state)
{
	(void)state;
	vgem = open_vgem();
	if (vgem < 0) {
		if (system("modprobe vgem 2>/dev/null"))
			vm_skip("vgem: the kernel has no such module");
		vgem_loaded = true;
		vgem = open_vgem();
	}
	if (vgem < 0)
		vm_fail("no card of vgem's: %s", strerror(-vgem));
	return client_open(&client, vm_env("GLOSS_NODE_MODEL"), NODE_PAGE);
}

static int close_files(void **state)
{
	(void)state;
	client_close(&client);
	close(vgem);
	return vgem_loaded ? system("rmmod vgem") : 0;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_job_waits_for_the_fences_of_its_objects),
		cmocka_unit_test(with_explicit_sync_a_job_does_not_wait_for_them),
		cmocka_unit_test(with_explicit_sync_nobody_waits_for_a_job),
		cmocka_unit_test(with_explicit_sync_new_board_memory_reads_zero),
	};

	return cmocka_run_group_tests(tests, open_files, close_files);
}
