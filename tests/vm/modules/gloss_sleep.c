// SPDX-License-Identifier: GPL-2.0-only
/*
 * Sends one PCI device to sleep when it is loaded and wakes it up when it is unloaded, as
 * a suspend of the whole system would. That can not be had in the tests' machine: the
 * files of its root come over virtio-9p, which does not survive it.
 */
#include <linux/device.h>
#include <linux/module.h>
#include <linux/pci.h>
#include <linux/pm.h>

static char *device;
module_param(device, charp, 0444);
MODULE_PARM_DESC(device, "name of the PCI device, as in /sys/bus/pci/devices");

static struct device *sleeper;

static int gloss_sleep_call(const char *phase, int (*call)(struct device *dev))
{
	int err = call ? call(sleeper) : 0;

	if (err)
		dev_err(sleeper, "%s: %d\n", phase, err);
	return err;
}

static int gloss_sleep_wake(void)
{
	const struct dev_pm_ops *pm = sleeper->bus->pm;
	int err;

	device_lock(sleeper);
	err = gloss_sleep_call("resume_noirq", pm->resume_noirq);
	if (!err)
		err = gloss_sleep_call("resume_early", pm->resume_early);
	if (!err)
		err = gloss_sleep_call("resume", pm->resume);
	device_unlock(sleeper);
	return err;
}

static int gloss_sleep_suspend(void)
{
	const struct dev_pm_ops *pm = sleeper->bus->pm;
	int err;

	device_lock(sleeper);
	err = gloss_sleep_call("suspend", pm->suspend);
	if (!err)
		err = gloss_sleep_call("suspend_late", pm->suspend_late);
	if (!err)
		err = gloss_sleep_call("suspend_noirq", pm->suspend_noirq);
	device_unlock(sleeper);
	return err;
}

static int __init gloss_sleep_init(void)
{
	int err;

	sleeper = bus_find_device_by_name(&pci_bus_type, NULL, device ?: "");
	if (!sleeper)
		return -ENODEV;
	err = gloss_sleep_suspend();
	if (err)
		put_device(sleeper);
	return err;
}

static void __exit gloss_sleep_exit(void)
{
	gloss_sleep_wake();
	put_device(sleeper);
}

module_init(gloss_sleep_init);
module_exit(gloss_sleep_exit);

MODULE_DESCRIPTION("Suspend and resume of one device, for the tests of gloss.ko");
MODULE_LICENSE("GPL");
