/* SPDX-License-Identifier: MIT */
/*
 * The board as the PCI bus sees it, by its directory in sysfs (GLOSS_PCI_RTL or
 * GLOSS_PCI_MODEL). As root. Functions return 0 or -errno.
 */
#ifndef VM_BOARD_H
#define VM_BOARD_H

#include <stddef.h>

/* Room for a node's path. */
#define BOARD_PATH 64

/* Writes to a file of the board's directory. */
int board_write(const char *pci, const char *file, const char *text);

/* Takes the driver off, or lets driver @name have the board. */
int board_unbind(const char *pci);
int board_bind(const char *pci, const char *name);

/* As if the board were pulled out while power is on, and put back. */
int board_remove(const char *pci);
int board_rescan(void);

/*
 * Loads and unloads module @name of tests/vm/modules; they are built beside gloss.ko, for
 * the same kernel. @parameters is a line of NAME=VALUE.
 */
int board_load(const char *name, const char *parameters);
int board_unload(const char *name);

/* The board's render node, once it is there: -ENODEV after @milliseconds without. */
int board_node(const char *pci, int milliseconds, char path[BOARD_PATH]);

/* The number of the board's directory in debugfs's dri/; -ENODEV. */
int board_minor(const char *pci);

#endif
