#!/bin/sh
# SPDX-License-Identifier: MIT
# The bunny over USB, on the C model behind the port and on the Verilated core.
exec "$GLOSS_SOURCE/tests/vm/vm_bunny.sh" "$GLOSS_USB_MODEL" "$GLOSS_USB_RTL"
