# SPDX-License-Identifier: MIT
# Pixels between a program's memory and the library's.

SHIM_SOURCES += $(addprefix mesa_shim/pixel/, pixels.c transfer.c rectangle.c draw_pixels.c)
