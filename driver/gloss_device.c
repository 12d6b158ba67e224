// SPDX-License-Identifier: GPL-2.0-only
/*
 * A board: whether it is one that this driver knows, its reset, and its going away.
 */
#include <drm/drm_print.h>
#include <linux/bitfield.h>
#include <linux/iopoll.h>
#include <linux/pci.h>
#include <linux/sizes.h>

#include "gloss_drv.h"

#define GLOSS_RESET_POLL_US	20
#define GLOSS_RESET_TIMEOUT_US	(2 * USEC_PER_SEC)

static int gloss_device_check_version(struct gloss_device *gdev)
{
	u32 identity = gloss_read(gdev, GLOSS_REG_IDENTITY);

	if (identity != GLOSS_IDENTITY) {
		drm_err(&gdev->drm, "not a Gloss board: identity %#010x, not %#010x\n", identity,
			GLOSS_IDENTITY);
		return -ENODEV;
	}

	gdev->version = gloss_read(gdev, GLOSS_REG_VERSION);
	if (gdev->version != GLOSS_VERSION) {
		drm_err(&gdev->drm, "the board has interface version %u, this driver is for %u\n",
			gdev->version, GLOSS_VERSION);
		return -ENODEV;
	}
	return 0;
}

static int gloss_device_check_capabilities(struct gloss_device *gdev)
{
	u32 value = gloss_read(gdev, GLOSS_REG_CAPABILITIES);
	u32 ring = FIELD_GET(GLOSS_REG_CAPABILITIES_RING_MAX_LOG2, value);
	u64 pages = gloss_read(gdev, GLOSS_REG_MEMORY_PAGES);

	gdev->tile_size = FIELD_GET(GLOSS_REG_CAPABILITIES_TILE_SIZE, value);
	gdev->pixels_per_clock = FIELD_GET(GLOSS_REG_CAPABILITIES_PIXELS_PER_CLOCK, value);
	/* A slot's range ends at 4 GiB at most. */
	gdev->memory.size = min_t(u64, pages * GLOSS_PAGE_BYTES, SZ_4G);

	if ((gdev->tile_size != 32 && gdev->tile_size != 64) || !pages ||
	    ring < GLOSS_RING_MAX_LOG2) {
		drm_err(&gdev->drm, "cannot use a board with tiles of %u, %llu pages, ring log2 %u\n",
			gdev->tile_size, pages, ring);
		return -ENODEV;
	}
	return 0;
}

int gloss_device_identify(struct gloss_device *gdev)
{
	return gloss_device_check_version(gdev) ?: gloss_device_check_capabilities(gdev);
}

/*
 * Ends whatever the board does. When this has returned, without an error too, it writes
 * to no page of the host any more.
 */
int gloss_device_reset(struct gloss_device *gdev)
{
	u32 value;
	int ret;

	gloss_write(gdev, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	ret = readl_poll_timeout(gdev->registers + GLOSS_REG_CONTROL, value,
				 value == U32_MAX || !(value & GLOSS_REG_CONTROL_RESET),
				 GLOSS_RESET_POLL_US, GLOSS_RESET_TIMEOUT_US);
	if (value == U32_MAX)
		return -ENODEV;
	if (ret)
		pci_clear_master(to_pci_dev(gdev->drm.dev));
	return ret;
}

static void gloss_device_write_address(struct gloss_device *gdev, u32 low, u32 high, u64 address)
{
	gloss_write(gdev, low, lower_32_bits(address));
	gloss_write(gdev, high, upper_32_bits(address));
}

/* After a reset: lets the board take jobs from the ring, which is empty. */
int gloss_device_start(struct gloss_device *gdev)
{
	const struct gloss_ring *ring = &gdev->ring;

	gloss_device_write_address(gdev, GLOSS_REG_RING_LOW, GLOSS_REG_RING_HIGH,
				   gloss_ring_address(ring, ring->shared->descriptor));
	gloss_device_write_address(gdev, GLOSS_REG_COMPLETION_LOW, GLOSS_REG_COMPLETION_HIGH,
				   gloss_ring_address(ring, ring->shared->completion));
	gloss_write(gdev, GLOSS_REG_RING_LOG2,
		    FIELD_PREP(GLOSS_REG_RING_LOG2_LOG2, GLOSS_RING_MAX_LOG2));
	/* A fault is told of with the job that had it. */
	gloss_write(gdev, GLOSS_REG_INTERRUPT_MASK,
		    GLOSS_REG_INTERRUPT_MASK_DONE | GLOSS_REG_INTERRUPT_MASK_DMA);
	gloss_write(gdev, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
	return gloss_read(gdev, GLOSS_REG_CONTROL) == GLOSS_REG_CONTROL_ENABLE ? 0 : -ENODEV;
}

/*
 * Gives up on the board: what it has ends now, what comes later at once, with -ENODEV. As
 * that may free pages, a board that is there after all must not write to them any more.
 */
void gloss_device_set_gone(struct gloss_device *gdev, const char *why)
{
	if (!xchg(&gdev->gone, true)) {
		pci_clear_master(to_pci_dev(gdev->drm.dev));
		if (why)
			drm_err(&gdev->drm, "the board is lost: %s\n", why);
	}
	gloss_ring_fail(&gdev->ring, -ENODEV);
	wake_up_all(&gdev->jobs_wait);
}
