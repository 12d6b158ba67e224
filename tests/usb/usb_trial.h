/* SPDX-License-Identifier: MIT */
/*
 * Work whose every byte is known: random jobs and pictures, on a board that may fail and on the
 * model. Each is of itself: it begins with memory that the library has cleared.
 */
#ifndef USB_TRIAL_H
#define USB_TRIAL_H

#include <stdint.h>

#include "accel.h"

/* The model that boards are compared with; its tiles as the board's. Ends the process if not. */
struct accel_device *usb_trial_model(unsigned int tile_size);

/*
 * Up to four jobs and pictures, as @seed says, all of them under way at once. 0: all of it is
 * as on @model, or the first error, -EIO or -ENODEV or -ENOMEM; then what did not end in an
 * error was right all the same. What is wrong is said and ends the process.
 */
int usb_trial_run(struct accel_device *device, struct accel_device *model, uint64_t seed);

/* Says what is wrong, with what usb_trial_context was given, and ends the process. */
void usb_trial_fail(const char *format, ...) __attribute__((format(printf, 1, 2), noreturn));
/* Lent for as long as trials run. */
void usb_trial_context(const char *text);

#endif
