/* SPDX-License-Identifier: MIT */
#ifndef GLOSS_DEVICE_H
#define GLOSS_DEVICE_H

struct accel_device;

/*
 * The device that all contexts of this process draw on: that of the settings, a name that
 * accel_device_new takes, or the first board, or else the model. It is opened by the first call
 * and stays. NULL: it does not open, which a later call tries again. Any thread may call this.
 */
struct accel_device *gloss_device(void);

#endif
