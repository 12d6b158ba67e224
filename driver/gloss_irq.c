// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: The interrupt
 *
 * With an MSI of its own the board raises one for each job that ends, and the driver
 * finds all it needs in memory: a register is read only when an interrupt came and no
 * job of those the board has did end, which may mean a DMA error.
 *
 * INTx may be somebody else's, and stays raised until its cause is cleared.
 */
#include <linux/interrupt.h>
#include <linux/pci.h>

#include "gloss_drv.h"

static bool gloss_irq_board_gone(struct gloss_device *gdev, u32 status)
{
	if (status != U32_MAX)
		return false;
	gloss_device_set_gone(gdev, "it does not answer");
	return true;
}

static irqreturn_t gloss_irq_msi(int irq, void *data)
{
	struct gloss_device *gdev = data;
	u32 status;

	if (gloss_ring_reap(&gdev->ring) || gloss_ring_idle(&gdev->ring))
		return IRQ_HANDLED;

	status = gloss_read(gdev, GLOSS_REG_INTERRUPT_STATUS);
	if (!gloss_irq_board_gone(gdev, status) && status & GLOSS_REG_INTERRUPT_STATUS_DMA)
		gloss_sched_kick(gdev);
	return IRQ_HANDLED;
}

static irqreturn_t gloss_irq_intx(int irq, void *data)
{
	struct gloss_device *gdev = data;
	u32 status = gloss_read(gdev, GLOSS_REG_INTERRUPT_STATUS);

	if (gloss_irq_board_gone(gdev, status) || !status)
		return IRQ_NONE;

	/* Before the ring is looked at, so that a job that ends after that interrupts again. */
	gloss_write(gdev, GLOSS_REG_INTERRUPT_STATUS, status);
	gloss_ring_reap(&gdev->ring);
	if (status & GLOSS_REG_INTERRUPT_STATUS_DMA)
		gloss_sched_kick(gdev);
	return IRQ_HANDLED;
}

int gloss_irq_init(struct gloss_device *gdev)
{
	struct pci_dev *pdev = to_pci_dev(gdev->drm.dev);
	int ret;

	ret = pci_alloc_irq_vectors(pdev, 1, 1, PCI_IRQ_MSI | PCI_IRQ_INTX);
	if (ret < 0)
		return ret;

	gdev->msi = pdev->msi_enabled;
	gdev->irq = pci_irq_vector(pdev, 0);
	return devm_request_irq(gdev->drm.dev, gdev->irq,
				gdev->msi ? gloss_irq_msi : gloss_irq_intx,
				gdev->msi ? 0 : IRQF_SHARED, "gloss", gdev);
}

void gloss_irq_fini(struct gloss_device *gdev)
{
	devm_free_irq(gdev->drm.dev, gdev->irq, gdev);
}
