// SPDX-License-Identifier: MIT
#include <dirent.h>
#include <limits.h>
#include <sys/syscall.h>

#include "vm_board.h"
#include "vm_test.h"

int board_write(const char *pci, const char *file, const char *text)
{
	char path[PATH_MAX];

	snprintf(path, sizeof(path), "%s/%s", pci, file);
	return vm_write_file(path, text);
}

static const char *slot(const char *pci)
{
	const char *last = strrchr(pci, '/');

	return last ? last + 1 : pci;
}

int board_unbind(const char *pci)
{
	return board_write(pci, "driver/unbind", slot(pci));
}

int board_bind(const char *pci, const char *name)
{
	char path[PATH_MAX];

	snprintf(path, sizeof(path), "/sys/bus/pci/drivers/%s/bind", name);
	return vm_write_file(path, slot(pci));
}

int board_remove(const char *pci)
{
	return board_write(pci, "remove", "1");
}

int board_rescan(void)
{
	return vm_write_file("/sys/bus/pci/rescan", "1");
}

int board_load(const char *name, const char *parameters)
{
	char path[PATH_MAX];
	int fd, err = 0;

	snprintf(path, sizeof(path), "%s/test/%s.ko", vm_env("GLOSS_DRIVER"), name);
	fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return -errno;
	if (syscall(SYS_finit_module, fd, parameters, 0))
		err = -errno;
	close(fd);
	return err;
}

int board_unload(const char *name)
{
	return syscall(SYS_delete_module, name, O_NONBLOCK) ? -errno : 0;
}

/* The number behind @prefix of the first such entry in the board's drm directory. */
static int drm_number(const char *pci, const char *prefix)
{
	char path[PATH_MAX];
	const struct dirent *entry;
	int number = -ENODEV;
	DIR *dir;

	snprintf(path, sizeof(path), "%s/drm", pci);
	dir = opendir(path);
	if (!dir)
		return -ENODEV;
	while (number < 0 && (entry = readdir(dir)))
		if (!strncmp(entry->d_name, prefix, strlen(prefix)))
			number = atoi(entry->d_name + strlen(prefix));
	closedir(dir);
	return number;
}

int board_node(const char *pci, int milliseconds, char path[BOARD_PATH])
{
	const struct timespec tick = { .tv_nsec = 5000000 };

	for (int waited = 0; waited <= milliseconds; waited += 5) {
		int number = drm_number(pci, "renderD");

		snprintf(path, BOARD_PATH, "/dev/dri/renderD%d", number);
		if (number >= 0 && !access(path, R_OK | W_OK))
			return 0;
		nanosleep(&tick, NULL);
	}
	return -ENODEV;
}

int board_minor(const char *pci)
{
	return drm_number(pci, "card");
}
