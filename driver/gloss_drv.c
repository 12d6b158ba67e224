// SPDX-License-Identifier: GPL-2.0-only
/*
 * The module, what a board goes through between its plugging in and its pulling out, and
 * what programs can ask of it.
 */
#include <drm/drm_debugfs.h>
#include <drm/drm_drv.h>
#include <drm/drm_file.h>
#include <drm/drm_gem.h>
#include <drm/drm_ioctl.h>
#include <drm/drm_prime.h>
#include <linux/dma-mapping.h>
#include <linux/module.h>
#include <linux/pci.h>
#include <linux/pm.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

/* No ids are assigned to Gloss; boards use the FPGA's vendor and a subsystem of their own. */
#define GLOSS_PCI_DEVICE	0x474c
#define GLOSS_PCI_SUBDEVICE	0x534f
#define GLOSS_PCI_BAR		0
/* The registers, up to the last one that is used here. */
#define GLOSS_REG_BYTES		(GLOSS_REG_STALL_RESPONSE + sizeof(u32))

unsigned int gloss_job_limit_ms = 10000;
module_param_named(job_limit_ms, gloss_job_limit_ms, uint, 0644);
MODULE_PARM_DESC(job_limit_ms, "A job that runs for so long is ended, and lost");

unsigned int gloss_timeout_ms = 2000;
module_param_named(timeout_ms, gloss_timeout_ms, uint, 0444);
MODULE_PARM_DESC(timeout_ms, "A job is lost, and the board reset, when nothing moves for so long");

static int gloss_get_param_ioctl(struct drm_device *drm, void *data, struct drm_file *file)
{
	const struct gloss_device *gdev = to_gloss_device(drm);
	struct drm_gloss_get_param *args = data;

	if (args->pad)
		return -EINVAL;

	switch (args->param) {
	case DRM_GLOSS_PARAM_VERSION:
		args->value = gdev->version;
		return 0;
	case DRM_GLOSS_PARAM_TILE_SIZE:
		args->value = gdev->tile_size;
		return 0;
	case DRM_GLOSS_PARAM_PIXELS_PER_CLOCK:
		args->value = gdev->pixels_per_clock;
		return 0;
	case DRM_GLOSS_PARAM_MEMORY_SIZE:
		args->value = gdev->memory.size;
		return 0;
	case DRM_GLOSS_PARAM_SLOTS:
		args->value = GLOSS_SLOTS;
		return 0;
	case DRM_GLOSS_PARAM_STREAM_WORDS_MAX:
		args->value = GLOSS_STREAM_WORDS_MAX;
		return 0;
	case DRM_GLOSS_PARAM_JOBS_LOST:
		args->value = atomic_read(&to_gloss_file(file)->jobs_lost);
		return 0;
	case DRM_GLOSS_PARAM_JOB_LIMIT:
		args->value = READ_ONCE(gloss_job_limit_ms);
		return 0;
	case DRM_GLOSS_PARAM_JOBS_QUEUED:
		args->value = GLOSS_FILE_JOBS;
		return 0;
	default:
		return -EINVAL;
	}
}

static const struct drm_ioctl_desc gloss_ioctls[] = {
	DRM_IOCTL_DEF_DRV(GLOSS_GET_PARAM, gloss_get_param_ioctl, DRM_RENDER_ALLOW),
	DRM_IOCTL_DEF_DRV(GLOSS_GEM_CREATE, gloss_gem_create_ioctl, DRM_RENDER_ALLOW),
	DRM_IOCTL_DEF_DRV(GLOSS_GEM_MMAP_OFFSET, gloss_gem_mmap_offset_ioctl, DRM_RENDER_ALLOW),
	DRM_IOCTL_DEF_DRV(GLOSS_SUBMIT, gloss_submit_ioctl, DRM_RENDER_ALLOW),
	DRM_IOCTL_DEF_DRV(GLOSS_GET_CLOCKS, gloss_clocks_ioctl, DRM_RENDER_ALLOW),
};

static const struct file_operations gloss_fops = {
	.owner = THIS_MODULE,
	DRM_GEM_FOPS,
	.show_fdinfo = gloss_fdinfo_show,
};

