#!/bin/sh
# SPDX-License-Identifier: MIT
# The bunny through the driver, on the C model behind the port and on the Verilated core.
exec "$GLOSS_SOURCE/tests/vm/vm_bunny.sh" "drm:$GLOSS_NODE_MODEL" "drm:$GLOSS_NODE_RTL"
