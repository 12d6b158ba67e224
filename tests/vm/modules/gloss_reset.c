// SPDX-License-Identifier: GPL-2.0-only
/*
 * Tells the driver of one PCI device that its function will be reset, or that its bus had an
 * error, when it is loaded, and that this is over when it is unloaded. The virtual boards can
 * have neither: they have no such reset, and sit on no port that reports errors.
 */
#include <linux/device.h>
#include <linux/module.h>
#include <linux/pci.h>

static char *device;
module_param(device, charp, 0444);
MODULE_PARM_DESC(device, "name of the PCI device, as in /sys/bus/pci/devices");

static bool error;
module_param(error, bool, 0444);
MODULE_PARM_DESC(error, "an error of the bus, not a reset");

static struct pci_dev *board;

static const struct pci_error_handlers *gloss_reset_handlers(void)
{
	return board->driver ? board->driver->err_handler : NULL;
}

static int __init gloss_reset_init(void)
{
	struct device *found = bus_find_device_by_name(&pci_bus_type, NULL, device ?: "");

	if (!found)
		return -ENODEV;
	board = to_pci_dev(found);
	device_lock(found);
	if (!gloss_reset_handlers()) {
		device_unlock(found);
		put_device(found);
		return -EOPNOTSUPP;
	}
	if (!error)
		gloss_reset_handlers()->reset_prepare(board);
	else if (gloss_reset_handlers()->error_detected(board, pci_channel_io_frozen) !=
		 PCI_ERS_RESULT_NEED_RESET)
		pci_err(board, "an error of the bus asks for no reset\n");
	device_unlock(found);
	return 0;
}

static void __exit gloss_reset_exit(void)
{
	device_lock(&board->dev);
	if (!error)
		gloss_reset_handlers()->reset_done(board);
	else if (gloss_reset_handlers()->slot_reset(board) == PCI_ERS_RESULT_RECOVERED)
		gloss_reset_handlers()->resume(board);
	device_unlock(&board->dev);
	put_device(&board->dev);
}

module_init(gloss_reset_init);
module_exit(gloss_reset_exit);

MODULE_DESCRIPTION("Resets and bus errors of one device, for the tests of gloss.ko");
MODULE_LICENSE("GPL");
