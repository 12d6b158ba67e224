// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "load.h"
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

static bool load_fits(const struct gloss_board_ops *ops, uint32_t tile, uint32_t lanes)
{
	return ops && ops->abi == GLOSS_BOARD_ABI && ops->version == GLOSS_VERSION &&
	       ops->tile_size == tile && ops->pixels_per_clock == lanes;
}

/* -ENOENT: the directory has no such file. */
static int load_from(struct vboard_loaded *loaded, const char *directory, uint32_t tile,
			    uint32_t lanes, struct accel_transport_error *error)
{
	char path[PATH_MAX];
	int length;

	length = snprintf(path, sizeof(path), "%s/accel-board-t%u-k%u.so", directory, tile, lanes);
	if (length < 0 || (size_t)length >= sizeof(path) || access(path, F_OK))
		return -ENOENT;
	loaded->plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	if (!loaded->plugin) {
		accel_transport_say(error, "%s", dlerror());
		return -ENOSYS;
	}
	loaded->ops = dlsym(loaded->plugin, GLOSS_BOARD_SYMBOL);
	if (load_fits(loaded->ops, tile, lanes))
		return 0;
	dlclose(loaded->plugin);
	accel_transport_say(error, "%s is no board of this version", path);
	return -ENOSYS;
}

static int load_plugin(struct vboard_loaded *loaded, uint32_t tile, uint32_t lanes,
		       struct accel_transport_error *error)
{
	char beside[PATH_MAX];
	const char *directory[] = {
		secure_getenv("GLOSS_SIM_PATH"),
		load_beside(beside),
		ACCEL_SIM_DIR,
	};
	size_t i;
	int err;

	for (i = 0; i < sizeof(directory) / sizeof(directory[0]); i++) {
		if (!directory[i] || !*directory[i])
			continue;
		err = load_from(loaded, directory[i], tile, lanes, error);
		if (err != -ENOENT)
			return err;
	}
	accel_transport_say(error, "accel-board-t%u-k%u.so is not installed; it was looked for in "
			    "$GLOSS_SIM_PATH, sim/ beside the program, and " ACCEL_SIM_DIR, tile,
			    lanes);
	return -ENOSYS;
}

int vboard_load(struct vboard_loaded *loaded, const char *name, uint32_t tile,
		       uint32_t lanes, struct accel_transport_error *error)
{
	loaded->plugin = NULL;
	if (!strcmp(name, "rtl"))
		return load_plugin(loaded, tile, lanes, error);
	if (strcmp(name, "model") != 0) {
		accel_transport_say(error, "no engine \"%s\": give model or rtl", name);
		return -EINVAL;
	}
	loaded->ops = tile == 32 ? &gloss_board_model_t32 : &gloss_board_model_t64;
	return 0;
}

void vboard_unload(struct vboard_loaded *loaded)
{
	if (loaded->plugin)
		dlclose(loaded->plugin);
}
