// SPDX-License-Identifier: GPL-2.0-only
/*
 * The least that any driver takes to have a board do something and hear of it: each read
 * of /dev/gloss_floor writes to the virtual board's doorbell, sleeps until the interrupt
 * and returns. test_latency holds gloss.ko's jobs against it.
 *
 * It is bound by driver_override alone, and one board at a time.
 */
#include <linux/interrupt.h>
#include <linux/io.h>
#include <linux/miscdevice.h>
#include <linux/module.h>
#include <linux/pci.h>
#include <linux/sched.h>

/* The fault window's, from tools/vboard/pci/faults.h. */
#define FLOOR_BAR	1
#define FLOOR_DOORBELL	0x18

struct gloss_floor {
	struct miscdevice misc;
	void __iomem *window;
	struct task_struct *sleeper;
	bool rung;
};

static irqreturn_t gloss_floor_irq(int irq, void *data)
{
	struct gloss_floor *floor = data;

	WRITE_ONCE(floor->rung, true);
	wake_up_process(floor->sleeper);
	return IRQ_HANDLED;
}

/*
 * The board may interrupt before the write to it is over. So interrupts are held back until
 * the thread sleeps, else there would be nobody to wake up, as there is after a job.
 */
static ssize_t gloss_floor_read(struct file *file, char __user *to, size_t size, loff_t *at)
{
	struct gloss_floor *floor = container_of(file->private_data, struct gloss_floor, misc);

	floor->sleeper = current;
	floor->rung = false;
	local_irq_disable();
	set_current_state(TASK_UNINTERRUPTIBLE);
	writel(1, floor->window + FLOOR_DOORBELL);
	schedule_timeout(HZ);
	local_irq_enable();
	return READ_ONCE(floor->rung) ? 0 : -ETIME;
}

static const struct file_operations gloss_floor_fops = {
	.owner = THIS_MODULE,
	.read = gloss_floor_read,
};

static void gloss_floor_free_vectors(void *data)
{
	pci_free_irq_vectors(data);
}

static int gloss_floor_interrupt(struct pci_dev *pdev, struct gloss_floor *floor)
{
	int err = pci_alloc_irq_vectors(pdev, 1, 1, PCI_IRQ_MSI);

	if (err < 0)
		return err;
	err = devm_add_action_or_reset(&pdev->dev, gloss_floor_free_vectors, pdev);
	if (err)
		return err;
	return devm_request_irq(&pdev->dev, pci_irq_vector(pdev, 0), gloss_floor_irq, 0,
				"gloss_floor", floor);
}

static int gloss_floor_probe(struct pci_dev *pdev, const struct pci_device_id *id)
{
	struct gloss_floor *floor = devm_kzalloc(&pdev->dev, sizeof(*floor), GFP_KERNEL);
	int err;

	if (!floor)
		return -ENOMEM;
	err = pcim_enable_device(pdev);
	if (err)
		return err;
	err = pcim_iomap_regions(pdev, BIT(FLOOR_BAR), "gloss_floor");
	if (err)
		return err;
	floor->window = pcim_iomap_table(pdev)[FLOOR_BAR];
	pci_set_master(pdev);
	err = gloss_floor_interrupt(pdev, floor);
	if (err)
		return err;
	floor->misc = (struct miscdevice){
		.minor = MISC_DYNAMIC_MINOR,
		.name = "gloss_floor",
		.fops = &gloss_floor_fops,
		.parent = &pdev->dev,
	};
	pci_set_drvdata(pdev, floor);
	return misc_register(&floor->misc);
}

static void gloss_floor_remove(struct pci_dev *pdev)
{
	struct gloss_floor *floor = pci_get_drvdata(pdev);

	misc_deregister(&floor->misc);
}

static const struct pci_device_id gloss_floor_ids[] = {
	{ }
};

static struct pci_driver gloss_floor_driver = {
	.name = "gloss_floor",
	.id_table = gloss_floor_ids,
	.probe = gloss_floor_probe,
	.remove = gloss_floor_remove,
};
module_pci_driver(gloss_floor_driver);

MODULE_DESCRIPTION("The floor under Gloss's submit latency");
MODULE_LICENSE("GPL");
