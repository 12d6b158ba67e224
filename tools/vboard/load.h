/* SPDX-License-Identifier: MIT */
/* The boards that a program can serve, by the names of their engines. */
#ifndef VBOARD_LOAD_H
#define VBOARD_LOAD_H

#include "transport/transport.h"

/* The first fields of gloss_board_ops and of gloss_usb_board_ops. */
struct vboard_load_head {
	uint32_t abi, version, tile_size, pixels_per_clock;
};

/* The boards of one bus. */
struct vboard_load_bus {
	const char *plugin; /* PLUGIN-t64-k8.so */
	const char *symbol; /* that has its ops */
	uint32_t abi;
	const void *model_t32, *model_t64; /* ops of the C model */
};

struct vboard_loaded {
	const void *ops; /* of the bus */
	void *plugin;    /* that they are in; NULL: in this program */
};

/*
 * "model", the C model, or "rtl", the Verilated board, which is in a plugin.
 * @lanes is for rtl alone. Says in @error what is wrong: -EINVAL: no such engine;
 * -ENOSYS: its plugin is not there or does not fit.
 */
int vboard_load(struct vboard_loaded *loaded, const struct vboard_load_bus *bus, const char *name,
		uint32_t tile, uint32_t lanes, struct accel_transport_error *error);
/* No board of the engine is there any more. */
void vboard_unload(struct vboard_loaded *loaded);

#endif