static const struct drm_driver gloss_driver = {
	.driver_features = DRIVER_GEM | DRIVER_RENDER | DRIVER_SYNCOBJ | DRIVER_SYNCOBJ_TIMELINE,
	.open = gloss_file_open,
	.postclose = gloss_file_close,
	.ioctls = gloss_ioctls,
	.num_ioctls = ARRAY_SIZE(gloss_ioctls),
	.fops = &gloss_fops,
	.gem_create_object = gloss_host_new,
	.gem_prime_import_sg_table = gloss_host_import,
	GLOSS_COMPAT_PRIME
#ifdef CONFIG_DEBUG_FS
	.debugfs_init = gloss_debugfs_init,
#endif
	.name = "gloss",
	.desc = "Gloss 3D accelerator",
	GLOSS_COMPAT_DATE
	.major = 1,
	.minor = 0,
};

static int gloss_pci_enable(struct gloss_device *gdev)
{
	struct pci_dev *pdev = to_pci_dev(gdev->drm.dev);
	int ret;

	ret = pcim_enable_device(pdev);
	if (ret)
		return ret;

	/* What is not there reads as all ones, and may be another device's. */
	if (pci_resource_len(pdev, GLOSS_PCI_BAR) < GLOSS_REG_BYTES)
		return dev_err_probe(&pdev->dev, -ENODEV, "BAR %d has only %llu bytes\n",
				     GLOSS_PCI_BAR,
				     (u64)pci_resource_len(pdev, GLOSS_PCI_BAR));

	ret = pcim_iomap_regions(pdev, BIT(GLOSS_PCI_BAR), "gloss");
	if (ret)
		return ret;
	gdev->registers = pcim_iomap_table(pdev)[GLOSS_PCI_BAR];

	ret = dma_set_mask_and_coherent(&pdev->dev, DMA_BIT_MASK(64));
	if (ret)
		return ret;
	pci_set_master(pdev);
	/* For gloss_pci_slot_reset(). */
	pci_save_state(pdev);
	return 0;
}

static int gloss_device_init(struct gloss_device *gdev)
{
	init_waitqueue_head(&gdev->jobs_wait);
	return gloss_device_identify(gdev) ?:
	       gloss_device_reset(gdev) ?:
	       gloss_ring_init(gdev) ?:
	       gloss_clocks_init(gdev) ?:
	       gloss_hosts_init(gdev) ?:
	       gloss_memory_init(gdev) ?:
	       gloss_sched_init(gdev) ?:
	       gloss_pages_init(gdev) ?:
	       gloss_clear_init(gdev) ?:
	       gloss_irq_init(gdev);
}

static int gloss_pci_probe(struct pci_dev *pdev, const struct pci_device_id *id)
{
	struct gloss_device *gdev;
	int ret;

	gdev = devm_drm_dev_alloc(&pdev->dev, &gloss_driver, struct gloss_device, drm);
	if (IS_ERR(gdev))
		return PTR_ERR(gdev);

	pci_set_drvdata(pdev, gdev);
	ret = gloss_pci_enable(gdev) ?: gloss_device_init(gdev);
	if (ret)
		return dev_err_probe(&pdev->dev, ret, "no board to work with\n");

	ret = gloss_device_start(gdev) ?: drm_dev_register(&gdev->drm, 0);
	if (ret)
		gloss_device_reset(gdev);
	return ret;
}

/* Unbound, or pulled out: all jobs end, and the board touches no memory any more. */
static void gloss_pci_remove(struct pci_dev *pdev)
{
	struct gloss_device *gdev = pci_get_drvdata(pdev);

	drm_dev_unplug(&gdev->drm);
	gloss_irq_fini(gdev);
	gloss_device_reset(gdev);
	gloss_device_set_gone(gdev, NULL);
	gloss_hosts_unmap(gdev);
}

/* Before another kernel runs, whose memory the board must not write to. */
static void gloss_pci_shutdown(struct pci_dev *pdev)
{
	struct gloss_device *gdev = pci_get_drvdata(pdev);

	gloss_device_set_gone(gdev, NULL);
	gloss_device_reset(gdev);
}

