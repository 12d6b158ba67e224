/* SPDX-License-Identifier: MIT */
/* The boards that a program can serve, by the names of their engines. */
#ifndef VBOARD_LOAD_H
#define VBOARD_LOAD_H

#include "transport/plugin.h"

/* The boards of one bus. */
struct vboard_load_bus {
	struct accel_plugin_kind plugin;
	const void *model_t32, *model_t64; /* ops of the C model */
};

/*
 * "model", the C model, or "rtl", the Verilated board, which is in a plugin.
 * @lanes is for rtl alone. Says in @error what is wrong: -EINVAL: no such engine;
 * -ENOSYS: its plugin is not there or does not fit. The model has no handle.
 */
int vboard_load(struct accel_plugin *loaded, const struct vboard_load_bus *bus, const char *name,
		uint32_t tile, uint32_t lanes, struct accel_transport_error *error);
/* No board of the engine is there any more. */
void vboard_unload(struct accel_plugin *loaded);

#endif
