#!/bin/sh
# SPDX-License-Identifier: MIT
# Screen savers that know of no board: three through the driver, one on each kind of board, over USB and in RTL too. They
# draw what they draw on model:.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VENDOR="$GLOSS_BUILD/gl" TOOLS="$GLOSS_BUILD/tests/gl"
tests=$GLOSS_SOURCE/tests/gl
"$tests/with_xvfb" 24+noglx "$tests/on_devices" "$work" 'pipes morph3d jigglypuff' "drm:$GLOSS_NODE_MODEL"
"$tests/with_xvfb" 24+noglx "$tests/on_devices" "$work" pipes "drm:$GLOSS_NODE_RTL" "$GLOSS_USB_MODEL" "$GLOSS_USB_RTL"
