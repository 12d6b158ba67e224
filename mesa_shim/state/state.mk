# SPDX-License-Identifier: MIT
SHIM_SOURCES += mesa_shim/state/context.c
