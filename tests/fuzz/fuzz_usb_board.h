/* SPDX-License-Identifier: MIT */
/*
 * A hostile board on USB: the honest one (the C model) between whose words and registers bytes put
 * others, as fuzz_usb_input.h says.
 */
#ifndef FUZZ_USB_BOARD_H
#define FUZZ_USB_BOARD_H

#include <stddef.h>
#include <stdint.h>

#include "vboard/board/usb.h"

/*
 * The one board there is, anew, which does what @flags of struct fuzz_usb_head and the @size bytes
 * at @data say. They stay the caller's, and have to be there as long as the board is.
 */
const struct gloss_usb_board_ops *fuzz_usb_board(uint8_t flags, const uint8_t *data, size_t size);

#endif
