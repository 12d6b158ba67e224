// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "vboard/load.h"
#include "gloss_regs.h"

/* The directory sim/ beside this program. */
static const char *load_beside(char path[PATH_MAX])
{
	ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - sizeof("sim"));

	if (length < 0)
		return NULL;
	path[length] = '\0';
	strcpy(strrchr(path, '/') + 1, "sim");
	return path;
}

static bool load_fits(const struct vboard_load_head *head, uint32_t abi, uint32_t tile,
		      uint32_t lanes)
{
	return head && head->abi == abi && head->version == GLOSS_VERSION &&
	       head->tile_size == tile && head->pixels_per_clock == lanes;
}

/* -ENOENT: the directory has no such @file. */
static int load_from(struct vboard_loaded *loaded, const char *directory, const char *file,
		     const char *symbol, struct accel_transport_error *error)
{
	char path[PATH_MAX];
	int length = snprintf(path, sizeof(path), "%s/%s", directory, file);

	if (length < 0 || (size_t)length >= sizeof(path) || access(path, F_OK))
		return -ENOENT;
	loaded->plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	if (!loaded->plugin) {
		accel_transport_say(error, "%s", dlerror());
		return -ENOSYS;
	}
	loaded->ops = dlsym(loaded->plugin, symbol);
	return 0;
}

static int load_find(struct vboard_loaded *loaded, const char *file, const char *symbol,
		     struct accel_transport_error *error)
{
	char beside[PATH_MAX];
	const char *directory[] = {
		secure_getenv("GLOSS_SIM_PATH"),
		load_beside(beside),
		ACCEL_SIM_DIR,
	};
	int err;

	for (size_t i = 0; i < sizeof(directory) / sizeof(directory[0]); i++) {
		if (!directory[i] || !*directory[i])
			continue;
		err = load_from(loaded, directory[i], file, symbol, error);
		if (err != -ENOENT)
			return err;
	}
	accel_transport_say(error,
			    "%s is not installed; it was looked for in $GLOSS_SIM_PATH, "
			    "sim/ beside the program, and " ACCEL_SIM_DIR,
			    file);
	return -ENOSYS;
}

static int load_plugin(struct vboard_loaded *loaded, const struct vboard_load_bus *bus,
		       uint32_t tile, uint32_t lanes, struct accel_transport_error *error)
{
	char file[64];
	int err;

	snprintf(file, sizeof(file), "%s-t%u-k%u.so", bus->plugin, tile, lanes);
	err = load_find(loaded, file, bus->symbol, error);
	if (err)
		return err;
	if (load_fits(loaded->ops, bus->abi, tile, lanes))
		return 0;
	dlclose(loaded->plugin);
	accel_transport_say(error, "the %s that was found is no board of this version", file);
	return -ENOSYS;
}

int vboard_load(struct vboard_loaded *loaded, const struct vboard_load_bus *bus, const char *name,
		uint32_t tile, uint32_t lanes, struct accel_transport_error *error)
{
	loaded->plugin = NULL;
	if (!strcmp(name, "rtl"))
		return load_plugin(loaded, bus, tile, lanes, error);
	if (strcmp(name, "model") != 0) {
		accel_transport_say(error, "no engine \"%s\": give model or rtl", name);
		return -EINVAL;
	}
	loaded->ops = tile == 32 ? bus->model_t32 : bus->model_t64;
	return 0;
}

void vboard_unload(struct vboard_loaded *loaded)
{
	if (loaded->plugin)
		dlclose(loaded->plugin);
}