/* What the board can not end in time is lost; what it does not have yet waits. */
static int gloss_pm_suspend(struct device *dev)
{
	gloss_sched_suspend(dev_get_drvdata(dev));
	return 0;
}

/*
 * Board memory may have lost its content. It is cleared, so that it is nobody else's, and
 * files are told.
 */
static int gloss_pm_resume(struct device *dev)
{
	gloss_sched_resume(dev_get_drvdata(dev));
	return 0;
}

static DEFINE_SIMPLE_DEV_PM_OPS(gloss_pm_ops, gloss_pm_suspend, gloss_pm_resume);

/* A function reset is to the board as a loss of power. */
static void gloss_pci_reset_prepare(struct pci_dev *pdev)
{
	gloss_sched_suspend(pci_get_drvdata(pdev));
}

static void gloss_pci_reset_done(struct pci_dev *pdev)
{
	gloss_sched_resume(pci_get_drvdata(pdev));
}

static pci_ers_result_t gloss_pci_error_detected(struct pci_dev *pdev, pci_channel_state_t state)
{
	struct gloss_device *gdev = pci_get_drvdata(pdev);

	if (state == pci_channel_io_normal)
		return PCI_ERS_RESULT_CAN_RECOVER;
	if (state == pci_channel_io_perm_failure) {
		gloss_device_set_gone(gdev, "its bus has failed");
		return PCI_ERS_RESULT_DISCONNECT;
	}
	/* Reads all ones now, so nothing is waited for. */
	gloss_sched_suspend(gdev);
	return PCI_ERS_RESULT_NEED_RESET;
}

static pci_ers_result_t gloss_pci_slot_reset(struct pci_dev *pdev)
{
	struct gloss_device *gdev = pci_get_drvdata(pdev);

	pci_restore_state(pdev);
	pci_save_state(pdev);
	if (!gloss_device_identify(gdev))
		return PCI_ERS_RESULT_RECOVERED;

	gloss_device_set_gone(gdev, "it did not come back from an error of its bus");
	gloss_sched_resume(gdev);
	return PCI_ERS_RESULT_DISCONNECT;
}

static void gloss_pci_error_resume(struct pci_dev *pdev)
{
	struct gloss_device *gdev = pci_get_drvdata(pdev);

	/* Not after an error that did not stop the bus. */
	if (gdev->ring.asleep)
		gloss_sched_resume(gdev);
}

static const struct pci_error_handlers gloss_pci_error_handlers = {
	.error_detected = gloss_pci_error_detected,
	.slot_reset = gloss_pci_slot_reset,
	.resume = gloss_pci_error_resume,
	.reset_prepare = gloss_pci_reset_prepare,
	.reset_done = gloss_pci_reset_done,
};

static const struct pci_device_id gloss_pci_ids[] = {
	{ PCI_DEVICE_SUB(PCI_VENDOR_ID_XILINX, GLOSS_PCI_DEVICE,
			 PCI_VENDOR_ID_XILINX, GLOSS_PCI_SUBDEVICE) },
	{ }
};
MODULE_DEVICE_TABLE(pci, gloss_pci_ids);

static struct pci_driver gloss_pci_driver = {
	.name = "gloss",
	.id_table = gloss_pci_ids,
	.probe = gloss_pci_probe,
	.remove = gloss_pci_remove,
	.shutdown = gloss_pci_shutdown,
	.err_handler = &gloss_pci_error_handlers,
	.driver.pm = pm_sleep_ptr(&gloss_pm_ops),
};

static int __init gloss_init(void)
{
	return pci_register_driver(&gloss_pci_driver);
}

static void __exit gloss_exit(void)
{
	pci_unregister_driver(&gloss_pci_driver);
	/* The last fence is gone, but what freed it may not have returned. */
	rcu_barrier();
}

module_init(gloss_init);
module_exit(gloss_exit);

MODULE_DESCRIPTION("Gloss 3D accelerator on PCI");
MODULE_LICENSE("GPL");
GLOSS_COMPAT_IMPORT_NS(DMA_BUF);
