/* SPDX-License-Identifier: MIT */
/* The boards that vboard-pci can put into a slot, by name. */
#ifndef VBOARD_LOAD_H
#define VBOARD_LOAD_H

#include "board.h"
#include "transport.h"

struct vboard_loaded {
	const struct gloss_board_ops *ops;
	void *plugin;			/* that they are in; NULL: in this program */
};

/*
 * "model", the C model, or "rtl", the Verilated board, which is in a plugin.
 * @lanes is for rtl alone. Says in @error what is wrong: -EINVAL: no such engine;
 * -ENOSYS: its plugin is not there or does not fit.
 */
int vboard_load(struct vboard_loaded *loaded, const char *name, uint32_t tile,
		       uint32_t lanes, struct accel_transport_error *error);
/* No board of the engine is there any more. */
void vboard_unload(struct vboard_loaded *loaded);

#endif
