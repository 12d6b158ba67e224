// SPDX-License-Identifier: MIT
#include "runner.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/netlink.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#define PCI "/sys/bus/pci/devices"
#define GROUP_CARD 44 /* video, in every Debian */

static int fd;
static unsigned int render;

static int is_board(const struct dirent *entry)
{
	char path[512], ids[2][16] = { "", "" };
	const char *const names[] = { "vendor", "device" };

	for (int i = 0; i < 2; i++) {
		FILE *file;

		snprintf(path, sizeof(path), PCI "/%s/%s", entry->d_name, names[i]);
		file = fopen(path, "r");
		if (!file)
			return false;
		if (!fgets(ids[i], sizeof(ids[i]), file))
			ids[i][0] = '\0';
		fclose(file);
	}
	return !strcmp(ids[0], "0x10ee\n") && !strcmp(ids[1], "0x474c\n");
}

static bool find_node(struct board *board)
{
	char path[128];
	struct dirent *entry;
	bool found = false;
	DIR *dir;

	snprintf(path, sizeof(path), "%s/drm", board->pci);
	dir = opendir(path);
	while (dir && (entry = readdir(dir)))
		if (!strncmp(entry->d_name, "renderD", 7)) {
			snprintf(board->node, sizeof(board->node), "/dev/dri/%.16s", entry->d_name);
			found = !access(board->node, F_OK);
		}
	if (dir)
		closedir(dir);
	return found;
}

static int find(struct board *boards)
{
	struct dirent **entries;
	int count = scandir(PCI, &entries, is_board, alphasort), found = 0;

	for (int i = 0; i < count; i++) {
		if (found < BOARDS) {
			snprintf(boards[found].pci, sizeof(boards[found].pci), PCI "/%.32s",
				 entries[i]->d_name);
			found += find_node(&boards[found]);
		}
		free(entries[i]);
	}
	if (count >= 0)
		free(entries);
	return found;
}

int board_find(struct board *boards, int ms)
{
	int found;

	while ((found = find(boards)) < BOARDS && ms > 0) {
		usleep(10 * 1000);
		ms -= 10;
	}
	board_event();
	return found;
}

static void own(const char *name, unsigned int group)
{
	char path[64];

	snprintf(path, sizeof(path), "/dev/dri/%.32s", name);
	/* One that is gone by now is nobody's. */
	if ((chown(path, 0, group) || chmod(path, 0660)) && errno != ENOENT)
		fprintf(stderr, "%s: %s\n", path, strerror(errno));
}

void board_event(void)
{
	char message[8192];
	struct dirent *entry;
	DIR *dir;

	while (recv(fd, message, sizeof(message), MSG_DONTWAIT) > 0)
		;
	dir = opendir("/dev/dri");
	while (dir && (entry = readdir(dir))) {
		if (!strncmp(entry->d_name, "renderD", 7))
			own(entry->d_name, render);
		else if (!strncmp(entry->d_name, "card", 4))
			own(entry->d_name, GROUP_CARD);
	}
	if (dir)
		closedir(dir);
	usb_own(render);
}

int board_open(unsigned int group_render)
{
	struct sockaddr_nl address = { .nl_family = AF_NETLINK, .nl_groups = 1 };

	render = group_render;
	fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_KOBJECT_UEVENT);
	if (fd < 0 || bind(fd, (struct sockaddr *)&address, sizeof(address)))
		runner_die("uevents: %s", strerror(errno));
	return fd;
}
