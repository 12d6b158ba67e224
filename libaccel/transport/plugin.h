/* SPDX-License-Identifier: MIT */
/* Plugins: shared objects with a Verilated core or board, one for each tile size and width. */
#ifndef ACCEL_PLUGIN_H
#define ACCEL_PLUGIN_H

#include <stdint.h>

#include "transport/transport.h"

/* What the operations of every plugin begin with. */
struct accel_plugin_head {
	uint32_t abi;     /* of its kind */
	uint32_t version; /* GLOSS_VERSION it was built from */
	uint32_t tile_size, pixels_per_clock;
};

struct accel_plugin_kind {
	const char *name;   /* of the file: NAME-t64-k8.so */
	const char *symbol; /* its operations, which begin with a struct accel_plugin_head */
	uint32_t abi;
	/* For messages: what it is, and who looks for it. */
	const char *what, *who;
};

struct accel_plugin {
	void *handle; /* for dlclose() */
	const void *ops;
};

/*
 * Opens the plugin from the first of these directories that has it: $GLOSS_SIM_PATH, sim/ beside
 * the shared object or the program that this is linked into, and that of `make install`.
 * -ENOSYS: it is not there, does not load, or is of another version; @error says so.
 */
int accel_plugin_open(struct accel_plugin *plugin, const struct accel_plugin_kind *kind,
		      uint32_t tile, uint32_t lanes, struct accel_transport_error *error);

#endif
