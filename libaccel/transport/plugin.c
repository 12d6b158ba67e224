// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <link.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "transport/plugin.h"
#include "gloss_packets.h"

/* The directory sim/ beside the object that this is linked into; NULL: not known. */
static const char *plugin_beside(char path[PATH_MAX])
{
	static const char here;
	struct link_map *map;
	Dl_info info;

	if (!dladdr1(&here, &info, (void **)&map, RTLD_DL_LINKMAP))
		return NULL;
	if (!realpath(*map->l_name ? map->l_name : "/proc/self/exe", path))
		return NULL;
	*strrchr(path, '/') = '\0';
	if (strlen(path) + sizeof("/sim") > PATH_MAX)
		return NULL;
	return strcat(path, "/sim");
}

static bool plugin_fits(const struct accel_plugin_head *head, const struct accel_plugin_kind *kind,
			uint32_t tile, uint32_t lanes)
{
	return head && head->abi == kind->abi && head->version == GLOSS_VERSION &&
	       head->tile_size == tile && head->pixels_per_clock == lanes;
}

/* -ENOENT: the directory has no such file. */
static int plugin_open_from(struct accel_plugin *plugin, const struct accel_plugin_kind *kind,
			    const char *directory, uint32_t tile, uint32_t lanes,
			    struct accel_transport_error *error)
{
	char path[PATH_MAX];
	int length;

	length = snprintf(path, sizeof(path), "%s/%s-t%u-k%u.so", directory, kind->name, tile,
			  lanes);
	if (length < 0 || (size_t)length >= sizeof(path) || access(path, F_OK))
		return -ENOENT;
	plugin->handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	if (!plugin->handle) {
		accel_transport_say(error, "%s", dlerror());
		return -ENOSYS;
	}
	plugin->ops = dlsym(plugin->handle, kind->symbol);
	if (plugin_fits(plugin->ops, kind, tile, lanes))
		return 0;
	dlclose(plugin->handle);
	accel_transport_say(error, "%s is no %s of this version", path, kind->what);
	return -ENOSYS;
}

int accel_plugin_open(struct accel_plugin *plugin, const struct accel_plugin_kind *kind,
		      uint32_t tile, uint32_t lanes, struct accel_transport_error *error)
{
	char beside[PATH_MAX];
	const char *directory[] = {
		secure_getenv("GLOSS_SIM_PATH"),
		plugin_beside(beside),
		ACCEL_SIM_DIR,
	};
	int err;

	for (size_t i = 0; i < sizeof(directory) / sizeof(directory[0]); i++) {
		if (!directory[i] || !*directory[i])
			continue;
		err = plugin_open_from(plugin, kind, directory[i], tile, lanes, error);
		if (err != -ENOENT)
			return err;
	}
	accel_transport_say(error,
			    "%s-t%u-k%u.so is not installed; it was looked for in "
			    "$GLOSS_SIM_PATH, sim/ beside the %s, and " ACCEL_SIM_DIR,
			    kind->name, tile, lanes, kind->who);
	return -ENOSYS;
}
