// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <errno.h>
#include <string.h>

#include "vboard/load.h"

int vboard_load(struct accel_plugin *loaded, const struct vboard_load_bus *bus, const char *name,
		uint32_t tile, uint32_t lanes, struct accel_transport_error *error)
{
	if (!strcmp(name, "rtl"))
		return accel_plugin_open(loaded, &bus->plugin, tile, lanes, error);
	if (strcmp(name, "model") != 0) {
		accel_transport_say(error, "no engine \"%s\": give model or rtl", name);
		return -EINVAL;
	}
	*loaded = (struct accel_plugin){
		.ops = tile == 32 ? bus->model_t32 : bus->model_t64,
	};
	return 0;
}

void vboard_unload(struct accel_plugin *loaded)
{
	if (loaded->handle)
		dlclose(loaded->handle);
}
